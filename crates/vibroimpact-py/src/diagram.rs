//! The orbit diagram as arrays over sweep, value and point, filled up with NaN.

use crate::axis::{SpanArgument, parameter};
use crate::columns::column;
use crate::door::{self, Watch};
use crate::error::Trouble;
use crate::oscillator::Oscillator;
use crate::simulate::text;
use numpy::{Element, IntoPyArray, PyArray1, PyArray2, PyArray3, PyArrayMethods};
use pyo3::prelude::*;
use vibroimpact_study::diagram::{Diagram, Direction, Kind, Point, Show, Step, Sweep};
use vibroimpact_study::{DiagramPlan, Plan, Task};

/// The fields of the Dataset.
#[derive(IntoPyObject)]
pub(crate) struct Fields<'py> {
    values: Bound<'py, PyArray1<f64>>,
    sweeps: Vec<String>,
    /// 0 impacts, 1 no impact, 2 stuck, 3 undecided.
    kind: Bound<'py, PyArray2<u8>>,
    count: Bound<'py, PyArray2<u32>>,
    /// Phase of an impact, or position at phase 0.
    first: Bound<'py, PyArray3<f64>>,
    /// Speed of arrival, or velocity at phase 0.
    second: Bound<'py, PyArray3<f64>>,
    /// +1 for the first stop, -1 for the second, 0 for none.
    side: Bound<'py, PyArray3<i8>>,
    plan: String,
}

fn show(name: &str) -> Result<Show, Trouble> {
    match name {
        "velocity" => Ok(Show::Velocity),
        "strobe" => Ok(Show::Strobe),
        other => Err(Trouble::question(format!("`{other}` cannot be shown; there are velocity, strobe"))),
    }
}

fn direction(name: &str, starts: Option<u64>, seed: Option<u64>) -> Result<Direction, Trouble> {
    if name != "scatter" && (starts.is_some() || seed.is_some()) {
        return Err(Trouble::question("starts and seed belong to direction=\"scatter\""));
    }
    match name {
        "up" => Ok(Direction::Up),
        "down" => Ok(Direction::Down),
        "both" => Ok(Direction::Both),
        "scatter" => Ok(Direction::Scatter { starts: starts.unwrap_or(8), seed: seed.unwrap_or(1) }),
        other => Err(Trouble::question(format!("`{other}` is no direction; there are up, down, both, scatter"))),
    }
}

/// Rows of sweeps, columns of values, so many points deep.
struct Shape {
    sweeps: usize,
    values: usize,
    points: usize,
    /// Whether the only sweep is the one down.
    down: bool,
}

impl Shape {
    fn of(found: &Diagram) -> Self {
        Self {
            sweeps: usize::try_from(found.plan.runs()).unwrap_or(0),
            values: found.plan.over.count() as usize,
            points: found.steps.iter().map(|step| step.points.len()).max().unwrap_or(0),
            down: found.plan.direction == Direction::Down,
        }
    }

    fn place(&self, step: &Step) -> usize {
        let row = match step.sweep {
            Sweep::Up => 0,
            Sweep::Down => usize::from(!self.down),
            Sweep::Start(k) => usize::try_from(k).unwrap_or(0),
        };
        row * self.values + step.index as usize
    }

    /// One number for each motion.
    fn flat<'py, T: Element + Copy>(
        &self,
        py: Python<'py>,
        found: &Diagram,
        empty: T,
        of: impl Fn(&Step) -> T,
    ) -> PyResult<Bound<'py, PyArray2<T>>> {
        let mut cells = vec![empty; self.sweeps * self.values];
        found.steps.iter().for_each(|step| cells[self.place(step)] = of(step));
        cells.into_pyarray(py).reshape([self.sweeps, self.values])
    }

    /// One number for each point.
    fn deep<'py, T: Element + Copy>(
        &self,
        py: Python<'py>,
        found: &Diagram,
        empty: T,
        of: impl Fn(&Point) -> T,
    ) -> PyResult<Bound<'py, PyArray3<T>>> {
        let mut cells = vec![empty; self.sweeps * self.values * self.points];
        for step in &found.steps {
            let begin = self.place(step) * self.points;
            cells[begin..].iter_mut().zip(&step.points).for_each(|(cell, point)| *cell = of(point));
        }
        cells.into_pyarray(py).reshape([self.sweeps, self.values, self.points])
    }
}

/// Follows the motions at all values of a parameter.
#[pyfunction]
#[allow(clippy::too_many_arguments)] // keywords
pub(crate) fn orbit_diagram<'py>(
    py: Python<'py>,
    osc: Oscillator,
    vary: &str,
    over: SpanArgument,
    show: &str,
    direction: &str,
    starts: Option<u64>,
    seed: Option<u64>,
    transient: u64,
    keep: u64,
    threads: usize,
    progress: Option<Py<PyAny>>,
) -> Result<Fields<'py>, Trouble> {
    let (over, direction) = (over.span()?, self::direction(direction, starts, seed)?);
    let task = DiagramPlan { vary: parameter(vary)?, over, show: self::show(show)?, direction, transient, keep };
    let system = osc.plan.with(task.vary, over.at(0))?;
    let plan = Plan::new(system, Task::Diagram(task));
    plan.check()?;
    let total = u64::from(over.count()) * task.runs();
    let watch = Watch { what: "following motions", total, progress, threads };
    let found = door::run(py, watch, move |control| Ok(vibroimpact_study::diagram(&system, &task, control)?))?;
    let shape = Shape::of(&found);
    let number = |point: &Point| match point {
        Point::Impact { phase, velocity, .. } => (*phase, *velocity),
        Point::Chatter { phase, .. } => (*phase, 0.0),
        Point::State { x, v } => (*x, *v),
    };
    Ok(Fields {
        values: column(py, over.values()),
        sweeps: match direction {
            Direction::Up => vec!["up".into()],
            Direction::Down => vec!["down".into()],
            Direction::Both => vec!["up".into(), "down".into()],
            Direction::Scatter { starts, .. } => (1..=starts).map(|k| format!("start {k}")).collect(),
        },
        kind: shape.flat(py, &found, 3, |step| match step.kind {
            Kind::Impacts => 0,
            Kind::NoImpact => 1,
            Kind::Stuck => 2,
            Kind::Undecided => 3,
        })?,
        count: shape.flat(py, &found, 0, |step| u32::try_from(step.points.len()).unwrap_or(u32::MAX))?,
        first: shape.deep(py, &found, f64::NAN, |point| number(point).0)?,
        second: shape.deep(py, &found, f64::NAN, |point| number(point).1)?,
        side: shape.deep(py, &found, 0, |point| match point {
            Point::Impact { side, .. } | Point::Chatter { side, .. } => crate::columns::sign(*side),
            Point::State { .. } => 0,
        })?,
        plan: text(&plan)?,
    })
}

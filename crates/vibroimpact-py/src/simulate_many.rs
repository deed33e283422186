//! Many motions event by event, and their states at given times, at one phase of the force and at one position.

use crate::door::{self, Watch};
use crate::error::Trouble;
use crate::oscillator::OscillatorFile;
use crate::points::{Over, listed};
use crate::section::{Section, States, columns, whole_periods};
use crate::simulate::{StartArgument, simulate_plan, start_plan};
use numpy::{IntoPyArray, PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use vibroimpact::motion::{Level, Strobes, states_at};
use vibroimpact::system::phase::wrap;
use vibroimpact::{Oscillator, Start};
use vibroimpact_study::{
    Control, END_REASONS, EventColumns, PlanError, PointsPlan, StartPlan, SystemPlan, real_numbers,
};

/// The points, the system and the start of a question.
struct Asked {
    points: PointsPlan,
    system: SystemPlan,
    start: StartPlan,
}

impl Asked {
    fn new(osc: OscillatorFile, over: &Over<'_>, start: StartArgument) -> Result<Self, Trouble> {
        Ok(Self { points: listed(over)?, system: osc.plan, start: start_plan(start) })
    }

    /// The results of `work` at all points.
    fn each<T: Send + 'static>(
        self,
        py: Python<'_>,
        (threads, progress): (usize, Option<Py<PyAny>>),
        work: impl Fn(&Oscillator, Start, &Control<'_>) -> Result<T, PlanError> + Send + Sync + 'static,
    ) -> Result<Vec<T>, Trouble> {
        let watch = Watch { what: "following motions", total: self.points.count(), progress, threads };
        door::run(py, watch, move |control| {
            let all = self.points.each((&self.system, &self.start), control, |osc, start| work(osc, start, control))?;
            Ok(all.into_iter().collect::<Result<Vec<T>, PlanError>>()?)
        })
    }
}

/// The events of many motions: rows of `room` cells each, as [`EventColumns`] describes them.
#[derive(IntoPyObject)]
pub(crate) struct ManyFields<'py> {
    room: usize,
    width: usize,
    kind: Bound<'py, PyArray1<i8>>,
    side: Bound<'py, PyArray1<i8>>,
    /// Times, phases, and velocities before and after, one after another.
    real: Bound<'py, PyArray1<f64>>,
    count: Bound<'py, PyArray1<i32>>,
    end: Bound<'py, PyArray1<i8>>,
    end_time: Bound<'py, PyArray1<f64>>,
}

/// The reasons for which lists of events end, in the order of their codes.
#[pyfunction]
pub(crate) const fn end_reasons() -> [&'static str; END_REASONS.len()] {
    END_REASONS
}

/// Follows the motion at each point event by event.
#[pyfunction]
pub(crate) fn simulate_points<'py>(
    py: Python<'py>,
    osc: OscillatorFile,
    over: Over<'py>,
    start: StartArgument,
    plan: &str,
    threads: usize,
    progress: Option<Py<PyAny>>,
) -> Result<ManyFields<'py>, Trouble> {
    let Asked { points, system, start } = Asked::new(osc, &over, start)?;
    let watch = Watch { what: "following motions", total: points.count(), progress, threads };
    let plan = simulate_plan(plan)?;
    let real = PyArray1::zeros(py, real_numbers(&points, &plan), false);
    let mut borrowed = real.readwrite();
    let memory = borrowed.as_slice_mut().map_err(|_| Trouble::Defect("borrowing new memory"))?;
    let found = door::run_borrowing(py, watch, move |control| {
        Ok(vibroimpact_study::simulate_points(&points, (&system, &start), &plan, memory, control)?)
    })?;
    drop(borrowed);
    let EventColumns { room, width, kind, side, refitted, count, end, end_time } = found;
    Ok(ManyFields {
        room,
        width,
        kind: kind.into_pyarray(py),
        side: side.into_pyarray(py),
        real: refitted.map_or(real, |refitted| refitted.into_pyarray(py)),
        count: count.into_pyarray(py),
        end: end.into_pyarray(py),
        end_time: end_time.into_pyarray(py),
    })
}

/// The states of the motion at each point in a section: times, phases, positions and velocities.
#[pyfunction]
pub(crate) fn states_of_points<'py>(
    py: Python<'py>,
    osc: OscillatorFile,
    over: Over<'py>,
    start: StartArgument,
    of: Section,
    threads: usize,
    progress: Option<Py<PyAny>>,
) -> Result<States<'py>, Trouble> {
    of.check()?;
    let rows =
        Asked::new(osc, &over, start)?.each(py, (threads, progress), move |osc, start, _| section(osc, start, &of))?;
    Ok(columns(py, &rows, 4, |state, k| state[k]))
}

/// The states of a motion in a section.
fn section(osc: &Oscillator, start: Start, of: &Section) -> Result<Vec<[f64; 4]>, PlanError> {
    Ok(match of {
        Section::At(times) => {
            let states = states_at(osc, start, times).into_iter().zip(times);
            states.map(|(state, time)| state.map_or([f64::NAN; 4], |of| [*time, of.phase, of.x, of.v])).collect()
        }
        Section::Phase(phase, periods) => {
            let first = wrap(phase - start.phase) / osc.beta();
            let states = whole_periods(*periods).zip(Strobes::new(osc, start, *phase));
            states.map(|(k, of)| [first + f64::from(k) * osc.period(), of.phase, of.x, of.v]).collect()
        }
        Section::Position(_, position, periods) => {
            let crossings = Level::new(osc, *position)?;
            let crossings = crossings.crossings(start, periods * osc.period());
            crossings.map(|of| [of.time, of.phase, *position, of.velocity]).collect()
        }
    })
}

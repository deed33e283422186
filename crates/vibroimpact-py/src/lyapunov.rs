//! The Lyapunov exponents of a motion, and the sections of its attractor.

use crate::columns::{column, named, sign};
use crate::door::{self, Watch};
use crate::error::Trouble;
use crate::motion::{Fields as Motion, HorizonFields};
use crate::oscillator::Oscillator;
use crate::simulate::{StartArgument, start_plan, text};
use numpy::PyArray1;
use pyo3::prelude::*;
use vibroimpact::chaos::{Grounds, Measured};
use vibroimpact_study::{LyapunovPlan, Plan, Results, Task};

/// Value and error.
type Quantity = (f64, f64);

const fn quantity(of: Measured) -> Quantity {
    (of.value, of.error)
}

/// The fields of `Lyapunov`.
#[derive(IntoPyObject)]
pub(crate) struct Fields<'py> {
    motion: Motion<'py>,
    exponents: [Quantity; 2],
    exponents_per_period: [Quantity; 2],
    sum: Quantity,
    identity: f64,
    impacts_per_period: Quantity,
    section_dimension: Option<Quantity>,
    flow_dimension: Option<Quantity>,
    grounds: GroundsFields,
    impacts: Impacts<'py>,
    strobes: (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>),
    plan: String,
}

/// Phases, speeds before impacts, and sides.
type Impacts<'py> = (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<i8>>);

#[derive(Default, IntoPyObject)]
struct GroundsFields {
    kind: &'static str,
    impacts: Option<u64>,
    transient: Option<u64>,
    time: Option<f64>,
    blocks: Option<u32>,
    horizon: Option<HorizonFields>,
    side: Option<&'static str>,
}

impl GroundsFields {
    fn new(grounds: &Grounds) -> Self {
        let bare = Self::default();
        match grounds {
            Grounds::Measured { impacts, transient, time, blocks } => Self {
                kind: "measured",
                impacts: Some(*impacts),
                transient: Some(*transient),
                time: Some(*time),
                blocks: Some(*blocks),
                ..bare
            },
            Grounds::Flight(why) => Self { kind: "no_impact", horizon: Some(HorizonFields::new(why)), ..bare },
            Grounds::Sticks(side) => Self { kind: "sticks", side: Some(named(*side)), ..bare },
            Grounds::Stuck(side) => Self { kind: "stuck", side: Some(named(*side)), ..bare },
            Grounds::Touches(why) => Self { kind: "touches", horizon: Some(HorizonFields::new(why)), ..bare },
            Grounds::Undecided { impacts } => Self { kind: "undecided", impacts: Some(*impacts), ..bare },
        }
    }
}

/// Measures the exponents of the motion from a start.
#[pyfunction]
pub(crate) fn lyapunov(
    py: Python<'_>,
    osc: Oscillator,
    start: StartArgument,
    impacts: u64,
    transient: u64,
    points: Option<u64>,
    progress: Option<Py<PyAny>>,
) -> Result<Fields<'_>, Trouble> {
    let task = LyapunovPlan { start: start_plan(start), impacts, transient, points, ..LyapunovPlan::default() };
    let total = transient + impacts + points.map_or(0, |points| transient + points);
    let plan = Plan::new(osc.plan, Task::Lyapunov(task));
    let (found, points) = door::result(py, Watch::one("measuring", total, progress), &plan, |of| {
        if let Results::Lyapunov(_, found, points) = of { Some((found, points.unwrap_or_default())) } else { None }
    })?;
    let osc = osc.osc;
    let (struck, states) = (|| points.impacts.iter(), || points.strobes.iter());
    Ok(Fields {
        motion: Motion::new(py, &found.motion, &osc),
        exponents: found.exponents.map(quantity),
        exponents_per_period: found.per_period().map(quantity),
        sum: quantity(found.sum),
        identity: found.identity,
        impacts_per_period: quantity(found.impacts_per_period),
        section_dimension: found.section_dimension.map(quantity),
        flow_dimension: found.flow_dimension().map(quantity),
        grounds: GroundsFields::new(&found.grounds),
        impacts: (
            column(py, struck().map(|at| at.phase)),
            column(py, struck().map(|at| at.velocity)),
            column(py, struck().map(|at| sign(at.side))),
        ),
        strobes: (column(py, states().map(|at| at.x)), column(py, states().map(|at| at.v))),
        plan: text(&plan)?,
    })
}

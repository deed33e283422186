//! The attractors of a system, and the share of starts that lead to each.

use crate::door::{self, Watch};
use crate::error::Trouble;
use crate::motion::Fields;
use crate::oscillator::Oscillator;
use crate::simulate::text;
use pyo3::prelude::*;
use vibroimpact::verdict::StartBox;
use vibroimpact_study::basin;
use vibroimpact_study::{Plan, Results, Task};

/// The fields of `Attractors`.
#[derive(IntoPyObject)]
pub(crate) struct Found<'py> {
    /// Each motion, its share, and the number of starts that lead to it.
    motions: Vec<(Fields<'py>, f64, u64)>,
    x: (f64, f64),
    v: (f64, f64),
    phase: (f64, f64),
    plan: String,
}

/// The interval of a share at a confidence of 95 %.
#[pyfunction]
pub(crate) fn share_interval(count: u64, total: u64) -> (f64, f64) {
    basin::share_interval(count, total)
}

/// The largest share that no start may have shown, at a confidence of 95 %.
#[pyfunction]
pub(crate) fn missed_share(total: u64) -> f64 {
    basin::missed_share(total)
}

/// Settles scattered starts and counts the distinct motions.
#[pyfunction]
pub(crate) fn attractors(
    py: Python<'_>,
    osc: Oscillator,
    starts: u64,
    seed: u64,
    impacts: Option<u32>,
    threads: usize,
    progress: Option<Py<PyAny>>,
) -> Result<Found<'_>, Trouble> {
    let plan = Plan::new(osc.plan, Task::Attractors { starts, seed, impacts });
    let osc = osc.osc;
    let area = StartBox::natural(&osc);
    let watch = Watch { what: "looking for attractors", total: starts, progress, threads };
    let census =
        door::result(py, watch, &plan, |of| if let Results::Attractors(census) = of { Some(census) } else { None })?;
    let motions = census
        .by_share()
        .into_iter()
        .map(|found| (Fields::new(py, &found.verdict, &osc), census.share(found), found.count))
        .collect();
    Ok(Found { motions, x: area.x, v: area.v, phase: area.phase, plan: text(&plan)? })
}

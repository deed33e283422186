//! The periodic orbits of a label, stable or not.

use crate::columns::named;
use crate::door::{self, Watch};
use crate::error::Trouble;
use crate::motion::Fields;
use crate::oscillator::Oscillator;
use pyo3::prelude::*;
use vibroimpact::verdict::Verdict;
use vibroimpact_study::{Plan, Results, Task};

/// After which impact, counted from 1, it meets which stop, and how long after.
type Earlier = (Option<usize>, &'static str, f64);

/// Each orbit, whether it is a possible motion, and where it meets a stop too early.
#[pyfunction]
pub(crate) fn orbits<'py>(
    py: Python<'py>,
    osc: Oscillator,
    label: &str,
) -> Result<Vec<(Fields<'py>, bool, Option<Earlier>)>, Trouble> {
    let plan = Plan::new(osc.plan, Task::Orbit { label: label.to_owned() });
    let osc = osc.osc;
    let watch = Watch::alone("looking for orbits");
    let found = door::result(py, watch, &plan, |of| if let Results::Orbit(found) = of { Some(found) } else { None })?;
    Ok(found
        .into_iter()
        .map(|orbit| {
            let earlier = orbit.earlier.map(|contact| {
                let impact = (!orbit.cycle.points.is_empty()).then_some(contact.flight + 1);
                (impact, named(contact.side), contact.time)
            });
            (Fields::new(py, &Verdict::Periodic(orbit.cycle), &osc), orbit.physical, earlier)
        })
        .collect())
}

//! The periodic orbits with a label, stable or not.

use crate::columns::named;
use crate::door::{self, Watch};
use crate::error::Trouble;
use crate::motion::Fields;
use crate::oscillator::Oscillator;
use pyo3::prelude::*;
use vibroimpact::verdict::Verdict;
use vibroimpact_study::{Plan, Results, Task};

/// The first contact of an inadmissible solution: the number (from 1) of the impact before it, the stop, and the time
/// since that impact.
type Earlier = (Option<usize>, &'static str, f64);

/// Each orbit, whether it is admissible, and if not, its first contact with a stop.
#[pyfunction]
pub(crate) fn orbits<'py>(
    py: Python<'py>,
    osc: Oscillator,
    label: &str,
    progress: Option<Py<PyAny>>,
) -> Result<Vec<(Fields<'py>, bool, Option<Earlier>)>, Trouble> {
    let plan = Plan::new(osc.plan, Task::Orbit { label: label.to_owned() });
    let osc = osc.osc;
    let watch = Watch::one("looking for orbits", 1, progress);
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

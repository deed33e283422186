//! A sweep: at each value the motion is settled from the state that the motion at the value before has.

use super::plan::ResponsePlan;
use super::row::{ResponseRow, all};
use crate::diagram::{carried_state, state_on};
use crate::map::options;
use crate::{Control, RunError, SystemPlan};
use vibroimpact::Start;
use vibroimpact::math::sort_by;
use vibroimpact::orbit::Cycle;
use vibroimpact::quantities::of_verdict;
use vibroimpact::verdict::{Verdict, settle_while};

/// The motion of a sweep at one value.
pub(super) struct SweptMotion {
    pub(super) row: ResponseRow,
    /// Its cycle, if it is periodic with impacts.
    pub(super) cycle: Option<Cycle>,
}

/// The motions of one sweep; fewer than there are values when stopped. `before` motions were done before.
pub(super) fn sweep(
    system: &SystemPlan,
    plan: &ResponsePlan,
    rising: bool,
    before: usize,
    control: &Control<'_>,
) -> Result<Vec<SweptMotion>, RunError> {
    let cut = plan.cut();
    let mut values: Vec<f64> = plan.over.all();
    sort_by(&mut values, f64::total_cmp);
    if !rising {
        values.reverse();
    }
    let mut motions = Vec::with_capacity(values.len());
    let mut last: Option<(SystemPlan, Start)> = None;
    for value in values {
        let there = cut.system(system, value)?;
        let osc = there.oscillator()?;
        let start = match last {
            Some((before, state)) => carried_state(state, &before, &there)?,
            None => Start::at_rest(&osc),
        };
        let Some(settled) = settle_while(&osc, start, &options(plan.impacts), &|| !control.stopping()) else { break };
        last = Some((there, state_on(&osc, &settled.verdict, start)));
        let row = ResponseRow {
            value,
            label: settled.verdict.label().into_owned(),
            admissible: true,
            stability: settled.verdict.stability(&osc),
            event: None,
            quantities: all(of_verdict(&osc, &settled.verdict)),
        };
        motions.push(SweptMotion {
            row,
            cycle: if let Verdict::Periodic(cycle) = settled.verdict { Some(cycle) } else { None },
        });
        (control.progress)((before + motions.len()) as u64);
    }
    Ok(motions)
}

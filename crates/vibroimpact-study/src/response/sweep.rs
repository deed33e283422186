//! A sweep: at each value the motion is settled from the state that the motion at the value before has.

use super::ResponsePlan;
use crate::diagram::{carried_state, state_on};
use crate::{Control, RunError, SystemPlan};
use vibroimpact::orbit::Cycle;
use vibroimpact::quantities::{Quantities, of_verdict};
use vibroimpact::verdict::{SettleOptions, Verdict, settle_while};
use vibroimpact::{Oscillator, Start};

/// The motion of a sweep at one value.
#[derive(Clone, Debug, PartialEq)]
pub struct SweptMotion {
    /// The value of the parameter.
    pub value: f64,
    /// The label of the motion.
    pub label: String,
    /// Its cycle, if it is periodic with impacts.
    pub cycle: Option<Cycle>,
    /// Its quantities; `None` for an undecided motion.
    pub quantities: Option<Quantities>,
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
    let mut values: Vec<f64> = plan.over.values().collect();
    values.sort_by(f64::total_cmp);
    if !rising {
        values.reverse();
    }
    let mut motions = Vec::with_capacity(values.len());
    let mut last: Option<(Oscillator, Start)> = None;
    for value in values {
        let osc = cut.oscillator(system, value)?;
        let start = last.map_or_else(|| Start::at_rest(&osc), |(before, state)| carried_state(state, &before, &osc));
        let options = SettleOptions::default();
        let Some(settled) = settle_while(&osc, start, &options, || !control.stopping()) else { break };
        last = Some((osc, state_on(&osc, &settled.verdict, start)));
        motions.push(SweptMotion {
            value,
            label: settled.verdict.label().into_owned(),
            quantities: of_verdict(&osc, &settled.verdict),
            cycle: if let Verdict::Periodic(cycle) = settled.verdict { Some(cycle) } else { None },
        });
        (control.progress)((before + motions.len()) as u64);
    }
    Ok(motions)
}

//! A sweep: at each value the motion is settled from the state that the motion at the value before has.

use super::ResponsePlan;
use crate::diagram::carried_state;
use crate::map::options;
use crate::{Control, RunError, SystemPlan};
use vibroimpact::motion::{Motion, Path};
use vibroimpact::orbit::Cycle;
use vibroimpact::quantities::{Quantities, of_verdict};
use vibroimpact::verdict::{NoImpact, Verdict, settle_while};
use vibroimpact::{Oscillator, Side, Start};

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
    let mut last: Option<(SystemPlan, Start)> = None;
    for value in values {
        let there = cut.system(system, value)?;
        let osc = there.oscillator()?;
        let start = match last {
            Some((before, state)) => carried_state(state, &before, &there)?,
            None => Start::at_rest(&osc),
        };
        let Some(settled) = settle_while(&osc, start, &options(plan.impacts), || !control.stopping()) else { break };
        last = Some((there, state_on(&osc, &settled.verdict, start)));
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

/// Impacts of an undecided motion after which it is carried to the next value.
const CARRIED: usize = 2_000;

/// A state of the settled motion.
fn state_on(osc: &Oscillator, verdict: &Verdict, start: Start) -> Start {
    let on = |side: Side, phase: f64| {
        let x = side.sign() * osc.stop(side).map_or(0.0, |stop| stop.gap);
        Start { x, v: 0.0, phase }
    };
    match verdict {
        Verdict::Periodic(cycle) => match (cycle.rests.last(), cycle.points.first()) {
            (Some(rest), _) => on(rest.side, rest.release),
            (None, Some(point)) => point.state.rebound(osc),
            (None, None) => start,
        },
        Verdict::Stuck(side) | Verdict::NoImpact(NoImpact::Landing { side, .. }) => on(*side, start.phase),
        Verdict::Chaotic(chaos) => chaos.spectrum.last.rebound(osc),
        // with damping all motions without impacts end in the same one; without, the last flight is the motion
        Verdict::NoImpact(_) if osc.damping() > 0.0 => Start::free_motion(osc).unwrap_or(start),
        Verdict::NoImpact(_) | Verdict::Undecided(_) => {
            let mut motion = Motion::new(osc, start);
            let followed = motion.by_ref().take(CARRIED).count();
            match motion.leg() {
                Some(leg) if followed < CARRIED || matches!(leg.path, Path::Flight(_)) => leg.start(osc, 0.0),
                _ => start,
            }
        }
    }
}

//! A quantity of the motion that a start settles into, and the state that it leaves.

use super::follow::{AfterTransient, DiagramPoint, MotionKind};
use crate::quantity::Quantity;
use vibroimpact::motion::{Motion, Path};
use vibroimpact::quantities::of_verdict_only;
use vibroimpact::verdict::{NoImpact, SettleOptions, Verdict, settle};
use vibroimpact::{Oscillator, Side, Start};

/// Settles the motion from a start. Its point is the value of the quantity, if it is finite.
pub(super) fn after_transients(osc: &Oscillator, start: Start, quantity: Quantity) -> AfterTransient {
    let verdict = settle(osc, start, &SettleOptions::default()).verdict;
    let kind = MotionKind::of(&verdict);
    let value = of_verdict_only(osc, &verdict, &[quantity]).map(|of| of.get(quantity));
    let points = value.filter(|value| value.is_finite()).map(DiagramPoint::Value);
    AfterTransient { kind, points: points.into_iter().collect(), last: state_on(osc, &verdict, start) }
}

/// Impacts of an undecided motion after which it is carried to the next value.
const CARRIED: usize = 2_000;

/// A state of the settled motion from a start, to be carried to the next value of a parameter.
pub(crate) fn state_on(osc: &Oscillator, verdict: &Verdict, start: Start) -> Start {
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
        Verdict::Chaotic(chaos) => chaos.tail.last.rebound(osc),
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

#[cfg(test)]
mod tests {
    use super::*;

    /// At the point S of the 1971 paper: the value is that of the verdict, and the motion left behind settles into the same.
    #[test]
    fn the_value_of_the_settled_motion_and_a_state_on_it() {
        let osc = Oscillator::from_inverse_beta(1.3, 0.75, 0.5).unwrap();
        let quantity = Quantity::ImpactSpeedMax;
        for v in [0.0, 1.0] {
            let start = Start { x: 0.0, v, phase: 0.0 };
            let Verdict::Periodic(cycle) = settle(&osc, start, &SettleOptions::default()).verdict else {
                panic!("{v}")
            };
            let found = after_transients(&osc, start, quantity);
            assert_eq!(found.kind, MotionKind::Impacts);
            let [DiagramPoint::Value(value)] = found.points[..] else { panic!("{:?}", found.points) };
            assert_eq!(value, cycle.fastest());
            let again = after_transients(&osc, found.last, quantity);
            let [DiagramPoint::Value(next)] = again.points[..] else { panic!("{:?}", again.points) };
            assert!((next - value).abs() < 1e-9);
        }
    }

    /// Without impacts the mean speed of impacts is not defined, and the largest speed is 0.
    #[test]
    fn a_quantity_that_is_not_defined_is_no_point() {
        let far = Oscillator::new(0.5, 40.0, 0.5).unwrap();
        let of = |quantity| after_transients(&far, Start::at_rest(&far), quantity);
        assert_eq!(
            (of(Quantity::ImpactSpeedMean).points.len(), of(Quantity::ImpactSpeedMean).kind),
            (0, MotionKind::NoImpact)
        );
        let quantity = Quantity::ImpactSpeedMax;
        assert_eq!(of(quantity).points, [DiagramPoint::Value(0.0)]);
    }
}

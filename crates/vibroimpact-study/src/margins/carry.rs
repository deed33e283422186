//! A periodic motion carried from one system to a system nearby.

use vibroimpact::orbit::{Cycle, CyclePoint, from_release, refine};
use vibroimpact::system::phase;
use vibroimpact::{Oscillator, Side};

/// Why a motion was not found at a system nearby.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Loss {
    /// There is no such system: the two stops leave no room.
    NoSystem,
    /// No solution with the same impacts was found close by.
    NoSolution,
    /// The solution passes through a stop on its way, or an impact has no speed.
    Inadmissible,
    /// A multiplier lies on or outside the unit circle.
    Unstable,
    /// The motion repeats after a part of its period, so it has another label.
    Shorter,
    /// After the release another motion follows.
    OtherMotion,
}

impl Loss {
    /// Its name in JSON and tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::NoSystem => "no system",
            Self::NoSolution => "no solution",
            Self::Inadmissible => "inadmissible",
            Self::Unstable => "unstable",
            Self::Shorter => "shorter period",
            Self::OtherMotion => "other motion",
        }
    }
}

/// Two cycles with a larger difference in a phase (radians) or in a speed (relative) are not taken for neighbours.
const NEAR: f64 = 0.1;
/// A motion from a release is followed for this multiple of the events of the motion nearby, and for [`FEWEST`] more.
const LONGER: u32 = 4;
const FEWEST: u32 = 50;
/// If a cycle differs from itself after a part of its period by less than this, it repeats.
const REPEATS: f64 = 1e-5;

/// The motion `before` of a system nearby, as a stable motion of `osc` with the same label that strikes the same stops in
/// the same order.
///
/// A motion that sticks is determined by its release: it has the same label and sticks on the same stops in the same
/// order. Any other motion solves the equations of its impacts by Newton's method; the solution counts if it is close
/// to `before`, admissible and stable.
pub(super) fn carry(osc: &Oscillator, before: &Cycle) -> Result<Cycle, Loss> {
    if let Some(rest) = before.rests.last() {
        let usual = u32::try_from(before.points.len() + before.rests.len()).unwrap_or(u32::MAX);
        let events = usual.saturating_mul(LONGER).saturating_add(FEWEST);
        let after = from_release(osc, rest.side, events).ok_or(Loss::OtherMotion)?;
        return if rests_alike(before, &after) { Ok(after) } else { Err(Loss::OtherMotion) };
    }
    let orbit = refine(osc, before).ok_or(Loss::NoSolution)?;
    let after = orbit.cycle;
    if !before.points.is_empty() && !after.same_as(before, NEAR) {
        return Err(Loss::NoSolution);
    }
    if !orbit.physical {
        return Err(Loss::Inadmissible);
    }
    if !after.stable() {
        return Err(Loss::Unstable);
    }
    if repeats(&after) { Err(Loss::Shorter) } else { Ok(after) }
}

/// Whether two motions that stick have the same label, stick on the same stops in the same order, and strike the same
/// stops. The number of impacts listed before a complete chatter ends is not compared: it depends on rounding.
fn rests_alike(before: &Cycle, after: &Cycle) -> bool {
    let rests = |cycle: &Cycle| cycle.rests.iter().map(|rest| (rest.side, rest.chatter)).collect::<Vec<_>>();
    let strikes = |cycle: &Cycle, side: Side| cycle.points.iter().any(|point| point.state.side == side);
    let sides = [Side::Upper, Side::Lower];
    before.label == after.label
        && rests(before) == rests(after)
        && sides.iter().all(|side| strikes(before, *side) == strikes(after, *side))
}

/// Whether a cycle is a shorter one that is run through several times.
fn repeats(cycle: &Cycle) -> bool {
    let (m, n) = (cycle.points.len(), cycle.label.periods as usize);
    let whole = |parts: &usize| m.is_multiple_of(*parts) && n.is_multiple_of(*parts);
    (2..=m.min(n)).filter(whole).any(|parts| {
        let shift = m / parts;
        (0..m).all(|k| close(&cycle.points[k], &cycle.points[(k + shift) % m]))
    })
}

fn close(a: &CyclePoint, b: &CyclePoint) -> bool {
    let speed = a.state.velocity.max(b.state.velocity).max(f64::MIN_POSITIVE);
    a.state.side == b.state.side
        && phase::difference(a.state.phase, b.state.phase).abs() <= REPEATS
        && (a.state.velocity - b.state.velocity).abs() <= REPEATS * speed
}

#[cfg(test)]
mod tests {
    use super::*;
    use vibroimpact::Start;
    use vibroimpact::verdict::{SettleOptions, Verdict, settle};

    fn settled(osc: &Oscillator) -> Cycle {
        match settle(osc, Start::at_rest(osc), &SettleOptions::default()).verdict {
            Verdict::Periodic(cycle) => cycle,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn to_a_neighbour_and_not_beyond_an_event() {
        let at = |gap: f64| Oscillator::from_inverse_beta(1.11, gap, 0.5).unwrap();
        let cycle = settled(&at(1.8));
        assert_eq!(cycle.label.to_string(), "1/1");
        let there = carry(&at(1.82), &cycle).unwrap();
        assert!(there.same_as(&settled(&at(1.82)), 1e-9));
        // the flip lies at 1.829
        assert_eq!(carry(&at(1.84), &cycle), Err(Loss::Unstable));
        // 2/2 ends at the flip from the other side; beyond, Newton's method finds 1/1 twice
        let twice = settled(&at(1.832));
        assert_eq!(twice.label.to_string(), "2/2");
        assert_eq!(carry(&at(1.82), &twice).unwrap_err(), Loss::Shorter);
    }

    #[test]
    fn a_motion_that_sticks() {
        let at = |gap: f64| Oscillator::from_inverse_beta(1.11, gap, 0.5).unwrap();
        let cycle = settled(&at(-0.5));
        assert_eq!(carry(&at(-0.45), &cycle).unwrap().label.to_string(), "inf/1");
        assert_eq!(carry(&at(0.5), &cycle), Err(Loss::OtherMotion));
    }
}

//! The impacts of a motion on each of two stops.

use vibroimpact::orbit::Cycle;
use vibroimpact::verdict::{NoImpact, Verdict};
use vibroimpact::{Oscillator, Side};

/// Number of impacts of a motion on each stop in one period of the motion. A number is `None` if a complete chatter on
/// that stop makes it infinite.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct ImpactsByStop {
    /// On the first stop.
    pub upper: Option<u32>,
    /// On the second stop.
    pub lower: Option<u32>,
}

impl ImpactsByStop {
    /// The numbers of a motion; `None` if there is no second stop, or if the motion does not repeat.
    #[must_use]
    pub fn of(osc: &Oscillator, verdict: &Verdict) -> Option<Self> {
        osc.stop(Side::Lower).and_then(|_| Self::of_motion(verdict))
    }

    /// The same, of one stop too.
    #[must_use]
    pub fn of_motion(verdict: &Verdict) -> Option<Self> {
        match verdict {
            Verdict::Periodic(cycle) => Some(Self::of_cycle(cycle)),
            Verdict::NoImpact(NoImpact::ForPeriods(_)) | Verdict::Chaotic(_) | Verdict::Undecided(_) => None,
            Verdict::NoImpact(_) | Verdict::Stuck(_) => Some(Self { upper: Some(0), lower: Some(0) }),
        }
    }

    /// The numbers of a cycle.
    #[must_use]
    pub fn of_cycle(cycle: &Cycle) -> Self {
        let on = |side: Side| {
            let endless = cycle.rests.iter().any(|rest| rest.chatter && rest.side == side);
            let count = cycle.points.iter().filter(|point| point.state.side == side).count();
            (!endless).then(|| u32::try_from(count).unwrap_or(u32::MAX))
        };
        Self { upper: on(Side::Upper), lower: on(Side::Lower) }
    }
}

impl core::fmt::Display for ImpactsByStop {
    /// `2 upper, 1 lower`; `inf` for an infinite number.
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let text = |count: Option<u32>| count.map_or_else(|| "inf".to_owned(), |count| count.to_string());
        write!(f, "{} upper, {} lower", text(self.upper), text(self.lower))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use vibroimpact::Start;
    use vibroimpact::verdict::{SettleOptions, settle};

    #[test]
    fn of_motions_between_two_stops() {
        let settled = |osc: &Oscillator, x: f64| {
            settle(osc, Start { x, ..Start::at_rest(osc) }, &SettleOptions::default()).verdict
        };
        // the upper stop is close and the lower one far: each motion counts its own impacts
        for (gap, second) in [(0.2, 1.5), (0.5, 1.0), (1.0, 1.0), (-0.5, 3.0)] {
            let osc = Oscillator::new(0.8, gap, 0.6).unwrap().with_damping(0.02).unwrap();
            let both = osc.with_second_stop(second, 0.6).unwrap();
            let verdict = settled(&both, gap.min(0.0));
            assert_eq!(ImpactsByStop::of(&osc, &verdict), None, "one stop has no other");
            let (Verdict::Periodic(cycle), Some(found)) = (&verdict, ImpactsByStop::of(&both, &verdict)) else {
                continue;
            };
            let upper = cycle.points.iter().filter(|point| point.state.side == Side::Upper).count();
            match (found.upper, found.lower) {
                (Some(up), Some(low)) => {
                    assert_eq!((up as usize, (up + low) as usize), (upper, cycle.points.len()));
                    assert_eq!(found.to_string(), format!("{up} upper, {low} lower"));
                }
                _ => assert!(cycle.rests.iter().any(|rest| rest.chatter)),
            }
        }
        // equal stops: a symmetric motion strikes both equally often
        let equal = Oscillator::new(0.8, 1.0, 0.6).unwrap().with_second_stop(1.0, 0.6).unwrap();
        let verdict = settled(&equal, 0.0);
        let found = ImpactsByStop::of(&equal, &verdict).unwrap();
        assert!(found.upper.is_some() && found.upper == found.lower, "{} {found}", verdict.label());
        let chatter = Oscillator::from_inverse_beta(1.11, -0.5, 0.5).unwrap().with_second_stop(9.0, 0.5).unwrap();
        assert_eq!(ImpactsByStop::of(&chatter, &settled(&chatter, -0.5)).unwrap().to_string(), "inf upper, 0 lower");
    }
}

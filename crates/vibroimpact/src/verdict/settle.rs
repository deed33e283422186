//! From a start to a verdict.
//!
//! The motion is followed event by event until one of these is shown:
//!
//! - **no impact**: the flight never touches again ([`Horizon`](crate::flight::Horizon)), or the impacts follow the law
//!   of the [graze limit](super::graze_limit), or none comes within the search limits (which are stated);
//! - **periodic**: the last impacts resemble those m impacts before ([`recurrence`](super)), Newton's method on the m-fold impact
//!   map with its exact derivative finds a cycle there, its multipliers lie inside the unit circle, and the motion is
//!   *captured*: it is close and its next turn obeys the cycle's linear law to a fraction of the contraction. A
//!   transient that merely passes a cycle fails the last point and is followed on. Newton's flights end at first contact, so the
//!   cycle is physical by construction;
//! - **periodic with a stick**: what follows a release is one motion, so a release that leads back to itself is a proof
//!   by itself ([`from_release`]); the multipliers are 0;
//! - **chaotic**: the largest Lyapunov exponent exceeds its error bar of three standard errors;
//! - **stuck**: the force will never lift the mass again;
//! - **undecided**: none of these within the budget; what was tried is in the verdict.

use super::outcome::{NoImpact, Undecided, Verdict};
use super::{graze_limit, recurrence};
use crate::chaos::{Spectrum, lyapunov};
use crate::flight::SearchLimits;
use crate::motion::{End, EventKind, ImpactState, MAX_TOUCHES, Motion};
use crate::orbit::{Cycle, DEFAULT_EVENTS, from_release, shoot};
use crate::system::{Oscillator, Side, Start};

/// How far to follow a motion and how close is close.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SettleOptions {
    /// Impacts to follow before giving up.
    pub max_impacts: u32,
    /// Impacts after which a motion without a cycle is measured for chaos.
    pub chaos_after: u32,
    /// Impacts over which the Lyapunov exponents are measured.
    pub chaos_over: u32,
    /// The longest period looked for, in impacts.
    pub longest: u32,
    /// How close the last impacts must come to earlier ones, in phase and relative velocity, to try Newton's method.
    pub recurrence: f64,
    /// How far each flight is searched.
    pub limits: SearchLimits,
    /// Search steps over all flights followed before giving up: what bounds the time where every flight is long.
    pub max_steps: u64,
}

impl Default for SettleOptions {
    /// 20 000 impacts or two million search steps (a tenth of a second, where flights are plain), chaos measured over 4000 impacts after 1000,
    /// periods up to 128 impacts.
    fn default() -> Self {
        Self {
            max_impacts: 20_000,
            chaos_after: 1_000,
            chaos_over: 4_000,
            longest: 128,
            recurrence: 1e-2,
            limits: SearchLimits::default(),
            max_steps: 2_000_000,
        }
    }
}

/// A verdict and how it was reached.
#[derive(Clone, Debug, PartialEq)]
pub struct Settled {
    /// What the motion settles into.
    pub verdict: Verdict,
    /// Impacts followed until it was clear.
    pub impacts: u64,
    /// Time followed until it was clear.
    pub time: f64,
}

/// What the motion of `osc` from `start` settles into.
///
/// ```
/// use vibroimpact::{Oscillator, Start, verdict::{SettleOptions, settle}};
/// // N of the 1971 paper: four unequal impacts in each forcing period
/// let osc = Oscillator::from_inverse_beta(1.8, 0.25, 0.5)?;
/// let settled = settle(&osc, Start::at_rest(&osc), &SettleOptions::default());
/// assert_eq!(settled.verdict.label(), "4/1");
/// # Ok::<(), vibroimpact::SystemError>(())
/// ```
#[must_use]
pub fn settle(osc: &Oscillator, start: Start, options: &SettleOptions) -> Settled {
    let mut follow = Follow {
        osc,
        options,
        impacts: Vec::with_capacity(64),
        released: [false; 2],
        last_impact: 0.0,
        candidate: None,
        grazes: 0,
        next_look: LOOK,
    };
    let mut motion = Motion::with_limits(osc, start, options.limits);
    let (mut time, mut spectrum) = (0.0, None);
    let done = |verdict, follow: &Follow<'_>, time| Settled { verdict, impacts: follow.impacts.len() as u64, time };
    // every event but an impact is followed by one or ends the motion, except runs of grazes, which are cut short
    while follow.impacts.len() < options.max_impacts as usize && motion.steps() < options.max_steps {
        let Some(event) = motion.next() else {
            let verdict = ended(osc, motion.end(), options.limits);
            return done(verdict, &follow, time);
        };
        time = event.time;
        let shown = match event.kind {
            EventKind::Impact { velocity_before, .. } => {
                let state = ImpactState { phase: event.phase, velocity: velocity_before, side: event.side };
                follow.impact(state, time)
            }
            EventKind::Graze { .. } => follow.graze(event.phase),
            EventKind::Stick { .. } => None,
            EventKind::Release => follow.release(event.side),
        };
        if let Some(verdict) = shown {
            return done(verdict, &follow, time);
        }
        let count = follow.impacts.len();
        if count >= options.chaos_after as usize && spectrum.is_none() && matches!(event.kind, EventKind::Impact { .. })
        {
            spectrum = Some(lyapunov(osc, follow.impacts[count - 1].0, options.chaos_over));
            if let Some(Some(found)) = &spectrum
                && chaotic(found)
            {
                return done(Verdict::Chaotic(*found), &follow, time);
            }
        }
    }
    // a last look, where the transient is as far gone as it will be
    let last = follow.impacts.last().and_then(|(state, _)| lyapunov(osc, *state, options.chaos_over));
    let verdict = match last.or(spectrum.flatten()) {
        Some(found) if chaotic(&found) => Verdict::Chaotic(found),
        spectrum => Verdict::Undecided(Undecided::Impacts { impacts: follow.impacts.len() as u64, spectrum }),
    };
    done(verdict, &follow, time)
}

fn chaotic(spectrum: &Spectrum) -> bool {
    spectrum.exponents[0].value > spectrum.exponents[0].error
}

fn ended(osc: &Oscillator, end: Option<End>, limits: SearchLimits) -> Verdict {
    match end {
        Some(End::Never(why)) => Verdict::NoImpact(NoImpact::Flight(why)),
        Some(End::Stuck(side)) => Verdict::Stuck(side),
        Some(End::NoneFor(time)) => {
            let periods = time / osc.period();
            if time >= 0.999 * limits.horizon(osc) {
                Verdict::NoImpact(NoImpact::ForPeriods(periods.floor()))
            } else {
                Verdict::Undecided(Undecided::Search { periods })
            }
        }
        None => Verdict::Undecided(Undecided::Search { periods: 0.0 }),
    }
}

struct Follow<'a> {
    osc: &'a Oscillator,
    options: &'a SettleOptions,
    /// Each impact and the time since the one before.
    impacts: Vec<(ImpactState, f64)>,
    /// The stops whose release was followed and did not come back.
    released: [bool; 2],
    last_impact: f64,
    candidate: Option<Cycle>,
    grazes: u32,
    next_look: usize,
}

/// Impacts between looks for a recurrence, while there are few; later an eighth of those there are, so that the looks
/// into a long chaotic motion stay cheap.
const LOOK: usize = 16;
/// Candidates for the period tried at each look.
const TRIES: usize = 3;

impl Follow<'_> {
    fn impact(&mut self, state: ImpactState, time: f64) -> Option<Verdict> {
        self.impacts.push((state, time - self.last_impact));
        self.last_impact = time;
        self.grazes = 0;
        if graze_limit::recognised(self.osc, &self.impacts) {
            return Some(Verdict::NoImpact(NoImpact::GrazeLimit { velocity: state.velocity, phase: state.phase }));
        }
        let count = self.impacts.len();
        if count < self.next_look {
            return None;
        }
        self.next_look = count + LOOK.max(count / 8);
        if let Some(cycle) = &self.candidate
            && recurrence::captured(self.osc, &state, cycle)
        {
            return self.candidate.take().map(Verdict::Periodic);
        }
        let found: Vec<(usize, u32)> =
            recurrence::candidates(self.osc, &self.impacts, self.options.longest as usize, self.options.recurrence)
                .take(TRIES)
                .collect();
        for (m, n) in found {
            let Ok(cycle) = shoot(self.osc, state, u32::try_from(m).unwrap_or(u32::MAX), n) else {
                continue;
            };
            if recurrence::captured(self.osc, &state, &cycle) {
                return Some(Verdict::Periodic(cycle));
            }
            if cycle.stable() {
                self.candidate = Some(cycle);
                break;
            }
        }
        None
    }

    fn graze(&mut self, phase: f64) -> Option<Verdict> {
        self.grazes += 1;
        (self.grazes > MAX_TOUCHES).then_some(Verdict::NoImpact(NoImpact::Grazing { phase }))
    }

    /// A release decides all that follows: if it leads back to itself, that is the cycle.
    fn release(&mut self, side: Side) -> Option<Verdict> {
        if core::mem::replace(&mut self.released[usize::from(side == Side::Lower)], true) {
            return None;
        }
        from_release(self.osc, side, DEFAULT_EVENTS).map(Verdict::Periodic)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario;
    use crate::verdict::{Count, Label};

    #[test]
    fn the_papers_points_from_rest() {
        for point in scenario::PAPER {
            let osc = point.oscillator();
            let settled = settle(&osc, Start::at_rest(&osc), &SettleOptions::default());
            assert!(point.motions.contains(&&*settled.verdict.label()), "{}: {:?}", point.name, settled.verdict);
        }
    }

    #[test]
    fn four_over_one_at_n_to_the_last_digits() {
        let osc = scenario::N.oscillator();
        let settled = settle(&osc, Start::at_rest(&osc), &SettleOptions::default());
        let Verdict::Periodic(cycle) = settled.verdict else { panic!() };
        let expected = [
            (0.185_568_221_573_524_7, 1.513_140_069_144_015_8),
            (1.440_306_040_352_512_3, 1.099_197_434_354_180_2),
            (2.158_838_329_628_230_4, 0.513_913_325_133_134_5),
            (2.736_447_333_268_362_8, 0.179_240_599_381_170_8),
        ];
        for (point, (theta, u)) in cycle.points.iter().zip(expected) {
            assert!((point.state.phase - theta).abs() < 1e-12 && (point.state.velocity - u).abs() < 1e-12, "{point:?}");
        }
        assert!(cycle.residual < 1e-13);
    }

    #[test]
    fn chatter_cycles_are_superstable() {
        let osc = Oscillator::from_inverse_beta(1.11, -0.5, 0.5).unwrap();
        let settled = settle(&osc, Start::at_rest(&osc), &SettleOptions::default());
        let Verdict::Periodic(cycle) = settled.verdict else { panic!("{:?}", settled.verdict) };
        assert_eq!(cycle.label.impacts, Count::Infinite);
        assert!(cycle.rests.len() == 1 && cycle.stable());
    }

    #[test]
    fn ever_gentler_impacts_are_no_impact_in_the_limit() {
        // Q of the paper: 1/beta = 0.7, so the touches come every ten forcing periods
        let osc = scenario::Q.oscillator();
        let mut limits = 0;
        for k in 0..60 {
            let start = Start { x: 1.5 - 0.05 * f64::from(k), v: 0.3 + 0.02 * f64::from(k), phase: 0.0 };
            match settle(&osc, start, &SettleOptions::default()).verdict {
                Verdict::NoImpact(NoImpact::GrazeLimit { .. }) => limits += 1,
                Verdict::NoImpact(_) => {}
                Verdict::Periodic(cycle) => assert_eq!(cycle.label, Label::new(1, 1)),
                other => panic!("{start:?}: {other:?}"),
            }
        }
        assert!(limits > 5, "{limits}");
    }

    /// At rest on the stop under a pull away, beta = 2: back for a touch after every natural period, for ever. The impact
    /// map once waited for an impact that never came.
    #[test]
    fn touches_without_impacts_end() {
        let osc = Oscillator::new(2.0, 3.0, 0.5).unwrap();
        let start = Start { x: 3.0, v: 0.0, phase: 2.0 };
        let settled = settle(&osc, start, &SettleOptions::default());
        assert!(matches!(settled.verdict, Verdict::NoImpact(NoImpact::Grazing { .. })), "{:?}", settled.verdict);
        let state = ImpactState { phase: 2.0, velocity: 0.0, side: Side::Upper };
        let mapped = crate::motion::impact_map(&osc, &state, SearchLimits::default());
        assert!(matches!(mapped, crate::motion::Mapped::End(_)), "{mapped:?}");
    }
}

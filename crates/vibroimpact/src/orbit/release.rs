//! Cycles that stick, from the release that determines them.
//!
//! For $`|\delta| < 1`$ the mass leaves a stop at rest, at the phase $`\pi - \arcsin\delta`$. This is one state,
//! whatever the motion was before, so the motion after a release is unique. If it sticks to that stop again, it is
//! periodic from then on. No iteration is needed. Both multipliers are 0, because a neighbouring motion that sticks has
//! the same release.

use super::cycle::{Cycle, CyclePoint, RestSpan};
use super::label::{Count, Label};
use super::release_errors::rounding_decides;
use crate::contact::sticking::release_phase;
use crate::lanes::PropagatorCache;
use crate::math::Multiplier;
use crate::motion::{EventKind, ImpactState, Motion};
use crate::system::{Oscillator, Side};

/// The largest number of events within which a motion must return to its release. A chatter at restitution 1/2 has
/// about fifteen impacts.
pub const DEFAULT_EVENTS: u32 = 4_000;

/// An impact after a release.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Strike {
    /// Time of flight since the impact before, or since the release.
    pub(crate) flown: f64,
    pub(crate) state: ImpactState,
}

/// An interval of sticking that ends with a release.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rest {
    pub(crate) span: RestSpan,
    /// Time from the last impact to the beginning of sticking.
    pub(crate) settled: f64,
    /// Time for which the mass sticks.
    pub(crate) held: f64,
}

/// The motion from a release to the next release.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Stretch {
    /// The stop of the release.
    pub(crate) from: Side,
    pub(crate) strikes: Vec<Strike>,
    /// The interval of sticking at its end; `None` if the mass does not stick.
    pub(crate) rest: Option<Rest>,
}

/// The motion from a release to the next release from the same stop, as far as it was followed.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Excursion {
    pub(crate) stretches: Vec<Stretch>,
    /// The number of forcing periods; `None` if the motion does not return to the release.
    pub(crate) periods: Option<u32>,
}

impl Excursion {
    /// The motion after the release from the stop on `side`, for at most this number of events and forcing periods;
    /// `None` if the stop never releases the mass.
    pub(crate) fn new(osc: &Oscillator, side: Side, events: u32, periods: f64) -> Option<Self> {
        release_phase(osc, side)?;
        let after = |from| Stretch { from, strikes: Vec::new(), rest: None };
        let mut excursion = Self { stretches: vec![after(side)], periods: None };
        let (mut motion, cache) = (Motion::released(osc, side), PropagatorCache::new());
        let mut flown = 0.0;
        for _ in 0..events {
            let Some(event) = motion.advance(Some(&cache)).filter(|event| event.time <= periods * osc.period()) else {
                break;
            };
            // sums of times of flight, because differences of the total time would lose the short flights of a chatter
            flown += motion.leg().map_or(0.0, |leg| leg.duration);
            let here = excursion.stretches.last_mut()?;
            match event.kind {
                EventKind::Impact { velocity_before, .. } => {
                    let state = ImpactState { phase: event.phase, velocity: velocity_before, side: event.side };
                    here.strikes.push(Strike { flown, state });
                }
                EventKind::Stick { chatter, .. } => {
                    let span = RestSpan { side: event.side, chatter, begin: event.phase, release: f64::NAN };
                    here.rest = Some(Rest { span, settled: flown, held: f64::NAN });
                }
                EventKind::Release => {
                    let rest = here.rest.as_mut()?;
                    (rest.span.release, rest.held) = (event.phase, flown);
                    // the same release as at the beginning, so all repeats from here on
                    if event.side == side {
                        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a count, saturating
                        let count = (event.time / osc.period()).round() as u32;
                        excursion.periods = (count > 0).then_some(count);
                        break;
                    }
                    excursion.stretches.push(after(event.side));
                }
                // the flight goes on: its time counts up to the impact
                EventKind::Graze { .. } => continue,
            }
            flown = 0.0;
        }
        Some(excursion)
    }

    /// The intervals of sticking in order.
    pub(crate) fn rests(&self) -> impl Iterator<Item = &Rest> {
        self.stretches.iter().filter_map(|stretch| stretch.rest.as_ref())
    }

    /// The number of impacts before stretch `k`.
    pub(crate) fn before(&self, k: usize) -> usize {
        self.stretches.iter().take(k).map(|stretch| stretch.strikes.len()).sum()
    }

    /// The motion as a cycle; `None` if it does not return to the release.
    pub(crate) fn cycle(&self) -> Option<Cycle> {
        let periods = self.periods?;
        let mut points = Vec::new();
        for stretch in &self.stretches {
            // an impact has the interval after it, and a strike the flight before it
            let next = stretch.strikes.iter().skip(1).map(|strike| strike.flown);
            let intervals = next.chain(stretch.rest.map(|rest| rest.settled));
            points.extend(
                stretch
                    .strikes
                    .iter()
                    .zip(intervals)
                    .map(|(strike, interval)| CyclePoint { state: strike.state, interval }),
            );
        }
        let rests: Vec<RestSpan> = self.rests().map(|rest| rest.span).collect();
        let impacts = if rests.iter().any(|rest| rest.chatter) {
            Count::Infinite
        } else {
            Count::Finite(u32::try_from(points.len()).unwrap_or(u32::MAX))
        };
        let multipliers = [Multiplier::default(); 2];
        Some(Cycle { label: Label { impacts, periods }, points, rests, multipliers, residual: 0.0 })
    }
}

/// The cycle that consists of the motion after the release from the stop on `side`, if it returns to this release
/// within `events` events; `None` otherwise, if the stop never releases the mass, or if rounding errors decide after how many
/// periods it returns.
///
/// ```
/// use vibroimpact::{Oscillator, Side, orbit};
/// let osc = Oscillator::from_inverse_beta(1.11, -0.5, 0.5)?;
/// let cycle = orbit::from_release(&osc, Side::Upper, orbit::DEFAULT_EVENTS).unwrap();
/// assert_eq!(cycle.label.to_string(), "inf/1");
/// assert!((cycle.rests[0].release - (std::f64::consts::PI + 0.5_f64.asin())).abs() < 1e-15);
/// # Ok::<(), vibroimpact::SystemError>(())
/// ```
#[must_use]
pub fn from_release(osc: &Oscillator, side: Side, events: u32) -> Option<Cycle> {
    match AfterRelease::new(osc, side, events)? {
        AfterRelease::Cycle(cycle) => Some(cycle),
        AfterRelease::Unconfirmed => None,
    }
}

/// The motion after a release that returns to this release.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum AfterRelease {
    /// The cycle.
    Cycle(Cycle),
    /// Rounding errors decide its period.
    Unconfirmed,
}

impl AfterRelease {
    /// After the release from the stop on `side`; `None` if it does not return within `events` events.
    pub(crate) fn new(osc: &Oscillator, side: Side, events: u32) -> Option<Self> {
        let excursion = Excursion::new(osc, side, events, f64::INFINITY)?;
        let cycle = excursion.cycle()?;
        Some(if rounding_decides(osc, &excursion) { Self::Unconfirmed } else { Self::Cycle(cycle) })
    }
}

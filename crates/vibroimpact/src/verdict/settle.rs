//! The verdict on the motion from a start.
//!
//! The motion is followed event by event until one of these is shown:
//!
//! - **no impact**: the flight never reaches a stop again ([`Horizon`](crate::flight::Horizon)), or the impacts satisfy
//!   the conditions of the [graze limit](super::graze_limit), or there is none within the search limits (which are
//!   stated);
//! - **periodic**: the last impacts resemble those m impacts before ([`recurrence`](super)), Newton's method on the
//!   m-fold impact map with its exact derivative finds a cycle there, its multipliers lie inside the unit circle, and
//!   the motion is *captured*: it is close, and its next period follows the linear law of the cycle to a fraction of
//!   the contraction. A transient that only passes near a cycle is not captured, and it is followed further. The
//!   flights in Newton's method end at their first contact, so the cycle is admissible;
//! - **periodic with sticking**: every motion is the same after a release, so a release that leads back to itself shows
//!   the cycle ([`from_release`](crate::orbit::from_release)); the multipliers are 0. Where rounding errors decide after how many
//!   periods it leads back, the motion is undecided;
//! - **chaotic**: the largest Lyapunov exponent, measured along the motion as it is followed, exceeds its error bar of
//!   three standard errors; neighbours have separated by more than is possible on the way from an unstable cycle to a
//!   stable one ([`Spectrum::chaotic`](crate::chaos::Spectrum::chaotic)); and none of the above was shown during the
//!   measurement. Chaos that ends within the budget is reported in [`Settled::transient`] beside the motion that
//!   follows. For other chaos the verdict states over how many impacts it was seen;
//! - **stuck**: the force never pulls the mass off the stop;
//! - **undecided**: none of these within the budget; the verdict states what was tried.

use super::follow::{Follow, Releases, ended};
use super::options::SettleOptions;
use super::outcome::{Settled, Verdict};
use super::record::Record;
use super::recurring::{Recurring, SystemOf};
use crate::lanes::PropagatorCache;
use crate::lyapunov::Arrivals;
use crate::motion::{EventKind, ImpactState, Motion};
use crate::system::{Oscillator, Start};

/// The verdict on the motion of `osc` from `start`.
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
    settle_knowing(osc, start, options, &mut Releases::default()).0
}

/// The same as [`settle`], but stopped when `go_on` returns false, and then `None`. `go_on` is called at every impact.
#[must_use]
pub fn settle_while(
    osc: &Oscillator,
    start: Start,
    options: &SettleOptions,
    go_on: &dyn Fn() -> bool,
) -> Option<Settled> {
    drive(osc, start, options, &mut Releases::default(), go_on).map(|(settled, _)| settled)
}

/// The same, with the verdicts on releases that other motions of the oscillator have given. Returns also the impacts of
/// the tail of a chaotic motion.
pub(super) fn settle_knowing(
    osc: &Oscillator,
    start: Start,
    options: &SettleOptions,
    releases: &mut Releases,
) -> (Settled, Arrivals) {
    // only a verdict stops it
    drive(osc, start, options, releases, &|| true).unwrap_or_else(|| {
        let verdict = ended(osc, None, options.limits, 0);
        (Settled { verdict, impacts: 0, time: 0.0, transient: None }, Arrivals::new())
    })
}

/// Follows the motion from `start` to a verdict; `None` if `go_on` returned false.
fn drive(
    osc: &Oscillator,
    start: Start,
    options: &SettleOptions,
    releases: &mut Releases,
    go_on: &dyn Fn() -> bool,
) -> Option<(Settled, Arrivals)> {
    let mut follow = Follow::keeping_tail();
    let cache = PropagatorCache::new();
    let motion = &mut Motion::with_limits(osc, start, options.limits);
    let mut drive =
        Drive { osc, follow: &mut follow, releases, motion, cache: Some(&cache), time: 0.0, returned: false };
    let verdict = drive.verdict(options, &|_| !go_on())?;
    let time = drive.time;
    let arrivals = follow.arrivals(&verdict, options);
    Some((follow.record.settled(osc, verdict, time), arrivals))
}

/// A motion that is followed to its verdict: of the oscillator from impact to impact, of a machine from event to event.
pub(super) trait Followed {
    /// What its record needs to know.
    type Of: Recurring;

    /// The system, and the record of the motion.
    fn record(&mut self) -> (&Self::Of, &mut Record<Self::Of>);
    /// Follows the motion by an event; returns the verdict if it is decided.
    fn step(&mut self, options: &SettleOptions) -> Option<Verdict<SystemOf<Self::Of>>>;
    /// Whether the last event was a return, from which the motion can be followed in another way.
    fn returned(&self) -> bool;

    /// Follows the motion to a verdict, or to the first return after which `leave` returns true of it.
    fn verdict(
        &mut self,
        options: &SettleOptions,
        leave: &dyn Fn(&Self) -> bool,
    ) -> Option<Verdict<SystemOf<Self::Of>>> {
        // the budget is checked before each event, so that no loop is without a cap
        while self.record().1.within(options) {
            let verdict = self.step(options);
            if verdict.is_some() {
                return verdict;
            }
            // lanes can take over only between two impacts
            if self.returned() && self.record().1.within(options) && leave(self) {
                return None;
            }
        }
        let (system, record) = self.record();
        Some(record.last_look(system, options))
    }
}

/// A motion of an oscillator.
pub(super) struct Drive<'a, 'b> {
    pub(super) osc: &'a Oscillator,
    pub(super) follow: &'a mut Follow,
    pub(super) releases: &'a mut Releases,
    pub(super) motion: &'a mut Motion<'b>,
    /// The propagators of the oscillator, kept for a motion that may be long.
    pub(super) cache: Option<&'a PropagatorCache>,
    /// The time followed so far.
    pub(super) time: f64,
    /// Whether the last event was an impact.
    pub(super) returned: bool,
}

impl Followed for Drive<'_, '_> {
    type Of = Oscillator;

    fn record(&mut self) -> (&Oscillator, &mut Record<Oscillator>) {
        (self.osc, &mut self.follow.record)
    }

    /// Every other event is followed by an impact or ends the motion; runs of grazing contacts are limited.
    fn step(&mut self, options: &SettleOptions) -> Option<Verdict> {
        let Self { osc, follow, motion, .. } = self;
        // the steps of the search for contacts are a part of the budget
        let before = motion.steps();
        let Some(event) = motion.advance(self.cache) else {
            return Some(ended(osc, motion.end(), options.limits, follow.count() as u64));
        };
        self.time = event.time;
        follow.record.steps += motion.steps() - before;
        // not the difference of two times, which loses digits as the time grows
        let interval = motion.leg().map_or(0.0, |leg| leg.duration);
        self.returned = matches!(event.kind, EventKind::Impact { .. });
        match event.kind {
            EventKind::Impact { velocity_before, .. } => {
                let state = ImpactState { phase: event.phase, velocity: velocity_before, side: event.side };
                follow.impact(osc, options, state, interval)
            }
            EventKind::Graze { .. } => follow.graze(osc, event.side, event.phase, interval),
            EventKind::Stick { .. } => {
                follow.stick(osc, interval);
                None
            }
            EventKind::Release => follow.release(osc, self.releases, event.side, interval),
        }
    }

    fn returned(&self) -> bool {
        self.returned
    }
}

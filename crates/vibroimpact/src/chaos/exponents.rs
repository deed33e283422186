//! The Lyapunov exponents of the motion from a start, through impacts, chatter and sticking.
//!
//! First the transient is passed. The tangent vectors begin in arbitrary directions and converge to their own during
//! the transient. Then the given number of impacts is measured, in [blocks](super) from which the error bars are
//! computed.
//!
//! The motion is checked for cycles, sticking and fading impacts as by [`settle`](crate::verdict::settle()), as long as
//! it is followed. The verdict is reported with the exponents ([`Exponents::motion`]), and they belong to that motion:
//! if it settles after the measurement has begun, the measurement begins again. So a chaotic transient and the motion
//! after it are not mixed.
//!
//! When the mass sticks, the measurement is discarded: the release is one state, so the motion after it does not depend
//! on what was before, and transient and measurement begin again. If it sticks on the same stop a second time, the
//! motion is periodic and sticks in every period, so both exponents are $`-\infty`$. So a measurement is begun again at
//! most once for each stop.

use super::dimension;
use super::run::Impacts;
use crate::flight::SearchLimits;
use crate::lyapunov::blocks::{Block, MEASURE, quotient};
use crate::lyapunov::{Measured, Run, Spectrum, Tail};
use crate::motion::{EventKind, ImpactState, Motion};
use crate::system::{Oscillator, Side, Start};
use crate::verdict::{
    Chaos, Follow, NoImpact, Releases, SettleOptions, System, Undecided, UndecidedCause, Verdict, ended,
};

/// The default number of impacts that are measured.
pub const DEFAULT_IMPACTS: u64 = 100_000;
/// The default number of impacts of the transient.
pub const DEFAULT_TRANSIENT: u64 = 1_000;

/// How long a motion is followed for its exponents.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExponentOptions {
    /// The number of impacts that are measured; with fewer than a few thousand the error bars are wide.
    pub impacts: u64,
    /// The number of impacts of the transient before the measurement; at least 100 are used.
    pub transient: u64,
    /// The limits of the search for the first contact of each flight.
    pub limits: SearchLimits,
    /// The largest number of search steps of all flights together; it limits the time if every flight is long.
    pub max_steps: u64,
}

impl ExponentOptions {
    /// Measures `impacts` after `transient`, with two hundred search steps for each impact; ordinary flights take ten.
    #[must_use]
    pub const fn new(impacts: u64, transient: u64) -> Self {
        let max_steps = impacts.saturating_add(transient).saturating_mul(200).saturating_add(2_000_000);
        Self { impacts, transient, limits: SearchLimits { periods: 1000.0, steps: 100_000 }, max_steps }
    }
}

impl Default for ExponentOptions {
    /// [`DEFAULT_IMPACTS`] after [`DEFAULT_TRANSIENT`].
    fn default() -> Self {
        Self::new(DEFAULT_IMPACTS, DEFAULT_TRANSIENT)
    }
}

/// How the exponents were obtained.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Grounds {
    /// Measured over `impacts` impacts, after `transient` others; of a machine that is followed itself, over events.
    Measured {
        /// Impacts measured.
        impacts: u64,
        /// Impacts of the transient.
        transient: u64,
        /// Time of the measurement.
        time: f64,
        /// Number of blocks.
        blocks: u32,
    },
    /// There are no more impacts: the exponents of the free oscillator, exact.
    Flight(NoImpact),
    /// The mass sticks on this stop again and again, once in each period of a cycle: minus infinity, exact.
    Sticks(Side),
    /// The mass sticks on this stop for ever: minus infinity, exact.
    Stuck(Side),
    /// The mass grazes a stop again and again, or its impacts fade away: there is no derivative and no exponent.
    Touches(NoImpact),
    /// Those of the cycle of a machine, from its multipliers, or of the structure in its last regime, exact.
    Exact,
    /// The search steps were used up before enough impacts were found, or the motion of a machine ended in another way.
    Undecided {
        /// Impacts found.
        impacts: u64,
    },
}

/// The exponents of a motion of an oscillator or of a machine.
#[derive(Clone, Debug, PartialEq)]
pub struct Exponents<S: System = Oscillator> {
    /// The verdict on the motion, as far as it was followed for the exponents: chaos if the largest exponent excludes 0
    /// and nothing else was shown.
    pub motion: Verdict<S>,
    /// Lyapunov exponents per unit of time, two for each coordinate, the largest first. Errors are three standard errors, and at
    /// least 1 over the measured time. Minus infinity where neighbouring motions become the same, NaN if there are none or none
    /// were found; see [`Grounds`].
    pub exponents: Vec<Measured>,
    /// The measured sum of all. Its error is smaller than theirs, because they are correlated.
    pub sum: Measured,
    /// The exact sum: $`2\,\overline{\ln\varepsilon}\,\nu - 2\zeta`$ with the impacts that were measured. The
    /// difference from `sum` is the rounding error of the measurement. NaN for a machine whose exponents are measured.
    pub identity: f64,
    /// Impacts per unit of time; infinite with a complete chatter in each period of a cycle, NaN if impacts fade away. Of a
    /// machine, closings of stops.
    pub impact_rate: Measured,
    /// Kaplan-Yorke dimension of the stroboscopic section, or of one across the flow without forcing; `None` if the largest
    /// exponent is not known to differ from 0.
    pub section_dimension: Option<Measured>,
    /// The dimension of the flow in the space of coordinates, velocities and the phase of the forcing; `None` as for the section.
    pub flow_dimension: Option<Measured>,
    /// How the exponents were obtained.
    pub grounds: Grounds,
}

impl<S: System> Exponents<S> {
    /// Whether they are exact, or measured.
    #[must_use]
    pub const fn exact(&self) -> bool {
        !matches!(self.grounds, Grounds::Measured { .. } | Grounds::Undecided { .. })
    }

    /// The exponents of a motion with this rate of impacts, from blocks of a measurement, or exact without blocks. In the dimension
    /// of the flow the phase counts as one if the motion is `forced`; without forcing one exponent is 0 along the motion.
    pub(super) fn new(
        motion: Verdict<S>,
        (exponents, impact_rate): (Vec<Measured>, Measured),
        (blocks, grounds): (&[Block], Grounds),
        forced: bool,
    ) -> Self {
        let sum: f64 = exponents.iter().map(|of| of.value).sum();
        let (sum, identity) = if blocks.is_empty() {
            (Measured::exact(sum), sum)
        } else {
            let sum = quotient(blocks, 0.0, |block| block.stretch.iter().sum(), |block| block.time);
            let total = |of: fn(&Block) -> f64| blocks.iter().map(of).sum::<f64>();
            (sum, total(|block| block.volume) / total(|block| block.time))
        };
        let dimension = dimension::kaplan_yorke(&exponents, identity, blocks);
        let more = |by: f64| move |of: Measured| Measured { value: (of.value + by).max(0.0), error: of.error };
        Self {
            motion,
            exponents,
            sum,
            identity,
            impact_rate,
            section_dimension: dimension.map(more(if forced { 0.0 } else { -1.0 })),
            flow_dimension: dimension.map(more(if forced { 1.0 } else { 0.0 })),
            grounds,
        }
    }
}

/// How a measurement was made.
pub(super) fn measured(run: &Run, blocks: &[Block]) -> Grounds {
    let impacts = run.measured().unwrap_or(0);
    let time = blocks.iter().map(|block| block.time).sum();
    let blocks = u32::try_from(blocks.len()).unwrap_or(u32::MAX);
    Grounds::Measured { impacts, transient: run.transient, time, blocks }
}

/// Exponents that are known exactly.
fn exact(values: [f64; 2], rate: f64, (motion, grounds): (Verdict, Grounds)) -> Exponents {
    let exponents = values.map(Measured::exact).into();
    Exponents::new(motion, (exponents, Measured::exact(rate)), (&[], grounds), true)
}

/// The exponents of a completed measurement.
fn of_run(found: &Impacts, settled: Option<Verdict>, last: ImpactState) -> Option<Exponents> {
    let (spectrum, blocks) = found.run.spectrum(MEASURE)?;
    let (exponents, impact_rate, impacts) = (spectrum.exponents, spectrum.impact_rate, found.seen);
    let pair = Spectrum { exponents: [exponents[0], exponents[1]], impact_rate, time: spectrum.time };
    let motion = settled.unwrap_or_else(|| {
        if pair.chaotic() {
            let tail = found.tail.map_or(Tail::new(last), |tail| tail.so_far());
            return Verdict::Chaotic(Chaos { spectrum: pair, impacts, tail });
        }
        Verdict::Undecided(Undecided { why: UndecidedCause::Budget, impacts, spectrum: Some(pair) })
    });
    let grounds = measured(&found.run, &blocks);
    Some(Exponents::new(motion, (exponents, impact_rate), (&blocks, grounds), true))
}

/// The Lyapunov exponents of the motion of `osc` from `start`.
///
/// ```
/// use vibroimpact::{Start, chaos::{ExponentOptions, exponents}, scenario};
/// let osc = scenario::U.oscillator();                                  // U of the 1971 paper
/// let found = exponents(&osc, Start::at_rest(&osc), &ExponentOptions::new(20_000, 1_000));
/// let [one, two] = found.exponents[..] else { panic!("two") };
/// assert!(one.value > one.error && (found.sum.value - found.identity).abs() < 1e-9);
/// let dimension = found.section_dimension.unwrap();                    // of the stroboscopic section
/// assert!((dimension.value - (1.0 + one.value / -two.value)).abs() < 1e-12);
/// ```
#[must_use]
pub fn exponents(osc: &Oscillator, start: Start, options: &ExponentOptions) -> Exponents {
    // it is never stopped
    exponents_while(osc, start, options, &|| true).unwrap_or_else(|| spent(osc, options, None, 0))
}

/// The same as [`exponents`], but stopped when `go_on` returns false, and then `None`. `go_on` is called at every
/// event.
#[must_use]
pub fn exponents_while(
    osc: &Oscillator,
    start: Start,
    options: &ExponentOptions,
    go_on: &dyn Fn() -> bool,
) -> Option<Exponents> {
    let mut motion = Motion::with_limits(osc, start, options.limits);
    let mut run = Impacts::new(options.impacts, options.transient);
    // chaos is measured here: only what the motion settles into is watched
    let watch = SettleOptions { chaos_over: 0, limits: options.limits, ..SettleOptions::default() };
    let (mut follow, releases) = (Follow::default(), &mut Releases::default());
    let mut settled: Option<Verdict> = None;
    while motion.steps() < options.max_steps {
        if !go_on() {
            return None;
        }
        let Some(event) = motion.next() else {
            return Some(at_the_end(osc, ended(osc, motion.end(), options.limits, run.seen), run.seen));
        };
        let interval = motion.leg().map_or(0.0, |leg| leg.duration);
        run.since += interval;
        match event.kind {
            EventKind::Impact { velocity_before, .. } => {
                let state = ImpactState { phase: event.phase, velocity: velocity_before, side: event.side };
                run.impact(osc, state);
                if settled.is_none() {
                    settled = follow.impact(osc, &watch, state, interval);
                    // what has been measured so far belongs to the transient
                    if settled.is_some() && run.run.measured() > Some(0) {
                        run.begin_again();
                    }
                }
                if run.run.complete() {
                    return of_run(&run, settled, state);
                }
            }
            EventKind::Graze { .. } => {
                if settled.is_none() {
                    settled = follow.graze(osc, event.side, event.phase, interval);
                }
            }
            EventKind::Stick { chatter, .. } => {
                follow.stick(osc, interval);
                if let Some(rate) = run.stick(osc, event.side, event.time, chatter)
                    && let Some(verdict) = &settled
                {
                    let grounds = Grounds::Sticks(event.side);
                    // a finite number of impacts in a period that rounding errors decide is not known
                    let known = rate == f64::INFINITY || !matches!(verdict, Verdict::Undecided(_));
                    let rate = if known { rate } else { f64::NAN };
                    return Some(exact([f64::NEG_INFINITY; 2], rate / osc.period(), (verdict.clone(), grounds)));
                }
            }
            EventKind::Release => {
                // at rest neighbouring motions become one: the measurement begins again
                run.begin_again();
                settled = settled.or_else(|| follow.release(osc, releases, event.side, interval));
            }
        }
        if let Some(Verdict::NoImpact(why)) = settled
            && !matches!(why, NoImpact::Landing { .. })
        {
            return Some(at_the_end(osc, Verdict::NoImpact(why), run.seen));
        }
    }
    Some(spent(osc, options, settled, run.seen))
}

/// The exponents of a motion whose search steps were used up.
fn spent(osc: &Oscillator, options: &ExponentOptions, settled: Option<Verdict>, impacts: u64) -> Exponents {
    let motion = settled.unwrap_or_else(|| ended(osc, None, options.limits, impacts));
    exact([f64::NAN; 2], f64::NAN, (motion, Grounds::Undecided { impacts }))
}

/// The exponents of a motion with no further event.
fn at_the_end(osc: &Oscillator, end: Verdict, impacts: u64) -> Exponents {
    let (values, rate, grounds) = match &end {
        Verdict::NoImpact(why @ NoImpact::Grazing { .. }) => ([f64::NAN; 2], 0.0, Grounds::Touches(*why)),
        // the impacts become ever gentler but do not end
        Verdict::NoImpact(why @ NoImpact::GrazeLimit { .. }) => ([f64::NAN; 2], f64::NAN, Grounds::Touches(*why)),
        Verdict::NoImpact(why) => (of_flight(osc.damping()), 0.0, Grounds::Flight(*why)),
        Verdict::Stuck(side) => ([f64::NEG_INFINITY; 2], 0.0, Grounds::Stuck(*side)),
        _ => ([f64::NAN; 2], f64::NAN, Grounds::Undecided { impacts }),
    };
    exact(values, rate, (end, grounds))
}

/// The real parts of the characteristic exponents.
fn of_flight(damping: f64) -> [f64; 2] {
    if damping < 1.0 {
        // adding to 0 avoids a negative zero
        return [0.0 - damping; 2];
    }
    // two roots, because the square of the damping less 1 would lose digits near critical damping
    let fast = damping + (damping - 1.0).sqrt() * (damping + 1.0).sqrt();
    // their product is 1: as a quotient the slow one keeps its digits
    [-1.0 / fast, -fast]
}

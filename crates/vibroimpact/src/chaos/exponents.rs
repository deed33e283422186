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
use super::run::Run;
use crate::flight::SearchLimits;
use crate::lyapunov::blocks::{Block, MEASURE, quotient};
use crate::lyapunov::{Measured, Spectrum, Tail};
use crate::motion::{EventKind, ImpactState, Motion};
use crate::system::{Oscillator, Side, Start};
use crate::verdict::{Chaos, Follow, NoImpact, Releases, SettleOptions, Undecided, Verdict, ended};

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
    /// Measured over `impacts` impacts, after `transient` others.
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
    /// The search steps were used up before enough impacts were found.
    Undecided {
        /// Impacts found.
        impacts: u64,
    },
}

/// The exponents of a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Exponents {
    /// The verdict on the motion, as far as it was followed for the exponents: chaos if the larger exponent excludes 0
    /// and nothing else was shown.
    pub motion: Verdict,
    /// Lyapunov exponents per unit of (nondimensional) time, the larger first. Errors are three standard errors, and at
    /// least 1 over the measured time. Minus infinity for a motion that sticks, NaN if there are none or none were
    /// found; see [`Grounds`].
    pub exponents: [Measured; 2],
    /// The measured sum of both. Its error is smaller than theirs, because they are correlated.
    pub sum: Measured,
    /// The exact sum: $`2\,\overline{\ln\varepsilon}\,\nu - 2\zeta`$ with the impacts that were measured. The
    /// difference from `sum` is the rounding error of the measurement.
    pub identity: f64,
    /// Impacts per forcing period; infinite with a complete chatter in each period of a cycle, NaN if impacts fade
    /// away.
    pub impacts_per_period: Measured,
    /// Kaplan-Yorke dimension of the stroboscopic section, 0 to 2; `None` if the larger exponent is not known to differ
    /// from 0. That of the flow, in the space of position, velocity and phase, is larger by 1.
    pub section_dimension: Option<Measured>,
    /// The forcing period.
    pub period: f64,
    /// How the exponents were obtained.
    pub grounds: Grounds,
}

impl Exponents {
    /// The exponents per forcing period: the logarithms of the multipliers of the stroboscopic map.
    #[must_use]
    pub fn per_period(&self) -> [Measured; 2] {
        self.exponents.map(|m| Measured { value: m.value * self.period, error: m.error * self.period })
    }

    /// Kaplan-Yorke dimension of the flow in the space of position, velocity and phase, 1 to 3; `None` as for the
    /// section.
    #[must_use]
    pub fn flow_dimension(&self) -> Option<Measured> {
        self.section_dimension.map(|d| Measured { value: d.value + 1.0, error: d.error })
    }

    /// Exponents that are known exactly.
    fn exact(osc: &Oscillator, values: [f64; 2], rate: f64, (motion, grounds): (Verdict, Grounds)) -> Self {
        let exact = |value| Measured { value, error: 0.0 };
        let exponents = values.map(exact);
        let sum = values[0] + values[1];
        Self {
            motion,
            exponents,
            sum: exact(sum),
            identity: sum,
            impacts_per_period: exact(rate),
            section_dimension: dimension::of_section(&exponents, &[]),
            period: osc.period(),
            grounds,
        }
    }

    /// The exponents of a completed measurement.
    fn measured(osc: &Oscillator, run: &Run, settled: Option<Verdict>, last: ImpactState) -> Self {
        let (blocks, transient) = (run.blocks.as_slice(), run.transient);
        let total = blocks.iter().fold(Block::default(), |sum, block| sum.plus(block));
        let rate = |least: f64, of: &dyn Fn(&Block) -> f64| quotient(blocks, least, of, |block| block.time);
        let mut exponents = [0, 1].map(|k| rate(MEASURE, &|b| b.stretch[k]));
        if exponents[0].value < exponents[1].value {
            // equal to within their errors
            exponents.swap(0, 1);
        }
        let impacts = rate(0.0, &|b| b.impacts);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a whole number, as it was counted
        let count = total.impacts as u64;
        let grounds = Grounds::Measured {
            impacts: count,
            transient,
            time: total.time,
            blocks: u32::try_from(blocks.len()).unwrap_or(u32::MAX),
        };
        let impacts_per_period = Measured { value: impacts.value * osc.period(), error: impacts.error * osc.period() };
        let tail = run.tail.map_or(Tail::new(last), Tail::so_far);
        let spectrum = Spectrum { exponents, impacts_per_period, time: total.time, last, tail };
        let motion = settled.unwrap_or(if spectrum.chaotic() {
            Verdict::Chaotic(Chaos { spectrum, impacts: run.seen })
        } else {
            Verdict::Undecided(Undecided::Impacts { impacts: run.seen, spectrum: Some(spectrum) })
        });
        Self {
            motion,
            exponents,
            sum: rate(0.0, &|b| b.stretch[0] + b.stretch[1]),
            identity: total.area / total.time,
            impacts_per_period,
            section_dimension: dimension::of_section(&exponents, blocks),
            period: osc.period(),
            grounds,
        }
    }
}

/// The Lyapunov exponents of the motion of `osc` from `start`.
///
/// ```
/// use vibroimpact::{Start, chaos::{ExponentOptions, exponents}, scenario};
/// let osc = scenario::U.oscillator();                                  // U of the 1971 paper
/// let found = exponents(&osc, Start::at_rest(&osc), &ExponentOptions::new(20_000, 1_000));
/// let [one, two] = found.exponents;
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
    let mut run = Run::new(options.impacts, options.transient);
    let watch = SettleOptions { chaos_over: 0, limits: options.limits, ..SettleOptions::default() };
    let (mut follow, releases) = (Follow::default(), &mut Releases::default());
    let mut settled: Option<Verdict> = None;
    while motion.steps() < options.max_steps {
        if !go_on() {
            return None;
        }
        let Some(event) = motion.next() else {
            return Some(at_the_end(osc, ended(osc, motion.end(), options.limits), run.seen));
        };
        let interval = motion.leg().map_or(0.0, |leg| leg.duration);
        run.since += interval;
        match event.kind {
            EventKind::Impact { velocity_before, .. } => {
                let state = ImpactState { phase: event.phase, velocity: velocity_before, side: event.side };
                run.impact(osc, state);
                if settled.is_none() {
                    settled = follow.impact(osc, &watch, state, interval);
                    if settled.is_some() && run.measuring() {
                        run.begin_again();
                    }
                }
                if run.complete() {
                    return Some(Exponents::measured(osc, &run, settled, state));
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
                    return Some(Exponents::exact(osc, [f64::NEG_INFINITY; 2], rate, (verdict.clone(), grounds)));
                }
            }
            EventKind::Release => {
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
    let motion = settled.unwrap_or_else(|| ended(osc, None, options.limits));
    Exponents::exact(osc, [f64::NAN; 2], f64::NAN, (motion, Grounds::Undecided { impacts }))
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
    Exponents::exact(osc, values, rate, (end, grounds))
}

/// The real parts of the characteristic exponents.
fn of_flight(damping: f64) -> [f64; 2] {
    if damping < 1.0 {
        // adding to 0 avoids a negative zero
        return [0.0 - damping; 2];
    }
    let fast = damping + (damping - 1.0).sqrt() * (damping + 1.0).sqrt();
    [-1.0 / fast, -fast]
}

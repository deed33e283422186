//! The first zero of a flight where it is a plain crossing, by samples of the guards at equal steps.
//!
//! Between two samples a guard lies above the line between them less $`Bh^2/8`$, with a bound $`B`$ of its second
//! derivative; so it is positive where both are larger. Other steps are decided by the series of the guard over the step.
//! What is not decided so, which is rare, is left to the search (`search`).

use super::flight::{MachineFlight, Modes};
use crate::math::fit;
use crate::regime::{POWERS, REST, SAMPLES, Sampled, Span};

/// The state is computed anew, by the search, after so many spans.
const SPANS: u32 = 32;

/// Buffers for the samples, kept from flight to flight.
#[derive(Clone, Debug, Default)]
pub(super) struct Sampling {
    /// The state at the beginning of a span, and after some of its steps.
    z: Vec<f64>,
    there: Vec<f64>,
    /// Energies of the free parts of the modes at the beginning of the flight, and bounds of those until the end of a span.
    first: Vec<f64>,
    energies: Vec<f64>,
    series: Vec<[f64; POWERS]>,
    guards: Vec<Of>,
}

/// A guard in a span.
#[derive(Clone, Copy, Debug, Default)]
struct Of {
    samples: [f64; SAMPLES],
    /// It is positive between two samples above this.
    margin: f64,
    /// A bound of the errors of its series.
    error: f64,
    /// Both without rounding errors, and the sizes of terms to which these are relative.
    least: f64,
    rest: f64,
    size: f64,
    size_at_start: f64,
    /// Its constant part, and its value at the beginning of the flight if the span begins there.
    constant: f64,
    value: Option<f64>,
    /// Whether it is zero at the beginning of the span because the flight begins on it.
    known: bool,
}

/// What is known of a guard in a step.
enum Step {
    Positive,
    /// It crosses zero after this part of the step, and is positive before.
    Crosses(f64),
    Open,
}

impl Of {
    /// Whether it is positive in a step, by its samples.
    #[inline(always)]
    fn is_clear(&self, step: usize) -> bool {
        if self.known && step == 0 {
            // above the chord from the zero, less what it can bend
            return self.samples[1] > 4.0 * self.margin;
        }
        self.samples[step] > self.margin && self.samples[step + 1] > self.margin
    }

    /// The first step in which it is not positive by its samples, from one on.
    #[inline(always)]
    fn first_open(&self, from: usize) -> usize {
        // all steps at once, because no processor can predict which one it is
        let mut positive = 0_u32;
        for (j, sample) in self.samples.iter().enumerate() {
            positive |= u32::from(*sample > self.margin) << j;
        }
        let mut clear = positive & (positive >> 1);
        if self.known {
            clear = clear & !1 | u32::from(self.is_clear(0));
        }
        from + usize::try_from((clear >> from).trailing_ones()).unwrap_or(0)
    }

    /// The same from the first step on.
    #[inline(always)]
    fn first_open_of_all(&self) -> usize {
        if self.known {
            return self.first_open(0);
        }
        // the least of all samples first, because most spans are clear
        let less = |one: f64, other: f64| if one < other { one } else { other };
        let (eight, _) = self.samples.as_chunks::<8>();
        let mut least = eight[0];
        for (least, sample) in least.iter_mut().zip(&eight[1]) {
            *least = less(*least, *sample);
        }
        let four =
            [less(least[0], least[4]), less(least[1], least[5]), less(least[2], least[6]), less(least[3], least[7])];
        let all_clear = less(less(four[0], four[2]), less(four[1], four[3])) > self.margin;
        if all_clear { SAMPLES - 1 } else { self.first_open(0) }
    }

    /// What it does in a step, by its series there.
    #[inline(always)]
    fn decide(&self, c: &mut [f64; POWERS - 1], step: usize) -> Step {
        let mut error = self.error;
        if self.known && step == 0 {
            // the zero at the beginning is divided out
            c.copy_within(1.., 0);
            c[POWERS - 2] = 0.0;
            error += 64.0 * f64::EPSILON * (c[0].abs() + c[1].abs());
        }
        if self.samples[step + 1] > 0.0 {
            return if is_positive(c, error) { Step::Positive } else { Step::Open };
        }
        if c[0] <= error { Step::Open } else { crossing(c, error).map_or(Step::Open, Step::Crosses) }
    }
}

/// Whether a polynomial with small higher terms is larger than an error on [0, 1]; `false` may be wrong.
#[inline(always)]
fn is_positive(c: &[f64; POWERS - 1], error: f64) -> bool {
    // all that the terms beyond the parabola can take away
    let rest: f64 = c[3..].iter().map(|c| c.abs()).sum();
    // the vertex of the parabola lies within the step
    let inside = c[2] > 0.0 && c[1] < 0.0 && -c[1] < 2.0 * c[2];
    let least = if inside { c[0] - c[1] * c[1] / (4.0 * c[2]) } else { c[0].min(c[0] + c[1] + c[2]) };
    least > error + rest
}

/// The zero of a polynomial that falls all the way to it.
#[inline(always)]
fn crossing(c: &[f64; POWERS - 1], error: f64) -> Option<f64> {
    // the zero of the parabola, and Halley's method from there
    let root = c[1] * c[1] - 4.0 * c[0] * c[2];
    let mut t = if root >= 0.0 { (2.0 * c[0] / (root.sqrt() - c[1])).min(1.0) } else { 1.0 };
    let mut slope = 0.0;
    for _ in 0..8 {
        let value;
        (value, slope) = value_and_slope(c, t);
        // nearly the second derivative is enough
        let bend = 2.0 * (c[2] + t * (3.0 * c[3] + t * (6.0 * c[4] + t * 10.0 * c[5])));
        let moved = 2.0 * value * slope / (2.0 * slope * slope - value * bend);
        t -= moved;
        // the next step would be below rounding
        if moved.abs() <= 1e-6 * t {
            break;
        }
    }
    // the terms that rise do so most at the end
    let end = t + 2.0 * error / slope.abs();
    let (mut steepest, mut power, mut k) = (c[1], end, 2.0);
    for c in &c[2..] {
        steepest += k * c.max(0.0) * power;
        power *= end;
        k += 1.0;
    }
    // the guard falls all the way to there, so this zero is the first
    (t > 0.0 && end <= 1.0 && steepest < -16.0 * error).then_some(t)
}

/// The time of the first zero before `until` and its guard, if it is the plain crossing of one guard; the modes are then those
/// there.
pub(super) fn plain_crossing(
    flight: &MachineFlight,
    until: f64,
    steps: u32,
    sampling: &mut Sampling,
    modes: &mut Modes,
) -> Option<(f64, usize)> {
    let sampled = flight.structure.sampled()?;
    if flight.guards.iter().any(|guard| guard.known > 1 || guard.recovery.is_some()) {
        return None;
    }
    let (s, guard, part) = search(sampling, flight, sampled, until, steps.min(SPANS))?;
    modes.s = s;
    let over = 1.0 / sampled.spans[0].step;
    let count = sampling.series.len();
    fit(&mut modes.moved, count);
    fit(&mut modes.v, count);
    for (c, (moved, v)) in sampling.series.iter().zip(modes.moved.iter_mut().zip(&mut modes.v)) {
        let (value, slope) = value_and_slope(c, part);
        (*moved, *v) = (value, slope * over);
    }
    modes.error.clear();
    flight.gain(modes);
    flight.turn(s, modes);
    Some((s, guard))
}

/// [`Sampling::search`] by vectors of four numbers where the processor has them. Samples are independent sums, so the result has the
/// same bits. What it calls is inlined, because a function that is not would be compiled for vectors of two.
fn search(
    sampling: &mut Sampling,
    flight: &MachineFlight,
    sampled: &Sampled,
    until: f64,
    spans: u32,
) -> Option<(f64, usize, f64)> {
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("avx2") {
        // the processor has been asked
        #[allow(unsafe_code)]
        return unsafe { search_avx2(sampling, flight, sampled, until, spans) };
    }
    sampling.search(flight, sampled, until, spans)
}

/// Whether vectors of four numbers lead to the same crossing, to the last bit.
#[cfg(test)]
pub(super) fn is_the_same_without_vectors(flight: &MachineFlight, sampling: &mut Sampling) -> bool {
    let sampled = flight.structure.sampled().expect("the structure is sampled");
    let bits = |found: Option<(f64, usize, f64)>| found.map(|(s, guard, part)| (s.to_bits(), guard, part.to_bits()));
    bits(search(sampling, flight, sampled, 30.0, SPANS)) == bits(sampling.search(flight, sampled, 30.0, SPANS))
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn search_avx2(
    sampling: &mut Sampling,
    flight: &MachineFlight,
    sampled: &Sampled,
    until: f64,
    spans: u32,
) -> Option<(f64, usize, f64)> {
    sampling.search(flight, sampled, until, spans)
}

/// The value of a polynomial and its slope, by even and odd powers.
#[inline(always)]
fn value_and_slope<const N: usize>(c: &[f64; N], t: f64) -> (f64, f64) {
    let u = t * t;
    // the last two powers have nothing above them
    let mut k = N - 2 + N % 2;
    let (mut even, mut odd) = (c[k], if k + 1 < N { c[k + 1] } else { 0.0 });
    let (mut even_slope, mut odd_slope) = (0.0, 0.0);
    while k > 1 {
        k -= 2;
        even_slope = even_slope * u + even;
        even = even * u + c[k];
        odd_slope = odd_slope * u + odd;
        odd = odd * u + if k + 1 < N { c[k + 1] } else { 0.0 };
    }
    (even + t * odd, odd + 2.0 * (t * even_slope + u * odd_slope))
}

impl Sampling {
    /// The time of the crossing, its guard, and which part of a step it is behind the state of `series`.
    #[inline(always)]
    fn search(
        &mut self,
        flight: &MachineFlight,
        sampled: &Sampled,
        until: f64,
        spans: u32,
    ) -> Option<(f64, usize, f64)> {
        flight.state_of_modes(&mut self.z);
        sampled.energies(&self.z, &mut self.first);
        // the sizes of all terms in the time that can be searched
        let longest = sampled.spans.last().map_or(0.0, |span| span.step) * LAST * f64::from(spans);
        sampled.grown(&self.first, &self.z, longest, &mut self.energies);
        fit(&mut self.guards, flight.guards.len());
        for ((of, start), parts) in self.guards.iter_mut().zip(&flight.guards).zip(&sampled.guards) {
            (of.constant, of.value, of.known) = (start.constant, Some(start.value), start.known > 0);
            of.size = parts.size(&self.energies, &self.z, longest);
            of.size_at_start = 8.0 * (start.size + start.constant.abs());
        }
        // those at the beginning hold for ever if none grows
        if !sampled.grows {
            core::mem::swap(&mut self.first, &mut self.energies);
        }
        let (mut s, mut level, mut stay, mut passed, mut bounded) = (0.0, 0, 0, 0.0, None);
        for _ in 0..spans {
            if s >= until {
                break;
            }
            let span = &sampled.spans[level];
            let end = s + span.step * LAST;
            if sampled.grows {
                sampled.grown(&self.first, &self.z, end, &mut self.energies);
            }
            if sampled.grows || bounded != Some(level) {
                self.bound(span);
                bounded = Some(level);
            }
            let mut open = SAMPLES - 1;
            for (of, samples) in self.guards.iter_mut().zip(&span.guards) {
                samples.at(&self.z, of.constant, &mut of.samples);
                let rounding = f64::EPSILON * (32.0 * (passed + 1.0) * of.size + of.size_at_start);
                (of.margin, of.error) = (of.least + rounding, of.rest + rounding);
                if s > 0.0 {
                    (of.value, of.known) = (None, false);
                }
                open = open.min(of.first_open_of_all());
            }
            if level == 0 && open < SAMPLES - 1 {
                match self.decide(sampled, open)? {
                    (steps, Some((guard, part))) => {
                        let s = s + (steps + part) * span.step;
                        return (s < until).then_some((s, guard, part));
                    }
                    (_, None) => open = SAMPLES - 1,
                }
            }
            if open > 0 {
                span.pass(open, &mut self.z);
                s += span.step * COUNTS[open];
                passed += 1.0;
            }
            if open < SAMPLES - 1 {
                level -= 1;
                stay = 1;
            } else if stay > 0 {
                stay -= 1;
            } else if level + 1 < sampled.spans.len() {
                level += 1;
            }
        }
        None
    }

    /// The bounds of all guards in a span, without rounding errors.
    #[inline(always)]
    fn bound(&mut self, span: &Span) {
        for (of, samples) in self.guards.iter_mut().zip(&span.guards) {
            let (bend, lowered) = samples.bend(&self.energies, &self.z);
            let bend = bend * span.step * span.step;
            (of.least, of.rest) = (0.125 * bend + lowered, REST * bend);
        }
    }

    /// Decides the steps of a span of the first level from the first open one on: the crossing, with the steps before it,
    /// or none; `None` if that is not decided.
    #[inline(always)]
    fn decide(&mut self, sampled: &Sampled, mut step: usize) -> Option<(f64, Option<(usize, f64)>)> {
        let count = sampled.parts.len();
        while step < SAMPLES - 1 {
            fit(&mut self.there, self.z.len());
            self.there.copy_from_slice(&self.z);
            if step > 0 {
                sampled.spans[0].pass(step, &mut self.there);
            }
            sampled.expand(&self.there, &mut self.series);
            let mut found = None;
            for (g, of) in self.guards.iter().enumerate() {
                if of.is_clear(step) {
                    continue;
                }
                let mut c = sampled.guards[g].series(&self.series, &self.there[3 * count..]);
                c[0] = match of.value {
                    Some(value) if step == 0 => value,
                    _ => c[0] + of.constant,
                };
                match of.decide(&mut c, step) {
                    Step::Positive => {}
                    Step::Crosses(part) if found.is_none() => found = Some((g, part)),
                    Step::Crosses(_) | Step::Open => return None,
                }
            }
            if found.is_some() {
                return Some((COUNTS[step], found));
            }
            step = self.guards.iter().map(|of| of.first_open(step + 1)).min().unwrap_or(SAMPLES - 1);
        }
        Some((0.0, None))
    }
}

/// The numbers of steps as they multiply.
const COUNTS: [f64; SAMPLES] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0, 13.0, 14.0, 15.0];
const LAST: f64 = COUNTS[SAMPLES - 1];

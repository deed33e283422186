//! The zero of a guard: proof that there is one, and its time.

use super::flight::{MachineFlight, Modes};
use super::found::{Buffers, Found, Guards};
use super::guard_polynomial::ORDER;
use super::polynomial::{RESOLUTION, falls, first_zero_near, value};
use crate::regime::TERMS;

/// Over this part of a radian of the fastest rate the modes move on by their rates, exact to rounding.
const NEARBY: f64 = 1e-8;
/// Up to this part of a window the remainder of the polynomial, of the ninth order, is below rounding.
const NEAR: f64 = 0.01;

/// The zero, if it is proven that there is exactly one near `near` for each guard that may be the first.
pub(super) fn certain(flight: &MachineFlight, window: f64, s: f64, near: f64, buffers: &mut Buffers) -> Option<Found> {
    let mut brackets = core::mem::take(&mut buffers.brackets);
    brackets.clear();
    let found = proven(flight, window, s, near, buffers, &mut brackets);
    buffers.brackets = brackets;
    found
}

fn proven(
    flight: &MachineFlight,
    window: f64,
    s: f64,
    near: f64,
    buffers: &mut Buffers,
    brackets: &mut Vec<(usize, f64, f64)>,
) -> Option<Found> {
    let mut end = 1.0_f64;
    for (g, of) in buffers.polynomials.iter().enumerate() {
        let Some(from) = of.from else { continue };
        if from > end {
            continue;
        }
        match first_zero_near(&of.beside(1.0), from) {
            Some(to) => {
                // the guard itself falls from here to there
                if !falls(&of.steep(), from, to.max(from)) {
                    if from <= near {
                        return None;
                    }
                    end = end.min(from);
                    continue;
                }
                brackets.push((g, from, to));
                end = end.min(to);
            }
            None if from <= near => return None,
            None => end = end.min(from),
        }
    }
    // a guard whose zero is not certain may come first
    brackets.retain(|(_, from, _)| *from <= end);
    let last = brackets.iter().map(|(_, _, to)| *to).fold(f64::INFINITY, f64::min);
    if brackets.is_empty() || last > end {
        return None;
    }
    let mut best = f64::INFINITY;
    for (g, from, to) in brackets.iter_mut() {
        let (g, from, to) = (*g, from, *to);
        let of = buffers.polynomials[g];
        // a first approximation
        let guess = || {
            let (t, curvature) = crossing_of(&without_remainder(&of.p), *from, to);
            (s + t * window, curvature / (window * window))
        };
        let along = of.beside(0.0);
        let at = if of.known == 0 && along[0] <= 0.0 {
            // it is zero already
            s
        } else if of.known > 0 {
            let bracket = (*from, to);
            on_polynomial(&along, window, bracket).unwrap_or_else(|| {
                let bracket = (*from * window, to * window);
                refine(flight, g, bracket, Some(guess()), RESOLUTION * window, &mut buffers.modes)
            })
        } else {
            let guess = guess();
            let bracket = (s + *from * window, s + to * window);
            refine(flight, g, bracket, Some(guess), RESOLUTION * window, &mut buffers.modes)
        };
        best = best.min(at);
        // its time in the place of its bracket
        *from = at;
    }
    // the same time within rounding
    let together = |at: f64| at <= best * (1.0 + 4.0 * f64::EPSILON);
    let guards = brackets.iter().filter(|(_, at, _)| together(*at)).map(|(g, ..)| *g).collect();
    Some(Found::Zero { s: best, guards: Guards::Several(guards) })
}

/// The zero of a falling polynomial between two points, nearly, and the size of its second derivative.
fn crossing_of(p: &[f64; TERMS], from: f64, to: f64) -> (f64, f64) {
    let mut t = 0.5 * (from + to);
    for _ in 0..3 {
        let (height, slope) = value(p, t);
        let next = (t - height / slope).clamp(from, to.max(from));
        let moved = (next - t).abs();
        t = next;
        if moved < 1e-7 {
            break;
        }
    }
    let mut curvature = 0.0;
    let mut k = 9.0;
    for c in p[2..].iter().rev() {
        curvature = curvature * t + k * (k - 1.0) * c;
        k -= 1.0;
    }
    (t, curvature.abs())
}

/// The polynomial alone.
pub(super) fn without_remainder(p: &[f64; TERMS]) -> [f64; TERMS] {
    let mut q = *p;
    q[ORDER] = 0.0;
    q
}

/// The lowest point of a polynomial after `from`, and how far behind it the polynomial has risen above rounding.
pub(super) fn lowest(p: &[f64; TERMS], from: f64) -> (f64, f64) {
    let q = without_remainder(p);
    let (mut low, mut high) = (from, 1.0);
    // the slope is negative before and positive after; without a change of sign the end is the lowest point
    let mut step = 1e-6;
    while low + step < 1.0 && value(&q, low + step).1 < 0.0 {
        step *= 2.0;
    }
    if low + step < 1.0 {
        high = low + step;
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if value(&q, middle).1 < 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
    }
    let touch = 0.5 * (low + high);
    (touch, (touch - from).max(1e-9) * 2.0)
}

/// The zero of a guard in a bracket in time, by Newton's method on the closed form. `guess` are a first approximation, in
/// the bracket, and the second derivative of the guard there. The modes are then those at the zero.
pub(super) fn refine(
    flight: &MachineFlight,
    g: usize,
    (from, to): (f64, f64),
    guess: Option<(f64, f64)>,
    resolution: f64,
    modes: &mut Modes,
) -> f64 {
    let (mut low, mut high) = (from, to.max(from));
    let (mut s, curvature) = guess.unwrap_or((0.5 * (low + high), f64::INFINITY));
    // the ends are known to the resolution of the search on the polynomial
    let beside = 4.0 * resolution + 8.0 * f64::EPSILON * high;
    (low, high) = ((low - beside).max(0.0), high + beside);
    s = if s.is_nan() { 0.5 * (low + high) } else { s.clamp(low, high) };
    let nearby = if flight.structure.dense.is_none() { NEARBY / flight.structure.fastest() } else { 0.0 };
    for _ in 0..100 {
        flight.at(s, modes);
        let (value, rate, _) = flight.guard(g, modes);
        if value > 0.0 {
            low = low.max(s);
        } else {
            high = high.min(s);
        }
        let mut next = s - value / rate;
        let newton = next >= low && next <= high;
        if !newton {
            next = 0.5 * (low + high);
        }
        let moved = (next - s).abs();
        // the next step of the method would be below rounding, and the modes move on by their rates
        if newton && moved <= nearby && 4.0 * curvature * moved * moved <= f64::EPSILON * s * rate.abs() {
            flight.advance(next - s, modes);
            modes.s = next;
            return next;
        }
        s = next;
        if moved <= f64::EPSILON * s || value == 0.0 || high - low <= f64::EPSILON * high {
            break;
        }
    }
    s
}

/// The zero of a guard on which the flight began, if it is so near that the remainder of the polynomial is below rounding.
fn on_polynomial(q: &[f64; TERMS], window: f64, (from, to): (f64, f64)) -> Option<f64> {
    if from > NEAR {
        return None;
    }
    let (mut low, mut high) = ((from - 4.0 * RESOLUTION).max(0.0), to + 4.0 * RESOLUTION);
    let mut t = 0.5 * (low + high);
    for _ in 0..100 {
        let (height, slope) = value(q, t);
        if height > 0.0 {
            low = t;
        } else {
            high = t;
        }
        let mut next = t - height / slope;
        if !(next >= low && next <= high) {
            next = 0.5 * (low + high);
        }
        let moved = (next - t).abs();
        t = next;
        if moved <= 0.25 * f64::EPSILON * t {
            break;
        }
    }
    (t < NEAR).then_some(t * window)
}

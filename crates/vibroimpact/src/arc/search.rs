//! The first event of a flight: the first zero of any of its guards. None is missed.
//!
//! At a time $`s`$ the guards are expanded to the eighth order; the ninth derivative is bounded over a window by bounds
//! of the modes. With $`E = \sqrt{\dot y^2 + ky^2}`$, which grows by at most the size $`P`$ of the forcing per unit of
//! time, $`|\dot y| \le E + PH`$ over a window of length $`H`$, and from the equation of the mode
//!
//! $$`|y^{(k+2)}| \le 2d\,|y^{(k+1)}| + k\,|y^{(k)}| + |p^{(k)}|.`$$
//!
//! So each guard lies between two polynomials. Where the lower one is positive there is no event. A first zero is
//! accepted if both polynomials have one and the guard falls between them; it is then refined with the closed form. The
//! search begins anew at the first zero of the lower polynomial otherwise, with a shorter window: the distance of the two
//! polynomials falls with the ninth power of its length. What remains are touches of a guard within rounding, which are
//! told and have no effect.

use super::flight::{MachineFlight, Modes};
use super::polynomial::{falls, first_zero, first_zero_near, is_positive, value};
use super::track::Track;
use crate::math::dot;
use crate::regime::{REACH, TERMS};

/// What ends a flight.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Found {
    /// The guards (by place) that become zero a time after the beginning. If there are several, they are zero at the
    /// same time within rounding.
    Zero { s: f64, guards: Vec<usize> },
    /// No zero before this time.
    NoneBefore(f64),
}

/// A guard that touches zero within rounding and is positive again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Touch {
    pub(crate) s: f64,
    pub(crate) guard: usize,
}

const ORDER: usize = TERMS - 1;
/// Over this part of a radian of the fastest rate the modes move on by their rates, exact to rounding.
const NEARBY: f64 = 1e-8;
/// How exactly a first zero of a polynomial on [0, 1] is found.
const RESOLUTION: f64 = super::polynomial::RESOLUTION;

/// Up to this part of a window the remainder of the polynomial, of the ninth order, is below rounding.
const NEAR: f64 = 0.01;

/// Buffers of a search, kept from flight to flight.
#[derive(Clone, Debug, Default)]
pub(crate) struct Buffers {
    pub(crate) modes: Modes,
    terms: Vec<f64>,
    ninth: Vec<f64>,
    tenth: Vec<f64>,
    turned: Vec<(f64, f64)>,
    polynomials: Vec<GuardPolynomial>,
    track: Track,
    known: Vec<usize>,
    touched: Vec<bool>,
    brackets: Vec<(usize, f64, f64)>,
    /// Whether `modes` are those of the last flight at its first zero.
    fresh: bool,
}

impl Buffers {
    /// The modes of a flight at a time. Those at the first zero of the flight searched last are known.
    pub(crate) fn modes_at(&mut self, flight: &MachineFlight, s: f64) -> &Modes {
        if !(core::mem::take(&mut self.fresh) && self.modes.s == s) {
            flight.at(s, &mut self.modes);
        }
        &self.modes
    }
}

/// A guard over a window, by powers of the part of the window that has passed.
#[derive(Clone, Copy, Debug)]
pub(super) struct GuardPolynomial {
    /// Its coefficients, with the bound of the remainder in the last place. Zeros at the beginning that are known are not
    /// divided out.
    pub(super) p: [f64; TERMS],
    /// How many of them there are.
    pub(super) known: usize,
    /// A bound of the rounding error of its value.
    pub(super) error: f64,
    /// The size of its terms.
    pub(super) size: f64,
    /// A point before which it is positive even with its remainder, if it may have a zero.
    pub(super) from: Option<f64>,
}

impl GuardPolynomial {
    pub(super) fn new(p: [f64; TERMS], known: usize, error: f64, size: f64) -> Self {
        let mut of = Self { p, known, error, size, from: None };
        // contacts on which the flight begins are divided out; a derivative that is zero within rounding is zero, and the
        // next one decides
        while of.known > 0 && of.known < 4 && of.p[of.known] <= 0.0 && -of.p[of.known] <= 64.0 * f64::EPSILON * of.size
        {
            of.known += 1;
        }
        of
    }

    /// Whether it is positive over the window, by a quick test; `false` may be wrong.
    pub(super) fn is_positive(&self) -> bool {
        is_positive(&self.beside(-1.0))
    }

    /// The polynomial with its bound of the remainder added or subtracted, and known zeros divided out.
    fn beside(&self, sign: f64) -> [f64; TERMS] {
        let mut q = self.p;
        q[ORDER] *= sign;
        if self.known > 0 {
            q.rotate_left(self.known);
            q[TERMS - self.known..].fill(0.0);
        } else {
            q[0] += sign * self.error;
        }
        q
    }

    /// The polynomial whose slope is that of the guard, with known zeros divided out and without them with its remainder.
    fn steep(&self) -> [f64; TERMS] {
        if self.known > 0 { self.beside(1.0) } else { self.p }
    }
}

/// The first zero of a guard before the time `until`, in at most `steps` windows. `touches` receives what touches zero
/// before.
pub(crate) fn first_event(
    flight: &MachineFlight,
    until: f64,
    steps: u32,
    buffers: &mut Buffers,
    touches: &mut Vec<Touch>,
) -> Found {
    let (mut known, mut touched) = (core::mem::take(&mut buffers.known), core::mem::take(&mut buffers.touched));
    known.clear();
    known.extend(flight.guards.iter().map(|guard| guard.known));
    // a contact on which the flight begins does not count as a touch
    touched.clear();
    touched.extend(flight.guards.iter().map(|guard| guard.known > 0));
    buffers.fresh = false;
    let found = search(flight, until, steps, buffers, touches, &mut known, &mut touched);
    (buffers.known, buffers.touched) = (known, touched);
    buffers.fresh = matches!(found, Found::Zero { s, .. } if s == buffers.modes.s);
    found
}

fn search(
    flight: &MachineFlight,
    until: f64,
    mut steps: u32,
    buffers: &mut Buffers,
    touches: &mut Vec<Touch>,
    known: &mut [usize],
    touched: &mut [bool],
) -> Found {
    let fastest = flight.structure.fastest();
    let series = flight.structure.windows.first();
    let mut s = 0.0;
    let mut reach = 1.0;
    let mut on_track = false;
    while steps > 0 {
        steps -= 1;
        if s >= until {
            return Found::NoneBefore(until);
        }
        let mut here = false;
        if let Some(series) = series
            && reach == 1.0
            && fastest > 0.0
        {
            // windows without a zero are passed, and a plain zero is found, without the closed form
            if !on_track {
                flight.at(s, &mut buffers.modes);
                buffers.track.settle(flight, &buffers.modes);
                here = true;
            }
            on_track = false;
            let blocked = buffers.track.pass(flight, until, &mut steps, &mut buffers.polynomials);
            if buffers.track.s > s {
                s = buffers.track.s;
                touched.fill(false);
                here = false;
            }
            let Some(part) = blocked else { continue };
            let first = first_of(&mut buffers.polynomials);
            let Some((near, _)) = first else {
                // no zero after all
                on_track = part >= 1.0;
                buffers.track.step(series);
                s = if on_track { buffers.track.s } else { until };
                continue;
            };
            let standing = flight.guards.iter().any(|guard| guard.recovery.is_some());
            if !standing && let Some(found) = certain(flight, series.length * part, s, near, buffers) {
                return found;
            }
        }
        // after the beginning of the flight a contact on which it began is a guard as any other
        if s > 0.0 {
            known.fill(0);
        }
        if !here {
            flight.at(s, &mut buffers.modes);
            if series.is_some() {
                buffers.track.settle(flight, &buffers.modes);
            }
        }
        let surfaces = flight.guards.iter().filter_map(|guard| guard.recovery);
        // a surface that has recovered does not shorten the window
        let rate = surfaces
            .filter(|surface| surface.rate * s < 40.0)
            .fold(fastest, |rate, surface| rate.max(surface.rate * crate::system::decay(surface.rate * s / 9.0).0));
        let window = (if rate > 0.0 { REACH / rate } else { 1e150 } * reach).min((until - s) * 1.001 + 1e-300);
        match series {
            Some(_) => {
                buffers.track.energies(flight);
            }
            None => expand(flight, window, s, buffers),
        }
        buffers.polynomials.clear();
        for (g, known) in known.iter_mut().enumerate() {
            let of = match series {
                Some(series) => buffers.track.polynomial(flight, g, series, window, *known, &buffers.modes),
                None => polynomial(flight, g, window, s, buffers, *known),
            };
            *known = of.known;
            if s > 0.0 && of.p[0] > 4.0 * of.error {
                touched[g] = false;
            }
            buffers.polynomials.push(of);
        }
        let Some((near, g)) = first_of(&mut buffers.polynomials) else {
            s += window;
            reach = (reach * 1.5).min(1.0);
            continue;
        };
        if let Some(found) = certain(flight, window, s, near, buffers) {
            return found;
        }
        let GuardPolynomial { p, error, .. } = buffers.polynomials[g];
        let remainder = p[ORDER];
        if remainder <= error || window * 0.01 <= f64::EPSILON * s {
            // a touch within rounding, or a zero that cannot be told from one
            let (touch, after) = lowest(&p, near);
            let depth = value(&without_remainder(&p), touch).0;
            if depth < -error - remainder {
                let at = refine(
                    flight,
                    g,
                    (s + near * window, s + touch * window),
                    None,
                    RESOLUTION * window,
                    &mut buffers.modes,
                );
                return Found::Zero { s: at, guards: vec![g] };
            }
            // one touch until the guard is clearly positive again
            if !touched[g] {
                touches.push(Touch { s: s + touch * window, guard: g });
            }
            touched[g] = true;
            let next = s + (touch + after).min(1.0) * window;
            s = if next > s { next } else { s * (1.0 + f64::EPSILON) + f64::MIN_POSITIVE };
            reach = 1.0;
        } else if near > 0.25 {
            s += near * window * (1.0 - 1e-3);
            reach = (0.7 * reach).max(1e-12);
        } else {
            // the window is too long for the bound
            reach *= 0.4;
        }
    }
    Found::NoneBefore(s)
}

/// The first point where one may be zero, and its guard.
fn first_of(polynomials: &mut [GuardPolynomial]) -> Option<(f64, usize)> {
    let mut first: Option<(f64, usize)> = None;
    for (g, of) in polynomials.iter_mut().enumerate() {
        of.from = first_zero(&of.beside(-1.0));
        if let Some(t) = of.from
            && first.is_none_or(|(least, _)| t < least)
        {
            first = Some((t, g));
        }
    }
    first
}

/// The zero, if it is proven that there is exactly one near `near` for each guard that may be the first.
fn certain(flight: &MachineFlight, window: f64, s: f64, near: f64, buffers: &mut Buffers) -> Option<Found> {
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
        // a first approximation: nearly exact by the series of all powers
        let guess = || {
            let (t, curvature) = crossing_of(&without_remainder(&of.p), *from, to);
            match flight.structure.windows.first() {
                Some(series) if flight.guards[g].recovery.is_none() => {
                    buffers.track.sharp(flight, series, g, t * window / series.length)
                }
                _ => (s + t * window, curvature / (window * window)),
            }
        };
        let at = if of.known > 0 {
            let bracket = (*from, to);
            on_polynomial(&of.beside(0.0), window, bracket).unwrap_or_else(|| {
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
    Some(Found::Zero { s: best, guards })
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

fn without_remainder(p: &[f64; TERMS]) -> [f64; TERMS] {
    let mut q = *p;
    q[ORDER] = 0.0;
    q
}

/// The lowest point of a polynomial after `from`, and how far behind it the polynomial has risen above rounding.
fn lowest(p: &[f64; TERMS], from: f64) -> (f64, f64) {
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
fn refine(
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

/// Expands all modes at the current time, with bounds of their ninth and tenth derivatives over the window.
fn expand(flight: &MachineFlight, window: f64, s: f64, buffers: &mut Buffers) {
    let (structure, drive) = (&flight.structure, &flight.drive);
    let count = structure.modes.len();
    let Buffers { modes, terms, ninth, tenth, turned, .. } = buffers;
    terms.clear();
    terms.resize(count * (TERMS + 1), 0.0);
    ninth.clear();
    tenth.clear();
    // without modes: the energy of all directions together bounds each
    let energy = flight.dense().map(|dense| {
        dense.coefficients(&modes.moved, &modes.v, s, TERMS + 1, terms);
        (dot(&modes.v, &modes.v) + dot(&modes.moved, &dense.stiffness.apply(&modes.moved))).max(0.0).sqrt()
    });
    for (i, mode) in structure.modes.iter().enumerate() {
        turned.clear();
        let turns = modes.turned.iter().map(|turned| (turned.sin, turned.cos));
        turned.extend(crate::regime::turned(drive.of(i), turns));
        let (y, v) = (modes.moved[i], modes.v[i]);
        if energy.is_none() {
            let c = &mut terms[i * (TERMS + 1)..(i + 1) * (TERMS + 1)];
            flight.coefficients(i, y, v, s, turned, c);
        }
        // bounds: w_k of |y^(k)| window^k / k!
        let (mut ramp, mut steady) = (drive.ramp[i].abs(), drive.steady[i].abs());
        if energy.is_some() {
            // the forces on all directions together
            ramp = drive.ramp.iter().map(|ramp| ramp.abs()).sum();
            steady = drive.steady.iter().map(|steady| steady.abs()).sum();
            for (h, own) in turned.iter_mut().enumerate() {
                let of = drive.harmonics.iter().skip(h).step_by(drive.rates.len());
                *own = (of.map(|(a, b)| a.abs() + b.abs()).sum(), 0.0);
            }
        }
        let mut push = ramp * (s + window);
        let mut shifted = y;
        if mode.k > 0.0 && energy.is_none() {
            shifted -= drive.steady[i] / mode.k;
        } else {
            push += steady;
        }
        let mut swing = 0.0;
        for (a, b) in turned.iter() {
            swing += a.abs() + b.abs();
        }
        push += swing;
        let energy = energy.unwrap_or_else(|| (v * v + mode.k * shifted * shifted).sqrt());
        let speed = energy + push * window;
        let square = window * window;
        let mut two = speed * window;
        let mut three = 0.5 * square * (2.0 * mode.d * speed + mode.omega * speed + push);
        let mut one;
        // p_k of |p^(k)| window^k / k!
        let mut pushed: [f64; ORDER] = [0.0; ORDER];
        for ((a, b), w) in turned.iter().zip(&drive.rates) {
            let mut size = a.abs() + b.abs();
            let mut k = 1.0;
            for place in &mut pushed {
                *place += size;
                size *= w * window / k;
                k += 1.0;
            }
        }
        pushed[1] += ramp * window;
        let mut k = 1.0;
        for place in &pushed[1..] {
            // from w_k, w_{k+1} to w_{k+2}
            (one, two) = (two, three);
            three = (2.0 * mode.d * window * (k + 1.0) * two + mode.k * square * one + square * place)
                / ((k + 1.0) * (k + 2.0));
            k += 1.0;
        }
        // now k = ORDER: three bounds the derivative of order ORDER + 1
        ninth.push(two);
        tenth.push(three);
    }
}

/// The polynomial of a guard over the window.
fn polynomial(
    flight: &MachineFlight,
    g: usize,
    window: f64,
    s: f64,
    buffers: &Buffers,
    known: usize,
) -> GuardPolynomial {
    let (function, start) = (&flight.structure.guards[g].function, &flight.guards[g]);
    let mut p = [0.0; TERMS];
    let mut remainder = 0.0;
    let mut size = 0.0;
    let real = |k: usize| f64::from(u32::try_from(k).unwrap_or(0));
    for i in 0..buffers.ninth.len() {
        let c = &buffers.terms[i * (TERMS + 1)..(i + 1) * (TERMS + 1)];
        let (a, b) = (function.position[i], function.velocity[i]);
        if a != 0.0 {
            for (sum, c) in p.iter_mut().zip(c) {
                *sum += a * c;
            }
            remainder += a.abs() * buffers.ninth[i];
            size += a.abs() * (c[1] * window).abs().max((c[2] * window * window).abs());
        }
        if b != 0.0 {
            for k in 0..ORDER {
                p[k] += b * real(k + 1) * c[k + 1];
            }
            remainder += b.abs() * buffers.tenth[i] * real(ORDER + 1) / window;
            size += b.abs() * c[1].abs().max((c[2] * window).abs());
        }
    }
    p[1] += function.signal.ramp;
    for ((a, b), (turned, w)) in
        flight.harmonics(g).iter().zip(buffers.modes.turned.iter().zip(&flight.structure.rates))
    {
        if *a == 0.0 && *b == 0.0 {
            continue;
        }
        let (mut now, mut next) = (a * turned.cos + b * turned.sin, w * (b * turned.cos - a * turned.sin));
        let mut bound = a.abs() + b.abs();
        size += bound;
        for (k, sum) in p.iter_mut().enumerate().take(ORDER) {
            *sum += now;
            (now, next) = (next, -w * w * now / (real(k + 1) * real(k + 2)));
            bound *= w * window / real(k + 1);
        }
        remainder += bound;
    }
    if let Some(surface) = start.recovery {
        let mut term = surface.size * crate::system::decay(surface.rate * s).0;
        size += term;
        let mut bound = term;
        for (k, sum) in p.iter_mut().enumerate().take(ORDER) {
            *sum += term;
            term *= -surface.rate / real(k + 1);
            bound *= surface.rate * window / real(k + 1);
        }
        remainder += bound;
    }
    let (value, _, error) = flight.guard(g, &buffers.modes);
    p[0] = if known > 0 { 0.0 } else { value };
    let mut power = 1.0;
    for c in p.iter_mut().take(ORDER) {
        *c *= power;
        power *= window;
    }
    p[ORDER] = remainder;
    GuardPolynomial::new(p, known, error, size + p[0].abs())
}

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
//!
//! Where fast modes have no part in it a window is longer (`expansion`). Before all this, most first zeros are found at less cost as
//! plain crossings between samples of the guards (`crossing`).

use super::crossing::plain_crossing;
use super::flight::MachineFlight;
use super::found::{Buffers, Found, Guards, Touch};
use super::guard_polynomial::{GuardPolynomial, HIGHEST, ORDER, first_of};
use super::polynomial::{RESOLUTION, value};
use super::zero::{certain, lowest, refine, without_remainder};
use crate::math::dot;
use crate::regime::{REACH, Window};

/// The first zero of a guard before the time `until`, in at most `steps` windows. `touches` receives what touches zero
/// before.
pub(crate) fn first_event(
    flight: &MachineFlight,
    until: f64,
    steps: u32,
    buffers: &mut Buffers,
    touches: &mut Vec<Touch>,
) -> Found {
    if let Some((s, guard)) = plain_crossing(flight, until, steps, &mut buffers.sampling, &mut buffers.modes) {
        buffers.fresh = true;
        return Found::Zero { s, guards: Guards::One([guard]) };
    }
    by_windows(flight, until, steps, buffers, touches)
}

/// The same by windows, also where a guard only touches zero; apart, because few zeros are found so.
#[inline(never)]
fn by_windows(
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
    let mut found = match closing_already(flight, buffers, &mut touched) {
        Some(guard) => Found::Zero { s: 0.0, guards: Guards::One([guard]) },
        None => search(flight, until, steps, buffers, touches, &mut known, &mut touched),
    };
    (buffers.known, buffers.touched) = (known, touched);
    if let Found::Zero { s, guards } = &mut found {
        buffers.fresh = *s == buffers.modes.s;
        if flight.guards.len() > guards.len() {
            together(flight, *s, guards, buffers);
        }
    }
    found
}

/// A rigid stop whose gap is zero at the beginning and closes, as after an impact elsewhere. Beside others that are zero and open
/// no window would tell it apart from them. One that has just been left is zero by rounding only: it is not touched.
fn closing_already(flight: &MachineFlight, buffers: &mut Buffers, touched: &mut [bool]) -> Option<usize> {
    let mut zero = (0..flight.guards.len()).filter(|g| {
        let guard = &flight.guards[*g];
        guard.known < 2 && guard.value <= LEFT * f64::EPSILON * guard.size && flight.structure.guards[*g].strikes
    });
    let mut next = zero.next();
    if next.is_some() {
        flight.at(0.0, &mut buffers.modes);
    }
    while let Some(g) = next {
        let rate = flight.guard(g, &buffers.modes).1;
        if rate < 0.0 && flight.guards[g].value <= 0.0 {
            return Some(g);
        }
        touched[g] |= rate > 0.0;
        next = zero.next();
    }
    None
}

/// A gap below so many rounding errors of its terms is zero at the beginning of a flight.
const LEFT: f64 = 4.0;

/// A guard that only touches zero and goes below it by no more than this number of its rounding errors over a window decides
/// nothing there.
const FLAT: f64 = 8.0;

/// Zeros before this part of a window are searched for in a shorter one, because those of several guards that are so near each
/// other are not told apart in it; a window of this length is not made shorter.
const SHORT: f64 = 1e-9;
const SHORTEST: f64 = 1e-280;
/// The search goes on by at least this part of a window.
const CREEPS: f64 = 1e-6;

/// How many rounding errors of their values and of the time may lie between zeros of guards at one time.
const TOGETHER: f64 = 32.0;
/// A guard that is larger than so many of its rounding errors is clearly not zero.
const OPEN: f64 = 4.0;

/// Adds the guards that are zero at the same time within rounding errors.
fn together(flight: &MachineFlight, s: f64, guards: &mut Guards, buffers: &mut Buffers) {
    if !core::mem::replace(&mut buffers.fresh, true) {
        flight.at(s, &mut buffers.modes);
    }
    let later = (s * flight.structure.fastest()).min(1.0);
    // the rounding error of a guard, which makes the time of its zero uncertain
    let uncertain = |g: usize| {
        let (value, rate, error) = flight.guard(g, &buffers.modes);
        let of = &flight.structure.guards[g].function;
        // by how much it may differ between equal structures that move alike
        let motion = flight.size(of).max((dot(&of.position, &of.position) * buffers.square).sqrt());
        // one that is exact at the beginning has these errors when the others have had time to move it
        let share = if flight.begins_exactly(g) { later } else { 1.0 };
        let rounding = error + f64::EPSILON * share * motion;
        (value, rate, rounding)
    };
    // that of a guard that grazes is no measure for others
    let fastest = flight.structure.fastest();
    let most = 1e3 * f64::EPSILON * (s + if fastest > 0.0 { 1.0 / fastest } else { buffers.longest });
    let time = |g: &usize| {
        let (_, rate, rounding) = uncertain(*g);
        rounding / rate.abs()
    };
    let of_first = guards.iter().map(time).fold(f64::EPSILON * s, f64::max).min(most);
    let strikes = |g: &usize| flight.structure.guards[*g].strikes;
    let also = |g: &usize| {
        let (value, rate, rounding) = uncertain(*g);
        if rate >= 0.0 {
            // a rigid stop on which the structure has rested is not left yet, and pushes at an impact elsewhere
            return strikes(g) && flight.guards[*g].known > 1 && value <= rounding && guards.iter().any(strikes);
        }
        let own = rounding / -rate;
        // a gap that was clearly open at the beginning and is none now has closed, however slowly
        let closed = flight.guards[*g].known == 0 && flight.guards[*g].value > OPEN * rounding;
        let uncertain = if closed { own } else { own.min(most.max(later * own)) };
        value <= TOGETHER * (uncertain + of_first) * -rate
    };
    let others: Vec<usize> = (0..flight.guards.len()).filter(|g| !guards.contains(g)).filter(also).collect();
    if !others.is_empty() {
        let mut all = [&guards[..], &others].concat();
        all.sort_unstable();
        *guards = Guards::Several(all);
    }
}

/// The first zero of the guards that fall below zero by more than their errors, if the guard `g` does: one that has been touched also
/// later in the window.
fn below(
    flight: &MachineFlight,
    (s, window): (f64, f64),
    (g, touched): (usize, bool),
    buffers: &mut Buffers,
) -> Option<(f64, usize)> {
    let zero = |guard: usize, buffers: &mut Buffers| {
        let of = buffers.polynomials[guard];
        let GuardPolynomial { p, error, from, .. } = of;
        let from = from?;
        let (touch, _) = lowest(&p, from);
        let falls = value(&without_remainder(&p), touch).0 < -error - p[ORDER];
        let below = if falls { touch } else { of.below(FLAT).filter(|_| touched && guard == g)? };
        let bracket = (s + from * window, s + below * window);
        Some(refine(flight, guard, bracket, None, RESOLUTION * window, &mut buffers.modes))
    };
    let mut first = (zero(g, buffers)?, g);
    for other in (0..flight.guards.len()).filter(|other| *other != g) {
        // one that is zero at the beginning for certain is decided by the terms after that
        let of = &buffers.polynomials[other];
        let is_before = of.known == 0 && of.from.is_some_and(|from| s + from * window < first.0);
        if is_before && let Some(at) = zero(other, buffers).filter(|at| *at < first.0) {
            first = (at, other);
        }
    }
    Some(first)
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
    let series = flight.structure.windows().first();
    let windows = flight.structure.windows();
    let decays = windows.get(1).is_some_and(Window::leaves_out_decays);
    let quiet = flight.quiet_time(HIGHEST);
    let mut s = 0.0;
    let mut reach = 1.0;
    while steps > 0 {
        steps -= 1;
        if s >= until {
            return Found::NoneBefore(until);
        }
        let is_quiet = s < 0.999 * quiet;
        flight.at(s, &mut buffers.modes);
        if series.is_some() {
            buffers.expansion.settle(flight, &buffers.modes);
        }
        // close to a zero no long window is positive
        if windows.len() > 1
            && (reach == 1.0 || decays)
            && fastest > 0.0
            && !is_quiet
            && !buffers.stalled
            && let Some(length) = buffers.expansion.long_window(flight, &buffers.modes, until - s)
        {
            s += length;
            touched.fill(false);
            continue;
        }
        // after the beginning of the flight a contact on which it began is a guard as any other
        if s > 0.0 {
            known.fill(0);
        }
        let surfaces = flight.guards.iter().filter_map(|guard| guard.recovery);
        // a surface that has recovered does not shorten the window
        let rate = surfaces
            .filter(|surface| surface.rate * s < 40.0)
            .fold(fastest, |rate, surface| rate.max(surface.rate * crate::system::decay(surface.rate * s / 9.0).0));
        let rest = (until - s) * 1.001 + 1e-300;
        // free bodies have no window of their own
        let mut window = if rate > 0.0 { (REACH / rate * reach).min(rest) } else { rest.min(1e150) * reach };
        if is_quiet {
            window = window.min(quiet - s);
        }
        if series.is_none() {
            buffers.dense.expand(flight, &buffers.modes, window);
        }
        buffers.polynomials.clear();
        for (g, known) in known.iter_mut().enumerate() {
            let of = match series {
                Some(series) => buffers.expansion.polynomial(flight, g, series, window, *known, &buffers.modes),
                None => buffers.dense.polynomial(flight, g, window, *known, &buffers.modes),
            };
            *known = of.known;
            if s > 0.0 && of.p[0] > 4.0 * of.error {
                touched[g] = false;
            }
            // a contact that is only just left, by a power of the time, is zero within rounding for a while
            let larger = if buffers.stalled {
                let w = &flight.structure.guards[g].function.position;
                f64::EPSILON * (dot(w, w) * buffers.square).sqrt()
            } else {
                0.0
            };
            let passes = is_quiet && flight.guards[g].known > HIGHEST
                || touched[g] && of.is_flat(FLAT, larger)
                || of.is_constant();
            buffers.polynomials.push(if passes { GuardPolynomial::passed() } else { of });
        }
        let Some((near, g)) = first_of(&mut buffers.polynomials) else {
            s += window;
            // of free bodies: the window has been shortened by powers of ten, and grows back as fast
            reach = (reach * if rate == 0.0 && reach < 1e-3 { 100.0 } else { 1.5 }).min(1.0);
            continue;
        };
        // the windows of free bodies are not as short as their motion
        let shortens = rate == 0.0 && window > SHORTEST;
        let of = &buffers.polynomials[g];
        // nor is what has just been left and rises from zero within rounding
        let rises = touched[g] && of.p[1] > 0.0 && of.p[0] > -FLAT * of.error;
        if shortens && near < SHORT && (of.beside(-1.0)[0] > 0.0 || rises) {
            reach *= 1e3 * RESOLUTION.max(near);
            continue;
        }
        if let Some(found) = certain(flight, window, s, near, buffers) {
            return found;
        }
        let GuardPolynomial { p, error, .. } = buffers.polynomials[g];
        let remainder = p[ORDER];
        if remainder <= error || window * 0.01 <= f64::EPSILON * s {
            // a touch within rounding, or a zero that cannot be told from one
            let (touch, after) = lowest(&p, near);
            if let Some((at, guard)) = below(flight, (s, window), (g, touched[g]), buffers) {
                return Found::Zero { s: at, guards: Guards::One([guard]) };
            }
            // one touch until the guard is clearly positive again; from there on what is flat is passed
            let again = core::mem::replace(&mut touched[g], true);
            if shortens && again && error > 0.0 && touch + after < CREEPS && window * 0.01 > f64::EPSILON * s {
                // it rises, and may fall again within this window: it is passed over one in which it is flat
                reach *= 0.1;
                continue;
            }
            if !again {
                touches.push(Touch { s: s + touch * window, guard: g });
            }
            let others = buffers.polynomials.iter().enumerate().filter(|(other, _)| !touched[*other]);
            let first = others.filter_map(|(_, of)| of.from).filter(|from| *from > near).fold(1.0, f64::min);
            // where it is zero already the window begins again: at the beginning what is known of the others stays known
            let onward = if again {
                touch + after
            } else if p[0] <= 4.0 * error {
                0.0
            } else {
                touch
            };
            let next = s + onward.min(0.999 * first) * window;
            // at least by the smallest number, so that the search goes on
            s = if next > s || !again { next } else { s * (1.0 + f64::EPSILON) + f64::MIN_POSITIVE };
            reach = 1.0;
        // positive up to there: the next window begins just before, where its bound is tighter
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

#[cfg(test)]
mod tests {
    use super::super::crossing::is_the_same_without_vectors;
    use super::*;
    use crate::arc::{Begin, GapStart};
    use crate::machine::{Machine, MachineParts};
    use crate::regime::{ContactState, GuardKind, Normal, Structure};
    use std::sync::Arc;

    /// Plain crossings are the first zeros that the search finds, for starts on a stop and off it, and nearly all zeros are
    /// plain crossings.
    #[test]
    fn plain_crossings_are_first_zeros() {
        let parts = MachineParts::new(["a", "b", "c"])
            .with_mass(0, 1.0)
            .with_mass(1, 0.6)
            .with_mass(2, 0.2)
            .with_link(&[1.0, -1.0, 0.0], 1.0, 0.05)
            .with_link(&[0.0, 1.0, 0.0], 2.0, 0.03)
            .with_link(&[0.0, 1.0, -1.0], 90.0, 0.1)
            .with_frequency(1.7)
            .with_force(1, 1, 0.3, 1.0)
            .with_force(0, 2, 0.2, 0.0)
            .with_rigid_stop("wall", &[1.0, 0.0, 0.0], 0.4, 0.8)
            .with_rigid_stop("between", &[0.0, -1.0, 1.0], 0.3, 0.8);
        let machine = Machine::new(parts).unwrap();
        let normal = Normal::new(&machine);
        let structure = Arc::new(Structure::new(&machine, &normal, &[ContactState::Open; 2]).unwrap());
        let mut state = 5_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            f64::from(u32::try_from(state >> 33).unwrap()) / f64::from(1_u32 << 31) * 2.0 - 1.0
        };
        let (mut plain, mut all) = (0, 0);
        for case in 0..4000 {
            let on_stop = case % 2 == 0;
            let fast = if case % 3 == 0 { 0.1 } else { 1.0 };
            let q = [if on_stop { 0.4 } else { 0.39 * random() }, 0.2 * random(), 0.05 * random()];
            let rate = [if on_stop { -fast * random().abs() } else { random() }, random(), random()];
            let (x, v) = (normal.to_normal(&q), normal.to_normal(&rate));
            let phase: f64 = 3.0 * random();
            let turns = [phase.sin_cos(), (2.0 * phase).sin_cos()];
            let begin = Begin { x: &x, v: &v, set: &[], turns: &turns };
            let known = |kind| (usize::from(on_stop && kind == GuardKind::Gap(0)), None);
            let gap = |j: usize| {
                let (w, wall) = (&normal.directions[j], normal.walls[j].constant);
                let way: f64 = w.iter().zip(&x).map(|(w, x)| w * x).sum();
                GapStart { gap: wall - way, size: wall.abs() + way.abs(), swing: 0.0, sharp: false }
            };
            let flight = MachineFlight::new(structure.clone(), begin, gap, Some(known));
            let mut buffers = Buffers::default();
            let crossing = plain_crossing(&flight, 30.0, 100, &mut buffers.sampling, &mut buffers.modes);
            let modes = buffers.modes.clone();
            assert!(is_the_same_without_vectors(&flight, &mut buffers.sampling), "case {case}");
            let mut touches = Vec::new();
            let searched = by_windows(&flight, 30.0, 10_000, &mut buffers, &mut touches);
            all += u32::from(matches!(searched, Found::Zero { .. }));
            let Some((s, guard)) = crossing else { continue };
            plain += 1;
            let Found::Zero { s: wanted, guards: same } = searched else { panic!("case {case}: no zero, {s} found") };
            assert!(touches.is_empty() && same[..] == [guard], "case {case}: {guard} {same:?}");
            // a slow approach has an uncertain time
            let (_, speed, error) = flight.guard(guard, &buffers.modes);
            let allowed = 8.0 * error / speed.abs() + 32.0 * f64::EPSILON * (1.0 + s);
            assert!((s - wanted).abs() < allowed, "case {case}: {s} {wanted}, {allowed:e} allowed");
            flight.at(s, &mut buffers.modes);
            for (one, other) in modes.moved.iter().zip(&buffers.modes.moved).chain(modes.v.iter().zip(&buffers.modes.v))
            {
                assert!((one - other).abs() < 1e-13, "case {case}: {one} {other}");
            }
        }
        assert!(all > 3900 && plain > all - 100, "{plain} of {all}");
    }
}

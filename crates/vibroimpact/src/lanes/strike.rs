//! The contact at the end of a step that may hold one: found, refined to the last bits, and proven to be the first.
//!
//! 1. The root of the quintic interpolant of the step, from the values at its quarters by Halley's iteration: a guess, good to the error
//!    of the interpolant.
//! 2. The state there, the only one that a flight needs in full precision: by the closed form, or, damped, composed of the
//!    propagator to the nearest whole step and of the one over the rest ([`Stride`]).
//! 3. The root of the Taylor polynomial of degree 6 about it, which the equation of motion gives for nothing. The
//!    guess being within $`2^{-8}/\mu`$, what is left out is below $`2^{-68}`$ of the position and $`2^{-57}`$ of the speed.
//! 4. A [hull](super::hull) over the arc from the beginning of the step to the contact found: no other lies before it.
//!
//! Where one of these fails the answer is no, and the step is halved.

use super::hull::{End, MARGIN};
use super::stride::{Propagators, Row, State, Stride};
use crate::math::{Lane, Mask};

/// A launch: the state a flight begins with.
#[derive(Clone, Copy, Debug)]
pub(super) struct Launch<L> {
    pub(super) x: L,
    pub(super) v: L,
    pub(super) sin: L,
    pub(super) cos: L,
}

/// A contact found.
#[derive(Clone, Copy)]
pub(super) struct Strike<L: Lane> {
    /// Whether the rest holds.
    pub(super) proven: L::Mask,
    /// Time since the launch.
    pub(super) time: L,
    /// Speed of arrival.
    pub(super) velocity: L,
    /// +1 at the upper stop, -1 at the lower one.
    pub(super) side: L,
}

/// The stop a step may strike, seen as the upper one.
#[derive(Clone, Copy)]
struct Mirror<L> {
    two_stops: bool,
    side: L,
    gap: L,
}

impl<L: Lane> Mirror<L> {
    #[inline(always)]
    fn of(self, y: L) -> L {
        if self.two_stops { y * self.side } else { y }
    }
}

/// How far the guess may be from the contact, over the slowest time $`1/\mu`$.
const NEAR: f64 = 1.0 / 256.0;
/// Gentler arrivals than this, while being slowed down, are left to the careful search, which knows about rounding.
const GENTLE: f64 = 1e-3;
/// With damping, where the state is composed of two: it costs a few last places of the position.
const GENTLE_DAMPED: f64 = 1.0 / 64.0;
/// The same while being sped up, when the stop is passed for certain.
const SLOWEST: f64 = 1e-6;

/// Where a contact is expected.
#[derive(Clone, Copy)]
pub(super) struct Guess<L> {
    /// Time since the launch.
    pub(super) time: L,
    mirror: Mirror<L>,
}

/// The motion at the time of a guess, seen from the stop.
#[derive(Clone, Copy)]
pub(super) struct Approach<L> {
    /// Distance left to the stop, in full precision.
    room: L,
    state: Launch<L>,
}

impl<L: Lane> Guess<L> {
    /// To be filled in.
    #[inline(always)]
    pub(super) fn nowhere() -> Self {
        let zero = L::splat(0.0);
        Self { time: zero, mirror: Mirror { two_stops: false, side: zero, gap: zero } }
    }
}

impl<L: Lane> Approach<L> {
    /// To be filled in.
    #[inline(always)]
    pub(super) fn nowhere() -> Self {
        let zero = L::splat(0.0);
        Self { room: zero, state: Launch { x: zero, v: zero, sin: zero, cos: zero } }
    }
}

impl<L: Lane> Strike<L> {
    /// To be filled in.
    #[inline(always)]
    pub(super) fn nowhere() -> Self {
        let zero = L::splat(0.0);
        Self { proven: zero.less(zero), time: zero, velocity: zero, side: zero }
    }
}

impl Stride {
    /// The first contact in the step of length `h` between two states, if it can be proven.
    #[inline(always)]
    pub(super) fn strike<L: Lane>(
        &self,
        launch: &Launch<L>,
        h: L,
        (from, to): (&State<L>, &State<L>),
        margin: L,
        propagators: &impl Propagators<L>,
    ) -> Strike<L> {
        let guess = self.guess(h, from, to);
        let approach = self.approach(launch, &guess, propagators);
        self.polish(from, margin, &guess, &approach)
    }

    /// 1. Where the interpolant of the step meets a stop.
    #[inline(always)]
    pub(super) fn guess<L: Lane>(&self, h: L, from: &State<L>, to: &State<L>) -> Guess<L> {
        let (begin, end) = (self.end(from), self.end(to));
        let (one, upper) = (L::splat(1.0), L::splat(self.gap[0]));
        let mirror = if self.two_stops {
            let lower = to.x.less(L::splat(-self.gap[1]));
            let (side, gap) = (L::choose(lower, -one, one), L::choose(lower, L::splat(self.gap[1]), upper));
            Mirror { two_stops: true, side, gap }
        } else {
            Mirror { two_stops: false, side: one, gap: upper }
        };
        Guess { time: from.s + h * quintic_root(h, &begin, &end, mirror), mirror }
    }

    /// 2. The motion there.
    #[inline(always)]
    pub(super) fn approach<L: Lane>(
        &self,
        launch: &Launch<L>,
        guess: &Guess<L>,
        propagators: &impl Propagators<L>,
    ) -> Approach<L> {
        let mirror = guess.mirror;
        let launch = launch.mirrored(mirror);
        if self.drag == 0.0 {
            let (room, state) = self.carried(&launch, &self.whole(guess.time), mirror.gap);
            return Approach { room, state };
        }
        let nearest = (guess.time * L::splat(1.0 / self.pace.h)).nearest();
        let (room, node) = self.carried(&launch, &propagators.node(nearest), mirror.gap);
        let rest = self.rest(guess.time - nearest * L::splat(self.pace.h));
        let (_, state) = self.carried(&node, &rest, mirror.gap);
        Approach { room: room - self.moved(&node, &rest), state }
    }

    /// 3. The contact, and 4. whether it is proven to be the first since `from`.
    #[inline(always)]
    pub(super) fn polish<L: Lane>(
        &self,
        from: &State<L>,
        margin: L,
        guess: &Guess<L>,
        approach: &Approach<L>,
    ) -> Strike<L> {
        let Approach { room: g, state: Launch { x, v: p, sin, cos } } = *approach;
        let (drag, beta, mirror) = (L::splat(self.drag), L::splat(self.beta), guess.mirror);
        let damped = self.drag != 0.0;
        let q = if damped { (sin - x) - drag * p } else { sin - x };
        let j = if damped { (beta * cos - p) - drag * q } else { beta * cos - p };
        let force = L::splat(self.beta * self.beta) * sin;
        let snap = if damped { -(force + q) - drag * j } else { -(force + q) };
        let force_rate = L::splat(self.beta * self.beta * self.beta) * cos;
        let crackle = if damped { -(force_rate + j) - drag * snap } else { -(force_rate + j) };

        let pop = L::splat(self.beta * self.beta) * force - snap;
        let pop = if damped { pop - drag * crackle } else { pop };

        // g = p t + q t^2/2 + j t^3/6 + ... + pop t^6/720: the series of its inverse to the third order, then two
        // steps of Newton's with the slope found there
        let half = L::splat(0.5);
        let (j6, snap24) = (L::splat(1.0 / 6.0) * j, L::splat(1.0 / 24.0) * snap);
        let (crackle120, pop720) = (L::splat(1.0 / 120.0) * crackle, L::splat(1.0 / 720.0) * pop);
        let over = L::splat(1.0) / p;
        let (first, bend, twist) = (g * over, q * over, j6 * over);
        let bent = half * (bend * first);
        let series = first - first * (bent - first * (half * (bend * bend) - twist * first));
        let taylor = [p, half * q, j6, snap24, crackle120, pop720];
        // the slope there is p (1 + turn)
        let tt = series * series;
        let turn = bend * series + tt * (L::splat(3.0) * twist + (L::splat(4.0) * (snap24 * over)) * series);
        let newton = over * ((L::splat(1.0) - turn) + turn * turn);
        let correction = (g - sum(taylor, series)) * newton;
        let once = series + correction;
        let last = (g - sum(taylor, once)) * newton;
        let shift = once + last;
        let time = guess.time + shift;
        let ss = shift * shift;
        let velocity = (p + q * shift)
            + ss * ((L::splat(3.0) * j6 + L::splat(4.0) * (snap24 * shift))
                + ss * (L::splat(5.0) * crackle120 + L::splat(6.0) * (pop720 * shift)));

        let h = time - from.s;
        let arrival = End {
            x: mirror.of(mirror.gap),
            v: mirror.of(velocity),
            a: mirror.of(q + shift * (j + half * (shift * snap))),
        };
        // near enough for the polynomial, and what the correction leaves is no more than rounding
        let reach = time.min(L::splat(1.0 / self.beta.max(1.0 + self.drag)));
        let near = shift.abs().less(L::splat(NEAR) * reach);
        let left = (turn * turn * turn).abs() + (bend * correction).abs();
        let settled = (last.abs() * left).less(L::splat(0.25 * f64::EPSILON) * time);
        // an arrival that is being slowed down may be all but a graze
        let gentlest = if damped {
            L::splat(GENTLE_DAMPED)
        } else {
            L::choose(L::splat(0.0).less(q), L::splat(SLOWEST), L::splat(GENTLE))
        };
        let proven = self.clear(&self.scale(h), &self.end(from), &arrival, margin, true).and(near).and(settled);
        let proven = proven.and(gentlest.less(velocity)).and(L::splat(0.0).less(h));
        Strike { proven, time, velocity, side: mirror.side }
    }

    /// The state that a propagator carries another one to, and the distance to the stop there.
    #[inline(always)]
    fn carried<L: Lane>(&self, from: &Launch<L>, over: &Row<L>, gap: L) -> (L, Launch<L>) {
        let beta = L::splat(self.beta);
        let [_, c, s, s_rate, kc, ks, st, ct] = *over;
        let forced = from.sin * kc + from.cos * ks;
        let displacement = self.moved(from, over);
        // past a quarter of a free swing the position itself has the smaller terms
        let far = (from.x * c + from.v * s) + forced;
        let is_far = c.less(L::splat(0.5));
        let x = L::choose(is_far, far, from.x + displacement);
        let v = (from.v * s_rate - from.x * s) + (from.sin * (s - beta * ks) + from.cos * (beta * kc));
        let (sin, cos) = (from.sin * ct + from.cos * st, from.cos * ct - from.sin * st);
        (L::choose(is_far, gap - far, (gap - from.x) - displacement), Launch { x, v, sin, cos })
    }

    /// How far a propagator moves the mass.
    #[inline(always)]
    fn moved<L: Lane>(&self, from: &Launch<L>, over: &Row<L>) -> L {
        let [omc, _, s, _, kc, ks, _, _] = *over;
        (from.v * s - from.x * omc) + (from.sin * kc + from.cos * ks)
    }
}

impl<L: Lane> Launch<L> {
    /// The state a step in doubt begins with, and its margin: the launch itself, exact, or what was passed on from it.
    #[inline(always)]
    pub(super) fn or_on_the_way(&self, stride: &Stride, way: State<L>) -> (State<L>, L) {
        let fresh = way.s.less(L::splat(f64::MIN_POSITIVE));
        let state = State {
            s: way.s,
            x: L::choose(fresh, self.x, way.x),
            v: L::choose(fresh, self.v, way.v),
            sin: L::choose(fresh, self.sin, way.sin),
            cos: L::choose(fresh, self.cos, way.cos),
        };
        (state, L::choose(fresh, L::splat(MARGIN), stride.margin(way.s)))
    }

    /// Seen from the stop it may strike.
    #[inline(always)]
    fn mirrored(&self, mirror: Mirror<L>) -> Self {
        Self { x: mirror.of(self.x), v: mirror.of(self.v), sin: mirror.of(self.sin), cos: mirror.of(self.cos) }
    }
}

/// A polynomial without constant term.
#[inline(always)]
fn sum<L: Lane>(c: [L; 6], t: L) -> L {
    let tt = t * t;
    (c[0] * t + c[1] * tt) + (t * tt) * ((c[2] + c[3] * t) + tt * (c[4] + c[5] * t))
}

/// The root in (0, 1] of the quintic that interpolates the gap, as a fraction of the step; nonsense if there is none.
#[inline(always)]
fn quintic_root<L: Lane>(h: L, begin: &End<L>, end: &End<L>, mirror: Mirror<L>) -> L {
    let hh = h * h;
    let (x0, v0, a0) = (mirror.of(begin.x) - mirror.gap, mirror.of(begin.v) * h, mirror.of(begin.a) * hh);
    let (x1, v1, a1) = (mirror.of(end.x) - mirror.gap, mirror.of(end.v) * h, mirror.of(end.a) * hh);
    // the first crossing from below, to a quarter, by the values between
    let zero = L::splat(0.0);
    let third = zero.less(between::<L, 2>([x0, v0, a0], [x1, v1, a1]));
    let second = zero.less(between::<L, 1>([x0, v0, a0], [x1, v1, a1]));
    let first = zero.less(between::<L, 0>([x0, v0, a0], [x1, v1, a1]));
    let late = L::choose(third, L::splat(0.625), L::splat(0.875));
    let mut t = L::choose(first, L::splat(0.125), L::choose(second, L::splat(0.375), late));

    let c2 = L::splat(0.5) * a0;
    let d0 = ((x1 - x0) - v0) - c2;
    let d1 = (v1 - v0) - a0;
    let d2 = L::splat(0.5) * (a1 - a0);
    let c3 = L::splat(10.0) * d0 - (L::splat(4.0) * d1 - d2);
    let c4 = L::splat(7.0) * d1 - (L::splat(15.0) * d0 + (d2 + d2));
    let c5 = L::splat(6.0) * d0 - (L::splat(3.0) * d1 - d2);
    for _ in 0..2 {
        let tt = t * t;
        let (t3, t4, t5) = (c3 * t, c4 * t, c5 * t);
        let f = ((x0 + v0 * t) + tt * (c2 + t3)) + (tt * tt) * (c4 + t5);
        let d = ((v0 + a0 * t) + tt * (L::splat(3.0) * c3 + L::splat(4.0) * t4)) + (tt * tt) * (L::splat(5.0) * c5);
        let dd = (a0 + L::splat(6.0) * t3) + tt * (L::splat(12.0) * c4 + L::splat(20.0) * t5);
        // Halley's step, kept in the interval
        let step = (f * d) / (d * d - L::splat(0.5) * (f * dd));
        t = (t - step).max(zero).min(L::splat(1.0));
    }
    t
}

/// The quintic at so many quarters, less one.
#[inline(always)]
fn between<L: Lane, const K: usize>([x0, v0, a0]: [L; 3], [x1, v1, a1]: [L; 3]) -> L {
    let ([bx, bv, ba], [ex, ev, ea]) = (BETWEEN[K], BETWEEN[2 - K]);
    ((L::splat(bx) * x0 + L::splat(ex) * x1) + (L::splat(bv) * v0 - L::splat(ev) * v1))
        + (L::splat(ba) * a0 + L::splat(ea) * a1)
}

/// The quintic at 1/4, 1/2 and 3/4 from position, velocity and acceleration at its beginning; from its end by symmetry.
const BETWEEN: [[f64; 3]; 3] = [
    [918.0 / 1024.0, 189.0 / 1024.0, 13.5 / 1024.0],
    [0.5, 5.0 / 32.0, 1.0 / 64.0],
    [106.0 / 1024.0, 39.0 / 1024.0, 4.5 / 1024.0],
];

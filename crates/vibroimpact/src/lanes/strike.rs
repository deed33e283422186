//! The contact at the end of a step that may hold one: found, refined to the last bits, and proven to be the first.
//!
//! 1. The root of the quintic interpolant of the step, by bisection to an eighth and Halley's iteration: a guess, good to the error
//!    of the interpolant.
//! 2. The state there, the only one that a flight needs in full precision: by the closed form, or, damped, composed of the
//!    propagator to the nearest whole step and of the one over the rest ([`Stride`]).
//! 3. The root of the Taylor polynomial of degree 5 about it, which the equation of motion gives for nothing. The
//!    guess being within $`2^{-10}/\mu`$, what is left out is below $`2^{-60}`$ of the position and $`2^{-56}`$ of the speed.
//! 4. A [hull](super::hull) over the arc from the beginning of the step to the contact found: no other lies before it.
//!
//! Where one of these fails the answer is no, and the step is halved.

use super::hull::End;
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
const NEAR: f64 = 1.0 / 1024.0;
/// Gentler arrivals than this, while being slowed down, are left to the careful search, which knows about rounding.
const GENTLE: f64 = 1e-3;
/// With damping, where the state is composed of two: it costs a few last places of the position.
const GENTLE_DAMPED: f64 = 1.0 / 64.0;
/// The same while being sped up, when the stop is passed for certain.
const SLOWEST: f64 = 1e-6;

impl Stride {
    /// The first contact in the step of length `h` between two states, if it can be proven.
    #[inline(always)]
    pub(super) fn strike<L: Lane>(
        &self,
        launch: &Launch<L>,
        h: L,
        (from, to): (&State<L>, &State<L>),
        propagators: &impl Propagators<L>,
    ) -> Strike<L> {
        let (begin, end) = (self.end(from), self.end(to));
        let (one, upper) = (L::splat(1.0), L::splat(self.gap[0]));
        let mirror = if self.two_stops {
            let lower = to.x.less(L::splat(-self.gap[1]));
            let (side, gap) = (L::choose(lower, -one, one), L::choose(lower, L::splat(self.gap[1]), upper));
            Mirror { two_stops: true, side, gap }
        } else {
            Mirror { two_stops: false, side: one, gap: upper }
        };
        let guess = from.s + h * quintic_root(h, &begin, &end, mirror);

        let launch = launch.mirrored(mirror);
        let (g, state) = if self.drag == 0.0 {
            self.carried(&launch, &self.whole(guess), mirror.gap)
        } else {
            let nearest = (guess * L::splat(1.0 / self.pace.h)).nearest();
            let (room, node) = self.carried(&launch, &propagators.node(nearest), mirror.gap);
            let rest = self.rest(guess - nearest * L::splat(self.pace.h));
            let (_, state) = self.carried(&node, &rest, mirror.gap);
            (room - self.moved(&node, &rest), state)
        };
        let Launch { x, v: p, sin, cos } = state;
        let (drag, beta) = (L::splat(self.drag), L::splat(self.beta));
        let damped = self.drag != 0.0;
        let q = if damped { (sin - x) - drag * p } else { sin - x };
        let j = if damped { (beta * cos - p) - drag * q } else { beta * cos - p };
        let force = L::splat(self.beta * self.beta) * sin;
        let snap = if damped { -(force + q) - drag * j } else { -(force + q) };

        let force_rate = L::splat(self.beta * self.beta * self.beta) * cos;
        let crackle = if damped { -(force_rate + j) - drag * snap } else { -(force_rate + j) };

        // g = p t + q t^2/2 + j t^3/6 + snap t^4/24 + crackle t^5/120
        let half = L::splat(0.5);
        let taylor = [
            p,
            half * q,
            L::splat(1.0 / 6.0) * j,
            L::splat(1.0 / 24.0) * snap,
            L::splat(1.0 / 120.0) * crackle,
        ];
        let first = (g + g) / (p + (p * p + (q + q) * g).sqrt());
        let correction = (g - value(taylor, first)) / slope(taylor, first);
        let shift = first + correction;
        let time = guess + shift;
        let velocity = slope(taylor, shift);

        let h = time - from.s;
        let arrival = End {
            x: mirror.of(mirror.gap),
            v: mirror.of(velocity),
            a: mirror.of(q + shift * (j + half * (shift * snap))),
        };
        // near enough for the polynomial, and the next correction, quadratically smaller, would be no more than rounding
        let reach = time.min(L::splat(1.0 / self.beta.max(1.0 + self.drag)));
        let near = shift.abs().less(L::splat(NEAR) * reach);
        let settled = (correction * correction * q.abs()).less(L::splat(f64::EPSILON) * (velocity * time));
        // an arrival that is being slowed down may be all but a graze
        let gentlest = if damped {
            L::splat(GENTLE_DAMPED)
        } else {
            L::choose(L::splat(0.0).less(q), L::splat(SLOWEST), L::splat(GENTLE))
        };
        let proven = self.clear(&self.scale(h), &begin, &arrival, true).and(near).and(settled);
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
    /// Seen from the stop it may strike.
    #[inline(always)]
    fn mirrored(&self, mirror: Mirror<L>) -> Self {
        Self { x: mirror.of(self.x), v: mirror.of(self.v), sin: mirror.of(self.sin), cos: mirror.of(self.cos) }
    }
}

/// A polynomial without constant term.
#[inline(always)]
fn value<L: Lane>(c: [L; 5], t: L) -> L {
    t * (c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * c[4]))))
}

/// Its derivative.
#[inline(always)]
fn slope<L: Lane>(c: [L; 5], t: L) -> L {
    let (three, four, five) = (L::splat(3.0), L::splat(4.0), L::splat(5.0));
    c[0] + t * ((c[1] + c[1]) + t * (three * c[2] + t * (four * c[3] + t * (five * c[4]))))
}

/// The root in (0, 1] of the quintic that interpolates the gap, as a fraction of the step; nonsense if there is none.
#[inline(always)]
fn quintic_root<L: Lane>(h: L, begin: &End<L>, end: &End<L>, mirror: Mirror<L>) -> L {
    let hh = h * h;
    let (x0, v0, a0) = (mirror.of(begin.x) - mirror.gap, mirror.of(begin.v) * h, mirror.of(begin.a) * hh);
    let (x1, v1, a1) = (mirror.of(end.x) - mirror.gap, mirror.of(end.v) * h, mirror.of(end.a) * hh);
    let (half, zero) = (L::splat(0.5), L::splat(0.0));
    let c2 = half * a0;
    let d0 = ((x1 - x0) - v0) - c2;
    let d1 = (v1 - v0) - a0;
    let d2 = half * (a1 - a0);
    let c3 = L::splat(10.0) * d0 - (L::splat(4.0) * d1 - d2);
    let c4 = L::splat(7.0) * d1 - (L::splat(15.0) * d0 + (d2 + d2));
    let c5 = L::splat(6.0) * d0 - (L::splat(3.0) * d1 - d2);
    let c = [v0, c2, c3, c4, c5];
    // the first crossing from below, to an eighth
    let (mut t, mut move_by) = (half, L::splat(0.25));
    for _ in 0..3 {
        let beyond = zero.less(x0 + value(c, t));
        t = t + L::choose(beyond, -move_by, move_by);
        move_by = half * move_by;
    }
    let (six, twelve) = (L::splat(6.0), L::splat(12.0));
    for _ in 0..2 {
        let f = x0 + value(c, t);
        let dd = a0 + t * (six * c3 + t * (twelve * c4 + t * (L::splat(20.0) * c5)));
        t = halley(t, f, slope(c, t), dd);
    }
    t
}

/// One step of Halley's iteration, kept in [0, 1].
#[inline(always)]
fn halley<L: Lane>(t: L, f: L, d: L, dd: L) -> L {
    let step = (f * d) / (d * d - L::splat(0.5) * (f * dd));
    (t - step).max(L::splat(0.0)).min(L::splat(1.0))
}

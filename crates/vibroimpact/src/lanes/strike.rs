//! The contact at the end of a step that may contain one: it is found, refined to the last bits, and proven to be the
//! first.
//!
//! 1. A guess: the root of the quintic interpolant of the step, by Halley's iteration from its values at the quarters
//!    of the step. It is accurate to the error of the interpolant.
//! 2. The state there, the only one of a flight that is needed in full precision: by the closed form or, with damping,
//!    from the propagator to the nearest whole step and the one over the rest ([`Stride`]).
//! 3. The root of the Taylor polynomial of degree 6 about this state, whose coefficients follow from the equation of
//!    motion. As the guess is within $`2^{-8}/\mu`$, the remainder is below $`2^{-68}`$ of the position and $`2^{-57}`$
//!    of the speed.
//! 4. A [hull](super::hull) over the arc from the beginning of the step to the contact, which proves that there is no
//!    contact before.
//!
//! If one of these fails, no contact is reported, and the step is halved.

use super::constants::Constants;
use super::hull::{End, MARGIN};
use super::stride::{HullScale, Propagators, Row, State};
use super::swing::Swing;
use crate::math::{Lane, Mask, Numbers};

/// A launch: the state at the beginning of a flight.
#[derive(Clone, Copy, Debug)]
pub(super) struct Launch<L> {
    pub(super) x: L,
    pub(super) v: L,
    pub(super) sin: L,
    pub(super) cos: L,
}

/// A contact that is not yet proven to be the first.
#[derive(Clone, Copy)]
pub(super) struct Strike<L: Lane> {
    /// Whether the contact is accurate to the last bits.
    settled: L::Mask,
    /// Time since the launch.
    pub(super) time: L,
    /// Arrival speed.
    pub(super) velocity: L,
    /// Acceleration at the arrival, towards the stop.
    acceleration: L,
    /// +1 at the upper stop, -1 at the lower one.
    pub(super) side: L,
}

/// The stop of a possible contact; the lower one is mirrored to an upper one.
#[derive(Clone, Copy)]
struct Mirror<L> {
    two_stops: bool,
    side: L,
    gap: L,
}

impl<L: Numbers> Mirror<L> {
    /// The stop on this side.
    #[inline(always)]
    fn at(constants: &Constants<L>, side: L) -> Self {
        let [upper, lower] = constants.gap;
        // with one stop there is nothing to choose in any lane
        if !constants.two_stops {
            return Self { two_stops: false, side, gap: upper };
        }
        let low = side.less(L::splat(0.0));
        Self { two_stops: true, side, gap: L::choose(low, lower, upper) }
    }

    #[inline(always)]
    fn of(self, y: L) -> L {
        if self.two_stops { y * self.side } else { y }
    }
}

/// The largest distance of the guess from the contact, in units of the shortest time scale $`1/\mu`$.
const NEAR: f64 = 1.0 / 256.0;
/// Arrivals slower than this while the mass is being slowed down are left to the careful search, which takes rounding
/// errors into account.
const GENTLE: f64 = 1e-3;
/// The same with damping. There the state is computed with two propagators, which costs a few last digits of the
/// position.
const GENTLE_DAMPED: f64 = 1.0 / 64.0;
/// The same while the mass is being accelerated towards the stop, which it then passes for certain.
const SLOWEST: f64 = 1e-6;

/// The guess of a contact.
#[derive(Clone, Copy)]
pub(super) struct Guess<N> {
    /// Time since the launch.
    time: N,
    side: N,
}

/// The motion at the time of a guess, mirrored to the upper stop.
#[derive(Clone, Copy)]
pub(super) struct Approach<L> {
    /// Distance from the stop, in full precision.
    room: L,
    state: Launch<L>,
}

impl<N: Numbers> Guess<N> {
    /// A placeholder.
    #[inline(always)]
    pub(super) fn nowhere() -> Self {
        Self { time: N::splat(0.0), side: N::splat(0.0) }
    }
}

impl<L: Lane> Guess<L> {
    /// The guess in double precision.
    #[inline(always)]
    pub(super) fn of(rough: &Guess<L::Rough>) -> Self {
        Self { time: L::widened(rough.time), side: L::widened(rough.side) }
    }
}

impl<L: Lane> Approach<L> {
    /// A placeholder.
    #[inline(always)]
    pub(super) fn nowhere() -> Self {
        let zero = L::splat(0.0);
        Self { room: zero, state: Launch { x: zero, v: zero, sin: zero, cos: zero } }
    }
}

impl<L: Lane> Strike<L> {
    /// A placeholder.
    #[inline(always)]
    pub(super) fn nowhere() -> Self {
        let zero = L::splat(0.0);
        Self { settled: zero.less(zero), time: zero, velocity: zero, acceleration: zero, side: zero }
    }
}

impl<N: Numbers> Constants<N> {
    /// Step 1: the guess, where the interpolant of the step reaches a stop.
    #[inline(always)]
    pub(super) fn guess(&self, h: N, s: N, from: &End<N>, to: &End<N>) -> Guess<N> {
        let mut side = N::splat(1.0);
        if self.two_stops {
            // below the lower stop at the end of the step
            side = N::choose(to.x.less(-self.gap[1]), -side, side);
        }
        let mirror = Mirror::at(self, side);
        let quintic = Quintic::of(h, from, to, mirror);
        let sixth = |end: &End<N>| mirror.of(self.sixth[0] * end.a + self.sixth[1] * end.x);
        let t = quintic.root(quintic.first_crossing(), [sixth(from), sixth(to)]);
        Guess { time: s + h * t, side }
    }

    /// Whether no stop is reached before this arrival.
    #[inline(always)]
    fn reaches(&self, h: N, from: &End<N>, (side, v, a): (N, N, N), margin: N) -> N::Mask {
        let mirror = Mirror::at(self, side);
        let arrival = End { x: mirror.of(mirror.gap), v: mirror.of(v), a: mirror.of(a) };
        self.clear(&HullScale::new(h, self.bound), from, &arrival, margin, true).and(N::splat(0.0).less(h))
    }
}

impl<L: Lane> Constants<L> {
    /// Step 1: the guess from the estimate of a swing.
    #[inline(always)]
    pub(super) fn guess_near(&self, h: L, (s, from, to): &(L, End<L>, End<L>), swing: &Swing<L>) -> Guess<L> {
        let quintic = Quintic::of(h, from, to, Mirror::at(self, swing.side));
        Guess { time: *s + h * quintic.root(swing.estimate, [L::splat(0.0); 2]), side: swing.side }
    }

    /// Step 2: the motion at the guess.
    #[inline(always)]
    pub(super) fn approach(
        &self,
        launch: &Launch<L>,
        guess: &Guess<L>,
        propagators: &impl Propagators<L>,
    ) -> Approach<L> {
        let mirror = Mirror::at(self, guess.side);
        let launch = launch.mirrored(mirror);
        if !self.damped {
            let (room, state) = self.carried(&launch, &propagators.whole(guess.time), mirror.gap);
            return Approach { room, state };
        }
        // rounded to a whole number in any case, so a product with the inverse will do
        let nearest = (guess.time * (L::splat(1.0) / self.h)).nearest();
        let (room, node) = self.carried(&launch, &propagators.node(nearest), mirror.gap);
        let rest = propagators.rest(guess.time - nearest * self.h);
        let (_, state) = self.carried(&node, &rest, mirror.gap);
        // the distance at the node less the displacement since: no digits of a short way are lost
        Approach { room: room - Self::moved(&node, &rest), state }
    }

    /// Step 3: the contact, from the Taylor polynomial at the guess.
    #[inline(always)]
    pub(super) fn polish(&self, guess: &Guess<L>, approach: &Approach<L>) -> Strike<L> {
        let Approach { room: g, state: Launch { x, v: p, sin, cos } } = *approach;
        let Self { damped, beta, drag, .. } = *self;
        // the derivatives of the position, one after another from x'' = sin - x - 2 zeta x'
        let square = beta * beta;
        let q = if damped { (sin - x) - drag * p } else { sin - x };
        let j = if damped { (beta * cos - p) - drag * q } else { beta * cos - p };
        let force = square * sin;
        let snap = if damped { -(force + q) - drag * j } else { -(force + q) };
        let force_rate = square * beta * cos;
        let crackle = if damped { -(force_rate + j) - drag * snap } else { -(force_rate + j) };

        let pop = square * force - snap;
        let pop = if damped { pop - drag * crackle } else { pop };

        // g = p t + q t^2/2 + j t^3/6 + ... + pop t^6/720: the series of its inverse to the third order, then one
        // Newton step with the slope at that point
        let half = L::splat(0.5);
        let (j6, snap24) = (L::splat(1.0 / 6.0) * j, L::splat(1.0 / 24.0) * snap);
        let (crackle120, pop720) = (L::splat(1.0 / 120.0) * crackle, L::splat(1.0 / 720.0) * pop);
        let over = L::splat(1.0) / p;
        let (first, bend, twist) = (g * over, q * over, j6 * over);
        let bent = half * (bend * first);
        let series = first - first * (bent - (first * first) * (half * (bend * bend) - twist));
        let taylor = [p, half * q, j6, snap24, crackle120, pop720];
        // the slope at that point is p (1 + turn)
        let tt = series * series;
        let turn = bend * series + tt * (L::splat(3.0) * twist + (L::splat(4.0) * (snap24 * over)) * series);
        let newton = over * ((L::splat(1.0) - turn) + turn * turn);
        let correction = (g - sum(taylor, series)) * newton;
        let shift = series + correction;
        let time = guess.time + shift;
        let ss = shift * shift;
        let velocity = (p + q * shift)
            + ss * ((L::splat(3.0) * j6 + L::splat(4.0) * (snap24 * shift))
                + ss * (L::splat(5.0) * crackle120 + L::splat(6.0) * (pop720 * shift)));

        // close enough for the polynomial, and the remainder after the correction is within rounding
        let reach = time.min(self.shortest);
        let near = shift.abs().less(L::splat(NEAR) * reach);
        let left = (turn * turn * turn).abs() + (bend * correction).abs();
        let settled = (correction.abs() * left).less(L::splat(0.25 * f64::EPSILON) * time);
        // an arrival that is being slowed down can be almost a grazing contact
        let gentlest = if damped {
            L::splat(GENTLE_DAMPED)
        } else {
            L::choose(L::splat(0.0).less(q), L::splat(SLOWEST), L::splat(GENTLE))
        };
        let settled = near.and(settled).and(gentlest.less(velocity));
        let acceleration = q + shift * (j + half * (shift * snap));
        Strike { settled, time, velocity, acceleration, side: guess.side }
    }

    /// Step 4: whether the contact is proven to be the first since the beginning of the step at `s`, as bits. Single
    /// precision suffices unless the arc is very short.
    #[inline(always)]
    pub(super) fn first_roughly(
        roughly: &Constants<L::Rough>,
        strike: &Strike<L>,
        s: L::Rough,
        from: &End<L::Rough>,
    ) -> u32 {
        let h = (strike.time - L::widened(s)).rounded();
        let (v, a) = (strike.velocity.rounded(), strike.acceleration.rounded());
        strike.settled.bits() & roughly.reaches(h, from, (strike.side.rounded(), v, a), roughly.margin(s)).bits()
    }

    /// Step 4 in double precision.
    #[inline(always)]
    pub(super) fn first(&self, strike: &Strike<L>, s: L, from: &End<L>) -> L::Mask {
        let arrival = (strike.side, strike.velocity, strike.acceleration);
        strike.settled.and(self.reaches(strike.time - s, from, arrival, L::splat(MARGIN)))
    }

    /// The state a whole number of steps after the launch, in full precision.
    #[inline(always)]
    pub(super) fn after_steps(&self, launch: &Launch<L>, s: L, propagators: &impl Propagators<L>) -> State<L> {
        let steps = (s * (L::splat(1.0) / self.h)).nearest();
        let (_, there) = self.carried(launch, &propagators.node(steps), L::splat(0.0));
        State { s, x: there.x, v: there.v, sin: there.sin, cos: there.cos }
    }

    /// The state that a propagator gives from another state, and its distance from the stop.
    #[inline(always)]
    fn carried(&self, from: &Launch<L>, over: &Row<L>, gap: L) -> (L, Launch<L>) {
        let beta = self.beta;
        let [_, c, s, s_rate, kc, ks, st, ct] = *over;
        let forced = from.sin * kc + from.cos * ks;
        let displacement = Self::moved(from, over);
        // after a quarter of a free oscillation the terms of the position itself are smaller
        let far = (from.x * c + from.v * s) + forced;
        let is_far = c.less(L::splat(0.5));
        let x = L::choose(is_far, far, from.x + displacement);
        let v = (from.v * s_rate - from.x * s) + (from.sin * (s - beta * ks) + from.cos * (beta * kc));
        let (sin, cos) = (from.sin * ct + from.cos * st, from.cos * ct - from.sin * st);
        (L::choose(is_far, gap - far, (gap - from.x) - displacement), Launch { x, v, sin, cos })
    }

    /// The displacement that a propagator gives.
    #[inline(always)]
    fn moved(from: &Launch<L>, over: &Row<L>) -> L {
        let [omc, _, s, _, kc, ks, _, _] = *over;
        (from.v * s - from.x * omc) + (from.sin * kc + from.cos * ks)
    }
}

impl<L: Lane> Launch<L> {
    /// Mirrored to the upper stop.
    #[inline(always)]
    fn mirrored(&self, mirror: Mirror<L>) -> Self {
        Self { x: mirror.of(self.x), v: mirror.of(self.v), sin: mirror.of(self.sin), cos: mirror.of(self.cos) }
    }
}

/// The value of a polynomial without constant term.
#[inline(always)]
fn sum<L: Lane>(c: [L; 6], t: L) -> L {
    let tt = t * t;
    (c[0] * t + c[1] * tt) + (t * tt) * ((c[2] + c[3] * t) + tt * (c[4] + c[5] * t))
}

impl<N: Numbers> End<N> {
    /// Position less the gap, velocity and acceleration, in units in which the step has length 1.
    #[inline(always)]
    fn scaled(&self, h: N, mirror: Mirror<N>) -> [N; 3] {
        [mirror.of(self.x) - mirror.gap, mirror.of(self.v) * h, mirror.of(self.a) * (h * h)]
    }
}

/// A quintic by position less the gap, velocity and acceleration at its ends, in units in which the step has length 1.
#[derive(Clone, Copy)]
struct Quintic<N>([N; 3], [N; 3]);

impl<N: Numbers> Quintic<N> {
    #[inline(always)]
    fn of(h: N, begin: &End<N>, end: &End<N>, mirror: Mirror<N>) -> Self {
        Self(begin.scaled(h, mirror), end.scaled(h, mirror))
    }

    /// The first crossing from below, to within an eighth, from the values at the quarters.
    #[inline(always)]
    fn first_crossing(self) -> N {
        let zero = N::splat(0.0);
        let third = zero.less(between::<N, 2>(self.0, self.1));
        let second = zero.less(between::<N, 1>(self.0, self.1));
        let first = zero.less(between::<N, 0>(self.0, self.1));
        // the middle of the quarter in which the sign changes, so that it is off by an eighth at most
        let late = N::choose(third, N::splat(0.625), N::splat(0.875));
        N::choose(first, N::splat(0.125), N::choose(second, N::splat(0.375), late))
    }

    /// The root in (0, 1] near an estimate; meaningless if there is none.
    #[inline(always)]
    fn root(self, mut t: N, sixth: [N; 2]) -> N {
        let Self([x0, v0, a0], [x1, v1, a1]) = self;
        // the polynomial of degree 5 that has position, velocity and acceleration of both ends
        let c2 = N::splat(0.5) * a0;
        let d0 = ((x1 - x0) - v0) - c2;
        let d1 = (v1 - v0) - a0;
        let d2 = N::splat(0.5) * (a1 - a0);
        let c3 = N::splat(10.0) * d0 - (N::splat(4.0) * d1 - d2);
        let c4 = N::splat(7.0) * d1 - (N::splat(15.0) * d0 + (d2 + d2));
        let c5 = N::splat(6.0) * d0 - (N::splat(3.0) * d1 - d2);
        let mut slope = v0;
        for _ in 0..2 {
            let tt = t * t;
            let (t3, t4, t5) = (c3 * t, c4 * t, c5 * t);
            let f = ((x0 + v0 * t) + tt * (c2 + t3)) + (tt * tt) * (c4 + t5);
            let d = ((v0 + a0 * t) + tt * (N::splat(3.0) * c3 + N::splat(4.0) * t4)) + (tt * tt) * (N::splat(5.0) * c5);
            let dd = (a0 + N::splat(6.0) * t3) + tt * (N::splat(12.0) * c4 + N::splat(20.0) * t5);
            // Halley's step, kept in the interval
            let step = (f * d) / (d * d - N::splat(0.5) * (f * dd));
            t = (t - step).max(N::splat(0.0)).min(N::splat(1.0));
            slope = d;
        }
        // it lacks the term t^3 (t - 1)^3 of the sixth derivative, which moves the root by this to first order
        let there = t * (t - N::splat(1.0));
        let sixth = sixth[0] + t * (sixth[1] - sixth[0]);
        t - sixth * (there * there * there) / slope
    }
}

/// The value of the quintic at (K + 1)/4.
#[inline(always)]
fn between<L: Numbers, const K: usize>([x0, v0, a0]: [L; 3], [x1, v1, a1]: [L; 3]) -> L {
    let ([bx, bv, ba], [ex, ev, ea]) = (BETWEEN[K], BETWEEN[2 - K]);
    ((L::splat(bx) * x0 + L::splat(ex) * x1) + (L::splat(bv) * v0 - L::splat(ev) * v1))
        + (L::splat(ba) * a0 + L::splat(ea) * a1)
}

/// The coefficients of position, velocity and acceleration at the beginning for the values at 1/4, 1/2 and 3/4; those
/// at the end follow by symmetry.
const BETWEEN: [[f64; 3]; 3] = [
    [918.0 / 1024.0, 189.0 / 1024.0, 13.5 / 1024.0],
    [0.5, 5.0 / 32.0, 1.0 / 64.0],
    [106.0 / 1024.0, 39.0 / 1024.0, 4.5 / 1024.0],
];

//! Proves that a step stays clear of the stops, by the Bernstein hull of its Hermite interpolant, with the error term.
//!
//! Over a step $`s = s_0 + ht`$, $`0 \le t \le 1`$, position, velocity and acceleration at both ends determine a
//! quintic $`q`$ with
//!
//! $$`x(s) - q(t) = \frac{x^{(6)}(\xi)}{720}\,h^6\,t^3(t-1)^3, \qquad
//!   |x - q| \le \frac{B_6 h^6}{14\,400}\,\binom63 t^3(1-t)^3 ,`$$
//!
//! so the error is a multiple of the middle Bernstein polynomial of degree 6. In this degree the quintic has the
//! coefficients
//!
//! $$`x_0,\ x_0 + \tfrac h6 v_0,\ x_0 + \tfrac h3 v_0 + \tfrac{h^2}{30} a_0,\
//!   \tfrac12(b_2 + b_3),\ x_1 - \tfrac h3 v_1 + \tfrac{h^2}{30} a_1,\ x_1 - \tfrac h6 v_1,\ x_1,`$$
//!
//! with $`b_{2,3} = x_{0,1} \pm \tfrac{2h}5 v_{0,1} + \tfrac{h^2}{20}a_{0,1}`$. The arc lies in their convex hull, with
//! the middle one changed by the error. If all but the first are below the stop, the stop is not reached for
//! $`0 < t \le 1`$. This holds also for a step that begins on the stop: the known contact at $`t = 0`$ is the first
//! coefficient, and it is divided out by omitting this coefficient.
//!
//! $`B_6`$ grows with the energy radius (`flight/bounds.rs`), for which $`\sqrt{x^2+v^2} \le |x| + |v|`$.

use super::constants::{Constants, ROUGH};
use super::stride::{HullScale, State, nodes};
use crate::math::{Mask, Numbers};

/// The motion at an end of the arc.
#[derive(Clone, Copy)]
pub(super) struct End<L> {
    pub(super) x: L,
    pub(super) v: L,
    pub(super) a: L,
}

/// A bound of the rounding error of a coefficient, relative to 1 + |gap| + |x| + |v|, if the step begins at a state in
/// double precision. It is far above the few dozen rounding errors of a coefficient.
pub(super) const MARGIN: f64 = 1e-12;
/// The coefficients of an arc, without those at its ends.
pub(super) struct Hull<L> {
    /// |x| + |v| at its beginning.
    pub(super) size: L,
    /// The bound of the error of the middle coefficient.
    pub(super) error: L,
    /// The five coefficients between the ends.
    pub(super) coefficients: [L; 5],
}

impl<L: Numbers> Hull<L> {
    /// The hull of the arc between two ends, by the coefficients in the documentation of this file.
    #[inline(always)]
    pub(super) fn of(scale: &HullScale<L>, from: &End<L>, to: &End<L>) -> Self {
        let size = from.x.abs() + from.v.abs();
        let error = scale.error + scale.error_rate * size;
        // h/6 times the velocities; twice that is h/3
        let (leave, arrive) = (scale.sixth * from.v, scale.sixth * to.v);
        let c1 = from.x + leave;
        let c2 = from.x + ((leave + leave) + scale.thirtieth * from.a);
        let b2 = from.x + (scale.two_fifths * from.v + scale.twentieth * from.a);
        let b3 = to.x - (scale.two_fifths * to.v - scale.twentieth * to.a);
        let c3 = L::splat(0.5) * (b2 + b3);
        let c4 = to.x - ((arrive + arrive) - scale.thirtieth * to.a);
        let c5 = to.x - arrive;
        Self { size, error, coefficients: [c1, c2, c3, c4, c5] }
    }
}

impl<N: Numbers> Constants<N> {
    /// The motion at a state, with its acceleration.
    #[inline(always)]
    pub(super) fn end(&self, state: &State<N>) -> End<N> {
        let force = state.sin - state.x;
        let a = if self.damped { force - self.drag * state.v } else { force };
        End { x: state.x, v: state.v, a }
    }

    /// The relative margin for a state a time `s` after the launch; the launch itself counts as one step.
    #[inline(always)]
    pub(super) fn margin(&self, s: N) -> N {
        N::splat(ROUGH) + self.margin_rate * s
    }

    /// Whether the time is past the last step that lanes take.
    #[inline(always)]
    pub(super) fn late(&self, s: N) -> N::Mask {
        (N::splat(f64::from(nodes(self.damped))) * self.h).less(s)
    }

    /// Whether the arc is proven clear of the stops, except at its beginning; `margin` is relative. If `arrives` is
    /// set, its end is excepted too.
    #[inline(always)]
    pub(super) fn clear(&self, scale: &HullScale<N>, from: &End<N>, to: &End<N>, margin: N, arrives: bool) -> N::Mask {
        let Hull { size, error, coefficients: [c1, c2, c3, c4, c5] } = Hull::of(scale, from, to);
        let mut highest = c1.max(c2).max((c3 + error).max(c4)).max(c5);
        // the contact itself is at the stop
        if !arrives {
            highest = highest.max(to.x);
        }
        let clear = highest.less(self.room(0, margin, size));
        if !self.two_stops {
            return clear;
        }
        let mut lowest = c1.min(c2).min((c3 - error).min(c4)).min(c5);
        if !arrives {
            lowest = lowest.min(to.x);
        }
        // mirrored, the lowest is the highest
        clear.and((-lowest).less(self.room(1, margin, size)))
    }

    /// The gap of the upper (0) or the lower stop (1) less the margin.
    #[inline(always)]
    pub(super) fn room(&self, stop: usize, margin: N, size: N) -> N {
        self.gap[stop] - margin * (self.bulk[stop] + size)
    }
}

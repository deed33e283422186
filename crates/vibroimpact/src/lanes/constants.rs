//! The constants of flights: of one oscillator in every lane, or of another one in each.

/// A bound of the rounding error of a coefficient of a [hull](super::hull), relative to 1 + |gap| + |x| + |v|, for each
/// step taken in single precision. With $`u = 2^{-24}`$ a step adds at most $`6u`$ to sine and cosine
/// and $`11u\,(|x| + |v| + 3/2)`$ to position and velocity. The free motion preserves these errors up to a factor
/// $`\sqrt2`$ between the two. An error of the force is added at each step, near resonance in phase with the motion,
/// and becomes $`3u n^2`$ after $`n`$ steps. For at most 64 steps the sum is below $`230u\,n\,(1 + |x| + |v|)`$. One
/// step more is counted than was taken: for the step itself, and for the hull of the launch, which has about $`50u`$ in
/// single precision.
pub(super) const ROUGH: f64 = 1.4e-5;

/// The constants of flights that do not depend on the flight, of one oscillator or side by side.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Constants<N> {
    /// Whether there is a lower stop.
    pub(super) two_stops: bool,
    pub(super) damped: bool,
    pub(super) beta: N,
    /// 2 zeta.
    pub(super) drag: N,
    /// The gaps of the upper and the lower stop; infinite where there is none.
    pub(super) gap: [N; 2],
    /// 1 + |gap|, the part of the margin that does not depend on the state.
    pub(super) bulk: [N; 2],
    pub(super) restitution: [N; 2],
    /// The length of a whole step.
    pub(super) h: N,
    /// The margin of a rough state for each unit of time since the launch.
    pub(super) margin_rate: N,
    /// The shortest time scale of the system, 1/max(beta, 1 + 2 zeta).
    pub(super) shortest: N,
    /// B6 over a window from a state with |x| + |v| = 0, and its increase with |x| + |v|.
    pub(super) bound: [N; 2],
    /// The coefficients of acceleration and position in the sixth derivative (without damping), times h^6/720.
    pub(super) sixth: [N; 2],
}

impl<N> Constants<N> {
    /// The same with another representation of each number.
    #[inline(always)]
    pub(super) fn each<M>(&self, mut f: impl FnMut(&N) -> M) -> Constants<M> {
        let mut both = |[a, b]: &[N; 2]| [f(a), f(b)];
        let (gap, bulk, restitution) = (both(&self.gap), both(&self.bulk), both(&self.restitution));
        let (bound, sixth) = (both(&self.bound), both(&self.sixth));
        Constants {
            two_stops: self.two_stops,
            damped: self.damped,
            beta: f(&self.beta),
            drag: f(&self.drag),
            gap,
            bulk,
            restitution,
            h: f(&self.h),
            margin_rate: f(&self.margin_rate),
            shortest: f(&self.shortest),
            bound,
            sixth,
        }
    }

    /// Puts each number of another representation into the one here.
    pub(super) fn put<M>(&mut self, from: &Constants<M>, mut f: impl FnMut(&mut N, &M)) {
        let mut both = |[a, b]: &mut [N; 2], [c, d]: &[M; 2]| {
            f(a, c);
            f(b, d);
        };
        both(&mut self.gap, &from.gap);
        both(&mut self.bulk, &from.bulk);
        both(&mut self.restitution, &from.restitution);
        both(&mut self.bound, &from.bound);
        both(&mut self.sixth, &from.sixth);
        f(&mut self.beta, &from.beta);
        f(&mut self.drag, &from.drag);
        f(&mut self.h, &from.h);
        f(&mut self.margin_rate, &from.margin_rate);
        f(&mut self.shortest, &from.shortest);
    }
}

//! The free response: the motion without force from a displacement or a velocity.
//!
//! $$`C = e^{-\zeta s}\Bigl(\cos ws + \zeta\frac{\sin ws}{w}\Bigr), \quad S = e^{-\zeta s}\frac{\sin ws}{w}, \quad
//!   S' = C - 2\zeta S, \quad w = \sqrt{1-\zeta^2},`$$
//!
//! and with hyperbolic functions beyond critical damping. $`1 - C`$ is computed without cancellation: $`1 - \cos`$ as
//! $`\sin^2/(1+\cos)`$ where the cosine is positive, which keeps its digits also near multiples of a whole period, and
//! with damping by its Taylor series while $`s`$ is small.

use crate::math::{Lane, Mask, exp, exp_m1, two_prod};

/// For damping ratios from this value on, nothing cancels at resonance.
pub(crate) const HEAVY: f64 = 0.5;

/// From this damping ratio on the two exponents differ enough to divide by their difference.
const TWO_ROOTS: f64 = 1.2;
/// With damping, $`1 - C`$ is summed as a series below this; above, the subtraction loses at most two bits.
const SMALL: f64 = 1.0;

/// The free response for one damping ratio, with the quantities that do not depend on time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FreeResponse {
    pub(crate) damping: f64,
    /// $`\sqrt{|1-\zeta^2|}`$, its rounding error, and below critical damping the shift of frequency $`1 - w`$ from
    /// which both are computed.
    pub(crate) root: f64,
    root_low: f64,
    pub(crate) shift: f64,
}

/// The free response at one time, or at several side by side.
#[derive(Clone, Copy)]
pub(crate) struct Free<L = f64> {
    pub(crate) c: L,
    pub(crate) one_minus_c: L,
    pub(crate) s: L,
    pub(crate) s_rate: L,
    pub(crate) size: L,
    /// The angle that has a rounding error.
    pub(crate) angle: L,
}

impl FreeResponse {
    pub(crate) fn new(damping: f64) -> Self {
        let root = ((1.0 - damping) * (1.0 + damping)).abs().sqrt();
        let shift = damping * damping / (1.0 + root);
        let (root, root_low) = if damping < HEAVY { (1.0 - shift, (1.0 - (1.0 - shift)) - shift) } else { (root, 0.0) };
        Self { damping, root, root_low, shift }
    }

    /// The free response after a time `s >= 0`.
    pub(crate) fn at(&self, s: f64) -> Free {
        if self.damping < 1.0 {
            let decay = if self.damping == 0.0 { (1.0, 0.0) } else { decay(self.damping * s) };
            self.swing(s, self.swing_angle(s), decay)
        } else {
            self.creep(s)
        }
    }

    /// Sine and cosine of $`ws`$, corrected for the rounding errors of the product and of $`w`$. Without the correction
    /// these errors would limit the accuracy of the position late in a long flight with light damping.
    #[inline(always)]
    pub(crate) fn swing_angle<L: Lane>(&self, s: L) -> (L, L) {
        let (angle, low) = two_prod(L::splat(self.root), s);
        let (sin, cos) = angle.sine_and_cosine();
        let rest = low + L::splat(self.root_low) * s;
        (sin + cos * rest, cos - sin * rest)
    }

    /// The free response below critical damping, from the sine and cosine of `w s` and the decay.
    #[inline(always)]
    pub(crate) fn swing<L: Lane>(&self, s: L, (sw, cw): (L, L), (kept, loss): (L, L)) -> Free<L> {
        let zeta = L::splat(self.damping);
        let free_s = kept * if self.root == 0.0 { s } else { sw / L::splat(self.root) };
        let versine = versine(sw, cw);
        let (one_minus_c, size) = if self.damping == 0.0 {
            (versine, versine)
        } else {
            let sum = (loss - zeta * free_s) + kept * versine;
            let size = loss + (zeta * free_s).abs() + kept * versine;
            let small = (s * L::splat(1.0 + self.damping)).less(L::splat(SMALL));
            if small.bits() == 0 {
                (sum, size)
            } else {
                let series = self.one_minus_c_series(s);
                (L::choose(small, series, sum), L::choose(small, series, size))
            }
        };
        let (c, s_rate) = (kept * cw + zeta * free_s, kept * cw - zeta * free_s);
        Free { c, one_minus_c, s: free_s, s_rate, size, angle: L::splat(self.shift) * s }
    }

    /// The free response from critical damping on.
    fn creep(&self, s: f64) -> Free {
        let (zeta, root) = (self.damping, self.root);
        // slow exponent zeta - root = 1/(zeta + root), spread 2 root
        let fast = zeta + root;
        let slow = exp(-s / fast);
        let (left, spread) = decay(2.0 * root * s);
        let free_s = slow * if root == 0.0 { s } else { spread / (2.0 * root) };
        let c = slow * (1.0 - 0.5 * spread) + zeta * free_s;
        let one_minus_c = if s * (1.0 + zeta) < SMALL {
            self.one_minus_c_series(s)
        } else if zeta > TWO_ROOTS {
            // -(l1 expm1(l2 s) - l2 expm1(l1 s)) / (l1 - l2), l1 = -1/fast, l2 = -fast
            (exp_m1(-fast * s) / fast - fast * exp_m1(-s / fast)) / (2.0 * root)
        } else {
            1.0 - c
        };
        let s_rate = if zeta > TWO_ROOTS {
            // (fast e^{-fast s} - e^{-s/fast}/fast) / (2 root)
            slow * (fast * left - 1.0 / fast) / (2.0 * root)
        } else {
            slow * (1.0 - 0.5 * spread) - zeta * free_s
        };
        let size = one_minus_c.max(if zeta > TWO_ROOTS { 0.0 } else { 0.5 });
        Free { c, one_minus_c, s: free_s, s_rate, size, angle: s / fast }
    }

    /// $`1 - C`$ by its Taylor series, for `s (1 + zeta) <` [`SMALL`]: $`c_{k+2} = -c_k - 2\zeta c_{k+1}`$.
    #[inline(always)]
    fn one_minus_c_series<L: Lane>(&self, s: L) -> L {
        let (mut a, mut b) = (1.0, 0.0); // derivatives of C at 0
        let (mut power, mut sum) = (s, L::splat(0.0));
        let mut k = 2;
        while k < 30 {
            let next = -a - 2.0 * self.damping * b;
            power = power * (s / L::splat(f64::from(k)));
            sum = sum - L::splat(next) * power;
            (a, b) = (b, next);
            k += 1;
        }
        sum
    }
}

/// $`e^{-x}`$ and $`1 - e^{-x}`$, both accurate to their last bits.
#[inline]
pub(crate) fn decay(x: f64) -> (f64, f64) {
    let loss = -exp_m1(-x);
    (if loss < 0.5 { 1.0 - loss } else { exp(-x) }, loss)
}

/// $`1 - \cos`$ without cancellation.
#[inline(always)]
pub(crate) fn versine<L: Lane>(sin: L, cos: L) -> L {
    let one = L::splat(1.0);
    L::choose(L::splat(0.0).less(cos), sin * sin / (one + cos), one - cos)
}

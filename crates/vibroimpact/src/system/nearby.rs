//! The responses at several times around one time, side by side, for damping ratios below 1/2.
//!
//! With damping the decay is the product of that up to the middle time and $`e^{-\zeta d}`$ from there on, whose offset
//! $`d`$ is small enough for a series. The sum $`1 - E = (1 - E_0) + E_0(1 - e^{-\zeta d})`$ keeps the digits that the
//! forced response near resonance needs under very light damping.

use super::free::{HEAVY, decay};
use super::response::{NearForced, Regime, Response, divide};
use crate::math::Lane;

/// The terms of the series of the decay: for $`\zeta|d| \le 1.25`$ the first one that is omitted is below $`10^{-19}`$.
const TERMS: u32 = 23;

/// The responses at several times.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Nearby<L> {
    /// $`C`$, $`S`$ and $`S'`$ of the free response.
    pub(crate) c: L,
    pub(crate) s: L,
    pub(crate) s_rate: L,
    /// $`K_c`$ and $`K_s`$ of the forced response.
    pub(crate) kc: L,
    pub(crate) ks: L,
    /// $`\sin\beta s`$ and $`\cos\beta s`$.
    pub(crate) sin_turn: L,
    pub(crate) cos_turn: L,
}

impl Response {
    /// Whether the damping is light enough for [`nearby`](Self::nearby).
    pub(crate) const fn is_light(&self) -> bool {
        self.damping() < HEAVY
    }

    /// The responses at the time `middle` plus these offsets, for times from 0 to 1e5 and offsets of at most 2.5. For
    /// damping ratios below 1/2.
    #[inline(always)]
    pub(crate) fn nearby<L: Lane>(&self, middle: f64, offset: L) -> Nearby<L> {
        let zeta = self.damping();
        let s = L::splat(middle) + offset;
        if zeta == 0.0 {
            let p = self.undamped_form().splat().at(s);
            return Nearby {
                c: p.c,
                s: p.s,
                s_rate: p.c,
                kc: p.kc,
                ks: p.ks,
                sin_turn: p.sin_turn,
                cos_turn: p.cos_turn,
            };
        }
        let (kept, loss) = decay(zeta * middle);
        let further = loss_of(L::splat(zeta) * offset);
        let kept = L::splat(kept);
        // the decay to the middle time and on from there
        let (kept, loss) = (kept - kept * further, L::splat(loss) + kept * further);
        let (sw, cw) = (L::splat(self.free.root) * s).sine_and_cosine();
        let free_s = kept * sw / L::splat(self.free.root);
        // C = E cos + zeta S and S' = E cos - zeta S
        let c = kept * cw + L::splat(zeta) * free_s;
        let s_rate = kept * cw - L::splat(zeta) * free_s;
        let (kc, ks, sin_turn, cos_turn) = if let Regime::Light { detuning } = self.regime {
            let half = (L::splat(0.5 * detuning) * s).sine_and_cosine();
            let near = NearForced::new(self, detuning, (sw, cw), half, (kept, loss));
            (near.kc, near.ks, near.sin_turn, near.cos_turn)
        } else {
            let beta = self.beta();
            let (sin, cos) = (L::splat(beta) * s).sine_and_cosine();
            let z = ((1.0 - beta) * (1.0 + beta), 2.0 * zeta * beta);
            let (kc, ks) = divide((cos - c, sin - L::splat(beta) * free_s), z);
            (kc, ks, sin, cos)
        };
        Nearby { c, s: free_s, s_rate, kc, ks, sin_turn, cos_turn }
    }
}

/// $`1 - e^{-y}`$ for `y` of at most 1.25 in magnitude, by its series.
#[inline(always)]
fn loss_of<L: Lane>(y: L) -> L {
    let mut sum = L::splat(1.0);
    let mut k = TERMS;
    while k > 1 {
        // 1 - e^-y = y (1 - y/2 (1 - y/3 (1 - ...)))
        sum = L::splat(1.0) - y * L::splat(1.0 / f64::from(k)) * sum;
        k -= 1;
    }
    y * sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The loss against the library's function, over the whole range.
    #[test]
    fn the_series_of_the_decay() {
        for k in -100..=100 {
            let y = 1.25 * f64::from(k) / 100.0;
            let (series, exact) = (loss_of(y), -(-y).exp_m1());
            assert!((series - exact).abs() <= 4.0 * f64::EPSILON * exact.abs(), "{y}: {series} {exact}");
        }
    }

    /// All responses against those at one time, through resonance and for every damping that is light.
    #[test]
    fn the_responses_are_those_at_one_time() {
        for beta in [1e-3, 0.3, 0.5, 0.9, 1.0 - 1e-9, 1.0, 1.0 + 1e-5, 1.7, 2.0, 8.0, 60.0] {
            for zeta in [0.0, 1e-12, 1e-6, 1e-3, 0.02, 0.3, 0.499] {
                let response = Response::new(beta, zeta);
                for middle in [2.5, 3.0, 11.0, 40.0, 500.0] {
                    for offset in [-2.5, -0.7, 0.0, 1e-3, 2.5] {
                        let (near, one) = (response.nearby(middle, offset), response.at(middle + offset));
                        let size = 1.0 + one.kc.abs() + one.ks.abs();
                        let close = 1e-15 * (4.0 + (middle + 3.0) * beta.max(1.0)) * size;
                        for (a, b) in [
                            (near.c, one.c),
                            (near.s, one.s),
                            (near.s_rate, one.s_rate),
                            (near.kc, one.kc),
                            (near.ks, one.ks),
                            (near.sin_turn, one.sin_turn),
                            (near.cos_turn, one.cos_turn),
                        ] {
                            assert!((a - b).abs() < close, "beta {beta} zeta {zeta} {middle} {offset}: {a} {b}");
                        }
                    }
                }
            }
        }
    }
}

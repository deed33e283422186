//! One mode: $`\ddot y + 2d\dot y + ky = p_0 + p_1 s + \sum_h (a_h\cos w_h s + b_h\sin w_h s)`$ in closed form.
//!
//! The mode moves as
//!
//! $$`y(s) = y_0\,C + v_0\,S + p_0\,I_1 + p_1\,I_2 + \sum_h \Re\bigl[(a_h - ib_h)\,K_h\bigr],`$$
//!
//! with the free responses $`C, S`$ to a unit displacement and a unit velocity, $`I_1 = \int S`$, $`I_2 = \int I_1`$, and
//! the forced responses from rest $`K_h = \int_0^s S(s-r)\,e^{iw_hr}\,dr`$. For $`k > 0`$ the time is scaled by
//! $`\sqrt k`$ and the responses are those of the oscillator ([`Response`]), which hold through resonance, critical
//! damping and beyond. A mode without stiffness is a free body: $`C = 1`$, $`S = (1 - e^{-2ds})/2d`$.
//!
//! Over short times the responses are summed as Taylor series, which lose no digits of the displacement.

use crate::system::{FreeResponse, Response, decay, versine};

/// The damping, the stiffness and the rates of the forcing of one mode.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Mode {
    /// Stiffness $`k`$.
    pub(crate) k: f64,
    /// Half the damping, $`d`$.
    pub(crate) d: f64,
    /// $`\sqrt k`$.
    pub(crate) omega: f64,
    /// The fastest rate of the free motion, $`\sqrt k + 2d`$.
    pub(crate) rate: f64,
    /// The rates of the slow and of the fast decay of the free motion far beyond critical damping.
    pub(crate) decays: Option<(f64, f64)>,
    /// The free response in scaled time; `None` without stiffness.
    free: Option<FreeResponse>,
    /// How the response to each harmonic is computed.
    forced: Vec<Forced>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Forced {
    /// By the plain quotient $`(e^{iws} - C - iwS)/Z`$, $`Z = k - w^2 + 2idw`$.
    Plain { w: f64, z: (f64, f64) },
    /// Near resonance, in scaled time.
    Near(Response),
}

/// The sine, cosine and versine of an angle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Turned {
    pub(crate) sin: f64,
    pub(crate) cos: f64,
    pub(crate) versine: f64,
}

impl Turned {
    pub(crate) fn of(angle: f64) -> Self {
        let (sin, cos) = crate::math::sin_cos(angle);
        Self { sin, cos, versine: versine(sin, cos) }
    }
}

/// The responses of a mode after a time, per unit of what drives it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FreeMode {
    pub(crate) one_minus_c: f64,
    pub(crate) s: f64,
    pub(crate) s_rate: f64,
    /// Responses to a constant and to a ramp.
    pub(crate) step: f64,
    pub(crate) ramp: f64,
    /// Sizes of the terms of $`1 - C`$, for rounding errors.
    pub(crate) size: f64,
    /// The angle that was rounded.
    pub(crate) angle: f64,
}

/// The two decays of a mode are apart if $`d^2`$ is above $`k`$ by this factor: the fast one is 62 times faster then.
const APART: f64 = 16.0;
/// Near resonance: frequency ratios in which the formula that holds through resonance is used.
const NEAR: core::ops::RangeInclusive<f64> = 0.5..=2.0;

impl Mode {
    /// For $`k, d \ge 0`$ and the rates $`w_h`$ of the forcing.
    pub(crate) fn new(k: f64, d: f64, rates: &[f64]) -> Self {
        let omega = k.sqrt();
        // a stiffness that damping outweighs by more than 1e15 moves nothing in any time
        let stiff = omega > 0.0 && d / omega < 1e15;
        let (k, omega) = if stiff { (k, omega) } else { (0.0, 0.0) };
        let damping = if stiff { d / omega } else { 0.0 };
        let forced = rates.iter().map(|&w| {
            let near = stiff && NEAR.contains(&(w / omega)) && damping < crate::system::HEAVY;
            if near {
                Forced::Near(Response::new(w / omega, damping))
            } else {
                Forced::Plain { w, z: ((omega - w) * (omega + w), 2.0 * d * w) }
            }
        });
        let forced = forced.collect();
        let apart = stiff && d * d > APART * k;
        let decays = apart.then(|| {
            // the slow rate from the product of both, k: as a difference it would lose its digits
            let fast = d + (d * d - k).sqrt();
            (k / fast, fast)
        });
        Self { k, d, omega, rate: omega + 2.0 * d, decays, free: stiff.then(|| FreeResponse::new(damping)), forced }
    }

    /// The rate at which the free motion decays at last, for $`k > 0`$.
    pub(crate) fn slowest_decay(&self) -> f64 {
        let Self { k, d, .. } = self;
        if d * d > *k { k / (d + (d * d - k).sqrt()) } else { *d }
    }

    /// The free responses after a time `s >= 0`.
    pub(crate) fn free(&self, s: f64) -> FreeMode {
        let Some(response) = &self.free else { return self.without_stiffness(s) };
        let free = response.at(self.omega * s);
        let over = 1.0 / self.omega;
        let unit = free.s * over;
        let step = free.one_minus_c / self.k;
        FreeMode {
            one_minus_c: free.one_minus_c,
            s: unit,
            s_rate: free.s_rate,
            step,
            // k I_2 = s - S - 2d I_1, whose terms nearly cancel over short times
            ramp: if self.rate * s < 1.0 { self.ramp_series(s) } else { (s - unit - 2.0 * self.d * step) / self.k },
            size: free.size,
            // the scaled time itself is rounded
            angle: free.angle + self.omega * s,
        }
    }

    /// The response to a ramp over a short time, from the Taylor series of $`S`$, $`S'' = -kS - 2dS'`$.
    fn ramp_series(&self, s: f64) -> f64 {
        // a = S^(j) s^j / j!, b the next
        let (mut a, mut b) = (0.0, s);
        let (mut sum, mut j) = (0.0, 0.0);
        while j < 24.0 {
            sum += a * s * s / ((j + 1.0) * (j + 2.0));
            (a, b) = (b, -(self.k * s * s * a / (j + 1.0) + 2.0 * self.d * s * b) / (j + 2.0));
            j += 1.0;
        }
        sum
    }

    fn without_stiffness(&self, s: f64) -> FreeMode {
        let rate = 2.0 * self.d;
        let x = rate * s;
        let (kept, loss) = if rate > 0.0 { decay(x) } else { (1.0, 0.0) };
        let (unit, step, ramp) = if x < 0.5 {
            // 1/k! sums: S = s (1 - x/2 + ...), I1 = s^2 (1/2 - x/6 + ...), I2 = s^3 (1/6 - x/24 + ...)
            let (mut one, mut two, mut three) = (0.0, 0.0, 0.0);
            let (mut term, mut k) = (1.0, 1.0);
            while k < 24.0 {
                one += term / k;
                two += term / (k * (k + 1.0));
                three += term / (k * (k + 1.0) * (k + 2.0));
                term *= -x / k;
                k += 1.0;
            }
            (s * one, s * s * two, s * s * s * three)
        } else {
            // from 2d I_1 = s - S and 2d I_2 = s^2/2 - I_1, whose terms nearly cancel over short times
            let unit = loss / rate;
            let step = (s - unit) / rate;
            (unit, step, (0.5 * s * s - step) / rate)
        };
        FreeMode { one_minus_c: 0.0, s: unit, s_rate: kept, step, ramp, size: 0.0, angle: 0.0 }
    }

    /// The steady response to $`a\cos ws + b\sin ws`$, as factors of cosine and sine; infinite at resonance without damping.
    pub(crate) fn steady(&self, w: f64, (a, b): (f64, f64)) -> (f64, f64) {
        // two factors keep the digits near resonance
        let (re, im) = ((self.omega - w) * (self.omega + w), 2.0 * self.d * w);
        let norm = re * re + im * im;
        ((a * re - b * im) / norm, (b * re + a * im) / norm)
    }

    /// The forced responses from rest to $`\cos w_hs`$ and $`\sin w_hs`$, and the size of their terms. `free` and `turned`
    /// are those after the time `s`.
    pub(crate) fn forced(&self, h: usize, s: f64, free: &FreeMode, turned: &Turned) -> (f64, f64, f64) {
        match &self.forced[h] {
            Forced::Plain { w, z } => {
                // 1 - C less the versine is cos - C, with the digits of both small numbers
                let n = (free.one_minus_c - turned.versine, turned.sin - w * free.s);
                let norm = z.0 * z.0 + z.1 * z.1;
                let (kc, ks) = ((n.0 * z.0 + n.1 * z.1) / norm, (n.1 * z.0 - n.0 * z.1) / norm);
                let terms = turned.versine + free.size + turned.sin.abs() + (w * free.s).abs();
                let angle = w * s * 0.25;
                (kc, ks, (terms * 1.5 + angle) / z.0.abs().max(z.1))
            }
            Forced::Near(response) => {
                let p = response.at(self.omega * s);
                let size = (p.forced_size + p.forced_angle + self.omega * s * p.s.abs()) / self.k;
                (p.kc / self.k, p.ks / self.k, size)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The responses against Taylor integration in small steps.
    #[test]
    fn responses_in_every_regime() {
        for k in [0.0, 0.3, 1.0, 4.0, 1e4] {
            for d in [0.0, 1e-9, 0.02, 0.5, 1.0, 3.0] {
                for w in [0.3, 1.0, 1.0 + 1e-9, 2.0, 7.0] {
                    let mode = Mode::new(k, d, &[w]);
                    for s in [1e-3, 0.2, 1.7, 9.0] {
                        let (y0, v0, p0, p1, a, b) = (0.3, -0.8, 0.7, -0.2, 0.9, 0.4);
                        let free = mode.free(s);
                        let (kc, ks, _) = mode.forced(0, s, &free, &Turned::of(w * s));
                        let y = y0 - y0 * free.one_minus_c
                            + v0 * free.s
                            + p0 * free.step
                            + p1 * free.ramp
                            + a * kc
                            + b * ks;
                        let steps = 40.0 * (s * (1.0 + w + k.sqrt() + d)).ceil();
                        let (mut x, mut v, mut t) = (y0, v0, 0.0);
                        let h = s / steps;
                        while t < steps {
                            let now = t * h;
                            let mut c = [0.0; 14];
                            (c[0], c[1]) = (x, v);
                            let (mut factorial, mut power) = (1.0, 1.0);
                            for j in 0..12_u8 {
                                let turn = w * now + core::f64::consts::FRAC_PI_2 * f64::from(j);
                                let mut p = power * (a * turn.cos() + b * turn.sin());
                                if j == 0 {
                                    p += p0 + p1 * now;
                                } else if j == 1 {
                                    p += p1;
                                }
                                p /= factorial;
                                let i = usize::from(j);
                                let real = f64::from(j);
                                c[i + 2] =
                                    (p - 2.0 * d * (real + 1.0) * c[i + 1] - k * c[i]) / ((real + 1.0) * (real + 2.0));
                                factorial *= real + 1.0;
                                power *= w;
                            }
                            let (mut nx, mut nv) = (0.0, 0.0);
                            for j in (0..14_u8).rev() {
                                nx = nx * h + c[usize::from(j)];
                                if j > 0 {
                                    nv = nv * h + f64::from(j) * c[usize::from(j)];
                                }
                            }
                            (x, v) = (nx, nv);
                            t += 1.0;
                        }
                        let scale = 1.0 + x.abs() + 0.01 * s * s * s;
                        assert!((y - x).abs() < 2e-12 * scale, "k {k} d {d} w {w} s {s}: {y} {x}");
                    }
                }
            }
        }
    }
}

//! The response of the mass between impacts, in closed form for every $`\beta`$ and every damping.
//!
//! From any state the flight is
//!
//! $$`x(s) = x_0\,C(s) + v_0\,S(s) + \sin\varphi\,K_c(s) + \cos\varphi\,K_s(s)`$$
//!
//! where $`C, S`$ are the free responses to a unit displacement and a unit velocity ($`C' = -S`$,
//! $`S' = C - 2\zeta S`$) and $`K = K_c + iK_s = \int_0^s S(s-r)\,e^{i\beta r}\,dr`$ is the forced response from rest,
//! for which $`K' = S + i\beta K`$.
//!
//! The textbook form (eq. 3 of the 1971 paper) divides by $`1-\beta^2`$ and loses every digit near resonance, and its
//! resonant form (3)' holds at one point only. Here $`K`$ is the divided difference of the exponential over the three
//! characteristic exponents $`-\zeta \pm iw`$ and $`i\beta`$, $`w = \sqrt{1-\zeta^2}`$, in a form in which nothing
//! cancels. With $`h = (\beta - w)s/2`$, $`A = ws + h`$, $`E = e^{-\zeta s}`$:
//!
//! $$`K = \frac{1}{2iw}\left[e^{iA}\,\frac{(1-E)\cos h + i(1+E)\sin h}{\zeta + i(\beta-w)}
//!      - e^{ih}\,\frac{(1-E)\cos A + i(1+E)\sin A}{\zeta + i(\beta+w)}\right]`$$
//!
//! Only the first fraction can be $`0/0`$, and only at $`\zeta = 0`$, $`\beta = 1`$ exactly, where its value is $`s`$.
//! Everywhere else $`\beta - w = (\beta - 1) + \zeta^2/(1+w)`$ has full relative accuracy, and so has the quotient. So
//! one formula holds through resonance. Without damping it becomes, with $`Q = \sin h/(\beta-1)`$ ($`= s/2`$ at
//! resonance),
//!
//! $$`K_c = \frac{2Q\sin A}{\beta+1}, \qquad K_s = \frac{\sin A\cos h}{\beta+1} - Q\cos A.`$$
//!
//! Away from resonance - $`\zeta \ge 1/2`$, or $`\beta`$ outside [1/2, 2], where $`|Z| \ge 0.75`$ - nothing cancels in
//! the plain quotient $`K = (e^{i\beta s} - C - i\beta S)/Z`$, $`Z = 1-\beta^2+2i\zeta\beta`$. It is more accurate
//! there, because it uses $`\beta s`$ itself, and the sum $`ws + 2h`$ would add the rounding error of the larger term
//! to the smaller one.
//!
use super::free::{Free, FreeResponse, HEAVY, decay, versine};
use crate::math::Lane;

/// The frequency ratios near resonance, for which the formula that holds through resonance is used.
const NEAR: core::ops::RangeInclusive<f64> = 0.5..=2.0;

/// The free and forced responses after a time, from which any flight of the same oscillator is a linear combination.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Propagator {
    /// $`1 - C(s)`$, without cancellation at small `s`.
    pub one_minus_c: f64,
    /// $`C(s)`$, response to a unit displacement.
    pub c: f64,
    /// $`S(s)`$, response to a unit velocity.
    pub s: f64,
    /// $`S'(s) = C - 2\zeta S`$, without cancellation under heavy damping.
    pub s_rate: f64,
    /// $`K_c(s)`$, response from rest to the force $`\cos\beta s`$.
    pub kc: f64,
    /// $`K_s(s)`$, response from rest to the force $`\sin\beta s`$.
    pub ks: f64,
    /// $`\sin\beta s`$.
    pub sin_turn: f64,
    /// $`\cos\beta s`$.
    pub cos_turn: f64,
    /// Size of the terms of $`1 - C`$, for its rounding error.
    pub free_size: f64,
    /// The angle of the free part if it was rounded (with damping), else 0; its rounding error is proportional to it.
    pub free_angle: f64,
    /// Size of the terms of $`K`$, for its rounding error.
    pub forced_size: f64,
    /// The part of the angle of the force that was rounded, divided by $`|Z|`$; its rounding error changes the forced
    /// part along its velocity.
    pub forced_angle: f64,
}

/// The closed-form responses for one $`\beta`$ and $`\zeta`$, with the quantities that do not depend on time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Response {
    beta: f64,
    pub(super) free: FreeResponse,
    pub(super) regime: Regime,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Regime {
    /// $`\zeta = 0`$ near resonance: `detuning` $`= \beta - 1`$, `over_sum` $`= 1/(\beta+1)`$.
    Undamped { detuning: f64, over_sum: f64 },
    /// $`0 < \zeta < 1/2`$ near resonance: `detuning` $`= \beta - w`$.
    Light { detuning: f64 },
    /// Away from resonance.
    Plain,
}

impl Response {
    /// For checked parameters: `beta > 0`, `damping >= 0`, both finite.
    pub(crate) fn new(beta: f64, damping: f64) -> Self {
        let free = FreeResponse::new(damping);
        let regime = if !NEAR.contains(&beta) || damping >= HEAVY {
            Regime::Plain
        } else if damping == 0.0 {
            Regime::Undamped { detuning: beta - 1.0, over_sum: 1.0 / (beta + 1.0) }
        } else {
            // beta - w in full relative accuracy, as the difference of the two would not be
            Regime::Light { detuning: (beta - 1.0) + free.shift }
        };
        Self { beta, free, regime }
    }

    /// Frequency ratio $`\beta`$.
    #[inline]
    #[must_use]
    pub const fn beta(&self) -> f64 {
        self.beta
    }

    /// Damping ratio $`\zeta`$.
    #[inline]
    #[must_use]
    pub const fn damping(&self) -> f64 {
        self.free.damping
    }

    /// The responses after a time `s >= 0`.
    #[inline]
    #[must_use]
    pub fn at(&self, s: f64) -> Propagator {
        match self.regime {
            Regime::Undamped { over_sum, .. } => {
                let near = self.undamped_form().near(s, Turn::of(s));
                Propagator {
                    one_minus_c: near.one_minus_c,
                    c: near.c,
                    s: near.s,
                    s_rate: near.c,
                    kc: near.kc,
                    ks: near.ks,
                    sin_turn: near.sin_turn,
                    cos_turn: near.cos_turn,
                    free_size: near.one_minus_c,
                    free_angle: 0.0,
                    forced_size: near.forced_size,
                    // s itself is exact, and only h was rounded: 2|h|/|Z|
                    forced_angle: s * over_sum,
                }
            }
            Regime::Light { detuning } => {
                let over_angle = self.beta + self.free.root;
                self.light(s, detuning, decay(self.free.damping * s)).propagator(s / over_angle)
            }
            Regime::Plain => {
                let (re, im) = self.denominator();
                // |Z|, or a little less
                self.quotient(s, &self.free.at(s)).propagator(self.beta * s / re.abs().max(im.abs()))
            }
        }
    }

    /// The responses without damping, in lanes, with the bits of [`at`](Self::at); times and angles up to 1e5.
    #[inline(always)]
    pub(crate) fn undamped<L: Lane>(&self, s: L) -> Undamped<L> {
        self.undamped_form().splat().exact(s)
    }

    /// The constants of the closed form without damping.
    pub(crate) fn undamped_form(&self) -> UndampedForm<f64> {
        match self.regime {
            Regime::Undamped { detuning, over_sum } => {
                let kind = if detuning == 0.0 { FormKind::Resonance } else { FormKind::Near };
                UndampedForm { kind, numbers: [0.5 * detuning, 1.0 / detuning, over_sum] }
            }
            _ => {
                // two factors: 1 - beta^2 would cancel
                let over = 1.0 / ((1.0 - self.beta) * (1.0 + self.beta));
                UndampedForm { kind: FormKind::Plain, numbers: [self.beta, over, 0.0] }
            }
        }
    }

    /// The responses with damping below the critical one, in lanes, with the bits of [`at`](Self::at), from the
    /// [`decay`] after each time; times and angles up to 1e5.
    #[inline(always)]
    pub(crate) fn damped<L: Lane>(&self, s: L, decay: (L, L)) -> Damped<L> {
        match self.regime {
            Regime::Light { detuning } => self.light(s, detuning, decay),
            _ => self.quotient(s, &self.free.swing(s, self.free.swing_angle(s), decay)),
        }
    }

    /// The responses with light damping near resonance.
    #[inline(always)]
    fn light<L: Lane>(&self, s: L, detuning: f64, decay: (L, L)) -> Damped<L> {
        let swing = self.free.swing_angle(s);
        // h = (beta - w) s/2
        let half = (L::splat(0.5 * detuning) * s).sine_and_cosine();
        let near = NearForced::new(self, detuning, swing, half, decay);
        let (first, second) = (near.first, near.second);
        let free = self.free.swing(s, swing, decay);
        Damped {
            free,
            kc: near.kc,
            ks: near.ks,
            sin_turn: near.sin_turn,
            cos_turn: near.cos_turn,
            forced_size: (first.0.abs() + first.1.abs() + second.0.abs() + second.1.abs()) / L::splat(self.free.root)
                * (L::splat(1.0) + L::splat(0.25) * free.angle),
        }
    }

    /// The responses away from resonance, by the plain quotient.
    #[inline(always)]
    fn quotient<L: Lane>(&self, s: L, free: &Free<L>) -> Damped<L> {
        let (beta, z) = (L::splat(self.beta), self.denominator());
        let (st, ct) = (beta * s).sine_and_cosine();
        let versine = versine(st, ct);
        // 1 - C and the versine are small numbers with all their digits, C and the cosine are not
        let (kc, ks) = divide((free.one_minus_c - versine, st - beta * free.s), z);
        let size = versine + free.size + st.abs() + (beta * free.s).abs();
        let over = L::splat(z.0.abs().max(z.1));
        Damped { free: *free, kc, ks, sin_turn: st, cos_turn: ct, forced_size: size * L::splat(1.5) / over }
    }

    /// $`Z = 1-\beta^2+2i\zeta\beta`$.
    fn denominator(&self) -> (f64, f64) {
        ((1.0 - self.beta) * (1.0 + self.beta), 2.0 * self.free.damping * self.beta)
    }
}

/// The free and the forced response.
#[derive(Clone, Copy)]
pub(crate) struct Damped<L> {
    pub(crate) free: Free<L>,
    pub(crate) kc: L,
    pub(crate) ks: L,
    sin_turn: L,
    cos_turn: L,
    forced_size: L,
}

impl Damped<f64> {
    /// With the [angle](Propagator::forced_angle) of the force that was rounded.
    #[inline]
    const fn propagator(&self, forced_angle: f64) -> Propagator {
        let Self { free, kc, ks, sin_turn, cos_turn, forced_size } = *self;
        Propagator {
            one_minus_c: free.one_minus_c,
            c: free.c,
            s: free.s,
            s_rate: free.s_rate,
            kc,
            ks,
            sin_turn,
            cos_turn,
            free_size: free.size,
            free_angle: free.angle,
            forced_size,
            forced_angle,
        }
    }
}

/// The forced response with light damping near resonance, and its two fractions.
pub(super) struct NearForced<L> {
    first: (L, L),
    second: (L, L),
    pub(super) kc: L,
    pub(super) ks: L,
    pub(super) sin_turn: L,
    pub(super) cos_turn: L,
}

impl<L: Lane> NearForced<L> {
    /// From sine and cosine of $`ws`$ and of $`h`$, and $`E`$ and $`1 - E`$.
    #[inline(always)]
    pub(super) fn new(
        response: &Response,
        detuning: f64,
        (sw, cw): (L, L),
        (sh, ch): (L, L),
        (kept, loss): (L, L),
    ) -> Self {
        let (zeta, w) = (response.free.damping, response.free.root);
        // sine and cosine of A = ws + h
        let (sa, ca) = (sw * ch + cw * sh, cw * ch - sw * sh);
        let both = L::splat(1.0) + kept;
        let first = divide((loss * ch, both * sh), (zeta, detuning));
        let second = divide((loss * ca, both * sa), (zeta, response.beta + w));
        // e^{iA} first - e^{ih} second, then divided by 2iw
        let re = (ca * first.0 - sa * first.1) - (ch * second.0 - sh * second.1);
        let im = (sa * first.0 + ca * first.1) - (sh * second.0 + ch * second.1);
        let over = L::splat(2.0 * w);
        // by 2iw: the real part over i is the imaginary one; beta s = A + h
        Self { first, second, kc: im / over, ks: -re / over, sin_turn: sa * ch + ca * sh, cos_turn: ca * ch - sa * sh }
    }
}

/// The responses without damping ($`S' = C`$).
#[derive(Clone, Copy)]
pub(crate) struct Undamped<L> {
    pub(crate) one_minus_c: L,
    pub(crate) c: L,
    pub(crate) s: L,
    pub(crate) kc: L,
    pub(crate) ks: L,
    pub(crate) sin_turn: L,
    pub(crate) cos_turn: L,
    forced_size: L,
}

/// The sine and cosine of an angle, and 1 - cos without cancellation.
#[derive(Clone, Copy)]
struct Turn<L> {
    sin: L,
    cos: L,
    versine: L,
}

impl<L: Lane> Turn<L> {
    /// Accurate to the last bits.
    #[inline(always)]
    fn of(angle: L) -> Self {
        let (sin, cos) = angle.sine_and_cosine();
        Self { sin, cos, versine: versine(sin, cos) }
    }

    /// Accurate to two units in the last place, without a division.
    #[inline(always)]
    fn by_half(angle: L) -> Self {
        let (sin, cos) = (L::splat(0.5) * angle).sine_and_cosine();
        let twice = sin + sin;
        let versine = twice * sin;
        Self { sin: twice * cos, cos: L::splat(1.0) - versine, versine }
    }
}

/// The formulas of the closed form without damping.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum FormKind {
    /// Away from resonance.
    #[default]
    Plain,
    /// Near resonance.
    Near,
    /// At resonance.
    Resonance,
}

/// The constants of the closed form without damping, of one system or of several side by side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct UndampedForm<L> {
    pub(crate) kind: FormKind,
    /// Near resonance half the detuning, its inverse and $`1/(\beta+1)`$; otherwise $`\beta`$ and $`1/(1-\beta^2)`$.
    pub(crate) numbers: [L; 3],
}

impl UndampedForm<f64> {
    /// The same in every lane.
    #[inline(always)]
    pub(crate) fn splat<L: Lane>(&self) -> UndampedForm<L> {
        let [a, b, c] = self.numbers;
        UndampedForm { kind: self.kind, numbers: [L::splat(a), L::splat(b), L::splat(c)] }
    }
}

impl<L: Lane> UndampedForm<L> {
    /// The responses after times up to 1e5.
    #[inline(always)]
    pub(crate) fn at(&self, s: L) -> Undamped<L> {
        match self.kind {
            FormKind::Plain => self.plain(s),
            FormKind::Near | FormKind::Resonance => self.near(s, Turn::by_half(s)),
        }
    }

    /// The same with the bits of [`Response::at`].
    #[inline(always)]
    pub(crate) fn exact(&self, s: L) -> Undamped<L> {
        let free = Turn::of(s);
        if self.kind != FormKind::Plain {
            return self.near(s, free);
        }
        let [beta, ..] = self.numbers;
        let (one, turn) = (L::splat(1.0), Turn::of(beta * s));
        // by the operations of `quotient`, for its bits
        let z = ((one - beta) * (one + beta), L::splat(0.0));
        let (kc, ks) = divided((free.versine - turn.versine, turn.sin - beta * free.sin), z);
        let (sin_turn, cos_turn, forced_size) = (turn.sin, turn.cos, L::splat(0.0));
        Undamped { one_minus_c: free.versine, c: free.cos, s: free.sin, kc, ks, sin_turn, cos_turn, forced_size }
    }

    /// Near resonance and at resonance.
    #[inline(always)]
    fn near(&self, s: L, free: Turn<L>) -> Undamped<L> {
        let [half, over_detuning, over_sum] = self.numbers;
        let (ss, cs) = (free.sin, free.cos);
        let (sh, ch) = (half * s).sine_and_cosine();
        // sin h/(beta - 1), which at resonance is 0/0 with the limit s/2
        let q = if self.kind == FormKind::Resonance { L::splat(0.5) * s } else { sh * over_detuning };
        let (sa, ca) = (ss * ch + cs * sh, cs * ch - ss * sh);
        let part = sa * over_sum;
        Undamped {
            one_minus_c: free.versine,
            c: cs,
            s: ss,
            kc: L::splat(2.0) * q * part,
            ks: part * ch - q * ca,
            // beta s = A + h
            sin_turn: sa * ch + ca * sh,
            cos_turn: ca * ch - sa * sh,
            forced_size: part.abs() + q.abs(),
        }
    }

    /// Away from resonance: $`K = (e^{i\beta s} - C - i\beta S)/(1-\beta^2)`$.
    #[inline(always)]
    fn plain(&self, s: L) -> Undamped<L> {
        let [beta, over, _] = self.numbers;
        let (free, turn) = (Turn::by_half(s), Turn::by_half(beta * s));
        Undamped {
            one_minus_c: free.versine,
            c: free.cos,
            s: free.sin,
            kc: (free.versine - turn.versine) * over,
            ks: (turn.sin - beta * free.sin) * over,
            sin_turn: turn.sin,
            cos_turn: turn.cos,
            forced_size: L::splat(0.0),
        }
    }
}

/// The quotient of two complex numbers.
#[inline(always)]
pub(super) fn divide<L: Lane>(n: (L, L), d: (f64, f64)) -> (L, L) {
    divided(n, (L::splat(d.0), L::splat(d.1)))
}

/// The same for a divisor in each lane.
#[inline(always)]
fn divided<L: Lane>(n: (L, L), (re, im): (L, L)) -> (L, L) {
    let norm = re * re + im * im;
    ((n.0 * re + n.1 * im) / norm, (n.1 * re - n.0 * im) / norm)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Eighth-order Taylor integration in small steps: an independent, slow reference.
    fn by_integration(beta: f64, zeta: f64, s: f64, x0: f64, v0: f64, phi: f64) -> (f64, f64) {
        let steps = ((s * (1.0 + beta + zeta)) * 40.0).ceil();
        let h = s / steps;
        let (mut x, mut v) = (x0, v0);
        let mut k = 0.0;
        while k < steps {
            let theta = phi + beta * h * k;
            let mut d = [0.0; 12];
            (d[0], d[1]) = (x, v);
            let mut bk = 1.0;
            for j in 0..10 {
                let quarter = core::f64::consts::FRAC_PI_2 * f64::from(u32::try_from(j).unwrap());
                d[j + 2] = bk * (theta + quarter).sin() - d[j] - 2.0 * zeta * d[j + 1];
                bk *= beta;
            }
            let mut power = 1.0;
            (x, v) = (0.0, 0.0);
            for j in 0..11 {
                x += d[j] * power;
                v += d[j + 1] * power;
                power *= h / f64::from(u32::try_from(j + 1).unwrap());
            }
            k += 1.0;
        }
        (x, v)
    }

    #[test]
    fn matches_slow_integration_in_every_regime() {
        let betas = [0.01, 0.3, 0.9, 1.0 - 1e-3, 1.0 - 1e-9, 1.0, 1.0 + 1e-12, 1.0 + 1e-5, 1.7, 8.0, 60.0];
        let dampings = [0.0, 1e-9, 1e-3, 0.1, 0.499, 0.5, 0.9, 1.0 - 1e-13, 1.0, 1.0 + 1e-9, 1.3, 2.5, 7.0];
        for beta in betas {
            for zeta in dampings {
                let response = Response::new(beta, zeta);
                for s in [0.05, 0.7, 3.0, 11.0] {
                    let p = response.at(s);
                    let (x0, v0, phi) = (0.3, -0.8, 2.2_f64);
                    let (sp, cp) = phi.sin_cos();
                    let x = x0 * p.c + v0 * p.s + sp * p.kc + cp * p.ks;
                    let v = -x0 * p.s + v0 * (p.c - 2.0 * zeta * p.s) + sp * (p.s - beta * p.ks) + cp * beta * p.kc;
                    let (wx, wv) = by_integration(beta, zeta, s, x0, v0, phi);
                    assert!((x - wx).abs() < 3e-13, "beta {beta} zeta {zeta} s {s}: x {x} {wx}");
                    assert!((v - wv).abs() < 3e-13 * (1.0 + beta), "beta {beta} zeta {zeta} s {s}: v {v} {wv}");
                    assert!((p.one_minus_c + p.c - 1.0).abs() < 1e-14);
                    assert!((p.sin_turn - (beta * s).sin()).abs() < 1e-13);
                    assert!((p.cos_turn - (beta * s).cos()).abs() < 1e-13);
                }
            }
        }
    }

    #[test]
    fn lanes_without_damping_have_the_same_bits() {
        for beta in [1e-3, 0.3, 0.5, 0.9, 1.0, 1.0 + 1e-9, 2.0, 2.7, 40.0] {
            let response = Response::new(beta, 0.0);
            for s in [1e-9, 0.05, 0.7, 1.6, 3.0, 4.7, 11.0, 300.0] {
                let (p, q) = (response.at(s), response.undamped(s));
                assert_eq!([p.one_minus_c, p.c, p.s, p.kc, p.ks], [q.one_minus_c, q.c, q.s, q.kc, q.ks], "{beta} {s}");
            }
        }
    }

    #[test]
    fn resonance_is_the_papers_equation_3_prime() {
        let p = Response::new(1.0, 0.0).at(5.0);
        // force sin(s): x = sin(s)/2 - s cos(s)/2 from rest
        assert!((p.ks - (0.5 * 5_f64.sin() - 2.5 * 5_f64.cos())).abs() < 1e-15);
        assert!((p.kc - 2.5 * 5_f64.sin()).abs() < 1e-15);
    }

    #[test]
    fn no_digits_are_lost_beside_resonance() {
        // the difference from resonance is the first-order term, down to 1e-13 away
        let at = |beta: f64| Response::new(beta, 0.0).at(9.0);
        let base = at(1.0);
        let slope = (at(1.0 + 1e-5).kc - at(1.0 - 1e-5).kc) / 2e-5;
        for k in 6..13 {
            let d = 10_f64.powi(-k);
            let beta = 1.0 + d;
            let predicted = base.kc + (beta - 1.0) * slope;
            assert!((at(beta).kc - predicted).abs() < 1e-15 + 1e3 * d * d + 1e-9 * d, "1 + 1e-{k}");
        }
    }
}

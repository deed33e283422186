//! The flight as a textbook writes it: amplitudes of the free motion and of the steady one.
//!
//! $$x = e^{-\zeta s}(A\cos ws + B\sin ws) + P\cos\beta s + Q\sin\beta s, \qquad
//!   Q + iP = \frac{e^{i\varphi}}{1 - \beta^2 + 2i\zeta\beta},\quad A = x_0 - P,\quad B = \frac{v_0 + \zeta A - \beta Q}{w}$$
//!
//! for $\zeta < 1$, $w = \sqrt{1-\zeta^2}$; at critical damping the bracket is $A + Bs$, above it a sum of two
//! exponentials; undamped resonance is the case of its own that every textbook makes it,
//! $x = x_0\cos s + (v_0 + \frac12\cos\varphi)\sin s - \frac s2\cos(s + \varphi)$. These forms lose every digit of a
//! double beside resonance; here there are enough digits to lose.

use super::elementary::{decay, sin_cos};
use super::fixed::Fixed;

/// What a flight depends on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Data {
    pub(crate) beta: Fixed,
    pub(crate) zeta: Fixed,
    pub(crate) x: Fixed,
    pub(crate) v: Fixed,
    /// Sine and cosine of the phase of the force; both zero: no force.
    pub(crate) force: (Fixed, Fixed),
}

/// A point of the flight.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    pub(crate) s: Fixed,
    /// Displacement from the start.
    pub(crate) d: Fixed,
    pub(crate) v: Fixed,
    /// Acceleration, to the precision of a double.
    pub(crate) a: f64,
}

/// One flight with its amplitudes worked out.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Solution {
    data: Data,
    free: Free,
    /// $P$ and $Q$; at resonance the factors of $-s/2$: $\cos\varphi$ and $-\sin\varphi$.
    steady: (Fixed, Fixed),
    resonant: bool,
}

/// Amplitudes of the free motion.
#[derive(Clone, Copy, Debug)]
enum Free {
    Under {
        w: Fixed,
        a: Fixed,
        b: Fixed,
    },
    Critical {
        a: Fixed,
        b: Fixed,
    },
    /// $a e^{-l s} + b e^{-m s}$.
    Over {
        l: Fixed,
        m: Fixed,
        a: Fixed,
        b: Fixed,
    },
}

/// The time-dependent factors: of the free motion (two functions), and $\cos\beta s, \sin\beta s$.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Factors {
    free: (Fixed, Fixed),
    turn: (Fixed, Fixed),
}

impl Solution {
    pub(crate) fn new(data: Data) -> Self {
        let Data { beta, zeta, x, v, force: (sine, cosine) } = data;
        let one = Fixed::ONE;
        let (zr, zi) = (one - beta * beta, (zeta * beta).times(2));
        let resonant = zr == Fixed::ZERO && zi == Fixed::ZERO;
        let steady = if resonant {
            (cosine, -sine)
        } else if zi == Fixed::ZERO {
            let factor = zr.inverse();
            (sine * factor, cosine * factor)
        } else {
            let factor = (zr * zr + zi * zi).inverse();
            ((sine * zr - cosine * zi) * factor, (cosine * zr + sine * zi) * factor)
        };
        // start of the free motion
        let (xf, vf) = if resonant { (x, v + cosine.halved(1)) } else { (x - steady.0, v - beta * steady.1) };
        let square = one - zeta * zeta;
        let free = if zeta == one {
            Free::Critical { a: xf, b: vf + xf }
        } else if square.is_negative() {
            let inverse = (-square).inverse_sqrt();
            let root = -square * inverse;
            let (l, m) = (zeta + root, zeta - root);
            let a = -(vf + m * xf) * inverse.halved(1);
            Free::Over { l, m, a, b: xf - a }
        } else {
            let inverse = square.inverse_sqrt();
            Free::Under { w: square * inverse, a: xf, b: (vf + zeta * xf) * inverse }
        };
        Self { data, free, steady, resonant }
    }

    pub(crate) fn data(&self) -> &Data {
        &self.data
    }

    pub(crate) fn factors(&self, s: Fixed) -> Factors {
        let free = match self.free {
            Free::Under { w, .. } => {
                let (sine, cosine) = sin_cos(w * s);
                let kept = if self.data.zeta == Fixed::ZERO { Fixed::ONE } else { decay(self.data.zeta * s) };
                (kept * cosine, kept * sine)
            }
            Free::Critical { .. } => (decay(s), Fixed::ZERO),
            Free::Over { l, m, .. } => (decay(l * s), decay(m * s)),
        };
        let (sine, cosine) = sin_cos(self.data.beta * s);
        Factors { free, turn: (cosine, sine) }
    }

    /// Factors after a further time, whose factors are `by`: a rotation, a few units of $2^{-256}$ off.
    pub(crate) fn advance(&self, f: &Factors, by: &Factors) -> Factors {
        let rotate = |(c, s): (Fixed, Fixed), (dc, ds): (Fixed, Fixed)| (c * dc - s * ds, c * ds + s * dc);
        let free = match self.free {
            Free::Under { .. } => rotate(f.free, by.free),
            Free::Critical { .. } | Free::Over { .. } => (f.free.0 * by.free.0, f.free.1 * by.free.1),
        };
        Factors { free, turn: rotate(f.turn, by.turn) }
    }

    pub(crate) fn at(&self, s: Fixed) -> Node {
        self.node(s, &self.factors(s))
    }

    pub(crate) fn node(&self, s: Fixed, factors: &Factors) -> Node {
        let Data { beta, zeta, .. } = self.data;
        let (mut x, mut v) = match self.free {
            Free::Under { w, a, b } => {
                let (c, s) = factors.free;
                (a * c + b * s, (w * b - zeta * a) * c - (w * a + zeta * b) * s)
            }
            Free::Critical { a, b } => {
                let kept = factors.free.0;
                let linear = a + b * s;
                (kept * linear, kept * (b - linear))
            }
            Free::Over { l, m, a, b } => {
                let (fast, slow) = (a * factors.free.0, b * factors.free.1);
                (fast + slow, -(l * fast) - m * slow)
            }
        };
        let ((c, sn), (p, q)) = (factors.turn, self.steady);
        let (wave, slope) = (p * c + q * sn, q * c - p * sn);
        if self.resonant {
            // -s/2 cos(s + phi) and its derivative
            x = x - (s * wave).halved(1);
            v = v - (wave + s * slope).halved(1);
        } else {
            x = x + wave;
            v = v + beta * slope;
        }
        let (sine, cosine) = (self.data.force.0.to_f64(), self.data.force.1.to_f64());
        let push = sine * c.to_f64() + cosine * sn.to_f64();
        let a = push - x.to_f64() - 2.0 * zeta.to_f64() * v.to_f64();
        Node { s, d: x - self.data.x, v, a }
    }
}

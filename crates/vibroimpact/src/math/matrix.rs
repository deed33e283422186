//! Two-by-two matrices: derivatives of the impact map, and multipliers of their products.

use super::hypot;

/// A real 2 x 2 matrix, by rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Matrix2(pub [[f64; 2]; 2]);

impl Matrix2 {
    /// The identity.
    pub const IDENTITY: Self = Self([[1.0, 0.0], [0.0, 1.0]]);

    /// The product `self * other`: `other` is applied first.
    #[must_use]
    pub fn times(self, other: Self) -> Self {
        let ([[a, b], [c, d]], [[e, f], [g, h]]) = (self.0, other.0);
        Self([[a * e + b * g, a * f + b * h], [c * e + d * g, c * f + d * h]])
    }

    /// The image of a vector.
    #[must_use]
    pub fn apply(self, v: [f64; 2]) -> [f64; 2] {
        let [[a, b], [c, d]] = self.0;
        [a * v[0] + b * v[1], c * v[0] + d * v[1]]
    }

    /// The trace.
    #[must_use]
    pub fn trace(self) -> f64 {
        self.0[0][0] + self.0[1][1]
    }

    /// The determinant.
    #[must_use]
    pub fn determinant(self) -> f64 {
        let [[a, b], [c, d]] = self.0;
        a * d - b * c
    }

    /// The solution `x` of `self * x = v`, or `None` if the matrix is singular to working precision.
    #[must_use]
    pub fn solve(self, v: [f64; 2]) -> Option<[f64; 2]> {
        let [[a, b], [c, d]] = self.0;
        let det = self.determinant();
        // the determinant is a difference: it is zero if it is small beside its terms
        let size = (a * d).abs() + (b * c).abs();
        if !det.is_finite() || det.abs() <= 1e-15 * size {
            return None;
        }
        Some([(d * v[0] - b * v[1]) / det, (a * v[1] - c * v[0]) / det])
    }
}

/// An eigenvalue, with real and imaginary part.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Multiplier {
    /// Real part.
    pub re: f64,
    /// Imaginary part.
    pub im: f64,
}

impl Multiplier {
    /// Absolute value.
    #[must_use]
    pub fn modulus(self) -> f64 {
        hypot(self.re, self.im)
    }

    /// Whether it is one of a complex pair on the unit circle. Two real ones whose product is 1 are not.
    pub(crate) fn is_on_circle(self) -> bool {
        self.im.abs() > 1e-6 && (self.modulus() - 1.0).abs() < 1e-6
    }
}

/// The two eigenvalues of a matrix with this trace and determinant, the larger first. The smaller is computed as the
/// determinant over the larger, so it keeps its digits even if it is very small.
#[must_use]
pub fn eigenvalues(trace: f64, determinant: f64) -> [Multiplier; 2] {
    let half = 0.5 * trace;
    let disc = half * half - determinant;
    if disc < 0.0 {
        let im = (-disc).sqrt();
        return [Multiplier { re: half, im }, Multiplier { re: half, im: -im }];
    }
    let large = if half < 0.0 { half - disc.sqrt() } else { half + disc.sqrt() };
    let small = if large == 0.0 { 0.0 } else { determinant / large };
    [Multiplier { re: large, im: 0.0 }, Multiplier { re: small, im: 0.0 }]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiny_eigenvalues_keep_their_digits() {
        let [large, small] = eigenvalues(3.0 + 1e-30, 3e-30);
        assert_eq!(large.re, 3.0);
        assert!((small.re / 1e-30 - 1.0).abs() < 1e-15);
        let [one, two] = eigenvalues(0.0, 4.0);
        assert_eq!((one.im, two.im), (2.0, -2.0));
        assert_eq!(eigenvalues(0.0, 0.0)[0].modulus(), 0.0);
    }

    #[test]
    fn solves_and_refuses() {
        let m = Matrix2([[2.0, 1.0], [1.0, 3.0]]);
        let x = m.solve(m.apply([0.3, -0.7])).unwrap();
        assert!((x[0] - 0.3).abs() < 1e-15 && (x[1] + 0.7).abs() < 1e-15);
        assert_eq!(Matrix2([[1.0, 2.0], [2.0, 4.0]]).solve([1.0, 1.0]), None);
    }
}

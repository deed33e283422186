//! Eigenvalues and eigenvectors of symmetric matrices, by Jacobi's rotations.
//!
//! The rotations are applied in a fixed order, so the result has the same bits on every platform. Jacobi's method finds
//! the eigenvectors orthogonal to rounding, also those of equal eigenvalues.

use super::Matrix;
use crate::math::sort_by;

/// The largest number of sweeps; six to ten suffice, because convergence is quadratic.
const SWEEPS: u32 = 60;

/// The eigenvalues of a symmetric matrix in ascending order, and its orthonormal eigenvectors as columns.
pub(crate) fn symmetric_eigen(matrix: &Matrix) -> (Vec<f64>, Matrix) {
    let n = matrix.rows();
    let mut a = matrix.clone();
    let mut vectors = Matrix::identity(n);
    for _ in 0..SWEEPS {
        let mut turned = false;
        for p in 0..n {
            for q in p + 1..n {
                turned |= rotate(&mut a, &mut vectors, p, q);
            }
        }
        if !turned {
            break;
        }
    }
    let mut order: Vec<usize> = (0..n).collect();
    sort_by(&mut order, |i, j| a[(*i, *i)].total_cmp(&a[(*j, *j)]).then(i.cmp(j)));
    let values = order.iter().map(|i| a[(*i, *i)]).collect();
    let mut sorted = Matrix::zeros(n, n);
    for (to, from) in order.into_iter().enumerate() {
        // the largest component is positive, so that the sign does not depend on the rotations
        let column = vectors.column(from);
        let largest = column.iter().fold(0.0_f64, |most, x| if x.abs() > most.abs() { *x } else { most });
        for (i, x) in column.iter().enumerate() {
            sorted[(i, to)] = if largest < 0.0 { -x } else { *x };
        }
    }
    (values, sorted)
}

/// Makes the element (p, q) zero by a rotation; `false` if it is negligible.
fn rotate(a: &mut Matrix, vectors: &mut Matrix, p: usize, q: usize) -> bool {
    let off = a[(p, q)];
    let (app, aqq) = (a[(p, p)], a[(q, q)]);
    // negligible: it would not change the two eigenvalues, which are those of a definite matrix
    if off == 0.0 || off.abs() <= 1e-3 * f64::EPSILON * (app * aqq).abs().sqrt() || off.abs() < f64::MIN_POSITIVE {
        (a[(p, q)], a[(q, p)]) = (0.0, 0.0);
        return false;
    }
    let half = (aqq - app) / (2.0 * off);
    // the smaller of the two angles, with which the rotations converge; the square of a large quotient would overflow
    let tangent = if half.abs() > 1e150 {
        0.5 / half
    } else {
        let t = 1.0 / (half.abs() + (half * half + 1.0).sqrt());
        if half < 0.0 { -t } else { t }
    };
    let cosine = 1.0 / (tangent * tangent + 1.0).sqrt();
    let sine = tangent * cosine;
    let n = a.rows();
    for k in 0..n {
        if k != p && k != q {
            let (x, y) = (a[(k, p)], a[(k, q)]);
            let (x, y) = (cosine * x - sine * y, sine * x + cosine * y);
            (a[(k, p)], a[(p, k)]) = (x, x);
            (a[(k, q)], a[(q, k)]) = (y, y);
        }
        let (x, y) = (vectors[(k, p)], vectors[(k, q)]);
        (vectors[(k, p)], vectors[(k, q)]) = (cosine * x - sine * y, sine * x + cosine * y);
    }
    a[(p, p)] = app - tangent * off;
    a[(q, q)] = aqq + tangent * off;
    (a[(p, q)], a[(q, p)]) = (0.0, 0.0);
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eigenvectors_of_a_chain_and_of_equal_values() {
        for n in [1, 2, 3, 8, 30] {
            let mut chain = Matrix::zeros(n, n);
            for i in 0..n {
                chain[(i, i)] = 2.0;
                if i + 1 < n {
                    (chain[(i, i + 1)], chain[(i + 1, i)]) = (-1.0, -1.0);
                }
            }
            let (values, vectors) = symmetric_eigen(&chain);
            for (k, value) in values.iter().enumerate() {
                let real = |k: usize| f64::from(u32::try_from(k).unwrap());
                // closed form: 4 sin^2(pi k / (2 (n + 1)))
                let sine = (core::f64::consts::PI * real(k + 1) / (2.0 * real(n + 1))).sin();
                assert!((value - 4.0 * sine * sine).abs() < 1e-14, "{n} {k}: {value}");
                let v = vectors.column(k);
                let image = chain.apply(&v);
                assert!(image.iter().zip(&v).all(|(a, b)| (a - value * b).abs() < 1e-14));
            }
            let gram = vectors.transposed().times(&vectors);
            for i in 0..n {
                for j in 0..n {
                    assert!((gram[(i, j)] - f64::from(u8::from(i == j))).abs() < 1e-14);
                }
            }
        }
        let (values, vectors) = symmetric_eigen(&Matrix::diagonal(&[3.0, 1.0, 3.0]));
        assert_eq!(values, [1.0, 3.0, 3.0]);
        assert_eq!(vectors.column(0), [0.0, 1.0, 0.0]);
    }

    /// A stiff spring between two light bodies: the small eigenvalue keeps its digits.
    #[test]
    fn small_eigenvalues_keep_their_digits() {
        let k = 1e8;
        let (values, _) = symmetric_eigen(&Matrix::from_rows(&[vec![1.0 + k, -k], vec![-k, 1.0 + k]]).unwrap());
        assert!((values[0] - 1.0).abs() < 4e-8, "{}", values[0]);
        assert!((values[1] / (1.0 + 2.0 * k) - 1.0).abs() < 1e-15);
    }
}

//! Damping that is given by the damping ratios of the modes.

use crate::math::{Matrix, symmetric_eigen};

/// The damping matrix with these damping ratios $`\zeta_i`$ of the modes of a mass and a stiffness matrix, from the
/// lowest frequency. `None` if the mass matrix is not positive definite or if sizes differ.
///
/// With $`M = LL^T`$ and the eigenvectors $`u_i`$ of $`L^{-1}KL^{-T}`$ the matrix is
/// $`\sum_i 2\zeta_i\omega_i\,(Lu_i)(Lu_i)^T`$. A mode with frequency 0 has no damping.
///
/// ```
/// use vibroimpact::math::Matrix;
/// use vibroimpact::machine::modal_damping;
/// let damping = modal_damping(&Matrix::diagonal(&[2.0]), &Matrix::diagonal(&[8.0]), &[0.1]).unwrap();
/// assert!((damping[(0, 0)] - 2.0 * 0.1 * 2.0 * 2.0).abs() < 1e-15);
/// ```
#[must_use]
pub fn modal_damping(mass: &Matrix, stiffness: &Matrix, ratios: &[f64]) -> Option<Matrix> {
    let n = ratios.len();
    let fits = |matrix: &Matrix| matrix.rows() == n && matrix.columns() == n;
    if !fits(mass) || !fits(stiffness) {
        return None;
    }
    let factor = mass.cholesky()?;
    let reduced = stiffness.reduced(&factor);
    let (squares, vectors) = symmetric_eigen(&reduced);
    let mut damping = Matrix::zeros(n, n);
    for (k, ratio) in ratios.iter().enumerate() {
        let size = 2.0 * ratio * squares[k].max(0.0).sqrt();
        let shape = factor.apply(&vectors.column(k));
        for i in 0..n {
            for j in 0..n {
                damping[(i, j)] += size * (shape[i] * shape[j]);
            }
        }
    }
    Some(damping)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// C M^-1 C = 4 zeta^2 K for equal ratios, an identity without eigenvectors.
    #[test]
    fn equal_ratios() {
        let rows =
            |rows: &[[f64; 3]]| Matrix::from_rows(&rows.iter().map(|row| row.to_vec()).collect::<Vec<_>>()).unwrap();
        let mass = rows(&[[2.0, 0.3, 0.0], [0.3, 1.0, 0.1], [0.0, 0.1, 0.5]]);
        let stiffness = rows(&[[5.0, -2.0, 0.0], [-2.0, 4.0, -1.0], [0.0, -1.0, 3.0]]);
        let damping = modal_damping(&mass, &stiffness, &[0.05; 3]).unwrap();
        let factor = mass.cholesky().unwrap();
        // C L^-T, because C is symmetric
        let half: Vec<Vec<f64>> = (0..3).map(|i| factor.solve_lower(damping.row(i))).collect();
        let half = Matrix::from_rows(&half).unwrap();
        let product = half.times(&half.transposed());
        for i in 0..3 {
            for j in 0..3 {
                assert_eq!(damping[(i, j)], damping[(j, i)]);
                let wanted = 4.0 * 0.05 * 0.05 * stiffness[(i, j)];
                assert!((product[(i, j)] - wanted).abs() < 1e-16, "{} {wanted}", product[(i, j)]);
            }
        }
    }

    #[test]
    fn the_lowest_mode_comes_first() {
        let (mass, stiffness) = (Matrix::identity(2), Matrix::diagonal(&[9.0, 4.0]));
        let damping = modal_damping(&mass, &stiffness, &[0.1, 0.2]).unwrap();
        assert_eq!(damping, Matrix::diagonal(&[2.0 * 0.2 * 3.0, 2.0 * 0.1 * 2.0]));
        assert_eq!(modal_damping(&Matrix::diagonal(&[-1.0]), &Matrix::identity(1), &[0.1]), None);
        assert_eq!(modal_damping(&mass, &stiffness, &[0.1]), None);
    }
}

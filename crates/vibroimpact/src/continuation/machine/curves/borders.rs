//! A test function for singular matrices.
//!
//! The linear equations of a cycle, in which the changes of the first event return after one period multiplied by +1 or -1,
//! have a solution where a multiplier is +1 or -1. With two borders $`b`$ and $`c`$ the system
//!
//! $$`\begin{pmatrix} A & b\\ c^T & 0\end{pmatrix}\begin{pmatrix} v\\ g\end{pmatrix} = \begin{pmatrix} 0\\ 1\end{pmatrix}`$$
//!
//! is regular also where $`A`$ is singular, and g is zero there and only there (A. Griewank and G. W. Reddien, "Characterization
//! and computation of generalized turning points", SIAM Journal on Numerical Analysis 21 (1984) 176-185). Unlike the multipliers, g is
//! smooth through grazing impacts, at which multipliers are infinite.

use crate::math::{Lu, Matrix, dot};

/// The borders: approximate null vectors of a matrix whose rows and columns have been divided by their sizes.
#[derive(Clone, Debug)]
pub(super) struct Borders {
    rows: Vec<f64>,
    columns: Vec<f64>,
    left: Vec<f64>,
    right: Vec<f64>,
}

/// Rounds of inverse iteration.
const ROUNDS: usize = 4;
/// Added on the diagonal of a matrix that is exactly singular.
const BESIDE: f64 = 1e-13;

impl Borders {
    /// The borders of a matrix whose unknowns have these sizes; in the direction of those `before`.
    pub(super) fn new(matrix: &Matrix, columns: Vec<f64>, before: Option<&Self>) -> Option<Self> {
        let size = matrix.rows();
        let largest =
            |i: usize| matrix.row(i).iter().zip(&columns).fold(0.0_f64, |most, (a, c)| most.max((a * c).abs()));
        let rows: Vec<f64> = (0..size).map(|i| 1.0 / largest(i).max(f64::MIN_POSITIVE)).collect();
        // uneven, so that they are not perpendicular to a singular vector by symmetry
        let some = || (0..size).map(|i| if i % 2 == 0 { 1.0 } else { 0.7 }).collect::<Vec<f64>>();
        let (left, right) = before.map_or_else(|| (some(), some()), |known| (known.left.clone(), known.right.clone()));
        let mut borders = Self { rows, columns, left, right };
        let scaled = borders.scaled(matrix);
        let factors = |matrix: &Matrix| {
            Lu::new(matrix.values().to_vec(), size).or_else(|| {
                // singular to the last bit: a little beside, solutions have the singular direction all the same
                let mut other = matrix.clone();
                (0..size).for_each(|i| other[(i, i)] += BESIDE);
                Lu::new(other.values().to_vec(), size)
            })
        };
        let (straight, turned) = (factors(&scaled)?, factors(&scaled.transposed())?);
        // each solution is nearer to the singular vector than the border before
        for _ in 0..ROUNDS {
            borders.right = unit(&straight, &borders.left, &borders.right)?;
            borders.left = unit(&turned, &borders.right, &borders.left)?;
        }
        Some(borders)
    }

    /// The borders of another matrix, in the same direction.
    pub(super) fn renewed(&self, matrix: &Matrix) -> Option<Self> {
        Self::new(matrix, self.columns.clone(), Some(self))
    }

    fn scaled(&self, matrix: &Matrix) -> Matrix {
        let mut scaled = matrix.clone();
        for (i, row) in self.rows.iter().enumerate() {
            scaled.row_mut(i).iter_mut().zip(&self.columns).for_each(|(a, column)| *a *= row * column);
        }
        scaled
    }

    /// The test function of a matrix near the one of the borders, and its approximate null vector.
    pub(super) fn test(&self, matrix: &Matrix) -> Option<(f64, Vec<f64>)> {
        let size = matrix.rows();
        let scaled = self.scaled(matrix);
        let mut rows = Vec::with_capacity((size + 1) * (size + 1));
        // the bordered matrix is regular; the last number of the solution is zero where the matrix itself is singular
        for (i, left) in self.left.iter().enumerate() {
            rows.extend_from_slice(scaled.row(i));
            rows.push(*left);
        }
        rows.extend_from_slice(&self.right);
        rows.push(0.0);
        let mut solution = vec![0.0; size + 1];
        solution[size] = 1.0;
        Lu::new(rows, size + 1)?.solve(&mut solution);
        let g = solution.pop()?;
        let vector = solution.iter().zip(&self.columns).map(|(v, column)| v * column).collect();
        g.is_finite().then_some((g, vector))
    }
}

/// The solution of length 1, with a positive product with `known`.
fn unit(lu: &Lu, from: &[f64], known: &[f64]) -> Option<Vec<f64>> {
    let mut x = from.to_vec();
    lu.solve(&mut x);
    let length = dot(&x, &x).sqrt();
    // with the sign of the border before, so that the test function keeps its own
    let length = if dot(&x, known) < 0.0 { -length } else { length };
    (length != 0.0 && length.is_finite()).then(|| x.iter().map(|x| x / length).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The test function of a diagonal matrix is minus its small element, whatever the sizes of the rows.
    #[test]
    fn zero_where_it_is_singular() {
        let at = |small: f64| Matrix::diagonal(&[1e6, small, -3.0]);
        let borders = Borders::new(&at(0.0), vec![1.0; 3], None).unwrap();
        assert_eq!(borders.right.iter().map(|x| x.abs().round()).collect::<Vec<_>>(), [0.0, 1.0, 0.0]);
        let (g, v) = borders.test(&at(0.0)).unwrap();
        assert!(g.abs() < 1e-15 && v[0].abs() < 1e-15 && (v[1].abs() - 1.0).abs() < 1e-12, "{g} {v:?}");
        let near = Borders::new(&at(1e-9), vec![1.0; 3], Some(&borders)).unwrap();
        let (one, two) = (near.test(&at(1e-3)).unwrap().0, near.test(&at(-1e-3)).unwrap().0);
        assert!(one * two < 0.0 && (one + two).abs() < 1e-9 * one.abs(), "{one} {two}");
    }
}

//! Matrices whose rows have very different sizes, as those of a flight in which some directions decay by many powers of ten.

use super::{Matrix, exp, ln};

/// A matrix with the rows $`e^{s_i}w_i`$.
#[derive(Clone, Debug, Default)]
pub(crate) struct Graded {
    /// The rows $`w_i`$.
    pub(crate) rows: Vec<Vec<f64>>,
    /// The logarithms $`s_i`$.
    pub(crate) scales: Vec<f64>,
}

/// A graded matrix as the product $`L\,\mathrm{diag}(e^{s})\,U`$ with a unit lower triangular $`L`$ (of exchanged rows) whose
/// elements are at most 1, and an upper triangular $`U`$.
#[derive(Clone, Debug)]
pub(crate) struct GradedFactors {
    /// The columns of $`L`$; of a column that depends on those before it nothing.
    pub(crate) lower: Vec<Vec<f64>>,
    /// The logarithms $`s`$; minus infinity for a column that depends on those before it.
    pub(crate) scales: Vec<f64>,
    pub(crate) upper: Matrix,
}

impl Graded {
    /// Adds the row $`e^{s}w`$.
    pub(crate) fn push(&mut self, row: Vec<f64>, scale: f64) {
        self.rows.push(row);
        self.scales.push(scale);
    }

    /// Its factors, by elimination in which the largest element of a column, with the size of its row, is the pivot. Each
    /// column has the digits that its own size allows, however small its row is beside others. What is left of an element and is
    /// no more than the part `vanished` of the largest of its row is a rounding error. A matrix without rows has so
    /// many columns of zeros.
    pub(crate) fn factors(mut self, columns: usize, vanished: f64) -> GradedFactors {
        let mut left: Vec<usize> = (0..self.rows.len()).collect();
        let largest = |row: &Vec<f64>| row.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let least: Vec<f64> = self.rows.iter().map(|row| vanished * largest(row)).collect();
        let mut factors = GradedFactors {
            lower: Vec::with_capacity(columns),
            scales: Vec::with_capacity(columns),
            upper: Matrix::zeros(columns, columns),
        };
        for j in 0..columns {
            for i in &left {
                if self.rows[*i][j].abs() <= least[*i] {
                    self.rows[*i][j] = 0.0;
                }
            }
            let size = |i: usize| self.scales[i] + ln(self.rows[i][j].abs());
            let pivot = (0..left.len()).max_by(|a, b| size(left[*a]).total_cmp(&size(left[*b])));
            let mut lower = vec![0.0; self.rows.len()];
            let Some(at) = pivot.filter(|at| self.rows[left[*at]][j] != 0.0) else {
                factors.lower.push(Vec::new());
                factors.scales.push(f64::NEG_INFINITY);
                continue;
            };
            let pivot = left.remove(at);
            let (top, scale) = (self.rows[pivot].clone(), self.scales[pivot]);
            lower[pivot] = 1.0;
            for i in &left {
                let factor = self.rows[*i][j] / top[j];
                if factor != 0.0 {
                    lower[*i] = factor * exp(self.scales[*i] - scale);
                    for (x, t) in self.rows[*i].iter_mut().zip(&top).skip(j + 1) {
                        *x -= factor * t;
                    }
                }
            }
            factors.upper.row_mut(j)[j..].copy_from_slice(&top[j..]);
            factors.lower.push(lower);
            factors.scales.push(scale);
        }
        factors
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The product of the factors is the matrix again, and the logarithms of a matrix whose rows differ by e^900 are those of its
    /// determinants.
    #[test]
    fn factors_of_rows_of_any_size() {
        let rows = vec![vec![0.3, -1.0, 0.7], vec![1.1, 0.4, -0.2], vec![-0.6, 0.9, 1.3]];
        let of = |scales: [f64; 3]| Graded { rows: rows.clone(), scales: scales.to_vec() }.factors(3, 0.0);
        let factors = of([0.0, 1.0, -2.0]);
        for (i, (row, scale)) in rows.iter().zip([0.0_f64, 1.0, -2.0]).enumerate() {
            for (j, value) in row.iter().enumerate() {
                let product: f64 =
                    (0..=j).map(|k| factors.lower[k][i] * factors.scales[k].exp() * factors.upper[(k, j)]).sum();
                assert!((product - value * scale.exp()).abs() < 1e-14, "{i} {j}");
            }
        }
        let whole = crate::math::Lu::new(rows.concat(), 3).unwrap().determinant().abs().ln();
        for scales in [[0.0, 1.0, -2.0], [-900.0, 3.0, -400.0], [5.0, -700.0, -1e5]] {
            let factors = of(scales);
            let sum: f64 = (0..3).map(|k| factors.scales[k] + factors.upper[(k, k)].abs().ln()).sum();
            let wanted = whole + scales.iter().sum::<f64>();
            assert!((sum - wanted).abs() < 1e-14 * (1.0 + wanted.abs()), "{sum} {wanted}");
            // the first is the logarithm of the largest element of the first column
            let first = factors.scales[0] + factors.upper[(0, 0)].abs().ln();
            let largest = (0..3).map(|i| scales[i] + rows[i][0].abs().ln()).fold(f64::NEG_INFINITY, f64::max);
            assert_eq!(first, largest);
        }
    }

    #[test]
    fn dependent_columns() {
        let factors = Graded { rows: vec![vec![1.0, 2.0, 0.5]], scales: vec![-3.0] }.factors(3, 0.0);
        assert_eq!(factors.scales, vec![-3.0, f64::NEG_INFINITY, f64::NEG_INFINITY]);
        // all directions are held
        assert_eq!(Graded::default().factors(2, 0.0).scales, vec![f64::NEG_INFINITY; 2]);
    }
}

//! Dense matrices of any size, by rows: the mass, damping and stiffness of machines.

use core::ops::{Index, IndexMut};

/// A real matrix, by rows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Matrix {
    rows: usize,
    columns: usize,
    values: Vec<f64>,
}

impl Matrix {
    /// A matrix of zeros.
    #[must_use]
    pub fn zeros(rows: usize, columns: usize) -> Self {
        Self { rows, columns, values: vec![0.0; rows * columns] }
    }

    /// A diagonal matrix.
    #[must_use]
    pub fn diagonal(values: &[f64]) -> Self {
        let mut matrix = Self::zeros(values.len(), values.len());
        for (i, value) in values.iter().enumerate() {
            matrix[(i, i)] = *value;
        }
        matrix
    }

    /// The identity.
    #[must_use]
    pub fn identity(n: usize) -> Self {
        Self::diagonal(&vec![1.0; n])
    }

    /// A matrix of these rows; `None` if they differ in length.
    #[must_use]
    pub fn from_rows(rows: &[Vec<f64>]) -> Option<Self> {
        let columns = rows.first().map_or(0, Vec::len);
        rows.iter().all(|row| row.len() == columns).then(|| Self { rows: rows.len(), columns, values: rows.concat() })
    }

    /// Number of rows.
    #[must_use]
    pub const fn rows(&self) -> usize {
        self.rows
    }

    /// Number of columns.
    #[must_use]
    pub const fn columns(&self) -> usize {
        self.columns
    }

    /// One row.
    #[must_use]
    pub fn row(&self, i: usize) -> &[f64] {
        &self.values[i * self.columns..(i + 1) * self.columns]
    }

    /// One row, to be changed.
    pub fn row_mut(&mut self, i: usize) -> &mut [f64] {
        &mut self.values[i * self.columns..(i + 1) * self.columns]
    }

    /// One column.
    #[must_use]
    pub fn column(&self, j: usize) -> Vec<f64> {
        (0..self.rows).map(|i| self[(i, j)]).collect()
    }

    /// All values, row after row.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The transpose.
    #[must_use]
    pub fn transposed(&self) -> Self {
        let mut other = Self::zeros(self.columns, self.rows);
        for i in 0..self.rows {
            for j in 0..self.columns {
                other[(j, i)] = self[(i, j)];
            }
        }
        other
    }

    /// The product `self * other`.
    #[must_use]
    pub fn times(&self, other: &Self) -> Self {
        let mut product = Self::zeros(self.rows, other.columns);
        for i in 0..self.rows {
            for (k, factor) in self.row(i).iter().enumerate() {
                // matrices of machines have many zeros
                if *factor == 0.0 {
                    continue;
                }
                for (sum, value) in product.row_mut(i).iter_mut().zip(other.row(k)) {
                    *sum += factor * value;
                }
            }
        }
        product
    }

    /// The image of a vector.
    #[must_use]
    pub fn apply(&self, vector: &[f64]) -> Vec<f64> {
        let mut image = Vec::new();
        self.apply_into(vector, &mut image);
        image
    }

    /// The image of a vector, into another one.
    #[inline]
    pub(crate) fn apply_into(&self, vector: &[f64], image: &mut Vec<f64>) {
        fit(image, self.rows);
        let mut rest = self.values.as_slice();
        let mut next = || {
            let (row, others) = rest.split_at(self.columns);
            rest = others;
            row
        };
        // four sums at once, because each addition of one sum waits for the one before
        let (fours, others) = image.as_chunks_mut::<4>();
        for four in fours {
            let [a, b, c, d] = [next(), next(), next(), next()];
            // a sum of none is -0, as it is in `dot`
            let mut sums = [-0.0; 4];
            for ((((v, a), b), c), d) in vector.iter().zip(a).zip(b).zip(c).zip(d) {
                sums = [sums[0] + a * v, sums[1] + b * v, sums[2] + c * v, sums[3] + d * v];
            }
            *four = sums;
        }
        for value in others {
            *value = dot(next(), vector);
        }
    }

    /// The image of a vector under the transpose, into another one.
    pub(crate) fn apply_transposed_into(&self, vector: &[f64], image: &mut Vec<f64>) {
        image.clear();
        // row by row, which is the order in memory
        image.resize(self.columns, 0.0);
        for (i, factor) in vector.iter().enumerate() {
            add_scaled(image, *factor, self.row(i));
        }
    }

    /// The image of a vector under the transpose.
    #[must_use]
    pub fn apply_transposed(&self, vector: &[f64]) -> Vec<f64> {
        let mut image = Vec::new();
        self.apply_transposed_into(vector, &mut image);
        image
    }

    /// Adds `factor * left * right^T`.
    pub(crate) fn add_outer(&mut self, factor: f64, left: &[f64], right: &[f64]) {
        for (i, value) in left.iter().enumerate() {
            add_scaled(self.row_mut(i), factor * value, right);
        }
    }

    /// The mean of a square matrix and its transpose: exactly symmetric.
    #[must_use]
    pub(crate) fn symmetrised(&self) -> Self {
        let mut even = self.clone();
        even.symmetrise();
        even
    }

    /// Makes a square matrix exactly symmetric, by the means of the elements that differ.
    pub(crate) fn symmetrise(&mut self) {
        for i in 0..self.rows {
            for j in 0..i {
                let (one, other) = (self[(i, j)], self[(j, i)]);
                if one != other {
                    let mean = 0.5 * (one + other);
                    (self[(i, j)], self[(j, i)]) = (mean, mean);
                }
            }
        }
    }

    /// $`L^{-1}AL^{-T}`$ of a symmetric matrix $`A`$, exactly symmetric, for a lower triangular matrix $`L`$.
    #[must_use]
    pub(crate) fn reduced(&self, lower: &Self) -> Self {
        // the rows of the result are those of (L^{-1} A^T)^T; twice, because A is symmetric
        let solved = |matrix: &Self| {
            let mut rows = Self::zeros(matrix.columns, matrix.rows);
            for j in 0..matrix.columns {
                let column = lower.solve_lower(&matrix.column(j));
                rows.row_mut(j).copy_from_slice(&column);
            }
            rows
        };
        solved(&solved(self)).symmetrised()
    }

    /// The largest absolute value.
    #[must_use]
    pub fn largest(&self) -> f64 {
        self.values.iter().fold(0.0, |most, value| value.abs().max(most))
    }

    /// The lower factor $`L`$ of $`L L^T`$, by Cholesky's method; `None` if the matrix is not positive definite.
    #[must_use]
    pub fn cholesky(&self) -> Option<Self> {
        let mut factor = Self::zeros(self.rows, self.rows);
        // rows of the factor are 0 where those of the matrix begin with zeros
        let mut first = vec![0; self.rows];
        for i in 0..self.rows {
            first[i] = (0..i).find(|j| self[(i, *j)] != 0.0).unwrap_or(i);
            for j in first[i]..=i {
                // before, one of both rows has zeros only
                let from = first[i].max(first[j]).min(j);
                let sum = self[(i, j)] - dot(&factor.row(i)[from..j], &factor.row(j)[from..j]);
                if i == j {
                    // a pivot that is a rounding error of its diagonal is not positive
                    if !(sum > 8.0 * f64::EPSILON * self[(i, i)] && sum.is_finite()) {
                        return None;
                    }
                    factor[(i, i)] = sum.sqrt();
                } else {
                    factor[(i, j)] = sum / factor[(j, j)];
                }
            }
        }
        Some(factor)
    }

    /// The solution of $`L x = v`$ for a lower triangular matrix.
    #[must_use]
    pub fn solve_lower(&self, vector: &[f64]) -> Vec<f64> {
        let mut x = vector.to_vec();
        for i in 0..self.rows {
            let sum = dot(&self.row(i)[..i], &x[..i]);
            x[i] = (x[i] - sum) / self[(i, i)];
        }
        x
    }

    /// The solution of $`L^T x = v`$ for a lower triangular matrix.
    #[must_use]
    pub fn solve_lower_transposed(&self, vector: &[f64]) -> Vec<f64> {
        let mut x = Vec::with_capacity(self.rows);
        self.solve_lower_transposed_into(vector, &mut x);
        x
    }

    /// The same into a vector that is used again.
    pub(crate) fn solve_lower_transposed_into(&self, vector: &[f64], x: &mut Vec<f64>) {
        x.clear();
        x.extend_from_slice(vector);
        for i in (0..self.rows).rev() {
            for k in i + 1..self.rows {
                x[i] -= self[(k, i)] * x[k];
            }
            x[i] /= self[(i, i)];
        }
    }
}

impl Index<(usize, usize)> for Matrix {
    type Output = f64;
    fn index(&self, (i, j): (usize, usize)) -> &f64 {
        &self.values[i * self.columns + j]
    }
}

impl IndexMut<(usize, usize)> for Matrix {
    fn index_mut(&mut self, (i, j): (usize, usize)) -> &mut f64 {
        &mut self.values[i * self.columns + j]
    }
}

/// The scalar product.
#[inline]
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Gives a buffer that is used again this length. It mostly has it, and then nothing is called.
#[inline]
pub(crate) fn fit<T: Default>(buffer: &mut Vec<T>, length: usize) {
    if buffer.len() != length {
        buffer.resize_with(length, T::default);
    }
}

/// Adds `factor * vector` to `sum`.
#[inline]
pub(crate) fn add_scaled(sum: &mut [f64], factor: f64, vector: &[f64]) {
    for (s, v) in sum.iter_mut().zip(vector) {
        *s += factor * v;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_and_solutions() {
        let m = Matrix::from_rows(&[vec![4.0, 2.0, 0.4], vec![2.0, 3.0, -1.0], vec![0.4, -1.0, 2.0]]).unwrap();
        let l = m.cholesky().unwrap();
        let back = l.times(&l.transposed());
        assert!((0..9).all(|k| (back.values()[k] - m.values()[k]).abs() < 1e-15));
        let want = [0.3, -1.0, 2.0];
        let x = l.solve_lower_transposed(&l.solve_lower(&m.apply(&want)));
        assert!(x.iter().zip(&want).all(|(a, b)| (a - b).abs() < 1e-14));
        assert_eq!(m.apply_transposed(&want), m.apply(&want));
        assert_eq!(Matrix::from_rows(&[vec![1.0, 2.0], vec![2.0, 4.0]]).unwrap().cholesky(), None);
        assert_eq!(Matrix::from_rows(&[vec![1.0, 2.0], vec![2.0]]), None);
    }
}

//! Modes to the last digits, by Newton's method with residuals of twice the digits.
//!
//! A stop that is much stiffer than the structure leaves little of it in the shapes of the soft modes, and two real
//! eigenvalues that nearly coincide have nearly the same shape. Then eigenvectors that are correct to rounding of their
//! largest component are not enough. With the columns $`C = [E; V]`$ of the basis, their inverse $`X`$ and the equations
//! $`\dot Y = MY`$ of all modes, $`AC = C(M + D)`$ with a small $`D = X(AC - CM)`$. The basis $`C(I + W)`$ has
//! the equations $`M + \delta M`$ if $`D + MW - WM = \delta M`$, which is solved for each pair of modes.

use super::basis::Basis;
use crate::math::{Matrix, Wide};

/// Newton's method doubles the number of correct digits, so two steps reach those of [`Wide`].
const STEPS: u32 = 2;
/// Two modes whose equations differ by less than this part are not told apart further.
const ALIKE: f64 = 1e-14;
/// From farther away the method need not converge.
const FAR: f64 = 1e-3;

/// A matrix of [`Wide`] numbers, by rows.
struct WideMatrix {
    size: usize,
    values: Vec<Wide>,
}

impl WideMatrix {
    /// Of four blocks of `m` rows and columns.
    fn of_blocks(blocks: [&Matrix; 4]) -> Self {
        let m = blocks[0].rows();
        let block = |i: usize, j: usize| blocks[2 * (i / m) + j / m][(i % m, j % m)];
        let values = (0..4 * m * m).map(|at| Wide::from(block(at / (2 * m), at % (2 * m)))).collect();
        Self { size: 2 * m, values }
    }

    fn at(&self, i: usize, j: usize) -> Wide {
        self.values[i * self.size + j]
    }

    /// One of its blocks, rounded.
    fn block(&self, row: usize, column: usize) -> Matrix {
        let m = self.size / 2;
        let mut block = Matrix::zeros(m, m);
        for i in 0..m {
            for j in 0..m {
                block[(i, j)] = self.at(row * m + i, column * m + j).value();
            }
        }
        block
    }

    fn rounded(&self) -> Matrix {
        let mut rounded = Matrix::zeros(self.size, self.size);
        for i in 0..self.size {
            for (to, from) in rounded.row_mut(i).iter_mut().zip(&self.values[i * self.size..]) {
                *to = from.value();
            }
        }
        rounded
    }

    fn add(&mut self, other: &Matrix) {
        for (own, other) in self.values.iter_mut().zip(other.values()) {
            *own += *other;
        }
    }

    /// The identity less the product with `other`, rounded.
    fn missing(&self, other: &Self) -> Matrix {
        let n = self.size;
        let mut result = Matrix::zeros(n, n);
        for i in 0..n {
            let mut row = vec![Wide::default(); n];
            // minus the identity, so that the sums are minus what is missing
            row[i] = Wide::from(-1.0);
            for k in 0..n {
                let factor = self.at(i, k);
                for (sum, value) in row.iter_mut().zip(&other.values[k * n..]) {
                    *sum = *sum + factor * *value;
                }
            }
            for (to, value) in result.row_mut(i).iter_mut().zip(row) {
                *to = -value.value();
            }
        }
        result
    }
}

/// The basis of $`\ddot\xi + C\dot\xi + K\xi = 0`$ with all its digits, from one that is correct to rounding of its largest
/// numbers. `None` if the method does not converge.
pub(super) fn refined(basis: &Basis, stiffness: &Matrix, damping: &Matrix) -> Option<Basis> {
    let mut columns = WideMatrix::of_blocks([&basis.e[0], &basis.e[1], &basis.v[0], &basis.v[1]]);
    let mut inverse = WideMatrix::of_blocks([&basis.a[0], &basis.a[1], &basis.b[0], &basis.b[1]]);
    let mut modes: Vec<(Wide, Wide)> = basis.modes.iter().map(|(k, d)| (Wide::from(*k), Wide::from(*d))).collect();
    for _ in 0..STEPS {
        let defect = inverse.rounded().times(&residual(&columns, &modes, stiffness, damping));
        let (change, size) = correction(&defect, &mut modes);
        if size.is_nan() || size > FAR {
            return None;
        }
        let moved = columns.rounded().times(&change);
        columns.add(&moved);
        // X + X(I - CX), the correction of an inverse, twice for as many digits as the columns
        for _ in 0..2 {
            let missing = columns.missing(&inverse);
            let moved = inverse.rounded().times(&missing);
            inverse.add(&moved);
        }
    }
    let modes = basis.modes.iter().zip(&modes).map(|((was, _), (k, d))| {
        // rigid modes are exactly rigid
        (if *was == 0.0 { 0.0 } else { k.value().max(0.0) }, d.value().max(0.0))
    });
    Some(Basis {
        modes: modes.collect(),
        e: [columns.block(0, 0), columns.block(0, 1)],
        v: [columns.block(1, 0), columns.block(1, 1)],
        a: [inverse.block(0, 0), inverse.block(0, 1)],
        b: [inverse.block(1, 0), inverse.block(1, 1)],
        coupled: basis.coupled,
    })
}

/// $`AC - CM`$, rounded.
fn residual(columns: &WideMatrix, modes: &[(Wide, Wide)], stiffness: &Matrix, damping: &Matrix) -> Matrix {
    let m = modes.len();
    let mut residual = Matrix::zeros(2 * m, 2 * m);
    let minus = Wide::from(-1.0);
    for i in 0..m {
        // the accelerations of all columns at once, because rows are what is stored together
        let mut pulled = vec![Wide::default(); 2 * m];
        for k in 0..m {
            let (by_x, by_v) = (Wide::from(-stiffness[(i, k)]), Wide::from(-damping[(i, k)]));
            for (j, pulled) in pulled.iter_mut().enumerate() {
                *pulled = *pulled + by_x * columns.at(k, j) + by_v * columns.at(m + k, j);
            }
        }
        for (j, (k, d)) in modes.iter().enumerate() {
            for (row, one, two) in
                [(i, columns.at(m + i, j), columns.at(m + i, m + j)), (m + i, pulled[j], pulled[m + j])]
            {
                let (e1, e2) = (columns.at(row, j), columns.at(row, m + j));
                residual[(row, j)] = (one + *k * e2).value();
                residual[(row, m + j)] = (two + minus * e1 + (*d + *d) * e2).value();
            }
        }
    }
    residual
}

/// $`W`$ for a defect $`D`$, and its size in units of the fastest rate of each pair of modes; the modes become those of
/// $`M + \delta M`$.
fn correction(defect: &Matrix, modes: &mut [(Wide, Wide)]) -> (Matrix, f64) {
    let m = modes.len();
    let mut size = 0.0_f64;
    let mut change = Matrix::zeros(2 * m, 2 * m);
    let rounded: Vec<(f64, f64)> = modes.iter().map(|(k, d)| (k.value(), d.value())).collect();
    let own = |i: usize| rounded[i].0.sqrt() + rounded[i].1;
    let fastest = (0..m).map(own).fold(0.0, f64::max);
    // rigid modes have no rate of their own
    let rate = |i: usize| own(i).max(1e-6 * fastest);
    for i in 0..m {
        for j in 0..m {
            let [d11, d12, d21, d22] =
                [(i, j), (i, m + j), (m + i, j), (m + i, m + j)].map(|(row, column)| defect[(row, column)]);
            let ((ki, di), (kj, dj)) = (rounded[i], rounded[j]);
            if i == j {
                // the first row of the mode's own equations stays (0, 1), the second tells what k and d become
                let (c, e) = (-d11, -d12);
                (change[(m + i, i)], change[(m + i, m + i)]) = (c, e);
                modes[i].0 += -(d21 - 2.0 * di * c + ki * e);
                modes[i].1 += -0.5 * (d22 - c);
                size += c.abs() / rate(i) + e.abs();
                continue;
            }
            // M W - W M = -D in its four components, the last two of W expressed by the first two
            let (k, d) = (kj - ki, dj - di);
            let (a, b, c, e) = (k, -2.0 * kj * d, 2.0 * d, k - 4.0 * dj * d);
            let (p, q) = (-d21 - 2.0 * di * d11 + kj * d12, -d22 - d11 + 2.0 * d * d12);
            let determinant = a * e - b * c;
            let square = ki + kj + (di * di + dj * dj);
            if determinant.abs() <= ALIKE * square * square {
                continue;
            }
            let w1 = (p * e - b * q) / determinant;
            let w2 = (a * q - c * p) / determinant;
            let (w3, w4) = (-d11 - kj * w2, -d12 + w1 - 2.0 * dj * w2);
            (change[(i, j)], change[(i, m + j)]) = (w1, w2);
            (change[(m + i, j)], change[(m + i, m + j)]) = (w3, w4);
            let rate = rate(i).max(rate(j));
            size += w1.abs() + w4.abs() + w2.abs() * rate + w3.abs() / rate;
        }
    }
    (change, size)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A stop that is 1e7 times stiffer than the rest, nearly critically damped. A basis that is wrong by 1e-9 becomes the same
    /// one to the last digits, also of small components. What is compared are the projections to the plane of each mode, which
    /// do not depend on lengths of vectors.
    #[test]
    fn digits_of_small_components_come_back() {
        let mut stiffness =
            Matrix::from_rows(&[vec![8.0, 1.0, -0.5], vec![1.0, 3.0, 0.25], vec![-0.5, 0.25, 2.0]]).unwrap();
        let mut damping =
            Matrix::from_rows(&[vec![0.2, 0.05, 0.01], vec![0.05, 0.1, 0.02], vec![0.01, 0.02, 0.3]]).unwrap();
        stiffness[(0, 0)] += 2.5e7;
        damping[(0, 0)] += 9.5e3;
        let first = Basis::new(&stiffness, &damping).unwrap();
        assert!(first.coupled);
        let basis = refined(&first, &stiffness, &damping).unwrap();
        let mut wrong = basis.clone();
        for (at, matrix) in wrong.e.iter_mut().chain(&mut wrong.v).chain(&mut wrong.a).chain(&mut wrong.b).enumerate() {
            let size = 1e-9 * matrix.largest();
            for i in 0..3 {
                for (j, x) in matrix.row_mut(i).iter_mut().enumerate() {
                    *x += if (at + i + 2 * j) % 3 == 0 { size } else { -size };
                }
            }
        }
        let back = refined(&wrong, &stiffness, &damping).unwrap();
        for i in 0..3 {
            for (one, other) in [(basis.modes[i].0, back.modes[i].0), (basis.modes[i].1, back.modes[i].1)] {
                assert!((one - other).abs() <= 2.0 * f64::EPSILON * one, "{i}: {one} {other}");
            }
            let part = |basis: &Basis, row: usize, column: usize| {
                let (one, two) =
                    (basis.e[0][(row, i)] * basis.a[0][(i, column)], basis.e[1][(row, i)] * basis.b[0][(i, column)]);
                (one + two, one.abs() + two.abs())
            };
            for (row, column) in (0..9).map(|k| (k / 3, k % 3)) {
                let ((one, size), (other, _)) = (part(&basis, row, column), part(&back, row, column));
                assert!((one - other).abs() <= 8.0 * f64::EPSILON * size, "{i} {row} {column}: {one} {other}");
            }
        }
        // rounding of the largest component would leave seven digits of this one
        assert!(basis.e[0][(0, 1)].abs() < 1e-7);
    }
}

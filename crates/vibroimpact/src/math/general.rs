//! Eigenvalues of general real matrices, by the shifted QR method in complex numbers.
//!
//! The matrix is balanced by powers of two, reduced to Hessenberg form by Householder's reflections, and its
//! eigenvalues are split off at the end one by one, with Wilkinson's shift. Complex numbers cost twice the work of
//! Francis's double shift, which does not matter for matrices of the size of machines.

use super::{Complex, Lu, Matrix, Multiplier, dot};
use crate::math::sort_by;

/// The largest number of QR steps for one eigenvalue; two or three usually suffice.
const STEPS: u32 = 200;

/// The eigenvalues of a real square matrix, by descending modulus; pairs of complex ones side by side, the positive
/// imaginary part first. `None` if the matrix has a number that is not finite.
pub(crate) fn general_eigenvalues(matrix: &Matrix) -> Option<Vec<Multiplier>> {
    if !matrix.values().iter().all(|value| value.is_finite()) {
        return None;
    }
    let mut a = balanced(matrix);
    hessenberg(&mut a);
    let n = a.rows();
    let mut h: Vec<Vec<Complex>> = (0..n).map(|i| a.row(i).iter().map(|x| Complex::from(*x)).collect()).collect();
    let mut found = vec![Complex::default(); n];
    let mut end = n;
    let mut steps = 0;
    while end > 0 {
        let last = end - 1;
        // the block that ends here and has no negligible element below its diagonal
        let mut begin = last;
        // an element is negligible beside its neighbours on the diagonal
        while begin > 0 {
            let near = h[begin][begin].modulus() + h[begin - 1][begin - 1].modulus();
            if h[begin][begin - 1].modulus() <= 0.5 * f64::EPSILON * near {
                h[begin][begin - 1] = Complex::default();
                break;
            }
            begin -= 1;
        }
        // the block is a single element, or is taken as it is, so that the loop ends
        if begin == last || steps >= STEPS {
            found[last] = h[last][last];
            end -= 1;
            steps = 0;
            continue;
        }
        steps += 1;
        let shift = if steps % 20 == 10 {
            // an exceptional shift, if the iteration goes round in a circle
            h[last][last] + Complex::from(h[last][last - 1].modulus())
        } else {
            wilkinson(h[last - 1][last - 1], h[last - 1][last], h[last][last - 1], h[last][last])
        };
        qr_step(&mut h, begin, last, shift);
    }
    Some(paired(&found, matrix.largest()))
}

/// The eigenvalue of [[a, b], [c, d]] nearest to `d`.
fn wilkinson(a: Complex, b: Complex, c: Complex, d: Complex) -> Complex {
    let half = Complex::from(0.5);
    let middle = half * (a - d);
    let root = (middle * middle + b * c).sqrt();
    // the sum in which nothing cancels
    let sum = if (middle + root).modulus() > (middle - root).modulus() { middle + root } else { middle - root };
    if sum.modulus() == 0.0 { d } else { d - b * c / sum }
}

#[allow(clippy::needless_range_loop)] // two rows at a time
/// One QR step on the block from `begin` to `last`, by Givens rotations.
fn qr_step(h: &mut [Vec<Complex>], begin: usize, last: usize, shift: Complex) {
    // the shift is taken away, and added again at the end
    for (i, row) in h.iter_mut().enumerate().take(last + 1).skip(begin) {
        row[i] = row[i] - shift;
    }
    let mut turns = Vec::with_capacity(last - begin);
    for k in begin..last {
        let (x, y) = (h[k][k], h[k + 1][k]);
        // a rotation that makes the element below the diagonal 0
        let size = super::hypot(x.modulus(), y.modulus());
        let (c, s) = if size == 0.0 {
            (Complex::from(1.0), Complex::default())
        } else {
            (x / Complex::from(size), y / Complex::from(size))
        };
        let conj = |z: Complex| Complex::new(z.re, -z.im);
        for j in k..=last {
            let (p, q) = (h[k][j], h[k + 1][j]);
            h[k][j] = conj(c) * p + conj(s) * q;
            h[k + 1][j] = c * q - s * p;
        }
        turns.push((c, s));
    }
    for (k, (c, s)) in (begin..last).zip(turns) {
        let conj = |z: Complex| Complex::new(z.re, -z.im);
        // in Hessenberg form all that stands farther below is 0
        for row in h.iter_mut().take((k + 2).min(last) + 1).skip(begin) {
            let (p, q) = (row[k], row[k + 1]);
            row[k] = p * c + q * s;
            row[k + 1] = q * conj(c) - p * conj(s);
        }
    }
    for (i, row) in h.iter_mut().enumerate().take(last + 1).skip(begin) {
        row[i] = row[i] + shift;
    }
}

/// Rows and columns scaled by powers of two until their sizes are alike.
fn balanced(matrix: &Matrix) -> Matrix {
    let n = matrix.rows();
    let mut a = matrix.clone();
    for _ in 0..20 {
        let mut changed = false;
        for i in 0..n {
            let (mut row, mut column) = (0.0, 0.0);
            for j in (0..n).filter(|j| *j != i) {
                row += a[(i, j)].abs();
                column += a[(j, i)].abs();
            }
            // without coupling no factor makes both alike
            if row == 0.0 || column == 0.0 {
                continue;
            }
            // powers of two change no digits
            let mut factor = 1.0;
            while column * factor * factor < 0.5 * row && factor < 1e100 {
                factor *= 2.0;
            }
            while column * factor * factor >= 2.0 * row && factor > 1e-100 {
                factor *= 0.5;
            }
            if factor != 1.0 {
                changed = true;
                for j in 0..n {
                    a[(i, j)] /= factor;
                }
                for j in 0..n {
                    a[(j, i)] *= factor;
                }
            }
        }
        if !changed {
            break;
        }
    }
    a
}

/// Zeros below the first subdiagonal, by reflections.
fn hessenberg(a: &mut Matrix) {
    let n = a.rows();
    for k in 0..n.saturating_sub(2) {
        let norm = (k + 1..n).map(|i| a[(i, k)] * a[(i, k)]).sum::<f64>().sqrt();
        if norm == 0.0 {
            continue;
        }
        let mut v = vec![0.0; n];
        for (i, x) in v.iter_mut().enumerate().skip(k + 1) {
            *x = a[(i, k)];
        }
        // of both signs the one for which nothing cancels
        v[k + 1] += if v[k + 1] < 0.0 { -norm } else { norm };
        let square: f64 = v.iter().map(|x| x * x).sum();
        let rows = a.apply_transposed(&v);
        for (i, x) in v.iter().enumerate() {
            for (j, y) in rows.iter().enumerate() {
                a[(i, j)] -= 2.0 / square * x * y;
            }
        }
        let columns = a.apply(&v);
        for (i, x) in columns.iter().enumerate() {
            for (j, y) in v.iter().enumerate() {
                a[(i, j)] -= 2.0 / square * x * y;
            }
        }
        // exactly zero, as the reflection makes them but for rounding
        for i in k + 2..n {
            a[(i, k)] = 0.0;
        }
    }
}

/// Real eigenvalues made exactly real, complex ones exactly conjugate.
fn paired(found: &[Complex], size: f64) -> Vec<Multiplier> {
    let mut rest: Vec<Complex> = found.to_vec();
    sort_by(&mut rest, |a, b| {
        let order = b.modulus().total_cmp(&a.modulus());
        order.then(b.re.total_cmp(&a.re)).then(b.im.total_cmp(&a.im))
    });
    let mut all = Vec::with_capacity(rest.len());
    while let Some(one) = rest.first().copied() {
        rest.remove(0);
        // the conjugate, if there is one nearer than this one is to the real axis
        let distance = |other: &Complex| (one - Complex::new(other.re, -other.im)).modulus();
        let partner = (0..rest.len()).min_by(|i, j| distance(&rest[*i]).total_cmp(&distance(&rest[*j])));
        match partner {
            Some(place) if one.im.abs() > distance(&rest[place]) && one.im.abs() > 1e-15 * size => {
                let other = rest.remove(place);
                // their mean makes them conjugate to the last bit
                let (re, im) = (0.5 * (one.re + other.re), 0.5 * (one.im - other.im).abs());
                all.extend([Multiplier { re, im }, Multiplier { re, im: -im }]);
            }
            _ => all.push(Multiplier { re: one.re, im: 0.0 }),
        }
    }
    all
}

/// The direction of length 1 that a matrix multiplies by this real eigenvalue, by inverse iteration.
pub(crate) fn eigenvector(matrix: &Matrix, value: f64) -> Option<Vec<f64>> {
    let size = matrix.rows();
    let mut shifted = matrix.clone();
    for i in 0..size {
        // beside the eigenvalue, so that the matrix is not singular
        shifted[(i, i)] -= value * (1.0 + 1e-9);
    }
    let lu = Lu::new(shifted.values().to_vec(), size)?;
    let mut vector: Vec<f64> = (0..size).map(|i| if i % 2 == 0 { 1.0 } else { 0.7 }).collect();
    for _ in 0..3 {
        lu.solve(&mut vector);
        let length = dot(&vector, &vector).sqrt();
        if !(length > 0.0 && length.is_finite()) {
            return None;
        }
        vector.iter_mut().for_each(|x| *x /= length);
    }
    Some(vector)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_eigenvalues() {
        // companion matrix of (x - 1)(x - 2)(x + 3)(x^2 + 1)
        let coefficients = [6.0, -7.0, 6.0, -6.0, 0.0];
        let mut m = Matrix::zeros(5, 5);
        for k in 0..4 {
            m[(k + 1, k)] = 1.0;
        }
        for (k, c) in coefficients.iter().enumerate() {
            m[(k, 4)] = -c;
        }
        let found = general_eigenvalues(&m).unwrap();
        let want = [(-3.0, 0.0), (2.0, 0.0), (1.0, 0.0), (0.0, 1.0), (0.0, -1.0)];
        for (re, im) in want {
            assert!(found.iter().any(|e| (e.re - re).abs() < 1e-13 && (e.im - im).abs() < 1e-13), "{found:?}");
        }
        assert!(found[0].modulus() >= found[4].modulus());
        assert_eq!(general_eigenvalues(&Matrix::from_rows(&[vec![f64::NAN]]).unwrap()), None);
        let rotation = Matrix::from_rows(&[vec![0.0, -1.0], vec![1.0, 0.0]]).unwrap();
        let turn = general_eigenvalues(&rotation).unwrap();
        assert!(turn[0].re.abs() < 1e-15 && (turn[0].im - 1.0).abs() < 1e-15 && turn[1].im == -turn[0].im);
    }

    #[test]
    fn trace_and_determinant_of_random_matrices() {
        let mut state = 5_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            f64::from(u32::try_from(state >> 33).unwrap()) / f64::from(1_u32 << 31) - 0.5
        };
        for n in [1, 2, 3, 4, 8, 24] {
            let rows: Vec<Vec<f64>> = (0..n).map(|_| (0..n).map(|_| random()).collect()).collect();
            let m = Matrix::from_rows(&rows).unwrap();
            let found = general_eigenvalues(&m).unwrap();
            let trace: f64 = found.iter().map(|e| e.re).sum();
            let want: f64 = (0..n).map(|i| m[(i, i)]).sum();
            assert!((trace - want).abs() < 1e-13, "{n}");
            let square: f64 = found.iter().map(|e| e.re * e.re - e.im * e.im).sum();
            let two = m.times(&m);
            let want: f64 = (0..n).map(|i| two[(i, i)]).sum();
            assert!((square - want).abs() < 1e-12, "{n}");
        }
    }
}

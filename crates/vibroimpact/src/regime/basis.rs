//! The modes of $`\ddot\xi + C\dot\xi + K\xi = f(t)`$ with symmetric matrices, each of which obeys a scalar equation.
//!
//! If the eigenvectors of $`K`$ also diagonalise $`C`$ (proportional damping), they are the modes. Modes that damping
//! couples are taken from the eigenpairs $`(\lambda, v)`$ of $`(\lambda^2 + \lambda C + K)v = 0`$: a conjugate pair, or
//! two real ones, span an invariant plane. In it there are vectors $`e_1, e_2`$ with $`Ae_2 = e_1 - 2d\,e_2`$,
//! $`Ae_1 = -k\,e_2`$, so the components $`y, \dot y`$ of the state along them obey
//! $`\ddot y + 2d\dot y + ky = 0`$. See F. Tisseur and K. Meerbergen, "The quadratic eigenvalue problem", SIAM Review 43
//! (2001) 235-286, doi:10.1137/S0036144500381988.

use crate::math::{Complex, Lu, Matrix, dot, general_eigenvalues, symmetric_eigen};

/// The modes, and the maps between them and the state: $`\xi = E_1y + E_2z`$, $`\dot\xi = V_1y + V_2z`$, where $`z`$ is
/// $`\dot y`$ without forcing, and back: $`y = A_1\xi + A_2\dot\xi`$, $`z = B_1\xi + B_2\dot\xi`$.
#[derive(Clone, Debug)]
pub(crate) struct Basis {
    /// Stiffness and half the damping of each mode.
    pub(crate) modes: Vec<(f64, f64)>,
    pub(crate) e: [Matrix; 2],
    pub(crate) v: [Matrix; 2],
    pub(crate) a: [Matrix; 2],
    pub(crate) b: [Matrix; 2],
    /// Whether damping couples some modes.
    pub(crate) coupled: bool,
}

/// Coupling below this part of the whole damping is rounding.
const NEGLIGIBLE: f64 = 8.0 * f64::EPSILON;
/// Eigenvectors that amplify rounding errors by more than this are not used.
const CONDITION: f64 = 30.0;

impl Basis {
    /// `None` if the modes that damping couples are too nearly defective.
    pub(crate) fn new(stiffness: &Matrix, damping: &Matrix) -> Option<Self> {
        let m = stiffness.rows();
        let (mut values, mut phi) = symmetric_eigen(stiffness);
        for value in &mut values {
            // rigid modes are exactly rigid
            *value = if *value < 64.0 * f64::EPSILON * stiffness.largest() { 0.0 } else { *value };
        }
        align(&values, &mut phi, damping);
        // the damping between the eigenvectors: off the diagonal, what couples them
        let c = phi.transposed().times(&damping.times(&phi));
        let zero = || Matrix::zeros(m, m);
        let mut basis = Self {
            modes: vec![(0.0, 0.0); m],
            e: [zero(), zero()],
            v: [zero(), zero()],
            a: [zero(), zero()],
            b: [zero(), zero()],
            coupled: false,
        };
        let limit = NEGLIGIBLE * c.largest();
        let mut done = vec![false; m];
        for i in 0..m {
            if done[i] {
                continue;
            }
            // all modes that damping couples with this one, directly or through others
            let mut group = vec![i];
            done[i] = true;
            let mut next = 0;
            while next < group.len() {
                for (j, seen) in done.iter_mut().enumerate() {
                    if !*seen && c[(group[next], j)].abs() > limit {
                        *seen = true;
                        group.push(j);
                    }
                }
                next += 1;
            }
            group.sort_unstable();
            if let [one] = group[..] {
                // damping does not feed a mode; less than 0 is rounding
                basis.modes[one] = (values[one], 0.5 * c[(one, one)].max(0.0));
                for k in 0..m {
                    let x = phi[(k, one)];
                    (basis.e[0][(k, one)], basis.v[1][(k, one)]) = (x, x);
                    (basis.a[0][(one, k)], basis.b[1][(one, k)]) = (x, x);
                }
            } else {
                basis.coupled = true;
                basis.couple(&group, &values, &c, &phi)?;
            }
        }
        Some(basis)
    }

    /// The directions themselves, with bounds of the rates of all motions in the place of the rates of modes.
    pub(crate) fn identity(stiffness: &Matrix, damping: &Matrix) -> Self {
        let m = stiffness.rows();
        let largest = |matrix: &Matrix| symmetric_eigen(matrix).0.last().copied().unwrap_or(0.0).max(0.0);
        let (k, d) = (largest(stiffness), 0.5 * largest(damping));
        let (one, zero) = (Matrix::identity(m), Matrix::zeros(m, m));
        Self {
            modes: vec![(k, d); m],
            e: [one.clone(), zero.clone()],
            v: [zero.clone(), one.clone()],
            a: [one.clone(), zero.clone()],
            b: [zero, one],
            coupled: true,
        }
    }

    /// The modes of a group that damping couples.
    fn couple(&mut self, group: &[usize], values: &[f64], c: &Matrix, phi: &Matrix) -> Option<()> {
        let p = group.len();
        let stiffness: Vec<f64> = group.iter().map(|i| values[*i]).collect();
        let mut damping = Matrix::zeros(p, p);
        for (i, from) in group.iter().enumerate() {
            for (j, to) in group.iter().enumerate() {
                damping[(i, j)] = c[(*from, *to)];
            }
        }
        let planes = planes(&stiffness, &damping)?;
        // the columns e1, e2 of each plane; the state is scaled by the frequencies only through them
        let mut columns = Matrix::zeros(2 * p, 2 * p);
        for (i, plane) in planes.iter().enumerate() {
            for k in 0..2 * p {
                columns[(k, i)] = plane.e1[k];
                columns[(k, p + i)] = plane.e2[k];
            }
        }
        let inverse = inverse(&columns)?;
        for k in 0..2 * p {
            // the amplification of rounding errors on the way to the modes and back
            let sum: f64 = (0..2 * p).map(|j| (columns[(k, j)] * inverse[(j, k)]).abs()).sum();
            if sum > CONDITION || sum.is_nan() {
                return None;
            }
        }
        let n = phi.rows();
        for (i, plane) in planes.iter().enumerate() {
            let at = group[i];
            self.modes[at] = (plane.k, plane.d);
            for k in 0..n {
                for (j, from) in group.iter().enumerate() {
                    let x = phi[(k, *from)];
                    self.e[0][(k, at)] += x * columns[(j, i)];
                    self.e[1][(k, at)] += x * columns[(j, p + i)];
                    self.v[0][(k, at)] += x * columns[(p + j, i)];
                    self.v[1][(k, at)] += x * columns[(p + j, p + i)];
                    self.a[0][(at, k)] += x * inverse[(i, j)];
                    self.a[1][(at, k)] += x * inverse[(i, p + j)];
                    self.b[0][(at, k)] += x * inverse[(p + i, j)];
                    self.b[1][(at, k)] += x * inverse[(p + i, p + j)];
                }
            }
        }
        Some(())
    }
}

/// Turns eigenvectors of equal eigenvalues so that damping does not couple them.
fn align(values: &[f64], phi: &mut Matrix, damping: &Matrix) {
    let m = values.len();
    let largest = values.last().copied().unwrap_or(0.0);
    let mut begin = 0;
    while begin < m {
        let mut end = begin + 1;
        // equal to rounding: such eigenvectors can be turned within their plane
        while end < m && values[end] - values[begin] <= 1e-13 * largest {
            end += 1;
        }
        if end - begin > 1 {
            let size = end - begin;
            let columns: Vec<Vec<f64>> = (begin..end).map(|k| phi.column(k)).collect();
            let mut own = Matrix::zeros(size, size);
            for i in 0..size {
                let image = damping.apply(&columns[i]);
                for j in 0..size {
                    own[(i, j)] = dot(&image, &columns[j]);
                }
            }
            let (_, turn) = symmetric_eigen(&own);
            for k in 0..phi.rows() {
                for j in 0..size {
                    phi[(k, begin + j)] = (0..size).map(|i| columns[i][k] * turn[(i, j)]).sum();
                }
            }
        }
        begin = end;
    }
}

/// An invariant plane: its mode, and the vectors along which the state is $`y`$ and $`\dot y`$.
struct Plane {
    k: f64,
    d: f64,
    e1: Vec<f64>,
    e2: Vec<f64>,
}

fn planes(stiffness: &[f64], damping: &Matrix) -> Option<Vec<Plane>> {
    let p = stiffness.len();
    // the state (xi, xi') as a system of first order
    let mut companion = Matrix::zeros(2 * p, 2 * p);
    for i in 0..p {
        companion[(i, p + i)] = 1.0;
        companion[(p + i, i)] = -stiffness[i];
        for j in 0..p {
            companion[(p + i, p + j)] = -damping[(i, j)];
        }
    }
    // a rigid mode is exactly rigid: its eigenvalue is 0, which is the smallest, and its shape is known
    let rigid: Vec<usize> = (0..p).filter(|i| stiffness[*i] == 0.0).collect();
    let unit = |i: usize| (0..p).map(|k| if k == i { 1.0 } else { 0.0 }).collect();
    let mut real: Vec<(f64, Vec<f64>)> = rigid.iter().map(|i| (0.0, unit(*i))).collect();
    let mut found = Vec::new();
    // sorted by size: the zeros of the rigid modes are the last
    for value in general_eigenvalues(&companion)?.into_iter().take(2 * p - rigid.len()) {
        // one of each pair
        if value.im < 0.0 {
            continue;
        }
        let (lambda, v) = eigenpair(stiffness, damping, Complex::new(value.re, value.im))?;
        if value.im == 0.0 {
            // damping feeds no mode: growth is rounding
            real.push((lambda.re.min(0.0), v.iter().map(|z| z.re).collect()));
            continue;
        }
        let (a, b) = (lambda.re.min(0.0), lambda.im.abs());
        let v: Vec<Complex> = v.iter().map(|z| if lambda.im < 0.0 { Complex::new(z.re, -z.im) } else { *z }).collect();
        let rate: Vec<Complex> = v.iter().map(|z| Complex::new(a, b) * *z).collect();
        let both = || v.iter().chain(&rate);
        found.push(Plane {
            // with lambda = a + ib, k is its square and d is -a
            k: a * a + b * b,
            d: -a,
            e1: both().map(|z| z.re - a / b * z.im).collect(),
            e2: both().map(|z| z.im / b).collect(),
        });
    }
    if real.len() % 2 == 1 {
        return None;
    }
    while let Some((one, v)) = real.pop() {
        // the partner with the most similar shape
        let alike = |other: &(f64, Vec<f64>)| dot(&v, &other.1).abs();
        let place = (0..real.len()).max_by(|i, j| alike(&real[*i]).total_cmp(&alike(&real[*j])))?;
        let (two, mut w) = real.remove(place);
        // the same direction for both, so that their difference is small where they are alike
        if dot(&v, &w) < 0.0 {
            for x in &mut w {
                *x = -*x;
            }
        }
        // a double eigenvalue with one eigenvector has no such plane
        if one == two {
            return None;
        }
        let state =
            |lambda: f64, v: &[f64]| -> Vec<f64> { v.iter().copied().chain(v.iter().map(|x| lambda * x)).collect() };
        let (x, y) = (state(one, &v), state(two, &w));
        let over = 1.0 / (one - two);
        // k is the product of both eigenvalues and -2d their sum
        found.push(Plane {
            k: one * two,
            d: -0.5 * (one + two),
            e1: x.iter().zip(&y).map(|(x, y)| (one * y - two * x) * over).collect(),
            e2: x.iter().zip(&y).map(|(x, y)| (x - y) * over).collect(),
        });
    }
    Some(found)
}

/// The eigenpair near a value, by Newton's method with inverse iteration; the eigenvector as real as its phase allows, of
/// length 1.
fn eigenpair(stiffness: &[f64], damping: &Matrix, mut lambda: Complex) -> Option<(Complex, Vec<Complex>)> {
    let p = stiffness.len();
    let real = lambda.im == 0.0;
    // uneven, so that no symmetry of the structure makes it perpendicular to the eigenvector
    let mut v: Vec<Complex> =
        (0..p).map(|i| Complex::new(1.0 + 0.1 * f64::from(u32::try_from(i).unwrap_or(0)), 0.0)).collect();
    for _ in 0..4 {
        // a little beside the eigenvalue, so that the matrix is not singular to the last bit
        let beside = lambda * Complex::new(1.0 + 3e-15, if real { 0.0 } else { 2e-15 });
        let mut rows: Vec<Vec<Complex>> = Vec::with_capacity(p);
        for i in 0..p {
            let mut row: Vec<Complex> = (0..p).map(|j| beside * Complex::from(damping[(i, j)])).collect();
            row[i] = row[i] + beside * beside + Complex::from(stiffness[i]);
            rows.push(row);
        }
        for _ in 0..2 {
            v = solve(rows.clone(), v)?;
            let size = v.iter().map(|z| z.re * z.re + z.im * z.im).sum::<f64>().sqrt();
            if !(size.is_finite() && size > 0.0) {
                return None;
            }
            for z in &mut v {
                *z = *z / Complex::from(size);
            }
        }
        // v' L(lambda) v / v' L'(lambda) v, with the transpose because the matrices are symmetric
        let (mut square, mut loss, mut spring) = (Complex::default(), Complex::default(), Complex::default());
        for i in 0..p {
            square = square + v[i] * v[i];
            spring = spring + v[i] * v[i] * Complex::from(stiffness[i]);
            for j in 0..p {
                loss = loss + v[i] * v[j] * Complex::from(damping[(i, j)]);
            }
        }
        let value = lambda * lambda * square + lambda * loss + spring;
        let slope = lambda * square * Complex::from(2.0) + loss;
        // near a double eigenvalue the slope is lost; a long step would lead to another eigenvalue
        if slope.modulus() > 1e-6 * (lambda.modulus() * square.modulus() + loss.modulus()) {
            let step = value / slope;
            if step.modulus() < 1e-6 * lambda.modulus() {
                lambda = lambda - step;
            }
        }
    }
    let square = v.iter().fold(Complex::default(), |sum, z| sum + *z * *z);
    // so that v'v is real
    let turn = square.sqrt();
    if turn.modulus() > 1e-8 {
        for z in &mut v {
            *z = *z / turn * Complex::from(turn.modulus());
        }
    }
    Some((lambda, v))
}

#[allow(clippy::needless_range_loop)] // two rows at a time
/// The solution of a complex linear system, by elimination with partial pivoting.
fn solve(mut rows: Vec<Vec<Complex>>, mut right: Vec<Complex>) -> Option<Vec<Complex>> {
    let p = right.len();
    for k in 0..p {
        let pivot = (k..p).max_by(|i, j| rows[*i][k].modulus().total_cmp(&rows[*j][k].modulus()))?;
        rows.swap(k, pivot);
        right.swap(k, pivot);
        // only the direction is wanted, which the pivot does not change
        if rows[k][k].modulus() == 0.0 {
            rows[k][k] = Complex::from(f64::MIN_POSITIVE.sqrt());
        }
        for i in k + 1..p {
            let factor = rows[i][k] / rows[k][k];
            for j in k..p {
                let top = rows[k][j];
                rows[i][j] = rows[i][j] - factor * top;
            }
            let top = right[k];
            right[i] = right[i] - factor * top;
        }
    }
    for k in (0..p).rev() {
        let mut sum = right[k];
        for j in k + 1..p {
            sum = sum - rows[k][j] * right[j];
        }
        right[k] = sum / rows[k][k];
    }
    Some(right)
}

/// The inverse of a matrix.
pub(crate) fn inverse(matrix: &Matrix) -> Option<Matrix> {
    let n = matrix.rows();
    let lu = Lu::new(matrix.values().to_vec(), n)?;
    let mut result = Matrix::zeros(n, n);
    for j in 0..n {
        let mut column = vec![0.0; n];
        column[j] = 1.0;
        lu.solve(&mut column);
        for (i, x) in column.into_iter().enumerate() {
            result[(i, j)] = x;
        }
    }
    Some(result)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The maps of the basis turn the equations of the structure into those of its modes.
    #[test]
    fn modes_obey_their_equations() {
        let mut state = 3_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            f64::from(u32::try_from(state >> 33).unwrap()) / f64::from(1_u32 << 31)
        };
        let mut coupled = 0;
        for case in 0..300 {
            let m = 1 + case % 5;
            let mut gram = |size: f64, rank: usize| {
                let mut g = Matrix::zeros(m, m);
                for _ in 0..rank {
                    let v: Vec<f64> = (0..m).map(|_| random() - 0.5).collect();
                    g.add_outer(size, &v, &v);
                }
                g
            };
            let stiffness = gram(3.0, m);
            let damping = match case % 4 {
                0 => Matrix::zeros(m, m),
                1 => gram(0.2, 1),
                2 => gram(8.0, m),
                _ => {
                    let mut c = stiffness.clone();
                    c.add_outer(0.0, &vec![0.0; m], &vec![0.0; m]);
                    c
                }
            };
            let Some(basis) = Basis::new(&stiffness, &damping) else { continue };
            coupled += u32::from(basis.coupled);
            for (i, (k, d)) in basis.modes.iter().enumerate() {
                assert!(*k >= 0.0 && *d >= 0.0);
                // A e1 = -k e2, A e2 = e1 - 2d e2
                let col = |m: &Matrix| m.column(i);
                let (x1, x2, v1, v2) = (col(&basis.e[0]), col(&basis.e[1]), col(&basis.v[0]), col(&basis.v[1]));
                let rate = |x: &[f64], v: &[f64]| -> Vec<f64> {
                    stiffness.apply(x).iter().zip(damping.apply(v)).map(|(s, c)| -s - c).collect()
                };
                let (r1, r2) = (rate(&x1, &v1), rate(&x2, &v2));
                for j in 0..m {
                    let size = 1e-10 * (1.0 + k + d);
                    assert!((v1[j] + k * x2[j]).abs() < size, "case {case} {i}");
                    assert!((r1[j] + k * v2[j]).abs() < size, "case {case} {i}: {} {}", r1[j], -k * v2[j]);
                    assert!((v2[j] - (x1[j] - 2.0 * d * x2[j])).abs() < size);
                    assert!((r2[j] - (v1[j] - 2.0 * d * v2[j])).abs() < size);
                }
            }
            let there = basis.e[0].times(&basis.a[0]).row(0)[0] + basis.e[1].times(&basis.b[0]).row(0)[0];
            assert!((there - 1.0).abs() < 1e-11);
        }
        assert!(coupled > 60, "{coupled}");
    }
}

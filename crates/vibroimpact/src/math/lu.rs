//! Small dense linear systems: LU factors with partial pivoting.

/// The factors of a square matrix, for any number of right sides.
#[derive(Clone, Debug)]
pub(crate) struct Lu {
    n: usize,
    /// By rows: the multipliers below the diagonal, the upper factor on and above it.
    rows: Vec<f64>,
    /// The row used as pivot at each step.
    pivots: Vec<usize>,
    /// The factors of the rows and of the columns, if it is balanced.
    scales: Option<(Vec<f64>, Vec<f64>)>,
}

impl Lu {
    /// Factors the `n` x `n` matrix `rows`, given by rows; `None` if a pivot is zero or not finite.
    pub(crate) fn new(mut rows: Vec<f64>, n: usize) -> Option<Self> {
        debug_assert_eq!(rows.len(), n * n);
        let mut pivots = Vec::with_capacity(n);
        for k in 0..n {
            let (mut pivot, mut best) = (k, 0.0);
            for i in k..n {
                let size = rows[i * n + k].abs();
                if size > best {
                    (pivot, best) = (i, size);
                }
            }
            if !(best > 0.0 && best.is_finite()) {
                return None;
            }
            pivots.push(pivot);
            if pivot != k {
                for j in 0..n {
                    rows.swap(k * n + j, pivot * n + j);
                }
            }
            let (upper, lower) = rows.split_at_mut((k + 1) * n);
            let top = &upper[k * n..];
            for row in lower.chunks_exact_mut(n) {
                // a row that is 0 here stays as it is
                if row[k] == 0.0 {
                    continue;
                }
                // the multiplier stands in the place of the element that becomes 0
                let factor = row[k] / top[k];
                row[k] = factor;
                for (x, t) in row[k + 1..].iter_mut().zip(&top[k + 1..]) {
                    *x -= factor * t;
                }
            }
        }
        Some(Self { n, rows, pivots, scales: None })
    }

    /// The same of a matrix whose unknowns have these units, and its rows those that `unit` tells; another row has its largest element as its
    /// unit. So the choice of pivots depends on no unit. All units are taken as powers of two: nothing is rounded.
    pub(crate) fn balanced(mut rows: Vec<f64>, units: &[f64], unit: impl Fn(usize) -> Option<f64>) -> Option<Self> {
        let power = |x: f64| libm::ldexp(1.0, libm::ilogb(x));
        let columns: Vec<f64> = units.iter().map(|unit| power(*unit)).collect();
        let n = columns.len();
        let mut factors = Vec::with_capacity(n);
        for (i, row) in rows.chunks_exact_mut(n).enumerate() {
            row.iter_mut().zip(&columns).for_each(|(element, unit)| *element *= unit);
            let largest = || row.iter().fold(0.0_f64, |most, element| most.max(element.abs()));
            let own = unit(i).unwrap_or_else(largest);
            let factor = if own > 0.0 && own.is_finite() { 1.0 / power(own) } else { 1.0 };
            row.iter_mut().for_each(|element| *element *= factor);
            factors.push(factor);
        }
        Some(Self { scales: Some((factors, columns)), ..Self::new(rows, n)? })
    }

    /// The determinant, with the sign of the row exchanges; of a balanced matrix that with its factors, which has the same sign.
    pub(crate) fn determinant(&self) -> f64 {
        let exchanges = self.pivots.iter().enumerate().filter(|(k, pivot)| k != *pivot).count();
        let product: f64 = (0..self.n).map(|k| self.rows[k * self.n + k]).product();
        if exchanges.is_multiple_of(2) { product } else { -product }
    }

    /// Replaces the right side `x` by the solution.
    pub(crate) fn solve(&self, x: &mut [f64]) {
        let Some((rows, columns)) = &self.scales else { return self.substitute(x) };
        x.iter_mut().zip(rows).for_each(|(x, factor)| *x *= factor);
        self.substitute(x);
        x.iter_mut().zip(columns).for_each(|(x, factor)| *x *= factor);
    }

    fn substitute(&self, x: &mut [f64]) {
        let n = self.n;
        // whole rows were exchanged, with their multipliers, so all exchanges come first
        for (k, &pivot) in self.pivots.iter().enumerate() {
            x.swap(k, pivot);
        }
        for i in 1..n {
            let row = &self.rows[i * n..i * n + i];
            let sum: f64 = row.iter().zip(x.iter()).map(|(a, b)| a * b).sum();
            x[i] -= sum;
        }
        for i in (0..n).rev() {
            let row = &self.rows[i * n + i + 1..(i + 1) * n];
            let sum: f64 = row.iter().zip(x[i + 1..].iter()).map(|(a, b)| a * b).sum();
            x[i] = (x[i] - sum) / self.rows[i * n + i];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_what_needs_pivoting() {
        let mut state = 1_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            f64::from(u32::try_from(state >> 33).unwrap()) / f64::from(1_u32 << 31) - 0.5
        };
        for n in [1, 2, 3, 7, 20] {
            let mut a: Vec<f64> = (0..n * n).map(|_| random()).collect();
            if n > 1 {
                a[0] = 0.0;
            }
            let want: Vec<f64> = (0..n).map(|_| random()).collect();
            let mut x: Vec<f64> = (0..n).map(|i| (0..n).map(|j| a[i * n + j] * want[j]).sum()).collect();
            Lu::new(a, n).unwrap().solve(&mut x);
            assert!(x.iter().zip(&want).all(|(a, b)| (a - b).abs() < 1e-12), "{x:?} {want:?}");
        }
    }

    #[test]
    fn refuses_what_has_no_solution() {
        assert!(Lu::new(vec![1.0, 2.0, 2.0, 4.0], 2).is_none());
        assert!(Lu::new(vec![f64::NAN, 0.0, 0.0, 1.0], 2).is_none());
    }
}

//! Curves of solutions by pseudo-arclength.
//!
//! N equations in N + 1 unknowns have curves of solutions. From a point $`w_0`$ with unit tangent $`t`$ the next point
//! is predicted at $`w_0 + ht`$. Newton's method then corrects it in the plane perpendicular to the tangent:
//!
//! $$`G(w) = 0, \qquad \langle t, w - w_0\rangle = h,`$$
//!
//! which is regular also where a parameter turns back (H. B. Keller, "Numerical solution of bifurcation and
//! nonlinear eigenvalue problems", in: Applications of Bifurcation Theory, Academic Press 1977, 359-384). The inner
//! product has weights, so that changes of unknowns of different kinds are comparable.

use crate::math::Lu;

/// A system of equations with one equation fewer than unknowns.
pub(crate) trait Equations {
    /// Whether a Jacobian takes so long that it pays to evaluate it less often: corrections use it again, solutions are predicted to
    /// third order, and tangents are those of the corrections.
    const SLOW: bool = false;

    /// The weight of each unknown in the inner product; one for each unknown.
    fn weights(&self) -> &[f64];

    /// The residuals of the equations at `w`, and their Jacobian by rows, with one more row that the caller fills in;
    /// `None` where the equations are not defined.
    fn at(&self, w: &[f64]) -> Option<(Vec<f64>, Vec<f64>)>;

    /// The residuals alone.
    fn residuals(&self, w: &[f64]) -> Option<Vec<f64>> {
        self.at(w).map(|(miss, _)| miss)
    }

    /// The factors of the derivatives with the last row.
    fn factors(&self, rows: Vec<f64>) -> Option<Lu> {
        Lu::new(rows, self.weights().len())
    }

    /// The weighted inner product of two vectors.
    fn dot(&self, a: &[f64], b: &[f64]) -> f64 {
        self.weights().iter().zip(a.iter().zip(b)).map(|(w, (a, b))| w * a * b).sum()
    }

    /// The weighted length of a vector.
    fn length(&self, a: &[f64]) -> f64 {
        self.dot(a, a).sqrt()
    }

    /// The row whose product with a vector is its weighted inner product with `a`.
    fn row(&self, a: &[f64]) -> Vec<f64> {
        self.weights().iter().zip(a).map(|(w, a)| w * a).collect()
    }
}

/// The largest number of corrections of one point.
const MAX_CORRECTIONS: u32 = 10;
/// After a correction shorter than this, only rounding errors are left, because convergence is quadratic.
const SETTLED: f64 = 1e-9;
/// After a correction shorter than this, the next ones use its derivatives again, if others are slow,
const NEAR: f64 = 1e-5;
/// while each is shorter than the one before by this factor,
const SHARE: f64 = 0.1;
/// until one leaves an error below this.
const ROUNDING: f64 = 1e-16;
/// Where the last corrections did not become shorter by this factor, they are the rounding errors of a solution that is nearly singular;
const STALLED: f64 = 0.3;
/// it is refused where they are longer than this.
const INEXACT: f64 = 3e-8;
/// A correction longer than this would lead to another solution and is refused.
const ASTRAY: f64 = 1.0;

/// The row that selects unknown `k` of so many, with this factor.
pub(crate) fn unit(width: usize, k: usize, factor: f64) -> Vec<f64> {
    (0..width).map(|i| if i == k { factor } else { 0.0 }).collect()
}

/// The solution near `guess` at which the product of `row` and the unknowns is `level`, with the number of corrections;
/// `None` if Newton's method does not converge.
pub(crate) fn correct<E: Equations>(equations: &E, guess: &[f64], row: &[f64], level: f64) -> Option<(Vec<f64>, u32)> {
    corrected(equations, guess, row, level).map(|found| (found.w, found.count))
}

/// A solution that Newton's method found.
pub(crate) struct Corrected {
    pub(crate) w: Vec<f64>,
    /// The number of corrections.
    pub(crate) count: u32,
    /// The factors of the derivatives that were computed last, whose last row is that of the condition,
    pub(crate) factors: Lu,
    /// and the distance of their point from the solution.
    pub(crate) off: f64,
}

/// The same, with the factors of the derivatives.
pub(crate) fn corrected<E: Equations>(equations: &E, guess: &[f64], row: &[f64], level: f64) -> Option<Corrected> {
    let width = guess.len();
    let mut w = guess.to_vec();
    // the correction of a point for its residuals, and its length
    let correction = |w: &[f64], miss: Vec<f64>, factors: &Lu| {
        let off: f64 = row.iter().zip(w).map(|(r, w)| r * w).sum::<f64>() - level;
        let mut change: Vec<f64> = miss.iter().map(|m| -m).chain([-off]).collect();
        factors.solve(&mut change);
        let size = equations.length(&change);
        (change, size)
    };
    let moved = |w: &mut [f64], change: &[f64]| w.iter_mut().zip(change).for_each(|(w, change)| *w += change);
    let mut sizes = Vec::new();
    for count in 1..=MAX_CORRECTIONS {
        let (miss, mut rows) = equations.at(&w)?;
        // the last equation holds the distance along the tangent
        rows[width * (width - 1)..].copy_from_slice(row);
        let factors = equations.factors(rows)?;
        let (change, mut size) = correction(&w, miss, &factors);
        if size.is_nan() || size > ASTRAY {
            return None;
        }
        moved(&mut w, &change);
        // the method is quadratic: the next correction would be below rounding
        if size <= SETTLED {
            return Some(Corrected { w, count, factors, off: size });
        }
        sizes.push(size);
        let last = sizes.last_chunk::<4>().filter(|_| E::SLOW);
        if last.is_some_and(|[first, next @ ..]| next.iter().all(|size| *size > STALLED * first)) {
            return (size <= INEXACT).then_some(Corrected { w, count, factors, off: size });
        }
        let off = size;
        while E::SLOW && size <= NEAR {
            let (change, next) = correction(&w, equations.residuals(&w)?, &factors);
            let share = next / size;
            if next.is_nan() || next > NEAR {
                break;
            }
            moved(&mut w, &change);
            if share * next <= ROUNDING || next <= 1e3 * ROUNDING {
                // all of them count as the one that they replace
                return Some(Corrected { w, count: count + 1, factors, off });
            }
            if share > SHARE {
                break;
            }
            size = next;
        }
    }
    None
}

/// The unit tangent of the curve at `w` whose product with `row` is positive; `None` if that product is zero for the
/// tangent, or if the tangent is not unique.
pub(crate) fn tangent<E: Equations>(equations: &E, w: &[f64], row: &[f64]) -> Option<Vec<f64>> {
    let width = w.len();
    let (_, mut rows) = equations.at(w)?;
    rows[width * (width - 1)..].copy_from_slice(row);
    tangent_of(equations, &equations.factors(rows)?, width)
}

/// The same for the factors of derivatives with such a row, for so many unknowns.
pub(crate) fn tangent_of<E: Equations>(equations: &E, factors: &Lu, width: usize) -> Option<Vec<f64>> {
    // along the curve no equation changes; the last one gives the direction
    let mut along = unit(width, width - 1, 1.0);
    factors.solve(&mut along);
    let length = equations.length(&along);
    if !(length > 0.0 && length.is_finite()) {
        return None;
    }
    along.iter_mut().for_each(|a| *a /= length);
    Some(along)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The unit circle.
    struct Circle;

    impl Equations for Circle {
        fn weights(&self) -> &[f64] {
            &[1.0, 1.0]
        }

        fn at(&self, w: &[f64]) -> Option<(Vec<f64>, Vec<f64>)> {
            Some((vec![w[0] * w[0] + w[1] * w[1] - 1.0], vec![2.0 * w[0], 2.0 * w[1], 0.0, 0.0]))
        }
    }

    #[test]
    fn once_round_a_circle() {
        let (mut w, mut t) = (vec![1.0, 0.0], vec![0.0, 1.0]);
        let mut turned = 0.0_f64;
        for _ in 0..100 {
            let row = Circle.row(&t);
            let level = Circle.dot(&t, &w) + 0.1;
            let guess = [w[0] + 0.1 * t[0], w[1] + 0.1 * t[1]];
            let (next, _) = correct(&Circle, &guess, &row, level).unwrap();
            let angle: f64 = next[1].atan2(next[0]) - w[1].atan2(w[0]);
            turned += angle.rem_euclid(std::f64::consts::TAU);
            t = tangent(&Circle, &next, &row).unwrap();
            w = next;
            assert!((Circle.length(&w) - 1.0).abs() < 1e-15 && Circle.dot(&t, &w).abs() < 1e-15);
        }
        assert!((turned - 100.0 * 0.1_f64.asin()).abs() < 1e-12, "{turned}");
    }
}

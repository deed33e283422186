//! The law of impact: Newton's restitution at one stop, Moreau's law at several.
//!
//! With $`G = W^TW`$ over the closed stops (in mass-normalised coordinates) the impulses $`\Lambda`$ obey
//! $`0 \le \Lambda \perp (\dot g_+ + e\,\dot g_-) \ge 0`$, $`\dot g_+ = \dot g_- + G\Lambda`$. See J. J. Moreau,
//! "Unilateral contact and dry friction in finite freedom dynamics", doi:10.1007/978-3-7091-2624-0_1. The problem is
//! solved by Murty's principal pivoting, which ends for every positive definite $`G`$.

use crate::math::{Lu, dot};

/// The impulses on stops with these directions, velocities of their gaps before and restitutions; `None` if the
/// directions depend on each other so that no solution is found.
pub(super) fn impulses(directions: &[&[f64]], rates: &[f64], restitutions: &[f64]) -> Option<Vec<f64>> {
    let count = directions.len();
    let b: Vec<f64> = rates.iter().zip(restitutions).map(|(rate, e)| (1.0 + e) * rate).collect();
    let gram = |i: usize, j: usize| dot(directions[i], directions[j]);
    let mut pushed = vec![false; count];
    for _ in 0..(1_u32 << count.min(16)) + 16 {
        let set: Vec<usize> = (0..count).filter(|j| pushed[*j]).collect();
        let mut values = vec![0.0; count];
        if !set.is_empty() {
            let rows = set.iter().flat_map(|i| set.iter().map(|j| gram(*i, *j))).collect();
            let mut right: Vec<f64> = set.iter().map(|j| -b[*j]).collect();
            Lu::new(rows, set.len())?.solve(&mut right);
            for (j, value) in set.iter().zip(right) {
                values[*j] = value;
            }
        }
        let wrong = (0..count).find(|j| {
            if pushed[*j] {
                return values[*j] < 0.0;
            }
            let (mut left, mut size) = (b[*j], b[*j].abs());
            for (i, value) in values.iter().enumerate() {
                left += gram(*j, i) * value;
                size += (gram(*j, i) * value).abs();
            }
            left < -16.0 * f64::EPSILON * size
        });
        match wrong {
            None => return Some(values),
            Some(j) => pushed[j] = !pushed[j],
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_stop_and_a_chain_of_equal_balls() {
        assert_eq!(impulses(&[&[2.0]], &[-3.0], &[0.5]).unwrap(), [4.5 / 4.0]);
        // ball 0 at speed 1 strikes 1, which touches 2: gaps x1 - x0 and x2 - x1
        let (a, b): (&[f64], &[f64]) = (&[1.0, -1.0, 0.0], &[0.0, 1.0, -1.0]);
        let found = impulses(&[a, b], &[-1.0, 0.0], &[0.0, 0.0]).unwrap();
        // all three go on together with 1/3
        let v: Vec<f64> = (0..3).map(|i| f64::from(u8::from(i == 0)) - a[i] * found[0] - b[i] * found[1]).collect();
        assert!(v.iter().all(|v| (v - 1.0 / 3.0).abs() < 1e-15), "{v:?}");
        // a stop that opens takes no part
        assert_eq!(impulses(&[a, b], &[-1.0, 5.0], &[0.0, 0.0]).unwrap()[1], 0.0);
    }
}

//! The law of impact: Newton's restitution at one stop, Moreau's law at several.
//!
//! With $`G = W^TW`$ over the closed stops (in mass-normalised coordinates) the impulses $`\Lambda`$ obey
//! $`0 \le \Lambda \perp (\dot g_+ + e\,\dot g_-) \ge 0`$, $`\dot g_+ = \dot g_- + G\Lambda`$. See J. J. Moreau,
//! "Unilateral contact and dry friction in finite freedom dynamics", doi:10.1007/978-3-7091-2624-0_1. These are the
//! conditions for the least value of $`\tfrac12|W\Lambda|^2 + b\cdot\Lambda`$ over $`\Lambda \ge 0`$ with
//! $`b = (1 + e)\,\dot g_-`$, which is found by the active sets of C. L. Lawson and R. J. Hanson, *Solving Least Squares
//! Problems*, chapter 23, doi:10.1137/1.9781611971217. The velocities after the impact are unique also where directions
//! depend on each other, as two stops at one place or three supports of a bar. The impulses are not, and those of as few
//! stops as possible are taken.

use crate::math::{Lu, dot, two_prod};
use crate::regime::independent;

/// The impulses on stops with these directions, velocities of their gaps before and restitutions; `None` if stops close
/// on the structure from two sides, so that no impulses open all of them.
pub(super) fn impulses(directions: &[&[f64]], rates: &[f64], restitutions: &[f64]) -> Option<Vec<f64>> {
    let count = directions.len();
    let b: Vec<f64> = rates.iter().zip(restitutions).map(|(rate, e)| (1.0 + e) * rate).collect();
    let gram = |i: usize, j: usize| dot(directions[i], directions[j]);
    let mut values = vec![0.0; count];
    let mut pushing: Vec<usize> = Vec::new();
    // each round changes the set of stops that push, and no set comes twice; the cap is for rounding errors
    for _ in 0..64 * (count + 1) {
        let (least, j) = (0..count)
            .filter(|j| !pushing.contains(j))
            .map(|j| {
                let (mut left, mut size) = (b[j], b[j].abs());
                for i in &pushing {
                    left += gram(j, *i) * values[*i];
                    size += (gram(j, *i) * values[*i]).abs();
                }
                let square = gram(j, j).sqrt();
                // per length of the direction, so that no unit decides which stop is next; what is below the rounding
                // of the sum is open
                (if left < -16.0 * f64::EPSILON * size { left / square } else { 0.0 }, j)
            })
            .fold((0.0, count), |best, next| if next.0 < best.0 { next } else { best });
        if least == 0.0 {
            return Some(values);
        }
        if !enter(directions, &mut pushing, &mut values, j) {
            return None;
        }
        loop {
            let wanted = solution(&gram, &b, &pushing)?;
            let reach = |i: &usize, wanted: f64| {
                if wanted < 0.0 { values[*i] / (values[*i] - wanted) } else { f64::INFINITY }
            };
            let reaches: Vec<f64> = pushing.iter().zip(&wanted).map(|(i, wanted)| reach(i, *wanted)).collect();
            let step = reaches.iter().fold(1.0_f64, |least, reach| least.min(*reach));
            if step >= 1.0 {
                pushing.iter().zip(&wanted).for_each(|(i, wanted)| values[*i] = *wanted);
                break;
            }
            // as far as no impulse pulls; those that are zero there leave
            let mut left = Vec::new();
            for ((i, wanted), reach) in pushing.iter().zip(&wanted).zip(reaches) {
                if reach <= step {
                    values[*i] = 0.0;
                } else {
                    values[*i] += step * (wanted - values[*i]);
                    left.push(*i);
                }
            }
            pushing = left;
        }
    }
    None
}

/// Adds a stop to those that push. If its direction depends on theirs, it takes over the load of one of them; `false` if it
/// cannot.
fn enter(directions: &[&[f64]], pushing: &mut Vec<usize>, values: &mut [f64], j: usize) -> bool {
    let with: Vec<&[f64]> = pushing.iter().chain([&j]).map(|i| directions[*i]).collect();
    if independent(with.iter().copied()).len() == with.len() {
        pushing.push(j);
        return true;
    }
    // its direction as a combination of theirs
    let gram = pushing.iter().flat_map(|a| pushing.iter().map(|b| dot(directions[*a], directions[*b]))).collect();
    let Some(lu) = Lu::new(gram, pushing.len()) else { return false };
    let mut shares: Vec<f64> = pushing.iter().map(|i| dot(directions[*i], directions[j])).collect();
    lu.solve(&mut shares);
    let small = 1e-9 * shares.iter().fold(0.0_f64, |most, share| most.max(share.abs()));
    // the first whose load would be used up leaves for the new one; the impulse on the whole structure stays
    let loads = pushing.iter().zip(&shares).enumerate().filter(|(_, (_, share))| **share > small);
    let Some((load, at)) = loads.map(|(at, (i, share))| (values[*i] / share, at)).min_by(|a, b| a.0.total_cmp(&b.0))
    else {
        return false;
    };
    for (i, share) in pushing.iter().zip(&shares) {
        values[*i] -= load * share;
    }
    values[pushing[at]] = 0.0;
    values[j] = load;
    pushing[at] = j;
    true
}

/// The impulses with which these stops rebound by their restitution, rounded once, so that equal stops push equally.
fn solution(gram: &impl Fn(usize, usize) -> f64, b: &[f64], pushing: &[usize]) -> Option<Vec<f64>> {
    if let [i] = *pushing {
        return Some(vec![-b[i] / gram(i, i)]);
    }
    let lu = Lu::new(pushing.iter().flat_map(|i| pushing.iter().map(|j| gram(*i, *j))).collect(), pushing.len())?;
    let mut values: Vec<f64> = pushing.iter().map(|i| -b[*i]).collect();
    lu.solve(&mut values);
    // residuals with twice the digits, so that two corrections are as good as one rounding of the exact solution
    for _ in 0..2 {
        let residual = |i: &usize| {
            let (mut sum, mut low) = (-b[*i], 0.0);
            for (j, value) in pushing.iter().zip(&values) {
                let (product, error) = two_prod(gram(*i, *j), *value);
                let (next, lost) = crate::math::two_sum(sum, -product);
                (sum, low) = (next, low + (lost - error));
            }
            sum + low
        };
        let mut change: Vec<f64> = pushing.iter().map(residual).collect();
        lu.solve(&mut change);
        values.iter_mut().zip(change).for_each(|(value, change)| *value += change);
    }
    Some(values)
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

    /// Of two stops at one place the one with the larger restitution pushes; three supports of a bar share its impulse
    /// among two; a body between two stops that close on it from both sides has no solution.
    #[test]
    fn dependent_stops() {
        let one: &[f64] = &[1.0];
        assert_eq!(impulses(&[one, one], &[-1.0, -1.0], &[0.5, 0.5]).unwrap(), [1.5, 0.0]);
        assert_eq!(impulses(&[one, one], &[-1.0, -1.0], &[0.5, 0.8]).unwrap(), [0.0, 1.8]);
        let feet: [&[f64]; 3] = [&[1.0, -1.0], &[1.0, 0.0], &[1.0, 1.0]];
        for order in [[0, 1, 2], [2, 0, 1], [1, 2, 0]] {
            let directions: Vec<&[f64]> = order.iter().map(|i| feet[*i]).collect();
            let found = impulses(&directions, &[-1.0; 3], &[0.3; 3]).unwrap();
            let lift: f64 = directions.iter().zip(&found).map(|(w, value)| w[0] * value).sum();
            let turn: f64 = directions.iter().zip(&found).map(|(w, value)| w[1] * value).sum();
            assert!((lift - 1.3).abs() < 1e-15 && turn.abs() < 1e-15, "{order:?} {found:?}");
        }
        assert_eq!(impulses(&[one, &[-1.0]], &[-1.0, -1.0], &[0.5, 0.5]), None);
    }

    /// Equal impulses on equal stops, to the last bit, for any inertia.
    #[test]
    fn symmetric() {
        for k in 1..200 {
            let arm = 0.37 * f64::from(k).sqrt();
            let found = impulses(&[&[1.3, arm], &[1.3, -arm]], &[-0.7, -0.7], &[0.3, 0.3]).unwrap();
            assert_eq!(found[0], found[1], "{arm}");
        }
    }
}

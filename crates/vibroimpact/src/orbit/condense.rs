//! The linear system of a cycle, solved in a time proportional to its number of impacts.
//!
//! Each flight couples two impacts, $`A_i\,\Delta z_i + B_i\,\Delta z_{i+1} = r_i`$, and the last flight leads back to
//! the first impact. The impacts are eliminated one by one, between the flight that arrives and the flight that leaves,
//! until two equations for the first impact are left. Pivoting uses the four rows of both flights, because $`B_i`$ or
//! $`A_{i+1}`$ may be singular; $`B_i`$ is singular at a grazing impact.

use super::cyclic::Block;
use crate::math::Matrix2;

/// A row of the elimination: the coefficients of the first impact, of the impact to be eliminated and of the next, and
/// the right side.
type Row = [f64; 7];

/// The change of all unknowns that makes the residuals of all flights zero to first order; `None` if the system is
/// singular.
pub(crate) fn correction(blocks: &[Block]) -> Option<Vec<f64>> {
    let m = blocks.len();
    let row = |a: [f64; 2], b: [f64; 2], r: f64| -> Row { [0.0, 0.0, a[0], a[1], b[0], b[1], -r] };
    let two = |k: usize| {
        let Block { miss, left, right, .. } = &blocks[k];
        [0, 1].map(|i| row(left.0[i], right.0[i], miss[i]))
    };
    // the equations that couple the first impact with the current one; the coefficients of the first impact stand first
    let mut link = two(0).map(|[.., a, b, c, d, r]| [a, b, c, d, 0.0, 0.0, r]);
    let mut eliminated: Vec<[Row; 2]> = Vec::with_capacity(m);
    for k in 1..m {
        let [third, fourth] = two(k);
        let mut rows = [link[0], link[1], third, fourth];
        for step in 0..2 {
            let column = 2 + step;
            let pivot = (step..4).max_by(|&a, &b| rows[a][column].abs().total_cmp(&rows[b][column].abs()))?;
            if rows[pivot][column] == 0.0 || !rows[pivot][column].is_finite() {
                return None;
            }
            rows.swap(step, pivot);
            let top = rows[step];
            for other in &mut rows[step + 1..] {
                let factor = other[column] / top[column];
                other.iter_mut().zip(&top).for_each(|(x, t)| *x -= factor * t);
                other[column] = 0.0;
            }
        }
        eliminated.push([rows[0], rows[1]]);
        // the next impact takes the place of the eliminated one
        link = [rows[2], rows[3]].map(|[a, b, _, _, c, d, r]| [a, b, c, d, 0.0, 0.0, r]);
    }
    let closed = Matrix2(link.map(|[a, b, c, d, ..]| [a + c, b + d]));
    let first = closed.solve([link[0][6], link[1][6]])?;
    let mut change = vec![0.0; 2 * m];
    change[..2].copy_from_slice(&first);
    let mut next = first;
    for (k, [upper, lower]) in eliminated.iter().enumerate().rev() {
        let left = |row: &Row| row[6] - row[0] * first[0] - row[1] * first[1] - row[4] * next[0] - row[5] * next[1];
        let second = left(lower) / lower[3];
        next = [(left(upper) - upper[3] * second) / upper[2], second];
        change[2 * k + 2..2 * k + 4].copy_from_slice(&next);
    }
    Some(change)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Lu;
    use crate::orbit::fill;

    #[test]
    fn the_same_as_by_elimination_of_the_whole() {
        let mut state = 7_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            f64::from(u32::try_from(state >> 33).unwrap()) / f64::from(1_u32 << 31) - 0.5
        };
        for m in [1, 2, 3, 10] {
            let mut blocks: Vec<Block> = (0..m)
                .map(|_| Block {
                    miss: [random(), random()],
                    left: Matrix2([[random(), random()], [random(), random()]]),
                    right: Matrix2([[random(), 0.0], [random(), -1.0]]),
                    divisor: 1.0,
                })
                .collect();
            // a grazing impact
            blocks[0].right.0[0][0] = 0.0;
            let mut rows = vec![0.0; 4 * m * m];
            fill(&mut rows, 2 * m, &blocks);
            let mut expected: Vec<f64> = blocks.iter().flat_map(|b| b.miss).map(|miss| -miss).collect();
            Lu::new(rows, 2 * m).unwrap().solve(&mut expected);
            let found = correction(&blocks).unwrap();
            assert!(found.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-11 * (1.0 + b.abs())), "{m}");
        }
    }
}

//! How points are drawn from a box. Every point is computed from its number, so that tiles need not know each other.
//!
//! The sequence of Sobol has the direction numbers of S. Joe and F. Y. Kuo, "Constructing Sobol sequences with better
//! two-dimensional projections", SIAM J. Sci. Comput. 30 (2008) 2635-2654; a seed other than 0 shifts its digits. The
//! Latin hypercube permutes its layers by the hash of A. Kensler, "Correlated multi-jittered sampling", Pixar Technical
//! Memo 13-01 (2013).

use serde::{Deserialize, Serialize};

/// A rule by which points are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PointRule {
    /// The low-discrepancy sequence of Sobol. Powers of two are good numbers of points.
    Sobol,
    /// A Latin hypercube: each number has one value in each of N equal parts of its range, N being the number of points.
    Lhs,
}

/// Maximum number of dimensions of the sequence of Sobol.
pub(super) const MOST_SOBOL: usize = DIRECTIONS.len();

impl PointRule {
    /// The place from 0 to 1 of point number `k` in a dimension, for a number of points and a seed.
    pub(super) fn place(self, k: u64, dimension: usize, (count, seed): (u64, u64)) -> f64 {
        match self {
            Self::Sobol => {
                let shift = if seed == 0 { 0 } else { mixed(seed, dimension as u64) >> 32 };
                // the middle of the interval of 2^-32 in which the point lies; without a shift the point itself
                let half = if seed == 0 { 0.0 } else { 0.5 };
                (f64::from(sobol(k, dimension) ^ low(shift)) + half) / TWO_32
            }
            Self::Lhs => {
                let key = mixed(seed, 2 * dimension as u64);
                let layer = f64::from(permuted(low(k), low(count), low(key)));
                let within = mixed(mixed(seed, 2 * dimension as u64 + 1), k) >> 32;
                #[allow(clippy::cast_precision_loss)] // at most 10^9
                let count = count as f64;
                (layer + (f64::from(low(within)) + 0.5) / TWO_32) / count
            }
        }
    }
}

const TWO_32: f64 = 4_294_967_296.0;

/// The low 32 bits.
#[allow(clippy::cast_possible_truncation)] // that is the purpose
const fn low(bits: u64) -> u32 {
    bits as u32
}

/// Bits without a pattern, from two numbers: the finaliser of SplitMix64.
const fn mixed(a: u64, b: u64) -> u64 {
    let mut z =
        a.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(b.wrapping_add(1).wrapping_mul(0xd1b5_4a32_d192_ed03));
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Element `k` of a permutation of 0 to `count` - 1 that belongs to `key`.
const fn permuted(mut k: u32, count: u32, key: u32) -> u32 {
    let mut mask = count - 1;
    mask |= mask >> 1;
    mask |= mask >> 2;
    mask |= mask >> 4;
    mask |= mask >> 8;
    mask |= mask >> 16;
    // each step permutes the numbers with the bits of the mask; those beyond the end are permuted again
    loop {
        k ^= key;
        k = k.wrapping_mul(0xe170_893d);
        k ^= key >> 16;
        k ^= (k & mask) >> 4;
        k ^= key >> 8;
        k = k.wrapping_mul(0x0929_eb3f);
        k ^= key >> 23;
        k ^= (k & mask) >> 1;
        k = k.wrapping_mul(1 | key >> 27);
        k = k.wrapping_mul(0x6935_fa69);
        k ^= (k & mask) >> 11;
        k = k.wrapping_mul(0x74dc_b303);
        k ^= (k & mask) >> 2;
        k = k.wrapping_mul(0x9e50_1cc3);
        k ^= (k & mask) >> 2;
        k = k.wrapping_mul(0xc860_a3df);
        k &= mask;
        k ^= k >> 5;
        if k < count {
            return low((k as u64 + key as u64) % count as u64);
        }
    }
}

/// Degree, coefficients of the polynomial, and initial numbers of each dimension; the first dimension has none.
const DIRECTIONS: [(u32, u32, &[u32]); 16] = [
    (0, 0, &[]),
    (1, 0, &[1]),
    (2, 1, &[1, 3]),
    (3, 1, &[1, 3, 1]),
    (3, 2, &[1, 1, 1]),
    (4, 1, &[1, 1, 3, 3]),
    (4, 4, &[1, 3, 5, 13]),
    (5, 2, &[1, 1, 5, 5, 17]),
    (5, 4, &[1, 1, 5, 5, 5]),
    (5, 7, &[1, 1, 7, 11, 19]),
    (5, 11, &[1, 1, 5, 1, 1]),
    (5, 13, &[1, 1, 1, 3, 11]),
    (5, 14, &[1, 3, 5, 5, 31]),
    (6, 1, &[1, 3, 3, 9, 7, 49]),
    (6, 13, &[1, 1, 1, 15, 21, 21]),
    (6, 16, &[1, 3, 1, 13, 27, 49]),
];

/// Point number `k` of the sequence in a dimension, as a fraction of 2^32.
fn sobol(k: u64, dimension: usize) -> u32 {
    let (degree, coefficients, initial) = DIRECTIONS[dimension];
    let degree = degree as usize;
    let mut directions = [0_u32; 32];
    for bit in 0..32 {
        directions[bit] = if degree == 0 {
            1 << (31 - bit)
        } else if bit < degree {
            initial[bit] << (31 - bit)
        } else {
            let first = directions[bit - degree];
            let mut next = first ^ (first >> degree);
            for j in 1..degree {
                if coefficients >> (degree - 1 - j) & 1 == 1 {
                    next ^= directions[bit - j];
                }
            }
            next
        };
    }
    // in the order of the Gray code, in which consecutive points differ by one direction
    let gray = k ^ (k >> 1);
    (0..32).filter(|bit| gray >> bit & 1 == 1).fold(0, |x, bit| x ^ directions[bit])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_permutation_has_every_number_once() {
        for (count, key) in [(1, 5), (2, 0), (7, 1), (100, 77), (1000, u32::MAX), (4096, 3)] {
            let mut seen: Vec<u32> = (0..count).map(|k| permuted(k, count, key)).collect();
            seen.sort_unstable();
            assert_eq!(seen, (0..count).collect::<Vec<_>>());
        }
        assert_ne!(
            (0..50).map(|k| permuted(k, 50, 1)).collect::<Vec<_>>(),
            (0..50).map(|k| permuted(k, 50, 2)).collect::<Vec<_>>()
        );
    }

    /// The first points that J. Burkardt, S. Joe and F. Y. Kuo print for three dimensions.
    #[test]
    fn the_first_points_of_sobol() {
        let points: Vec<[f64; 3]> = (0..6).map(|k| [0, 1, 2].map(|of| PointRule::Sobol.place(k, of, (6, 0)))).collect();
        let expected = [
            [0.0, 0.0, 0.0],
            [0.5, 0.5, 0.5],
            [0.75, 0.25, 0.25],
            [0.25, 0.75, 0.75],
            [0.375, 0.375, 0.625],
            [0.875, 0.875, 0.125],
        ];
        assert_eq!(points, expected);
    }

    /// A Latin hypercube has one point in each layer, and 2^m points of Sobol one in each interval of 2^-m.
    #[test]
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // numbers of layers
    fn one_point_in_each_layer() {
        for (rule, count, dimensions) in [(PointRule::Lhs, 100, 16), (PointRule::Sobol, 256, 16)] {
            for seed in [0, 1, 12_345] {
                for dimension in 0..dimensions {
                    let mut layers: Vec<u64> = (0..count)
                        .map(|k| {
                            let place = rule.place(k, dimension, (count, seed));
                            assert!((0.0..=1.0).contains(&place));
                            (place * count as f64) as u64
                        })
                        .collect();
                    layers.sort_unstable();
                    assert_eq!(layers, (0..count).collect::<Vec<_>>(), "{rule:?} {seed} {dimension}");
                }
            }
        }
        let first = |seed| PointRule::Lhs.place(0, 0, (100, seed));
        assert_ne!(first(1), first(2));
    }
}

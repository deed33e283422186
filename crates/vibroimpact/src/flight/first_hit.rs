//! The first multiple of a number in an interval of the circle.

/// The smallest `k` from 1 to `most` with `l <= k a mod m <= r`, where `0 < l <= r < m` and `a < m`; `None` if there is
/// none. By the algorithm of Euclid, so the time is logarithmic. `m` is at most $`2^{44}`$ and `most` at most
/// $`2^{19}`$, so that no product overflows.
pub(super) fn first_hit(a: u64, m: u64, l: u64, r: u64, most: u64) -> Option<u64> {
    if a == 0 {
        return None;
    }
    if 2 * a > m {
        // - k (m - a) = k a
        return first_hit(m - a, m, m - r, m - l, most);
    }
    // without a full turn
    let direct = l.div_ceil(a);
    if direct * a <= r {
        return (direct <= most).then_some(direct);
    }
    // No multiple of a lies in [l, r]. After y turns there is one if -m y mod a is in the image of [l, r].
    let turns = first_hit((a - m % a) % a, a, l % a, r % a, most)?;
    let k = (l + m * turns).div_ceil(a);
    (k <= most).then_some(k)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn small_circles_entirely() {
        for m in 2..24_u64 {
            for (a, l, r) in (0..m).flat_map(|a| (1..m).flat_map(move |l| (l..m).map(move |r| (a, l, r)))) {
                let expected = (1..=2 * m).find(|k| (l..=r).contains(&(k * a % m)));
                assert_eq!(first_hit(a, m, l, r, 2 * m), expected, "{a} mod {m} in {l}..={r}");
            }
        }
    }

    proptest! {
        #[test]
        fn as_by_trying(a in 1..1_u64 << 44, l in 1..1_u64 << 44, wide in 0..1_u64 << 36) {
            let (m, most) = (1 << 44, 3000);
            let r = (l + wide).min(m - 1);
            let expected = (1..=most).find(|k| (l..=r).contains(&(k * a % m)));
            prop_assert_eq!(first_hit(a, m, l, r, most), expected);
        }
    }
}

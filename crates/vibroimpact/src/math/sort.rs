//! Sorting whose algorithm is compiled once: the standard one is compiled anew for each type and each order, at 8 kB each.

use core::cmp::Ordering;

/// Up to so many elements are sorted by insertion.
const SHORT: usize = 16;

/// Sorts a list as `slice::sort_by` does: equal elements keep their order.
///
/// ```
/// use vibroimpact::math::sort_by;
/// let mut speeds = vec![0.4_f64, 1.5, 0.1];
/// sort_by(&mut speeds, |a, b| b.total_cmp(a));
/// assert_eq!(speeds, [1.5, 0.4, 0.1]);
/// ```
pub fn sort_by<T>(list: &mut [T], order: impl Fn(&T, &T) -> Ordering) {
    if list.len() <= SHORT {
        for last in 1..list.len() {
            let place = (0..last).rev().take_while(|k| order(&list[*k], &list[last]) == Ordering::Greater).last();
            if let Some(place) = place {
                list[place..=last].rotate_right(1);
            }
        }
        return;
    }
    // where the element of each place comes from
    let mut from = ordered(list.len(), &|a, b| order(&list[a], &list[b]));
    for first in 0..from.len() {
        let mut place = first;
        while from[place] != first {
            list.swap(place, from[place]);
            place = core::mem::replace(&mut from[place], place);
        }
        from[place] = place;
    }
}

/// Sorts a list by a key: equal elements keep their order.
pub fn sort_by_key<T, K: Ord>(list: &mut [T], key: impl Fn(&T) -> K) {
    sort_by(list, |a, b| key(a).cmp(&key(b)));
}

/// The numbers below `count` in an order.
fn ordered(count: usize, order: &dyn Fn(usize, usize) -> Ordering) -> Vec<usize> {
    let mut all: Vec<usize> = (0..count).collect();
    all.sort_by(|a, b| order(*a, *b));
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The same as the standard sort, with many equal keys, at every length.
    #[test]
    fn as_the_standard_sort() {
        let mut state = 1_u64;
        for count in (0..40).chain([100, 1000]) {
            for keys in [1, 3, 50] {
                let mut list: Vec<(u64, usize)> = (0..count)
                    .map(|place| {
                        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                        ((state >> 33) % keys, place)
                    })
                    .collect();
                let mut standard = list.clone();
                standard.sort_by_key(|(key, _)| *key);
                sort_by_key(&mut list, |(key, _)| *key);
                assert_eq!(list, standard);
            }
        }
    }
}

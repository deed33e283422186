//! The order in which many starts are launched: one beside another after each other.
//!
//! Neighbouring starts mostly have the same impacts and the same ends, so a processor predicts the branches that their
//! motions take. Starts in no order take them at random, which costs some percent of the time. No verdict depends on the
//! order.

use crate::system::Start;

/// The number of cells into which the ranges of all coordinates together are divided.
const CELLS: usize = 1 << 14;
/// The number of pairs of successive starts from which it is told whether they are in no order.
const PAIRS: u64 = 64;
/// The first starts of these pairs are the multiples of this prime modulo the number of pairs, which are spread over all
/// starts. Evenly spaced pairs could all lie at the ends of the rows of a grid.
const SPREAD: u64 = 1_000_003;
/// Successive starts are apart if a coordinate differs by more than this part of its range.
const APART: f64 = 1.0 / 16.0;
/// Fewer starts than this are not worth an order.
const FEW: u64 = 1024;

/// The smallest and the largest value of each coordinate.
#[derive(Clone, Copy)]
struct Ranges([(f64, f64); 3]);

impl Ranges {
    fn of<'a>(starts: impl Iterator<Item = &'a Start>) -> Self {
        let mut ranges = [(f64::INFINITY, f64::NEG_INFINITY); 3];
        for start in starts {
            for ((low, high), value) in ranges.iter_mut().zip(coordinates(start)) {
                *low = if value < *low { value } else { *low };
                *high = if value > *high { value } else { *high };
            }
        }
        Self(ranges)
    }

    fn lengths(&self) -> [f64; 3] {
        self.0.map(|(low, high)| high - low)
    }
}

const fn coordinates(start: &Start) -> [f64; 3] {
    [start.x, start.v, start.phase]
}

/// The starts with their numbers, sorted by the cell in which they are; `None` if they are few, or if most of them
/// are beside the one before.
pub(super) fn sorted(count: u64, start: &dyn Fn(u64) -> Start) -> Option<Vec<(u32, Start)>> {
    let total = u32::try_from(count).ok().filter(|_| count >= FEW)?;
    let pair = |k: u64| [start(k), start(k + 1)];
    let pairs: Vec<[Start; 2]> = (0..PAIRS).map(|k| pair(k * SPREAD % (count - 1))).collect();
    let lengths = Ranges::of(pairs.iter().flatten()).lengths();
    let apart = |[a, b]: &&[Start; 2]| {
        let mut all = coordinates(a).into_iter().zip(coordinates(b)).zip(lengths);
        all.any(|((a, b), length)| (a - b).abs() > APART * length)
    };
    if 2 * pairs.iter().filter(apart).count() as u64 <= PAIRS {
        return None;
    }
    let starts: Vec<Start> = (0..count).map(start).collect();
    let cells = cells(&starts);
    // counted, then each put at the next place of its cell
    let mut places = vec![0_u32; CELLS];
    for cell in &cells {
        places[usize::from(*cell)] += 1;
    }
    let mut next = 0;
    for place in &mut places {
        next += core::mem::replace(place, next);
    }
    let mut sorted = vec![(0, starts[0]); starts.len()];
    for ((number, start), cell) in (0..total).zip(&starts).zip(&cells) {
        let place = &mut places[usize::from(*cell)];
        sorted[*place as usize] = (number, *start);
        *place += 1;
    }
    Some(sorted)
}

/// The cell of each start: the range of each coordinate that varies is divided into the same number of parts.
fn cells(starts: &[Start]) -> Vec<u16> {
    let ranges = Ranges::of(starts.iter());
    let varying = ranges.lengths().into_iter().filter(|length| *length > 0.0).count();
    // the roots of CELLS
    let parts: u16 = [1, 1 << 14, 1 << 7, 25][varying];
    let mut cells = vec![0; starts.len()];
    for (k, (low, high)) in ranges.0.into_iter().enumerate().filter(|(_, (low, high))| low < high) {
        let (scale, last) = (f64::from(parts) / (high - low), parts - 1);
        for (cell, start) in cells.iter_mut().zip(starts) {
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // 0 to CELLS
            let part = ((coordinates(start)[k] - low) * scale) as u16;
            *cell = *cell * parts + part.min(last);
        }
    }
    cells
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario;
    use crate::verdict::{StartBox, scattered_starts};

    /// Each scattered start once, and most beside the one before; a grid keeps its order.
    #[test]
    #[allow(clippy::cast_precision_loss)]
    fn every_start_once() {
        let osc = scenario::S.oscillator();
        let area = StartBox::natural(&osc);
        for count in [1024, 20_000, 65_536] {
            let start = |k: u64| scattered_starts(&osc, area, 3, k);
            let list = sorted(count, &start).unwrap();
            assert!(list.iter().all(|(k, there)| *there == start(u64::from(*k))));
            let mut numbers: Vec<u32> = list.iter().map(|(k, _)| *k).collect();
            numbers.sort_unstable();
            assert!(numbers.into_iter().map(u64::from).eq(0..count));
            let beside = |pair: &[(u32, Start)]| (pair[0].1.v - pair[1].1.v).abs() < 0.2 * (area.v.1 - area.v.0);
            let near = list.windows(2).filter(|pair| beside(pair)).count() as u64;
            assert!(10 * near > 8 * count, "{near} of {count}");
            for row in [100, 128, 256] {
                let grid = |k: u64| Start { x: (k / row) as f64, v: (k % row) as f64, phase: 0.0 };
                assert!(sorted(count, &grid).is_none());
            }
        }
        // a list that is sorted is in order
        let flat = |k: u64| Start { phase: 0.0, ..scattered_starts(&osc, area, 3, k) };
        let list = sorted(20_000, &flat).unwrap();
        assert!(sorted(20_000, &|k| list[usize::try_from(k).unwrap()].1).is_none());
        assert!(sorted(20, &|k| scattered_starts(&osc, area, 3, k)).is_none());
        // all the same
        assert!(sorted(5000, &|_| scattered_starts(&osc, area, 3, 1)).is_none());
    }
}

//! The tiles of a basin joined: its motions in the order of the first start that leads to each.

use crate::Block;
use vibroimpact::verdict::{Census, CountedMotion, System, Verdict};

/// A tile: its motions, and for each start the index of its motion; `None` for a start without one.
pub(super) struct Part<S: System> {
    pub(super) block: Block,
    pub(super) met: Census<S>,
    pub(super) cells: Vec<Option<u32>>,
}

/// The motions of all tiles, and for each start the index of its motion.
pub(super) struct Joined<S: System> {
    pub(super) motions: Vec<CountedMotion<S>>,
    pub(super) cells: Vec<Option<usize>>,
}

/// Joins the tiles of a grid. `settled` returns the verdict on the start at a point of the grid.
///
/// The verdict on a motion is that of its first start, so it does not depend on the tiles.
pub(super) fn joined<S: System>(
    whole: &Block,
    parts: impl IntoIterator<Item = Part<S>>,
    settled: impl Fn(usize) -> Verdict<S>,
) -> Joined<S> {
    let mut merged = Census::default();
    let mut cells: Vec<Option<usize>> = vec![None; whole.points()];
    // for each motion, the start whose verdict is in the census
    let mut sources: Vec<usize> = Vec::new();
    for Part { block, met, cells: local } in parts {
        let numbers: Vec<usize> = met.motions().iter().map(|found| merged.add_found(found)).collect();
        for (k, cell) in local.into_iter().enumerate() {
            let Some(local) = cell else { continue };
            let (place, number) = (whole.number(&block.index(k)), numbers[local as usize]);
            if number == sources.len() {
                sources.push(place);
            }
            cells[place] = Some(number);
        }
    }
    let mut order: Vec<(usize, usize)> = Vec::new();
    let mut renumbered = vec![None; sources.len()];
    for (place, cell) in cells.iter_mut().enumerate() {
        *cell = cell.map(|number| {
            *renumbered[number].get_or_insert_with(|| {
                order.push((number, place));
                order.len() - 1
            })
        });
    }
    let motions = order.into_iter().map(|(number, first)| {
        let found = &merged.motions()[number];
        let verdict = if sources[number] == first { found.verdict.clone() } else { settled(first) };
        CountedMotion { verdict, count: found.count }
    });
    Joined { motions: motions.collect(), cells }
}

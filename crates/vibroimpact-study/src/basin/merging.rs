//! Whether all basins of a plane have one common boundary (the Wada property), by the merging method.
//!
//! For each motion the basins of all others are merged into one, and the boundary between the two remaining basins is
//! taken. With the Wada property these boundaries are the same set, whichever motion is singled out. On a grid they are
//! compared after they are fattened: the radius is the smallest number of cells by which each of them has to be fattened
//! to contain all others (A. Daza, A. Wagemakers, M. A. F. Sanjuan, "Ascertaining when a basin is Wada: the merging
//! method", Sci. Rep. 8, 9954 (2018), <https://doi.org/10.1038/s41598-018-28119-0>). Where basins do not have the
//! property, the radius is a fixed part of the plane, however fine the grid; where they have it, the radius is a few cells.
//! The answer belongs to the resolution of the grid and proves nothing about smaller scales.

/// The comparison of the boundaries of at least three basins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Merging {
    /// Number of basins that were compared: those with at least one per cent of the cells.
    pub motions: usize,
    /// The smallest number of cells by which each boundary has to be fattened to contain all others. A boundary is
    /// fattened in rows, columns and diagonals.
    pub radius: usize,
    /// The largest radius at which the boundaries count as one: one per cent of the shorter side of the plane, at least 1.
    pub limit: usize,
    /// The share of the cells at any boundary that lie within the limit of all boundaries.
    pub common: f64,
}

impl Merging {
    /// Whether all basins have one boundary at the resolution of the grid.
    #[must_use]
    pub const fn wada(&self) -> bool {
        self.radius <= self.limit
    }
}

/// A basin with a smaller share of the cells is not compared; its cells count as those of other motions.
const RAREST: f64 = 0.01;
/// The largest radius as a part of the shorter side of the plane, inverted.
const PARTS: usize = 100;

/// The comparison of the boundaries in a plane whose cells are numbers of motions, with `width` cells in each row; `None`
/// with fewer than three basins to compare.
pub(super) fn merging<T: Copy + PartialEq>(cells: &[T], width: usize) -> Option<Merging> {
    let height = cells.len() / width.max(1);
    let cells = &cells[..height * width];
    let colours = frequent(cells);
    if colours.len() < 3 {
        return None;
    }
    // the largest distance of each cell from a boundary, and whether it lies on one
    let (mut farthest, mut on_any) = (vec![0_u32; cells.len()], vec![false; cells.len()]);
    for colour in &colours {
        let slim = boundary(cells, width, *colour);
        for (k, distance) in distances(&slim, width).into_iter().enumerate() {
            farthest[k] = farthest[k].max(distance);
            on_any[k] |= slim[k];
        }
    }
    let at_boundary = || farthest.iter().zip(&on_any).filter(|(_, on)| **on).map(|(distance, _)| *distance as usize);
    let limit = (width.min(height) / PARTS).max(1);
    let (all, near) = (at_boundary().count(), at_boundary().filter(|distance| *distance <= limit).count());
    #[allow(clippy::cast_precision_loss)] // counts below 2^53
    let common = near as f64 / all.max(1) as f64;
    Some(Merging { motions: colours.len(), radius: at_boundary().max().unwrap_or(0), limit, common })
}

/// The motions with at least the smallest share of the cells, in the order of their first cells.
fn frequent<T: Copy + PartialEq>(cells: &[T]) -> Vec<T> {
    let mut counts: Vec<(T, u64)> = Vec::new();
    for cell in cells {
        match counts.iter_mut().find(|(motion, _)| motion == cell) {
            Some((_, count)) => *count += 1,
            None => counts.push((*cell, 1)),
        }
    }
    #[allow(clippy::cast_precision_loss)] // counts below 2^53
    let enough = |count: u64| count as f64 >= RAREST * cells.len() as f64;
    counts.into_iter().filter(|(_, count)| enough(*count)).map(|(motion, _)| motion).collect()
}

/// The cells at the boundary of one basin: those with a neighbour in the row or column on the other side of it.
fn boundary<T: Copy + PartialEq>(cells: &[T], width: usize, colour: T) -> Vec<bool> {
    let inside: Vec<bool> = cells.iter().map(|cell| *cell == colour).collect();
    let mut slim = vec![false; cells.len()];
    for k in 0..cells.len() {
        let right = ((k + 1) % width != 0).then_some(k + 1);
        let below = (k + width < cells.len()).then_some(k + width);
        for other in right.into_iter().chain(below).filter(|other| inside[*other] != inside[k]) {
            (slim[k], slim[other]) = (true, true);
        }
    }
    slim
}

/// The distance of each cell from the nearest cell of a set, in steps to any of the eight neighbours. Two passes over the
/// plane give this distance exactly (A. Rosenfeld, J. L. Pfaltz, J. ACM 13, 471 (1966)).
fn distances(set: &[bool], width: usize) -> Vec<u32> {
    let height = set.len() / width;
    let mut far: Vec<u32> = set.iter().map(|on| if *on { 0 } else { u32::MAX }).collect();
    let mut pass = |k: usize, before: [Option<usize>; 4]| {
        let nearest = before.into_iter().flatten().map(|other| far[other].saturating_add(1)).min();
        far[k] = far[k].min(nearest.unwrap_or(u32::MAX));
    };
    for k in 0..set.len() {
        let (left, right) = (k % width > 0, (k + 1) % width != 0);
        let up = k.checked_sub(width);
        pass(k, [left.then(|| k - 1), up, up.filter(|_| left).map(|up| up - 1), up.filter(|_| right).map(|up| up + 1)]);
    }
    for k in (0..set.len()).rev() {
        let (left, right) = (k % width > 0, (k + 1) % width != 0);
        let down = (k / width + 1 < height).then_some(k + width);
        let (one, two) = (down.filter(|_| left).map(|down| down - 1), down.filter(|_| right).map(|down| down + 1));
        pass(k, [right.then_some(k + 1), down, one, two]);
    }
    far
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three colours in turn along rows and columns: each cell lies at the boundaries of all three, except two corners,
    /// where both neighbours have one colour. There the boundary of the third colour is one step away.
    #[test]
    fn interleaved_colours_are_wada() {
        let cells: Vec<usize> = (0..12 * 12).map(|k| (k % 12 + k / 12) % 3).collect();
        let found = merging(&cells, 12).unwrap();
        assert_eq!((found.motions, found.radius, found.limit, found.common), (3, 1, 1, 1.0));
        assert!(found.wada());
        // stripes of one cell inside a half of a single colour: the boundary with the half is that of all three
        let half: Vec<usize> = (0..12 * 12).map(|k| if k % 12 < 6 { 0 } else { k / 12 % 3 }).collect();
        assert!(merging(&half, 12).unwrap().wada());
    }

    /// Three stripes of 4 cells: the boundary of the first colour has columns 3 and 4, that of the second 3, 4, 7 and 8,
    /// that of the third 7 and 8. Cells of one lie up to 8 - 4 = 7 - 3 = 4 columns from another.
    #[test]
    fn stripes_are_not() {
        let cells: Vec<usize> = (0..12 * 12).map(|k| k % 12 / 4).collect();
        let found = merging(&cells, 12).unwrap();
        assert_eq!((found.motions, found.radius, found.common), (3, 4, 0.0));
        assert!(!found.wada());
        // on a grid that is ten times finer the radius is ten times larger
        let fine: Vec<usize> = (0..120 * 120).map(|k| k % 120 / 40).collect();
        assert_eq!(merging(&fine, 120).unwrap().radius, 40);
    }

    #[test]
    fn fewer_than_three_basins_are_not_compared() {
        let two: Vec<usize> = (0..144).map(|k| k % 2).collect();
        assert_eq!(merging(&two, 12), None);
        // one cell of a third motion of a thousand is too rare
        let mut rare: Vec<usize> = (0..1000).map(|k| k % 2).collect();
        rare[500] = 7;
        assert_eq!(merging(&rare, 40), None);
        assert_eq!(merging::<u8>(&[], 0), None);
    }

    /// Against all pairs, for random sets.
    #[test]
    fn distances_are_those_to_the_nearest_cell() {
        let mut state = 3_u64;
        for width in [1, 7, 13] {
            let set: Vec<bool> = (0..width * 11)
                .map(|_| {
                    state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                    state >> 60 == 0
                })
                .collect();
            let found = distances(&set, width);
            for (k, distance) in found.iter().enumerate() {
                let steps = |other: usize| (k % width).abs_diff(other % width).max((k / width).abs_diff(other / width));
                let nearest = (0..set.len()).filter(|other| set[*other]).map(steps).min();
                assert_eq!(nearest.map_or(u32::MAX, |steps| u32::try_from(steps).unwrap()), *distance);
            }
        }
    }
}

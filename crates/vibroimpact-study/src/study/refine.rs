//! Refinement: a coarse grid is computed first, and finer points only where its points differ.
//!
//! A block is divided into boxes with sides of `step` points. If all corners of a box have the same result, its inner
//! points are given that result. Other boxes are halved in every direction, until there are no points between their
//! corners. So every computed point has exactly the result of the full grid. A feature is missed only if it touches no
//! corner of a box, that is, if it is finer than `step`.

use crate::Block;
use std::collections::HashSet;

/// The result of a point.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Cell<T> {
    /// The point was computed.
    Computed(T),
    /// The point is given the result of a corner of its box, which is the point with this number.
    Like(u32),
}

impl<T> Cell<T> {
    /// The result of the point, and whether it was computed itself. `cells` are those of its block.
    pub(super) fn result<'a>(&'a self, cells: &'a [Self]) -> Option<(&'a T, bool)> {
        match self {
            Self::Computed(result) => Some((result, true)),
            Self::Like(corner) => match &cells[*corner as usize] {
                Self::Computed(result) => Some((result, false)),
                // a corner is always computed
                Self::Like(_) => None,
            },
        }
    }
}

/// A box: the lowest and highest index of each dimension within the block.
type Cuboid = Vec<(usize, usize)>;

/// Fills a block. `compute` is called with numbers of points and returns their results, or `None` if stopped. `same`
/// returns whether two results agree.
pub(super) fn fill<T>(
    block: &Block,
    step: usize,
    mut compute: impl FnMut(&[usize]) -> Option<Vec<T>>,
    same: impl Fn(&T, &T) -> bool,
) -> Option<Vec<Cell<T>>> {
    let lengths: Vec<usize> = block.ranges.iter().map(ExactSizeIterator::len).collect();
    let number = |index: &[usize]| index.iter().zip(&lengths).fold(0, |sum, (i, n)| sum * n + i);
    let mut cells: Vec<Option<Cell<T>>> = (0..block.points()).map(|_| None).collect();
    let mut boxes = coarse(&lengths, step);
    while !boxes.is_empty() {
        let corners: Vec<Vec<usize>> = boxes.iter().map(|b| corners(b).map(|c| number(&c)).collect()).collect();
        let mut wanted: Vec<usize> = Vec::new();
        let mut asked = HashSet::new();
        for k in corners.iter().flatten() {
            if !matches!(cells[*k], Some(Cell::Computed(_))) && asked.insert(*k) {
                wanted.push(*k);
            }
        }
        wanted.sort_unstable();
        for (k, result) in wanted.iter().zip(compute(&wanted)?) {
            cells[*k] = Some(Cell::Computed(result));
        }
        let mut finer = Vec::new();
        for (cuboid, corners) in boxes.iter().zip(&corners) {
            let result = |k: usize| if let Some(Cell::Computed(result)) = &cells[k] { Some(result) } else { None };
            let first = result(corners[0])?;
            if corners.iter().all(|k| result(*k).is_some_and(|other| same(first, other))) {
                let like = u32::try_from(corners[0]).ok()?;
                each_row(cuboid, |first, length| {
                    let from = number(first);
                    for cell in &mut cells[from..from + length] {
                        cell.get_or_insert(Cell::Like(like));
                    }
                });
            } else {
                finer.extend(halves(cuboid));
            }
        }
        boxes = finer;
    }
    cells.into_iter().collect()
}

/// Boxes with sides of `step` points that cover the block; neighbours share a face.
fn coarse(lengths: &[usize], step: usize) -> Vec<Cuboid> {
    let sides = lengths.iter().map(|n| {
        let mut edges: Vec<usize> = (0..*n).step_by(step).collect();
        if edges.last() != Some(&(n - 1)) {
            edges.push(n - 1);
        }
        match edges.as_slice() {
            [only] => vec![(*only, *only)],
            edges => edges.windows(2).map(|pair| (pair[0], pair[1])).collect::<Vec<_>>(),
        }
    });
    product(&sides.collect::<Vec<_>>())
}

/// The parts of a box halved in every direction that has points between its corners; empty if no direction has.
fn halves(cuboid: &Cuboid) -> Vec<Cuboid> {
    if cuboid.iter().all(|(low, high)| high - low < 2) {
        return Vec::new();
    }
    let halved = |(low, high): &(usize, usize)| {
        let middle = usize::midpoint(*low, *high);
        if high - low < 2 { vec![(*low, *high)] } else { vec![(*low, middle), (middle, *high)] }
    };
    product(&cuboid.iter().map(halved).collect::<Vec<_>>())
}

fn corners(cuboid: &Cuboid) -> impl Iterator<Item = Vec<usize>> {
    let ends = |(low, high): &(usize, usize)| if low == high { vec![*low] } else { vec![*low, *high] };
    product(&cuboid.iter().map(ends).collect::<Vec<_>>()).into_iter()
}

/// Calls `each` with the first index and the length of every row of a box, that is, of its points along the last dimension.
fn each_row(cuboid: &Cuboid, mut each: impl FnMut(&[usize], usize)) {
    let Some(((low, high), others)) = cuboid.split_last() else { return };
    let mut index: Vec<usize> = cuboid.iter().map(|(low, _)| *low).collect();
    loop {
        each(&index, high - low + 1);
        // the next row, as an odometer counts
        let Some(turns) = (0..others.len()).rfind(|k| index[*k] < others[*k].1) else { return };
        index[turns] += 1;
        for k in turns + 1..others.len() {
            index[k] = others[k].0;
        }
    }
}

/// The Cartesian product; the last factor varies fastest.
fn product<T: Clone>(factors: &[Vec<T>]) -> Vec<Vec<T>> {
    factors.iter().fold(vec![Vec::new()], |done, factor| {
        let with = |head: &Vec<T>| {
            let head = head.clone();
            factor.iter().map(move |item| head.iter().cloned().chain([item.clone()]).collect())
        };
        done.iter().flat_map(with).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn disc(block: &Block, k: usize) -> bool {
        let index = block.index(k);
        let far = |i: usize, centre: f64| (i as f64 - centre).powi(2);
        far(index[0], 31.0) + far(index[1], 17.0) < 120.0
    }

    #[test]
    fn computed_points_are_those_of_the_full_grid_and_edges_are_all_computed() {
        let block = Block { ranges: vec![0..61, 0..45] };
        let mut count = 0;
        let compute = |points: &[usize]| {
            count += points.len();
            Some(points.iter().map(|k| disc(&block, *k)).collect())
        };
        let cells = fill(&block, 8, compute, |a, b| a == b).unwrap();
        assert_eq!(count, cells.iter().filter(|c| matches!(c, Cell::Computed(_))).count());
        assert!(count < 61 * 45 / 3, "{count}");
        for (k, cell) in cells.iter().enumerate() {
            let value = match cell {
                Cell::Computed(value) => *value,
                Cell::Like(corner) => disc(&block, *corner as usize),
            };
            // a disc of radius 11 has no feature finer than 8 points
            assert_eq!(value, disc(&block, k), "{k}");
        }
    }

    #[test]
    fn odd_shapes_and_stopping() {
        let along = |(a, b): (usize, usize)| a..b;
        for ranges in [&[(0, 1), (0, 9)][..], &[(3, 4), (7, 8)], &[(0, 2), (0, 2), (0, 5)], &[(4, 9)]] {
            let block = Block { ranges: ranges.iter().copied().map(along).collect() };
            let cells = fill(&block, 4, |points| Some(points.to_vec()), |a, b| a == b).unwrap();
            // no results agree, so every point is computed
            let want: Vec<_> = (0..block.points()).map(Cell::Computed).collect();
            assert_eq!(cells, want);
            assert!(fill(&block, 4, |_| None::<Vec<u8>>, |a, b| a == b).is_none());
        }
    }
}

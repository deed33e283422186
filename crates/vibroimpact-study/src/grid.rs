//! A grid of points, divided into tiles of equal shape. Tiles at the upper ends of the dimensions may be smaller.

use crate::field::Column;
use core::ops::{Deref, Range};

/// Maximum number of dimensions of a grid, which is the maximum number of axes of a plan.
const MOST: usize = 4;

/// One dimension of a grid.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Dimension {
    /// Its name.
    pub name: String,
    /// Number of points along it.
    pub count: usize,
    /// Number of points of a tile along it.
    pub tile: usize,
}

/// A grid of points in row-major order: the last dimension varies fastest.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Grid {
    /// The dimensions, the slowest first.
    pub dimensions: Vec<Dimension>,
}

/// A tile: a range of indices in each dimension.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// The ranges, the slowest dimension first.
    pub ranges: Vec<Range<usize>>,
}

/// The indices of a point in its grid, the slowest dimension first. It dereferences to a slice and is stored without
/// heap allocation, because basins create millions of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Index {
    of: [usize; MOST],
    dimensions: usize,
}

impl Deref for Index {
    type Target = [usize];

    fn deref(&self) -> &[usize] {
        &self.of[..self.dimensions]
    }
}

/// The product of some counts; `u64::MAX` if it is larger.
fn product(counts: impl IntoIterator<Item = usize>) -> u64 {
    counts.into_iter().fold(1, |product, count| u64::saturating_mul(product, count as u64))
}

/// The position of number `k` in row-major order, among `along` of each dimension.
#[must_use]
#[allow(clippy::cast_possible_truncation)] // less than the count along a dimension, a usize
pub fn place(along: &[usize], k: u64) -> Vec<usize> {
    let mut rest = k;
    let mut place: Vec<usize> = along
        .iter()
        .rev()
        .map(|n| {
            let here = rest % *n as u64;
            rest /= *n as u64;
            here as usize
        })
        .collect();
    place.reverse();
    place
}

/// The number of a position in row-major order, the inverse of [`place`].
pub fn number(along: &[usize], place: impl IntoIterator<Item = usize>) -> u64 {
    along.iter().zip(place).fold(0, |number, (count, at)| number * *count as u64 + at as u64)
}

impl Grid {
    /// Total number of points.
    #[must_use]
    pub fn points(&self) -> u64 {
        product(self.dimensions.iter().map(|d| d.count))
    }

    /// Number of tiles along each dimension.
    #[must_use]
    pub fn tiles_along(&self) -> Vec<usize> {
        self.dimensions.iter().map(|d| d.count.div_ceil(d.tile)).collect()
    }

    /// Total number of tiles.
    #[must_use]
    pub fn tiles(&self) -> u64 {
        product(self.tiles_along())
    }

    /// The position of tile number `k` among the tiles, for each dimension. Tiles are numbered in row-major order.
    #[must_use]
    pub fn place(&self, k: u64) -> Vec<usize> {
        place(&self.tiles_along(), k)
    }

    /// Tile number `k`.
    #[must_use]
    pub fn tile(&self, k: u64) -> Block {
        let range = |(d, i): (&Dimension, usize)| i * d.tile..((i + 1) * d.tile).min(d.count);
        Block { ranges: self.dimensions.iter().zip(self.place(k)).map(range).collect() }
    }

    /// Tile number `k` in the shape of a full tile; it may extend beyond the grid.
    #[must_use]
    pub fn full_tile(&self, k: u64) -> Block {
        let range = |(d, i): (&Dimension, usize)| i * d.tile..(i + 1) * d.tile;
        Block { ranges: self.dimensions.iter().zip(self.place(k)).map(range).collect() }
    }

    /// The whole grid as one tile.
    #[must_use]
    pub fn whole(&self) -> Block {
        Block { ranges: self.dimensions.iter().map(|d| 0..d.count).collect() }
    }
}

impl Block {
    /// Number of points in the block.
    #[must_use]
    pub fn points(&self) -> usize {
        self.ranges.iter().map(ExactSizeIterator::len).product()
    }

    /// The indices in the grid of point number `k` of the block. The grid has at most four dimensions.
    #[must_use]
    pub fn index(&self, k: usize) -> Index {
        let (mut rest, dimensions) = (k, self.ranges.len());
        let mut of = [0; MOST];
        for (here, range) in of[..dimensions].iter_mut().zip(&self.ranges).rev() {
            *here = range.start + rest % range.len();
            rest /= range.len();
        }
        Index { of, dimensions }
    }

    /// The number in the block of the point with these indices in the grid.
    #[must_use]
    pub fn number(&self, index: &[usize]) -> usize {
        index.iter().zip(&self.ranges).fold(0, |sum, (i, range)| sum * range.len() + (i - range.start))
    }

    /// Copies the column of this block into the column of a larger block, with `width` values for each point.
    pub fn put(&self, part: &Column, within: &Self, width: usize, whole: &mut Column) {
        self.rows(within, width, |at, from, len| whole.copy(at, part, from, len));
    }

    /// Calls `row` for each row of this block as a part of a larger block that contains it, with `width` values for
    /// each point. The arguments are the index where the row begins in the larger block, the index where it begins in
    /// this block, and its length.
    pub fn rows(&self, within: &Self, width: usize, mut row: impl FnMut(usize, usize, usize)) {
        let Some(len) = self.ranges.last().map(ExactSizeIterator::len).filter(|len| *len > 0) else { return };
        for r in 0..self.points() / len {
            let index = self.index(r * len);
            row(within.number(&index) * width, r * len * width, len * width);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid() -> Grid {
        let dimension = |name: &str, count, tile| Dimension { name: name.into(), count, tile };
        Grid { dimensions: vec![dimension("gap", 5, 2), dimension("x", 7, 3)] }
    }

    #[test]
    fn tiles_cover_the_grid_once() {
        let grid = grid();
        assert_eq!((grid.points(), grid.tiles(), grid.tiles_along()), (35, 9, vec![3, 3]));
        let mut seen = [0; 35];
        for k in 0..grid.tiles() {
            let block = grid.tile(k);
            for p in 0..block.points() {
                let index = block.index(p);
                seen[index[0] * 7 + index[1]] += 1;
            }
        }
        assert_eq!(seen, [1; 35]);
        assert_eq!(grid.tile(8).ranges, [4..5, 6..7]);
        assert_eq!(grid.place(5), [1, 2]);
        assert_eq!(grid.whole().points(), 35);
        let mut rows = Vec::new();
        grid.tile(5).rows(&grid.whole(), 2, |at, from, len| rows.push((at, from, len)));
        assert_eq!(rows, [(40, 0, 2), (54, 2, 2)]);
        rows.clear();
        grid.tile(5).rows(&grid.full_tile(5), 1, |at, from, len| rows.push((at, from, len)));
        assert_eq!(rows, [(0, 0, 1), (3, 1, 1)]);
    }
}

//! What a kind of study fills: its grid, what runs along it, its tiles and the tables they conclude in.

use super::cycles;
use crate::grid::Dimension;
use crate::{Axis, Block, Column, Field, Grid};

/// Positions along a dimension of the grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Along {
    /// What it is called: as its dimension, or, beside that one, otherwise.
    pub name: String,
    /// The dimension.
    pub dimension: String,
    /// A value for each index.
    pub values: Vec<f64>,
    /// A sentence that says what it is.
    pub long_name: &'static str,
    /// Its unit.
    pub units: &'static str,
}

/// A task over a grid: what a tile of it computes, and how that is stored.
pub(crate) trait Fill: Send + Sync {
    /// The results of a tile.
    type Tile: Send;

    /// The grid and its tiles.
    fn grid(&self) -> &Grid;

    /// The values along its dimensions, where they have any.
    fn coordinates(&self) -> Vec<Along>;

    /// The arrays.
    fn fields(&self) -> Vec<Field>;

    /// Computes a tile; `None` if stopped. `tick` is called for each point and returns whether to stop.
    fn compute(&self, block: &Block, tick: &(dyn Fn() -> bool + Sync)) -> Option<Self::Tile>;

    /// The columns of a tile, one for each field.
    fn columns(&self, block: &Block, tile: Self::Tile) -> Vec<Column>;

    /// The field that numbers cycles, and the cycles known beforehand, where there is such a field.
    fn numbered(&self) -> Option<cycles::Numbering<'_>> {
        None
    }
}

/// A [`Fill`] whose results are known as columns only, so that a study can hold any of them.
pub(super) trait Columns: Send + Sync {
    fn grid(&self) -> &Grid;
    fn coordinates(&self) -> Vec<Along>;
    fn fields(&self) -> Vec<Field>;
    fn fill(&self, block: &Block, tick: &(dyn Fn() -> bool + Sync)) -> Option<Vec<Column>>;
    fn numbered(&self) -> Option<cycles::Numbering<'_>>;
}

impl<F: Fill> Columns for F {
    fn grid(&self) -> &Grid {
        Fill::grid(self)
    }

    fn coordinates(&self) -> Vec<Along> {
        Fill::coordinates(self)
    }

    fn fields(&self) -> Vec<Field> {
        Fill::fields(self)
    }

    fn fill(&self, block: &Block, tick: &(dyn Fn() -> bool + Sync)) -> Option<Vec<Column>> {
        Some(self.columns(block, self.compute(block, tick)?))
    }

    fn numbered(&self) -> Option<cycles::Numbering<'_>> {
        Fill::numbered(self)
    }
}

/// Tiles along an axis there are at least, so that all processors have something to do and little is lost in a break.
const FEWEST: usize = 16;

/// The grid of some axes, the first running fastest. Tiles have the given side; by default `side` or, on short axes,
/// less, but no less than a quarter of it.
pub(super) fn grid_of(axes: &[Axis], asked: Option<u32>, side: usize) -> Grid {
    let dimension = |axis: &Axis| {
        let count = axis.over.count();
        let fair = || (count / FEWEST).next_power_of_two().clamp(side.div_ceil(4), side);
        let tile = asked.map_or_else(fair, |tile| tile as usize).min(count);
        Dimension { name: axis.vary.name().to_owned(), count, tile }
    };
    Grid { dimensions: axes.iter().rev().map(dimension).collect() }
}

/// The values along the axes.
pub(super) fn along(axes: &[Axis]) -> Vec<Along> {
    let one = |axis: &Axis| Along {
        name: axis.vary.name().to_owned(),
        dimension: axis.vary.name().to_owned(),
        values: axis.over.all(),
        long_name: axis.vary.long_name(),
        units: axis.vary.units(),
    };
    axes.iter().rev().map(one).collect()
}

/// The place on axis number `k` of a point with these indices in the grid.
pub(crate) fn on_axis(index: &[usize], k: usize) -> usize {
    index[index.len() - 1 - k]
}

//! The interface of a task over a grid: its grid, its coordinates, its tiles and its final tables.

use super::cycles;
use crate::grid::Dimension;
use crate::{Axis, Block, Column, Field, Grid, Unit};

/// The coordinate values along a dimension of the grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Along {
    /// Name of the coordinate: that of the dimension, or another name for a second coordinate of the same dimension.
    pub name: String,
    /// Name of the dimension.
    pub dimension: String,
    /// The value at each index.
    pub values: Vec<f64>,
    /// One line of text that describes the coordinate.
    pub long_name: &'static str,
    /// Its unit.
    pub unit: Unit,
}

/// A task over a grid: how a tile is computed and stored.
pub(crate) trait Fill: Send + Sync {
    /// The results of one tile.
    type Tile: Send;

    /// The grid and its tiles.
    fn grid(&self) -> &Grid;

    /// The coordinate values of the dimensions that have any.
    fn coordinates(&self) -> Vec<Along>;

    /// The fields (arrays) of the task.
    fn fields(&self) -> Vec<Field>;

    /// Computes a tile; `None` if stopped. `tick` is called for each point and returns whether to stop.
    fn compute(&self, block: &Block, tick: &(dyn Fn() -> bool + Sync)) -> Option<Self::Tile>;

    /// The columns of a tile, one for each field.
    fn columns(&self, block: &Block, tile: Self::Tile) -> Vec<Column>;

    /// The field with the numbers of cycles and the cycles of the survey, if the task has such a field.
    fn numbered(&self) -> Option<cycles::Numbering<'_>> {
        None
    }
}

/// A [`Fill`] whose tiles are available only as columns, so that a study can contain any task.
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

/// Minimum number of tiles along an axis, so that all processors have work and little is lost when a run is
/// interrupted.
const FEWEST: usize = 16;

/// The grid over some axes; the first axis varies fastest. Tiles have the side `asked`, or by default `side`. On short
/// axes the default is smaller, but at least a quarter of `side`.
pub(super) fn grid_of(axes: &[Axis], asked: Option<u32>, side: usize) -> Grid {
    let dimension = |axis: &Axis| {
        let count = axis.over.count();
        let fair = || (count / FEWEST).next_power_of_two().clamp(side.div_ceil(4), side);
        let tile = asked.map_or_else(fair, |tile| tile as usize).min(count);
        Dimension { name: axis.vary.name().to_owned(), count, tile }
    };
    Grid { dimensions: axes.iter().rev().map(dimension).collect() }
}

/// The coordinate values of the axes.
pub(super) fn along(axes: &[Axis]) -> Vec<Along> {
    let one = |axis: &Axis| Along {
        name: axis.vary.name().to_owned(),
        dimension: axis.vary.name().to_owned(),
        values: axis.over.all(),
        long_name: axis.vary.long_name(),
        unit: axis.vary.unit(),
    };
    axes.iter().rev().map(one).collect()
}

/// The place on axis number `k` of the point with these indices in the grid.
pub(crate) fn on_axis(index: &[usize], k: usize) -> usize {
    index[index.len() - 1 - k]
}

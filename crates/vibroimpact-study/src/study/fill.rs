//! The interface of a task over a grid: its grid, its coordinates, its tiles and its final tables.

use super::cycles;
use crate::axis::Described;
use crate::grid::{Dimension, Index};
use crate::points::DIMENSION;
use crate::{Axis, Block, Column, Extra, Field, Grid, PointsPlan, Unit};
use std::borrow::Cow;

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
    pub long_name: Cow<'static, str>,
    /// Its unit.
    pub unit: Unit,
}

/// A grid, and the coordinate values of the dimensions that have any.
pub(crate) struct Over {
    pub(crate) grid: Grid,
    pub(crate) coordinates: Vec<Along>,
}

impl Over {
    /// The grid over some axes; the first axis varies fastest. Tiles have the side `asked`, or by default sides from the least to the
    /// most: where points of a machine take a hundred times as long, they are as small as one point where an axis is short.
    pub(super) fn axes<V: Described>(axes: &[Axis<V>], asked: Option<u32>, sides: (usize, usize)) -> Self {
        let dimension = |axis: &Axis<V>| dimension(axis.vary.text(), axis.over.count(), asked, sides);
        let along = |axis: &Axis<V>| Along::new(&axis.vary, axis.over.all(), axis.vary.text());
        Self {
            grid: Grid { dimensions: axes.iter().rev().map(dimension).collect() },
            coordinates: axes.iter().rev().map(along).collect(),
        }
    }

    /// The same with tiles of this side; on short axes the default is smaller, but at least a quarter of it.
    pub(super) fn usual<V: Described>(axes: &[Axis<V>], asked: Option<u32>, side: usize) -> Self {
        Self::axes(axes, asked, (side.div_ceil(4), side))
    }
}

/// A task over a grid: how a tile is computed and stored.
pub(crate) trait Fill: Send + Sync {
    /// The grid with its usual tiles, and its coordinates.
    fn over(&self) -> &Over;

    /// The fields (arrays) of the task.
    fn fields(&self) -> Vec<Field>;

    /// The columns of a tile, one for each field; `None` if stopped. `tick` is called for each point and returns whether to stop.
    fn fill(&self, block: &Block, tick: &(dyn Fn() -> bool + Sync)) -> Option<Vec<Column>>;

    /// The columns of some points of the grid, one for each field, as a tile has them; `None` if stopped, or if only whole
    /// tiles are computed.
    fn points(&self, points: &[Index], tick: &(dyn Fn() -> bool + Sync)) -> Option<Vec<Column>> {
        let _ = (points, tick);
        None
    }

    /// The field with the numbers of cycles and the cycles of the survey, if the task has such a field.
    fn numbered(&self) -> Option<cycles::Numbered<'_>> {
        None
    }

    /// Number of points of a block that is computed at the cost of the same points in a whole tile; `u64::MAX` if only a
    /// whole tile is.
    fn together(&self) -> u64 {
        1
    }

    /// Whether a tile can be continued after a part of it.
    fn continues(&self) -> bool {
        false
    }

    /// The columns of a tile, continued from what was computed of it before; `None` if stopped.
    fn continued(
        &self,
        block: &Block,
        before: Option<BegunTile>,
        keep: Keep<'_>,
        tick: &(dyn Fn() -> bool + Sync),
    ) -> Option<Vec<Column>> {
        let _ = (before, keep);
        self.fill(block, tick)
    }
}

/// A part of a tile whose points are computed one after another, each from the last state at the point before.
#[derive(Clone, Debug, PartialEq)]
pub struct BegunTile {
    /// Number of points that are computed.
    pub done: u64,
    /// The numbers of the last state; none if the next point begins anew.
    pub left: Vec<f64>,
    /// The columns of the tile, empty where nothing is computed yet.
    pub columns: Vec<Column>,
}

/// Called when a part of a tile is computed. Its first argument says whether the computation is about to be stopped, the
/// second returns the part.
pub type Keep<'a> = &'a dyn Fn(bool, &dyn Fn() -> BegunTile);

/// The points of a block that is computed at the cost of a whole tile: with refinement the whole tile.
pub(super) const fn with_refinement(refine: Option<u32>, points: u64) -> u64 {
    if refine.is_some() { u64::MAX } else { points }
}

/// Minimum number of tiles along an axis, so that all processors have work and little is lost when a run is
/// interrupted.
const FEWEST: usize = 16;

/// A dimension with tiles of the length `asked`, or by default of a length from `least` to `most`, the largest that gives
/// enough tiles.
pub(super) fn dimension(name: &str, count: usize, asked: Option<u32>, (least, most): (usize, usize)) -> Dimension {
    let fair = || (count / FEWEST).next_power_of_two().clamp(least, most);
    let tile = asked.map_or_else(fair, |tile| tile as usize).min(count);
    Dimension { name: name.to_owned(), count, tile }
}

/// The values of what varies at points, which are several coordinates of one dimension.
pub(super) fn along_points<V: Described>(points: &PointsPlan<V>) -> impl Iterator<Item = Along>
where
    Cow<'static, str>: From<V>,
{
    let count = usize::try_from(points.count()).unwrap_or(usize::MAX);
    let values = move |column| (0..count).map(|k| points.at(column, k)).collect();
    points.varied().enumerate().map(move |(column, vary)| Along::new(&vary, values(column), DIMENSION))
}

impl Along {
    /// The values of what varies along a dimension.
    pub(super) fn new<V: Described>(vary: &V, values: Vec<f64>, dimension: &str) -> Self {
        let (name, dimension) = (vary.text().to_owned(), dimension.to_owned());
        Self { name, dimension, values, long_name: vary.described(), unit: vary.in_unit() }
    }
}

/// The fields of quantities of a machine, which have the paths as names.
pub(super) fn machine_fields(paths: &[String], extra: &[Extra]) -> Vec<Field> {
    let field = |path: &String| Field::real(path.clone(), format!("{path} of the motion"), Unit::CONSISTENT, extra);
    paths.iter().map(field).collect()
}

/// Numbers of `count` points spread evenly over `total`; all of them if there are fewer.
pub(super) fn spread(total: u64, count: u64) -> impl Iterator<Item = u64> {
    let count = count.min(total);
    (0..count).map(move |k| total / count * k)
}

/// The place on axis number `k` of the point with these indices in the grid.
pub(crate) fn on_axis(index: &[usize], k: usize) -> usize {
    index[index.len() - 1 - k]
}

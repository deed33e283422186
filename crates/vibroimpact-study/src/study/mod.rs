//! A plan that fills a grid, tile by tile: what is stored, and what one tile of it holds.
//!
//! A tile depends on the plan and its own place only, so that tiles may be computed in any order, twice, and on any
//! machine. What only the whole can say, such as how many starts led to each motion, is worked out [at the
//! end](Study::conclude) from all tiles.

mod basin;
mod code;
mod cycles;
mod diagram;
mod lyapunov;
mod map;
mod memory;
mod refine;
#[cfg(test)]
mod tests;

pub use code::{CHAOTIC, NO_IMPACT, NO_MOTION, NOT_COMPUTED, STUCK, UNDECIDED, code, label_of};
pub use diagram::diagram_of;
pub use memory::{Sheet, in_memory};

use crate::grid::Dimension;
use crate::{Axis, Block, Column, Field, Grid, Plan, PlanError, Task};

/// Positions along a dimension of the grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Along {
    /// What it is called: as its dimension, or, beside that one, otherwise.
    pub name: String,
    /// The dimension.
    pub dimension: String,
    /// A value for each index.
    pub values: Vec<f64>,
    /// What it is, for people.
    pub long_name: &'static str,
    /// Its unit.
    pub units: &'static str,
}

/// A small array about the whole, over dimensions of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Its name.
    pub name: &'static str,
    /// What it is, for people.
    pub long_name: &'static str,
    /// Its unit.
    pub units: &'static str,
    /// Its dimensions and their lengths, the slowest first.
    pub dimensions: Vec<(&'static str, usize)>,
    /// Its values, in row-major order.
    pub values: Cells,
}

/// The values of a [`Table`].
#[derive(Clone, Debug, PartialEq)]
pub enum Cells {
    /// Numbers.
    Numbers(Column),
    /// Words.
    Text(Vec<String>),
}

/// The finished tiles of a study, wherever they are kept.
pub trait Tiles {
    /// Why they cannot be read or written.
    type Error;

    /// Field number `field` of tile number `tile`.
    ///
    /// # Errors
    /// When it cannot be read.
    fn read(&mut self, tile: u64, field: usize) -> Result<Column, Self::Error>;

    /// Replaces field number `field` of tile number `tile`.
    ///
    /// # Errors
    /// When it cannot be written.
    fn write(&mut self, tile: u64, field: usize, column: &Column) -> Result<(), Self::Error>;
}

/// What each tile holds.
pub trait Fill: Send + Sync {
    /// The grid and its tiles.
    fn grid(&self) -> &Grid;

    /// The values along its dimensions, where they have any.
    fn coordinates(&self) -> Vec<Along>;

    /// The arrays.
    fn fields(&self) -> Vec<Field>;

    /// The columns of a tile, one for each field. `tick` is called for each point and says whether to stop.
    fn fill(&self, block: &Block, tick: &(dyn Fn() -> bool + Sync)) -> Option<Vec<Column>>;

    /// The field that numbers cycles, and the cycles known beforehand, where there is such a field.
    fn numbered(&self) -> Option<cycles::Numbering<'_>> {
        None
    }
}

/// A plan that fills a grid.
pub struct Study {
    fill: Box<dyn Fill>,
}

impl Study {
    /// The study of a plan.
    ///
    /// # Errors
    /// [`PlanError`] for a plan that makes no sense, or one that fills no grid.
    pub fn new(plan: &Plan) -> Result<Self, PlanError> {
        plan.check()?;
        let tile = plan.tile;
        let fill: Box<dyn Fill> = match &plan.task {
            Task::Map(map) => Box::new(map::MapFill::new(&plan.system, map, tile)),
            Task::Basin(basin) => Box::new(basin::BasinFill::plane(&plan.system, basin, tile)?),
            Task::Attractors { starts, seed } => {
                Box::new(basin::BasinFill::scattered(&plan.system, (*starts, *seed), tile)?)
            }
            Task::Lyapunov(lyapunov) => Box::new(lyapunov::LyapunovFill::new(&plan.system, lyapunov, tile)),
            Task::Diagram(diagram) => Box::new(diagram::DiagramFill::new(&plan.system, diagram, tile)),
            Task::Simulate { .. } => return Err(PlanError::NoStudy("simulate")),
            Task::Settle { .. } => return Err(PlanError::NoStudy("settle")),
            Task::Orbit { .. } => return Err(PlanError::NoStudy("find orbits")),
            Task::Branch(_) => return Err(PlanError::NoStudy("follow a branch")),
            Task::Curve(_) => return Err(PlanError::NoStudy("follow a curve")),
            Task::Region(_) => return Err(PlanError::NoStudy("find a region")),
        };
        Ok(Self { fill })
    }

    /// The grid and its tiles.
    #[must_use]
    pub fn grid(&self) -> &Grid {
        self.fill.grid()
    }

    /// The values along its dimensions, where they have any.
    #[must_use]
    pub fn coordinates(&self) -> Vec<Along> {
        self.fill.coordinates()
    }

    /// The arrays.
    #[must_use]
    pub fn fields(&self) -> Vec<Field> {
        self.fill.fields()
    }

    /// The columns of tile number `k`, one for each field; `None` if stopped. `tick` is called for each point and says
    /// whether to stop.
    #[must_use]
    pub fn tile(&self, k: u64, tick: &(dyn Fn() -> bool + Sync)) -> Option<Vec<Column>> {
        self.fill.fill(&self.grid().tile(k), tick)
    }

    /// What only the whole can say, once all tiles are there. Writes tiles anew where cycles were met that nobody knew
    /// of when they were computed; doing it twice changes nothing.
    ///
    /// # Errors
    /// When tiles cannot be read or written.
    pub fn conclude<T: Tiles>(&self, tiles: &mut T) -> Result<Vec<Table>, T::Error> {
        match self.fill.numbered() {
            Some(numbering) => numbering.conclude(self.grid(), tiles),
            None => Ok(Vec::new()),
        }
    }
}

/// Tiles along an axis there are at least, so that all processors have something to do and little is lost in a break.
const FEWEST: usize = 16;

/// The grid of some axes, the first running fastest. Tiles have the side asked for; where nobody asks, `side` or, on short axes,
/// less, but no less than a quarter of it.
fn grid_of(axes: &[Axis], asked: Option<u32>, side: usize) -> Grid {
    let dimension = |axis: &Axis| {
        let count = axis.over.count();
        let fair = || (count / FEWEST).next_power_of_two().clamp(side.div_ceil(4), side);
        let tile = asked.map_or_else(fair, |tile| tile as usize).min(count);
        Dimension { name: axis.vary.name().to_owned(), count, tile }
    };
    Grid { dimensions: axes.iter().rev().map(dimension).collect() }
}

/// The values along the axes.
fn along(axes: &[Axis]) -> Vec<Along> {
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
fn on_axis(index: &[usize], k: usize) -> usize {
    index[index.len() - 1 - k]
}

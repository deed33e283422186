//! A plan that fills a grid tile by tile: the arrays that are stored, and how a tile is computed. A tile depends only
//! on the plan and its own place, so tiles may be computed in any order, more than once, and on any machine. Results
//! that need the whole grid, such as the number of starts that lead to each motion, are computed [at the
//! end](Study::conclude) from all tiles.

mod basin;
mod code;
mod cycles;
mod fill;
mod lyapunov;
mod machine_lyapunov;
mod machine_map;
mod machine_points;
mod map;
mod memory;
mod reason;
mod refine;
mod remarks;
mod some_points;
mod starts;
mod stored_motion;
mod sweeps;
mod tables;
#[cfg(test)]
mod tests;

pub(crate) use basin::{BasinFill, BasinTile, Basins, MachineBasin};
pub use code::{CHAOTIC, NO_IMPACT, NO_MOTION, NOT_COMPUTED, REFUSED, STUCK, UNDECIDED, code, label_of, meaning_of};
pub(crate) use fill::Fill;
pub use fill::{Along, BegunTile, Keep};
pub(crate) use map::{MapFill, Mapped};
pub(crate) use memory::tiles_of;
pub use memory::{Sheet, check_memory, in_memory};
pub(crate) use refine::Cell;
pub use remarks::{closed_of, has_closed};
pub use some_points::{PointColumns, points_until};
pub(crate) use sweeps::{SweepFill, Swept, diagram_of};
pub use tables::{Cells, EachCount, StudyArrays, StudyTable, Tiles};

use crate::diagram::Show;
use crate::machine::MachineSource;
use crate::map::options;
use crate::{Block, Column, DiagramPlan, Field, Grid, Plan, PlanError, System, SystemPlan, Task};
use lyapunov::LyapunovFill;

/// A plan that fills a grid.
pub struct Study {
    fill: Box<dyn Fill>,
    /// The grid and its tiles.
    grid: Grid,
    /// The numbers of the fields that are stored, among those that are computed.
    kept: Vec<usize>,
}

impl Study {
    /// The study of a plan.
    ///
    /// # Errors
    /// [`PlanError`] for an invalid plan, or for a task without a grid.
    pub fn new(plan: &Plan) -> Result<Self, PlanError> {
        plan.check()?;
        Ok(Self::of(match &plan.system {
            System::Oscillator(system) => Self::of_oscillator(system, plan)?,
            System::Machine(machine) => Self::of_machine(machine, &plan.task, plan.tile)?,
        }))
    }

    /// The study of a fill, with all its fields.
    fn of(fill: Box<dyn Fill>) -> Self {
        let (grid, kept) = (fill.over().grid.clone(), (0..fill.fields().len()).collect());
        Self { fill, grid, kept }
    }

    /// The same study with tiles of these lengths along the dimensions of its grid, and only the fields that `has` names: as a
    /// store has it that a version with other defaults began.
    #[must_use]
    pub fn with_tiles(mut self, lengths: &[usize], has: impl Fn(&str) -> bool) -> Self {
        for (dimension, tile) in self.grid.dimensions.iter_mut().zip(lengths) {
            dimension.tile = (*tile).clamp(1, dimension.count);
        }
        self.kept.retain({
            let fields = self.fill.fields();
            move |k| has(&fields[*k].name)
        });
        self
    }

    /// Those columns of a tile that are stored.
    fn stored(&self, columns: Vec<Column>) -> Vec<Column> {
        if self.kept.len() == columns.len() {
            return columns;
        }
        columns.into_iter().enumerate().filter(|(k, _)| self.kept.contains(k)).map(|(_, column)| column).collect()
    }

    fn of_machine(source: &MachineSource, task: &Task, tile: Option<u32>) -> Result<Box<dyn Fill>, PlanError> {
        Ok(match task {
            Task::Basin(basin) => {
                let (machine, start) = source.problem()?;
                Box::new(BasinFill::of_machine((&machine, &start), &basin.typed()?, tile)?)
            }
            Task::Map(map) => Box::new(MapFill::of_machine(source, &map.typed()?, tile)),
            Task::SettleMany(many) => {
                let (machine, start) = source.described()?;
                Box::new(MapFill::of_points(source, (&machine, &start), &many.typed()?, tile)?)
            }
            Task::Diagram(diagram) => Box::new(SweepFill::new(source, &diagram.typed()?, tile)),
            Task::Lyapunov(lyapunov) if !lyapunov.axes.is_empty() => {
                Box::new(LyapunovFill::of_machine(source, &lyapunov.typed()?, tile)?)
            }
            other => return Err(PlanError::NoMachineStudy(other.verb())),
        })
    }

    fn of_oscillator(system: &SystemPlan, plan: &Plan) -> Result<Box<dyn Fill>, PlanError> {
        let tile = plan.tile;
        Ok(match &plan.task {
            Task::Map(map) => Box::new(MapFill::new(system, &map.typed()?, tile)),
            Task::Basin(basin) => Box::new(BasinFill::plane(system, &basin.typed()?, tile)?),
            Task::Attractors { starts, seed, impacts } => {
                Box::new(BasinFill::scattered(system, (*starts, *seed), &options(*impacts), tile)?)
            }
            Task::Lyapunov(lyapunov) => Box::new(LyapunovFill::new(system, &lyapunov.typed()?, tile)),
            Task::Diagram(diagram) => {
                let diagram: DiagramPlan = diagram.typed()?;
                if let Show::Quantity(_) = diagram.show {
                    return Err(PlanError::NoStoredQuantity);
                }
                Box::new(SweepFill::new(system, &diagram, tile))
            }
            other => return Err(PlanError::NoStudy(other.verb())),
        })
    }

    /// The grid and its tiles.
    #[must_use]
    pub const fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The coordinate values of the dimensions that have any.
    #[must_use]
    pub fn coordinates(&self) -> Vec<Along> {
        self.fill.over().coordinates.clone()
    }

    /// The fields (arrays) of the study.
    #[must_use]
    pub fn fields(&self) -> Vec<Field> {
        let fields = self.fill.fields();
        self.kept.iter().map(|k| fields[*k].clone()).collect()
    }

    /// The columns of tile number `k`, one for each field; `None` if stopped. `tick` is called for each point and
    /// returns whether to stop.
    #[must_use]
    pub fn tile(&self, k: u64, tick: &(dyn Fn() -> bool + Sync)) -> Option<Vec<Column>> {
        self.block(&self.grid().tile(k), tick)
    }

    /// The columns of some points of a map, one for each field, in the order of `points`, which are numbers in row-major
    /// order. They are those of the tiles without refinement: the results of a point do not depend on the points beside
    /// it. `None` if stopped, and for studies of which only whole tiles are computed. `tick` is called for each point and
    /// returns whether to stop.
    pub(crate) fn points(&self, points: &[usize], tick: &(dyn Fn() -> bool + Sync)) -> Option<Vec<Column>> {
        let whole = self.grid().whole();
        let points: Vec<_> = points.iter().map(|k| whole.index(*k)).collect();
        self.fill.points(&points, tick).map(|columns| self.stored(columns))
    }

    /// Whether a tile can be continued after a part of it: the sweeps of an orbit diagram, which carry their state.
    #[must_use]
    pub fn continues(&self) -> bool {
        // what goes on needs all columns of the part before
        self.fill.continues() && self.kept.len() == self.fill.fields().len()
    }

    /// As [`Study::tile`], continued from what was computed of the tile before; `keep` is called for each further part.
    #[must_use]
    pub fn continued(
        &self,
        k: u64,
        before: Option<BegunTile>,
        keep: Keep<'_>,
        tick: &(dyn Fn() -> bool + Sync),
    ) -> Option<Vec<Column>> {
        self.fill.continued(&self.grid().tile(k), before, keep, tick)
    }

    /// Number of points of a block that is computed at the cost of the same points in a whole tile; `u64::MAX` if only a
    /// whole tile is.
    #[must_use]
    pub fn together(&self) -> u64 {
        self.fill.together()
    }

    /// The columns of a block within one tile; `None` if stopped. A block with fewer points than [`Study::together`] may
    /// cost more than its part of a tile.
    #[must_use]
    pub fn block(&self, block: &Block, tick: &(dyn Fn() -> bool + Sync)) -> Option<Vec<Column>> {
        self.fill.fill(block, tick).map(|columns| self.stored(columns))
    }

    /// The tables of the whole study, when all tiles are complete. Cycles with preliminary numbers are numbered, and
    /// the tiles that contain them are written again. A second call changes nothing.
    ///
    /// # Errors
    /// If tiles cannot be read or written.
    pub fn conclude<T: Tiles>(&self, tiles: &mut T) -> Result<Vec<StudyTable>, T::Error> {
        match self.fill.numbered() {
            Some(numbering) => numbering.conclude(self.grid(), tiles),
            None => Ok(Vec::new()),
        }
    }
}

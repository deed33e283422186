//! The tiles of a basin of any system: for each start, the motion to which it leads.

mod machine;
mod oscillator;
mod settling;

pub(crate) use machine::MachineBasin;
pub(crate) use oscillator::OscillatorBasin;

use super::code;
use super::cycles::{self, Numbered};
use super::fill::{self, Fill, Over};
use super::map::{computed, computed_column};
use super::refine::{self, Cell};
use super::stored_motion::Stored;
use crate::field::{Column, Field};
use crate::grid::{Block, Grid};
use core::cell::RefCell;
use std::sync::OnceLock;
use vibroimpact::verdict::{Census, CountedMotion, Verdict};

/// The starts of a system, or of systems, over a grid.
pub(crate) trait Basins: Send + Sync {
    /// The kind of system.
    type System: Stored<
            Cycle: Send + Sync,
            NoImpact: Send + Sync,
            Place: Send + Sync,
            State: Send + Sync,
            Exponents: Send + Sync,
        > + Send
        + Sync;
    /// What is noted of the starts of a tile, beside the motions of one system.
    type Notes: Default + Send;
    /// Number of starts that are settled together about as well as those of a whole tile.
    const ABREAST: u64;
    /// Whether a start may lie beyond a stop.
    const REFUSES: bool;

    /// Whether all starts belong to one system, whose cycles are numbered.
    fn one_system(&self) -> bool;

    /// The distance of the points that are computed first; `None` for all points.
    fn refine(&self) -> Option<u32>;

    /// The motions of starts of one system that are spread over the grid, which number the cycles.
    fn survey(&self, grid: &Grid) -> Census<Self::System>;

    /// Settles points of a block. Returns for each point the number of its motion; `None` beyond a stop.
    fn settle(
        &self,
        block: &Block,
        wanted: &[usize],
        into: &mut (Census<Self::System>, Self::Notes),
        tick: &(dyn Fn() -> bool + Sync),
    ) -> Option<Vec<Option<u32>>>;

    /// Whether two motions of a tile count as the same for starts between them.
    fn alike(_: &Census<Self::System>, a: Option<u32>, b: Option<u32>) -> bool {
        a == b
    }

    /// The codes of the labels of the motions of a tile that belong to several systems.
    fn codes(_: &Self::Notes) -> Vec<i32> {
        Vec::new()
    }

    /// The fields after those of the motions.
    fn fields(&self) -> Vec<Field>;

    /// Their columns. `stored` returns the verdict on a motion as it is stored.
    fn columns<'a>(
        &'a self,
        block: &Block,
        tile: &'a BasinTile<Self>,
        stored: &dyn Fn(&'a Verdict<Self::System>) -> &'a Verdict<Self::System>,
    ) -> Vec<Column>;

    /// The names of the stops of a machine.
    fn stops(&self) -> Vec<String> {
        Vec::new()
    }

    /// A basin of one system, whose cycles are numbered.
    fn numbered(of: &BasinFill<Self>) -> Numbered<'_>
    where
        Self: Sized;
}

/// A basin: the starts and their grid.
pub(crate) struct BasinFill<B: Basins> {
    pub(crate) of: B,
    over: Over,
    /// The cycles of one system with the same numbers in all tiles; computed when the first tile is stored.
    survey: OnceLock<Vec<Verdict<B::System>>>,
}

/// The motions of one tile.
pub(crate) struct BasinTile<B: Basins + ?Sized> {
    /// The motions of one system, in the order of the first start that was settled into each.
    pub(crate) met: Census<B::System>,
    pub(crate) notes: B::Notes,
    /// For each start the number of its motion; `None` beyond a stop.
    pub(crate) cells: Vec<Cell<Option<u32>>>,
}

impl<B: Basins + ?Sized> BasinTile<B> {
    /// For each start the number of its motion.
    pub(super) fn numbers(&self) -> impl Iterator<Item = Option<u32>> + '_ {
        self.cells.iter().map(|cell| cell.result(&self.cells).and_then(|(number, _)| *number))
    }
}

/// The result of a start as it is stored: the code of its label and the number of its cycle.
type Leads = (i32, i32);

impl<B: Basins> BasinFill<B> {
    pub(crate) const fn new(of: B, over: Over) -> Self {
        Self { of, over, survey: OnceLock::new() }
    }

    /// The cycles of the survey, if the starts belong to one system. Every tile computes the same ones.
    pub(super) fn cycles(&self) -> Option<&[Verdict<B::System>]> {
        let found = || cycles::survey(&self.of.survey(&self.over.grid));
        self.of.one_system().then(|| self.survey.get_or_init(found).as_slice())
    }

    /// The same basin with an empty survey.
    #[cfg(test)]
    pub(super) fn forgetful(self) -> Self {
        Self { survey: OnceLock::from(Vec::new()), ..self }
    }

    /// The stored result of each motion of a tile, and the cycles that the survey has not found.
    fn leads(&self, tile: &BasinTile<B>) -> (Vec<Leads>, Census<B::System>) {
        let mut unknown = Census::default();
        let Some(known) = self.cycles() else {
            return (B::codes(&tile.notes).into_iter().map(|code| (code, cycles::NONE)).collect(), unknown);
        };
        let leads =
            |found: &CountedMotion<B::System>| (code(&found.verdict), cycles::number(known, &mut unknown, found));
        (tile.met.motions().iter().map(leads).collect(), unknown)
    }

    /// The cycles that only this tile has found, in the order of their preliminary numbers.
    pub(super) fn unknown(&self, block: &Block) -> Census<B::System> {
        let tile = self.compute(block, &|| false);
        tile.map(|tile| self.leads(&tile).1).unwrap_or_default()
    }

    /// The motions of a tile; `None` if stopped.
    pub(crate) fn compute(&self, block: &Block, tick: &(dyn Fn() -> bool + Sync)) -> Option<BasinTile<B>> {
        let into = RefCell::default();
        let points = |wanted: &[usize]| self.of.settle(block, wanted, &mut into.borrow_mut(), tick);
        let cells = match self.of.refine() {
            None => points(&(0..block.points()).collect::<Vec<_>>())?.into_iter().map(Cell::Computed).collect(),
            Some(step) => refine::fill(block, step as usize, points, |a, b| B::alike(&into.borrow().0, *a, *b))?,
        };
        let (met, notes) = into.into_inner();
        Some(BasinTile { met, notes, cells })
    }

    fn columns(&self, block: &Block, tile: &BasinTile<B>) -> Vec<Column> {
        let (leads, _) = self.leads(tile);
        let of = |number: Option<u32>| number.map_or((super::REFUSED, cycles::BEYOND), |number| leads[number as usize]);
        let (labels, numbers) = tile.numbers().map(of).unzip();
        let mut columns = vec![Column::I32(labels)];
        if self.of.one_system() {
            columns.push(Column::I32(numbers));
        }
        // the verdict on a cycle that the survey has found is that of the survey, so that it is the same in all tiles
        let known = self.cycles().unwrap_or_default();
        let stored = |found| known.iter().find(|known| known.same_as(found, cycles::SAME)).unwrap_or(found);
        columns.extend(self.of.columns(block, tile, &stored));
        if self.of.refine().is_some() {
            columns.push(computed_column(&tile.cells));
        }
        columns
    }
}

impl<B: Basins> Fill for BasinFill<B> {
    fn together(&self) -> u64 {
        fill::with_refinement(self.of.refine(), B::ABREAST)
    }

    fn over(&self) -> &Over {
        &self.over
    }

    fn fields(&self) -> Vec<Field> {
        let refused = |number: i32| B::REFUSES.then_some((number, "beyond_a_stop"));
        let mut label = code::field("motion m/n that the start leads to", &[]);
        label.flags.extend(refused(super::REFUSED));
        let mut fields = vec![label.clone()];
        if self.of.one_system() {
            let mut cycle = cycles::field(label.clone());
            cycle.flags.extend(refused(cycles::BEYOND));
            fields.push(cycle);
        }
        fields.extend(self.of.fields());
        if self.of.refine().is_some() {
            fields.push(computed());
        }
        fields
    }

    fn fill(&self, block: &Block, tick: &(dyn Fn() -> bool + Sync)) -> Option<Vec<Column>> {
        Some(self.columns(block, &self.compute(block, tick)?))
    }

    fn numbered(&self) -> Option<Numbered<'_>> {
        self.of.one_system().then(|| B::numbered(self))
    }
}

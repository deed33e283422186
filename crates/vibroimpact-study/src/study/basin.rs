//! The tiles of a basin: for each start, the motion to which it leads.

use super::code;
use super::cycles::{self, Numbered, Numbering};
use super::fill::{Along, Fill, along, grid_of, on_axis, spread};
use super::map::{computed, computed_column, side};
use super::refine::{self, Cell};
use crate::axis;
use crate::basin::start_at;
use crate::field::{Column, Field, NumberType};
use crate::grid::{Block, Dimension, Grid};
use crate::limits::MOST_STARTS;
use crate::quantity::{self, Quantities, Quantity};
use crate::{BasinPlan, PlanError, SystemPlan, Unit};
use core::cell::RefCell;
use std::sync::OnceLock;
use vibroimpact::lanes::Width;
use vibroimpact::quantities::of_verdict_only;
use vibroimpact::verdict::{
    Census, CountedMotion, KnownAttractors, SettleOptions, StartBox, Verdict, scattered_starts, settle_many,
};
use vibroimpact::{Oscillator, Start};

/// Default number of points of a tile along each of two axes; a tile takes about a tenth of a second.
const TILE: usize = 256;
/// Number of starts, spread over the grid, that are settled in the survey, before the first tile, to find the cycles of
/// the system.
const SURVEY: u64 = 96;
/// Number of these starts whose cycles get trapping regions.
const TRAPS: u64 = 24;

/// The position of the starts.
enum Starts {
    /// At the points of the axes.
    Grid(BasinPlan),
    /// Scattered over an area, by the sequence with this seed.
    Scattered { area: StartBox, seed: u64 },
}

pub(crate) struct BasinFill {
    system: SystemPlan,
    /// The oscillator, if all starts belong to one.
    one: Option<Surveyed>,
    starts: Starts,
    grid: Grid,
    refine: Option<u32>,
    options: SettleOptions,
}

/// An oscillator and the result of the survey.
struct Surveyed {
    osc: Oscillator,
    survey: KnownAttractors,
    /// The cycles with the same numbers in all tiles; computed when the first tile is stored.
    cycles: OnceLock<Vec<Verdict>>,
}

/// The motions of one tile.
pub(crate) struct BasinTile {
    /// For a basin of one oscillator: the motions of the tile, in the order of the first start that was settled into
    /// each.
    pub(crate) met: Census,
    /// For a basin that also varies parameters: the codes of the labels in the tile. With quantities, each start has
    /// an entry of its own.
    codes: Vec<(i32, Option<Quantities>)>,
    /// For each point, the index of its motion in `met` or of its code in `codes`.
    pub(crate) cells: Vec<Cell<u32>>,
}

/// The result of a start as it is stored: the code of its label and the number of its cycle.
type Leads = (i32, i32);

/// A basin with fewer starts than this has no survey.
const WORTH_A_SURVEY: u64 = 500;

impl BasinFill {
    pub(crate) fn plane(system: &SystemPlan, plan: &BasinPlan, tile: Option<u32>) -> Result<Self, PlanError> {
        let starts = Starts::Grid(plan.clone());
        let grid = grid_of(&plan.axes, tile, side(TILE, plan.axes.len()));
        let osc = if plan.one_system() { Some(system.oscillator()?) } else { None };
        Ok(Self { system: *system, one: None, starts, grid, refine: plan.refine, options: plan.options() }
            .surveyed(osc))
    }

    pub(crate) fn scattered(
        system: &SystemPlan,
        (starts, seed): (u64, u64),
        options: &SettleOptions,
        tile: Option<u32>,
    ) -> Result<Self, PlanError> {
        let osc = system.oscillator()?;
        let count = usize::try_from(starts).map_err(|_| PlanError::Starts { given: starts, most: MOST_STARTS })?;
        let tile = tile.map_or(side(TILE, 1), |tile| tile as usize).min(count);
        let dimension = Dimension { name: "start".into(), count, tile };
        let grid = Grid { dimensions: vec![dimension] };
        let starts = Starts::Scattered { area: StartBox::natural(&osc), seed };
        Ok(Self { system: *system, one: None, starts, grid, refine: None, options: *options }.surveyed(Some(osc)))
    }

    fn surveyed(self, osc: Option<Oscillator>) -> Self {
        let one = osc.map(|osc| {
            let total = self.grid.points();
            let traps = if total > WORTH_A_SURVEY { TRAPS } else { 0 };
            let starts = spread(total, traps).map(|k| self.nth(&osc, k));
            Surveyed { survey: KnownAttractors::survey(&osc, starts, &self.options), cycles: OnceLock::new(), osc }
        });
        Self { one, ..self }
    }

    /// The start at point number `k` of the grid.
    fn nth(&self, osc: &Oscillator, k: u64) -> Start {
        self.start(osc, &self.system, &self.grid.whole().index(usize::try_from(k).unwrap_or(0)))
    }

    /// The cycles of the survey. Every tile computes the same ones.
    fn cycles<'a>(&self, one: &'a Surveyed) -> &'a [Verdict] {
        one.cycles.get_or_init(|| {
            let numbers: Vec<u64> = spread(self.grid.points(), SURVEY).collect();
            let known = |k: u64| self.nth(&one.osc, numbers[usize::try_from(k).unwrap_or(0)]);
            let (range, width) = (0..numbers.len() as u64, Width::best());
            let found = settle_many(&one.osc, range, known, &one.survey, &self.options, width, &|| false);
            let mut census = Census::default();
            for found in &found.motions {
                census.add_found(found);
            }
            cycles::survey(&census)
        })
    }

    /// The same basin with an empty survey.
    #[cfg(test)]
    pub(super) fn forgetful(self) -> Self {
        Self { one: self.one.map(|one| Surveyed { cycles: OnceLock::from(Vec::new()), ..one }), ..self }
    }

    /// The start at a point of the grid.
    fn start(&self, osc: &Oscillator, there: &SystemPlan, index: &[usize]) -> Start {
        match &self.starts {
            Starts::Scattered { area, seed } => scattered_starts(osc, *area, *seed, index[0] as u64),
            Starts::Grid(plan) => start_at(osc, (&self.system, there), plan, |k| on_axis(index, k)),
        }
    }

    /// The system at a point of the grid. The corners have been checked, so this fails only between valid corners.
    fn there(&self, index: &[usize]) -> Option<(SystemPlan, Oscillator)> {
        let Starts::Grid(plan) = &self.starts else { return None };
        let there = axis::system_at(&self.system, &plan.axes, |k| on_axis(index, k)).ok()?;
        Some((there, there.oscillator().ok()?))
    }

    /// Settles the given points of a tile. Returns for each point the index of its motion or code in the tile.
    fn settled(
        &self,
        block: &Block,
        wanted: &[usize],
        (met, codes): (&mut Census, &mut Vec<(i32, Option<Quantities>)>),
        tick: &(dyn Fn() -> bool + Sync),
    ) -> Option<Vec<u32>> {
        let options = self.options;
        let whole = |number: usize| u32::try_from(number).unwrap_or(u32::MAX);
        let Some(one) = &self.one else {
            let alone = |k: &usize| {
                let index = block.index(*k);
                // the corners are valid; a point between them that is not is undecided
                let found = self.there(&index).map_or((super::UNDECIDED, None), |(there, osc)| {
                    let start = self.start(&osc, &there, &index);
                    let verdict = vibroimpact::verdict::settle(&osc, start, &options).verdict;
                    let quantities =
                        if self.asked().is_empty() { None } else { of_verdict_only(&osc, &verdict, self.asked()) };
                    (code(&verdict), quantities)
                });
                let known = codes.iter().position(|known| *known == found).filter(|_| self.asked().is_empty());
                let number = known.unwrap_or_else(|| {
                    codes.push(found);
                    codes.len() - 1
                });
                (!tick()).then(|| whole(number))
            };
            return wanted.iter().map(alone).collect();
        };
        let start = |k: u64| {
            let number = usize::try_from(k).ok().and_then(|k| wanted.get(k)).copied().unwrap_or(0);
            self.start(&one.osc, &self.system, &block.index(number))
        };
        let range = 0..wanted.len() as u64;
        let settlement = settle_many(&one.osc, range, start, &one.survey, &options, Width::best(), &|| tick());
        if settlement.cells.len() < wanted.len() {
            return None;
        }
        let numbers: Vec<u32> = settlement.motions.iter().map(|found| whole(met.add_found(found))).collect();
        Some(settlement.cells.iter().map(|cell| numbers[*cell as usize]).collect())
    }

    /// The stored result of each motion of a tile, and the cycles that the survey has not found.
    fn leads(&self, tile: &BasinTile) -> (Vec<Leads>, Census) {
        let mut unknown = Census::default();
        let Some(one) = &self.one else {
            return (tile.codes.iter().map(|(code, _)| (*code, cycles::NONE)).collect(), unknown);
        };
        let known = self.cycles(one);
        let leads = |found: &CountedMotion| (code(&found.verdict), cycles::number(known, &mut unknown, found));
        (tile.met.motions().iter().map(leads).collect(), unknown)
    }

    /// The quantities that the plan asks for.
    fn asked(&self) -> &[Quantity] {
        if let Starts::Grid(plan) = &self.starts { &plan.fields } else { &[] }
    }

    /// The columns of the quantities that the plan asks for. The quantities of a cycle that the survey has found are
    /// those of the survey, so that they are the same in all tiles. Cells that took the motion of their neighbours have
    /// its quantities if all starts belong to one system.
    fn quantities(&self, tile: &BasinTile) -> Vec<Column> {
        let asked = self.asked();
        let mut columns = vec![Vec::with_capacity(tile.cells.len()); asked.len()];
        if asked.is_empty() {
            return Vec::new();
        }
        let known: Vec<Option<Quantities>> = match &self.one {
            Some(one) => {
                let survey = self.cycles(one);
                let same = |found: &Verdict| survey.iter().find(|known| cycles::same(*known, found));
                let of = |found: &CountedMotion| {
                    of_verdict_only(&one.osc, same(&found.verdict).unwrap_or(&found.verdict), asked)
                };
                tile.met.motions().iter().map(of).collect()
            }
            None => tile.codes.iter().map(|(_, quantities)| *quantities).collect(),
        };
        for cell in &tile.cells {
            let own = |(_, own): &(&u32, bool)| *own || self.one.is_some();
            let number = cell.result(&tile.cells).filter(own);
            let of = number.and_then(|(number, _)| known.get(*number as usize).copied().flatten());
            columns.iter_mut().zip(quantity::values(asked, of)).for_each(|(column, value)| column.push(value));
        }
        columns.into_iter().map(Column::F64).collect()
    }

    /// Whether two indices of a tile stand for the same motion, or for two motions with the same label that are no
    /// cycles.
    fn alike(&self, met: &Census, a: u32, b: u32) -> bool {
        let label = |number: u32| met.motions().get(number as usize).map(|found| &found.verdict);
        let plain = |of: Option<&Verdict>| of.filter(|verdict| !matches!(verdict, Verdict::Periodic(_))).map(code);
        a == b || (plain(label(a)).is_some() && plain(label(a)) == plain(label(b)))
    }
}

impl Fill for BasinFill {
    type Tile = BasinTile;

    fn grid(&self) -> &Grid {
        &self.grid
    }

    fn coordinates(&self) -> Vec<Along> {
        match &self.starts {
            Starts::Grid(plan) => along(&plan.axes),
            Starts::Scattered { .. } => Vec::new(),
        }
    }

    fn fields(&self) -> Vec<Field> {
        let label = code::field("motion m/n that the start leads to", Vec::new());
        let mut fields = vec![label.clone()];
        if self.one.is_some() {
            fields.push(cycles::field(label.clone()));
        }
        fields.extend(self.asked().iter().map(|quantity| quantity::field(*quantity, Vec::new())));
        if let Starts::Scattered { .. } = self.starts {
            let coordinate = |name: &'static str, long_name: &'static str, unit| Field {
                name: name.into(),
                long_name: long_name.into(),
                unit,
                kind: NumberType::F64,
                flags: Vec::new(),
                comment: "",
                ..label.clone()
            };
            fields.push(coordinate("x", "position of the start", Unit::LENGTH));
            fields.push(coordinate("v", "velocity of the start", Unit::VELOCITY));
            fields.push(coordinate("phase", "phase of the force at the start", Unit::ANGLE));
        }
        if self.refine.is_some() {
            fields.push(computed());
        }
        fields
    }

    fn compute(&self, block: &Block, tick: &(dyn Fn() -> bool + Sync)) -> Option<BasinTile> {
        let (mut met, mut codes) = (Census::default(), Vec::new());
        let cells = match self.refine {
            None => {
                let all: Vec<usize> = (0..block.points()).collect();
                let numbers = self.settled(block, &all, (&mut met, &mut codes), tick)?;
                numbers.into_iter().map(Cell::Computed).collect()
            }
            Some(step) => {
                let shared = RefCell::new((&mut met, &mut codes));
                let compute = |wanted: &[usize]| {
                    let (met, codes) = &mut *shared.borrow_mut();
                    self.settled(block, wanted, (met, codes), tick)
                };
                refine::fill(block, step as usize, compute, |a, b| self.alike(shared.borrow().0, *a, *b))?
            }
        };
        Some(BasinTile { met, codes, cells })
    }

    fn columns(&self, block: &Block, tile: BasinTile) -> Vec<Column> {
        let (leads, _) = self.leads(&tile);
        let cells = &tile.cells;
        let of = |cell: &Cell<u32>| {
            cell.result(cells).map_or((super::UNDECIDED, cycles::NONE), |(number, _)| leads[*number as usize])
        };
        let mut columns = vec![Column::I32(cells.iter().map(|cell| of(cell).0).collect())];
        if self.one.is_some() {
            columns.push(Column::I32(cells.iter().map(|cell| of(cell).1).collect()));
        }
        columns.extend(self.quantities(&tile));
        if let (Starts::Scattered { .. }, Some(one)) = (&self.starts, &self.one) {
            let starts: Vec<Start> =
                (0..block.points()).map(|k| self.start(&one.osc, &self.system, &block.index(k))).collect();
            for coordinate in [|s: &Start| s.x, |s: &Start| s.v, |s: &Start| s.phase] {
                columns.push(Column::F64(starts.iter().map(coordinate).collect()));
            }
        }
        if self.refine.is_some() {
            columns.push(computed_column(cells));
        }
        columns
    }

    fn numbered(&self) -> Option<Numbered<'_>> {
        let one = self.one.as_ref()?;
        let unknown = |k: u64| {
            let tile = self.compute(&self.grid.tile(k), &|| false);
            tile.map(|tile| self.leads(&tile).1).unwrap_or_default()
        };
        let numbering = Numbering { field: 1, known: self.cycles(one), unknown: Box::new(unknown) };
        Some(Numbered::Oscillator(numbering))
    }
}

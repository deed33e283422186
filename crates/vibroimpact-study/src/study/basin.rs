//! The tiles of a basin: for each start, the motion to which it leads.

mod columns;
mod settling;

use super::code;
use super::cycles::{self, Numbered, Numbering};
use super::fill::{self, Along, Fill, spread};
use super::refine::{self, Cell};
use super::starts::Starts;
use crate::field::{Column, Field};
use crate::grid::{Block, Grid};
use crate::limits::MOST_STARTS;
use crate::quantity::{Quantities, Quantity};
use crate::{BasinPlan, PlanError, SystemPlan};
use core::cell::RefCell;
use std::sync::OnceLock;
use vibroimpact::lanes::Width;
use vibroimpact::math::Multiplier;
use vibroimpact::verdict::{
    Census, CountedMotion, Ending, KnownAttractors, SettleOptions, StartBox, Verdict, settle_many,
};
use vibroimpact::{Oscillator, Start};

/// Number of starts, spread over the grid, that are settled in the survey, before the first tile, to find the cycles of
/// the system.
const SURVEY: u64 = 96;
/// Number of these starts whose cycles get trapping regions.
const TRAPS: u64 = 24;

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
    /// For a basin that also varies parameters: the motions of each system.
    found: Vec<Found>,
    /// For each point, the index of its motion in `met` or in `found`.
    pub(crate) cells: Vec<Cell<u32>>,
    /// How each point was decided; without meaning at points that were not computed.
    endings: Vec<Ending>,
}

/// A motion of one of the systems of a tile.
struct Found {
    code: i32,
    multipliers: Option<[Multiplier; 2]>,
    quantities: Option<Quantities>,
}

/// The motions of a tile while it is computed.
#[derive(Default)]
struct Settled {
    met: Census,
    found: Vec<Found>,
    endings: Vec<Ending>,
}

/// The result of a start as it is stored: the code of its label and the number of its cycle.
type Leads = (i32, i32);

/// Number of starts of one system that share lanes about as well as those of a whole tile.
const ABREAST: u64 = 256;

/// A basin with fewer starts than this has no survey.
const WORTH_A_SURVEY: u64 = 500;

impl BasinFill {
    pub(crate) fn plane(system: &SystemPlan, plan: &BasinPlan, tile: Option<u32>) -> Result<Self, PlanError> {
        let osc = if plan.one_system() { Some(system.oscillator()?) } else { None };
        Ok(Self::of((system, osc), Starts::Grid(plan.clone()), (plan.refine, plan.options()), tile))
    }

    pub(crate) fn scattered(
        system: &SystemPlan,
        (starts, seed): (u64, u64),
        options: &SettleOptions,
        tile: Option<u32>,
    ) -> Result<Self, PlanError> {
        let osc = system.oscillator()?;
        let count = usize::try_from(starts).map_err(|_| PlanError::outside("starts", starts, (1, MOST_STARTS)))?;
        let starts = Starts::Scattered { area: StartBox::natural(&osc), seed, count };
        Ok(Self::of((system, Some(osc)), starts, (None, *options), tile))
    }

    fn of(
        (system, osc): (&SystemPlan, Option<Oscillator>),
        starts: Starts,
        (refine, options): (Option<u32>, SettleOptions),
        tile: Option<u32>,
    ) -> Self {
        let bare = Self { system: *system, one: None, grid: starts.grid(tile), starts, refine, options };
        let one = osc.map(|osc| {
            let total = bare.grid.points();
            // a motion that a trapping region captures is not followed to its end, so its length is not known
            let traps = if total > WORTH_A_SURVEY && !bare.transient() { TRAPS } else { 0 };
            let starts = spread(total, traps).map(|k| bare.nth(&osc, k));
            Surveyed { survey: KnownAttractors::survey(&osc, starts, &bare.options), cycles: OnceLock::new(), osc }
        });
        Self { one, ..bare }
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
            let found = settle_many(&one.osc, range, &known, &one.survey, &self.options, width, &|| false);
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
        self.starts.at(osc, (&self.system, there), index)
    }

    /// The stored result of each motion of a tile, and the cycles that the survey has not found.
    fn leads(&self, tile: &BasinTile) -> (Vec<Leads>, Census) {
        let mut unknown = Census::default();
        let Some(one) = &self.one else {
            return (tile.found.iter().map(|found| (found.code, cycles::NONE)).collect(), unknown);
        };
        let known = self.cycles(one);
        let leads = |found: &CountedMotion| (code(&found.verdict), cycles::number(known, &mut unknown, found));
        (tile.met.motions().iter().map(leads).collect(), unknown)
    }

    /// The quantities that the plan asks for.
    fn asked(&self) -> &[Quantity] {
        self.starts.plan().map_or(&[], |plan| &plan.fields)
    }

    /// Whether the starts are points, for which further numbers of each motion are reported.
    fn of_points(&self) -> bool {
        self.starts.plan().is_some_and(|plan| plan.points.is_some())
    }

    /// Whether the starts are points of several systems, for which the multipliers of each motion are reported. Those of one
    /// system are in the tables of its cycles.
    fn of_systems(&self) -> bool {
        self.of_points() && self.one.is_none()
    }

    /// Whether the length of each transient is reported.
    fn transient(&self) -> bool {
        self.starts.plan().is_some_and(|plan| plan.transient)
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

    fn together(&self) -> u64 {
        fill::with_refinement(self.refine, ABREAST)
    }

    fn grid(&self) -> &Grid {
        &self.grid
    }

    fn grid_mut(&mut self) -> &mut Grid {
        &mut self.grid
    }

    fn coordinates(&self) -> Vec<Along> {
        self.starts.coordinates()
    }

    fn fields(&self) -> Vec<Field> {
        self.stored_fields()
    }

    fn compute(&self, block: &Block, tick: &(dyn Fn() -> bool + Sync)) -> Option<BasinTile> {
        let mut settled = Settled::default();
        let cells = match self.refine {
            None => {
                let all: Vec<usize> = (0..block.points()).collect();
                let numbers = self.settled(block, &all, &mut settled, tick)?;
                numbers.into_iter().map(Cell::Computed).collect()
            }
            Some(step) => {
                let shared = RefCell::new(&mut settled);
                let compute = |wanted: &[usize]| self.settled(block, wanted, &mut shared.borrow_mut(), tick);
                refine::fill(block, step as usize, compute, |a, b| self.alike(&shared.borrow().met, *a, *b))?
            }
        };
        let Settled { met, found, endings } = settled;
        Some(BasinTile { met, found, cells, endings })
    }

    fn columns(&self, block: &Block, tile: BasinTile) -> Vec<Column> {
        self.stored_columns(block, &tile)
    }

    fn numbered(&self) -> Option<Numbered<'_>> {
        let one = self.one.as_ref()?;
        let unknown = |k: u64| {
            let tile = self.compute(&self.grid.tile(k), &|| false);
            tile.map(|tile| self.leads(&tile).1).unwrap_or_default()
        };
        let numbering = Numbering { field: 1, known: self.cycles(one), stops: Vec::new(), unknown: Box::new(unknown) };
        Some(Numbered::Oscillator(numbering))
    }
}

//! The tiles of a basin: for each start, the motion to which it leads.

mod columns;

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
use std::collections::HashMap;
use std::sync::OnceLock;
use vibroimpact::lanes::Width;
use vibroimpact::math::Multiplier;
use vibroimpact::quantities::of_verdict_only;
use vibroimpact::verdict::{
    Census, CountedMotion, Ending, KnownAttractors, Reason, SettleOptions, Settlement, StartBox, Verdict, settle_each,
    settle_many,
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

/// A point that was not computed, or has no valid system.
const NOTHING: Ending = Ending { reason: Reason::SearchLimit, impacts: 0 };

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
        let count = usize::try_from(starts).map_err(|_| PlanError::Starts { given: starts, most: MOST_STARTS })?;
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
        self.starts.at(osc, (&self.system, there), index)
    }

    /// Settles the given points of a tile. Returns for each point the index of its motion in the tile.
    fn settled(
        &self,
        block: &Block,
        wanted: &[usize],
        into: &mut Settled,
        tick: &(dyn Fn() -> bool + Sync),
    ) -> Option<Vec<u32>> {
        into.endings.resize(block.points(), NOTHING);
        if let Some(one) = &self.one {
            let start = |k: usize| self.start(&one.osc, &self.system, &block.index(wanted[k]));
            let all: Vec<usize> = (0..wanted.len()).collect();
            let (motions, cells) = self.among(&one.osc, (&all, wanted), start, &one.survey, &mut into.endings, tick)?;
            let numbers: Vec<u32> = motions.iter().map(|found| whole(into.met.add_found(found))).collect();
            return Some(cells.into_iter().map(|cell| numbers[cell as usize]).collect());
        }
        // starts of one system are settled together
        let mut groups: Vec<Vec<usize>> = Vec::new();
        let mut known: HashMap<Vec<u64>, usize> = HashMap::new();
        for (k, number) in wanted.iter().enumerate() {
            let group = *known.entry(self.starts.key(&block.index(*number))).or_insert_with(|| {
                groups.push(Vec::new());
                groups.len() - 1
            });
            groups[group].push(k);
        }
        let mut numbers = vec![0; wanted.len()];
        // the starts of systems with few of them share lanes
        let mut few: Vec<(Vec<usize>, SystemPlan, Oscillator)> = Vec::new();
        for group in groups {
            let first = block.index(wanted[group[0]]);
            // the corners are valid; a point between them that is not is undecided
            let Some((there, osc)) = self.starts.system(&self.system, &first) else {
                let number = whole(into.found.len());
                into.found.push(Found { code: super::UNDECIDED, multipliers: None, quantities: None });
                group.iter().for_each(|k| numbers[*k] = number);
                if group.iter().any(|_| tick()) {
                    return None;
                }
                continue;
            };
            if group.len() as u64 <= WORTH_A_SURVEY {
                few.push((group, there, osc));
                continue;
            }
            let start = |k: usize| self.start(&osc, &there, &block.index(wanted[group[k]]));
            let traps = if self.transient() { 0 } else { TRAPS };
            let chosen = spread(group.len() as u64, traps).filter_map(|k| usize::try_from(k).ok()).map(start);
            let survey = KnownAttractors::survey(&osc, chosen, &self.options);
            let (motions, cells) = self.among(&osc, (&group, wanted), start, &survey, &mut into.endings, tick)?;
            let own: Vec<u32> = motions.iter().map(|found| self.found(&osc, &found.verdict, &mut into.found)).collect();
            group.iter().zip(cells).for_each(|(k, cell)| numbers[*k] = own[cell as usize]);
        }
        for ((group, _, osc), settlement) in few.iter().zip(self.of_few(block, wanted, &few, tick)?) {
            let own: Vec<u32> =
                settlement.motions.iter().map(|found| self.found(osc, &found.verdict, &mut into.found)).collect();
            for ((k, cell), ending) in group.iter().zip(&settlement.cells).zip(&settlement.endings) {
                numbers[*k] = own[*cell as usize];
                into.endings[wanted[*k]] = *ending;
            }
        }
        Some(numbers)
    }

    /// Settles the few starts of each of several systems, side by side.
    fn of_few(
        &self,
        block: &Block,
        wanted: &[usize],
        few: &[(Vec<usize>, SystemPlan, Oscillator)],
        tick: &(dyn Fn() -> bool + Sync),
    ) -> Option<Vec<Settlement>> {
        let counted: Vec<(Oscillator, u64)> = few.iter().map(|(group, _, osc)| (*osc, group.len() as u64)).collect();
        let start = |system: usize, k: u64| {
            let (group, there, osc) = &few[system];
            self.start(osc, there, &block.index(wanted[group[usize::try_from(k).unwrap_or(0)]]))
        };
        let mut settlements = vec![Settlement::default(); few.len()];
        settle_each(&counted, start, &self.options, false, Width::best(), &mut |system, settlement| {
            settlements[system] = settlement;
            few[system].0.iter().fold(false, |stop, _| tick() || stop)
        })
        .then_some(settlements)
    }

    /// Settles starts of one oscillator, and notes how each was decided. `group` are the places of the starts in `wanted`.
    fn among(
        &self,
        osc: &Oscillator,
        (group, wanted): (&[usize], &[usize]),
        start: impl Fn(usize) -> Start,
        survey: &KnownAttractors,
        endings: &mut [Ending],
        tick: &(dyn Fn() -> bool + Sync),
    ) -> Option<(Vec<CountedMotion>, Vec<u32>)> {
        let start = |k: u64| start(usize::try_from(k).unwrap_or(0));
        let range = 0..group.len() as u64;
        let settlement = settle_many(osc, range, start, survey, &self.options, Width::best(), &|| tick());
        if settlement.cells.len() < group.len() {
            return None;
        }
        for (k, ending) in group.iter().zip(&settlement.endings) {
            endings[wanted[*k]] = *ending;
        }
        Some((settlement.motions, settlement.cells))
    }

    /// The number of a motion in a tile of several systems. Without quantities and multipliers motions are their labels.
    fn found(&self, osc: &Oscillator, verdict: &Verdict, all: &mut Vec<Found>) -> u32 {
        let code = code(verdict);
        let bare = self.asked().is_empty() && !self.of_points();
        let known = if bare { all.iter().position(|known| known.code == code) } else { None };
        whole(known.unwrap_or_else(|| {
            let asked = self.asked();
            let quantities = if asked.is_empty() { None } else { of_verdict_only(osc, verdict, asked) };
            let multipliers = if self.of_systems() { verdict.multipliers(osc) } else { None };
            all.push(Found { code, multipliers, quantities });
            all.len() - 1
        }))
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

/// An index of a motion.
fn whole(number: usize) -> u32 {
    u32::try_from(number).unwrap_or(u32::MAX)
}

impl Fill for BasinFill {
    type Tile = BasinTile;

    fn together(&self) -> u64 {
        fill::with_refinement(self.refine, ABREAST)
    }

    fn grid(&self) -> &Grid {
        &self.grid
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
        let numbering = Numbering { field: 1, known: self.cycles(one), unknown: Box::new(unknown) };
        Some(Numbered::Oscillator(numbering))
    }
}

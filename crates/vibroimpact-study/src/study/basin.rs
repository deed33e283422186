//! The tiles of a basin: for each start the motion it leads to.

use super::code;
use super::cycles::{self, Numbering};
use super::fill::{Along, Fill, along, grid_of, on_axis};
use super::map::{computed, computed_column, side};
use super::refine::{self, Cell};
use crate::axis;
use crate::basin::start_at;
use crate::field::{Column, Field, NumberType};
use crate::grid::{Block, Dimension, Grid};
use crate::limits::MOST_STARTS;
use crate::{BasinPlan, PlanError, SystemPlan};
use vibroimpact::lanes::Width;
use vibroimpact::verdict::{
    Census, CountedMotion, KnownAttractors, SettleOptions, StartBox, Verdict, scattered_starts, settle_many,
};
use vibroimpact::{Oscillator, Start};

/// Points of a tile along each of two axes where no number is given; a tenth of a second of work.
const TILE: usize = 256;
/// Starts settled beforehand, spread over the grid, to know its cycles.
const SURVEY: u64 = 96;
/// Of these the ones whose cycles' traps are used.
const TRAPS: u64 = 24;

/// Where the starts are.
enum Starts {
    /// At the points of the axes.
    Grid(BasinPlan),
    /// Scattered, so many with that seed.
    Scattered { area: StartBox, seed: u64 },
}

pub(super) struct BasinFill {
    system: SystemPlan,
    /// The oscillator, where all starts are of one.
    one: Option<Surveyed>,
    starts: Starts,
    grid: Grid,
    refine: Option<u32>,
    options: SettleOptions,
}

/// An oscillator and what is known of it beforehand.
struct Surveyed {
    osc: Oscillator,
    survey: KnownAttractors,
    cycles: Vec<Verdict>,
}

/// What a start leads to: its label, and the number of its cycle.
type Leads = (i32, i32);

impl BasinFill {
    pub(super) fn plane(system: &SystemPlan, plan: &BasinPlan, tile: Option<u32>) -> Result<Self, PlanError> {
        let starts = Starts::Grid(plan.clone());
        let grid = grid_of(&plan.axes, tile, side(TILE, plan.axes.len()));
        let osc = if plan.one_system() { Some(system.oscillator()?) } else { None };
        Ok(Self { system: *system, one: None, starts, grid, refine: plan.refine, options: plan.options() }
            .surveyed(osc))
    }

    pub(super) fn scattered(
        system: &SystemPlan,
        (starts, seed): (u64, u64),
        tile: Option<u32>,
    ) -> Result<Self, PlanError> {
        let osc = system.oscillator()?;
        let count = usize::try_from(starts).map_err(|_| PlanError::Starts { given: starts, most: MOST_STARTS })?;
        let tile = tile.map_or(side(TILE, 1), |tile| tile as usize).min(count);
        let dimension = Dimension { name: "start".into(), count, tile };
        let grid = Grid { dimensions: vec![dimension] };
        let starts = Starts::Scattered { area: StartBox::natural(&osc), seed };
        Ok(Self { system: *system, one: None, starts, grid, refine: None, options: SettleOptions::default() }
            .surveyed(Some(osc)))
    }

    fn surveyed(self, osc: Option<Oscillator>) -> Self {
        let one = osc.map(|osc| {
            let (whole, options) = (self.grid.whole(), self.options);
            let total = self.grid.points();
            let start = |k: u64| self.start(&osc, &whole.index(usize::try_from(k).unwrap_or(0)));
            let spread = |n: u64| (0..n.min(total)).map(move |k| total / n.min(total) * k);
            let survey = KnownAttractors::survey(&osc, spread(TRAPS).map(start), &options);
            let numbers: Vec<u64> = spread(SURVEY).collect();
            let known = |k: u64| start(numbers[usize::try_from(k).unwrap_or(0)]);
            let found = settle_many(&osc, 0..numbers.len() as u64, known, &survey, &options, Width::best(), &|| false);
            let mut census = Census::default();
            for found in &found.motions {
                census.add_found(found);
            }
            Surveyed { survey, cycles: cycles::survey(&census), osc }
        });
        Self { one, ..self }
    }

    /// The same as if the survey had met nothing.
    #[cfg(test)]
    pub(super) fn forgetful(self) -> Self {
        Self { one: self.one.map(|one| Surveyed { cycles: Vec::new(), ..one }), ..self }
    }

    /// The start at a point of the grid.
    fn start(&self, osc: &Oscillator, index: &[usize]) -> Start {
        match &self.starts {
            Starts::Scattered { area, seed } => scattered_starts(osc, *area, *seed, index[0] as u64),
            Starts::Grid(plan) => start_at(osc, plan, |k| on_axis(index, k)),
        }
    }

    /// The oscillator at a point of the grid; the corners were checked.
    fn oscillator(&self, index: &[usize]) -> Option<Oscillator> {
        let Starts::Grid(plan) = &self.starts else { return None };
        axis::system_at(&self.system, &plan.axes, |k| on_axis(index, k)).ok()?.oscillator().ok()
    }

    /// Settles these points of a tile, and collects the cycles that the survey has not met.
    fn settled(
        &self,
        block: &Block,
        wanted: &[usize],
        unknown: &mut Census,
        tick: &(dyn Fn() -> bool + Sync),
    ) -> Option<Vec<Leads>> {
        let options = self.options;
        let Some(one) = &self.one else {
            let alone = |k: &usize| {
                let index = block.index(*k);
                let Some(osc) = self.oscillator(&index) else { return Some((super::UNDECIDED, cycles::NONE)) };
                let found = vibroimpact::verdict::settle(&osc, self.start(&osc, &index), &options);
                (!tick()).then(|| (code(&found.verdict), cycles::NONE))
            };
            return wanted.iter().map(alone).collect();
        };
        let start = |k: u64| {
            let number = usize::try_from(k).ok().and_then(|k| wanted.get(k)).copied().unwrap_or(0);
            self.start(&one.osc, &block.index(number))
        };
        let range = 0..wanted.len() as u64;
        let settlement = settle_many(&one.osc, range, start, &one.survey, &options, Width::best(), &|| tick());
        if settlement.cells.len() < wanted.len() {
            return None;
        }
        let leads = |found: &CountedMotion| (code(&found.verdict), cycles::number(&one.cycles, unknown, found));
        let motions: Vec<Leads> = settlement.motions.iter().map(leads).collect();
        Some(settlement.cells.iter().map(|cell| motions[*cell as usize]).collect())
    }

    /// The motions of a tile, and the cycles only it has met.
    fn leads(&self, block: &Block, tick: &(dyn Fn() -> bool + Sync)) -> Option<(Vec<Cell<Leads>>, Census)> {
        let mut unknown = Census::default();
        let compute = |wanted: &[usize]| self.settled(block, wanted, &mut unknown, tick);
        let cells = match self.refine {
            Some(step) => refine::fill(block, step as usize, compute, |a, b| a == b)?,
            None => {
                let mut compute = compute;
                compute(&(0..block.points()).collect::<Vec<_>>())?.into_iter().map(Cell::Computed).collect()
            }
        };
        Some((cells, unknown))
    }
}

impl Fill for BasinFill {
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
        let label = Field {
            name: "label",
            long_name: "motion m/n that the start leads to",
            units: "1",
            kind: NumberType::I32,
            fill: super::NOT_COMPUTED,
            extra: Vec::new(),
            flags: code::FLAGS.to_vec(),
            comment: code::COMMENT,
        };
        let mut fields = vec![label.clone()];
        if self.one.is_some() {
            fields.push(Field {
                name: "cycle",
                long_name: "number of the cycle that the start leads to, in the tables cycle_*",
                fill: i32::MIN,
                flags: vec![(i32::MIN, "not_computed"), (cycles::NONE, "no_cycle")],
                comment: "numbers below -1 stand for cycles that are numbered when all tiles are there",
                ..label.clone()
            });
        }
        if let Starts::Scattered { .. } = self.starts {
            let coordinate = |name, long_name, units| Field {
                name,
                long_name,
                units,
                kind: NumberType::F64,
                flags: Vec::new(),
                comment: "",
                ..label.clone()
            };
            fields.push(coordinate("x", "position of the start", "F/k"));
            fields.push(coordinate("v", "velocity of the start", "omega_n F/k"));
            fields.push(coordinate("phase", "phase of the force at the start", "radian"));
        }
        if self.refine.is_some() {
            fields.push(computed());
        }
        fields
    }

    fn fill(&self, block: &Block, tick: &(dyn Fn() -> bool + Sync)) -> Option<Vec<Column>> {
        let (cells, _) = self.leads(block, tick)?;
        let of = |cell: &Cell<Leads>| match cell {
            Cell::Computed(leads) => *leads,
            Cell::Like(corner) => match cells[*corner] {
                Cell::Computed(leads) => leads,
                Cell::Like(_) => (super::UNDECIDED, cycles::NONE),
            },
        };
        let mut columns = vec![Column::I32(cells.iter().map(|cell| of(cell).0).collect())];
        if self.one.is_some() {
            columns.push(Column::I32(cells.iter().map(|cell| of(cell).1).collect()));
        }
        if let (Starts::Scattered { .. }, Some(one)) = (&self.starts, &self.one) {
            let starts: Vec<Start> = (0..block.points()).map(|k| self.start(&one.osc, &block.index(k))).collect();
            for coordinate in [|s: &Start| s.x, |s: &Start| s.v, |s: &Start| s.phase] {
                columns.push(Column::F64(starts.iter().map(coordinate).collect()));
            }
        }
        if self.refine.is_some() {
            columns.push(computed_column(&cells));
        }
        Some(columns)
    }

    fn numbered(&self) -> Option<Numbering<'_>> {
        let one = self.one.as_ref()?;
        let unknown = |k: u64| {
            let found = self.leads(&self.grid.tile(k), &|| false);
            found.map(|(_, unknown)| unknown).unwrap_or_default()
        };
        Some(Numbering { field: 1, known: &one.cycles, unknown: Box::new(unknown) })
    }
}

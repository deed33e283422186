//! The starts of one oscillator, or of several, over a grid or scattered.

use super::{BasinFill, BasinTile, Basins};
use crate::field::{Column, Field, NumberType};
use crate::grid::{Block, Grid};
use crate::limits::MOST_STARTS;
use crate::map::options;
use crate::quantity::{self, Quantities, Quantity};
use crate::study::cycles::Numbered;
use crate::study::fill::spread;
use crate::study::refine::Cell;
use crate::study::starts::Starts;
use crate::study::{NOT_COMPUTED, code, reason};
use crate::{BasinPlan, PlanError, SystemPlan, Unit};
use vibroimpact::lanes::Width;
use vibroimpact::math::Multiplier;
use vibroimpact::quantities::of_verdict_only;
use vibroimpact::verdict::{
    Census, CountedMotion, Ending, KnownAttractors, SettleOptions, StartBox, Verdict, settle_many,
};
use vibroimpact::{Oscillator, Start};

/// Number of starts, spread over the grid, that are settled in the survey, before the first tile, to find the cycles of
/// the system.
const SURVEY: u64 = 96;
/// Number of these starts whose cycles get trapping regions.
pub(super) const TRAPS: u64 = 24;

/// The name, the description and the value of a part of the two multipliers of a motion.
type PartOfMultipliers = (&'static str, &'static str, fn(&[Multiplier; 2]) -> f64);

/// The multipliers as they are stored for points.
const MULTIPLIERS: [PartOfMultipliers; 4] = [
    ("multiplier_1_re", "real part of the larger Floquet multiplier", |of| of[0].re),
    ("multiplier_1_im", "imaginary part of the larger Floquet multiplier", |of| of[0].im),
    ("multiplier_2_re", "real part of the smaller Floquet multiplier", |of| of[1].re),
    ("multiplier_2_im", "imaginary part of the smaller Floquet multiplier", |of| of[1].im),
];

/// The starts of oscillators.
pub(crate) struct OscillatorBasin {
    pub(super) system: SystemPlan,
    /// The oscillator, if all starts belong to one, and what the survey has found of it.
    pub(super) one: Option<(Oscillator, KnownAttractors)>,
    pub(super) starts: Starts,
    pub(super) refine: Option<u32>,
    pub(super) options: SettleOptions,
}

/// What is noted of the starts of a tile.
#[derive(Default)]
pub(crate) struct Notes {
    /// For a basin that also varies parameters: the motions of each system.
    pub(super) found: Vec<Found>,
    /// How each point was decided; without meaning at points that were not computed.
    pub(super) endings: Vec<Ending>,
}

/// A motion of one of the systems of a tile.
pub(super) struct Found {
    pub(super) code: i32,
    pub(super) multipliers: Option<[Multiplier; 2]>,
    pub(super) quantities: Option<Quantities>,
}

/// A basin with fewer starts than this has no survey.
pub(super) const WORTH_A_SURVEY: u64 = 500;

impl BasinFill<OscillatorBasin> {
    pub(crate) fn plane(system: &SystemPlan, plan: &BasinPlan, tile: Option<u32>) -> Result<Self, PlanError> {
        let osc = if plan.one_system() { Some(system.oscillator()?) } else { None };
        Ok(Self::over((system, osc), Starts::Grid(plan.clone()), (plan.refine, options(plan.impacts)), tile))
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
        Ok(Self::over((system, Some(osc)), starts, (None, *options), tile))
    }

    fn over(
        (system, osc): (&SystemPlan, Option<Oscillator>),
        starts: Starts,
        (refine, options): (Option<u32>, SettleOptions),
        tile: Option<u32>,
    ) -> Self {
        let over = starts.over(tile);
        let bare = OscillatorBasin { system: *system, one: None, starts, refine, options };
        let one = osc.map(|osc| {
            let total = over.grid.points();
            // a motion that a trapping region captures is not followed to its end, so its length is not known
            let traps = if total > WORTH_A_SURVEY && !bare.transient() { TRAPS } else { 0 };
            let starts = spread(total, traps).map(|k| bare.nth(&osc, &over.grid, k));
            (osc, KnownAttractors::survey(&osc, starts, &bare.options))
        });
        Self::new(OscillatorBasin { one, ..bare }, over)
    }
}

impl OscillatorBasin {
    /// The start at point number `k` of the grid.
    fn nth(&self, osc: &Oscillator, grid: &Grid, k: u64) -> Start {
        self.start(osc, &self.system, &grid.whole().index(usize::try_from(k).unwrap_or(0)))
    }

    /// The start at a point of the grid.
    pub(super) fn start(&self, osc: &Oscillator, there: &SystemPlan, index: &[usize]) -> Start {
        self.starts.at(osc, (&self.system, there), index)
    }

    /// The quantities that the plan asks for.
    pub(super) fn asked(&self) -> &[Quantity] {
        self.starts.plan().map_or(&[], |plan| &plan.fields)
    }

    /// Whether the starts are points, for which further numbers of each motion are reported.
    pub(super) fn of_points(&self) -> bool {
        self.starts.plan().is_some_and(|plan| plan.points.is_some())
    }

    /// Whether the starts are points of several systems, for which the multipliers of each motion are reported. Those of one
    /// system are in the tables of its cycles.
    pub(super) fn of_systems(&self) -> bool {
        self.of_points() && self.one.is_none()
    }

    /// Whether the length of each transient is reported.
    pub(super) fn transient(&self) -> bool {
        self.starts.plan().is_some_and(|plan| plan.transient)
    }

    /// The columns of reasons, where the starts are points, of multipliers, and of the lengths of the transients.
    fn details(&self, tile: &BasinTile<Self>) -> Vec<Column> {
        let mut columns = Vec::new();
        if self.of_points() {
            columns.push(reason::column(&tile.notes.endings));
        }
        if self.of_systems() {
            for part in MULTIPLIERS.map(|(_, _, part)| part) {
                let known: Vec<f64> =
                    tile.notes.found.iter().map(|found| found.multipliers.as_ref().map_or(f64::NAN, part)).collect();
                columns.push(Column::F64(tile.numbers().map(|number| known[number.unwrap_or(0) as usize]).collect()));
            }
        }
        if self.transient() {
            let own = |(cell, ending): (&Cell<Option<u32>>, &Ending)| match cell {
                Cell::Computed(_) => i32::try_from(ending.impacts).unwrap_or(i32::MAX),
                Cell::Like(_) => -1,
            };
            columns.push(Column::I32(tile.cells.iter().zip(&tile.notes.endings).map(own).collect()));
        }
        columns
    }

    /// The columns of the quantities that the plan asks for. Cells that took the motion of their neighbours have its quantities if
    /// all starts belong to one system.
    fn quantities<'a>(&'a self, tile: &'a BasinTile<Self>, stored: &dyn Fn(&'a Verdict) -> &'a Verdict) -> Vec<Column> {
        let asked = self.asked();
        let mut columns = vec![Vec::with_capacity(tile.cells.len()); asked.len()];
        if asked.is_empty() {
            return Vec::new();
        }
        let known: Vec<Option<Quantities>> = match &self.one {
            Some((osc, _)) => {
                let of = |found: &'a CountedMotion| of_verdict_only(osc, stored(&found.verdict), asked);
                tile.met.motions().iter().map(of).collect()
            }
            None => tile.notes.found.iter().map(|found| found.quantities).collect(),
        };
        for cell in &tile.cells {
            let own = |(_, own): &(&Option<u32>, bool)| *own || self.one.is_some();
            let number = cell.result(&tile.cells).filter(own).and_then(|(number, _)| *number);
            let of = number.and_then(|number| known.get(number as usize).copied().flatten());
            columns.iter_mut().zip(quantity::values(asked, of)).for_each(|(column, value)| column.push(value));
        }
        columns.into_iter().map(Column::F64).collect()
    }
}

impl Basins for OscillatorBasin {
    type System = Oscillator;
    type Notes = Notes;
    const ABREAST: u64 = 256;
    const REFUSES: bool = false;

    fn one_system(&self) -> bool {
        self.one.is_some()
    }

    fn refine(&self) -> Option<u32> {
        self.refine
    }

    fn survey(&self, grid: &Grid) -> Census {
        let mut census = Census::default();
        let Some((osc, survey)) = &self.one else { return census };
        let numbers: Vec<u64> = spread(grid.points(), SURVEY).collect();
        let known = |k: u64| self.nth(osc, grid, numbers[usize::try_from(k).unwrap_or(0)]);
        let (range, width) = (0..numbers.len() as u64, Width::best());
        for found in &settle_many(osc, range, &known, survey, &self.options, width, &|| false).motions {
            census.add_found(found);
        }
        census
    }

    fn settle(
        &self,
        block: &Block,
        wanted: &[usize],
        (met, notes): &mut (Census, Notes),
        tick: &(dyn Fn() -> bool + Sync),
    ) -> Option<Vec<Option<u32>>> {
        Some(self.settled(block, wanted, (met, notes), tick)?.into_iter().map(Some).collect())
    }

    /// Or two motions with the same label that are no cycles.
    fn alike(met: &Census, a: Option<u32>, b: Option<u32>) -> bool {
        let label = |number: Option<u32>| number.and_then(|number| met.motions().get(number as usize));
        let plain = |number: Option<u32>| {
            label(number).map(|found| &found.verdict).filter(|of| !matches!(of, Verdict::Periodic(_))).map(code)
        };
        a == b || (plain(a).is_some() && plain(a) == plain(b))
    }

    fn codes(notes: &Notes) -> Vec<i32> {
        notes.found.iter().map(|found| found.code).collect()
    }

    fn fields(&self) -> Vec<Field> {
        let quantities = self.asked().iter().map(|quantity| quantity::field(*quantity, &[]));
        let mut fields: Vec<Field> = quantities.collect();
        let number = |name: &'static str, long_name: &'static str, unit| Field::real(name, long_name, unit, &[]);
        if self.of_points() {
            fields.push(reason::field());
        }
        if self.of_systems() {
            fields.extend(MULTIPLIERS.map(|(name, long_name, _)| number(name, long_name, Unit::NUMBER)));
        }
        if self.transient() {
            let long_name = "impacts until the motion was decided";
            let flags = [(NOT_COMPUTED, "not_computed"), (-1, "taken_from_agreeing_neighbours")];
            fields.push(Field::integers("transient", long_name, NumberType::I32, &[], &flags));
        }
        if let Starts::Scattered { .. } = self.starts {
            fields.push(number("x", "position of the start", Unit::LENGTH));
            fields.push(number("v", "velocity of the start", Unit::VELOCITY));
            fields.push(number("phase", "phase of the force at the start", Unit::ANGLE));
        }
        fields
    }

    fn columns<'a>(
        &'a self,
        block: &Block,
        tile: &'a BasinTile<Self>,
        stored: &dyn Fn(&'a Verdict) -> &'a Verdict,
    ) -> Vec<Column> {
        let mut columns = self.quantities(tile, stored);
        columns.extend(self.details(tile));
        if let (Starts::Scattered { .. }, Some((osc, _))) = (&self.starts, &self.one) {
            let starts: Vec<Start> =
                (0..block.points()).map(|k| self.start(osc, &self.system, &block.index(k))).collect();
            for coordinate in [|s: &Start| s.x, |s: &Start| s.v, |s: &Start| s.phase] {
                columns.push(Column::F64(starts.iter().map(coordinate).collect()));
            }
        }
        columns
    }

    fn numbered(of: &BasinFill<Self>) -> Numbered<'_> {
        Numbered::Oscillator(of)
    }
}

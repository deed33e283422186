//! The tiles of a basin of a machine: for each start, the motion to which it leads.

use super::code;
use super::cycles::{self, Numbered, Numbering};
use super::fill::{self, Along, Fill, along, grid_between, machine_fields, on_axis, spread};
use super::map::{computed, computed_column, side};
use super::refine::{self, Cell};
use super::remarks;
use super::stored_motion::StoredMotion;
use crate::field::{Column, Field};
use crate::machine::StartAxis;
use crate::map::options;
use crate::quantity::values_of;
use crate::{BasinPlan, Block, Grid, PlanError};
use core::cell::RefCell;
use std::collections::BTreeMap;
use std::sync::OnceLock;
use vibroimpact::events::Start;
use vibroimpact::lanes::Width;
use vibroimpact::machine::Machine;
use vibroimpact::verdict::machine::Settlement;
use vibroimpact::verdict::{
    Census, CountedMotion, KnownMotions, SettleOptions, Verdict, settle_machine, settle_machine_many,
};

/// Default number of points of a tile along each of two axes, at least and at most; a start takes up to a second.
const TILE: (usize, usize) = (1, 16);
/// The same for a machine that is an oscillator, whose starts share lanes.
const WIDE_TILE: (usize, usize) = (16, 64);
/// Number of starts, spread over the grid, that are settled before the first tile is stored, to find the cycles.
const SURVEY: u64 = 48;
/// Number of starts whose cycles get trapping regions, if the machine is an oscillator and the grid has more than a few starts.
const TRAPS: u64 = 24;
const FEW: u64 = 500;

/// The starts of a machine over a grid.
pub(crate) struct MachineBasinFill {
    machine: Machine,
    start: Start,
    plan: BasinPlan<String, String>,
    places: Vec<StartAxis>,
    options: SettleOptions,
    grid: Grid,
    /// The cycles with trapping regions.
    known: KnownMotions,
    /// The cycles with the same numbers in all tiles; computed when the first tile is stored.
    survey: OnceLock<Vec<Verdict<Machine>>>,
}

/// The motions of one tile.
pub(crate) struct MachineBasinTile {
    /// The motions, in the order of the first start that leads to each.
    pub(crate) met: Census<Machine>,
    /// For each start the index of its motion in `met`; `None` for a start beyond a rigid stop.
    pub(crate) cells: Vec<Cell<Option<u32>>>,
    /// For each start that was computed and is chaotic, the number of events over which chaos was seen.
    pub(crate) seen: BTreeMap<usize, u64>,
}

/// The result of a start as it is stored: the code of its label and the number of its cycle.
type Leads = (i32, i32);

impl MachineBasinFill {
    pub(crate) fn new(
        (machine, start): (&Machine, &Start),
        plan: &BasinPlan<String, String>,
        tile: Option<u32>,
    ) -> Result<Self, PlanError> {
        let places = plan.axes.iter().map(|axis| StartAxis::of(machine, &axis.vary)).collect::<Result<_, _>>()?;
        let (least, most) = if machine.reduced().is_some() { WIDE_TILE } else { TILE };
        let grid = grid_between(&plan.axes, tile, (least, side(most, plan.axes.len())));
        let mut start = start.clone();
        start.q.resize(machine.n(), 0.0);
        start.qdot.resize(machine.n(), 0.0);
        let (machine, plan, options) = (machine.clone(), plan.clone(), options(plan.impacts));
        let (known, survey) = (KnownMotions::default(), OnceLock::new());
        let bare = Self { machine, start, plan, places, options, grid, known, survey };
        let traps = if bare.grid.points() > FEW { TRAPS } else { 0 };
        let known = KnownMotions::survey(&bare.machine, &bare.spread(traps), &bare.options);
        Ok(Self { known, ..bare })
    }

    /// So many starts, spread over the grid.
    fn spread(&self, count: u64) -> Vec<Start> {
        let whole = self.grid.whole();
        let start = |k| self.start(&whole.index(usize::try_from(k).unwrap_or(0)));
        spread(self.grid.points(), count).map(start).collect()
    }

    /// The motions of starts; `None` if stopped.
    fn many(&self, starts: &[Start], tick: &dyn Fn() -> bool) -> Option<Settlement> {
        settle_machine_many(&self.machine, starts, &self.known, &self.options, Width::best(), &|| true, tick)
    }

    /// The start at a point of the grid.
    fn start(&self, index: &[usize]) -> Start {
        let mut start = self.start.clone();
        for (k, (place, axis)) in self.places.iter().zip(&self.plan.axes).enumerate() {
            place.set(&mut start, axis.over.at(on_axis(index, k)));
        }
        start
    }

    /// The verdict on the start at a point of the grid; `None` beyond a rigid stop.
    pub(crate) fn settled(&self, index: &[usize]) -> Option<Verdict<Machine>> {
        let settled = settle_machine(&self.machine, &self.start(index), &self.options);
        settled.ok().map(|settled| settled.verdict)
    }

    /// The cycles of the survey. Every tile computes the same ones.
    fn survey(&self) -> &[Verdict<Machine>] {
        self.survey.get_or_init(|| {
            let mut census = Census::default();
            for found in self.many(&self.spread(SURVEY), &|| false).unwrap_or_default().motions {
                census.add_found(&found);
            }
            cycles::survey(&census)
        })
    }

    /// The stored result of each motion of a tile, and the cycles that the survey has not found.
    fn leads(&self, tile: &MachineBasinTile) -> (Vec<Leads>, Census<Machine>) {
        let (mut unknown, known) = (Census::default(), self.survey());
        let leads = |found: &CountedMotion<Machine>| (found.verdict.code(), cycles::number(known, &mut unknown, found));
        (tile.met.motions().iter().map(leads).collect(), unknown)
    }
}

impl Fill for MachineBasinFill {
    type Tile = MachineBasinTile;

    fn together(&self) -> u64 {
        fill::with_refinement(self.plan.refine, 1)
    }

    fn grid(&self) -> &Grid {
        &self.grid
    }

    fn grid_mut(&mut self) -> &mut Grid {
        &mut self.grid
    }

    fn coordinates(&self) -> Vec<Along> {
        along(&self.plan.axes)
    }

    fn fields(&self) -> Vec<Field> {
        let mut flags = code::FLAGS.to_vec();
        flags.push((super::REFUSED, "beyond_a_stop"));
        let label = Field { flags, ..code::field("motion m/n that the start leads to", Vec::new()) };
        let mut cycle = cycles::field(label.clone());
        cycle.flags.push((cycles::BEYOND, "beyond_a_stop"));
        let mut fields = vec![label, cycle];
        fields.extend(remarks::fields(self.machine.stops().len(), &[]));
        fields.extend(machine_fields(&self.plan.fields, &[]));
        if self.plan.refine.is_some() {
            fields.push(computed());
        }
        fields
    }

    fn compute(&self, block: &Block, tick: &(dyn Fn() -> bool + Sync)) -> Option<MachineBasinTile> {
        let (met, seen) = (RefCell::new(Census::default()), RefCell::new(BTreeMap::new()));
        let points = |wanted: &[usize]| {
            let starts: Vec<Start> = wanted.iter().map(|k| self.start(&block.index(*k))).collect();
            let found = self.many(&starts, &|| tick())?;
            let number = |motion| u32::try_from(met.borrow_mut().add_found(motion)).unwrap_or(u32::MAX);
            let numbers: Vec<u32> = found.motions.iter().map(number).collect();
            let events = wanted.iter().zip(&found.seen).filter_map(|(k, events)| Some((*k, (*events)?)));
            seen.borrow_mut().extend(events);
            Some(found.cells.iter().map(|cell| cell.map(|cell| numbers[cell as usize])).collect::<Vec<_>>())
        };
        let cells = match self.plan.refine {
            None => points(&(0..block.points()).collect::<Vec<_>>())?.into_iter().map(Cell::Computed).collect(),
            Some(step) => refine::fill(block, step as usize, points, |a, b| a == b)?,
        };
        Some(MachineBasinTile { met: met.into_inner(), cells, seen: seen.into_inner() })
    }

    fn columns(&self, _: &Block, tile: MachineBasinTile) -> Vec<Column> {
        let (leads, _) = self.leads(&tile);
        let number = |cell: &Cell<Option<u32>>| cell.result(&tile.cells).and_then(|(number, _)| *number);
        let numbers: Vec<Option<u32>> = tile.cells.iter().map(number).collect();
        let of =
            |number: &Option<u32>| number.map_or((super::REFUSED, cycles::BEYOND), |number| leads[number as usize]);
        let stored: Vec<Leads> = numbers.iter().map(of).collect();
        let mut columns = vec![
            Column::I32(stored.iter().map(|(label, _)| *label).collect()),
            Column::I32(stored.iter().map(|(_, cycle)| *cycle).collect()),
        ];
        let stops = self.machine.stops().len();
        let closed: Vec<Vec<usize>> = tile.met.motions().iter().map(|found| found.verdict.closed()).collect();
        let mut remarked = vec![Vec::with_capacity(numbers.len()); remarks::fields(stops, &[]).len()];
        for (k, number) in numbers.iter().enumerate() {
            let closed = number.map_or(&[][..], |number| &closed[number as usize]);
            let remarks = remarks::of(stops, closed, tile.seen.get(&k).copied());
            remarked.iter_mut().zip(remarks).for_each(|(column, remark)| column.push(remark));
        }
        columns.extend(remarked.into_iter().map(Column::I32));
        // those of a cycle that the survey has found are those of the survey, so that they are the same in all tiles
        let same = |found: &Verdict<Machine>| self.survey().iter().find(|known| cycles::same(*known, found));
        let motions = tile.met.motions().iter().map(|found| same(&found.verdict).unwrap_or(&found.verdict));
        let values: Vec<Vec<f64>> =
            motions.map(|verdict| values_of(&self.machine, verdict, &self.plan.fields)).collect();
        let mut fields = vec![Vec::with_capacity(numbers.len()); self.plan.fields.len()];
        for number in &numbers {
            let row = number.map(|number| &values[number as usize]);
            for (k, field) in fields.iter_mut().enumerate() {
                field.push(row.map_or(f64::NAN, |row| row[k]));
            }
        }
        columns.extend(fields.into_iter().map(Column::F64));
        if self.plan.refine.is_some() {
            columns.push(computed_column(&tile.cells));
        }
        columns
    }

    fn numbered(&self) -> Option<Numbered<'_>> {
        let unknown = |k: u64| {
            let tile = self.compute(&self.grid.tile(k), &|| false);
            tile.map(|tile| self.leads(&tile).1).unwrap_or_default()
        };
        let stops = self.machine.stops().iter().map(|stop| stop.name.clone()).collect();
        Some(Numbered::Machine(Numbering { field: 1, known: self.survey(), stops, unknown: Box::new(unknown) }))
    }
}

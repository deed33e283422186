//! The starts of a machine over a grid.

use super::{BasinFill, BasinTile, Basins};
use crate::field::{Column, Field};
use crate::machine::StartAxis;
use crate::map::options;
use crate::quantity::values_of;
use crate::study::cycles::Numbered;
use crate::study::fill::{Over, machine_fields, on_axis, spread};
use crate::study::map::side;
use crate::study::remarks;
use crate::{BasinPlan, Block, Grid, PlanError};
use std::collections::BTreeMap;
use vibroimpact::events::Start;
use vibroimpact::lanes::Width;
use vibroimpact::machine::Machine;
use vibroimpact::verdict::machine::Settlement;
use vibroimpact::verdict::{Census, KnownMotions, SettleOptions, Verdict, settle_machine_many};

/// Default number of points of a tile along each of two axes, at least and at most; a start takes up to a second.
const TILE: (usize, usize) = (1, 16);
/// The same for a machine that is an oscillator, whose starts share lanes.
const WIDE_TILE: (usize, usize) = (16, 64);
/// Number of starts, spread over the grid, that are settled before the first tile is stored, to find the cycles.
const SURVEY: u64 = 48;
/// Number of starts whose cycles get trapping regions, if the machine is an oscillator and the grid has more than a few starts.
const TRAPS: u64 = 24;
const FEW: u64 = 500;

/// The starts of a machine.
pub(crate) struct MachineBasin {
    machine: Machine,
    start: Start,
    plan: BasinPlan<String, String>,
    places: Vec<StartAxis>,
    options: SettleOptions,
    /// The cycles with trapping regions.
    known: KnownMotions,
}

impl BasinFill<MachineBasin> {
    pub(crate) fn of_machine(
        (machine, start): (&Machine, &Start),
        plan: &BasinPlan<String, String>,
        tile: Option<u32>,
    ) -> Result<Self, PlanError> {
        let places = plan.axes.iter().map(|axis| StartAxis::of(machine, &axis.vary)).collect::<Result<_, _>>()?;
        let (least, most) = if machine.reduced().is_some() { WIDE_TILE } else { TILE };
        let over = Over::axes(&plan.axes, tile, (least, side(most, plan.axes.len())));
        let (machine, start) = (machine.clone(), start.clone());
        let (plan, options) = (plan.clone(), options(plan.impacts));
        let bare = MachineBasin { machine, start, plan, places, options, known: KnownMotions::default() };
        let traps = if over.grid.points() > FEW { TRAPS } else { 0 };
        let known = KnownMotions::survey(&bare.machine, &bare.spread(&over.grid, traps), &bare.options);
        Ok(Self::new(MachineBasin { known, ..bare }, over))
    }
}

impl MachineBasin {
    /// So many starts, spread over the grid.
    fn spread(&self, grid: &Grid, count: u64) -> Vec<Start> {
        let whole = grid.whole();
        let start = |k| self.start(&whole.index(usize::try_from(k).unwrap_or(0)));
        spread(grid.points(), count).map(start).collect()
    }

    /// The motions of starts; `None` if stopped.
    fn many(&self, starts: &[Start], tick: &dyn Fn() -> bool) -> Option<Settlement> {
        settle_machine_many(&self.machine, starts, &self.known, &self.options, Width::best(), &|| true, tick)
    }

    /// The start at a point of the grid.
    pub(crate) fn start(&self, index: &[usize]) -> Start {
        let mut start = self.start.clone();
        for (k, (place, axis)) in self.places.iter().zip(&self.plan.axes).enumerate() {
            place.set(&mut start, axis.over.at(on_axis(index, k)));
        }
        start
    }
}

impl Basins for MachineBasin {
    type System = Machine;
    /// For each start that was computed and is chaotic, the number of events over which chaos was seen.
    type Notes = BTreeMap<usize, u64>;
    const ABREAST: u64 = 1;
    const REFUSES: bool = true;

    fn one_system(&self) -> bool {
        true
    }

    fn refine(&self) -> Option<u32> {
        self.plan.refine
    }

    fn survey(&self, grid: &Grid) -> Census<Machine> {
        let mut census = Census::default();
        for found in self.many(&self.spread(grid, SURVEY), &|| false).unwrap_or_default().motions {
            census.add_found(&found);
        }
        census
    }

    fn settle(
        &self,
        block: &Block,
        wanted: &[usize],
        (met, seen): &mut (Census<Machine>, Self::Notes),
        tick: &(dyn Fn() -> bool + Sync),
    ) -> Option<Vec<Option<u32>>> {
        let starts: Vec<Start> = wanted.iter().map(|k| self.start(&block.index(*k))).collect();
        let found = self.many(&starts, &|| tick())?;
        let number = |motion| u32::try_from(met.add_found(motion)).unwrap_or(u32::MAX);
        let numbers: Vec<u32> = found.motions.iter().map(number).collect();
        seen.extend(wanted.iter().zip(&found.seen).filter_map(|(k, events)| Some((*k, (*events)?))));
        Some(found.cells.iter().map(|cell| cell.map(|cell| numbers[cell as usize])).collect())
    }

    fn fields(&self) -> Vec<Field> {
        let mut fields = remarks::fields(self.machine.stops().len(), &[]);
        fields.extend(machine_fields(&self.plan.fields, &[]));
        fields
    }

    fn columns<'a>(
        &'a self,
        _: &Block,
        tile: &'a BasinTile<Self>,
        stored: &dyn Fn(&'a Verdict<Machine>) -> &'a Verdict<Machine>,
    ) -> Vec<Column> {
        let stops = self.machine.stops().len();
        let closed: Vec<Vec<usize>> = tile.met.motions().iter().map(|found| found.verdict.closed()).collect();
        let mut remarked = vec![Vec::with_capacity(tile.cells.len()); remarks::fields(stops, &[]).len()];
        for (k, number) in tile.numbers().enumerate() {
            let closed = number.map_or(&[][..], |number| &closed[number as usize]);
            let remarks = remarks::of(stops, closed, tile.notes.get(&k).copied());
            remarked.iter_mut().zip(remarks).for_each(|(column, remark)| column.push(remark));
        }
        let motions = tile.met.motions().iter().map(|found| stored(&found.verdict));
        let values: Vec<Vec<f64>> =
            motions.map(|verdict| values_of(&self.machine, verdict, &self.plan.fields)).collect();
        let mut fields = vec![Vec::with_capacity(tile.cells.len()); self.plan.fields.len()];
        for number in tile.numbers() {
            let row = number.map(|number| &values[number as usize]);
            for (k, field) in fields.iter_mut().enumerate() {
                field.push(row.map_or(f64::NAN, |row| row[k]));
            }
        }
        remarked.into_iter().map(Column::I32).chain(fields.into_iter().map(Column::F64)).collect()
    }

    fn stops(&self) -> Vec<String> {
        self.machine.stops().iter().map(|stop| stop.name.clone()).collect()
    }

    fn numbered(of: &BasinFill<Self>) -> Numbered<'_> {
        Numbered::Machine(of)
    }
}

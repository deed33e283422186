//! The tiles of a map of a machine: the motions at each point of a grid over numbers of the machine.

use super::code::code;
use super::fill::{Over, machine_fields, on_axis};
use super::map::{MapFill, Mapped, Motions, side};
use super::stored_motion::Stored;
use crate::field::{Extra, Field};
use crate::grid::Index;
use crate::machine::MachineSource;
use crate::map::options;
use crate::quantity::values_of;
use crate::{Axis, MapPlan, PlanError, Share, Unit};
use vibroimpact::events::Start;
use vibroimpact::lanes::Width;
use vibroimpact::machine::Machine;
use vibroimpact::verdict::{
    Census, CountedMotion, SettleOptions, Verdict, scattered_machine_starts, settle_each_machine,
};

/// Default number of points of a tile along each of two axes, at least and at most; the starts at a point take up to some seconds.
const TILE: (usize, usize) = (1, 8);
/// The same for machines that are oscillators, whose long motions share lanes.
const WIDE_TILE: (usize, usize) = (8, 32);

/// Machines over numbers.
pub(crate) struct MachinesOver {
    source: MachineSource,
    plan: MapPlan<String, String>,
    options: SettleOptions,
    /// Number of stops.
    stops: usize,
}

impl MapFill<MachinesOver> {
    pub(crate) fn of_machine(source: &MachineSource, plan: &MapPlan<String, String>, tile: Option<u32>) -> Self {
        let machine = source.machine().ok();
        let reduced = machine.as_ref().is_some_and(|machine| machine.reduced().is_some());
        let (least, most) = if reduced { WIDE_TILE } else { TILE };
        let over = Over::axes(&plan.axes, tile, (least, side(most, plan.axes.len())));
        let stops = machine.map_or(0, |machine| machine.stops().len());
        let mapped = MachinesOver { source: source.clone(), plan: plan.clone(), options: options(plan.impacts), stops };
        Self::of(mapped, over, plan.starts, plan.refine)
    }
}

impl MachinesOver {
    /// The description of the machine at a point.
    fn source<'a>(&'a self, index: &[usize]) -> Result<MachineSource, PlanError> {
        let value = |(k, axis): (usize, &'a Axis<String>)| (axis.vary.as_str(), axis.over.at(on_axis(index, k)));
        Ok(self.source.with_all(self.plan.axes.iter().enumerate().map(value))?)
    }

    /// The machine at a point, with its scattered starts.
    fn problem(&self, index: &[usize]) -> Result<(Machine, Vec<Start>), PlanError> {
        let machine = self.source(index)?.machine()?;
        let starts = (0..self.plan.starts).map(|k| scattered_machine_starts(&machine, self.plan.seed, k)).collect();
        Ok((machine, starts))
    }
}

impl Share {
    /// A motion of a machine to which this share of the starts leads.
    pub(crate) fn of_machine(machine: &Machine, verdict: &Verdict<Machine>, share: f64, fields: &[String]) -> Self {
        let cycle = Machine::stored_cycle(verdict);
        let fastest = if let Verdict::Periodic(cycle) = verdict { cycle.fastest() } else { f64::NAN };
        Self {
            label: verdict.label(),
            code: code(verdict),
            share,
            speed: fastest,
            multiplier: cycle.map_or(f64::NAN, |cycle| cycle.multiplier),
            stops: verdict.closed(),
            seen_events: verdict.seen_events(),
            by_stop: None,
            quantities: values_of(machine, verdict, fields),
        }
    }
}

impl Mapped for MachinesOver {
    const VELOCITY: Unit = Unit::CONSISTENT;

    fn motions(&self, points: &[Index], tick: &dyn Fn() -> bool) -> Option<Vec<Motions>> {
        let mut problems = Vec::new();
        let mut found: Vec<Motions> = Vec::with_capacity(points.len());
        for index in points {
            found.push(self.problem(index).map(|problem| {
                problems.push(problem);
                Vec::new()
            }));
            if found.last().is_some_and(Result::is_err) && tick() {
                return None;
            }
        }
        let settled = settle_each_machine(&problems, &self.options, Width::best(), &|| true, tick)?;
        let allowed = found.iter_mut().filter_map(|found| found.as_mut().ok());
        for (shares, ((machine, _), settlement)) in allowed.zip(problems.iter().zip(settled)) {
            // a start beyond a rigid stop has no motion
            let mut census = Census::default();
            settlement.motions.iter().for_each(|motion| {
                census.add_found(motion);
            });
            let share = |of: &CountedMotion<Machine>| {
                Share::of_machine(machine, &of.verdict, census.share(of), &self.plan.fields)
            };
            *shares = census.by_share().into_iter().map(share).collect();
        }
        Some(found)
    }

    fn remarked_stops(&self) -> Option<usize> {
        Some(self.stops)
    }

    fn quantities(&self, extra: &[Extra]) -> Vec<Field> {
        machine_fields(&self.plan.fields, extra)
    }
}

//! The tiles of a map of a machine: the motions at each point of a grid over numbers of the machine.

use super::code;
use super::fill::{Along, along_machine, machine_fields, machine_grid, on_axis};
use super::map::{MapFill, Mapped, Motions, side};
use super::remarks;
use super::stored_motion::StoredMotion;
use crate::field::{Extra, Field};
use crate::grid::Index;
use crate::machine::MachineSource;
use crate::machine_plan::{MachineMapPlan, MachineShare, values_of};
use crate::map::options;
use crate::{MachineAxis, PlanError, Unit};
use vibroimpact::machine::Machine;
use vibroimpact::verdict::{
    Census, CountedMotion, MachineVerdict, SettleOptions, scattered_machine_starts, settle_machine,
};

/// Default number of points of a tile along each of two axes; the starts at a point take up to some seconds.
const TILE: usize = 8;

/// Machines over numbers.
pub(crate) struct MachinesOver {
    source: MachineSource,
    plan: MachineMapPlan,
    options: SettleOptions,
    /// Number of stops.
    stops: usize,
}

impl MapFill<MachinesOver> {
    pub(crate) fn of_machine(source: &MachineSource, plan: &MachineMapPlan, tile: Option<u32>) -> Self {
        let grid = machine_grid(&plan.axes, tile, side(TILE, plan.axes.len()));
        let stops = source.machine().map_or(0, |machine| machine.stops().len());
        let mapped = MachinesOver { source: source.clone(), plan: plan.clone(), options: options(plan.impacts), stops };
        Self::of(mapped, grid, plan.starts, plan.refine)
    }
}

impl MachinesOver {
    /// The description of the machine at a point.
    fn source<'a>(&'a self, index: &[usize]) -> Result<MachineSource, PlanError> {
        let value = |(k, axis): (usize, &'a MachineAxis)| (axis, axis.over.at(on_axis(index, k)));
        MachineAxis::with_values(&self.source, self.plan.axes.iter().enumerate().map(value))
    }

    /// The motions at a point, the most frequent first.
    fn at(&self, index: &[usize]) -> Result<Vec<MachineShare>, PlanError> {
        let machine = self.source(index)?.machine()?;
        let mut census: Census<MachineVerdict> = Census::default();
        for k in 0..self.plan.starts {
            let start = scattered_machine_starts(&machine, self.plan.seed, k);
            // a start beyond a rigid stop has no motion
            if let Ok(settled) = settle_machine(&machine, &start, &self.options) {
                census.add(&settled.verdict);
            }
        }
        let motion = |found: &CountedMotion<MachineVerdict>| {
            MachineShare::of(&machine, &found.verdict, census.share(found), &self.plan.fields)
        };
        Ok(census.by_share().into_iter().map(motion).collect())
    }
}

impl MachineShare {
    /// A motion of a machine to which this share of the starts leads.
    pub(crate) fn of(machine: &Machine, verdict: &MachineVerdict, share: f64, fields: &[String]) -> Self {
        let cycle = verdict.stored_cycle();
        let fastest = if let MachineVerdict::Periodic(cycle) = verdict { cycle.fastest() } else { f64::NAN };
        Self {
            code: code::of_machine(verdict),
            share,
            speed: fastest,
            multiplier: cycle.map_or(f64::NAN, |cycle| cycle.multiplier),
            stops: verdict.closed(),
            seen_events: verdict.seen_events(),
            quantities: values_of(machine, verdict, fields),
        }
    }
}

impl Mapped for MachinesOver {
    type Motion = MachineShare;
    const VELOCITY: Unit = Unit::CONSISTENT;

    fn coordinates(&self) -> Vec<Along> {
        along_machine(&self.plan.axes)
    }

    fn motions(&self, points: &[Index], tick: &dyn Fn() -> bool) -> Option<Vec<Motions<Self>>> {
        points.iter().map(|index| (!tick()).then(|| self.at(index))).collect()
    }

    fn label(motion: &MachineShare) -> (i32, f64) {
        (motion.code, motion.share)
    }

    fn remarks(&self, extra: &[Extra]) -> Vec<Field> {
        remarks::fields(self.stops, extra)
    }

    fn remarked(&self, motion: &MachineShare) -> Vec<i32> {
        remarks::of(self.stops, &motion.stops, motion.seen_events)
    }

    fn quantities(&self, extra: &[Extra]) -> Vec<Field> {
        machine_fields(&self.plan.fields, extra)
    }

    fn numbers(&self, _: &[usize], motions: &[MachineShare]) -> Vec<Vec<f64>> {
        let of = |motion: &MachineShare| [vec![motion.speed, motion.multiplier], motion.quantities.clone()].concat();
        motions.iter().map(of).collect()
    }
}

//! The tiles of points of a machine: the motion at each point of its numbers and of its start.

use super::fill::{Over, along_points, dimension, machine_fields};
use super::map::{MapFill, Mapped, Motions};
use crate::field::{Extra, Field};
use crate::grid::{Grid, Index};
use crate::machine::{MachineSource, StartAxis};
use crate::map::options;
use crate::points::DIMENSION;
use crate::{ManyPlan, PlanError, Share, Unit};
use core::cell::Cell;
use vibroimpact::events::Start;
use vibroimpact::lanes::Width;
use vibroimpact::machine::Machine;
use vibroimpact::verdict::{CountedMotion, SettleOptions, settle_each_machine};

/// Default number of points of a tile, at least and at most; a point takes up to a second.
const TILE: (usize, usize) = (4, 64);
/// The same for machines that are oscillators, whose long motions share lanes.
const WIDE_TILE: (usize, usize) = (16, 4096);

/// A machine at points.
pub(crate) struct MachineAt {
    source: MachineSource,
    machine: Machine,
    start: Start,
    plan: ManyPlan<String>,
    /// Where each column stands in a start; `None` for a number of the machine.
    places: Vec<Option<StartAxis>>,
    options: SettleOptions,
}

impl MapFill<MachineAt> {
    pub(crate) fn of_points(
        source: &MachineSource,
        (machine, start): (&Machine, &Start),
        plan: &ManyPlan<String>,
        tile: Option<u32>,
    ) -> Result<Self, PlanError> {
        let places = plan.points.varied().map(|name| StartAxis::found(machine, &name)).collect::<Result<_, _>>()?;
        let sizes = if machine.reduced().is_some() { WIDE_TILE } else { TILE };
        let count = usize::try_from(plan.points.count()).unwrap_or(usize::MAX);
        let grid = Grid { dimensions: vec![dimension(DIMENSION, count, tile, sizes)] };
        let over = Over { grid, coordinates: along_points(&plan.points).collect() };
        let (source, machine, start) = (source.clone(), machine.clone(), start.clone());
        let (plan, options) = (plan.clone(), options(plan.impacts));
        Ok(Self::of(MachineAt { source, machine, start, plan, places, options }, over, 1, None))
    }
}

impl MachineAt {
    /// The machine and the start at point number `k`.
    fn problem(&self, k: usize) -> Result<(Machine, Start), PlanError> {
        let names: Vec<String> = self.plan.points.varied().collect();
        let values: Vec<(&str, Option<&StartAxis>, f64)> = (names.iter().zip(&self.places).enumerate())
            .map(|(column, (name, place))| (name.as_str(), place.as_ref(), self.plan.points.at(column, k)))
            .collect();
        if self.places.iter().any(Option::is_none) {
            return self.source.described_at(&values);
        }
        // the machine is the same at all points, and need not be read again
        let mut start = self.start.clone();
        for (_, place, value) in values {
            place.iter().for_each(|place| place.set(&mut start, value));
        }
        Ok((self.machine.clone(), start))
    }
}

impl Mapped for MachineAt {
    const VELOCITY: Unit = Unit::CONSISTENT;
    const SEVERAL: bool = false;

    /// Points of the same machine after each other are settled together.
    fn motions(&self, points: &[Index], tick: &dyn Fn() -> bool) -> Option<Vec<Motions>> {
        let mut problems: Vec<(Machine, Vec<Start>)> = Vec::new();
        let mut add = |(machine, start)| match problems.last_mut() {
            Some((last, starts)) if *last == machine => starts.push(start),
            _ => problems.push((machine, vec![start])),
        };
        let mut found: Vec<Motions> =
            points.iter().map(|index| self.problem(index[0]).map(&mut add).map(|()| Vec::new())).collect();
        // the points of a machine after its first, and those that are none, are counted at the end
        let told = Cell::new(0);
        let one = || {
            told.set(told.get() + 1);
            tick()
        };
        let settled = settle_each_machine(&problems, &self.options, Width::best(), &|| true, &one)?;
        if (told.get()..points.len()).any(|_| tick()) {
            return None;
        }
        let mut motions = problems.iter().zip(&settled).flat_map(|((machine, _), settled)| {
            let share = |of: &CountedMotion<Machine>| Share::of_machine(machine, &of.verdict, 1.0, &self.plan.fields);
            let shares: Vec<Share> = settled.motions.iter().map(share).collect();
            settled
                .cells
                .iter()
                .zip(&settled.seen)
                .map(move |(cell, seen)| cell.map(|cell| Share { seen_events: *seen, ..shares[cell as usize].clone() }))
        });
        // a start beyond a rigid stop has no motion
        for motion in found.iter_mut().filter_map(|found| found.as_mut().ok()) {
            motion.extend(motions.next().flatten());
        }
        Some(found)
    }

    fn remarked_stops(&self) -> Option<usize> {
        Some(self.machine.stops().len())
    }

    fn quantities(&self, extra: &[Extra]) -> Vec<Field> {
        machine_fields(&self.plan.fields, extra)
    }
}

#[cfg(test)]
mod tests {
    use crate::machine::MachineSource;
    use crate::{Control, Plan, PlanResults, Results, Task, run};
    use serde_json::json;

    /// A start that depends on a number that varies is that of each point.
    #[test]
    fn each_point_has_its_own_start() {
        let text = "start = { q = { mass = \"x0\" } }\n[parameters]\nx0 = 0\n[machine]\nbodies = { mass = 1 }\nfrequency = 0.769\n\
                    link = [{ between = [\"mass\", \"ground\"], stiffness = 1 }]\nforce = [{ at = \"mass\", sin = 1 }]\n\
                    stop = [{ name = \"stop\", at = \"mass\", gap = 0.75, restitution = 0.5 }]\n";
        let source = MachineSource::open(text).unwrap();
        let answered = |source: MachineSource, task: serde_json::Value| {
            let task: Task = serde_json::from_value(task).unwrap();
            match run(&Plan::new(source, task), &Control::default()) {
                Ok(PlanResults::Machine(found)) => found,
                other => panic!("{other:?}"),
            }
        };
        let starts = [0.0, -2.0, -0.7];
        let listed = json!({"settle_many": {"points": {"listed": [{"vary": "x0", "values": starts}]}}});
        let Results::Map(found) = answered(source.clone(), listed) else { panic!() };
        let many: Vec<_> = found.points.iter().map(|cell| cell[0].label.clone()).collect();
        let alone = starts.map(|x0| {
            let Results::Settle(found) = answered(source.with("x0", x0).unwrap(), json!({"settle": {}})) else {
                panic!()
            };
            found.verdict.label()
        });
        assert_eq!(many, alone);
        assert_ne!(alone[0], alone[1]);
    }
}

//! Which motion each of many machines and starts leads to: points of numbers and starts, listed or drawn from ranges.

use super::grid::{StartAxis, check_fields, none_twice};
use super::verdicts::tile;
use crate::machine::MachineSource;
use crate::map::{check_impacts, options};
use crate::{Control, ListedColumn, PlanError, PointsPlan, RegionMap, RunError, Share, limits, tiles};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use vibroimpact::events::MachineStart;
use vibroimpact::lanes::Width;
use vibroimpact::machine::Machine;
use vibroimpact::verdict::{CountedMotion, settle_each_machine};

/// Points of numbers of a machine and of its start.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "ManyPlan")]
pub struct ManyPlan<V = String> {
    /// The points. What varies is the path of a number of the machine, or `q.COORDINATE`, `qdot.COORDINATE` or `phase` of the
    /// start; what does not is that of the machine and of its start.
    pub points: PointsPlan<V>,
    /// Budget of events for each start: 1 to 1000000. 20000 when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub impacts: Option<u32>,
    /// Quantities of each motion to report beside its label, by path.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub fields: Vec<String>,
}

impl<V> ManyPlan<V> {
    /// The same with other names of what varies.
    pub(crate) fn named<W, E>(&self, name: &impl Fn(&V) -> Result<W, E>) -> Result<ManyPlan<W>, E> {
        let (points, fields) = (self.points.named(name)?, self.fields.clone());
        Ok(ManyPlan { points, impacts: self.impacts, fields })
    }
}

/// Maximum number of points, whose motions are in memory.
const MOST: u64 = 10_000_000;

impl ManyPlan<String> {
    /// Checks everything that can be checked without running the plan.
    ///
    /// # Errors
    /// [`PlanError`] names the first invalid value.
    pub fn check(&self, source: &MachineSource, machine: &Machine) -> Result<(), PlanError> {
        self.points.check_values()?;
        limits::check("points", self.points.count(), 1..=MOST)?;
        check_fields(machine, &self.fields)?;
        check_impacts(self.impacts)?;
        none_twice(self.points.varied())?;
        self.points.varied().try_for_each(|name| {
            if StartAxis::found(machine, &name)?.is_none() {
                source.number(&name)?;
            }
            Ok(())
        })
    }
}

/// The motion at each point; none where the numbers or the start are not allowed.
pub(super) fn many(
    source: &MachineSource,
    (machine, start): (&Machine, &MachineStart),
    plan: &ManyPlan<String>,
    control: &Control<'_>,
) -> Result<RegionMap<String, String>, RunError> {
    let count = plan.points.count();
    let column = |column| ListedColumn {
        vary: plan.points.vary(column),
        values: (0..usize::try_from(count).unwrap_or(0)).map(|k| plan.points.at(column, k)).collect(),
    };
    let columns: Vec<ListedColumn<String>> = (0..plan.points.width()).map(column).collect();
    let places = columns.iter().map(|column| StartAxis::found(machine, &column.vary)).collect::<Result<Vec<_>, _>>()?;
    let problem = |k: u64| {
        let at = usize::try_from(k).ok()?;
        let mut state = start.clone();
        let mut changes = Vec::new();
        for (column, place) in columns.iter().zip(&places) {
            match place {
                Some(place) => place.set(&mut state, column.values[at]),
                None => changes.push((column.vary.as_str(), column.values[at])),
            }
        }
        let there = if changes.is_empty() { machine.clone() } else { source.with_all(changes).ok()?.machine().ok()? };
        Some((there, state))
    };
    let shares = tiles(count, tile(machine), control, |range, tick| {
        let total = range.end - range.start;
        let found = settled(range.map(problem), plan, &|| !control.stopping());
        (0..total).all(|_| !tick());
        found
    })?;
    let shares = shares.into_iter().flatten().flatten();
    let points = shares.map(|share| share.into_iter().collect()).collect();
    Ok(RegionMap { axes: Vec::new(), columns, points, fields: plan.fields.clone() })
}

/// The motion at each of some points; `None` if stopped. Points of the same machine after each other are settled together.
fn settled(
    points: impl Iterator<Item = Option<(Machine, MachineStart)>>,
    plan: &ManyPlan<String>,
    go_on: &dyn Fn() -> bool,
) -> Option<Vec<Option<Share>>> {
    let mut problems: Vec<(Machine, Vec<MachineStart>)> = Vec::new();
    let mut allowed = Vec::new();
    for point in points {
        allowed.push(point.is_some());
        let Some((machine, start)) = point else { continue };
        match problems.last_mut() {
            Some((last, starts)) if *last == machine => starts.push(start),
            _ => problems.push((machine, vec![start])),
        }
    }
    let found = settle_each_machine(&problems, &options(plan.impacts), Width::best(), go_on, &|| false)?;
    let mut shares = problems.iter().zip(&found).flat_map(|((machine, _), found)| {
        let share = |motion: &CountedMotion<_>| Share::of_machine(machine, &motion.verdict, 1.0, &plan.fields);
        let shares: Vec<Share> = found.motions.iter().map(share).collect();
        let of = move |(cell, seen): (&Option<u32>, &Option<u64>)| {
            cell.map(|cell| Share { seen_events: *seen, ..shares[cell as usize].clone() })
        };
        found.cells.iter().zip(&found.seen).map(of)
    });
    Some(allowed.into_iter().map(|allowed| allowed.then(|| shares.next().flatten()).flatten()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{DrawnPoints, Plan, PointRange, PointRule, Results, Task, machine, run};

    fn settled(source: &MachineSource, points: PointsPlan<String>) -> RegionMap<String, String> {
        let fields = vec!["power".to_owned()];
        let task = Task::from(ManyPlan { points, impacts: None, fields });
        let plan = Plan::new(source.clone(), task);
        assert_eq!(Plan::from_text(&plan.to_toml()).unwrap(), plan);
        let Results::Machine(machine::Results::Map(found)) = run(&plan, &Control::default()).unwrap() else { panic!() };
        found
    }

    /// Each point is settled as it is alone; a start beyond a stop has no motion.
    #[test]
    fn points_are_those_of_single_questions() {
        let source = MachineSource::open("two-mass-hammer").unwrap();
        let over = [("frequency", 0.9, 1.3), ("q.head", -1.0, 0.4)].map(|(vary, from, to)| PointRange {
            vary: vary.to_owned(),
            from,
            to,
        });
        let drawn = DrawnPoints { rule: PointRule::Sobol, count: 24, seed: 3, over: over.to_vec() };
        let found = settled(&source, PointsPlan::Drawn(drawn));
        let columns = found.columns.clone();
        for (k, cell) in found.points.iter().enumerate() {
            let [frequency, head] = [0, 1].map(|column| columns[column].values[k]);
            let start = MachineStart { q: vec![0.0, head], qdot: vec![0.0; 2], ..MachineStart::default() };
            let there = source.with("frequency", frequency).unwrap().starting(&start);
            let alone = Plan::new(there, Task::Settle { start: None, impacts: None });
            let Results::Machine(machine::Results::Settle(alone)) = run(&alone, &Control::default()).unwrap() else {
                panic!()
            };
            assert_eq!(cell[0].label, alone.verdict.label(), "{k}");
            assert!(cell[0].quantities[0].is_finite());
        }
        let listed = |values: Vec<f64>| ListedColumn { vary: "q.head".to_owned(), values };
        let found = settled(&source, PointsPlan::Listed(vec![listed(vec![0.0, 9.0])]));
        assert!(found.points[0].len() == 1 && found.points[1].is_empty());
        let twice = PointsPlan::Listed(vec![listed(vec![0.0]), listed(vec![0.0])]);
        let plan = ManyPlan { points: twice, impacts: None, fields: Vec::new() };
        assert!(plan.check(&source, &source.machine().unwrap()).unwrap_err().to_string().contains("q.head"));
    }
}

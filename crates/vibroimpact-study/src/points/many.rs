//! Which motion each of many machines and starts leads to: points of numbers and starts, listed or drawn from ranges.

use crate::axis::none_twice;
use crate::machine::{MachineSource, StartAxis};
use crate::map::check_impacts;
use crate::name::renamed;
use crate::quantity::check_fields;
use crate::{PlanError, PointsPlan, limits};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use vibroimpact::machine::Machine;

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

renamed!(ManyPlan: names, parts points, others impacts fields);

/// Maximum number of points, whose motions are in memory.
const MOST: u64 = 10_000_000;

impl ManyPlan<String> {
    /// Checks everything that can be checked without running the plan.
    pub(crate) fn check(&self, source: &MachineSource, machine: &Machine) -> Result<(), PlanError> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Control, DrawnPoints, ListedColumn, Plan, PlanResults, PointRange, PointRule, RegionMap, Results, Task, run,
    };
    use vibroimpact::events::Start;

    fn settled(source: &MachineSource, points: PointsPlan<String>) -> RegionMap<String, String> {
        let fields = vec!["power".to_owned()];
        let task = Task::from(ManyPlan { points, impacts: None, fields });
        let plan = Plan::new(source.clone(), task);
        assert_eq!(Plan::from_text(&plan.to_toml()).unwrap(), plan);
        let PlanResults::Machine(Results::Map(found)) = run(&plan, &Control::default()).unwrap() else { panic!() };
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
            let start = Start { q: vec![0.0, head], qdot: vec![0.0; 2], ..Start::default() };
            let there = source.with("frequency", frequency).unwrap().starting(&start);
            let alone = Plan::new(there, Task::Settle { start: None, impacts: None });
            let PlanResults::Machine(Results::Settle(alone)) = run(&alone, &Control::default()).unwrap() else {
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

//! The border between the motions to which two starts lead, the motion on it, and the saddle to which that leads.

use crate::axis::Coordinate;
use crate::dynamics::{Dynamics, Setup};
use crate::map::{check_impacts, options};
use crate::name::renamed;
use crate::{Control, PlanError, RunError, StartPlan, Stopped, limits};
use serde::{Deserialize, Serialize};
use vibroimpact::edge::{Edge, EdgeError, EdgeOptions, edge_while};

/// The largest number of laps.
const MOST_LAPS: u32 = 10_000;

/// The border between the starts that lead to one motion and those that lead to others.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields, bound(serialize = "V: Serialize", deserialize = "V: Deserialize<'de>"))]
#[schemars(rename = "EdgePlan", bound = "V: schemars::JsonSchema + Serialize")]
pub struct EdgePlan<V = Coordinate> {
    /// The first start of an oscillator; at rest when absent. A machine has a start of its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start: Option<StartPlan>,
    /// The coordinates and velocities in which the second start differs from the first.
    pub other: Vec<PlacePlan<V>>,
    /// Forcing periods for which the motion on the border is followed at most, up to 10000; 200 when absent. Without forcing they
    /// are periods of the slowest free oscillation.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub laps: Option<u32>,
    /// Budget of impacts for each start, of a machine of events, 1 to 1000000; 20000 when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub impacts: Option<u32>,
}

/// A coordinate of a start, and its value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields, bound(serialize = "V: Serialize", deserialize = "V: Deserialize<'de>"))]
#[schemars(rename = "PlacePlan", bound = "V: schemars::JsonSchema + Serialize")]
pub struct PlacePlan<V = Coordinate> {
    /// `x` or `v` of an oscillator, `q.NAME` or `qdot.NAME` of a machine.
    pub coordinate: V,
    /// Its value.
    pub value: f64,
}

renamed!(EdgePlan: names, parts other, others start laps impacts);
renamed!(PlacePlan: names coordinate, parts, others value);

impl<V> EdgePlan<V> {
    /// The largest number of laps.
    #[must_use]
    pub fn laps(&self) -> u32 {
        self.laps.unwrap_or(EdgeOptions::default().laps)
    }

    /// The second start.
    fn second<D: Dynamics<Coordinate = V>>(&self, of: &Setup<'_, D>) -> Result<D::Start, PlanError> {
        if self.other.is_empty() {
            return Err(PlanError::refused(
                "a border lies between two starts, and the second start is missing\nhint: --other v=1 changes the velocity of the first start; of a machine --other qdot.NAME=1",
            ));
        }
        let place = |start: D::Start, one: &PlacePlan<V>| D::placed(&of.system, start, &one.coordinate, one.value);
        D::allowed(&of.system, self.other.iter().try_fold(of.start.clone(), place)?)
    }

    /// Checks everything that can be checked without running the plan.
    pub(crate) fn check<D: Dynamics<Coordinate = V>>(&self, of: &Setup<'_, D>) -> Result<(), PlanError> {
        limits::check("laps", self.laps(), 1..=MOST_LAPS)?;
        check_impacts(self.impacts)?;
        self.second(of).map(|_| ())
    }
}

/// Finds the border and follows the motion on it.
pub(crate) fn edge<D: Dynamics>(
    of: &Setup<'_, D>,
    plan: &EdgePlan<D::Coordinate>,
    control: &Control<'_>,
) -> Result<Edge<D::System>, RunError> {
    let options = EdgeOptions { laps: plan.laps(), settle: options(plan.impacts) };
    let found = edge_while(&of.system, &[of.start.clone(), plan.second(of)?], &options, &|| !control.stopping());
    found.map_err(|error| match error {
        EdgeError::Stopped => Stopped { done: 0, total: 1 }.into(),
        other => PlanError::Edge(other).into(),
    })
}

#[cfg(test)]
mod tests {
    use crate::{Control, Plan, PlanResults, Results, SystemPlan, Task, run};

    #[test]
    fn a_border_is_found() {
        let task = r#"{"edge":{"other":[{"coordinate":"x","value":-2.0}]}}"#;
        let plan =
            Plan::new(SystemPlan::from_inverse_beta(1.3, 0.75, 0.5), serde_json::from_str::<Task>(task).unwrap());
        let found = run(&plan, &Control::default()).unwrap();
        let PlanResults::Oscillator(Results::Edge(found)) = found else { panic!("an edge") };
        assert!((0.0..1.0).contains(&found.part) && found.saddle.is_some(), "{found:?}");
    }
}

//! The plan of a map: the parameters and the number of starts at each point.

use crate::axis::{self, Axis, Coordinate};
use crate::limits::{MOST_STARTS, starts};
use crate::machine::MachineSource;
use crate::name::Renamed;
use crate::quantity::{Quantity, check_fields};
use crate::{Parameter, PlanError, Span, SystemPlan, limits};
use serde::{Deserialize, Serialize};
use vibroimpact::Oscillator;
use vibroimpact::verdict::SettleOptions;

/// Maximum number of starts at one point. A thread keeps the verdicts on all starts of its point in memory.
const MOST_AT_A_POINT: u64 = 10_000_000;

/// The points of a map: a grid over two parameters or more, several starts each.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(
    deny_unknown_fields,
    bound(serialize = "V: Serialize, Q: Serialize", deserialize = "V: Deserialize<'de>, Q: Deserialize<'de>")
)]
#[schemars(rename = "MapPlan", bound = "V: schemars::JsonSchema + Serialize, Q: schemars::JsonSchema + Serialize")]
pub struct MapPlan<V = Coordinate, Q = Quantity> {
    /// What varies; the first runs fastest and is drawn to the right, the second upwards.
    pub axes: Vec<Axis<V>>,
    /// Starts per point: the first at rest, the second on the free motion if it clears the stops, the others scattered.
    pub starts: u64,
    /// Seed of their sequence; 0, of a machine 1, when absent.
    #[serde(default)]
    pub seed: u64,
    /// Where results are stored: compute every K-th point first, K being this number, and the points between only where neighbours
    /// differ. All of them when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub refine: Option<u32>,
    /// Budget of impacts for each start, of a machine of events, 1 to 1000000; 20000 when absent. Motions that have not settled by
    /// then are undecided.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub impacts: Option<u32>,
    /// Quantities of each motion to report beside its label.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub fields: Vec<Q>,
}

/// Maximum number of axes.
const MOST_AXES: usize = 4;
/// Maximum distance between the points of the coarse grid.
const MOST_REFINE: u32 = 64;

/// Checks the distance between the points of the coarse grid.
pub(crate) fn check_refine(refine: Option<u32>) -> Result<(), PlanError> {
    let hint = ": the distance, in points, of the coarse grid to begin with";
    limits::given("refine", refine, 2..=MOST_REFINE).map_err(|error| error.hinted(hint))
}

/// Maximum number of impacts for which a start is followed.
const MOST_IMPACTS: u32 = 1_000_000;

/// Checks the number of impacts for which each start is followed.
pub(crate) fn check_impacts(impacts: Option<u32>) -> Result<(), PlanError> {
    limits::given("impacts", impacts, 1..=MOST_IMPACTS)
}

/// The options with which each start is followed.
pub(crate) fn options(impacts: Option<u32>) -> SettleOptions {
    impacts.map_or_else(SettleOptions::default, SettleOptions::at_most)
}

impl<V, Q> MapPlan<V, Q> {
    /// The same with other names of what varies and of quantities.
    pub(crate) fn named<W, R, E>(
        &self,
        name: &impl Fn(&V) -> Result<W, E>,
        quantity: &impl Fn(&Q) -> Result<R, E>,
    ) -> Result<MapPlan<W, R>, E> {
        let Self { starts, seed, refine, impacts, .. } = self;
        let axes = self.axes.named(name)?;
        let fields = self.fields.iter().map(quantity).collect::<Result<_, E>>()?;
        Ok(MapPlan { axes, starts: *starts, seed: *seed, refine: *refine, impacts: *impacts, fields })
    }

    /// Total number of points.
    #[must_use]
    pub fn points(&self) -> u64 {
        axis::points(&self.axes)
    }
}

impl MapPlan {
    /// A map over inverse frequency ratio and gap, the plane of the 1971 paper.
    #[must_use]
    pub fn plane(inverse_beta: Span, gap: Span, starts: u64, seed: u64) -> Self {
        let axes = vec![Axis::parameter(Parameter::InverseBeta, inverse_beta), Axis::parameter(Parameter::Gap, gap)];
        Self { axes, starts, seed, refine: None, impacts: None, fields: Vec::new() }
    }

    /// Checks everything that can be checked without running the plan.
    pub(crate) fn check(&self, system: &SystemPlan) -> Result<(), PlanError> {
        if let Some(axis) = self.axes.iter().find(|axis| axis.vary.is_start()) {
            let (task, name) = ("map", axis.vary.name().into());
            return Err(PlanError::WrongAxis { task, name, known: "the parameters of the system" });
        }
        axis::check("map", &self.axes, (1, MOST_AXES))?;
        starts(self.starts, MOST_AT_A_POINT)?;
        check_refine(self.refine)?;
        check_impacts(self.impacts)?;
        for corner in axis::corners(&self.axes) {
            self.oscillator(system, |k| corner[k])?;
        }
        Ok(())
    }

    /// The oscillator at a point, given by its place on each axis. Other parameters are those of `system`.
    ///
    /// # Errors
    /// [`PlanError`] for a point that is no valid system.
    pub fn oscillator(&self, system: &SystemPlan, place: impl Fn(usize) -> usize) -> Result<Oscillator, PlanError> {
        axis::system_at(system, &self.axes, place)?.oscillator()
    }
}

impl MapPlan<String, String> {
    /// Checks everything that can be checked without running the plan.
    pub(crate) fn check(&self, source: &MachineSource) -> Result<(), PlanError> {
        axis::check("map", &self.axes, (1, MOST_AXES))?;
        for axis in &self.axes {
            source.number(&axis.vary)?;
        }
        check_fields(&source.machine()?, &self.fields)?;
        check_refine(self.refine)?;
        starts(self.starts, MOST_STARTS).and(check_impacts(self.impacts))
    }
}

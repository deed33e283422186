//! The plan of a basin: the starts and the systems.

use crate::axis::{self, Axis, Coordinate};
use crate::machine::StartAxis;
use crate::map::{check_impacts, check_refine};
use crate::name::Renamed;
use crate::quantity::{Quantity, check_fields};
use crate::{PlanError, PointsPlan, Span, StartPlan, SystemPlan};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use vibroimpact::machine::Machine;

/// The starts of a basin: a grid over coordinates of the start, and perhaps over parameters, or points of both.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(
    deny_unknown_fields,
    bound(serialize = "V: Serialize, Q: Serialize", deserialize = "V: Deserialize<'de>, Q: Deserialize<'de>")
)]
#[schemars(rename = "BasinPlan", bound = "V: schemars::JsonSchema + Serialize, Q: schemars::JsonSchema + Serialize")]
pub struct BasinPlan<V = Coordinate, Q = Quantity> {
    /// What varies; the first runs fastest and is drawn to the right, the second upwards.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub axes: Vec<Axis<V>>,
    /// Points of parameters and starts, each with the whole grid over the axes, if there are any axes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub points: Option<PointsPlan<V>>,
    /// The coordinates of an oscillator that are on no axis; at rest when absent. Those of a machine are in its start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start: Option<StartPlan>,
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
    /// Whether to report the number of impacts after which each motion was decided. Many starts of one system take longer
    /// then.
    #[serde(default, skip_serializing_if = "core::ops::Not::not")]
    pub transient: bool,
}

/// Maximum number of axes.
const MOST_AXES: usize = 4;

impl<V, Q> BasinPlan<V, Q> {
    /// The same with other names of what varies and of quantities.
    pub(crate) fn named<W, R, E>(
        &self,
        name: &impl Fn(&V) -> Result<W, E>,
        quantity: &impl Fn(&Q) -> Result<R, E>,
    ) -> Result<BasinPlan<W, R>, E> {
        let Self { start, refine, impacts, transient, .. } = self;
        let (axes, points) = (self.axes.named(name)?, self.points.named(name)?);
        let fields = self.fields.iter().map(quantity).collect::<Result<_, E>>()?;
        let (start, refine, impacts, transient) = (*start, *refine, *impacts, *transient);
        Ok(BasinPlan { axes, points, start, refine, impacts, fields, transient })
    }
}

impl<V: Clone + Into<Cow<'static, str>>, Q> BasinPlan<V, Q> {
    /// Total number of starts.
    #[must_use]
    pub fn starts(&self) -> u64 {
        let points = self.points.as_ref().map_or(1, PointsPlan::count);
        points.saturating_mul(axis::points(&self.axes))
    }
}

impl BasinPlan {
    /// The coordinates of the start that are on no axis.
    #[must_use]
    pub fn start(&self) -> StartPlan {
        self.start.unwrap_or_default()
    }

    /// A plane of positions and velocities at one phase.
    #[must_use]
    pub fn plane(x: Span, v: Span, phase: f64) -> Self {
        let axes = vec![Axis::new(Coordinate::X, x), Axis::new(Coordinate::V, v)];
        Self::usual(axes, None, StartPlan { phase, ..StartPlan::default() })
    }

    /// One start for each point.
    #[must_use]
    pub fn of_points(points: PointsPlan, start: StartPlan) -> Self {
        Self::usual(Vec::new(), Some(points), start)
    }

    fn usual(axes: Vec<Axis>, points: Option<PointsPlan>, start: StartPlan) -> Self {
        let (start, fields) = (Some(start), Vec::new());
        Self { axes, points, start, refine: None, impacts: None, fields, transient: false }
    }

    /// Checks everything that can be checked without running the plan.
    pub(crate) fn check(&self, system: &SystemPlan) -> Result<(), PlanError> {
        let counts = if self.points.is_some() { (0, MOST_AXES - 1) } else { (1, MOST_AXES) };
        axis::check("basin", &self.axes, counts)?;
        check_refine(self.refine)?;
        check_impacts(self.impacts)?;
        if let Some(points) = &self.points {
            if self.refine.is_some() {
                return Err(PlanError::refused("points have no neighbours, so nothing is between them to refine"));
            }
            axis::none_twice(points.varied().chain(self.axes.iter().map(|axis| axis.vary)))?;
            if points.one_system() && self.axes.is_empty() {
                let osc = system.oscillator()?;
                return points.check(system, &self.start(), |_, start| start.start(&osc).map(|_| ()));
            }
            return points.check(system, &self.start(), |there, start| self.corners(there, start));
        }
        if !self.axes.iter().any(|axis| axis.vary.is_start()) {
            return Err(PlanError::refused(
                "a basin needs an axis over x, v or phase\nhint: which motions there are at points of a plane of parameters is a map",
            ));
        }
        self.corners(system, &self.start())
    }

    /// Checks the corners of the grid over the axes, from a start of a system.
    fn corners(&self, system: &SystemPlan, start: &StartPlan) -> Result<(), PlanError> {
        if self.axes.is_empty() {
            return start.start(&system.oscillator()?).map(|_| ());
        }
        for corner in axis::corners(&self.axes) {
            let there = axis::system_at(system, &self.axes, |k| corner[k])?;
            let start = axis::start_at((system, &there), start, &self.axes, |k| corner[k]);
            start.start(&there.oscillator()?)?;
        }
        Ok(())
    }

    /// Whether all starts belong to one system, that is, no axis varies a parameter.
    pub(crate) fn one_system(&self) -> bool {
        let points = self.points.as_ref().is_none_or(PointsPlan::one_system);
        points && self.axes.iter().all(|axis| axis.vary.is_start())
    }
}

impl BasinPlan<String, String> {
    /// Checks everything that can be checked without running the plan.
    pub(crate) fn check(&self, machine: &Machine) -> Result<(), PlanError> {
        if self.points.is_some() || self.transient {
            let hint = "the task settle_many has points";
            return Err(PlanError::refused(format!("a basin of a machine has axes only\nhint: {hint}")));
        }
        axis::check("basin", &self.axes, (1, MOST_AXES))?;
        for axis in &self.axes {
            StartAxis::of(machine, &axis.vary)?;
        }
        check_fields(machine, &self.fields)?;
        check_refine(self.refine)?;
        check_impacts(self.impacts)
    }
}

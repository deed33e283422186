//! The tasks of machines.

use super::axis::MachineAxis;
use super::branch::MachineBranchPlan;
use super::curve::MachineCurvePlan;
use super::diagram::MachineDiagramPlan;
use super::grid::{MachineBasinPlan, MachineMapPlan};
use super::lyapunov::MachineLyapunovPlan;
use super::many::MachineManyPlan;
use super::margins::MachineMarginsPlan;
use super::response::MachineResponsePlan;
use super::simulate::{check, most_events};
use super::{orbits, verdicts};
use crate::machine::{MachineSource, Named, NumberText, StartText, VectorText};
use crate::map::check_impacts;
use crate::PlanError;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use vibroimpact::events::{MachineLimits, MachineMotion, MachineStart};
use vibroimpact::machine::Machine;

/// What is computed for a machine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum MachineTask {
    /// The events of a motion.
    Simulate {
        /// The largest number of events: 1 to 10000000. 100 when absent, or 1000000 with `periods`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        impacts: Option<u64>,
        /// The largest number of forcing periods, up to 1e9; no limit when absent.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        periods: Option<f64>,
    },
    /// What the motion settles into.
    Settle {
        /// Budget of events: 1 to 1000000. 20000 when absent.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        impacts: Option<u32>,
    },
    /// The steady motions to which scattered starts lead, and their shares.
    Attractors {
        /// The number of starts.
        starts: u64,
        /// Which sequence of starts.
        #[serde(default = "one")]
        seed: u64,
        /// Budget of events for each start: 1 to 1000000. 20000 when absent.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        impacts: Option<u32>,
    },
    /// All Lyapunov exponents of the motion, or at each point of a grid.
    Lyapunov(MachineLyapunovPlan),
    /// The orbits with a label, stable or not, from many guesses.
    Orbit {
        /// The label m/n.
        label: String,
    },
    /// A branch of orbits in one number, or along a line through two.
    Branch(MachineBranchPlan),
    /// A curve of an event of an orbit over two numbers.
    Curve(MachineCurvePlan),
    /// The motion at each of many points of numbers and starts.
    SettleMany(MachineManyPlan),
    /// How far a cycle is from the nearest event in each number.
    Margins(MachineMarginsPlan),
    /// A quantity of all motions over one number.
    Response(MachineResponsePlan),
    /// The motion to which each start of a grid leads.
    Basin(MachineBasinPlan),
    /// The motions at each point of a grid of numbers of the machine.
    Map(MachineMapPlan),
    /// The motion after its transient at each value of a number.
    Diagram(MachineDiagramPlan),
}

const fn one() -> u64 {
    1
}

impl MachineTask {
    /// A title in words, of a machine with this title.
    pub(crate) fn title(&self, name: &str) -> String {
        let over = |axes: &[MachineAxis]| axes.iter().map(|axis| axis.vary.as_str()).collect::<Vec<_>>().join(", ");
        match self {
            Self::Basin(basin) => format!("motions that starts lead to over {}: {name}", over(&basin.axes)),
            Self::Diagram(diagram) => format!("orbit diagram over {}: {name}", diagram.vary),
            Self::Response(response) => format!("response over {}: {name}", response.vary),
            Self::Map(map) => format!("motions over {}: {name}", over(&map.axes)),
            Self::Lyapunov(MachineLyapunovPlan { axes, .. }) if !axes.is_empty() => {
                format!("Lyapunov exponents over {}: {name}", over(axes))
            }
            _ => name.to_owned(),
        }
    }

    /// The amount of work and its unit, for tasks that report progress: `(400, "points")`.
    pub(crate) fn work(&self) -> Option<(u64, &'static str)> {
        match self {
            Self::Attractors { starts, .. } => Some((*starts, "starts")),
            Self::Basin(basin) => Some((MachineAxis::points(&basin.axes), "starts")),
            Self::Map(map) => Some((MachineAxis::points(&map.axes), "points")),
            Self::Response(response) => Some((response.motions(), "motions")),
            Self::SettleMany(many) => Some((many.points.count(), "points")),
            Self::Lyapunov(lyapunov) => match lyapunov.axes.as_slice() {
                [] => None,
                axes => Some((MachineAxis::points(axes), "points")),
            },
            Self::Diagram(diagram) => {
                Some(((diagram.over.count() as u64).saturating_mul(diagram.direction.runs()), "motions"))
            }
            _ => None,
        }
    }

    /// The number of events after which a simulation ends; `None` for other tasks.
    #[must_use]
    pub fn most_events(&self) -> Option<u64> {
        match self {
            Self::Simulate { impacts, periods } => Some(most_events(*impacts, *periods)),
            _ => None,
        }
    }

    /// The paths of the quantities that the task reports beside labels.
    #[must_use]
    pub fn fields(&self) -> &[String] {
        match self {
            Self::Basin(basin) => &basin.fields,
            Self::Map(map) => &map.fields,
            Self::SettleMany(many) => &many.fields,
            _ => &[],
        }
    }

    /// Whether the task fills a grid, which a store keeps.
    pub(crate) const fn fills_a_grid(&self) -> bool {
        match self {
            Self::Basin(_) | Self::Map(_) | Self::Diagram(_) => true,
            Self::Lyapunov(lyapunov) => !lyapunov.axes.is_empty(),
            _ => false,
        }
    }

    /// Checks everything that can be checked without running the task.
    ///
    /// # Errors
    /// [`PlanError`] names the first invalid value.
    pub(crate) fn check(&self, source: &MachineSource) -> Result<(), PlanError> {
        let (machine, _) = match self {
            Self::Map(_) | Self::Diagram(_) | Self::Response(_) | Self::SettleMany(_) => source.described()?,
            // each point has its own start
            Self::Lyapunov(MachineLyapunovPlan { axes, .. }) if !axes.is_empty() => source.described()?,
            _ => source.problem()?,
        };
        match self {
            Self::Simulate { impacts, periods } => check(&machine, (*impacts, *periods)),
            Self::Settle { impacts } => check_impacts(*impacts),
            Self::Attractors { starts, impacts, .. } => verdicts::check_starts(*starts, *impacts),
            Self::Lyapunov(lyapunov) => lyapunov.check(source, &machine),
            Self::Orbit { label } => orbits::label(&machine, label).map(|_| ()),
            Self::Branch(branch) => branch.check(source, &machine),
            Self::Curve(curve) => curve.check(source, &machine),
            Self::SettleMany(many) => many.check(source, &machine),
            Self::Margins(margins) => margins.check(source, &machine),
            Self::Response(response) => response.check(source, &machine),
            Self::Basin(basin) => basin.check(&machine),
            Self::Map(map) => map.check(source),
            Self::Diagram(diagram) => diagram.check(source),
        }
    }
}

impl MachineSource {
    /// The same machine with another start. Vectors that are empty are 0.
    #[must_use]
    pub fn starting(mut self, start: &MachineStart) -> Self {
        let vector = |values: &[f64]| {
            let list = values.iter().map(|value| NumberText::Value(*value)).collect();
            (!values.is_empty()).then_some(VectorText::List(list))
        };
        let phase = (start.phase != 0.0).then_some(NumberText::Value(start.phase));
        // contacts have names in a machine only; another file is refused later
        let contacts = if start.contacts.is_empty() { None } else { self.parts().ok() };
        let contacts = contacts.map(|parts| StartText::of(start, &parts).contacts).unwrap_or_default();
        let exact = Named(start.exact.clone());
        let text = StartText { q: vector(&start.q), qdot: vector(&start.qdot), phase, contacts, exact };
        self.start = (text != StartText::default()).then_some(text);
        self
    }

    /// The machine, checked, and the start, which may lie beyond a rigid stop. The tasks that vary a number have their own
    /// starts at each value.
    ///
    /// # Errors
    /// [`PlanError::Machine`] with the path of the first number that is not allowed.
    pub fn described(&self) -> Result<(Machine, MachineStart), PlanError> {
        Ok((self.machine()?, self.start()?.into()))
    }

    /// The machine and the start, both checked.
    ///
    /// # Errors
    /// [`PlanError::Machine`] with the path of the first number that is not allowed.
    pub fn problem(&self) -> Result<(Machine, MachineStart), PlanError> {
        let (machine, start) = self.described()?;
        let limits = MachineLimits::default();
        MachineMotion::new(&machine, &start, limits).map_err(|error| PlanError::Machine(error.into()))?;
        Ok((machine, start))
    }
}

//! A plan of a machine: everything on which a result depends, and nothing else.

use super::axis::MachineAxis;
use super::branch::MachineBranchPlan;
use super::curve::MachineCurvePlan;
use super::diagram::MachineDiagramPlan;
use super::grid::{MachineBasinPlan, MachineMapPlan};
use super::lyapunov::MachineLyapunovPlan;
use super::many::MachineManyPlan;
use super::margins::MachineMarginsPlan;
use super::region::MachineRegionPlan;
use super::response::MachineResponsePlan;
use super::simulate::{check, most_events};
use super::{orbits, verdicts};
use crate::machine::{MachineSource, Named, NumberText, StartText, VectorText};
use crate::map::check_impacts;
use crate::plan::{check_shard, check_tile, hash_of};
use crate::{PLAN_VERSION, PlanError};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use vibroimpact::events::{MachineLimits, MachineMotion, MachineStart};
use vibroimpact::machine::Machine;

/// A question about a machine.
///
/// ```
/// use vibroimpact_study::{Control, MachinePlan, MachineResults, run_machine};
/// let plan = MachinePlan::from_text(r#"
///     version = 1
///     [start]
///     q = [0.5]
///     [machine]
///     bodies = { ball = 1 }
///     constant = { ball = -1 }
///     stop = [{ name = "floor", between = ["ground", "ball"], gap = 0, restitution = 0.5 }]
///     [task.simulate]
///     impacts = 3
/// "#, vibroimpact_study::machine::no_files)?;
/// let MachineResults::Simulate(found) = run_machine(&plan, &Control::default())? else { unreachable!() };
/// assert_eq!(found.events.iter().map(|event| event.time).collect::<Vec<_>>(), [1.0, 2.0, 2.5]);
/// assert_eq!(MachinePlan::from_text(&plan.to_toml(), vibroimpact_study::machine::no_files)?, plan);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "super::text::MachinePlanText", into = "super::text::MachinePlanText")]
pub struct MachinePlan {
    /// The version of the fields, [`PLAN_VERSION`].
    pub version: u32,
    /// The machine as it is written. Its table `[start]` is where the motion starts; at rest at 0 when absent.
    pub machine: MachineSource,
    /// What is computed.
    pub task: MachineTask,
    /// Points of a tile along each axis, where results are stored; each task has a size of its own when absent.
    pub tile: Option<u32>,
    /// Tiles of a shard along each axis, where results are stored; 1 for no shards. When absent, a store has shards if it
    /// has more than 4096 tiles.
    pub shard: Option<u32>,
}

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
    /// Where in a plane of two numbers a motion exists, and where it is stable.
    Region(MachineRegionPlan),
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

impl MachinePlan {
    /// A plan of the current version.
    #[must_use]
    pub const fn new(machine: MachineSource, task: MachineTask) -> Self {
        Self { version: PLAN_VERSION, machine, task, tile: None, shard: None }
    }

    /// The same plan with another start. Vectors that are empty are 0.
    #[must_use]
    pub fn starting(mut self, start: &MachineStart) -> Self {
        let vector = |values: &[f64]| {
            let list = values.iter().map(|value| NumberText::Value(*value)).collect();
            (!values.is_empty()).then_some(VectorText::List(list))
        };
        let phase = (start.phase != 0.0).then_some(NumberText::Value(start.phase));
        // contacts have names in a machine only; another file is refused later
        let contacts = if start.contacts.is_empty() { None } else { self.machine.parts().ok() };
        let contacts = contacts.map(|parts| StartText::of(start, &parts).contacts).unwrap_or_default();
        let exact = Named(start.exact.clone());
        let text = StartText { q: vector(&start.q), qdot: vector(&start.qdot), phase, contacts, exact };
        self.machine.start = (text != StartText::default()).then_some(text);
        self
    }

    /// An identifier of the content: the first 16 digits of the SHA-256 of the plan as JSON.
    #[must_use]
    pub fn hash(&self) -> String {
        hash_of(self)
    }

    /// A title in words.
    #[must_use]
    pub fn title(&self) -> String {
        let name = self.machine.title.as_deref().unwrap_or("a machine");
        let over = |axes: &[MachineAxis]| axes.iter().map(|axis| axis.vary.as_str()).collect::<Vec<_>>().join(", ");
        match &self.task {
            MachineTask::Basin(basin) => format!("motions that starts lead to over {}: {name}", over(&basin.axes)),
            MachineTask::Diagram(diagram) => format!("orbit diagram over {}: {name}", diagram.vary),
            MachineTask::Region(MachineRegionPlan { label, across, up, .. }) => {
                format!("region of {} over {}, {}: {name}", label.trim(), across.path, up.path)
            }
            MachineTask::Response(response) => format!("response over {}: {name}", response.vary),
            MachineTask::Map(map) => format!("motions over {}: {name}", over(&map.axes)),
            MachineTask::Lyapunov(MachineLyapunovPlan { axes, .. }) if !axes.is_empty() => {
                format!("Lyapunov exponents over {}: {name}", over(axes))
            }
            _ => name.to_owned(),
        }
    }

    /// The amount of work and its unit, for tasks that report progress: `(400, "points")`.
    #[must_use]
    pub fn work(&self) -> Option<(u64, &'static str)> {
        match &self.task {
            MachineTask::Attractors { starts, .. } => Some((*starts, "starts")),
            MachineTask::Basin(basin) => Some((MachineAxis::points(&basin.axes), "starts")),
            MachineTask::Map(map) => Some((MachineAxis::points(&map.axes), "points")),
            MachineTask::Region(_) => Some((2, "regions")),
            MachineTask::Response(response) => Some((response.motions(), "motions")),
            MachineTask::SettleMany(many) => Some((many.points.count(), "points")),
            MachineTask::Lyapunov(lyapunov) => match lyapunov.axes.as_slice() {
                [] => None,
                axes => Some((MachineAxis::points(axes), "points")),
            },
            MachineTask::Diagram(diagram) => {
                Some(((diagram.over.count() as u64).saturating_mul(diagram.direction.runs()), "motions"))
            }
            _ => None,
        }
    }

    /// The number of events after which a simulation ends; `None` for other tasks.
    #[must_use]
    pub fn most_events(&self) -> Option<u64> {
        match self.task {
            MachineTask::Simulate { impacts, periods } => Some(most_events(impacts, periods)),
            _ => None,
        }
    }

    /// The paths of the quantities that the task reports beside labels.
    #[must_use]
    pub fn fields(&self) -> &[String] {
        match &self.task {
            MachineTask::Basin(basin) => &basin.fields,
            MachineTask::Map(map) => &map.fields,
            MachineTask::SettleMany(many) => &many.fields,
            _ => &[],
        }
    }

    /// Whether the task fills a grid, which a store keeps.
    #[must_use]
    pub const fn fills_a_grid(&self) -> bool {
        match &self.task {
            MachineTask::Basin(_) | MachineTask::Map(_) | MachineTask::Diagram(_) => true,
            MachineTask::Lyapunov(lyapunov) => !lyapunov.axes.is_empty(),
            _ => false,
        }
    }

    /// The plan as JSON.
    #[must_use]
    pub fn json(&self) -> String {
        // finite numbers and texts can always be written as JSON
        serde_json::to_string(self).unwrap_or_default()
    }

    /// The start, with a number for each coordinate and velocity.
    ///
    /// # Errors
    /// [`PlanError::Machine`] with the path of the first number that has no meaning.
    pub fn start(&self) -> Result<MachineStart, PlanError> {
        Ok(self.machine.start()?.into())
    }

    /// The machine, checked, and the start, which may lie beyond a rigid stop. The tasks that vary a number have their own
    /// starts at each value.
    ///
    /// # Errors
    /// [`PlanError::Machine`] with the path of the first number that is not allowed.
    pub fn described(&self) -> Result<(Machine, MachineStart), PlanError> {
        Ok((self.machine.machine()?, self.start()?))
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

    /// Checks everything that can be checked without running the plan.
    ///
    /// # Errors
    /// [`PlanError`] names the first invalid value.
    pub fn check(&self) -> Result<(), PlanError> {
        if self.version != PLAN_VERSION {
            return Err(PlanError::Version(self.version));
        }
        check_tile(self.tile)?;
        check_shard(self.shard)?;
        let (machine, _) = match &self.task {
            MachineTask::Map(_)
            | MachineTask::Diagram(_)
            | MachineTask::Region(_)
            | MachineTask::Response(_)
            | MachineTask::SettleMany(_) => self.described()?,
            // each point has its own start
            MachineTask::Lyapunov(MachineLyapunovPlan { axes, .. }) if !axes.is_empty() => self.described()?,
            _ => self.problem()?,
        };
        match &self.task {
            MachineTask::Simulate { impacts, periods } => check(&machine, (*impacts, *periods)),
            MachineTask::Settle { impacts } => check_impacts(*impacts),
            MachineTask::Attractors { starts, impacts, .. } => verdicts::check_starts(*starts, *impacts),
            MachineTask::Lyapunov(lyapunov) => lyapunov.check(&self.machine, &machine),
            MachineTask::Orbit { label } => orbits::label(&machine, label).map(|_| ()),
            MachineTask::Branch(branch) => branch.check(&self.machine, &machine),
            MachineTask::Curve(curve) => curve.check(&self.machine, &machine),
            MachineTask::SettleMany(many) => many.check(&self.machine, &machine),
            MachineTask::Margins(margins) => margins.check(&self.machine, &machine),
            MachineTask::Region(region) => region.check(&self.machine),
            MachineTask::Response(response) => response.check(&self.machine, &machine),
            MachineTask::Basin(basin) => basin.check(&machine),
            MachineTask::Map(map) => map.check(&self.machine),
            MachineTask::Diagram(diagram) => diagram.check(&self.machine),
        }
    }
}

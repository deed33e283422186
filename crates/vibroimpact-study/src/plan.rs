//! A plan: everything on which a result depends, and nothing else.
//!
//! Threads, output files and progress reports are not part of a plan. Each absent field has one meaning, which is
//! documented here. Unknown fields are errors, so a misspelt parameter is not ignored.

use crate::dynamics::Dynamics;
use crate::limits::{self, MOST_STARTS, PLAN_VERSION, starts};
use crate::machine::MachineSource;
use crate::map::check_impacts;
use crate::name::{Name, Variable};
use crate::{Axis, Parameter, PlanError, PointsPlan, RegionPlan, System, SystemPlan, Task, UnitsPlan};
use serde::Serialize;

/// A question: a system and a task.
///
/// ```
/// use vibroimpact_study::{Control, Plan, PlanResults, Results, run};
/// let plan = Plan::from_text(r#"
///     version = 1
///     [start]
///     q = [0.5]
///     [machine]
///     bodies = { ball = 1 }
///     constant = { ball = -1 }
///     stop = [{ name = "floor", between = ["ground", "ball"], gap = 0, restitution = 0.5 }]
///     [task.simulate]
///     impacts = 3
/// "#)?;
/// let PlanResults::Machine(Results::Simulate(found)) = run(&plan, &Control::default())? else { unreachable!() };
/// assert_eq!(found.events.iter().map(|event| event.time).collect::<Vec<_>>(), [1.0, 2.0, 2.5]);
/// assert_eq!(Plan::from_text(&plan.to_toml())?, plan);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The version of the fields, [`PLAN_VERSION`].
    pub version: u32,
    /// The system. What varies on an axis over an oscillator has its first value here, and need not be written; for a
    /// region, what varies has its smallest value.
    pub system: System,
    /// The task that is computed for the system.
    pub task: Task,
    /// Points of a tile along each axis, where results are stored; each task has a size of its own when absent.
    pub tile: Option<u32>,
    /// Tiles of a shard along each axis, where results are stored; 1 for no shards. When absent, a store has shards if it
    /// has more than 4096 tiles.
    pub shard: Option<u32>,
    /// The physical units in which results are reported; nondimensional when absent. Numbers of the plan are
    /// nondimensional, in these units, unless their names end in a unit. A machine has the units of its numbers.
    pub units: Option<UnitsPlan>,
}

/// Maximum number of points of a tile along one axis.
const MOST_TILE: u32 = 4096;

/// The first 16 digits of the SHA-256 of a plan as JSON.
pub(crate) fn hash_of(plan: &impl Serialize) -> String {
    // finite numbers and texts can always be written as JSON
    let text = serde_json::to_vec(plan).unwrap_or_default();
    hmac_sha256::Hash::hash(&text).iter().take(8).map(|byte| format!("{byte:02x}")).collect()
}

/// Maximum number of tiles of a shard along one axis.
const MOST_SHARD: u32 = 1024;

impl Plan {
    /// A plan of the current version.
    #[must_use]
    pub fn new(system: impl Into<System>, task: impl Into<Task>) -> Self {
        Self { version: PLAN_VERSION, system: system.into(), task: task.into(), tile: None, shard: None, units: None }
    }

    /// The oscillator; `None` for a machine.
    #[must_use]
    pub const fn oscillator(&self) -> Option<&SystemPlan> {
        self.system.oscillator()
    }

    /// The machine; `None` for an oscillator.
    #[must_use]
    pub fn machine(&self) -> Option<&MachineSource> {
        self.system.machine()
    }

    /// Whether the task fills a grid over axes, which a store keeps.
    #[must_use]
    pub const fn fills_a_grid(&self) -> bool {
        self.task.fills_a_grid()
    }

    /// An identifier of the content: the first 16 digits of the SHA-256 of the plan as JSON.
    #[must_use]
    pub fn hash(&self) -> String {
        hash_of(self)
    }

    /// A title in words.
    #[must_use]
    pub fn title(&self) -> String {
        match &self.system {
            System::Oscillator(_) => self.task.title_of_oscillator(),
            System::Machine(machine) => self.task.title_of_machine(machine.title.as_deref().unwrap_or("a machine")),
        }
    }

    /// The same question as the command of its task writes it: parameters on an axis have their first value in the
    /// system, and the number of impacts is explicit.
    ///
    /// # Errors
    /// [`PlanError`] for a parameter of a second stop if there is none.
    pub fn complete(&self) -> Result<Self, PlanError> {
        let mut plan = self.canonical()?;
        match &mut plan.task {
            Task::Simulate(plan) => plan.impacts = Some(plan.most_impacts()),
            Task::Region(region) => {
                if let System::Oscillator(system) = &mut plan.system {
                    let RegionPlan { across: p, up: q, .. } = region.typed::<Parameter>()?;
                    *system = system.with(p.parameter, p.from)?.with(q.parameter, q.from)?;
                }
            }
            _ => {}
        }
        Ok(plan)
    }

    /// The amount of work and its unit, for tasks that report progress: `(40000, "starts")`.
    #[must_use]
    pub fn work(&self) -> Option<(u64, &'static str)> {
        match &self.task {
            // exponents over axes of an oscillator are a study only
            Task::Lyapunov(lyapunov) if self.machine().is_some() && !lyapunov.axes.is_empty() => {
                Some((crate::axis::points(&lyapunov.axes), "points"))
            }
            task => task.work(),
        }
    }

    /// Checks everything that can be checked without running the plan.
    ///
    /// # Errors
    /// [`PlanError`] names the first invalid value.
    pub fn check(&self) -> Result<(), PlanError> {
        if self.version != PLAN_VERSION {
            return Err(PlanError::Version(self.version));
        }
        limits::given("tile", self.tile, 1..=MOST_TILE)?;
        limits::given("shard", self.shard, 1..=MOST_SHARD)?;
        match &self.system {
            System::Oscillator(system) => {
                if let Some(units) = &self.units {
                    units.check(system)?;
                }
                self.task.check(system)
            }
            System::Machine(machine) => self.task.check(&**machine),
        }
    }
}

impl Task {
    fn title_of_oscillator(&self) -> String {
        match self {
            Self::Map(map) => format!("motions of an impact oscillator over {}", over(&map.axes, ", ")),
            Self::Basin(basin) => {
                let points = basin.points.iter().flat_map(PointsPlan::varied);
                let all = points.chain(basin.axes.iter().map(|axis| axis.vary.clone()));
                let names: Vec<String> = all.map(|varied| varied.text().to_owned()).collect();
                let points = if basin.points.is_some() { "points of " } else { "" };
                format!("motions an impact oscillator settles into over {points}{}", names.join(", "))
            }
            Self::Attractors { .. } => "motions an impact oscillator settles into from scattered starts".to_owned(),
            Self::Diagram(diagram) => {
                let also = diagram.also.as_ref().map(|also| format!(" and {}", also.parameter.text()));
                let also = also.unwrap_or_default();
                format!("orbit diagram of an impact oscillator over {}{also}", diagram.vary.text())
            }
            Self::Lyapunov(_) => "Lyapunov exponents of an impact oscillator".to_owned(),
            _ => "an impact oscillator".to_owned(),
        }
    }

    fn title_of_machine(&self, name: &str) -> String {
        match self {
            Self::Basin(basin) => format!("motions that starts lead to over {}: {name}", over(&basin.axes, ", ")),
            Self::Diagram(diagram) => format!("orbit diagram over {}: {name}", diagram.vary.text()),
            Self::Response(response) => format!("response over {}: {name}", response.vary.text()),
            Self::Map(map) => format!("motions over {}: {name}", over(&map.axes, ", ")),
            Self::SettleMany(many) => {
                let names: Vec<String> = many.points.varied().map(|varied| varied.text().to_owned()).collect();
                format!("motions over points of {}: {name}", names.join(", "))
            }
            Self::Lyapunov(lyapunov) if !lyapunov.axes.is_empty() => {
                format!("Lyapunov exponents over {}: {name}", over(&lyapunov.axes, ", "))
            }
            _ => name.to_owned(),
        }
    }

    /// Checks the task of a system.
    fn check<D: Dynamics>(&self, system: &D) -> Result<(), PlanError> {
        let of = system.setup_of(self)?;
        match self {
            Self::Simulate(plan) => plan.check(),
            Self::Settle { impacts, .. } => check_impacts(*impacts),
            Self::Attractors { starts: given, impacts, .. } => starts(*given, MOST_STARTS).and(check_impacts(*impacts)),
            Self::Orbit { label } => of.check_orbit((Some(label), None), false),
            Self::Branch(plan) => plan.typed::<D::Name>()?.check(&of),
            Self::Curve(plan) => plan.typed::<D::Name>()?.check(&of),
            Self::Region(plan) => plan.typed::<D::Name>()?.check(&of),
            Self::Response(plan) => plan.typed::<D::Name, D::Quantity>()?.check(&of),
            Self::Edge(plan) => plan.typed::<D::Coordinate>()?.check(&of),
            _ => Ok(()),
        }?;
        D::check_own(&of, self)
    }
}

/// The names of axes.
fn over(axes: &[Axis<Variable>], between: &str) -> String {
    axes.iter().map(|axis| axis.vary.text()).collect::<Vec<_>>().join(between)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{BasinPlan, Parameter, SimulatePlan, Stretch};

    const SYSTEM: SystemPlan = SystemPlan::from_inverse_beta(1.3, 0.75, 0.5);

    fn plan() -> Plan {
        let basin = BasinPlan::plane("-3:0.75:4".parse().unwrap(), "-1:1:3".parse().unwrap(), 0.0);
        Plan::new(SYSTEM, basin)
    }

    #[test]
    fn a_plan_is_completed_as_the_command_writes_it() {
        let complete = Plan { task: simulate(None, Some(3.0)), ..plan() }.complete().unwrap().task;
        let Task::Simulate(SimulatePlan { impacts: Some(1_000_000), periods: Some(3.0), .. }) = complete else {
            panic!("{complete:?}")
        };
        let over = |parameter, from, to| Stretch { parameter, from, to };
        let (across, up) = (over(Parameter::Beta, 0.5, 0.6), over(Parameter::Gap, -1.0, 2.0));
        let region = Task::from(RegionPlan { label: "1/1".into(), across, up, grid: 3 });
        let region = Plan { task: region, ..plan() };
        let complete = region.complete().unwrap();
        let system = complete.oscillator().unwrap();
        assert_eq!((system.beta, system.inverse_beta, system.gap), (Some(0.5), None, -1.0));
        assert_eq!(region.work(), Some((2, "regions")));
    }

    fn simulate(impacts: Option<u64>, periods: Option<f64>) -> Task {
        Task::Simulate(SimulatePlan { impacts, periods, ..SimulatePlan::default() })
    }
}

//! The tasks: what is computed for a system. What varies is a name, which each task reads as that of a number of its system.

use crate::diagram::ShowText;
use crate::name::{Name, Renamed, Variable};
use crate::{
    BasinPlan, BranchPlan, CurvePlan, DiagramPlan, EdgePlan, LyapunovPlan, ManyPlan, MapPlan, MarginsPlan, PlanError,
    RegionPlan, ResponsePlan, SimulatePlan, StartPlan,
};
use core::convert::Infallible;
use serde::{Deserialize, Serialize};

/// A task: what is computed for a system.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Task {
    /// The events of a motion.
    Simulate(SimulatePlan),
    /// What a motion settles into.
    Settle {
        /// Where an oscillator starts; at rest when absent.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        start: Option<StartPlan>,
        /// Budget of impacts, of a machine of events, 1 to 1000000; 20000 when absent. A motion that has not settled by then is
        /// undecided.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        impacts: Option<u32>,
    },
    /// The motions that scattered starts settle into, and their shares.
    Attractors {
        /// Number of starts, 1 to 1000000000.
        starts: u64,
        /// Seed of their sequence.
        #[serde(default = "one")]
        seed: u64,
        /// Budget of impacts for each start, of a machine of events, 1 to 1000000; 20000 when absent. Motions that have not
        /// settled by then are undecided.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        impacts: Option<u32>,
    },
    /// The periodic orbits of a label.
    Orbit {
        /// m/n, or m/T of a machine without forcing.
        label: String,
    },
    /// Which motion each start of a plane leads to.
    Basin(BasinPlan<Variable, String>),
    /// Which motions there are at each point of a parameter plane.
    Map(MapPlan<Variable, String>),
    /// The motion after its transient at each value of a parameter.
    Diagram(DiagramPlan<Variable, ShowText>),
    /// The Lyapunov exponents of a motion.
    Lyapunov(LyapunovPlan<Variable>),
    /// A branch of periodic orbits in one parameter.
    Branch(BranchPlan<Variable>),
    /// A curve of events in two.
    Curve(CurvePlan<Variable>),
    /// Where a motion exists and is stable in a plane of two.
    Region(RegionPlan<Variable>),
    /// A quantity of all motions over one parameter.
    Response(ResponsePlan<Variable, String>),
    /// The motion of a machine at each of many points of its numbers and starts. Points of an oscillator are a basin.
    SettleMany(ManyPlan<Variable>),
    /// The distances of a motion from its nearest events.
    Margins(MarginsPlan<Variable>),
    /// The border between the starts of two motions, and the saddle on it.
    Edge(EdgePlan<Variable>),
}

const fn one() -> u64 {
    1
}

impl Task {
    /// The amount of work and its unit, for tasks that report progress: `(40000, "starts")`.
    pub(crate) fn work(&self) -> Option<(u64, &'static str)> {
        match self {
            Self::Attractors { starts, .. } => Some((*starts, "starts")),
            Self::Basin(basin) => Some((basin.starts(), "starts")),
            Self::Map(map) => Some((map.points(), "points")),
            Self::Diagram(diagram) => Some(((diagram.over.count() as u64).saturating_mul(diagram.runs()), "motions")),
            Self::Region(_) => Some((2, "regions")),
            Self::Response(response) => Some((response.motions(), "motions")),
            Self::SettleMany(many) => Some((many.points.count(), "points")),
            _ => None,
        }
    }

    /// The names of the quantities that are reported beside labels.
    #[must_use]
    pub fn fields(&self) -> &[String] {
        match self {
            Self::Basin(basin) => &basin.fields,
            Self::Map(map) => &map.fields,
            Self::SettleMany(many) => &many.fields,
            _ => &[],
        }
    }

    /// The axes of a grid.
    #[must_use]
    pub fn axes(&self) -> &[crate::Axis<Variable>] {
        match self {
            Self::Basin(basin) => &basin.axes,
            Self::Map(map) => &map.axes,
            Self::Lyapunov(lyapunov) => &lyapunov.axes,
            _ => &[],
        }
    }

    /// Whether the task fills a grid over axes, which a store keeps.
    pub(crate) const fn fills_a_grid(&self) -> bool {
        match self {
            Self::Basin(_) | Self::Map(_) | Self::SettleMany(_) | Self::Diagram(_) => true,
            Self::Lyapunov(lyapunov) => !lyapunov.axes.is_empty(),
            _ => false,
        }
    }

    /// The name of what the task computes, after "a plan that asks to".
    pub(crate) const fn verb(&self) -> &'static str {
        match self {
            Self::Simulate(_) => "simulate",
            Self::Settle { .. } => "settle",
            Self::Attractors { .. } => "find attractors",
            Self::Orbit { .. } => "find orbits",
            Self::Basin(_) => "find a basin",
            Self::Map(_) => "find a map",
            Self::Diagram(_) => "draw a diagram",
            Self::Lyapunov(_) => "measure the exponents of one motion",
            Self::Branch(_) => "follow a branch",
            Self::Curve(_) => "follow a curve",
            Self::Region(_) => "find a region",
            Self::Response(_) => "find a response",
            Self::SettleMany(_) => "settle points",
            Self::Margins(_) => "find margins",
            Self::Edge(_) => "find an edge",
        }
    }

    /// The start of an oscillator, if the task has one.
    pub(crate) const fn start(&self) -> Option<&Option<StartPlan>> {
        match self {
            Self::Simulate(SimulatePlan { start, .. }) | Self::Settle { start, .. } => Some(start),
            Self::Basin(basin) => Some(&basin.start),
            Self::Lyapunov(lyapunov) => Some(&lyapunov.start),
            Self::Margins(margins) => Some(&margins.start),
            Self::Edge(edge) => Some(&edge.start),
            _ => None,
        }
    }

    /// The same, to be changed.
    pub(crate) const fn start_mut(&mut self) -> Option<&mut Option<StartPlan>> {
        match self {
            Self::Simulate(SimulatePlan { start, .. }) | Self::Settle { start, .. } => Some(start),
            Self::Basin(basin) => Some(&mut basin.start),
            Self::Lyapunov(lyapunov) => Some(&mut lyapunov.start),
            Self::Margins(margins) => Some(&mut margins.start),
            Self::Edge(edge) => Some(&mut edge.start),
            _ => None,
        }
    }

    /// The same task with other names of what varies and of quantities.
    pub(crate) fn named(
        &self,
        name: &impl Fn(&Variable) -> Result<Variable, PlanError>,
        quantity: &impl Fn(&String) -> Result<String, PlanError>,
    ) -> Result<Self, PlanError> {
        Ok(match self {
            Self::Basin(plan) => Self::Basin(plan.named(name, quantity)?),
            Self::Map(plan) => Self::Map(plan.named(name, quantity)?),
            Self::Diagram(plan) => Self::Diagram(plan.named(name, &|show: &ShowText| Ok(show.clone()))?),
            Self::Lyapunov(plan) => Self::Lyapunov(plan.named(name)?),
            Self::Branch(plan) => Self::Branch(plan.named(name)?),
            Self::Curve(plan) => Self::Curve(plan.named(name)?),
            Self::Response(plan) => Self::Response(plan.named(name, quantity)?),
            Self::SettleMany(plan) => Self::SettleMany(plan.named(name)?),
            Self::Margins(plan) => Self::Margins(plan.named(name)?),
            Self::Region(plan) => Self::Region(plan.named(name)?),
            Self::Edge(plan) => Self::Edge(plan.named(name)?),
            other => other.clone(),
        })
    }
}

/// What varies, as a name of a number of a system.
fn of_system<W: Name>(name: &Variable) -> Result<W, PlanError> {
    W::of(name.text())
}

/// A quantity, as that of a system.
#[allow(clippy::ptr_arg, reason = "names in plans are strings")]
fn quantity<R: Name>(name: &String) -> Result<R, PlanError> {
    R::of(name)
}

/// A name of a number of a system, as that of any.
fn of_any<V: Clone + Into<Variable>>(name: &V) -> Result<Variable, Infallible> {
    Ok(name.clone().into())
}

/// A quantity of a system by its name.
#[allow(clippy::unnecessary_wraps, reason = "other names may be wrong")]
fn text<Q: Name>(name: &Q) -> Result<String, Infallible> {
    Ok(name.text().to_owned())
}

impl From<SimulatePlan> for Task {
    fn from(plan: SimulatePlan) -> Self {
        Self::Simulate(plan)
    }
}

/// Plans with names of what varies: with those of a system, and as tasks of any system.
macro_rules! with_names {
    ($($plan:ident => $task:ident),*) => {$(
        impl $plan<Variable> {
            /// The plan with the names of a system.
            ///
            /// # Errors
            /// [`PlanError::Name`] for a name that the system does not have.
            pub fn typed<W: Name>(&self) -> Result<$plan<W>, PlanError> {
                self.named(&of_system)
            }
        }

        impl<V: Clone + Into<Variable>> From<$plan<V>> for Task {
            fn from(plan: $plan<V>) -> Self {
                let Ok(plan) = plan.named(&of_any);
                Self::$task(plan)
            }
        }
    )*};
}

/// The same of plans that have names of quantities too.
macro_rules! with_quantities {
    ($($plan:ident => $task:ident),*) => {$(
        impl $plan<Variable, String> {
            /// The plan with the names of a system.
            ///
            /// # Errors
            /// [`PlanError::Name`] for a name that the system does not have.
            pub fn typed<W: Name, R: Name>(&self) -> Result<$plan<W, R>, PlanError> {
                self.named(&of_system, &quantity)
            }
        }

        impl<V: Clone + Into<Variable>, Q: Name> From<$plan<V, Q>> for Task {
            fn from(plan: $plan<V, Q>) -> Self {
                let Ok(plan) = plan.named(&of_any, &text);
                Self::$task(plan)
            }
        }
    )*};
}

with_names!(LyapunovPlan => Lyapunov, BranchPlan => Branch, CurvePlan => Curve, MarginsPlan => Margins, ManyPlan => SettleMany, RegionPlan => Region, EdgePlan => Edge);
with_quantities!(BasinPlan => Basin, MapPlan => Map, ResponsePlan => Response);

impl DiagramPlan<Variable, ShowText> {
    /// The plan with the names of a system.
    ///
    /// # Errors
    /// [`PlanError`] for a name that the system does not have.
    pub fn typed<W: Name, S>(&self) -> Result<DiagramPlan<W, S>, PlanError>
    where
        S: for<'a> TryFrom<&'a ShowText, Error = PlanError>,
    {
        self.named(&of_system, &|show: &ShowText| S::try_from(show))
    }
}

impl<V: Clone + Into<Variable>, S: Clone + Into<ShowText>> From<DiagramPlan<V, S>> for Task {
    fn from(plan: DiagramPlan<V, S>) -> Self {
        let Ok(plan) = plan.named(&of_any, &|show: &S| Ok::<ShowText, Infallible>(show.clone().into()));
        Self::Diagram(plan)
    }
}

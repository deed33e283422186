//! What tasks ask of a system as it is written in a plan: the same of an oscillator and of a machine.

mod machine;
mod oscillator;

pub use machine::machine_label;
pub(crate) use machine::refused;
#[cfg(test)]
pub(crate) use oscillator::at_rest;

use crate::diagram::{Diagram, DiagramPlan, DiagramPoint, ShowText, Shown};
use crate::margins::{MotionBox, ParameterMargin};
use crate::name::{Name, Variable};
use crate::orbit_line::{Along, OrbitLine, Solution};
use crate::region::Over;
use crate::study::diagram_of;
use crate::{
    Chosen, Column, Control, CurvePlan, Cut, FollowedEvent, LyapunovPlan, MarginsPlan, Orbit, OrbitNumber, PlanError,
    PlanResults, Results, RunError, ScaledParameter, Scope, SimulatePlan, Simulated, Stopped, Stretch, Task,
};
use core::fmt::Debug;
use std::borrow::Cow;
use vibroimpact::Label;
use vibroimpact::continuation::CurveEvent;
use vibroimpact::edge::Bordered;
use vibroimpact::orbit::Stability;
use vibroimpact::verdict::{Census, SettleOptions, Settled, System, Verdict};

/// A system as it is written in a plan. Errors are [`PlanError`]s that name what is wrong, and of searches [`Stopped`].
#[allow(clippy::missing_errors_doc, reason = "all have the errors of the trait")]
pub trait Dynamics: Clone + Debug {
    /// The name of a number.
    type Name: Name + Into<Variable>;
    /// The name of what varies on an axis of a grid: a number, or a part of a start.
    type Coordinate: Name + Into<Cow<'static, str>>;
    /// The name of a quantity.
    type Quantity: Name;
    /// What an orbit diagram shows of a motion.
    type Shown: Shown + Into<ShowText> + for<'a> TryFrom<&'a ShowText, Error = PlanError>;
    /// The system.
    type System: Bordered<Start = Self::Start>;
    /// Where a motion starts.
    type Start: Clone + Debug + PartialEq;
    /// An event of a motion.
    type Event: Clone + Debug;
    /// The systems along a line through numbers.
    type Along: Along<Point: Solution<System = Self::System>>;
    /// A point of a curve of events.
    type CurvePoint: Clone + Debug;
    /// The points of such a curve, one after another.
    type Curve: Iterator<Item = Self::CurvePoint>;

    /// The system with the start of a task.
    fn setup_of(&self, task: &Task) -> Result<Setup<'_, Self>, PlanError>;

    /// Checks what only this system has: its start, and the plans of tasks over grids, of exponents and of margins.
    fn check_own(of: &Setup<'_, Self>, task: &Task) -> Result<(), PlanError>;

    /// The results of a plan of such a system; `None` for those of another one.
    fn own(results: PlanResults) -> Option<Results<Self>>;

    /// The events of a motion, up to a number of them and of forcing periods.
    fn simulate(
        of: &Setup<'_, Self>,
        plan: &SimulatePlan,
        control: &Control<'_>,
    ) -> Result<Simulated<Self::Event>, RunError>;

    /// The distinct motions from so many scattered starts of a sequence.
    fn attractors(
        of: &Setup<'_, Self>,
        starts: (u64, u64),
        options: &SettleOptions,
        control: &Control<'_>,
    ) -> Result<Census<Self::System>, RunError>;

    /// The exponents of a motion, and its sections if points of them are asked for.
    fn exponents(
        of: &Setup<'_, Self>,
        plan: &LyapunovPlan<Self::Coordinate>,
        go_on: &dyn Fn() -> bool,
    ) -> Result<Results<Self>, RunError>;

    /// The result of a task over a grid or over points.
    fn over_grid(of: &Setup<'_, Self>, task: &Task, control: &Control<'_>) -> Result<Results<Self>, RunError>;

    /// The point of an orbit diagram from its numbers in the columns of a study; `None` if there is none.
    fn shown_point(show: &Self::Shown, numbers: &[f64]) -> Option<DiagramPoint>;

    /// The orbit diagram from the columns of its study. Motions of tiles that are not complete are left out.
    fn diagram_of(plan: &DiagramPlan<Self::Name, Self::Shown>, columns: &[Column]) -> Diagram<Self::Name, Self::Shown> {
        diagram_of::<Self>(plan, columns)
    }

    /// A start with another value of a coordinate.
    fn placed(
        system: &Self::System,
        start: Self::Start,
        coordinate: &Self::Coordinate,
        value: f64,
    ) -> Result<Self::Start, PlanError>;

    /// A start, if it is allowed.
    fn allowed(system: &Self::System, start: Self::Start) -> Result<Self::Start, PlanError>;

    /// The value of a number.
    fn number(&self, name: &Self::Name) -> Result<f64, PlanError>;

    /// Checks that a line goes through different numbers, and the systems at its ends.
    fn check_line(&self, cut: &Cut<Self::Name>) -> Result<(), PlanError>;

    /// Checks the systems at the ends of a line through one number.
    fn check_ends(&self, cut: &Cut<Self::Name>) -> Result<(), PlanError>;

    /// Checks that the system has curves of a kind.
    fn check_curve(kind: FollowedEvent) -> Result<(), PlanError>;

    /// Checks that the ranges of two numbers span a plane of valid systems.
    fn check_plane(&self, one: &Stretch<Self::Name>, two: &Stretch<Self::Name>) -> Result<(), PlanError>;

    /// The systems of the plane of two numbers.
    fn over(&self, across: &Stretch<Self::Name>, up: &Stretch<Self::Name>) -> Result<Over, PlanError>;

    /// The line on which orbits are followed from a value of its first number, and the largest number of points of each branch.
    fn line(&self, cut: &Cut<Self::Name>, from: f64, points: u32) -> Result<OrbitLine<Self::Along>, PlanError>;

    /// The system where the first number of a line has a value; `None` if the value is not allowed.
    fn system_on(&self, cut: &Cut<Self::Name>, line: &OrbitLine<Self::Along>, value: f64) -> Option<Self::System>;

    /// The label of an orbit. One that is followed `in_a_plane` has no infinite number of impacts if it is an oscillator's.
    fn label(system: &Self::System, text: Option<&str>, in_a_plane: bool) -> Result<Option<Label>, PlanError>;

    /// The orbits with a label in order of rising speed.
    fn orbits(
        system: &Self::System,
        label: Label,
        go_on: &dyn Fn() -> bool,
    ) -> Result<Vec<Orbit<CycleOf<Self>>>, RunError>;

    /// Checks that an orbit with a label can be followed.
    fn check_followed(_: &Self::System, _: Label) -> Result<(), PlanError> {
        Ok(())
    }

    /// The error where no orbit with a label is admissible, with the number of the others.
    fn no_orbit(label: Label, others: usize) -> PlanError;

    /// The motion from a start, and how far it was followed.
    fn settle(
        system: &Self::System,
        start: &Self::Start,
        impacts: Option<u32>,
        go_on: &dyn Fn() -> bool,
    ) -> Result<Settled<Self::System>, RunError>;

    /// Whether neighbours approach a cycle.
    fn stability(cycle: &CycleOf<Self>) -> Stability;

    /// The cycle of a motion; `None` for a motion that cannot be followed.
    fn cycle(system: &Self::System, motion: &Verdict<Self::System>) -> Option<CycleOf<Self>>;

    /// The numbers that vary where a plan of margins does not say it.
    fn free_numbers(&self) -> Result<Vec<Self::Name>, PlanError>;

    /// The range and the scale of a number.
    fn scope(&self, varied: &ScaledParameter<Self::Name>, within: f64) -> Result<Scope<Self::Name>, PlanError>;

    /// The box of numbers in which a stable motion is found by trying; `None` where none is looked for.
    fn motion_box(
        &self,
        cycle: &CycleOf<Self>,
        margins: &[ParameterMargin<Self::Name, PointOf<Self>>],
        plan: &MarginsPlan<Self::Name>,
        control: &Control<'_>,
    ) -> Result<Option<MotionBox>, RunError>;

    /// The start of a motion of a sweep, at a value of the first number of a line: the state that the motion at the value before
    /// has left there.
    fn carried(
        of: &Setup<'_, Self>,
        cut: &Cut<Self::Name>,
        before: Option<(f64, Self::Start)>,
        at: (f64, &Self::System),
    ) -> Result<Self::Start, PlanError>;

    /// A state of the settled motion from a start.
    fn reached(system: &Self::System, motion: &Verdict<Self::System>, start: Self::Start) -> Self::Start;

    /// The names of all quantities of a motion.
    fn quantity_names(system: &Self::System) -> Vec<String>;

    /// The name of the quantity of a response, checked.
    fn quantity(system: &Self::System, given: Option<&Self::Quantity>) -> Result<String, PlanError>;

    /// The values of all quantities of a motion; `None` if they are not defined.
    fn quantities(system: &Self::System, motion: &Verdict<Self::System>) -> Option<Vec<f64>>;

    /// The same of a cycle, which need not be admissible.
    fn cycle_quantities(system: &Self::System, cycle: &CycleOf<Self>) -> Option<Vec<f64>>;

    /// Whether a branch passes through a cycle at a value between two of its points.
    fn passes(system: &Self::System, cycle: &CycleOf<Self>, between: [&PointOf<Self>; 2]) -> bool;

    /// The line on which the events of a curve are looked for, and the value from which the orbit is followed.
    fn line_of_events(
        of: &Setup<'_, Self>,
        plan: &CurvePlan<Self::Name>,
    ) -> Result<(OrbitLine<Self::Along>, f64), PlanError>;

    /// The two directions of the curve through an event, and the stops and joints to which it belongs.
    fn curve(
        of: &Setup<'_, Self>,
        plan: &CurvePlan<Self::Name>,
        line: OrbitLine<Self::Along>,
        event: &PointOf<Self>,
    ) -> Result<([Self::Curve; 2], Vec<usize>), PlanError>;

    /// The event at a point of a curve.
    fn curve_event(point: &Self::CurvePoint) -> Option<CurveEvent>;
}

/// A cycle of a system.
pub type CycleOf<D> = <<D as Dynamics>::System as System>::Cycle;

/// A point of a branch of a system.
pub type PointOf<D> = <<D as Dynamics>::Along as Along>::Point;

/// A system with the start of a motion.
#[derive(Debug)]
pub struct Setup<'a, D: Dynamics> {
    /// The system as it is written.
    pub written: &'a D,
    /// The system, checked.
    pub system: D::System,
    /// The start.
    pub start: D::Start,
}

/// Whether a run goes on: the error of a run that was stopped.
pub(crate) fn not_stopped(control: &Control<'_>) -> Result<(), Stopped> {
    if control.stopping() { Err(Stopped { done: 0, total: 1 }) } else { Ok(()) }
}

impl<D: Dynamics> Setup<'_, D> {
    /// Checks the label and the number of an orbit.
    pub(crate) fn check_orbit(
        &self,
        (label, number): (Option<&str>, Option<u32>),
        in_a_plane: bool,
    ) -> Result<(), PlanError> {
        match D::label(&self.system, label, in_a_plane)? {
            None if number.is_some() => Err(PlanError::refused(
                "the number of an orbit is given without a label\nhint: orbits are numbered among those with the same label m/n",
            )),
            _ => Ok(()),
        }
    }

    /// The orbit with a label and a number. Without a number: the stable orbit, or else the fastest admissible one; without a label
    /// the motion from the start.
    pub(crate) fn chosen(
        &self,
        (text, number): (Option<&str>, Option<u32>),
        control: &Control<'_>,
    ) -> Result<Chosen<CycleOf<D>>, RunError> {
        let go_on = || !control.stopping();
        let Some(label) = D::label(&self.system, text, false)? else {
            return match D::settle(&self.system, &self.start, None, &go_on)?.verdict {
                Verdict::Periodic(cycle) => {
                    let stability = Some(D::stability(&cycle));
                    Ok(Chosen { cycle, among: None, stability })
                }
                other => {
                    let why = format!("`{}`, no cycle of events, so no branch begins there", other.label());
                    let hint = "give the label of an orbit, or another start";
                    Err(PlanError::refused(format!("the motion from the start is {why}\nhint: {hint}")).into())
                }
            };
        };
        D::check_followed(&self.system, label)?;
        let orbits = D::orbits(&self.system, label, &go_on)?;
        let count = orbits.len();
        let index = match number {
            Some(given) => {
                let index = usize::try_from(given).ok().and_then(|n| n.checked_sub(1)).filter(|index| *index < count);
                index.ok_or(PlanError::NoSuchOrbit { given, count, label })?
            }
            None => {
                let rank = |orbit: &Orbit<CycleOf<D>>| {
                    (orbit.admissible, orbit.admissible && D::stability(&orbit.cycle).is_stable())
                };
                // of several with the same rank, the last one, which is the fastest
                let best = (0..count).max_by_key(|index| rank(&orbits[*index]));
                best.filter(|index| orbits[*index].admissible).ok_or_else(|| D::no_orbit(label, count))?
            }
        };
        let found = orbits.into_iter().nth(index).ok_or_else(|| D::no_orbit(label, 0))?;
        let Orbit { cycle, admissible, .. } = found;
        let stability = admissible.then(|| D::stability(&cycle));
        Ok(Chosen { cycle, among: Some(OrbitNumber::new(index, count)), stability })
    }
}

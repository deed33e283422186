//! What is told of the answers of one kind of system only; all else is written once, in the modules of answers and of JSON.

use super::AnswerOf;
use crate::json::branch::{self, Along, EventOf};
use crate::json::event::{StateObject, Stops};
use crate::json::motion::MotionObject;
use crate::json::system::SystemObject;
use crate::scene::View;
use crate::table::Remark;
use crate::task::attractors::Area;
use crate::task::basin::MeasureFields;
use crate::task::curve;
use crate::task::lyapunov::LyapunovAnswer;
use crate::task::orbit::OrbitObject;
use crate::task::response::ResponseView;
use crate::task::settle::SettleAnswer;
use crate::task::simulate::Events;
use crate::{AnswerError, FieldName, ReportError, ShownValue, Table, Units, Varied};
use vibroimpact::chaos::Exponents;
use vibroimpact::machine::Machine;
use vibroimpact::math::Multiplier;
use vibroimpact::orbit::machine::Cycle;
use vibroimpact::verdict::{Settled, Verdict};
use vibroimpact_plot::Figure;
use vibroimpact_study::{
    Basin, Branches, CurvePlan, Cut, CycleOf, Dynamics, EventCurve, Orbit, PlanError, PointOf, ResponseCurves,
    SectionPoints, Simulated,
};

/// The branches of a system.
pub(crate) type BranchesOf<D> = Branches<CycleOf<D>, PointOf<D>>;

/// A curve of events of a system.
pub(crate) type CurveOf<D> = EventCurve<CycleOf<D>, PointOf<D>, <D as Dynamics>::CurvePoint>;

/// The motions of the starts of a system.
pub(crate) type BasinOf<D> = Basin<<D as Dynamics>::System, <D as Dynamics>::Coordinate, <D as Dynamics>::Quantity>;

/// A system whose answers are told. Errors are those of what cannot be drawn or tabulated, and of names of plans.
#[allow(clippy::missing_errors_doc, clippy::must_use_candidate, reason = "all have the errors of the trait")]
pub trait Told:
    Dynamics<Name: Varied, Coordinate: Varied, Quantity: FieldName, Shown: ShownValue, System: Stops>
{
    /// The machine, if the system is one.
    fn machine(_: &AnswerOf<Self>) -> Option<&Machine> {
        None
    }

    /// The period of the forcing, nondimensional of an oscillator; `None` without forcing.
    fn period(of: &AnswerOf<Self>) -> Option<f64> {
        Self::machine(of)?.period()
    }

    /// The system, without the numbers that vary.
    fn system(of: &AnswerOf<Self>) -> SystemObject<'_>;

    /// The start of the motion.
    fn state(of: &AnswerOf<Self>) -> StateObject<'_>;

    /// A state as numbers: the coordinates, the velocities, and the names of both.
    fn numbers(of: &AnswerOf<Self>, start: &Self::Start) -> (Vec<f64>, Vec<f64>);

    /// The names of the coordinates in tables and on axes, and of the velocities.
    fn names(of: &AnswerOf<Self>) -> (Vec<String>, Vec<String>);

    /// A motion.
    fn motion<'a>(of: &'a AnswerOf<Self>, verdict: &'a Verdict<Self::System>) -> MotionObject<'a>;

    /// The Floquet multipliers of a motion; none if it has none.
    fn multipliers(of: &AnswerOf<Self>, verdict: &Verdict<Self::System>) -> Vec<Multiplier>;

    /// The cycle of a motion of a machine.
    fn cycle_of_machine(_: &Verdict<Self::System>) -> Option<&Cycle> {
        None
    }

    /// What is said of a motion of a machine beside its label.
    fn remark(_: &Verdict<Self::System>) -> Remark {
        Remark::default()
    }

    /// An orbit with a label.
    fn orbit<'a>(of: &'a AnswerOf<Self>, orbit: &'a Orbit<CycleOf<Self>>) -> OrbitObject<'a>;

    /// The events of a motion.
    fn events<'a>(of: &'a AnswerOf<Self>, found: &'a Simulated<Self::Event>) -> Events<'a>;

    /// A settled motion; a brief one is without what takes longest to compute.
    fn settled<'a>(of: &'a AnswerOf<Self>, found: &'a Settled<Self::System>, _brief: bool) -> SettleAnswer<'a> {
        SettleAnswer::brief(of, found)
    }

    /// Exponents.
    fn exponents_object<'a>(of: &'a AnswerOf<Self>, found: &'a Exponents<Self::System>) -> LyapunovAnswer<'a> {
        LyapunovAnswer::new(of, found)
    }

    /// The box of scattered starts, if there is one.
    fn area(_: &AnswerOf<Self>) -> Option<Area> {
        None
    }

    /// The measures of a basin, if it has any.
    fn measures(_: &BasinOf<Self>) -> Option<MeasureFields> {
        None
    }

    /// What is shown of each cycle on branches of a system that has no speeds of closings.
    fn shown_on_branches(_: &AnswerOf<Self>, _: &BranchesOf<Self>, _: &Cut<Self::Name>) -> Option<Self::Shown> {
        None
    }

    /// A point of a branch, with what a diagram shows of its cycle, and what an event there happens to.
    fn branch_point<'a>(
        along: Along<'a, Self>,
        point: &'a PointOf<Self>,
        cut: &Cut<Self::Name>,
        show: Option<&Self::Shown>,
    ) -> (branch::PointObject<'a>, EventOf<'a>);

    /// A point of a curve of events.
    fn curve_point<'a>(
        of: &'a AnswerOf<Self>,
        point: &'a Self::CurvePoint,
        plan: &CurvePlan<Self::Name>,
    ) -> curve::PointObject<'a>;

    /// A response.
    fn response<'a>(of: &'a AnswerOf<Self>, found: &'a ResponseCurves) -> Result<ResponseView<'a>, PlanError>;

    /// The title of a figure, without these numbers, which vary in it. A machine without a title of its own has this name.
    fn title(&self, name: &str, units: &Units, varied: &[&str]) -> String;

    /// The names of the speeds of orbits, and of those of branches.
    fn speeds(of: &AnswerOf<Self>) -> [String; 2];

    /// The figure of the events of a motion, over time or in the phase plane.
    fn simulated_figure(
        of: &AnswerOf<Self>,
        found: &Simulated<Self::Event>,
        view: View,
    ) -> Result<Option<Figure>, ReportError>;

    /// The figure of a settled motion.
    fn settled_figure(of: &AnswerOf<Self>, found: &Settled<Self::System>, view: View) -> Result<Figure, AnswerError>;

    /// The figure of both sections of an attractor.
    fn section_figure(of: &AnswerOf<Self>, found: &Exponents<Self::System>, points: &SectionPoints) -> Figure;

    /// The waveform of the motion from a state over a time, with this time between its points.
    fn waveform_table<'a>(
        of: &'a AnswerOf<Self>,
        from: &Self::Start,
        span: (f64, f64),
    ) -> Result<Table<'a>, ReportError>;

    /// The table of a settled motion, but not that of its multipliers.
    fn settled_table<'a>(
        of: &'a AnswerOf<Self>,
        found: &'a Settled<Self::System>,
        view: View,
    ) -> Result<Table<'a>, ReportError>;
}

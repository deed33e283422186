//! The errors of plans and runs.

use crate::control::Stopped;
use crate::machine::MachineFileError;
use crate::text::TextError;
use core::fmt;
use std::borrow::Cow;
use thiserror::Error;
use vibroimpact::continuation::BranchError;
use vibroimpact::edge::EdgeError;
use vibroimpact::verdict::LabelError;
use vibroimpact::{Label, SystemError};

/// An error in a plan. The message names the value, the allowed range and often a hint.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum PlanError {
    /// What makes no sense, as a sentence.
    #[error("{0}")]
    Refused(Cow<'static, str>),
    /// The system or a start is invalid.
    #[error(transparent)]
    System(#[from] SystemError),
    /// A machine, a number in it or its start is invalid.
    #[error(transparent)]
    Machine(#[from] MachineFileError),
    /// A number of forcing periods of a machine without forcing.
    #[error("the machine has no forcing, so no forcing periods\nhint: a number of impacts limits the number of events")]
    Unforced,
    /// No border between two starts.
    #[error(transparent)]
    Edge(#[from] EdgeError),
    /// A number of a body in two forms.
    #[error("{0} and {1} are two forms of one number, and both are given")]
    TwoForms(&'static str, &'static str),
    /// A stop that moves by itself, and a base that moves too.
    #[error("the motion of the stop is given, and a base that moves: a stop moves with its base or is fixed in space")]
    StopAndBase,
    /// A number of a body, but the system is an oscillator without units.
    #[error("{0} is a number of a body in SI units, and the system is nondimensional")]
    NoBody(&'static str),
    /// A text that cannot be read as a plan.
    #[error("the plan does not read: {0}")]
    Text(#[from] TextError),
    /// A number outside its allowed range.
    #[error("{name} = {given} lies outside {range}{hint}")]
    OutOfRange {
        /// Its name.
        name: &'static str,
        /// The given value.
        given: String,
        /// The allowed range, such as `1 <= starts <= 100`.
        range: String,
        /// What is said after that, beginning with a colon or a line break; may be empty.
        hint: &'static str,
    },
    /// A range that is not `A:B:N`.
    #[error(
        "range `{given}` is not A:B:N with finite A and B and a whole N >= 1\nhint: {}",
        crate::typed::range_hint(given)
    )]
    Range {
        /// The given text.
        given: String,
    },
    /// The number of axes is too small or too large for the task.
    #[error("axes given: {given}; a {task} has {least} to {most}")]
    Axes {
        /// The number of axes given.
        given: usize,
        /// The name of the task.
        task: &'static str,
        /// The smallest number of axes allowed.
        least: usize,
        /// The largest number of axes allowed.
        most: usize,
    },
    /// The task cannot have this axis.
    #[error("a {task} has no axis {name}; it may have {known}")]
    WrongAxis {
        /// The name of the task.
        task: &'static str,
        /// The quantity that varies on the axis.
        name: Cow<'static, str>,
        /// The quantities that may vary.
        known: &'static str,
    },
    /// A name of nothing that the system has.
    #[error("{0}")]
    Name(String),
    /// A branch or a curve of an oscillator without the label of an orbit.
    #[error("the label of the orbit to follow is not given\nhint: label m/n, for example 1/1")]
    NoLabel,
    /// A task of a machine for an oscillator.
    #[error("the task is one of a machine, and the system is an oscillator")]
    OfMachine,
    /// A task of an oscillator for a machine.
    #[error("the task is one of an oscillator, and the system is a machine")]
    OfOscillator,
    /// A task without a grid, which cannot be stored as a study.
    #[error(
        "a plan that asks to {0} fills no grid, so there is nothing to store\nhint: tasks for a store are map, basin, attractors, diagram and lyapunov"
    )]
    NoStudy(&'static str),
    /// A task of a machine without a grid, which cannot be stored as a study.
    #[error(
        "a plan of a machine that asks to {0} fills no grid, so there is nothing to store\nhint: tasks of machines for a store are map, basin, settle-many, diagram, and lyapunov over axes"
    )]
    NoMachineStudy(&'static str),
    /// A diagram of a quantity, which has no store.
    #[error(
        "a diagram of a quantity is computed in memory, and has no store\nhint: a map over one parameter with --fields has one, and all coexisting motions"
    )]
    NoStoredQuantity,
    /// Parameters that are given neither in the system nor on an axis.
    #[error("neither in the system nor on an axis: {}", .0.join(", "))]
    Missing(Vec<&'static str>),
    /// The frequency is given twice or not at all (beta and its inverse).
    #[error("the frequency is given {0}: exactly one of beta and inverse beta is needed")]
    Frequency(&'static str),
    /// A parameter of the second stop is to vary, but there is only one stop.
    #[error("{0} is to vary, but there is no second stop\nhint: a second stop has a gap and a restitution of its own")]
    NoSecondStop(&'static str),
    /// More results than one run keeps in memory.
    #[error(
        "{rows} x {columns} = {total} {what}; at most {most} are allowed\nhint: fewer values, or a store, which holds any number",
        total = u128::from(*rows) * u128::from(*columns)
    )]
    Size {
        /// The name of what is counted.
        what: &'static str,
        /// Number of values on the first axis.
        columns: u64,
        /// Number of values on the other axes.
        rows: u64,
        /// The largest allowed number of results.
        most: u64,
    },
    /// A parameter is to vary from its value to the same value.
    #[error("{name} is to go from {value} to {value}: there is nothing on the way")]
    Nowhere {
        /// The name of the parameter.
        name: Cow<'static, str>,
        /// Its value.
        value: f64,
    },
    /// The two parameters of a plane are the same parameter.
    #[error("{0} and {1} do not span a plane: they are one parameter")]
    SameParameter(Cow<'static, str>, Cow<'static, str>),
    /// No admissible orbit of the label exists, so a branch cannot begin.
    #[error(
        "no admissible orbit {label} was found, so there is nothing to follow\nhint: inadmissible solutions ({others} here) are followed only when their number is given"
    )]
    NoOrbit {
        /// The label.
        label: Label,
        /// Number of inadmissible solutions of the equations.
        others: usize,
    },
    /// No orbit with this number exists.
    #[error(
        "there is no orbit {label} number {given}; found: {count}\nhint: they are numbered from 1, as the search for orbits lists them"
    )]
    NoSuchOrbit {
        /// The given number.
        given: u32,
        /// The number of orbits.
        count: usize,
        /// The label.
        label: Label,
    },
    /// There is no event of this kind on the branch, or none with this number.
    #[error(
        "{} on the branch of {label} with {name} from {from} to {to}{}",
        asked.map_or_else(|| format!("no {kind} was found"), |n| format!("there is no {kind} number {n}")),
        if *count == 0 { String::new() } else { format!(": {count} found") }
    )]
    NoEvent {
        /// The kind of event.
        kind: &'static str,
        /// The label of the branch.
        label: Label,
        /// The parameter that varies.
        name: Cow<'static, str>,
        /// Smallest value of its range.
        from: f64,
        /// Largest value of the range.
        to: f64,
        /// The number of events of this kind.
        count: usize,
        /// The number of the requested event, if one was given.
        asked: Option<u32>,
    },
    /// A branch or a curve cannot begin.
    #[error(transparent)]
    Branch(#[from] BranchError),
    /// The text is not a label.
    #[error(transparent)]
    Label(#[from] LabelError),
    /// The plan has a version that this program does not support.
    #[error("the plan has version {0}; this program knows version {known}", known = crate::PLAN_VERSION)]
    Version(u32),
}

impl PlanError {
    /// What makes no sense, as a sentence.
    pub(crate) fn refused(sentence: impl Into<Cow<'static, str>>) -> Self {
        Self::Refused(sentence.into())
    }

    /// A range whose ends are not finite or not in rising order.
    pub(crate) fn no_range(name: &str, (from, to): (f64, f64)) -> Self {
        let needed = "two finite numbers in rising order are needed";
        Self::refused(format!("{name} from {from} to {to} is no range: {needed}"))
    }

    /// A number of a system that is not that of its body.
    pub(crate) fn not_of_body(name: &str, given: f64, own: f64) -> Self {
        let hint = "leave the nondimensional numbers out";
        Self::refused(format!("{name} = {given} of the system is not that of its body, {own}\nhint: {hint}"))
    }

    /// The error of a point of a list. Its number is written in the first line, before a hint.
    pub(crate) fn at_point(self, point: usize) -> Self {
        let text = self.to_string();
        let (first, rest) = text.split_at(text.find('\n').unwrap_or(text.len()));
        Self::refused(format!("{first} (point {point}){rest}"))
    }

    /// A number that lies outside a range, both ends of which are allowed.
    pub(crate) fn outside<T: fmt::Display>(name: &'static str, given: T, (least, most): (T, T)) -> Self {
        let range = format!("{least} <= {name} <= {most}");
        Self::OutOfRange { name, given: given.to_string(), range, hint: "" }
    }

    /// The same number with a hint.
    pub(crate) fn hinted(mut self, text: &'static str) -> Self {
        if let Self::OutOfRange { hint, .. } = &mut self {
            *hint = text;
        }
        self
    }
}

/// The reason why a run was not completed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RunError {
    /// The plan is invalid.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// The run was stopped by its caller.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

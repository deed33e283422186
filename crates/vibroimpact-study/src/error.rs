//! Why a plan makes no sense.

use crate::control::Stopped;
use crate::counted;
use thiserror::Error;
use vibroimpact::continuation::BranchError;
use vibroimpact::verdict::LabelError;
use vibroimpact::{Label, SystemError};

/// A plan that cannot be run. The sentence names the value, the allowed range and often a hint.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum PlanError {
    /// The system or a start is impossible.
    #[error(transparent)]
    System(#[from] SystemError),
    /// A text that is no plan.
    #[error("the plan does not read: {0}")]
    Text(String),
    /// A range that is not `A:B:N`.
    #[error(
        "range `{given}` is not A:B:N with finite A and B and a whole N >= 1\nhint: 0.4:2:33 is 33 values from 0.4 to 2, both included"
    )]
    Range {
        /// What was typed.
        given: String,
    },
    /// Equal ratios from or to what is not positive.
    #[error("range `{given}` is logarithmic, so both ends must be positive")]
    Logarithmic {
        /// What was typed.
        given: String,
    },
    /// A range with a number of values that is too small or too large.
    #[error("range `{given}` asks for {}; allowed is 1 to {most}, and 1 only when A = B", counted(*count, "value"))]
    Count {
        /// What was typed.
        given: String,
        /// The number of values asked for.
        count: u64,
        /// The largest number allowed.
        most: u64,
    },
    /// A list of values that is empty, too long, or has something in it that is no number.
    #[error("a list of {} was given: allowed are 1 to {most} finite numbers, none of them twice{}",
        counted(*count as u64, "value"), wrong.map_or_else(String::new, |value| format!(", not {value}")))]
    Listed {
        /// Its length.
        count: usize,
        /// The largest length allowed.
        most: u64,
        /// The value that is wrong, if it is one.
        wrong: Option<f64>,
    },
    /// Too few or too many axes.
    #[error("axes given: {given}; a {task} has {least} to {most}")]
    Axes {
        /// What was asked.
        given: usize,
        /// The task.
        task: &'static str,
        /// The least.
        least: usize,
        /// The most.
        most: usize,
    },
    /// An axis that a task cannot have.
    #[error("a {task} has no axis {name}; it may have {known}")]
    WrongAxis {
        /// The task.
        task: &'static str,
        /// What varies.
        name: &'static str,
        /// What may vary.
        known: &'static str,
    },
    /// A basin over parameters only.
    #[error(
        "a basin needs an axis over x, v or phase\nhint: which motions there are at points of a plane of parameters is a map"
    )]
    NoStartAxis,
    /// A question that fills no grid.
    #[error(
        "a plan that asks to {0} fills no grid, so there is nothing to store\nhint: tasks for a store are map, basin, attractors, diagram and lyapunov"
    )]
    NoStudy(&'static str),
    /// A size of tiles that makes no sense.
    #[error("tile = {given} lies outside 1 <= tile <= {most}")]
    Tile {
        /// What was asked.
        given: u32,
        /// The most allowed.
        most: u32,
    },
    /// A coarse step that makes no sense.
    #[error(
        "refine = {given} lies outside 2 <= refine <= {most}: the distance, in points, of the coarse grid to begin with"
    )]
    Refine {
        /// What was asked.
        given: u32,
        /// The most allowed.
        most: u32,
    },
    /// Parameters given neither in the system nor on an axis.
    #[error("neither in the system nor on an axis: {}", .0.join(", "))]
    Missing(Vec<&'static str>),
    /// Neither or both of beta and its inverse.
    #[error("the frequency is given {0}: exactly one of beta and inverse beta is needed")]
    Frequency(&'static str),
    /// A number of starts that makes no sense.
    #[error("starts = {given} lies outside 1 <= starts <= {most}")]
    Starts {
        /// What was asked for.
        given: u64,
        /// The most allowed.
        most: u64,
    },
    /// A number of impacts that makes no sense.
    #[error("impacts = {0} lies outside 1 <= impacts <= 10000000")]
    Impacts(u64),
    /// A number of impacts to follow each start for that makes no sense.
    #[error("impacts = {given} lies outside 1 <= impacts <= {most}")]
    Budget {
        /// What was given.
        given: u32,
        /// The most there may be.
        most: u32,
    },
    /// A number of impacts to measure over that is too small for an error bar, or too large.
    #[error(
        "impacts = {given} lies outside {least} <= impacts <= {most}\nhint: the error bar shrinks with the square root of the number; 100000 give two or three digits"
    )]
    Measured {
        /// What was asked.
        given: u64,
        /// The least allowed.
        least: u64,
        /// The most allowed.
        most: u64,
    },
    /// A number of points of a section that makes no sense.
    #[error("points = {given} lies outside 1 <= points <= {most}")]
    Points {
        /// What was asked.
        given: u64,
        /// The most allowed.
        most: u64,
    },
    /// A number of forcing periods that makes no sense.
    #[error("periods = {0} lies outside 0 < periods <= 1e9")]
    Periods(f64),
    /// A transient that is too long.
    #[error("transient = {given} lies outside 0 <= transient <= {most}")]
    Transient {
        /// What was asked.
        given: u64,
        /// The most allowed.
        most: u64,
    },
    /// A number of impacts or states to keep that makes no sense.
    #[error("keep = {given} lies outside 1 <= keep <= {most}")]
    Keep {
        /// What was asked.
        given: u64,
        /// The most allowed.
        most: u64,
    },
    /// A parameter of a second stop where there is only one.
    #[error("{0} is to vary, but there is no second stop\nhint: a second stop has a gap and a restitution of its own")]
    NoSecondStop(&'static str),
    /// More results than fit any memory.
    #[error(
        "{rows} x {columns} = {total} {what}; at most {most} are allowed\nhint: fewer values, or a store, which holds any number",
        total = u128::from(*rows) * u128::from(*columns)
    )]
    Size {
        /// What is counted.
        what: &'static str,
        /// Values on one axis.
        columns: u64,
        /// Values on the other.
        rows: u64,
        /// The most allowed.
        most: u64,
    },
    /// More numbers than fit any memory.
    #[error("{numbers} numbers would have to be kept; at most {most} fit\nhint: give a store, which holds any number")]
    Memory {
        /// Numbers asked for.
        numbers: u64,
        /// The most allowed.
        most: u64,
    },
    /// A parameter that is to go where it is already.
    #[error("{name} is to go from {value} to {value}: there is nothing on the way")]
    Nowhere {
        /// The parameter.
        name: &'static str,
        /// Where it is.
        value: f64,
    },
    /// A number of branches to follow that makes no sense.
    #[error("follow = {given} lies outside 0 <= follow <= {most}")]
    Follow {
        /// What was asked.
        given: u32,
        /// The most allowed.
        most: u32,
    },
    /// A number of points of a branch that makes no sense.
    #[error("points = {given} lies outside 2 <= points <= {most}")]
    BranchPoints {
        /// What was asked.
        given: u32,
        /// The most allowed.
        most: u32,
    },
    /// A grid that makes no sense.
    #[error("grid = {given} lies outside 2 <= grid <= {most}")]
    Grid {
        /// What was asked.
        given: u32,
        /// The most allowed.
        most: u32,
    },
    /// A range of a parameter that is none.
    #[error("{name} from {from} to {to} is no range: two finite numbers in rising order are needed")]
    Stretch {
        /// The parameter.
        name: &'static str,
        /// One end.
        from: f64,
        /// The other.
        to: f64,
    },
    /// A range of a parameter that rounding leaves no steps in.
    #[error(
        "{name} from {from:?} to {to:?} is too narrow a range to follow curves through: rounding leaves no steps in it\nhint: a width of at least {least:.1e}"
    )]
    Narrow {
        /// The parameter.
        name: &'static str,
        /// One end.
        from: f64,
        /// The other.
        to: f64,
        /// The least width.
        least: f64,
    },
    /// Two parameters that are one.
    #[error("{0} and {1} do not span a plane: they are one parameter")]
    SameParameter(&'static str, &'static str),
    /// The system lies outside the range of a parameter.
    #[error(
        "{name} = {value} lies outside the range from {from} to {to}\nhint: the orbit to begin with is looked for at the system given"
    )]
    Outside {
        /// The parameter.
        name: &'static str,
        /// Its value in the system.
        value: f64,
        /// Smallest value of the range.
        from: f64,
        /// Largest value.
        to: f64,
    },
    /// No motion of a label to begin with.
    #[error(
        "no admissible orbit {label} was found, so there is nothing to follow\nhint: inadmissible solutions ({others} here) are followed only when their number is given"
    )]
    NoOrbit {
        /// The label.
        label: Label,
        /// Inadmissible solutions of the equations.
        others: usize,
    },
    /// An orbit by a number that none has.
    #[error(
        "there is no orbit {label} number {given}; found: {count}\nhint: they are numbered from 1, as the search for orbits lists them"
    )]
    NoSuchOrbit {
        /// What was asked.
        given: u32,
        /// How many there are.
        count: usize,
        /// The label.
        label: Label,
    },
    /// No event of a kind on a branch, or none of that number.
    #[error(
        "{} on the branch of {label} with {name} from {from} to {to}{}",
        asked.map_or_else(|| format!("no {kind} was found"), |n| format!("there is no {kind} number {n}")),
        if *count == 0 { String::new() } else { format!(": {count} found") }
    )]
    NoEvent {
        /// The kind.
        kind: &'static str,
        /// Label of the branch.
        label: Label,
        /// The parameter that varies.
        name: &'static str,
        /// Smallest value of its range.
        from: f64,
        /// Largest value.
        to: f64,
        /// How many there are.
        count: usize,
        /// Which was asked for, if one was.
        asked: Option<u32>,
    },
    /// A branch or a curve that cannot begin.
    #[error(transparent)]
    Branch(#[from] BranchError),
    /// Not a label.
    #[error(transparent)]
    Label(#[from] LabelError),
    /// A plan of a version this program does not know.
    #[error("the plan has version {0}; this program knows version {known}", known = crate::PLAN_VERSION)]
    Version(u32),
}

/// Why a run was not completed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RunError {
    /// The plan makes no sense.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// It was stopped from outside.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

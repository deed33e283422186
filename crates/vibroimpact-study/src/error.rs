//! The errors of plans and runs.

use crate::control::Stopped;
use crate::counted;
use crate::machine::MachineFileError;
use crate::text::TextError;
use core::fmt;
use std::borrow::Cow;
use thiserror::Error;
use vibroimpact::continuation::BranchError;
use vibroimpact::edge::EdgeError;
use vibroimpact::verdict::LabelError;
use vibroimpact::{Label, SystemError};

/// The message about a point: its number is written in the first line, before a hint.
fn at_point(error: &PlanError, point: u64) -> String {
    let text = error.to_string();
    let (first, rest) = text.split_once('\n').map_or((text.as_str(), None), |(first, rest)| (first, Some(rest)));
    let rest = rest.map_or_else(String::new, |rest| format!("\n{rest}"));
    format!("{first} (point {point}){rest}")
}

/// An error in a plan. The message names the value, the allowed range and often a hint.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum PlanError {
    /// The system or a start is invalid.
    #[error(transparent)]
    System(#[from] SystemError),
    /// A machine, a number in it or its start is invalid.
    #[error(transparent)]
    Machine(#[from] MachineFileError),
    /// A number of forcing periods of a machine without forcing.
    #[error("the machine has no forcing, so no forcing periods\nhint: a number of impacts limits the number of events")]
    Unforced,
    /// A label of motions of a machine without forcing.
    #[error(
        "label `{0}` is not m/T with m a whole number from 0 to 10000 (or inf/T), and the machine has no forcing\nhint: m closings in one period T of the motion, for example 2/T"
    )]
    LabelUnforced(String),
    /// A label of motions of a machine with forcing.
    #[error(
        "label `{0}` is one of a machine without forcing, and the machine has a forcing\nhint: m/n for m closings in n forcing periods, for example 2/1"
    )]
    LabelForced(String),
    /// Sections of the attractor of a machine without forcing.
    #[error("the machine has no forcing, so its attractor has no section at a phase")]
    UnforcedSection,
    /// Both numbers of a line through two are the same.
    #[error("{0} and {0} cannot vary together: a line goes through two different numbers")]
    MachineTogether(String),
    /// The ends of a line are not finite.
    #[error("{name} is to go from {from} to {to}, but both values are finite")]
    Endless {
        /// The name of the number.
        name: Cow<'static, str>,
        /// Its first value.
        from: f64,
        /// Its last value.
        to: f64,
    },
    /// No border between two starts.
    #[error(transparent)]
    Edge(#[from] EdgeError),
    /// A border without a second start.
    #[error(
        "a border lies between two starts, and the second start is missing\nhint: --other v=1 changes the velocity of the first start; of a machine --other qdot.NAME=1"
    )]
    NoOtherStart,
    /// The number of an orbit without a label.
    #[error(
        "the number of an orbit is given without a label\nhint: orbits are numbered among those with the same label m/n"
    )]
    NumberWithoutLabel,
    /// The motion from the start of a branch is not periodic.
    #[error(
        "the motion from the start is `{0}`, no cycle of events, so no branch begins there\nhint: give the label of an orbit, or another start"
    )]
    NotPeriodic(String),
    /// No orbit of a machine with a label was found.
    #[error("no orbit {0} was found at this machine\nhint: `vibro attractors --machine` lists the stable ones")]
    NoMachineOrbit(Label),
    /// An axis of a basin of a machine that is no part of a start.
    #[error("`{given}` is no part of a start\nhint: q.NAME, qdot.NAME or phase; the coordinates are {coordinates}")]
    MachineStartAxis {
        /// The given name.
        given: String,
        /// All coordinates.
        coordinates: String,
    },
    /// Something that a diagram of a machine cannot show.
    #[error(
        "`{given}` is nothing that a diagram of a machine shows\nhint: speed, q.NAME, qdot.NAME, or a quantity by its path, as power or stop.NAME.impact_speed_max; the coordinates are {coordinates}"
    )]
    MachineShow {
        /// The given name.
        given: String,
        /// All coordinates.
        coordinates: String,
    },
    /// A number of a body in two forms.
    #[error("{0} and {1} are two forms of one number, and both are given")]
    TwoForms(&'static str, &'static str),
    /// A stop that moves by itself, and a base that moves too.
    #[error("the motion of the stop is given, and a base that moves: a stop moves with its base or is fixed in space")]
    StopAndBase,
    /// A number of a body, but the system is an oscillator without units.
    #[error("{0} is a number of a body in SI units, and the system is nondimensional")]
    NoBody(&'static str),
    /// A system whose numbers are not those of its body.
    #[error(
        "{name} = {given} of the system is not that of its body, {own}\nhint: leave the nondimensional numbers out"
    )]
    NotOfBody {
        /// The name of the number.
        name: &'static str,
        /// The number that is given.
        given: f64,
        /// That of the body.
        own: f64,
    },
    /// A number of a body as the side of a plane of parameters.
    #[error(
        "{0} and {1} do not span a plane: {0} is measured in units that change with the numbers of the body\nhint: take frequency_hz, gap_m or second_gap_m instead of {0}"
    )]
    MixedPlane(&'static str, &'static str),
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
    /// A logarithmic range with an end that is not positive.
    #[error("range `{given}` is logarithmic, so both ends must be positive")]
    Logarithmic {
        /// The given text.
        given: String,
    },
    /// A range with a number of values that is too small or too large.
    #[error("range `{given}` asks for {}; allowed is 1 to {most}, and 1 only when A = B", counted(*count, "value"))]
    Count {
        /// The given text.
        given: String,
        /// The number of values requested.
        count: u64,
        /// The largest number allowed.
        most: u64,
    },
    /// A list of values that is empty or too long, or contains a value that is repeated or not finite.
    #[error("a list of {} was given: allowed are 1 to {most} finite numbers, none of them twice{}",
        counted(*count as u64, "value"), wrong.map_or_else(String::new, |value| format!(", not {value}")))]
    Listed {
        /// The length of the list.
        count: usize,
        /// The largest length allowed.
        most: u64,
        /// The invalid value; `None` if the length is the error.
        wrong: Option<f64>,
    },
    /// A list of a diagram with values that neither rise nor fall.
    #[error("the values of a diagram rise or fall, and those of the list do neither\nhint: sort them")]
    Order,
    /// A point of a list that is invalid.
    #[error("{}", at_point(error, *point))]
    AtPoint {
        /// The number of the point, counted from 0.
        point: u64,
        /// What is invalid.
        error: Box<Self>,
    },
    /// Columns of points that have different lengths.
    #[error("{} has {} values and {} has {}: every column has one value for each point", names.0, counts.0, names.1, counts.1)]
    PointColumns {
        /// The names of two columns.
        names: (Cow<'static, str>, Cow<'static, str>),
        /// Their lengths.
        counts: (usize, usize),
    },
    /// A value of a point that is not finite.
    #[error("{name} = {value} is not finite (point {point})")]
    PointValue {
        /// The name of the column.
        name: Cow<'static, str>,
        /// The value.
        value: f64,
        /// The number of the point, counted from 0.
        point: u64,
    },
    /// The number of sides of the box from which points are drawn.
    #[error("ranges given: {given}; points are drawn from 1 to {most}")]
    PointSides {
        /// The number given.
        given: usize,
        /// The largest number allowed.
        most: usize,
    },
    /// Points with a refinement between neighbours.
    #[error("points have no neighbours, so nothing is between them to refine")]
    PointsRefined,
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
    /// A basin whose axes are all parameters.
    #[error(
        "a basin needs an axis over x, v or phase\nhint: which motions there are at points of a plane of parameters is a map"
    )]
    NoStartAxis,
    /// A name of nothing that the system has.
    #[error("{0}")]
    Name(String),
    /// A branch or a curve of an oscillator without the label of an orbit.
    #[error("the label of the orbit to follow is not given\nhint: label m/n, for example 1/1")]
    NoLabel,
    /// A curve that only machines have.
    #[error("an oscillator has no curve of {0}; its curves are fold, flip and grazing")]
    NoCurve(&'static str),
    /// The scales or the lines of a box, which margins of machines do not have.
    #[error("margins of a machine have no box, so no scales and no lines")]
    NoBox,
    /// Points of a machine in a basin, or transients of its motions.
    #[error("a basin of a machine has axes only\nhint: the task settle_many has points")]
    NoPoints,
    /// A start in the task of a machine.
    #[error("the start of a machine is its table `start`, and the task has one too")]
    StartTwice,
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
    /// The frame of positions and phases is not finite.
    #[error("the frame of positions and phases is not finite: phase = {phase}, offset_m = {offset_m}")]
    Frame {
        /// The given phase.
        phase: f64,
        /// The given offset.
        offset_m: f64,
    },
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
    /// More numbers than one run keeps in memory.
    #[error("{numbers} numbers would have to be kept; at most {most} fit\nhint: give a store, which holds any number")]
    Memory {
        /// The number of numbers requested.
        numbers: u64,
        /// The largest allowed number.
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
    /// A branch that is followed both ways begins at one of its ends, or outside them.
    #[error(
        "{name} = {value} of the system does not lie between {back} and {to}\nhint: a branch is followed both ways from the system"
    )]
    OneSide {
        /// The name of the parameter.
        name: Cow<'static, str>,
        /// Its value.
        value: f64,
        /// The ends of its range.
        back: f64,
        /// The same.
        to: f64,
    },
    /// The scale of a parameter is not positive and finite.
    #[error(
        "the scale of {name} is {given}: a positive finite number is needed\nhint: it is the change of {name} that counts as 1 in the box"
    )]
    Scale {
        /// The name of the parameter.
        name: &'static str,
        /// The given value.
        given: f64,
    },
    /// Two parameters that are to vary are the same one.
    #[error("{0} and {1} are both to vary: each parameter varies once, and the frequency in one form")]
    VariedTwice(&'static str, &'static str),
    /// A motion is given both by its label and by a start.
    #[error("the motion is given twice, by its label and by a start\nhint: a label alone, or a start alone")]
    LabelAndStart,
    /// The ends of a range of a parameter are not finite or not in rising order.
    #[error("{name} from {from} to {to} is no range: two finite numbers in rising order are needed")]
    Stretch {
        /// The name of the parameter.
        name: Cow<'static, str>,
        /// The first end.
        from: f64,
        /// The second end.
        to: f64,
    },
    /// The range of a parameter is so narrow that rounding leaves too few values in it.
    #[error(
        "{name} from {from:?} to {to:?} is too narrow a range to follow curves through: rounding leaves no steps in it\nhint: a width of at least {least:.1e}"
    )]
    Narrow {
        /// The name of the parameter.
        name: &'static str,
        /// The first end.
        from: f64,
        /// The second end.
        to: f64,
        /// The smallest allowed width.
        least: f64,
    },
    /// The two parameters of a plane are the same parameter.
    #[error("{0} and {1} do not span a plane: they are one parameter")]
    SameParameter(Cow<'static, str>, Cow<'static, str>),
    /// The value of a parameter in the system lies outside the given range.
    #[error(
        "{name} = {value} lies outside the range from {from} to {to}\nhint: the orbit to begin with is looked for at the system given"
    )]
    Outside {
        /// The name of the parameter.
        name: Cow<'static, str>,
        /// Its value in the system.
        value: f64,
        /// Smallest value of the range.
        from: f64,
        /// Largest value of the range.
        to: f64,
    },
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

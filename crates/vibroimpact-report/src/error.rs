//! The errors of answers, figures and tables.

use crate::number::short;
use vibroimpact_plot::PlotError;
use vibroimpact_study::{PlanError, RunError, Stopped};

/// The reason why a result has no figure or table. The message names the cause, often with a hint.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReportError {
    /// The values of an axis neither rise nor fall.
    #[error("a figure needs values in rising or falling order\nhint: a table takes any order")]
    Order,
    /// Numbers that are those of no contact.
    #[error("{0}")]
    Contact(String),
    /// The number of axes is neither one nor two.
    #[error("a figure needs one or two axes, not {0}\nhint: a table takes any number, and xarray opens a store")]
    Axes(usize),
    /// An axis has more values than a figure can show.
    #[error("a figure shows at most {most} values on an axis, not {given}")]
    Values {
        /// The number of values.
        given: usize,
        /// The largest allowed number.
        most: usize,
    },
    /// Exponents over a number of axes other than one.
    #[error("exponents are drawn over one axis\nhint: a table or xarray takes more")]
    Exponents,
    /// A store of scattered starts.
    #[error("scattered starts have no figure\nhint: a table has them all")]
    Scattered,
    /// A store without the field to be drawn.
    #[error("there are no labels")]
    NoLabels,
    /// A colour by a quantity that the plan does not ask for.
    #[error(
        "there are no values of `{}`: the plan asks for {}\nhint: --fields {} computes them",
        flag(field),
        listed(there),
        flag(field)
    )]
    NoField {
        /// The name of the quantity.
        field: String,
        /// The quantities that the plan asks for.
        there: Vec<String>,
    },
    /// A bifurcation diagram of something that branches of machines do not have.
    #[error(
        "branches of a machine have speeds of closings, if it has stops, and quantities, not `{show}`\nhint: a quantity, such as --show q.{coordinate}.displacement_max"
    )]
    NoBranchValue {
        /// What was to be shown.
        show: String,
        /// The name of a coordinate of the machine.
        coordinate: String,
    },
    /// A colour by a quantity in a figure without cells or motions.
    #[error("only maps and basins have colours by a quantity")]
    NoColours,
    /// Layers, a mark or a line in the figure of anything but a map over two parameters.
    #[error("layers, a mark and a line are drawn over a map of two parameters\nhint: two parameters with ranges")]
    NoPlane,
    /// A layer that shows motions, in a figure in the colours of a quantity.
    #[error("the layer {0} shows motions, and the figure shows a quantity\nhint: leave out {0}")]
    LayerOfMotions(&'static str),
    /// The amplitude in a plane without a gap.
    #[error("the layer amplitude needs the gap on an axis\nhint: a range of --gap or --gap-m")]
    NoGapAxis,
    /// A mark or a line outside the figure.
    #[error(
        "{name} = {value} of the {what} lies outside {low} <= {name} <= {high}, the axis of the figure\nhint: coordinates are in the units of the axes, the abscissa first"
    )]
    Outside {
        /// Whether it is the mark or the line.
        what: &'static str,
        /// The name of the axis.
        name: String,
        /// The given value.
        value: f64,
        /// The smallest value on the axis.
        low: f64,
        /// The largest value on the axis.
        high: f64,
    },
    /// A waveform with more points than a table may have.
    #[error(
        "step = {} gives {} points over a time of {}; at most {most} are allowed\nhint: a longer step, or fewer periods or impacts",
        short(*step), short(until / step), short(*until)
    )]
    Points {
        /// Time between the points.
        step: f64,
        /// Duration of the waveform.
        until: f64,
        /// The largest allowed number of points.
        most: f64,
    },
    /// A motion of a machine that is no cycle, where one period of a cycle would be drawn.
    #[error(
        "the settled motion has no state or no period from which it can be shown: {0}\nhint: `vibro simulate --machine --plot` draws any motion"
    )]
    NoCycle(String),
    /// A motion that is not periodic has no margins.
    #[error("the motion `{0}` is not periodic, so it has no margins to draw")]
    NoMargins(String),
    /// A motion without multipliers.
    #[error("the motion `{0}` has no multipliers\nhint: periodic motions have, and those without impacts")]
    NoMultipliers(String),
    /// The sections of a settled motion of a machine.
    #[error("--show sections is for oscillators\nhint: of a machine, `vibro lyapunov --points N` has both sections")]
    MachineSections,
    /// The figure cannot be rendered.
    #[error("the figure failed: {0}")]
    Plot(#[from] PlotError),
    /// A value overflows in the units of the results.
    #[error(transparent)]
    Plan(#[from] PlanError),
}

/// A quantity as the command writes it.
fn flag(field: &str) -> String {
    // names of stops and coordinates are as they are
    match field.rsplit_once('.') {
        Some((part, name)) => format!("{part}.{}", name.replace('_', "-")),
        None => field.replace('_', "-"),
    }
}

/// A list of quantities in a sentence.
fn listed(quantities: &[String]) -> String {
    match quantities {
        [] => "no quantities".to_owned(),
        list => list.iter().map(|field| flag(field)).collect::<Vec<_>>().join(", "),
    }
}

/// The reason why there is no answer, or no figure or table of it.
#[derive(Debug, thiserror::Error)]
pub enum AnswerError {
    /// The question is invalid.
    #[error(transparent)]
    Plan(PlanError),
    /// The run was stopped by its caller.
    #[error(transparent)]
    Stopped(#[from] Stopped),
    /// The result cannot be drawn or tabulated.
    #[error(transparent)]
    Report(ReportError),
}

impl From<PlanError> for AnswerError {
    fn from(error: PlanError) -> Self {
        Self::Plan(error)
    }
}

impl From<RunError> for AnswerError {
    fn from(error: RunError) -> Self {
        match error {
            RunError::Plan(error) => Self::Plan(error),
            RunError::Stopped(error) => Self::Stopped(error),
        }
    }
}

impl From<ReportError> for AnswerError {
    fn from(error: ReportError) -> Self {
        match error {
            ReportError::Plan(error) => Self::Plan(error),
            error => Self::Report(error),
        }
    }
}

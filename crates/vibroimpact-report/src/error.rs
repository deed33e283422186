//! What cannot be drawn, or not be tabulated.

use crate::number::short;
use vibroimpact_plot::PlotError;
use vibroimpact_study::PlanError;

/// Why a result has no such figure or table. The sentence names what is asked too much, often with a hint.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReportError {
    /// Values on an axis that are in no order.
    #[error("a figure needs values in rising or falling order\nhint: a table takes any order")]
    Order,
    /// Another number of axes than two.
    #[error("a figure needs two axes, not {0}\nhint: a table takes any number, and xarray opens a store")]
    Axes(usize),
    /// An axis with more values than a picture can have.
    #[error("a figure shows at most {most} values on an axis, not {given}")]
    Values {
        /// Values asked for.
        given: usize,
        /// The most.
        most: usize,
    },
    /// Exponents over more or fewer than one axis.
    #[error("exponents are drawn over one axis\nhint: a table or xarray takes more")]
    Exponents,
    /// A store of scattered starts.
    #[error("scattered starts have no figure\nhint: a table has them all")]
    Scattered,
    /// A store without the field that is drawn.
    #[error("there are no labels")]
    NoLabels,
    /// A waveform with more points than a table should have.
    #[error(
        "step = {} gives {} points over a time of {}; at most {most} are allowed\nhint: a longer step, or fewer periods or impacts",
        short(*step), short(until / step), short(*until)
    )]
    Points {
        /// Time between points.
        step: f64,
        /// The time they are to cover.
        until: f64,
        /// The most.
        most: f64,
    },
    /// Multipliers of a motion without any.
    #[error("the motion `{0}` has no multipliers\nhint: periodic motions have, and those without impacts")]
    NoMultipliers(String),
    /// The picture cannot be made.
    #[error("the figure failed: {0}")]
    Plot(#[from] PlotError),
    /// A range in the units of the results leaves the range of numbers.
    #[error(transparent)]
    Plan(#[from] PlanError),
}

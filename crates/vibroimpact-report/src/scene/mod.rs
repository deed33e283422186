//! Pictures of a settled motion and of branches along a line, beside the figures of the commands. Each has a size of its own; [`Figure::size`] gives it another.
//!
//! [`Figure::size`]: vibroimpact_plot::Figure::size

mod bifurcation;
mod multipliers;
mod phase;
mod sections;
mod view;

pub use bifurcation::{bifurcation, labels};
pub use multipliers::multipliers;
pub use phase::phase_portrait;
pub use view::{SECTION_POINTS, View, Viewed};

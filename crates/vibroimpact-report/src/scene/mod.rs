//! Figures of a settled motion, and of branches along a line, in addition to those of the commands. Each has a default
//! size, which [`Figure::size`] changes.
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

//! Figures of a settled motion, and of branches along a line, in addition to those of the commands. Each has a default
//! size, which [`Figure::size`] changes. A [`SampledMotion`] is a motion as numbers, for a page that animates it.
//!
//! [`Figure::size`]: vibroimpact_plot::Figure::size

mod bifurcation;
mod multipliers;
mod phase;
mod sampled_motion;
mod view;

pub(crate) use bifurcation::strobes;
pub use bifurcation::{BifurcationDiagram, BifurcationEvent, bifurcation, labels, machine_bifurcation};
pub use multipliers::multipliers;
pub(crate) use phase::machine_portrait;
pub use phase::phase_portrait;
pub use sampled_motion::SampledMotion;
pub use view::{SECTION_POINTS, View};

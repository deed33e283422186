//! Figures of a settled motion, and of branches along a line, in addition to those of the commands. Each has a default
//! size, which [`Figure::size`] changes. A [`SampledMotion`] is a motion as numbers, for a page that animates it.
//!
//! [`Figure::size`]: vibroimpact_plot::Figure::size

mod bifurcation;
mod multipliers;
mod phase;
mod sampled_motion;

pub(crate) use bifurcation::strobes;
pub use bifurcation::{BifurcationDiagram, BifurcationEvent, bifurcation, labels, machine_bifurcation};
pub use multipliers::multipliers;
pub(crate) use phase::machine_portrait;
pub use phase::phase_portrait;
pub use sampled_motion::SampledMotion;

use serde::Deserialize;

/// Number of impacts and states of a section.
pub const SECTION_POINTS: u64 = 2000;

/// A view of a settled motion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum View {
    /// Position over time.
    #[default]
    Waveform,
    /// Velocity over position.
    Phase,
    /// Floquet multipliers in the complex plane.
    Multipliers,
    /// Phase and speed of its impacts, and its states at phase 0 of the force.
    Sections,
}

impl View {
    /// All views.
    pub const ALL: [Self; 4] = [Self::Waveform, Self::Phase, Self::Multipliers, Self::Sections];

    /// Its name in commands and requests.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Waveform => "waveform",
            Self::Phase => "phase",
            Self::Multipliers => "multipliers",
            Self::Sections => "sections",
        }
    }
}

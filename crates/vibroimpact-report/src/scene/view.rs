//! The views of a settled motion: over time, in the phase plane, by its multipliers, and in both sections. Each has a
//! figure and a table of the same data.

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

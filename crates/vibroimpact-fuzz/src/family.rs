//! The families of cases.

use clap::ValueEnum;
use core::fmt;

/// A family of cases: the kind of its questions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Family {
    /// Command lines.
    Commands,
    /// Plans in memory.
    Plans,
    /// Damaged stores.
    Stores,
    /// Requests to the explorer.
    Page,
    /// Starts, settled alone and in batches.
    Verdicts,
    /// Degenerate machines.
    Machines,
}

impl Family {
    /// Its share of the time, relative to those of the others.
    #[must_use]
    pub const fn weight(self) -> u32 {
        match self {
            Self::Commands => 4,
            Self::Plans | Self::Verdicts | Self::Machines => 2,
            Self::Stores | Self::Page => 1,
        }
    }
}

/// Its name on the command line.
impl fmt::Display for Family {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.to_possible_value().unwrap_or_default().get_name())
    }
}

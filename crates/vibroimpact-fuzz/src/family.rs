//! The families of cases.

use core::fmt;

/// A family of cases: the kind of its questions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
    /// All families.
    pub const ALL: [Self; 6] = [Self::Commands, Self::Plans, Self::Stores, Self::Page, Self::Verdicts, Self::Machines];

    /// Its name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Commands => "commands",
            Self::Plans => "plans",
            Self::Stores => "stores",
            Self::Page => "page",
            Self::Verdicts => "verdicts",
            Self::Machines => "machines",
        }
    }

    /// The family with this name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|family| family.name() == name)
    }

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

impl fmt::Display for Family {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_found() {
        for family in Family::ALL {
            assert_eq!(Family::named(family.name()), Some(family));
        }
        assert_eq!(Family::named("all"), None);
    }
}

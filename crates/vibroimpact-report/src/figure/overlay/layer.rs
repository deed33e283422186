//! The layers of a map by name.

/// A layer of the figure of a map over two parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Layer {
    /// The boundaries of the regions in which simple motions are stable.
    Regions,
    /// The amplitude of the motion without stops, where a gap is on an axis.
    Amplitude,
    /// The points of the 1971 paper.
    Paper,
    /// Stripes where motions coexist.
    Stripes,
    /// Lines between cells with different motions.
    Boundaries,
}

impl Layer {
    /// All layers.
    pub const ALL: [Self; 5] = [Self::Regions, Self::Amplitude, Self::Paper, Self::Stripes, Self::Boundaries];

    /// Its name in commands and requests.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Regions => "regions",
            Self::Amplitude => "amplitude",
            Self::Paper => "paper",
            Self::Stripes => "stripes",
            Self::Boundaries => "boundaries",
        }
    }

    /// The layer with this name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|layer| layer.name() == name)
    }

    /// Whether it shows the motions in the cells and not something over them.
    pub(crate) const fn of_motions(self) -> bool {
        matches!(self, Self::Stripes | Self::Boundaries)
    }
}

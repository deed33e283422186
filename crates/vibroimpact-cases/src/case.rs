//! A case: a machine, a start, and what is known of its motion without computing it.

use vibroimpact::events::Start;
use vibroimpact::machine::{Machine, MachineParts, StopLaw};

/// A map of a machine onto itself: coordinate `i` of the image is `signs[i] * q[from[i]]`, and what stop or joint `k` does
/// in a motion, `places[k]` does in its image. Joints are counted after the stops.
#[derive(Clone, Debug, PartialEq)]
pub struct Symmetry {
    /// The coordinate that each coordinate of the image is.
    pub from: Vec<usize>,
    /// Its sign.
    pub signs: Vec<f64>,
    /// The stop or joint that each of them becomes.
    pub places: Vec<usize>,
}

impl Symmetry {
    /// A row of coordinates from its other end, with this sign.
    pub(crate) fn reversed(n: usize, sign: f64, places: Vec<usize>) -> Self {
        Self { from: (0..n).rev().collect(), signs: vec![sign; n], places }
    }

    /// Coordinates with signs of their own.
    pub(crate) fn mirrored(n: usize, sign: impl Fn(usize) -> f64, places: Vec<usize>) -> Self {
        Self { from: (0..n).collect(), signs: (0..n).map(sign).collect(), places }
    }

    /// The image of a vector of coordinates, velocities, forces, or a direction.
    #[must_use]
    pub fn image(&self, vector: &[f64]) -> Vec<f64> {
        self.from.iter().zip(&self.signs).map(|(from, sign)| sign * vector[*from]).collect()
    }
}

/// What a family draws.
#[derive(Clone, Debug)]
pub struct Drawn {
    /// The numbers of the machine.
    pub parts: MachineParts,
    /// The start.
    pub start: Start,
    /// Maps of machine and start onto themselves: the motion is its own image.
    pub symmetries: Vec<Symmetry>,
    /// Pairs of coordinates that stay equal.
    pub equal: Vec<(usize, usize)>,
    /// A machine of the same coordinates that moves in the same way.
    pub same_as: Option<MachineParts>,
}

impl Drawn {
    /// A machine and a start of which nothing more is known.
    #[must_use]
    pub const fn new(parts: MachineParts, start: Start) -> Self {
        Self { parts, start, symmetries: Vec::new(), equal: Vec::new(), same_as: None }
    }

    /// The same, with a map onto itself.
    #[must_use]
    pub fn symmetric(mut self, symmetry: Symmetry) -> Self {
        self.symmetries.push(symmetry);
        self
    }

    /// The same; all coordinates stay equal.
    #[must_use]
    pub fn together(mut self) -> Self {
        self.equal = (1..self.parts.n()).map(|i| (0, i)).collect();
        self
    }
}

/// A machine, a start, and what is known of its motion.
#[derive(Clone, Debug)]
pub struct Case {
    /// The name of its family.
    pub family: &'static str,
    /// Its seed in the family.
    pub seed: u64,
    /// The machine.
    pub machine: Machine,
    /// The start.
    pub start: Start,
    /// Maps of machine and start onto themselves.
    pub symmetries: Vec<Symmetry>,
    /// Pairs of coordinates that stay equal.
    pub equal: Vec<(usize, usize)>,
    /// A machine that moves in the same way.
    pub same_as: Option<Machine>,
}

impl Case {
    /// Whether any stop is rigid.
    #[must_use]
    pub fn has_rigid_stop(&self) -> bool {
        self.machine.stops().iter().any(|stop| matches!(stop.law, StopLaw::Rigid { .. }))
    }
}

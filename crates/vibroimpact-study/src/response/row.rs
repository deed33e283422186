//! What is told of the motions of a response, for every kind of system.

use vibroimpact::verdict::Stability;

/// A motion of a sweep, or an orbit at a point of a branch.
#[derive(Clone, Debug, PartialEq)]
pub struct ResponseRow {
    /// The value of the number that varies.
    pub value: f64,
    /// The label of the motion.
    pub label: String,
    /// Whether it is a motion; a solution of the equations of a branch may pass through a stop.
    pub admissible: bool,
    /// Whether neighbours approach it; `None` if that is not known.
    pub stability: Option<Stability>,
    /// The event of the branch at this point.
    pub event: Option<&'static str>,
    /// All quantities, in the order of their names; not-a-number where one is not defined.
    pub quantities: Vec<f64>,
}

impl ResponseRow {
    /// Whether it is a motion that attracts its neighbourhood.
    #[must_use]
    pub fn stable(&self) -> bool {
        self.admissible && self.stability == Some(Stability::Stable)
    }
}

/// The response over a number. Values and quantities of an oscillator are nondimensional.
#[derive(Clone, Debug, PartialEq)]
pub struct ResponseCurves {
    /// The names of the quantities, and which of them is reported.
    pub quantities: Vec<String>,
    /// See above.
    pub shown: usize,
    /// The motions of the sweep with rising values, in this order.
    pub up: Vec<ResponseRow>,
    /// The motions of the sweep with falling values, in this order.
    pub down: Vec<ResponseRow>,
    /// The branches on which cycles of the sweeps lie, from one end to the other.
    pub branches: Vec<Vec<ResponseRow>>,
}

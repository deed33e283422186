//! The orbit from which the trace of a region begins.

use crate::orbit::Ring;
use crate::system::Oscillator;

/// An orbit at a point of the plane. `below`: whether its multipliers are below +1.
#[derive(Clone, Debug)]
pub(crate) struct Seed {
    pub(crate) ring: Ring,
    pub(crate) osc: Oscillator,
    pub(crate) below: bool,
}

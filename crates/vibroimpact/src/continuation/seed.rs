//! Where a walk round a region begins.

use crate::orbit::Ring;
use crate::system::Oscillator;

/// An orbit at a point of the plane.
#[derive(Clone, Debug)]
pub(super) struct Seed {
    pub(super) ring: Ring,
    pub(super) osc: Oscillator,
    pub(super) below: bool,
}

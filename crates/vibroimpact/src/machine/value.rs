//! A checked machine.

use super::parts::{FrictionJoint, MachineParts, Stop};
use super::{Fault, MachineError, checks, path};
use crate::math::Matrix;
use core::f64::consts::TAU;

/// A checked machine: a linear structure with stops and friction joints.
///
/// ```
/// use vibroimpact::machine::{Machine, MachineParts};
/// // two bodies on springs; the first strikes a wall
/// let parts = MachineParts::new(["body", "shoe"])
///     .with_mass(0, 1.0)
///     .with_mass(1, 1.0)
///     .with_link(&[1.0, -1.0], 1.0, 0.03)
///     .with_link(&[0.0, 1.0], 1.0, 0.03)
///     .with_frequency(0.66)
///     .with_force(1, 1, 0.1, 0.0)
///     .with_rigid_stop("wall", &[1.0, 0.0], 1.0, 0.8);
/// let machine = Machine::new(parts)?;
/// assert_eq!(machine.number("stop.wall.gap")?, 1.0);
/// let closer = machine.with("stop.wall.gap", 0.5)?;
/// assert_eq!(closer.parts().stops[0].gap, 0.5);
/// # Ok::<(), vibroimpact::machine::MachineError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Machine {
    parts: MachineParts,
    /// The lower factor of the mass matrix, $`M = LL^T`$.
    factor: Matrix,
}

impl Machine {
    /// Checks the numbers.
    ///
    /// # Errors
    /// [`MachineError`] with the path of the first number that is not allowed.
    pub fn new(parts: MachineParts) -> Result<Self, MachineError> {
        checks::check(&parts)?;
        let mut parts = parts;
        // to the last bit, so that it does not matter which triangle is read
        for matrix in [&mut parts.mass, &mut parts.damping, &mut parts.stiffness] {
            matrix.symmetrise();
        }
        let factor = parts.mass.cholesky().ok_or_else(|| MachineError::new("mass", Fault::NotPositiveDefinite))?;
        Ok(Self { parts, factor })
    }

    /// The numbers.
    #[must_use]
    pub const fn parts(&self) -> &MachineParts {
        &self.parts
    }

    /// Number of coordinates.
    #[must_use]
    pub fn n(&self) -> usize {
        self.parts.n()
    }

    /// The stops.
    #[must_use]
    pub fn stops(&self) -> &[Stop] {
        &self.parts.stops
    }

    /// The friction joints.
    #[must_use]
    pub fn joints(&self) -> &[FrictionJoint] {
        &self.parts.joints
    }

    /// The name of a stop, or of a joint, which are counted after the stops.
    #[must_use]
    pub fn name_of(&self, place: usize) -> &str {
        let stops = self.parts.stops.len();
        if place < stops { &self.parts.stops[place].name } else { &self.parts.joints[place - stops].name }
    }

    /// The period of the forcing; `None` without forcing.
    #[must_use]
    pub fn period(&self) -> Option<f64> {
        self.parts.frequency.map(|frequency| TAU / frequency)
    }

    /// The lower factor of the mass matrix.
    pub(crate) const fn factor(&self) -> &Matrix {
        &self.factor
    }

    /// The number at a path, as `stop.wall.gap`. [`Machine::paths`] lists all.
    ///
    /// # Errors
    /// [`MachineError`] if the path leads to no number.
    pub fn number(&self, path: &str) -> Result<f64, MachineError> {
        self.parts.number(path)
    }

    /// The same machine with another number at a path. A number of a symmetric matrix changes in both places.
    ///
    /// # Errors
    /// [`MachineError`] if the path leads to no number, or if the number is not allowed.
    pub fn with(&self, path: &str, value: f64) -> Result<Self, MachineError> {
        let mut parts = self.parts.clone();
        parts.set(path, value)?;
        Self::new(parts)
    }

    /// The paths of all numbers that are written or not zero, in the order of the description.
    #[must_use]
    pub fn paths(&self) -> Vec<String> {
        self.numbers().into_iter().map(|(path, _)| path).collect()
    }

    /// The same paths with their numbers.
    #[must_use]
    pub fn numbers(&self) -> Vec<(String, f64)> {
        path::all(&self.parts)
    }
}

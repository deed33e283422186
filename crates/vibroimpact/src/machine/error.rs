//! Errors of machines: the path of the number, what is wrong with it, and often a hint.

use thiserror::Error;

/// A machine that is not one, or a path that leads to no number.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{path}: {fault}")]
pub struct MachineError {
    /// The path of the number or of the part, as `stop.wall.gap`.
    pub path: String,
    /// What is wrong.
    pub fault: Fault,
}

/// What is wrong with a part of a machine.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum Fault {
    /// No coordinates.
    #[error("a machine needs at least one coordinate")]
    NoCoordinates,
    /// More coordinates than a machine can have.
    #[error(
        "a machine has at most {most} coordinates, and this one has {0}\nhint: describe a large structure by its lowest modes",
        most = super::MOST_COORDINATES
    )]
    TooLarge(usize),
    /// A name that cannot be a part of a path.
    #[error("{0:?} is not a name\nhint: letters, digits, _ and -, at least one")]
    Name(String),
    /// Two parts of one kind with one name.
    #[error("the name is used twice")]
    Twice,
    /// A vector or matrix of another size.
    #[error("has {given}, and the machine has {n} coordinates")]
    Size {
        /// The size given, as text.
        given: String,
        /// The number of coordinates.
        n: usize,
    },
    /// A number that is not finite.
    #[error("{0} is not a finite number")]
    NotFinite(f64),
    /// A matrix that is not symmetric.
    #[error("the matrix is not symmetric: {one} in row {row}, column {column}, and {other} in the other place")]
    NotSymmetric {
        /// Row, from 1.
        row: usize,
        /// Column, from 1.
        column: usize,
        /// The value there.
        one: f64,
        /// The value in the transposed place.
        other: f64,
    },
    /// A mass matrix that is not positive definite.
    #[error("the mass matrix is not positive definite\nhint: each coordinate needs a mass")]
    NotPositiveDefinite,
    /// A damping or stiffness matrix with a negative eigenvalue.
    #[error(
        "the matrix has a negative eigenvalue, {0}\nhint: damping and stiffness are positive semidefinite; springs that push away from the rest position and dampers that feed energy are not supported"
    )]
    Negative(f64),
    /// A number outside its range.
    #[error("{value} lies outside {range}")]
    Range {
        /// The value.
        value: f64,
        /// The allowed range, as text.
        range: &'static str,
    },
    /// Forces or moving stops without a frequency.
    #[error("a harmonic needs the frequency of the forcing\nhint: frequency = 1.5")]
    NoFrequency,
    /// A stop or joint without direction.
    #[error("the direction is zero")]
    NoDirection,
    /// Two rigid stops that leave no room.
    #[error("the stop overlaps {other:?} when both are at rest: they leave a room of {room}, which must be positive")]
    NoRoom {
        /// The name of the other stop.
        other: String,
        /// The sum of the gaps, for a direction of length 1.
        room: f64,
    },
    /// A path that leads to no number.
    #[error("no such number in this machine\nhint: {0}")]
    NoNumber(String),
    /// A start of another size, or beyond a stop.
    #[error("the start lies {0} beyond the stop\nhint: give a start with --q that leaves the gap open")]
    Beyond(f64),
    /// A contact of a start that does not agree with its coordinates and velocities, or a part of it that is not one.
    #[error("{0}\nhint: a contact that is left out follows from coordinates and velocities")]
    Contact(String),
}

impl MachineError {
    pub(crate) fn new(path: impl Into<String>, fault: Fault) -> Self {
        Self { path: path.into(), fault }
    }
}

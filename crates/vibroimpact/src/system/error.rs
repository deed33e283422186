//! Errors of parameters, starts and units: the value, the allowed range, and often a hint.

use thiserror::Error;

/// A number in the fewest digits that identify it, with an exponent if it is far from 1.
fn written(x: f64) -> String {
    if x == 0.0 || (1e-5..1e16).contains(&x.abs()) || !x.is_finite() { format!("{x}") } else { format!("{x:e}") }
}

/// An invalid parameter or start. Each variant contains the value.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum SystemError {
    /// The frequency ratio is not a number in [1e-15, 1e15].
    #[error(
        "frequency ratio beta = {} lies outside 1e-15 <= beta <= 1e15\nhint: beta = omega / omega_n",
        written(*.0)
    )]
    Beta(f64),
    /// The inverse frequency ratio is not a number in [1e-15, 1e15].
    #[error(
        "inverse frequency ratio 1/beta = {} lies outside 1e-15 <= 1/beta <= 1e15\nhint: 1/beta = omega_n / omega",
        written(*.0)
    )]
    InverseBeta(f64),
    /// The gap is not a number in [-1e100, 1e100].
    #[error(
        "gap delta = {} lies outside -1e100 <= delta <= 1e100\nhint: a negative gap presses the mass against the stop at rest",
        written(*.0)
    )]
    Gap(f64),
    /// The restitution is outside [0, 1].
    #[error("restitution eps = {0} lies outside 0 <= eps <= 1\nhint: eps is the ratio of velocities, not of energies")]
    Restitution(f64),
    /// The damping ratio is neither 0 nor a number in [1e-100, 1e15].
    #[error(
        "damping ratio zeta = {} lies outside 0 <= zeta <= 1e15 or between 0 and 1e-100\nhint: zeta = c / (2 sqrt(k m))",
        written(*.0)
    )]
    Damping(f64),
    /// The two stops leave no room between them.
    #[error(
        "the stops at x = {upper} and x = {lower} leave the mass no room: the sum of the gaps, {width}, must be positive\nhint: the second stop stands at x = -gap of its own"
    )]
    NoRoom {
        /// Position of the first stop.
        upper: f64,
        /// Position of the second stop.
        lower: f64,
        /// Their distance.
        width: f64,
    },
    /// A parameter of the second stop, but there is only one stop.
    #[error("{0} is a parameter of the second stop, and there is only one stop\nhint: give the second stop first")]
    NoSecondStop(&'static str),
    /// A second parameter on a line of oscillators that follow from another number.
    #[error("{0} cannot vary in proportion: the line is that of another number")]
    OwnLine(&'static str),
    /// A machine that is no oscillator, at this value of a number.
    #[error("at {0} the machine is no oscillator")]
    NoOscillator(f64),
    /// Two parameters on one line that are the same.
    #[error("{0} and {1} cannot vary together: a line goes through two different parameters")]
    Together(&'static str, &'static str),
    /// A parameter whose rate along a line is not finite.
    #[error("{name} would change by {rate} for a change of the other parameter by 1, which is not a finite number")]
    Rate {
        /// The parameter.
        name: &'static str,
        /// The rate.
        rate: f64,
    },
    /// A start beyond a stop.
    #[error("start x = {x} lies beyond the stop: x must be in [{lowest}, {highest}]")]
    BeyondStop {
        /// The position given.
        x: f64,
        /// Position of the second stop, or minus infinity.
        lowest: f64,
        /// Position of the first stop.
        highest: f64,
    },
    /// A start that is not a finite number.
    #[error("start {name} = {value} is not a finite number")]
    StartNotFinite {
        /// `x`, `v` or `phase`.
        name: &'static str,
        /// The value given.
        value: f64,
    },
    /// A start whose position or velocity is so large that its energy could overflow.
    #[error("start {name} = {} lies outside -1e100 <= {name} <= 1e100", written(*.value))]
    LargeStart {
        /// `x` or `v`.
        name: &'static str,
        /// The value given.
        value: f64,
    },
    /// A phase so large that its double does not determine an angle.
    #[error(
        "start phase = {0:?} lies outside -1e15 <= phase <= 1e15\nhint: numbers that large are too far apart to be angles; give the phase modulo 2 pi"
    )]
    LargePhase(f64),
    /// A physical quantity outside its range.
    #[error("{name} = {value} {unit} lies outside {range}\nhint: {hint}")]
    Quantity {
        /// Name of the quantity.
        name: &'static str,
        /// The value given.
        value: f64,
        /// Its unit.
        unit: &'static str,
        /// The allowed range.
        range: &'static str,
        /// How to correct it.
        hint: &'static str,
    },
    /// A conversion whose result is not a finite positive number.
    #[error(
        "these quantities give {name} = {value}, which is not a usable number\nhint: check the units: kg, N/m, N, rad/s, m"
    )]
    Scaling {
        /// The nondimensional number that is invalid.
        name: &'static str,
        /// Its value.
        value: f64,
    },
}

//! The units that may be typed behind numbers.

use core::f64::consts::{PI, TAU};
use vibroimpact_study::typed::shifted;

/// What a number measures, which determines the units that may follow it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum UnitKind {
    Mass,
    Stiffness,
    DampingCoefficient,
    Force,
    Frequency,
    AngularFrequency,
    Length,
    Velocity,
    Acceleration,
    Unbalance,
    Ratio,
    Time,
    Angle,
}

/// How a number in a unit becomes one in the SI unit.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Factor {
    /// Times a power of ten, which is written as the exponent of the number: 1.5 mm is 1.5e-3 m to the last digit.
    Ten(i32),
    /// Divided by a number.
    Over(f64),
    /// Times a number.
    Times(f64),
}

use Factor::{Over, Ten, Times};

/// Standard gravity in m/s^2.
pub(crate) const GRAVITY: f64 = 9.806_65;

impl Factor {
    /// A number in the SI unit.
    pub(crate) fn convert(self, value: f64) -> f64 {
        match self {
            Ten(0) => value,
            Ten(power) => shifted(value, power),
            Over(by) => value / by,
            Times(by) => value * by,
        }
    }
}

impl UnitKind {
    /// All of them, with what they measure.
    pub(crate) const ALL: [(Self, &'static str); 13] = [
        (Self::Mass, "mass"),
        (Self::Stiffness, "stiffness"),
        (Self::DampingCoefficient, "damping coefficient"),
        (Self::Force, "force"),
        (Self::Frequency, "frequency"),
        (Self::AngularFrequency, "angular frequency"),
        (Self::Length, "length"),
        (Self::Velocity, "velocity"),
        (Self::Acceleration, "acceleration"),
        (Self::Unbalance, "unbalance"),
        (Self::Ratio, "ratio"),
        (Self::Time, "time"),
        (Self::Angle, "angle"),
    ];

    /// The units with their factors; the SI unit comes first. They are in the form of [`plain`].
    pub(crate) const fn units(self) -> &'static [(&'static str, Factor)] {
        match self {
            Self::Mass => &[("kg", Ten(0)), ("g", Ten(-3)), ("mg", Ten(-6)), ("t", Ten(3))],
            Self::Stiffness => &[
                ("N/m", Ten(0)),
                ("N/mm", Ten(3)),
                ("N/um", Ten(6)),
                ("kN/m", Ten(3)),
                ("kN/mm", Ten(6)),
                ("MN/m", Ten(6)),
            ],
            Self::DampingCoefficient => &[("Ns/m", Ten(0)), ("kg/s", Ten(0)), ("Ns/mm", Ten(3)), ("kNs/m", Ten(3))],
            Self::Force => &[("N", Ten(0)), ("mN", Ten(-3)), ("kN", Ten(3)), ("MN", Ten(6))],
            Self::Frequency => {
                &[("Hz", Ten(0)), ("kHz", Ten(3)), ("rpm", Over(60.0)), ("1/min", Over(60.0)), ("rad/s", Over(TAU))]
            }
            Self::AngularFrequency => {
                &[("rad/s", Ten(0)), ("Hz", Times(TAU)), ("rpm", Times(TAU / 60.0)), ("1/min", Times(TAU / 60.0))]
            }
            Self::Length => &[("m", Ten(0)), ("cm", Ten(-2)), ("mm", Ten(-3)), ("um", Ten(-6)), ("nm", Ten(-9))],
            Self::Velocity => &[("m/s", Ten(0)), ("cm/s", Ten(-2)), ("mm/s", Ten(-3)), ("um/s", Ten(-6))],
            Self::Acceleration => {
                &[("m/s^2", Ten(0)), ("m/s2", Ten(0)), ("mm/s^2", Ten(-3)), ("mm/s2", Ten(-3)), ("g", Times(GRAVITY))]
            }
            Self::Unbalance => &[("kgm", Ten(0)), ("gm", Ten(-3)), ("kgmm", Ten(-3)), ("gmm", Ten(-6))],
            Self::Ratio => &[("", Ten(0)), ("%", Ten(-2))],
            Self::Time => &[("s", Ten(0)), ("ms", Ten(-3))],
            Self::Angle => &[("rad", Ten(0)), ("deg", Times(PI / 180.0)), ("\u{b0}", Times(PI / 180.0))],
        }
    }

    /// The factor of a unit in the form of [`plain`]; `None` for a unit of another kind, and for no unit.
    pub(crate) fn factor(self, unit: &str) -> Option<Factor> {
        self.units().iter().find(|(name, _)| *name == unit && !name.is_empty()).map(|(_, factor)| *factor)
    }
}

/// A unit without blanks and signs of multiplication, with `u` for micro and `^2` for a square.
pub(crate) fn plain(unit: &str) -> String {
    let unit: String =
        unit.chars().filter(|c| !c.is_whitespace() && !['*', '.', '\u{b7}', '\u{22c5}'].contains(c)).collect();
    unit.replace(['\u{b5}', '\u{3bc}'], "u").replace('\u{b2}', "^2")
}

//! Units of the arrays of studies, as other programs read them.
//!
//! The name of a unit follows UDUNITS, as the CF conventions demand. A nondimensional number is a pure number, with the name
//! `1`; the scale by which it is divided is kept beside it, such as `omega_n F/k` for a velocity.

use crate::BodyNumber;
use vibroimpact::QuantityKind;

/// The unit of the numbers of an array.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unit {
    /// Its name in the notation of UDUNITS; `1` for pure and nondimensional numbers; empty if it is unknown.
    pub name: &'static str,
    /// The scale of a nondimensional number, made of the force amplitude `F`, the stiffness `k`, the mass `m` and the
    /// natural frequency `omega_n`; empty for pure numbers and in physical units.
    pub scale: &'static str,
}

impl Unit {
    /// A pure number.
    pub const NUMBER: Self = Self { name: "1", scale: "" };
    /// An angle, in radians.
    pub const ANGLE: Self = Self { name: "rad", scale: "" };
    /// A nondimensional time.
    pub const TIME: Self = Self { name: "1", scale: "1/omega_n" };
    /// A number of a machine, whose file is in one consistent system of units that it does not name.
    pub const CONSISTENT: Self = Self { name: "", scale: "" };
    /// A nondimensional length.
    pub const LENGTH: Self = Self::nondimensional(QuantityKind::Length);
    /// A nondimensional velocity.
    pub const VELOCITY: Self = Self::nondimensional(QuantityKind::Velocity);
    /// A nondimensional rate.
    pub const RATE: Self = Self::nondimensional(QuantityKind::Rate);

    /// The unit of a nondimensional quantity of this kind.
    pub(crate) const fn nondimensional(kind: QuantityKind) -> Self {
        match kind {
            QuantityKind::Number => Self::NUMBER,
            kind => Self { name: "1", scale: kind.nondimensional() },
        }
    }

    /// The SI unit of a number of a body.
    pub(crate) const fn of_body(number: BodyNumber) -> Self {
        Self { name: number.udunits(), scale: "" }
    }

    /// The kind of quantity whose nondimensional unit it is; a pure number for all other units.
    #[must_use]
    pub fn kind(self) -> QuantityKind {
        QuantityKind::ALL.into_iter().find(|kind| Self::nondimensional(*kind) == self).unwrap_or(QuantityKind::Number)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// UDUNITS: symbols, each with an integer as its exponent, separated by blanks; no slash, no superscript, no fraction.
    fn is_udunits(name: &str) -> bool {
        const SYMBOLS: [&str; 9] = ["m", "s", "kg", "N", "Hz", "J", "W", "rad", "1"];
        name.split(' ').all(|factor| {
            let symbol = factor.trim_end_matches(|c: char| c == '-' || (c.is_ascii_digit() && factor != "1"));
            let power = &factor[symbol.len()..];
            SYMBOLS.contains(&symbol) && (power.is_empty() || power.parse::<i32>().is_ok())
        })
    }

    #[test]
    fn every_name_is_in_udunits() {
        for name in ["m/s", "m/s²", "omega_n", "F/k", "", "radian", "m s^-1"] {
            assert!(!is_udunits(name), "{name}");
        }
        let kinds = QuantityKind::ALL.map(|kind| (kind.udunits(), Unit::nondimensional(kind)));
        for (si, unit) in kinds {
            assert!(is_udunits(si) && unit.name == "1", "{si} {unit:?}");
            assert_eq!(unit.scale.is_empty(), si == "1", "{unit:?}");
        }
        for number in BodyNumber::ALL {
            let unit = Unit::of_body(number);
            assert!(is_udunits(unit.name) && unit.scale.is_empty(), "{number:?} {unit:?}");
            assert_eq!(unit.name == "1", number.unit().is_empty(), "{number:?}");
        }
    }

    #[test]
    fn a_scale_has_one_kind() {
        for kind in QuantityKind::ALL {
            assert_eq!(Unit::nondimensional(kind).kind(), kind);
        }
        assert_eq!([Unit::ANGLE, Unit::TIME].map(Unit::kind), [QuantityKind::Number; 2]);
    }
}

//! Kinds of quantities, and their units.

use super::Scales;

/// The kind of a quantity: what is measured, which determines its unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum QuantityKind {
    /// A pure number.
    Number,
    /// A length.
    Length,
    /// A velocity.
    Velocity,
    /// An acceleration.
    Acceleration,
    /// A force.
    Force,
    /// An impulse.
    Impulse,
    /// An energy.
    Energy,
    /// A power.
    Power,
    /// A number per unit of time.
    Rate,
}

impl QuantityKind {
    /// All kinds.
    pub const ALL: [Self; 9] = [
        Self::Number,
        Self::Length,
        Self::Velocity,
        Self::Acceleration,
        Self::Force,
        Self::Impulse,
        Self::Energy,
        Self::Power,
        Self::Rate,
    ];

    /// One nondimensional unit in the units of the scales.
    #[must_use]
    pub fn scale(self, scales: &Scales) -> f64 {
        let Scales { length, time, mass } = *scales;
        let velocity = scales.velocity();
        match self {
            Self::Number => 1.0,
            Self::Length => length,
            Self::Velocity => velocity,
            Self::Acceleration => velocity / time,
            Self::Force => mass * velocity / time,
            Self::Impulse => mass * velocity,
            Self::Energy => mass * velocity * velocity,
            Self::Power => mass * velocity * velocity / time,
            Self::Rate => 1.0 / time,
        }
    }

    /// The SI unit in text and in the name of a column, the nondimensional unit, and the SI unit in the notation of UDUNITS.
    const fn units(self) -> [&'static str; 4] {
        match self {
            Self::Number => ["", "", "1", "1"],
            Self::Length => ["m", "_m", "F/k", "m"],
            Self::Velocity => ["m/s", "_m_per_s", "omega_n F/k", "m s-1"],
            Self::Acceleration => ["m/s²", "_m_per_s2", "omega_n^2 F/k", "m s-2"],
            Self::Force => ["N", "_n", "F", "N"],
            Self::Impulse => ["N s", "_n_s", "m omega_n F/k", "N s"],
            Self::Energy => ["J", "_j", "F^2/k", "J"],
            Self::Power => ["W", "_w", "omega_n F^2/k", "W"],
            Self::Rate => ["1/s", "_per_s", "omega_n", "s-1"],
        }
    }

    /// The SI unit, as in text; empty for a number.
    #[must_use]
    pub const fn unit(self) -> &'static str {
        self.units()[0]
    }

    /// The SI unit at the end of the name of a column, such as `_m_per_s`; empty for a number.
    #[must_use]
    pub const fn suffix(self) -> &'static str {
        self.units()[1]
    }

    /// The nondimensional unit; `1` for a number.
    #[must_use]
    pub const fn nondimensional(self) -> &'static str {
        self.units()[2]
    }

    /// The SI unit in the notation of UDUNITS; `1` for a number.
    #[must_use]
    pub const fn udunits(self) -> &'static str {
        self.units()[3]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The units follow from their definitions: J = N m, W = J/s, and N = kg m/s^2.
    #[test]
    fn derived_units() {
        let scales = Scales { length: 0.003, time: 0.02, mass: 0.7 };
        let of = |kind: QuantityKind| kind.scale(&scales);
        let newton = of(QuantityKind::Acceleration) * 0.7;
        for (value, expected) in [
            (of(QuantityKind::Impulse), newton * 0.02),
            (of(QuantityKind::Energy), newton * 0.003),
            (of(QuantityKind::Power), newton * 0.003 / 0.02),
            (of(QuantityKind::Rate), 50.0),
            (of(QuantityKind::Velocity), 0.15),
        ] {
            assert!((value / expected - 1.0).abs() < 1e-14);
        }
    }
}

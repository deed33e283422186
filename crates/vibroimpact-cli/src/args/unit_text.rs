//! Numbers with units, as people write them: `1.5mm`, `12 N/mm`, `900 rpm`, `2 %`.

/// The kind of number that a flag takes, which determines the units that may follow it.
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
}

/// How a number in a unit becomes one in the SI unit.
#[derive(Clone, Copy)]
enum Factor {
    /// Times a power of ten, which is written as the exponent of the number: 1.5 mm is 1.5e-3 m to the last digit.
    Ten(i32),
    /// Divided by a number.
    Over(f64),
    /// Times a number.
    Times(f64),
}

use Factor::{Over, Ten, Times};
use core::f64::consts::TAU;
use vibroimpact_study::typed::{decimal, shifted};

/// Standard gravity in m/s^2.
const GRAVITY: f64 = 9.806_65;

impl UnitKind {
    /// The units with their factors; the SI unit comes first. Blanks, and dots and stars between units, are left out.
    const fn units(self) -> &'static [(&'static str, Factor)] {
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
        }
    }

    /// A number, with or without a unit; without one it is in the SI unit.
    pub(crate) fn parse(self, text: &str) -> Result<f64, String> {
        Ok(self.split(text)?.0)
    }

    /// The number in the SI unit, and whether a unit was written.
    pub(crate) fn split(self, text: &str) -> Result<(f64, bool), String> {
        let whole = text.trim();
        let shown = || whole.chars().take(60).collect::<String>();
        if let Some(number) = decimal(whole) {
            return Ok((number, false));
        }
        // the longest beginning that is a number
        let ends = (0..=whole.len()).rev().filter(|at| whole.is_char_boundary(*at));
        let at = ends.into_iter().find(|at| decimal(&whole[..*at]).is_some()).unwrap_or(0);
        let (number, unit) = (whole[..at].trim_end(), plain(&whole[at..]));
        let known = self.units();
        let names =
            || known.iter().map(|(name, _)| *name).filter(|name| !name.is_empty()).collect::<Vec<_>>().join(", ");
        if number.is_empty() {
            return Err(format!("`{}` is not a number with a unit, such as {}", shown(), names()));
        }
        let Some((_, factor)) = known.iter().find(|(name, _)| *name == unit && !name.is_empty()) else {
            let hint = if unit.starts_with(',') { "; write a decimal point: 1.5" } else { "" };
            return Err(format!("`{}` does not end in one of the units {}{hint}", shown(), names()));
        };
        let value = decimal(number).ok_or_else(|| format!("`{}` is not a number", shown()))?;
        Ok((
            match factor {
                Ten(0) => value,
                Ten(power) => shifted(value, *power),
                Over(by) => value / by,
                Times(by) => value * by,
            },
            true,
        ))
    }
}

/// A unit without blanks and signs of multiplication, with `u` for micro and `^2` for a square.
fn plain(unit: &str) -> String {
    let unit: String =
        unit.chars().filter(|c| !c.is_whitespace() && !['*', '.', '\u{b7}', '\u{22c5}'].contains(c)).collect();
    unit.replace(['\u{b5}', '\u{3bc}'], "u").replace('\u{b2}', "^2")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_with_units() {
        for (kind, text, value) in [
            (UnitKind::Length, "1.5mm", 0.0015),
            (UnitKind::Length, "1.5 mm", 0.0015),
            (UnitKind::Length, "0.0015", 0.0015),
            (UnitKind::Length, "-250 \u{b5}m", -250e-6),
            (UnitKind::Length, "1e2um", 1e-4),
            (UnitKind::Stiffness, "12 N/mm", 12e3),
            (UnitKind::DampingCoefficient, "3.1 N*s/m", 3.1),
            (UnitKind::DampingCoefficient, "3.1 N s/m", 3.1),
            (UnitKind::Frequency, "900rpm", 15.0),
            (UnitKind::Frequency, "2kHz", 2000.0),
            (UnitKind::AngularFrequency, "15 Hz", TAU * 15.0),
            (UnitKind::Acceleration, "0.5 g", 0.5 * GRAVITY),
            (UnitKind::Acceleration, "3 m/s\u{b2}", 3.0),
            (UnitKind::Unbalance, "20 g mm", 20e-6),
            (UnitKind::Mass, "800 g", 0.8),
            (UnitKind::Ratio, "2 %", 0.02),
            (UnitKind::Ratio, "0.65", 0.65),
        ] {
            assert_eq!(kind.parse(text), Ok(value), "{text}");
        }
        for (kind, text, word) in [
            (UnitKind::Length, "1.5in", "does not end in one of the units m, cm, mm"),
            (UnitKind::Length, "1,5mm", "write a decimal point"),
            (UnitKind::Length, "mm", "is not a number with a unit"),
            (UnitKind::Force, "", "is not a number with a unit"),
            (UnitKind::Frequency, "15mm", "Hz, kHz, rpm"),
            (UnitKind::Ratio, "2 mm", "one of the units %"),
        ] {
            assert!(kind.parse(text).is_err_and(|why| why.contains(word)), "{text}: {:?}", kind.parse(text));
        }
    }
}

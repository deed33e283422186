//! Numbers with units, as people write them: `1.5mm`, `12 N/mm`, `900 rpm`, `2 %`.

pub(crate) use crate::unit_table::UnitKind;
use crate::unit_table::plain;
use vibroimpact_study::typed::decimal;

impl UnitKind {
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
        let Some(factor) = self.factor(&unit) else {
            let hint = if unit.starts_with(',') { "; write a decimal point: 1.5" } else { "" };
            return Err(format!("`{}` does not end in one of the units {}{hint}", shown(), names()));
        };
        let value = decimal(number).ok_or_else(|| format!("`{}` is not a number", shown()))?;
        Ok((factor.convert(value), true))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::unit_table::GRAVITY;
    use core::f64::consts::TAU;

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

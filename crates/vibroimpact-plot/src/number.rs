//! Coordinates as text: at most two decimals, never `-0`, never `NaN`.
//!
//! A figure unit is 1/8 mm, so two decimals are 1.25 micrometres, far below the resolution of printers, and a path of a
//! thousand points has only a few kilobytes. With a fixed number of decimals the same figure always has the same bytes.

use std::fmt;

/// A coordinate that is printed with few digits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct N(pub(crate) f64);

impl fmt::Display for N {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.0.is_finite() {
            return f.write_str("0");
        }
        let text = format!("{:.2}", self.0);
        let text = text.trim_end_matches('0').trim_end_matches('.');
        f.write_str(if text == "-0" { "0" } else { text })
    }
}

#[cfg(test)]
mod tests {
    use super::N;

    #[test]
    fn short_and_fixed() {
        for (value, text) in [
            (0.0, "0"),
            (-0.001, "0"),
            (1.0, "1"),
            (100.0, "100"),
            (1.256, "1.26"),
            (-2.5, "-2.5"),
            (f64::NAN, "0"),
            (f64::INFINITY, "0"),
        ] {
            assert_eq!(N(value).to_string(), text);
        }
    }
}

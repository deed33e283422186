//! Numbers as text: for tables in the shortest form that reads back as the same double, for human readers with few
//! digits.

use core::fmt::{self, Display};

/// A number in its shortest round-trip form.
#[derive(Clone, Copy, Debug)]
pub struct Number(pub f64);

impl Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // minus zero becomes zero
        let x = self.0 + 0.0;
        if x == 0.0 || (1e-5..1e16).contains(&x.abs()) { write!(f, "{x}") } else { write!(f, "{x:e}") }
    }
}

/// About six digits, without trailing zeros.
#[must_use]
pub fn short(x: f64) -> String {
    let size = x.abs();
    if x == 0.0 {
        "0".into()
    } else if !x.is_finite() {
        if x.is_nan() { "none".into() } else { "infinite".into() }
    } else if (1e-4..1e7).contains(&size) {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // between 0 and 10
        let places = (5.0 - size.log10().floor()).clamp(0.0, 9.0) as usize;
        let text = format!("{x:.places$}");
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').into() } else { text }
    } else {
        let text = format!("{x:.5e}");
        let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        format!("{}e{exponent}", digits.trim_end_matches('0').trim_end_matches('.'))
    }
}

/// Twelve digits, the accuracy of the value of an event.
#[must_use]
pub fn precise(x: f64) -> String {
    if x == 0.0 || !x.is_finite() {
        return short(x);
    }
    let size = x.abs();
    if (1e-4..1e7).contains(&size) {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // between 0 and 15
        let places = (11.0 - size.log10().floor()).clamp(0.0, 15.0) as usize;
        format!("{x:.places$}")
    } else {
        format!("{x:.11e}")
    }
}

/// A share in per cent. Small shares are not rounded to 0.
#[must_use]
pub fn percent(share: f64) -> String {
    let p = 100.0 * share;
    if p > 0.0 && p < 0.1 { format!("{p:.2} %") } else { format!("{p:.1} %") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_back() {
        for (x, text) in
            [(0.1, "0.1"), (-0.0, "0"), (1.0, "1"), (1e-7, "1e-7"), (1e300, "1e300"), (-123_456.789, "-123456.789")]
        {
            assert_eq!(Number(x).to_string(), text);
            assert_eq!(text.parse::<f64>(), Ok(x));
        }
    }

    #[test]
    fn numbers_are_short() {
        for (x, text) in [
            (0.0, "0"),
            (1.25, "1.25"),
            (0.829_989_67, "0.82999"),
            (123_456.78, "123457"),
            (1e-9, "1e-9"),
            (-2.5e12, "-2.5e12"),
            (100.0, "100"),
            (f64::INFINITY, "infinite"),
        ] {
            assert_eq!(short(x), text);
        }
    }

    #[test]
    fn events_have_twelve_digits() {
        for (x, text) in [
            (1.829_006_189_683_6, "1.82900618968"),
            (-0.012_345_678_901_234, "-0.0123456789012"),
            (1e-9, "1.00000000000e-9"),
            (0.0, "0"),
        ] {
            assert_eq!(precise(x), text);
        }
    }
}

//! Numbers in the forms that users write: `1000` or `1e3`, `0.5` or `-2e-3`.

use core::fmt::Display;
use vibroimpact_study::typed::{decimal, meant};

/// Up to this number every integer is a double.
const MOST: f64 = 9_007_199_254_740_992.0;

/// A number. Numbers that are not finite pass, because the check of the quantity names its range.
pub(crate) fn number(text: &str) -> Result<f64, String> {
    decimal(text).ok_or_else(|| format!("`{}` is not a number, such as 0.5 or -2e-3{}", shown(text), hint(text)))
}

/// The beginning of a text, for messages.
pub(super) fn shown(text: &str) -> String {
    text.chars().take(60).collect()
}

/// The hint for a text that is not a number, on a line of its own, if it is known what was meant.
pub(super) fn hint(text: &str) -> String {
    if let Some(number) = meant(text) {
        return format!("\nhint: write {number}");
    }
    let several = |separator| {
        let mut parts = text.split(separator).map(decimal);
        text.contains(separator) && parts.all(|part| part.is_some())
    };
    if several(':') || several(',') {
        "\nhint: one value is needed here, not several".to_owned()
    } else {
        String::new()
    }
}

/// An integer, in digits or with an exponent.
pub(crate) fn whole<T: TryFrom<u64, Error: Display>>(text: &str) -> Result<T, String> {
    let bad = || {
        let digits = |number: &String| !number.is_empty() && number.bytes().all(|digit| digit.is_ascii_digit());
        let hint = thousands(text).or_else(|| meant(text)).filter(digits);
        let hint = hint.map_or_else(String::new, |number| format!("\nhint: write {number}"));
        format!("`{}` is not a whole number, such as 1000 or 1e3{hint}", shown(text))
    };
    let short = |text: &str| {
        let number: f64 = text.parse().ok()?;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // whole, and within the range
        let whole = ((0.0..=MOST).contains(&number) && number.fract() == 0.0).then_some(number as u64);
        whole
    };
    let number = text.parse().ok().or_else(|| short(text)).ok_or_else(bad)?;
    T::try_from(number).map_err(|_| format!("{number} is too large"))
}

/// A whole number without the separators of its thousands. One comma separates thousands too, because there are no decimals.
fn thousands(text: &str) -> Option<String> {
    let separators = [',', ' ', '_', '\''];
    let mut groups = text.trim().split(separators);
    let first = groups.next()?;
    let rest: Vec<&str> = groups.collect();
    (!rest.is_empty() && rest.iter().all(|group| group.len() == 3)).then(|| format!("{first}{}", rest.concat()))
}

/// An integer in a range, with both ends allowed.
pub(crate) fn within<T: TryFrom<u64, Error: Display>, const LOWEST: u64, const HIGHEST: u64>(
    text: &str,
) -> Result<T, String> {
    let number = whole::<u64>(text)?;
    if (LOWEST..=HIGHEST).contains(&number) {
        T::try_from(number).map_err(|why| why.to_string())
    } else {
        Err(format!("{number} lies outside {LOWEST} to {HIGHEST}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn f11_digits_and_exponents() {
        for (text, number) in [("7", 7), ("1e3", 1000), ("2.5e2", 250), ("1E9", 1_000_000_000), ("0", 0)] {
            assert_eq!(whole::<u64>(text), Ok(number), "{text}");
        }
        assert_eq!(whole::<u64>(&u64::MAX.to_string()), Ok(u64::MAX));
        assert_eq!(within::<u16, 1, 1024>("1e3"), Ok(1000));
        assert_eq!(within::<u16, 1, 1024>("0"), Err("0 lies outside 1 to 1024".to_owned()));
        assert!(within::<u16, 1, 1024>("-1").is_err_and(|why| why.contains("is not a whole number")));
        assert_eq!(whole::<u32>("5e9"), Err("5000000000 is too large".to_owned()));
        for (text, x) in [("7", 7.0), ("-2e-3", -0.002), (" .5 ", 0.5), ("inf", f64::INFINITY)] {
            assert_eq!(number(text), Ok(x), "{text}");
        }
        for (text, x) in [("1e3", 1000.0), ("\u{2212}0.5", -0.5)] {
            assert_eq!(number(text), Ok(x), "{text}");
        }
        for (bad, hint) in [
            ("1,5", "write 1.5"),
            ("50 %", "write 0.5"),
            ("1/4", "write 0.25"),
            ("0.1:0.2", "one value is needed here, not several"),
            ("1,2,3", "one value is needed here, not several"),
        ] {
            assert!(number(bad).is_err_and(|why| why.ends_with(&format!("\nhint: {hint}"))), "{bad}");
        }
        for (bad, hint) in [("1 000", "write 1000"), ("1,000", "write 1000"), ("1,000,000", "write 1000000")] {
            assert!(whole::<u64>(bad).is_err_and(|why| why.ends_with(&format!("\nhint: {hint}"))), "{bad}");
        }
        for bad in ["", " ", "x", "1,5", "1e", "0.1:0.2"] {
            assert!(number(bad).is_err_and(|why| why.contains("is not a number")), "{bad}");
        }
        for bad in ["", "-1", "2.5", "1e-3", "nan", "inf", "1e300", "x", "1e", "0x10"] {
            assert!(whole::<u64>(bad).is_err_and(|why| why.contains("is not a whole number")), "{bad}");
        }
    }
}

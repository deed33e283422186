//! Numbers in the forms that users write: `1000` or `1e3`, `0.5` or `-2e-3`.

use core::fmt::Display;

/// Up to this number every integer is a double.
const MOST: f64 = 9_007_199_254_740_992.0;

/// A number. Numbers that are not finite pass, because the check of the quantity names its range.
pub(crate) fn number(text: &str) -> Result<f64, String> {
    text.trim().parse().map_err(|_| format!("`{}` is not a number, such as 0.5 or -2e-3", shown(text)))
}

fn shown(text: &str) -> String {
    text.chars().take(60).collect()
}

/// An integer, in digits or with an exponent.
pub(crate) fn whole<T: TryFrom<u64, Error: Display>>(text: &str) -> Result<T, String> {
    let bad = || format!("`{}` is not a whole number, such as 1000 or 1e3", shown(text));
    let short = |text: &str| {
        let number: f64 = text.parse().ok()?;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // whole, and within the range
        let whole = ((0.0..=MOST).contains(&number) && number.fract() == 0.0).then_some(number as u64);
        whole
    };
    let number = text.parse().ok().or_else(|| short(text)).ok_or_else(bad)?;
    T::try_from(number).map_err(|_| format!("{number} is too large"))
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
        for bad in ["", " ", "x", "1,5", "1e", "0.1:0.2"] {
            assert!(number(bad).is_err_and(|why| why.contains("is not a number")), "{bad}");
        }
        for bad in ["", "-1", "2.5", "1e-3", "nan", "inf", "1e300", "x", "1e", "0x10"] {
            assert!(whole::<u64>(bad).is_err_and(|why| why.contains("is not a whole number")), "{bad}");
        }
    }
}

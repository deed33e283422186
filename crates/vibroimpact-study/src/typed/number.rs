//! Numbers as people type them, and what was probably meant by a text that is not a number.

use core::f64::consts::PI;

/// A number in decimal digits, with or without an exponent. The minus sign of typeset text (U+2212) is understood.
///
/// ```
/// use vibroimpact_study::typed::decimal;
/// assert_eq!([decimal(" -2e-3 "), decimal("\u{2212}0.5"), decimal("1,5")], [Some(-0.002), Some(-0.5), None]);
/// ```
#[must_use]
pub fn decimal(text: &str) -> Option<f64> {
    text.trim().replace('\u{2212}', "-").parse().ok()
}

/// What was probably meant by a text that is not a number: `1.5` for `1,5`, `0.5` for `50 %`, `1000` for `1 000`,
/// `0.25` for `1/4`, and multiples of `pi`. `None` if the text is a number, or if nothing is known.
///
/// ```
/// use vibroimpact_study::typed::meant;
/// assert_eq!(meant("1,5").as_deref(), Some("1.5"));
/// assert_eq!(meant("50 %").as_deref(), Some("0.5"));
/// assert_eq!(meant("five"), None);
/// ```
#[must_use]
pub fn meant(text: &str) -> Option<String> {
    if decimal(text).is_some() {
        return None;
    }
    let text = plain_signs(text);
    let number = finite(&text)
        .or_else(|| per_cent(&text))
        .or_else(|| grouped(&text))
        .or_else(|| text.contains(',').then(|| finite(&text.replacen(',', ".", 1)))?)
        .or_else(|| multiple_of_pi(&text))
        .or_else(|| quotient(&text))?;
    Some(number.to_string())
}

/// The numbers of a text that was probably meant as a range: `15:25`, `[15, 25]`, `15-25`, `15..25`, `15 to 25`,
/// `1,5:2,5:11`.
///
/// ```
/// use vibroimpact_study::typed::numbers;
/// assert_eq!(numbers("[15, 25]"), Some(vec![15.0, 25.0]));
/// assert_eq!(numbers("1,5:2,5:11"), Some(vec![1.5, 2.5, 11.0]));
/// assert_eq!(numbers("15"), None);
/// ```
#[must_use]
pub fn numbers(text: &str) -> Option<Vec<f64>> {
    let bare = text.trim().trim_start_matches(['[', '(']).trim_end_matches([']', ')']).trim();
    let parts: Vec<&str> = if bare.contains(':') { bare.split(':').collect() } else { ends(bare)?.to_vec() };
    let number = |part: &&str| decimal(part).or_else(|| meant(part)?.parse().ok()).filter(|x| x.is_finite());
    parts.iter().map(number).collect()
}

/// The two ends of a range that is not written with colons.
fn ends(text: &str) -> Option<[&str; 2]> {
    let separators = ["..", " to ", "\u{2013}", "\u{2026}", ";", ",", "-", " "];
    separators.into_iter().find_map(|separator| {
        // a sign at the beginning, and that of an exponent, separates nothing
        let mut places = text.match_indices(separator).filter(|(at, _)| *at > 0 && !text[..*at].ends_with(['e', 'E']));
        let (at, found) = places.next()?;
        let both = [text[..at].trim(), text[at + found.len()..].trim()];
        both.iter().all(|part| decimal(part).is_some()).then_some(both)
    })
}

/// The number with its decimal point moved by `places` to the right, rounded once.
///
/// ```
/// assert_eq!(vibroimpact_study::typed::shifted(0.7, -3), 0.0007);
/// ```
#[must_use]
pub fn shifted(number: f64, places: i32) -> f64 {
    let text = format!("{number:e}");
    let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let exponent = exponent.parse::<i32>().unwrap_or(0) + places;
    format!("{digits}e{exponent}").parse().unwrap_or(number)
}

/// The text without blanks around it, with dashes and full-width characters as ASCII characters.
fn plain_signs(text: &str) -> String {
    let plain = |c: char| match c {
        '\u{2010}'..='\u{2015}' | '\u{2212}' => '-',
        // the full-width forms stand in the order of ASCII
        '\u{ff01}'..='\u{ff5e}' => char::from_u32(u32::from(c) - 0xfee0).unwrap_or(c),
        '\u{a0}' | '\u{202f}' | '\u{2009}' => ' ',
        c => c,
    };
    text.trim().chars().map(plain).collect()
}

fn finite(text: &str) -> Option<f64> {
    text.trim().parse::<f64>().ok().filter(|number| number.is_finite())
}

fn per_cent(text: &str) -> Option<f64> {
    let number = text.strip_suffix('%')?.trim_end();
    finite(number).or_else(|| finite(&number.replacen(',', ".", 1))).map(|number| shifted(number, -2))
}

/// A number whose thousands are separated: `10 000`, `1_000`, `1'000`, `12,345,678`. One comma alone is a decimal comma.
fn grouped(text: &str) -> Option<f64> {
    let separator = [' ', '_', '\'', ','].into_iter().find(|separator| text.contains(*separator))?;
    let (whole, decimals) = text.split_once('.').unwrap_or((text, ""));
    let groups: Vec<&str> = whole.split(separator).collect();
    let [first, rest @ ..] = groups.as_slice() else { return None };
    let digits = |part: &str| !part.is_empty() && part.chars().all(|c| c.is_ascii_digit());
    let thousands = rest.iter().all(|group| group.len() == 3 && digits(group));
    let head = first.trim_start_matches(['-', '+']);
    let sure = separator != ',' || rest.len() > 1 || whole.len() < text.len();
    (thousands && sure && digits(head) && head.len() <= 3)
        .then(|| finite(&format!("{}.{decimals}", groups.concat())))
        .flatten()
}

/// `pi`, `2pi`, `-pi/2`, `3*pi/4`.
fn multiple_of_pi(text: &str) -> Option<f64> {
    let (before, after) = text.split_once("pi").or_else(|| text.split_once('\u{3c0}'))?;
    let factor = match before.trim().trim_end_matches('*').trim_end() {
        "" | "+" => 1.0,
        "-" => -1.0,
        number => finite(number)?,
    };
    let divisor = match after.trim() {
        "" => 1.0,
        rest => finite(rest.strip_prefix('/')?).filter(|number| *number != 0.0)?,
    };
    Some(factor * PI / divisor)
}

/// `1/4`.
fn quotient(text: &str) -> Option<f64> {
    let (over, under) = text.split_once('/')?;
    Some(finite(over)? / finite(under)?).filter(|number| number.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_probably_meant() {
        for (text, number) in [
            ("1,5", "1.5"),
            ("-0,25", "-0.25"),
            ("2,5e3", "2500"),
            ("50 %", "0.5"),
            ("50%", "0.5"),
            ("7,5 %", "0.075"),
            ("0.7%", "0.007"),
            ("10 000", "10000"),
            ("1_000.5", "1000.5"),
            ("12'345'678", "12345678"),
            ("1,234,567", "1234567"),
            ("1,234.5", "1234.5"),
            ("\u{2013}0.5", "-0.5"),
            ("\u{ff11}\u{ff0e}\u{ff15}", "1.5"),
            ("1/4", "0.25"),
            ("pi", "3.141592653589793"),
            ("-pi/2", "-1.5707963267948966"),
            ("2*pi", "6.283185307179586"),
            ("\u{3c0}/4", "0.7853981633974483"),
        ] {
            assert_eq!(meant(text).as_deref(), Some(number), "{text}");
        }
        for text in
            ["", "x", "1", "-2e-3", "\u{2212}1", "nan", "inf%", "1,2,3", "1 2", "1/0", "pi/0", "pipi", "%", "1.2.3"]
        {
            assert_eq!(meant(text), None, "{text}");
        }
    }

    #[test]
    fn a_decimal_point_is_moved_without_rounding_twice() {
        for (number, places, moved) in [
            (0.7, -3, 0.0007),
            (1.5, -3, 0.0015),
            (3.0, 3, 3000.0),
            (-0.29, 2, -29.0),
            (0.0, 5, 0.0),
            (5e-300, -3, 5e-303),
        ] {
            assert_eq!(shifted(number, places), moved);
        }
    }
}

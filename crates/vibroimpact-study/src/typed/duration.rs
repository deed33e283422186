//! Times as people type them: `8h`, `90s`, `1h30m`.

use super::decimal;
use core::time::Duration;

/// The units of time and their seconds, the longest first.
const UNITS: [(char, f64); 4] = [('d', 86_400.0), ('h', 3600.0), ('m', 60.0), ('s', 1.0)];

/// Longest time that is accepted: a hundred years.
const MOST: f64 = 100.0 * 365.0 * 86_400.0;

/// A positive time with units: `90s`, `30m` (minutes), `8h`, `2d`, `1.5h`, `1h30m`.
///
/// ```
/// use std::time::Duration;
/// use vibroimpact_study::typed::duration;
/// assert_eq!(duration("1h30m"), Ok(Duration::from_secs(5400)));
/// assert_eq!(duration("0.5s"), Ok(Duration::from_millis(500)));
/// assert!(duration("8").is_err_and(|why| why.ends_with("hint: 8h, 8m or 8s")));
/// assert!(duration("8 hours").is_err_and(|why| why.ends_with("hint: write 8h")));
/// ```
///
/// # Errors
/// A sentence with a hint for a text that is no positive time with units.
pub fn duration(text: &str) -> Result<Duration, String> {
    let shown: String = text.chars().take(60).collect();
    let refused = || {
        let hint = meant(text).unwrap_or_else(|| "90s, 30m, 8h, 2d or 1h30m".to_owned());
        format!("`{shown}` is no time: numbers with the units s, m, h or d\nhint: {hint}")
    };
    let seconds = seconds(text).ok_or_else(refused)?;
    if seconds <= 0.0 || seconds > MOST {
        return Err(format!("the time `{shown}` lies outside 0 < time <= 36500d"));
    }
    Ok(Duration::from_secs_f64(seconds))
}

/// The seconds of numbers with units, from the longest unit to the shortest.
fn seconds(text: &str) -> Option<f64> {
    let (mut rest, mut units, mut sum) = (text.trim(), UNITS.as_slice(), 0.0);
    if rest.is_empty() {
        return None;
    }
    while !rest.is_empty() {
        let end = rest.find(|c: char| c.is_ascii_alphabetic())?;
        let unit = rest[end..].chars().next()?;
        let place = units.iter().position(|(name, _)| *name == unit)?;
        let number = decimal(&rest[..end]).filter(|number| number.is_finite())?;
        sum += number * units[place].1;
        units = &units[place + 1..];
        rest = rest[end + 1..].trim_start();
    }
    Some(sum)
}

/// What was probably meant by a text that is no time.
fn meant(text: &str) -> Option<String> {
    let text = text.trim();
    let number = |text: &str| decimal(text).filter(|number| number.is_finite() && *number > 0.0);
    if let Some(number) = number(text) {
        return Some(format!("{number}h, {number}m or {number}s"));
    }
    // hours, minutes and seconds as a clock or Slurm writes them
    if let [hours, minutes, seconds] = text.split(':').collect::<Vec<_>>()[..] {
        let part = |text: &str, unit| Some((text.parse::<u32>().ok()?, unit));
        let parts = [part(hours, 'h')?, part(minutes, 'm')?, part(seconds, 's')?];
        let written: String =
            parts.iter().filter(|(count, _)| *count > 0).map(|(count, unit)| format!("{count}{unit}")).collect();
        return (!written.is_empty()).then(|| format!("write {written}"));
    }
    let end = text.find(|c: char| c.is_ascii_alphabetic())?;
    let (count, word) = (number(&text[..end])?, text[end..].trim().to_lowercase());
    let unit = ["days", "hours", "minutes", "seconds", "hrs", "secs"].into_iter().find(|unit| unit.starts_with(&word));
    Some(format!("write {count}{}", unit?.chars().next()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_and_what_is_none() {
        for (text, seconds) in
            [("90s", 90.0), (" 30m ", 1800.0), ("8h", 28_800.0), ("2d", 172_800.0), ("1d 2h 3m 4.5s", 93_784.5)]
        {
            assert_eq!(duration(text), Ok(Duration::from_secs_f64(seconds)), "{text}");
        }
        for (text, hint) in [
            ("8", "8h, 8m or 8s"),
            ("8 hours", "write 8h"),
            ("10min", "write 10m"),
            ("04:30:00", "write 4h30m"),
            ("", "90s, 30m, 8h, 2d or 1h30m"),
            ("h", "90s, 30m, 8h, 2d or 1h30m"),
            ("30m8h", "90s, 30m, 8h, 2d or 1h30m"),
            ("1w", "90s, 30m, 8h, 2d or 1h30m"),
            ("nanh", "90s, 30m, 8h, 2d or 1h30m"),
        ] {
            assert!(duration(text).is_err_and(|why| why.ends_with(&format!("\nhint: {hint}"))), "{text}");
        }
        for text in ["0s", "-1h", "1000000d", "1h-60m"] {
            assert!(duration(text).is_err_and(|why| why.contains("outside 0 < time <= 36500d")), "{text}");
        }
    }
}

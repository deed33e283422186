//! Numbers typed with a unit, such as `1.5 mm`: the flag that takes them, and the number that it takes.

use clap::error::{ContextKind, ContextValue, ErrorKind};
use core::f64::consts::PI;
use vibroimpact_study::typed::{decimal, meant, shifted};

/// What a unit measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Length,
    Velocity,
    Time,
    Frequency,
    AngularFrequency,
    Mass,
    Force,
    Stiffness,
    Damping,
    Angle,
}

/// The units: what they measure, the power of ten of the SI unit, and a factor beside it.
const UNITS: [(&str, Kind, i32, f64); 29] = [
    ("m", Kind::Length, 0, 1.0),
    ("cm", Kind::Length, -2, 1.0),
    ("mm", Kind::Length, -3, 1.0),
    ("um", Kind::Length, -6, 1.0),
    ("\u{b5}m", Kind::Length, -6, 1.0),
    ("\u{3bc}m", Kind::Length, -6, 1.0),
    ("m/s", Kind::Velocity, 0, 1.0),
    ("cm/s", Kind::Velocity, -2, 1.0),
    ("mm/s", Kind::Velocity, -3, 1.0),
    ("s", Kind::Time, 0, 1.0),
    ("ms", Kind::Time, -3, 1.0),
    ("Hz", Kind::Frequency, 0, 1.0),
    ("kHz", Kind::Frequency, 3, 1.0),
    ("rpm", Kind::Frequency, 0, 1.0 / 60.0),
    ("rad/s", Kind::AngularFrequency, 0, 1.0),
    ("kg", Kind::Mass, 0, 1.0),
    ("g", Kind::Mass, -3, 1.0),
    ("t", Kind::Mass, 3, 1.0),
    ("N", Kind::Force, 0, 1.0),
    ("mN", Kind::Force, -3, 1.0),
    ("kN", Kind::Force, 3, 1.0),
    ("N/m", Kind::Stiffness, 0, 1.0),
    ("N/mm", Kind::Stiffness, 3, 1.0),
    ("kN/m", Kind::Stiffness, 3, 1.0),
    ("Ns/m", Kind::Damping, 0, 1.0),
    ("rad", Kind::Angle, 0, 1.0),
    ("deg", Kind::Angle, 0, PI / 180.0),
    ("\u{b0}", Kind::Angle, 0, PI / 180.0),
    ("kg/s", Kind::Damping, 0, 1.0),
];

/// The message for a value with a unit; `None` for other errors.
pub(crate) fn refusal(error: &clap::Error) -> Option<String> {
    let text = |kind| match error.get(kind) {
        Some(ContextValue::String(text)) => Some(text.as_str()),
        _ => None,
    };
    if error.kind() != ErrorKind::ValueValidation {
        return None;
    }
    let (flag, value) = (text(ContextKind::InvalidArg)?, text(ContextKind::InvalidValue)?);
    let name = flag.split([' ', '=']).next().unwrap_or(flag);
    let hint = hint(name, value)?;
    Some(format!("error: invalid value '{value}' for '{flag}': a number without unit is needed\nhint: {hint}"))
}

/// Ends of the flags that take a number in an SI unit; the unit of another quantity is explained by their own message.
const SUFFIXES: [&str; 8] = ["-m", "-kg", "-n", "-hz", "-n-per-m", "-ns-per-m", "-per-s", "-per-s2"];

/// What to type instead of a value with a unit.
fn hint(flag: &str, value: &str) -> Option<String> {
    let (kind, number) = plain(value)?;
    let (suffix, unit) = si(kind);
    let own = suffix.is_some_and(|suffix| {
        flag.ends_with(suffix) && !(suffix == "-m" && (flag.ends_with("-per-m") || flag.ends_with("-kg-m")))
    });
    if own || (kind, flag) == (Kind::Angle, "--phase") {
        return Some(format!("{flag} takes {unit}: {number}"));
    }
    let twin = match (flag, kind) {
        ("--gap", Kind::Length) => "--gap-m",
        ("--second-gap", Kind::Length) => "--second-gap-m",
        ("--beta" | "--inverse-beta" | "--omega-rad-per-s", Kind::Frequency) => "--frequency-hz",
        ("--beta" | "--inverse-beta" | "--frequency-hz", Kind::AngularFrequency) => "--omega-rad-per-s",
        ("--damping" | "--damping-ratio", Kind::Damping) => "--damping-ns-per-m",
        ("--x", Kind::Length) | ("--v", Kind::Velocity) => {
            return Some(format!("with --units si, {flag} takes {unit}: {number}"));
        }
        _ if SUFFIXES.iter().any(|suffix| flag.ends_with(suffix)) => return None,
        _ => return Some(format!("{flag} takes a number without unit")),
    };
    let takes = si(kind).1;
    if flag.ends_with("-hz") || flag.ends_with("-per-s") {
        return Some(format!("{twin} takes {takes}: {number}"));
    }
    Some(format!("{flag} takes a number without unit; {twin} takes {takes}: {number}"))
}

/// The end of the flags that take an SI unit, and the unit in words.
const fn si(kind: Kind) -> (Option<&'static str>, &'static str) {
    match kind {
        Kind::Length => (Some("-m"), "metres"),
        Kind::Velocity => (Some("-m-per-s"), "metres per second"),
        Kind::Time => (Some("-s"), "seconds"),
        Kind::Frequency => (Some("-hz"), "hertz"),
        Kind::AngularFrequency => (Some("-rad-per-s"), "radians per second"),
        Kind::Mass => (Some("-kg"), "kilograms"),
        Kind::Force => (Some("-n"), "newtons"),
        Kind::Stiffness => (Some("-n-per-m"), "newtons per metre"),
        Kind::Damping => (Some("-ns-per-m"), "newton seconds per metre"),
        Kind::Angle => (None, "radians"),
    }
}

/// What the unit of a value, a list or a range measures, and the same text in SI units without unit. The first two numbers
/// of a range have one unit, which may be written once.
fn plain(value: &str) -> Option<(Kind, String)> {
    let separator = if value.contains(':') { ':' } else { ',' };
    let listed = separator == ',' && value.matches(',').count() > 0 && split(value).is_none();
    let parts: Vec<&str> = if separator == ':' || listed { value.split(separator).collect() } else { vec![value] };
    let (_, unit) = parts.iter().find_map(|part| split(part))?;
    let scaled = |(k, part): (usize, &&str)| match split(part) {
        // the number of values has no unit, even where the unit of the ends is written behind it
        found if separator == ':' && k >= 2 => {
            Some(found.map_or_else(|| part.trim().to_owned(), |(n, _)| n.to_string()))
        }
        Some((number, other)) => (other.1 == unit.1).then(|| in_si(number, other).to_string()),
        None => Some(in_si(number(part)?, unit).to_string()),
    };
    let parts: Option<Vec<String>> = parts.iter().enumerate().map(scaled).collect();
    Some((unit.1, parts?.join(&separator.to_string())))
}

type Unit = (&'static str, Kind, i32, f64);

fn in_si(number: f64, (.., places, factor): Unit) -> f64 {
    let number = shifted(number, places);
    if factor == 1.0 { number } else { number * factor }
}

fn number(text: &str) -> Option<f64> {
    decimal(text).or_else(|| meant(text)?.parse().ok()).filter(|number| number.is_finite())
}

/// A number and its unit.
fn split(text: &str) -> Option<(f64, Unit)> {
    let text = text.trim();
    let units = UNITS.into_iter().filter_map(|unit| {
        let before = text.strip_suffix(unit.0).or_else(|| text.strip_suffix("N s/m").filter(|_| unit.0 == "Ns/m"))?;
        Some((number(before)?, unit))
    });
    // `mm` ends in `m` too, but then what is before it is no number
    units.into_iter().next()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_flag_and_the_number_without_unit() {
        for (flag, value, said) in [
            ("--gap", "1.5 mm", "--gap takes a number without unit; --gap-m takes metres: 0.0015"),
            ("--gap-m", "0.7mm", "--gap-m takes metres: 0.0007"),
            ("--gap-m", "1,5 mm", "--gap-m takes metres: 0.0015"),
            ("--gap-m", "1 mm:2 mm:11", "--gap-m takes metres: 0.001:0.002:11"),
            ("--gap-m", "1:2:11 mm", "--gap-m takes metres: 0.001:0.002:11"),
            ("--gap-m", "1 mm,2 mm", "--gap-m takes metres: 0.001,0.002"),
            ("--frequency-hz", "15:25 Hz", "--frequency-hz takes hertz: 15:25"),
            ("--frequency-hz", "900 rpm", "--frequency-hz takes hertz: 15"),
            ("--frequency-hz", "90 rad/s", "--omega-rad-per-s takes radians per second: 90"),
            ("--beta", "15 Hz", "--beta takes a number without unit; --frequency-hz takes hertz: 15"),
            ("--mass-kg", "200 g", "--mass-kg takes kilograms: 0.2"),
            ("--stiffness-n-per-m", "2 N/mm", "--stiffness-n-per-m takes newtons per metre: 2000"),
            ("--damping-ns-per-m", "3 N s/m", "--damping-ns-per-m takes newton seconds per metre: 3"),
            ("--force-n", "1kN", "--force-n takes newtons: 1000"),
            ("--x", "2 mm", "with --units si, --x takes metres: 0.002"),
            ("--phase", "90 deg", "--phase takes radians: 1.5707963267948966"),
            ("--restitution", "3 mm", "--restitution takes a number without unit"),
        ] {
            assert_eq!(hint(flag, value).as_deref(), Some(said), "{flag} {value}");
        }
        for value in ["", "mm", "1.5", "1.5 furlongs", "a m", "1 mm:2 Hz", "50 %"] {
            assert_eq!(hint("--gap", value), None, "{value}");
        }
        for (flag, value) in [("--stiffness-n-per-m", "3 m"), ("--unbalance-kg-m", "3 mm"), ("--gap-m", "3 Hz")] {
            assert_eq!(hint(flag, value), None, "{flag} {value}");
        }
    }
}

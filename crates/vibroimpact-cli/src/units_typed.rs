//! Numbers typed with a unit, such as `1.5 mm`: the flag that takes them, and the number that it takes.

use crate::unit_table::{Factor, UnitKind, plain};
use clap::error::{ContextKind, ContextValue, ErrorKind};
use vibroimpact_study::typed::{decimal, meant};

/// What is measured by the units that are explained. The mass comes before the acceleration, so that `g` is a gram.
const KINDS: [UnitKind; 10] = [
    UnitKind::Length,
    UnitKind::Velocity,
    UnitKind::Time,
    UnitKind::Frequency,
    UnitKind::AngularFrequency,
    UnitKind::Mass,
    UnitKind::Force,
    UnitKind::Stiffness,
    UnitKind::DampingCoefficient,
    UnitKind::Angle,
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
    if WITH_UNITS.contains(&name) {
        return None;
    }
    let hint = hint(name, value)?;
    Some(format!("error: invalid value '{value}' for '{flag}': a number without unit is needed\nhint: {hint}"))
}

/// The flags that take a time or a size of memory with its unit; their own messages explain it.
const WITH_UNITS: [&str; 3] = ["--budget", "--every", "--memory"];
/// Ends of the flags that take a number in an SI unit; the unit of another quantity is explained by their own message.
const SUFFIXES: [&str; 8] = ["-m", "-kg", "-n", "-hz", "-n-per-m", "-ns-per-m", "-per-s", "-per-s2"];

/// What to type instead of a value with a unit.
fn hint(flag: &str, value: &str) -> Option<String> {
    let (kind, number) = in_si(value)?;
    let (suffix, unit) = si(kind);
    let own = suffix.is_some_and(|suffix| {
        flag.ends_with(suffix) && !(suffix == "-m" && (flag.ends_with("-per-m") || flag.ends_with("-kg-m")))
    });
    if own || (kind, flag) == (UnitKind::Angle, "--phase") {
        return Some(format!("{flag} takes {unit}: {number}"));
    }
    let twin = match (flag, kind) {
        ("--gap", UnitKind::Length) => "--gap-m",
        ("--second-gap", UnitKind::Length) => "--second-gap-m",
        ("--beta" | "--inverse-beta" | "--omega-rad-per-s", UnitKind::Frequency) => "--frequency-hz",
        ("--beta" | "--inverse-beta" | "--frequency-hz", UnitKind::AngularFrequency) => "--omega-rad-per-s",
        ("--damping" | "--damping-ratio", UnitKind::DampingCoefficient) => "--damping-ns-per-m",
        ("--x", UnitKind::Length) | ("--v", UnitKind::Velocity) => {
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
const fn si(kind: UnitKind) -> (Option<&'static str>, &'static str) {
    match kind {
        UnitKind::Length => (Some("-m"), "metres"),
        UnitKind::Velocity => (Some("-m-per-s"), "metres per second"),
        UnitKind::Time => (Some("-s"), "seconds"),
        UnitKind::Frequency => (Some("-hz"), "hertz"),
        UnitKind::AngularFrequency => (Some("-rad-per-s"), "radians per second"),
        UnitKind::Mass => (Some("-kg"), "kilograms"),
        UnitKind::Force => (Some("-n"), "newtons"),
        UnitKind::Stiffness => (Some("-n-per-m"), "newtons per metre"),
        UnitKind::DampingCoefficient => (Some("-ns-per-m"), "newton seconds per metre"),
        UnitKind::Acceleration => (Some("-m-per-s2"), "metres per second squared"),
        UnitKind::Unbalance => (Some("-kg-m"), "kilogram metres"),
        UnitKind::Angle => (None, "radians"),
        UnitKind::Ratio => (None, "a pure number"),
    }
}

/// What the unit of a value, a list or a range measures, and the same text in SI units without unit. The first two numbers
/// of a range have one unit, which may be written once.
fn in_si(value: &str) -> Option<(UnitKind, String)> {
    let separator = if value.contains(':') { ':' } else { ',' };
    let listed = separator == ',' && value.matches(',').count() > 0 && split(value).is_none();
    let parts: Vec<&str> = if separator == ':' || listed { value.split(separator).collect() } else { vec![value] };
    let (_, kind, factor) = parts.iter().find_map(|part| split(part))?;
    let scaled = |(k, part): (usize, &&str)| match split(part) {
        // the number of values has no unit, even where the unit of the ends is written behind it
        found if separator == ':' && k >= 2 => {
            Some(found.map_or_else(|| part.trim().to_owned(), |(number, ..)| number.to_string()))
        }
        Some((number, other, factor)) => (other == kind).then(|| factor.convert(number).to_string()),
        None => Some(factor.convert(number(part)?).to_string()),
    };
    let parts: Option<Vec<String>> = parts.iter().enumerate().map(scaled).collect();
    Some((kind, parts?.join(&separator.to_string())))
}

fn number(text: &str) -> Option<f64> {
    decimal(text).or_else(|| meant(text)?.parse().ok()).filter(|number| number.is_finite())
}

/// A number, what its unit measures, and the factor of the unit.
fn split(text: &str) -> Option<(f64, UnitKind, Factor)> {
    let text = text.trim();
    // the longest beginning that is a number
    let ends = (1..text.len()).rev().filter(|at| text.is_char_boundary(*at));
    let (number, at) = ends.into_iter().find_map(|at| Some((number(&text[..at])?, at)))?;
    let (kind, factor) = measured(&plain(&text[at..]))?;
    Some((number, kind, factor))
}

/// What a unit measures, and its factor: the kind of which it is the SI unit, or the first that has it.
fn measured(unit: &str) -> Option<(UnitKind, Factor)> {
    let of = |kind: UnitKind| Some((kind, kind.factor(unit)?));
    let si = KINDS.into_iter().find(|kind| kind.units().first().is_some_and(|(name, _)| *name == unit));
    si.and_then(of).or_else(|| KINDS.into_iter().find_map(of))
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

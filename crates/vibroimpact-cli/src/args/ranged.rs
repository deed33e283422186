//! A value, or several: `0.5`, the ends of a range `A:B`, the values of an axis `A:B:N` or `A:B:N:log`, or a list
//! `0.2,0.5,0.8`. The numbers of a body may have units.

use super::numbers::shown;
use super::unit_text::UnitKind;
use clap::builder::TypedValueParser;
use core::str::FromStr;
use vibroimpact_study::typed::{decimal, meant};
use vibroimpact_study::{Axis, Parameter, PlanError, Span, Values};

/// One value, the ends of a range, or the values of an axis.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Ranged {
    At(f64),
    Ends(f64, f64),
    Over(Values),
}

impl Ranged {
    /// The value, or the first value.
    pub(crate) fn first(&self) -> f64 {
        match self {
            Self::At(value) | Self::Ends(value, _) => *value,
            Self::Over(values) => values.at(0),
        }
    }

    /// Whether it has one value.
    pub(crate) const fn is_one(&self) -> bool {
        matches!(self, Self::At(_))
    }

    /// The axis, if it is one.
    pub(crate) fn axis(&self, parameter: Parameter) -> Option<Axis> {
        match self {
            Self::At(_) | Self::Ends(..) => None,
            Self::Over(values) => Some(Axis::parameter(parameter, values.clone())),
        }
    }

    /// The ends of a range without a number of values.
    pub(crate) const fn ends(&self) -> Option<(f64, f64)> {
        if let Self::Ends(from, to) = self { Some((*from, *to)) } else { None }
    }

    /// Reads a text whose numbers are read by `number`.
    pub(super) fn read(text: &str, number: impl Fn(&str) -> Result<f64, String>) -> Result<Self, String> {
        let finite = |part: &str| {
            let value = number(part)?;
            if value.is_finite() { Ok(value) } else { Err(format!("`{}` is not finite", part.trim())) }
        };
        let parts: Vec<&str> = text.split(':').collect();
        match parts.as_slice() {
            [one] if one.contains(',') => {
                let values: Result<Vec<f64>, String> = one.split(',').map(finite).collect();
                values.map(|values| Self::Over(Values::Listed(values)))
            }
            [one] => number(one).map(Self::At),
            [from, to] => Ok(Self::Ends(finite(from)?, finite(to)?)),
            [from, to, count, rest @ ..] => {
                // a range in which the numbers have no units any more
                let mut plain = format!("{:?}:{:?}:{}", finite(from)?, finite(to)?, count.trim());
                rest.iter().for_each(|part| plain.push_str(&format!(":{}", part.trim())));
                plain.parse::<Span>().map(|span| Self::Over(Values::Span(span))).map_err(|why| why.to_string())
            }
            [] => Err("no value is given".to_owned()),
        }
    }
}

/// Reads the values of an axis: a range or a list.
pub(crate) fn axis_values(text: &str) -> Result<Values, String> {
    match text.parse() {
        Ok(Ranged::Over(values)) => Ok(values),
        Err(why) if text.contains(',') => Err(why),
        // one value, or the ends of a range: the error of a range says what is missing
        _ => text.parse().map(Values::Span).map_err(|error: PlanError| error.to_string()),
    }
}

/// Reads numbers with units of one kind.
pub(crate) fn with_unit(kind: UnitKind) -> impl TypedValueParser<Value = Ranged> {
    move |text: &str| Ranged::read(text, |part| kind.parse(part))
}

impl FromStr for Ranged {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        // the error of a range of plain numbers has a hint of its own
        if text.contains(':') {
            return text.parse().map(|span| Self::Over(Values::Span(span))).map_err(|why: PlanError| why.to_string());
        }
        let list = text.contains(',');
        let bad = || {
            let what =
                if list { "no list of numbers" } else { "neither a number, nor a range A:B:N, nor a list of numbers" };
            format!("`{}` is {what}{}", shown(text), hint(text))
        };
        Self::read(text, |part| decimal(part).filter(|x| x.is_finite()).ok_or_else(bad))
    }
}

/// The hint for a text of neither form, on a line of its own.
fn hint(text: &str) -> String {
    if let Some(number) = meant(text) {
        return format!("\nhint: write {number}");
    }
    let bare = text.trim().trim_start_matches(['[', '(']).trim_end_matches([']', ')']);
    let list = bare.split([',', ';', ' ']).filter(|part| !part.is_empty()).map(meant_or_same);
    match list.collect::<Option<Vec<String>>>() {
        Some(values) if values.len() > 2 => format!("\nhint: the list is {}", values.join(",")),
        // two numbers are a range as likely as a list
        _ => match text.parse::<Span>() {
            Err(PlanError::Range { .. }) if bare.is_empty() => String::new(),
            Err(error) => error.to_string().split_once('\n').map_or_else(String::new, |(_, hint)| format!("\n{hint}")),
            Ok(_) => String::new(),
        },
    }
}

/// The number of a part of a list as it has to be written.
fn meant_or_same(part: &str) -> Option<String> {
    decimal(part).filter(|x| x.is_finite()).map(|x| x.to_string()).or_else(|| meant(part))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_ranges_and_lists() {
        assert_eq!("0.5".parse(), Ok(Ranged::At(0.5)));
        assert_eq!("-1:5:7".parse(), Ok(Ranged::Over(Values::Span("-1:5:7".parse().unwrap()))));
        assert_eq!("0.2,0.5".parse(), Ok(Ranged::Over(Values::Listed(vec![0.2, 0.5]))));
        for bad in ["", "a", "1:2", "0.1,", "nan", "1,inf"] {
            assert!(bad.parse::<Ranged>().is_err(), "{bad}");
        }
        for (bad, hint) in [
            ("50 %", "write 0.5"),
            ("15:25", "15:25:41 is 41 values from 15 to 25"),
            ("15:25:0.5", "15:25:21 has the distance 0.5"),
            ("15-25", "15:25:41 is 41 values from 15 to 25"),
            ("[15,25]", "15:25:41 is 41 values from 15 to 25"),
            ("[0.2, 0.5, 0.8]", "the list is 0.2,0.5,0.8"),
            ("0.2 0.5 80%", "the list is 0.2,0.5,0.8"),
        ] {
            let why = bad.parse::<Ranged>().unwrap_err();
            assert!(why.split_once("\nhint: ").is_some_and(|(_, said)| said.contains(hint)), "{bad}: {why}");
        }
    }

    #[test]
    fn ranges_with_units() {
        let read = |text: &str| Ranged::read(text, |part| UnitKind::Frequency.parse(part));
        let over = |text: &str| Ok(Ranged::Over(Values::Span(text.parse().unwrap())));
        assert_eq!(read("15Hz:25Hz:201"), over("15:25:201"));
        assert_eq!(read("900 rpm : 1500 rpm : 3"), over("15:25:3"));
        assert_eq!(read("1kHz:2kHz:5:log"), over("1000:2000:5:log"));
        assert_eq!(read("15Hz,0.02kHz"), Ok(Ranged::Over(Values::Listed(vec![15.0, 20.0]))));
        assert_eq!(read("15Hz:25"), Ok(Ranged::Ends(15.0, 25.0)));
        assert!(read("15mm:25Hz:3").is_err_and(|why| why.contains("rpm")));
        assert!(read("15:25:x").is_err());
    }
}

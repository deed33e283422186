//! A value, or the values of an axis: `0.5`, `A:B:N`, `A:B:N:log`, or a list `0.2,0.5,0.8`.

use super::numbers::shown;
use core::str::FromStr;
use vibroimpact_study::typed::{decimal, meant};
use vibroimpact_study::{Axis, Parameter, PlanError, Span, Values};

/// One value, or the values of an axis.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Ranged {
    At(f64),
    Over(Values),
}

impl Ranged {
    /// The value, or the first value of the axis.
    pub(crate) fn first(&self) -> f64 {
        match self {
            Self::At(value) => *value,
            Self::Over(values) => values.at(0),
        }
    }

    /// The axis, if it is one.
    pub(crate) fn axis(&self, parameter: Parameter) -> Option<Axis> {
        match self {
            Self::At(_) => None,
            Self::Over(values) => Some(Axis::parameter(parameter, values.clone())),
        }
    }
}

impl FromStr for Ranged {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = |part: &str| decimal(part).filter(|x| x.is_finite());
        if text.contains(':') {
            return text.parse().map(|span| Self::Over(Values::Span(span))).map_err(|e: PlanError| e.to_string());
        }
        if text.contains(',') {
            let values: Option<Vec<f64>> = text.split(',').map(number).collect();
            return values
                .map(|values| Self::Over(Values::Listed(values)))
                .ok_or_else(|| format!("`{}` is no list of numbers{}", shown(text), hint(text)));
        }
        number(text).map(Self::At).ok_or_else(|| {
            format!("`{}` is neither a number, nor a range A:B:N, nor a list of numbers{}", shown(text), hint(text))
        })
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
}

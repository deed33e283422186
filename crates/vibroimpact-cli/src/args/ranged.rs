//! A value, or the values of an axis: `0.5`, `A:B:N`, `A:B:N:log`, or a list `0.2,0.5,0.8`.

use core::str::FromStr;
use vibroimpact_study::{Axis, Parameter, Values};

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
        let given = || text.chars().take(60).collect::<String>();
        let number = |part: &str| part.trim().parse::<f64>().ok().filter(|x| x.is_finite());
        if text.contains(':') {
            return text
                .parse()
                .map(|span| Self::Over(Values::Span(span)))
                .map_err(|e: vibroimpact_study::PlanError| e.to_string());
        }
        if text.contains(',') {
            let values: Option<Vec<f64>> = text.split(',').map(number).collect();
            return values
                .map(|values| Self::Over(Values::Listed(values)))
                .ok_or_else(|| format!("`{}` is no list of numbers", given()));
        }
        number(text)
            .map(Self::At)
            .ok_or_else(|| format!("`{}` is neither a number, nor a range A:B:N, nor a list of numbers", given()))
    }
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
    }
}

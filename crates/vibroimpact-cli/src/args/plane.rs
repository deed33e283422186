//! PLANE: ranges of parameters, `A:B`, alone or with the name of the parameter.

use super::vary::flag;
use core::str::FromStr;
use vibroimpact_study::{Parameter, Stretch};

/// `A:B`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Interval(pub(crate) f64, pub(crate) f64);

impl FromStr for Interval {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let bad = || format!("`{}` is not A:B with finite A < B", text.chars().take(60).collect::<String>());
        let number = |part: &str| part.trim().parse::<f64>().ok().filter(|x| x.is_finite()).ok_or_else(bad);
        let (a, b) = text.split_once(':').ok_or_else(bad)?;
        let (a, b) = (number(a)?, number(b)?);
        if a < b { Ok(Self(a, b)) } else { Err(bad()) }
    }
}

/// A value, or a range of values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Place {
    At(f64),
    Over(Interval),
}

impl Place {
    /// The value, or the smallest.
    pub(crate) const fn first(self) -> f64 {
        match self {
            Self::At(value) | Self::Over(Interval(value, _)) => value,
        }
    }

    /// The range, if it is one.
    pub(crate) const fn over(self, parameter: Parameter) -> Option<Stretch> {
        match self {
            Self::At(_) => None,
            Self::Over(Interval(from, to)) => Some(Stretch { parameter, from, to }),
        }
    }
}

impl FromStr for Place {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text.contains(':') {
            return text.parse().map(Self::Over);
        }
        text.trim()
            .parse()
            .map(Self::At)
            .map_err(|_| format!("`{}` is neither a number nor a range A:B", text.chars().take(60).collect::<String>()))
    }
}

/// `PARAMETER=A:B`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Over(pub(crate) Parameter, pub(crate) Interval);

impl FromStr for Over {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (name, range) = text.split_once('=').unwrap_or((text, ""));
        let parameter = Parameter::ALL.into_iter().find(|parameter| flag(*parameter) == name.trim());
        let parameter = parameter.ok_or_else(|| {
            let known = Parameter::ALL.map(flag).join(", ");
            format!("`{}` is not PARAMETER=A:B; parameters: {known}", text.chars().take(60).collect::<String>())
        })?;
        Ok(Self(parameter, range.parse()?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_and_what_is_none() {
        assert_eq!("-1:5".parse(), Ok(Interval(-1.0, 5.0)));
        assert_eq!("0.5".parse(), Ok(Place::At(0.5)));
        assert_eq!("0.4:2".parse(), Ok(Place::Over(Interval(0.4, 2.0))));
        assert_eq!("second-gap=1:2".parse(), Ok(Over(Parameter::SecondGap, Interval(1.0, 2.0))));
        for bad in ["", ":", "2:1", "1:1", "1:nan", "1:2:3", "a:b", "1:inf"] {
            assert!(bad.parse::<Interval>().is_err(), "{bad}");
        }
        for bad in ["gap", "gap=", "mass=1:2", "=1:2", "gap=2:1", "gap:1=2"] {
            assert!(bad.parse::<Over>().is_err(), "{bad}");
        }
    }
}

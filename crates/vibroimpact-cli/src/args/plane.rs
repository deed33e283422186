//! PLANE: ranges of parameters, `A:B`, with or without the name of the parameter.

use super::parameter_flag::ParameterFlag;
use core::str::FromStr;
use vibroimpact_study::{Parameter, Stretch};

/// `A:B`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Interval(pub(crate) f64, pub(crate) f64);

impl FromStr for Interval {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let bad = |_| format!("`{}` is not A:B with finite A < B", text.chars().take(60).collect::<String>());
        let Ends(a, b) = text.parse().map_err(bad)?;
        if a < b { Ok(Self(a, b)) } else { Err(bad(String::new())) }
    }
}

/// A value, or a range of values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Place {
    At(f64),
    Over(Interval),
}

impl Place {
    /// The value, or the smallest value of the range.
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

/// `A:B` with the ends in any order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ends(pub(crate) f64, pub(crate) f64);

impl FromStr for Ends {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let bad = || format!("`{}` is not A:B with finite numbers", text.chars().take(60).collect::<String>());
        let number = |part: &str| part.trim().parse::<f64>().ok().filter(|x| x.is_finite()).ok_or_else(bad);
        let (a, b) = text.split_once(':').ok_or_else(bad)?;
        Ok(Self(number(a)?, number(b)?))
    }
}

/// `PARAMETER=...`: a parameter with a value or range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Named<T>(pub(crate) ParameterFlag, pub(crate) T);

/// `PARAMETER=A:B`.
pub(crate) type Over = Named<Interval>;

impl<T: FromStr<Err: core::fmt::Display>> FromStr for Named<T> {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (name, range) = text.split_once('=').unwrap_or((text, ""));
        let named = ParameterFlag::all().find(|named| named.flag() == name.trim());
        let named = named.ok_or_else(|| {
            let known = ParameterFlag::all().map(ParameterFlag::flag).collect::<Vec<_>>().join(", ");
            format!(
                "`{}` does not begin with PARAMETER=; parameters: {known}",
                text.chars().take(60).collect::<String>()
            )
        })?;
        Ok(Self(named, range.trim().parse().map_err(|error: T::Err| error.to_string())?))
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
        let plain = |parameter| ParameterFlag { parameter };
        assert_eq!("second-gap=1:2".parse(), Ok(Named(plain(Parameter::SecondGap), Interval(1.0, 2.0))));
        assert_eq!("gap=2:1".parse(), Ok(Named(plain(Parameter::Gap), Ends(2.0, 1.0))));
        assert_eq!("gap= -0.5".parse(), Ok(Named(plain(Parameter::Gap), -0.5)));
        let hertz = ParameterFlag::of_machine(vibroimpact::MachineParameter::Frequency);
        assert_eq!("frequency-hz=15:25".parse(), Ok(Named(hertz, Interval(15.0, 25.0))));
        for bad in ["gap=1:2:3", "gap=1", "gap=1:nan", "1:2"] {
            assert!(bad.parse::<Named<Ends>>().is_err(), "{bad}");
        }
        for bad in ["", ":", "2:1", "1:1", "1:nan", "1:2:3", "a:b", "1:inf"] {
            assert!(bad.parse::<Interval>().is_err(), "{bad}");
        }
        for bad in ["gap", "gap=", "mass=1:2", "=1:2", "gap=2:1", "gap:1=2"] {
            assert!(bad.parse::<Over>().is_err(), "{bad}");
        }
    }
}

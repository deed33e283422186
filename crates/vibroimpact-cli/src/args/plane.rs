//! PLANE: ranges of parameters, `A:B`, with or without the name of the parameter.

use super::Ranged;
use super::numbers::{self, shown};
use super::parameter_flag::{Varied, flags, of_flag};
use crate::failure::Failure;
use core::str::FromStr;
use vibroimpact_study::Parameter;
use vibroimpact_study::typed::{self, decimal, meant};

/// `A:B`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Interval(pub(crate) f64, pub(crate) f64);

impl FromStr for Interval {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let bad = |hint: String| format!("`{}` is not A:B with finite A < B{hint}", shown(text));
        let Ends(a, b) = text.parse().map_err(|_| bad(hint(text)))?;
        match (a, b) {
            (a, b) if a < b => Ok(Self(a, b)),
            (a, b) if a > b => Err(bad(format!("\nhint: write {b}:{a}"))),
            _ => Err(bad(String::new())),
        }
    }
}

/// The hint for a text that is not `A:B`, on a line of its own, if it is known what was meant.
fn hint(text: &str) -> String {
    match typed::numbers(text).as_deref() {
        Some([a, b]) => format!("\nhint: write {}:{}", a.min(*b), a.max(*b)),
        Some([a, b, _]) => format!("\nhint: only the two ends are given here: {}:{}", a.min(*b), a.max(*b)),
        _ => String::new(),
    }
}

/// Reads a value, or a range A:B.
pub(crate) fn place(text: &str) -> Result<Ranged, String> {
    if text.contains(':') {
        return text.parse().map(|Interval(from, to)| Ranged::Ends(from, to));
    }
    let hint = || Some(hint(text)).filter(|hint| !hint.is_empty()).unwrap_or_else(|| numbers::hint(text));
    decimal(text).map(Ranged::At).ok_or_else(|| match meant(text) {
        Some(number) => format!("`{}` is neither a number nor a range A:B\nhint: write {number}", shown(text)),
        None => format!("`{}` is neither a number nor a range A:B{}", shown(text), hint()),
    })
}

/// `A:B` with the ends in any order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ends(pub(crate) f64, pub(crate) f64);

impl FromStr for Ends {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let bad = || format!("`{}` is not A:B with finite numbers{}", shown(text), hint(text));
        let number = |part: &str| decimal(part).filter(|x| x.is_finite()).ok_or_else(bad);
        let (a, b) = text.split_once(':').ok_or_else(bad)?;
        Ok(Self(number(a)?, number(b)?))
    }
}

/// One end of a branch, or both, `A,B`: the one that it comes from, and the one to which it goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BranchEnds {
    pub(crate) back: Option<f64>,
    pub(crate) to: f64,
}

impl FromStr for BranchEnds {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.split_once(',').map(|(back, to)| (decimal(back), decimal(to))) {
            Some((Some(back), Some(to))) => Ok(Self { back: Some(back), to }),
            _ => numbers::number(text).map(|to| Self { back: None, to }),
        }
    }
}

/// A number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Value(pub(crate) f64);

impl FromStr for Value {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        numbers::number(text).map(Self)
    }
}

/// `PARAMETER=...`: a parameter with a value or range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Named<T>(pub(crate) Parameter, pub(crate) T);

impl<T: FromStr<Err: core::fmt::Display>> FromStr for Named<T> {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (name, range) = text.split_once('=').map_or((text, None), |(name, range)| (name, Some(range)));
        let named = of_flag(name.trim()).ok_or_else(|| {
            let known = flags().collect::<Vec<_>>().join(", ");
            format!("`{}` does not begin with PARAMETER=; parameters: {known}", shown(text))
        })?;
        let Some(range) = range else {
            return Err(format!("`{0}` has no values\nhint: {0}= and its value or range behind it", shown(text)));
        };
        Ok(Self(named, range.trim().parse().map_err(|error: T::Err| error.to_string())?))
    }
}

/// `PARAMETER=...` or `PATH=...`: what varies, with a value or range.
#[derive(Clone, Debug)]
pub(crate) struct VariedNamed<T>(pub(crate) Varied, pub(crate) T);

/// `PARAMETER=A:B` or `PATH=A:B`.
pub(crate) type VariedOver = VariedNamed<Interval>;

impl<T: Copy> VariedNamed<T> {
    /// A parameter of the oscillator.
    pub(crate) fn of_oscillator(&self) -> Result<Named<T>, Failure> {
        Ok(Named(self.0.parameter()?, self.1))
    }
}

impl<T: FromStr<Err: core::fmt::Display>> FromStr for VariedNamed<T> {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let unknown = match text.parse::<Named<T>>() {
            Ok(Named(named, range)) => return Ok(Self(Varied::Parameter(named), range)),
            Err(error) => error,
        };
        let Some((name, range)) = text.split_once('=') else { return Err(unknown) };
        let name = name.trim();
        // the value or range of a parameter is wrong
        if of_flag(name).is_some() {
            return Err(unknown);
        }
        let range = range.trim().parse().map_err(|error: T::Err| error.to_string())?;
        let path = name.contains('.') || name == "frequency";
        // whether a machine has this parameter is not known here
        Ok(Self(if path { Varied::Path(name.to_owned()) } else { Varied::Name(name.to_owned(), unknown) }, range))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_and_what_is_none() {
        assert_eq!("-1:5".parse(), Ok(Interval(-1.0, 5.0)));
        assert_eq!(place("0.5"), Ok(Ranged::At(0.5)));
        assert_eq!(place("0.4:2"), Ok(Ranged::Ends(0.4, 2.0)));
        assert_eq!("second-gap=1:2".parse(), Ok(Named(Parameter::SecondGap, Interval(1.0, 2.0))));
        assert_eq!("gap=2:1".parse(), Ok(Named(Parameter::Gap, Ends(2.0, 1.0))));
        assert_eq!("gap= -0.5".parse(), Ok(Named(Parameter::Gap, Value(-0.5))));
        assert!("gap=1,5".parse::<Named<Value>>().is_err_and(|why| why.ends_with("hint: write 1.5")));
        assert!("gap".parse::<Named<Ends>>().is_err_and(|why| why.contains("hint: gap= and its value")));
        let hertz = Parameter::Body(vibroimpact_study::BodyNumber::Frequency);
        assert_eq!("frequency-hz=15:25".parse(), Ok(Named(hertz, Interval(15.0, 25.0))));
        for bad in ["gap=1:2:3", "gap=1", "gap=1:nan", "1:2"] {
            assert!(bad.parse::<Named<Ends>>().is_err(), "{bad}");
        }
        for bad in ["", ":", "2:1", "1:1", "1:nan", "1:2:3", "a:b", "1:inf"] {
            assert!(bad.parse::<Interval>().is_err(), "{bad}");
        }
        for (bad, hint) in [
            ("2:1", "write 1:2"),
            ("15:25:41", "only the two ends are given here: 15:25"),
            ("[15,25]", "write 15:25"),
            ("15-25", "write 15:25"),
            ("0,5:1,5", "write 0.5:1.5"),
        ] {
            assert!(bad.parse::<Interval>().is_err_and(|why| why.ends_with(&format!("\nhint: {hint}"))), "{bad}");
        }
        assert!(place("1,5").is_err_and(|why| why.ends_with("\nhint: write 1.5")));
        assert!(place("25:15").is_err_and(|why| why.ends_with("\nhint: write 15:25")));
        for bad in ["gap", "gap=", "mass=1:2", "=1:2", "gap=2:1", "gap:1=2"] {
            assert!(bad.parse::<Named<Interval>>().is_err(), "{bad}");
        }
    }
}

//! SYSTEM: the oscillator, in nondimensional or in physical units.

use super::body::BodyArgs;
use super::parameter_flag::flag;
use super::plane::place;
use super::unit_text::UnitKind;
use super::{Ranged, number};
use crate::failure::Failure;
use clap::builder::{Resettable, TypedValueParser};
use clap::{Arg, Args, Id, ValueEnum};
use core::cell::Cell;
use vibroimpact_report::{Asked, Units};
use vibroimpact_study::{BodyNumber, Parameter, SecondStop, SystemPlan};

/// The numbers of a nondimensional oscillator: one value each, or several where a command takes [values] or [ranges].
#[derive(Clone, Debug, Default, Args)]
pub(crate) struct NumbersArgs {
    /// Frequency ratio: forcing over natural frequency, omega/omega_n; positive
    #[arg(long, value_parser = one(), value_name = "B", allow_hyphen_values = true, conflicts_with = "inverse_beta")]
    beta: Option<Ranged>,

    /// Its inverse omega_n/omega instead, the abscissa of the 1971 paper; positive
    #[arg(long, value_parser = one(), value_name = "X", allow_hyphen_values = true)]
    inverse_beta: Option<Ranged>,

    /// Distance of the stop from the rest position in units of F/k; negative presses the mass against it. With a unit,
    /// such as 1.5mm, it is --gap-m
    #[arg(long, value_parser = maybe_length(), value_name = "D", allow_hyphen_values = true, conflicts_with_all = ["gap_m", "gaps_m"])]
    gap: Option<MaybeLength>,

    /// Restitution: rebound speed over arrival speed, 0 to 1
    #[arg(long, value_parser = one(), value_name = "E", allow_hyphen_values = true)]
    restitution: Option<Ranged>,

    /// Damping ratio zeta = c / (2 sqrt(k m)), 0 or more [default: 0]
    #[arg(long, value_parser = one(), value_name = "Z", allow_hyphen_values = true)]
    damping: Option<Ranged>,

    /// A second stop on the other side, at x = -D2
    #[arg(long, value_parser = maybe_length(), value_name = "D2", allow_hyphen_values = true, conflicts_with_all = ["second_gap_m", "gaps_m"])]
    second_gap: Option<MaybeLength>,

    /// Restitution of the second stop [default: that of the first]
    #[arg(long, value_parser = one(), value_name = "E2", allow_hyphen_values = true)]
    second_restitution: Option<Ranged>,
}

#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "System")]
pub(crate) struct SystemArgs {
    #[command(flatten)]
    pub(super) numbers: NumbersArgs,

    #[command(flatten)]
    pub(super) body: BodyArgs,

    /// Units of starts, ranges and results
    #[arg(long, value_enum, value_name = "UNITS", default_value_t = Convention::Nondimensional)]
    units: Convention,
}

/// What lengths, velocities and times are measured in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Convention {
    /// F/k, and 1/omega_n
    Nondimensional,
    /// Metres and seconds; needs the system in physical units
    Si,
}

/// Lengths in units of F/k, or in m if they were written with a unit.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum MaybeLength {
    Plain(Ranged),
    Metres(Ranged),
}

/// Reads one number.
fn one() -> impl TypedValueParser<Value = Ranged> {
    |text: &str| number(text).map(Ranged::At)
}

/// Reads one length in units of F/k, or with a unit.
fn maybe_length() -> impl TypedValueParser<Value = MaybeLength> {
    |text: &str| {
        // a text that is no length either has the error of a plain number
        match UnitKind::Length.split(text) {
            Ok((value, true)) => Ok(MaybeLength::Metres(Ranged::At(value))),
            _ => number(text).map(|value| MaybeLength::Plain(Ranged::At(value))),
        }
    }
}

/// Reads lengths in units of F/k, or with units.
fn maybe_lengths() -> impl TypedValueParser<Value = MaybeLength> {
    |text: &str| {
        let plain = text.parse::<Ranged>().map(MaybeLength::Plain);
        // a text without a unit has the error of plain numbers
        let with_unit = Cell::new(false);
        let metres = |part: &str| {
            let (value, unit) = UnitKind::Length.split(part)?;
            with_unit.set(with_unit.get() || unit);
            Ok(value)
        };
        let metres = |why| Ranged::read(text, metres).ok().filter(|_| with_unit.get()).ok_or(why);
        plain.or_else(|why| metres(why).map(MaybeLength::Metres))
    }
}

/// An argument of [`NumbersArgs`] as one value or the values of an axis.
pub(crate) fn values(arg: Arg) -> Arg {
    match arg.get_id().as_str() {
        "gap" | "second_gap" => arg.value_parser(maybe_lengths()).value_name("VALUES"),
        "beta" | "inverse_beta" | "restitution" | "damping" | "second_restitution" => {
            arg.value_parser(|text: &str| text.parse::<Ranged>()).value_name("VALUES")
        }
        _ => arg,
    }
}

/// An argument of [`NumbersArgs`] as one value or a range A:B, which may replace the value of a body.
pub(crate) fn ranges(arg: Arg) -> Arg {
    match arg.get_id().as_str() {
        "gap" | "second_gap" => {
            let plain = |text: &str| place(text).map(MaybeLength::Plain);
            arg.value_parser(plain).conflicts_with(Resettable::<Id>::Reset)
        }
        "beta" | "inverse_beta" | "restitution" | "damping" | "second_restitution" => arg.value_parser(place),
        _ => arg,
    }
}

impl MaybeLength {
    const fn plain(&self) -> Option<&Ranged> {
        if let Self::Plain(value) = self { Some(value) } else { None }
    }

    const fn metres(&self) -> Option<&Ranged> {
        if let Self::Metres(value) = self { Some(value) } else { None }
    }
}

/// The error where the restitution varies, and that of the second stop would have to follow it.
pub(crate) fn without_second_restitution() -> Failure {
    Failure::bad("the restitution varies and that of the second stop is not given\nhint: --second-restitution E2")
}

impl NumbersArgs {
    /// The numbers that are given, in the order of the flags. A gap that is written with a unit is one of the body.
    pub(crate) fn given(&self) -> impl Iterator<Item = (Parameter, &Ranged)> {
        let all = [
            (Parameter::Beta, self.beta.as_ref()),
            (Parameter::InverseBeta, self.inverse_beta.as_ref()),
            (Parameter::Gap, self.gap.as_ref().and_then(MaybeLength::plain)),
            (Parameter::Restitution, self.restitution.as_ref()),
            (Parameter::Damping, self.damping.as_ref()),
            (Parameter::SecondGap, self.second_gap.as_ref().and_then(MaybeLength::plain)),
            (Parameter::SecondRestitution, self.second_restitution.as_ref()),
        ];
        all.into_iter().filter_map(|(parameter, given)| Some((parameter, given?)))
    }

    /// The value of a number, or its first value.
    fn value(&self, of: Parameter) -> Option<f64> {
        self.given().find(|(parameter, _)| *parameter == of).map(|(_, given)| given.first())
    }

    /// Whether a number has several values.
    pub(super) fn varies(&self, of: Parameter) -> bool {
        self.given().any(|(parameter, given)| parameter == of && !given.is_one())
    }

    /// Gives a number a value, or none.
    pub(super) fn set(&mut self, parameter: Parameter, value: Option<f64>) {
        let value = value.map(Ranged::At);
        match parameter {
            Parameter::Beta => self.beta = value,
            Parameter::InverseBeta => self.inverse_beta = value,
            Parameter::Gap => self.gap = value.map(MaybeLength::Plain),
            Parameter::Restitution => self.restitution = value,
            Parameter::Damping => self.damping = value,
            Parameter::SecondGap => self.second_gap = value.map(MaybeLength::Plain),
            Parameter::SecondRestitution => self.second_restitution = value,
            Parameter::Body(_) => {}
        }
    }

    /// Whether a number is given.
    pub(super) fn has(&self, parameter: Parameter) -> bool {
        match parameter {
            Parameter::Gap => self.gap.is_some(),
            Parameter::SecondGap => self.second_gap.is_some(),
            other => self.value(other).is_some(),
        }
    }

    /// Whether there is a second stop with the restitution of the first.
    pub(super) fn second_stop_follows(&self, body: &BodyArgs) -> bool {
        (self.second_gap.is_some() || body.has_second_stop()) && self.second_restitution.is_none()
    }

    /// The numbers of the body, with gaps that are written with a unit.
    pub(super) fn body(&self, body: &BodyArgs) -> BodyArgs {
        let mut body = body.clone();
        for (parameter, given) in [(BodyNumber::Gap, &self.gap), (BodyNumber::SecondGap, &self.second_gap)] {
            if let Some(metres) = given.as_ref().and_then(MaybeLength::metres) {
                body.put(parameter, metres.clone());
            }
        }
        body
    }

    /// The system with the first value of each range; `set` gives numbers of the body that vary their first values.
    pub(super) fn first(
        &self,
        body: &BodyArgs,
        units: Convention,
        set: &[(BodyNumber, f64)],
    ) -> Result<Asked, Failure> {
        let body = self.body(body);
        let (restitution, second) = (self.value(Parameter::Restitution), self.value(Parameter::SecondRestitution));
        let second_gap = self.value(Parameter::SecondGap);
        if second_gap.is_none() && !body.has_second_stop() && second.is_some() {
            return Err(Failure::bad("the second stop has a restitution but no gap\nhint: --second-gap D2"));
        }
        if !body.any() && set.is_empty() {
            if units == Convention::Si {
                return Err(Failure::bad(
                    "--units si needs the system in physical units\nhint: --mass-kg, --stiffness-n-per-m, --force-n ...",
                ));
            }
            let gap = self.complete()?;
            let restitution = restitution.unwrap_or(0.0);
            let system = SystemPlan {
                beta: self.value(Parameter::Beta),
                inverse_beta: self.value(Parameter::InverseBeta),
                gap,
                restitution,
                damping: self.value(Parameter::Damping).unwrap_or(0.0),
                second_stop: second_gap.map(|gap| SecondStop { gap, restitution: second.unwrap_or(restitution) }),
                body: None,
            };
            return Ok(Asked { system, units: Units::default() });
        }
        let plan = body.plan((restitution, second), set)?;
        let of_body = |of: Parameter| matches!(of, Parameter::Restitution | Parameter::SecondRestitution);
        if let Some((parameter, _)) = self.given().find(|(parameter, _)| !of_body(*parameter)) {
            let hint = match parameter {
                Parameter::Gap | Parameter::SecondGap => "\nhint: a gap in physical units has its unit, as 1.5mm",
                _ => "",
            };
            let flag = flag(parameter);
            return Err(Failure::bad(format!("--{flag} cannot go together with a system in physical units{hint}")));
        }
        super::body::asked(&plan, units == Convention::Si)
    }

    /// The gap of a nondimensional system; an error if a required number is missing.
    fn complete(&self) -> Result<f64, Failure> {
        let (beta, gap) = (self.beta.is_some() || self.inverse_beta.is_some(), self.value(Parameter::Gap));
        let needed = [
            ("the frequency ratio", "--beta B or --inverse-beta X", beta),
            ("the gap", "--gap D", gap.is_some()),
            ("the restitution", "--restitution E", self.restitution.is_some()),
        ];
        let missing = needed.iter().filter(|(.., given)| !given);
        let (names, flags): (Vec<&str>, Vec<&str>) = missing.map(|(name, flag, _)| (*name, *flag)).unzip();
        let said = match names.as_slice() {
            // if only the frequency is missing, the plan reports it with the same message in all interfaces
            [] | ["the frequency ratio"] => return Ok(gap.unwrap_or(0.0)),
            [one] => format!("{one} is not given"),
            [first @ .., last] => format!("{} and {last} are not given", first.join(", ")),
        };
        Err(Failure::bad(format!("{said}\nhint: {}", flags.join(", "))))
    }
}

impl SystemArgs {
    /// The system, in which no quantity is a range.
    pub(crate) fn asked(&self) -> Result<Asked, Failure> {
        self.asked_with(&[])
    }

    /// The same, with numbers of the body that vary and have these first values.
    pub(super) fn asked_with(&self, set: &[(BodyNumber, f64)]) -> Result<Asked, Failure> {
        self.body.one_value("`vibro map`, `vibro region` and `vibro response` take ranges; --vary FLAG elsewhere")?;
        self.numbers.first(&self.body, self.units, set)
    }

    /// The same with results in SI units.
    pub(crate) fn in_si(&self) -> Self {
        Self { units: Convention::Si, ..self.clone() }
    }

    /// Whether it is given in physical units.
    pub(crate) fn is_body(&self) -> bool {
        self.body.any()
    }
}

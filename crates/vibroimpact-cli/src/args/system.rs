//! SYSTEM: the oscillator, in nondimensional or in physical units.

use super::physical::PhysicalArgs;
use super::unit_text::UnitKind;
use super::{Ranged, number};
use crate::failure::Failure;
use clap::builder::TypedValueParser;
use clap::{Args, ValueEnum};
use vibroimpact::PhysicalParameter;
use vibroimpact_report::{Asked, Units};
use vibroimpact_study::{Parameter, SecondStop, SystemPlan};

#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "System")]
pub(crate) struct SystemArgs {
    /// Frequency ratio: forcing over natural frequency, omega/omega_n; positive
    #[arg(long, value_parser = number, value_name = "B", allow_hyphen_values = true, conflicts_with = "inverse_beta")]
    beta: Option<f64>,

    /// Its inverse omega_n/omega instead, the abscissa of the 1971 paper; positive
    #[arg(long, value_parser = number, value_name = "X", allow_hyphen_values = true)]
    inverse_beta: Option<f64>,

    /// Distance of the stop from the rest position in units of F/k; negative presses the mass against it. With a unit,
    /// such as 1.5mm, it is --gap-m
    #[arg(long, value_parser = maybe_length(), value_name = "D", allow_hyphen_values = true, conflicts_with_all = ["gap_m", "gaps_m"])]
    gap: Option<MaybeLength>,

    /// Restitution: rebound speed over arrival speed, 0 to 1
    #[arg(long, value_parser = number, value_name = "E", allow_hyphen_values = true)]
    restitution: Option<f64>,

    /// Damping ratio zeta = c / (2 sqrt(k m)), 0 or more [default: 0]
    #[arg(long, value_parser = number, value_name = "Z", allow_hyphen_values = true)]
    damping: Option<f64>,

    /// A second stop on the other side, at x = -D2
    #[arg(long, value_parser = maybe_length(), value_name = "D2", allow_hyphen_values = true, conflicts_with_all = ["second_gap_m", "gaps_m"])]
    second_gap: Option<MaybeLength>,

    /// Restitution of the second stop [default: that of the first]
    #[arg(long, value_parser = number, value_name = "E2", allow_hyphen_values = true)]
    second_restitution: Option<f64>,

    #[command(flatten)]
    pub(super) machine: PhysicalArgs,

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

/// Reads one length in units of F/k, or with a unit.
fn maybe_length() -> impl TypedValueParser<Value = MaybeLength> {
    |text: &str| {
        let plain = |text: &str| number(text).map(|value| MaybeLength::Plain(Ranged::At(value)));
        // a text that is no length either has the error of a plain number
        match UnitKind::Length.split(text) {
            Ok((value, true)) => Ok(MaybeLength::Metres(Ranged::At(value))),
            _ => plain(text),
        }
    }
}

/// Reads lengths in units of F/k, or with units.
pub(super) fn maybe_lengths() -> impl TypedValueParser<Value = MaybeLength> {
    |text: &str| {
        let metres = |text: &str| Ranged::read(text, |part| UnitKind::Length.parse(part)).map(MaybeLength::Metres);
        text.parse::<Ranged>().map(MaybeLength::Plain).or_else(|why| metres(text).map_err(|_| why))
    }
}

impl MaybeLength {
    pub(super) const fn plain(&self) -> Option<&Ranged> {
        if let Self::Plain(value) = self { Some(value) } else { None }
    }

    pub(super) const fn metres(&self) -> Option<&Ranged> {
        if let Self::Metres(value) = self { Some(value) } else { None }
    }
}

fn plain(given: Option<&MaybeLength>) -> Option<f64> {
    given.and_then(MaybeLength::plain).map(Ranged::first)
}

impl SystemArgs {
    /// The system, in which no quantity is a range.
    pub(crate) fn asked(&self) -> Result<Asked, Failure> {
        self.asked_with(&[])
    }

    /// The same, with numbers of the machine that vary and have these first values.
    pub(super) fn asked_with(&self, set: &[(PhysicalParameter, f64)]) -> Result<Asked, Failure> {
        self.machine
            .one_value("`vibro map`, `vibro region` and `vibro response` take ranges; --vary FLAG elsewhere")?;
        self.first(set)
    }

    /// The system with the first value of each range.
    pub(crate) fn first(&self, set: &[(PhysicalParameter, f64)]) -> Result<Asked, Failure> {
        let mut machine = self.machine.clone();
        for (parameter, given) in
            [(PhysicalParameter::Gap, &self.gap), (PhysicalParameter::SecondGap, &self.second_gap)]
        {
            if let Some(metres) = given.as_ref().and_then(MaybeLength::metres) {
                machine.put(parameter, metres.clone());
            }
        }
        let second_gap = plain(self.second_gap.as_ref());
        if second_gap.is_none() && !machine.has_second_stop() && self.second_restitution.is_some() {
            return Err(Failure::bad("the second stop has a restitution but no gap\nhint: --second-gap D2"));
        }
        if !machine.any() && set.is_empty() {
            if self.units == Convention::Si {
                return Err(Failure::bad(
                    "--units si needs the system in physical units\nhint: --mass-kg, --stiffness-n-per-m, --force-n ...",
                ));
            }
            let gap = self.complete()?;
            let restitution = self.restitution.unwrap_or(0.0);
            let system = SystemPlan {
                beta: self.beta,
                inverse_beta: self.inverse_beta,
                gap,
                restitution,
                damping: self.damping.unwrap_or(0.0),
                second_stop: second_gap
                    .map(|gap| SecondStop { gap, restitution: self.second_restitution.unwrap_or(restitution) }),
                machine: None,
            };
            return Ok(Asked { system, units: Units::default() });
        }
        let plan = machine.plan((self.restitution, self.second_restitution), set)?;
        let twice = [
            ("--beta", self.beta),
            ("--inverse-beta", self.inverse_beta),
            ("--gap", plain(self.gap.as_ref())),
            ("--damping", self.damping),
            ("--second-gap", second_gap),
        ];
        if let Some((flag, _)) = twice.iter().find(|(_, value)| value.is_some()) {
            return Err(Failure::bad(format!("{flag} cannot go together with a system in physical units")));
        }
        super::physical::asked(&plan, self.units == Convention::Si)
    }

    /// The same with results in SI units.
    pub(crate) fn in_si(&self) -> Self {
        Self { units: Convention::Si, ..self.clone() }
    }
}

impl SystemArgs {
    /// The gap of a nondimensional system; an error if a required parameter is missing.
    fn complete(&self) -> Result<f64, Failure> {
        let needed = [
            ("the frequency ratio", "--beta B or --inverse-beta X", self.beta.or(self.inverse_beta)),
            ("the gap", "--gap D", plain(self.gap.as_ref())),
            ("the restitution", "--restitution E", self.restitution),
        ];
        let missing = needed.iter().filter(|(.., value)| value.is_none());
        let (names, flags): (Vec<&str>, Vec<&str>) = missing.map(|(name, flag, _)| (*name, *flag)).unzip();
        let said = match names.as_slice() {
            // if only the frequency is missing, the plan reports it with the same message in all interfaces
            [] | ["the frequency ratio"] => return Ok(plain(self.gap.as_ref()).unwrap_or(0.0)),
            [one] => format!("{one} is not given"),
            [first @ .., last] => format!("{} and {last} are not given", first.join(", ")),
        };
        Err(Failure::bad(format!("{said}\nhint: {}", flags.join(", "))))
    }
}

/// Functions for a plane, whose values may be ranges.
impl SystemArgs {
    /// The system with these values.
    pub(crate) fn of(values: &[(Parameter, Option<f64>)], machine: PhysicalArgs, units: Convention) -> Self {
        let mut args = Self {
            beta: None,
            inverse_beta: None,
            gap: None,
            restitution: None,
            damping: None,
            second_gap: None,
            second_restitution: None,
            machine,
            units,
        };
        for (parameter, value) in values {
            args.set(*parameter, *value);
        }
        args
    }
}

/// Functions for a parameter that varies.
impl SystemArgs {
    /// Gives a parameter of the oscillator a value, or none.
    pub(super) fn set(&mut self, parameter: Parameter, value: Option<f64>) {
        match parameter {
            Parameter::Beta => self.beta = value,
            Parameter::InverseBeta => self.inverse_beta = value,
            Parameter::Gap => self.gap = value.map(|value| MaybeLength::Plain(Ranged::At(value))),
            Parameter::Restitution => self.restitution = value,
            Parameter::Damping => self.damping = value,
            Parameter::SecondGap => self.second_gap = value.map(|value| MaybeLength::Plain(Ranged::At(value))),
            Parameter::SecondRestitution => self.second_restitution = value,
            Parameter::Physical(_) => {}
        }
    }

    /// Whether a parameter of the oscillator is given.
    pub(super) const fn has(&self, parameter: Parameter) -> bool {
        match parameter {
            Parameter::Beta => self.beta.is_some(),
            Parameter::InverseBeta => self.inverse_beta.is_some(),
            Parameter::Gap => self.gap.is_some(),
            Parameter::Restitution => self.restitution.is_some(),
            Parameter::Damping => self.damping.is_some(),
            Parameter::SecondGap => self.second_gap.is_some(),
            Parameter::SecondRestitution => self.second_restitution.is_some(),
            Parameter::Physical(_) => false,
        }
    }

    /// Whether there is a second stop with the restitution of the first.
    pub(super) const fn second_stop_follows(&self) -> bool {
        (self.second_gap.is_some() || self.machine.has_second_stop()) && self.second_restitution.is_none()
    }

    /// Whether it is given in physical units.
    pub(crate) fn is_machine(&self) -> bool {
        self.machine.any()
    }
}

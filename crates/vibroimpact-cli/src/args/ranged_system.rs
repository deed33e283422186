//! SYSTEM with ranges: each parameter is one value or the values of an axis.

use super::parameter_flag::{ParameterFlag, flag};
use super::physical::PhysicalArgs;
use super::system::{MaybeLength, maybe_lengths};
use super::{AxesArgs, Ranged};
use crate::failure::Failure;
use clap::Args;
use vibroimpact::PhysicalParameter;
use vibroimpact_report::{Asked, Units};
use vibroimpact_study::{Axis, Parameter, SecondStop, SystemPlan};

/// The parameters of a system, values or ranges.
#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "System")]
#[command(group = clap::ArgGroup::new("frequency").required(true).args(["beta", "inverse_beta", "frequency_hz", "omega_rad_per_s"]))]
#[command(group = clap::ArgGroup::new("distance").required(true).args(["gap", "gap_m", "gaps_m"]))]
pub(crate) struct RangedSystemArgs {
    /// Frequency ratio omega/omega_n, positive
    #[arg(long, value_name = "VALUES", allow_hyphen_values = true, conflicts_with = "inverse_beta")]
    beta: Option<Ranged>,

    /// Its inverse omega_n/omega instead, the abscissa of the 1971 paper; positive
    #[arg(long, value_name = "VALUES", allow_hyphen_values = true)]
    inverse_beta: Option<Ranged>,

    /// Gap, in units of F/k; with a unit, such as 1.5mm, it is --gap-m
    #[arg(long, value_parser = maybe_lengths(), value_name = "VALUES", allow_hyphen_values = true)]
    gap: Option<MaybeLength>,

    /// Restitution: rebound speed over arrival speed, 0 to 1
    #[arg(long, value_name = "VALUES", allow_hyphen_values = true, required = true)]
    restitution: Option<Ranged>,

    /// Damping ratio zeta, 0 or more [default: 0]
    #[arg(long, value_name = "VALUES", allow_hyphen_values = true)]
    damping: Option<Ranged>,

    /// A second stop on the other side, at x = -D2
    #[arg(long, value_parser = maybe_lengths(), value_name = "VALUES", allow_hyphen_values = true, conflicts_with_all = ["second_gap_m", "gaps_m"])]
    second_gap: Option<MaybeLength>,

    /// Restitution of the second stop [default: that of the first, if that is one value]
    #[arg(long, value_name = "VALUES", allow_hyphen_values = true)]
    second_restitution: Option<Ranged>,

    #[command(flatten)]
    axes: AxesArgs,

    #[command(flatten)]
    machine: PhysicalArgs,
}

impl RangedSystemArgs {
    /// The given parameters, in the order of the flags.
    fn given(&self) -> impl Iterator<Item = (Parameter, &Ranged)> {
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

    /// The system with the first value of each range, and the units of the results.
    pub(crate) fn asked(&self) -> Result<Asked, Failure> {
        let first = |given: &Option<Ranged>| given.as_ref().map(Ranged::first);
        let plain = |given: &Option<MaybeLength>| given.as_ref().and_then(MaybeLength::plain).map(Ranged::first);
        let machine = self.machine();
        let second = self.second_gap.is_some() || machine.has_second_stop();
        if !second && self.second_restitution.is_some() {
            return Err(Failure::bad("the second stop has a restitution but no gap\nhint: --second-gap D2"));
        }
        let Some(restitution) = &self.restitution else {
            return Err(Failure::bad("the restitution is not given\nhint: --restitution E"));
        };
        let second_restitution = match (&self.second_restitution, restitution) {
            (None, Ranged::Over(_)) if second => {
                return Err(Failure::bad(
                    "the restitution varies and that of the second stop is not given\nhint: --second-restitution E2",
                ));
            }
            (None, one) => one.first(),
            (Some(own), _) => own.first(),
        };
        if machine.any() {
            let nondimensional =
                |parameter: Parameter| !matches!(parameter, Parameter::Restitution | Parameter::SecondRestitution);
            if let Some((parameter, _)) = self.given().find(|(parameter, _)| nondimensional(*parameter)) {
                return Err(Failure::bad(format!(
                    "--{} cannot go together with a system in physical units",
                    flag(parameter)
                )));
            }
            let restitutions = (Some(restitution.first()), Some(second_restitution));
            return super::physical::asked(&machine.plan(restitutions, &[])?, true);
        }
        let system = SystemPlan {
            beta: first(&self.beta),
            inverse_beta: first(&self.inverse_beta),
            gap: plain(&self.gap).unwrap_or(0.0),
            restitution: restitution.first(),
            damping: first(&self.damping).unwrap_or(0.0),
            second_stop: plain(&self.second_gap).map(|gap| SecondStop { gap, restitution: second_restitution }),
            machine: None,
        };
        Ok(Asked { system, units: Units::default() })
    }

    /// The numbers of the machine, with gaps that were written with a unit.
    fn machine(&self) -> PhysicalArgs {
        let mut machine = self.machine.clone();
        for (parameter, given) in
            [(PhysicalParameter::Gap, &self.gap), (PhysicalParameter::SecondGap, &self.second_gap)]
        {
            if let Some(metres) = given.as_ref().and_then(MaybeLength::metres) {
                machine.put(parameter, metres.clone());
            }
        }
        machine
    }

    /// The parameters that vary, in the order of the axes.
    pub(crate) fn axes(&self) -> Result<Vec<Axis>, Failure> {
        let mut varied = self.machine().axes()?;
        varied.extend(
            self.given().filter_map(|(parameter, given)| Some((ParameterFlag { parameter }, given.axis(parameter)?))),
        );
        Ok(self.axes.order(varied, |(named, _)| named.parameter)?.into_iter().map(|(_, axis)| axis).collect())
    }
}

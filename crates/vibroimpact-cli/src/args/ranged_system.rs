//! SYSTEM with the values of axes: each number is one value or those of an axis.

use super::AxesArgs;
use super::body::BodyArgs;
use super::system::{Convention, NumbersArgs, values, without_second_restitution};
use crate::failure::Failure;
use clap::Args;
use vibroimpact_report::Asked;
use vibroimpact_study::{Axis, Parameter, Variable};

/// The parameters of a system, values or ranges.
#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "System", mut_args(values))]
pub(crate) struct RangedSystemArgs {
    #[command(flatten)]
    numbers: NumbersArgs,

    #[command(flatten)]
    axes: AxesArgs,

    #[command(flatten)]
    body: BodyArgs,
}

impl RangedSystemArgs {
    /// The system with the first value of each range, and the units of the results, which are SI units of a body.
    pub(crate) fn asked(&self) -> Result<Asked, Failure> {
        if self.numbers.varies(Parameter::Restitution) && self.numbers.second_stop_follows(&self.body) {
            return Err(without_second_restitution());
        }
        let body = self.numbers.body(&self.body).any();
        let units = if body { Convention::Si } else { Convention::Nondimensional };
        self.numbers.first(&self.body, units, &[])
    }

    /// The parameters that vary, in the order of the axes.
    pub(crate) fn axes(&self) -> Result<Vec<Axis<Variable>>, Failure> {
        let mut varied = self.numbers.body(&self.body).axes()?;
        varied.extend(self.numbers.given().filter_map(|(parameter, given)| Some((parameter, given.axis(parameter)?))));
        let of_axis = |(_, Axis { vary, over }): (_, Axis)| Axis { vary: vary.into(), over };
        Ok(self.axes.order(varied, |(parameter, _)| *parameter)?.into_iter().map(of_axis).collect())
    }
}

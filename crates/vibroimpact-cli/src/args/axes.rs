//! AXES: the order in which the parameters that vary are the axes.

use super::parameter_flag::{flag, parameter};
use crate::failure::Failure;
use clap::Args;
use vibroimpact::math::sort_by_key;
use vibroimpact_study::Parameter;

/// The order of the axes.
#[derive(Clone, Debug, Args)]
pub(crate) struct AxesArgs {
    /// The parameters that vary in the order of the axes, the first to the right: gap,inverse-beta [default: in that of the flags]
    #[arg(long, value_name = "PARAMETERS", value_delimiter = ',', value_parser = parameter(), hide_possible_values = true)]
    axes: Vec<Parameter>,
}

impl AxesArgs {
    /// The parameters that vary in the requested order, or unchanged if none was requested.
    pub(crate) fn order<T>(&self, varied: Vec<T>, parameter: impl Fn(&T) -> Parameter) -> Result<Vec<T>, Failure> {
        if self.axes.is_empty() {
            return Ok(varied);
        }
        let names = |parameters: &[Parameter]| parameters.iter().map(|p| flag(*p)).collect::<Vec<_>>().join(",");
        let vary: Vec<Parameter> = varied.iter().map(&parameter).collect();
        let place = |one: &T| self.axes.iter().position(|other| *other == parameter(one));
        let each_once = self.axes.len() == vary.len() && varied.iter().all(|one| place(one).is_some());
        if !each_once {
            return Err(Failure::bad(format!(
                "--axes {} is not the order of what varies: {}\nhint: name each parameter that has a range once",
                names(&self.axes),
                if vary.is_empty() { "nothing".to_owned() } else { names(&vary) }
            )));
        }
        let mut varied = varied;
        sort_by_key(&mut varied, place);
        Ok(varied)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_parameter_once() {
        use Parameter::{Beta, Gap, Restitution};
        let order = |axes: &[Parameter]| AxesArgs { axes: axes.to_vec() }.order(vec![Beta, Gap], |p| *p).ok();
        assert_eq!(order(&[]), Some(vec![Beta, Gap]));
        assert_eq!(order(&[Beta, Gap]), Some(vec![Beta, Gap]));
        assert_eq!(order(&[Gap, Beta]), Some(vec![Gap, Beta]));
        for bad in [&[Gap][..], &[Gap, Gap], &[Gap, Restitution], &[Gap, Beta, Gap]] {
            assert_eq!(order(bad), None, "{bad:?}");
        }
    }
}

//! VARY: parameters that vary over ranges, and the system without them.

use super::SystemArgs;
use super::body::alone;
use super::parameter_flag::flag;
use super::system::without_second_restitution;
use crate::failure::Failure;
use vibroimpact_report::Asked;
use vibroimpact_study::{BodyNumber, Parameter};

impl SystemArgs {
    /// The system with results in SI units if one of these parameters is a number of a body, whose first values are
    /// given for those that are not given otherwise.
    fn with_first(&self, varied: &[Parameter], set: &[(BodyNumber, f64)]) -> Result<Asked, Failure> {
        let Some(si) = varied.iter().find(|parameter| parameter.of_body().is_some()) else { return self.asked() };
        if !self.is_body() {
            let twin = match si {
                Parameter::Body(BodyNumber::Frequency) => "; beta is nondimensional",
                Parameter::Body(BodyNumber::Gap) => "; gap is nondimensional",
                Parameter::Body(BodyNumber::SecondGap) => "; second-gap is nondimensional",
                _ => "",
            };
            return Err(Failure::bad(format!(
                "{} needs the system in physical units\nhint: --mass-kg, --stiffness-n-per-m, --force-n ...{twin}",
                flag(*si)
            )));
        }
        self.in_si().asked_with(set)
    }

    /// The system in which these parameters vary from their values in it.
    pub(crate) fn over(&self, varied: &[Parameter]) -> Result<Asked, Failure> {
        self.with_first(varied, &[])
    }

    /// The system in which the parameters that vary have their first values. Parameters of an oscillator may not have other
    /// values. For each parameter the flags are given that make it vary and set its range.
    pub(crate) fn varied(&self, varied: &[(Parameter, f64, [&str; 2])]) -> Result<Asked, Failure> {
        let mut args = self.clone();
        for (parameter, _, [varies, over]) in varied {
            let given = Parameter::ALL.into_iter().filter(|other| other.same_number(*parameter));
            if let Some(given) = given.into_iter().find(|parameter| args.numbers.has(*parameter)) {
                return Err(Failure::bad(format!(
                    "--{} cannot go together with --{varies} {}\nhint: leave it out, --{over} has its values",
                    flag(given),
                    flag(*parameter)
                )));
            }
            if *parameter == Parameter::Restitution && args.numbers.second_stop_follows(&args.body) {
                return Err(without_second_restitution());
            }
        }
        let body = args.is_body();
        let restitution = |p: Parameter| matches!(p, Parameter::Restitution | Parameter::SecondRestitution);
        for (parameter, first, _) in varied {
            if !body || restitution(*parameter) {
                args.numbers.set(*parameter, Some(*first));
            }
        }
        let set: Vec<(BodyNumber, f64)> =
            varied.iter().filter_map(|(parameter, first, _)| Some((parameter.of_body()?, *first))).collect();
        let mut asked = args.with_first(&varied.iter().map(|(parameter, ..)| *parameter).collect::<Vec<_>>(), &set)?;
        for (parameter, first, _) in varied {
            if body && !restitution(*parameter) {
                asked.system = asked.system.with(*parameter, first / asked.units.of(*parameter))?;
            }
        }
        Ok(asked.refreshed())
    }
}

/// The parameters of a curve or a region. They are parameters of the oscillator where each number of a body that varies
/// changes one of these alone, as its frequency does; their units change too then. Otherwise they are numbers of the body.
pub(crate) fn of_oscillator(asked: &mut Asked, varied: &[Parameter]) -> Vec<Parameter> {
    let body = asked.units.body;
    let own = |parameter: &Parameter| match (*parameter, body) {
        (Parameter::Body(number), Some(body)) => alone(number, &body),
        (parameter, _) => Some(parameter),
    };
    let Some(parameters) = varied.iter().map(own).collect::<Option<Vec<_>>>() else { return varied.to_vec() };
    asked.units.hertz = varied.contains(&Parameter::Body(BodyNumber::Frequency));
    parameters
}

//! SYSTEM with ranges A:B: each parameter is one value or lies between two ends.

use super::system::{NumbersArgs, without_second_restitution};
use super::{BodyArgs, Convention};
use crate::failure::Failure;
use vibroimpact_report::Asked;
use vibroimpact_study::{BodyNumber, Parameter, Stretch};

/// How the numbers of a body that vary are parameters: as those of the oscillator, or as they are.
pub(crate) type AsParameters = fn(&mut Asked, &[Parameter]) -> Vec<Parameter>;

impl NumbersArgs {
    /// Whether the restitution varies and that of a second stop would have to follow it.
    fn restitution_follows(&self, asked: &Asked) -> bool {
        self.varies(Parameter::Restitution)
            && !self.has(Parameter::SecondRestitution)
            && asked.system.second_stop.is_some()
    }

    /// The system, with the smallest values of the parameters that vary, and these parameters. A system in physical units
    /// must be given completely, because its units depend on all quantities; ranges replace its values. `first` are the values
    /// of parameters that have no flag.
    pub(crate) fn over_ranges(
        &self,
        (body, units): (&BodyArgs, Convention),
        first: &[(Parameter, f64)],
        as_parameters: AsParameters,
    ) -> Result<(Asked, Vec<Stretch>), Failure> {
        let is_body = body.any();
        let restitution = |p: Parameter| matches!(p, Parameter::Restitution | Parameter::SecondRestitution);
        let mut numbers = self.clone();
        for (parameter, _) in self.given().filter(|(of, given)| is_body && !restitution(*of) && !given.is_one()) {
            numbers.set(parameter, None);
        }
        for (parameter, value) in first.iter().filter(|(of, _)| !self.has(*of) && (!is_body || restitution(*of))) {
            numbers.set(*parameter, Some(*value));
        }
        let physical = body.ends()?;
        let set: Vec<(BodyNumber, f64)> =
            (first.iter()).filter_map(|(parameter, value)| Some((parameter.of_body()?, *value))).collect();
        let units = if physical.is_empty() && set.is_empty() { units } else { Convention::Si };
        let mut asked = numbers.first(body, units, &set)?;
        let flags: Vec<Parameter> = physical.iter().map(|(parameter, _)| *parameter).collect();
        let parameters = as_parameters(&mut asked, &flags);
        let ranges = parameters.into_iter().zip(physical).map(|(parameter, (_, ends))| (parameter, ends));
        let plain = self.given().filter_map(|(parameter, given)| Some((parameter, given.ends()?)));
        let stretch = |(parameter, (from, to))| {
            let unit = asked.units.of(parameter);
            Stretch { parameter, from: from / unit, to: to / unit }
        };
        let over: Vec<Stretch> = plain.chain(ranges).map(stretch).collect();
        let listed = first.iter().map(|(parameter, value)| (*parameter, value / asked.units.of(*parameter)));
        let starts: Vec<(Parameter, f64)> =
            listed.chain(over.iter().map(|stretch| (stretch.parameter, stretch.from))).collect();
        let of_body = starts.iter().any(|(parameter, _)| matches!(parameter, Parameter::Body(_)));
        if of_body {
            asked.system = asked.system.with_all(starts)?;
            asked = asked.refreshed();
        } else if is_body && !starts.is_empty() {
            // what varies are parameters of the oscillator, in the units of the body
            asked.system.body = None;
            for (parameter, value) in starts {
                asked.system = asked.system.with(parameter, value)?;
            }
        }
        if self.restitution_follows(&asked) {
            return Err(without_second_restitution());
        }
        Ok((asked, over))
    }
}

//! SYSTEM with ranges A:B: each parameter is one value or lies between two ends.

use super::{Convention, ParameterFlag, PhysicalArgs, Place, SystemArgs};
use crate::failure::Failure;
use clap::Args;
use vibroimpact::PhysicalParameter;
use vibroimpact_report::Asked;
use vibroimpact_study::{Parameter, Stretch};

/// The parameters of a system, values or ranges A:B.
#[derive(Clone, Debug, Args)]
pub(crate) struct SystemStretchesArgs {
    /// Frequency ratio: forcing over natural frequency, a value or a range A:B
    #[arg(long, value_name = "B", allow_hyphen_values = true, conflicts_with = "inverse_beta")]
    beta: Option<Place>,

    /// Its inverse omega_n/omega instead
    #[arg(long, value_name = "X", allow_hyphen_values = true)]
    inverse_beta: Option<Place>,

    /// Distance of the stop from the rest position in units of F/k
    #[arg(long, value_name = "D", allow_hyphen_values = true)]
    gap: Option<Place>,

    /// Restitution: rebound speed over arrival speed, 0 to 1
    #[arg(long, value_name = "E", allow_hyphen_values = true, required = true)]
    restitution: Option<Place>,

    /// Damping ratio zeta, 0 or more [default: 0]
    #[arg(long, value_name = "Z", allow_hyphen_values = true)]
    damping: Option<Place>,

    /// A second stop on the other side, at x = -D2
    #[arg(long, value_name = "D2", allow_hyphen_values = true)]
    second_gap: Option<Place>,

    /// Restitution of the second stop [default: that of the first]
    #[arg(long, value_name = "E2", allow_hyphen_values = true)]
    second_restitution: Option<Place>,
}

/// How the numbers of a machine that vary are parameters: as those of the oscillator, or as they are.
pub(crate) type AsParameters = fn(&mut Asked, &[ParameterFlag]) -> Vec<Parameter>;

impl SystemStretchesArgs {
    fn places(&self) -> [(Parameter, Option<Place>); 7] {
        [
            (Parameter::Beta, self.beta),
            (Parameter::InverseBeta, self.inverse_beta),
            (Parameter::Gap, self.gap),
            (Parameter::Restitution, self.restitution),
            (Parameter::Damping, self.damping),
            (Parameter::SecondGap, self.second_gap),
            (Parameter::SecondRestitution, self.second_restitution),
        ]
    }

    /// The parameters that are given.
    pub(crate) fn given(&self) -> impl Iterator<Item = Parameter> {
        self.places().into_iter().filter_map(|(parameter, place)| place.map(|_| parameter))
    }

    /// Whether the restitution varies and that of a second stop would have to follow it.
    pub(crate) fn second_stop_follows(&self, asked: &Asked) -> bool {
        let varies = self.restitution.is_some_and(|place| place.over(Parameter::Restitution).is_some());
        varies && self.second_restitution.is_none() && asked.system.second_stop.is_some()
    }

    /// The system, with the smallest values of the parameters that vary, and these parameters. A system in physical units
    /// must be given completely, because its units depend on all quantities; ranges replace its values. `first` are the values
    /// of parameters that have no flag.
    pub(crate) fn asked(
        &self,
        (machine, units): (&PhysicalArgs, Convention),
        first: &[(Parameter, f64)],
        as_parameters: AsParameters,
    ) -> Result<(Asked, Vec<Stretch>), Failure> {
        let is_machine = machine.any();
        let restitution = |p: Parameter| matches!(p, Parameter::Restitution | Parameter::SecondRestitution);
        let own = |(parameter, place): (Parameter, Option<Place>)| {
            let ranged = place.is_some_and(|place| place.over(parameter).is_some());
            let replaces = is_machine && !restitution(parameter) && ranged;
            let listed = first.iter().find(|(of, _)| *of == parameter && (!is_machine || restitution(*of)));
            let value = place.filter(|_| !replaces).map(Place::first).or(listed.map(|(_, value)| *value));
            (parameter, value)
        };
        let physical = machine.ends()?;
        let set: Vec<(PhysicalParameter, f64)> = (first.iter())
            .filter_map(|(parameter, value)| match parameter {
                Parameter::Physical(parameter) => Some((*parameter, *value)),
                _ => None,
            })
            .collect();
        let units = if physical.is_empty() && set.is_empty() { units } else { Convention::Si };
        let mut asked = SystemArgs::of(&self.places().map(own), machine.clone(), units).first(&set)?;
        let flags: Vec<ParameterFlag> = physical.iter().map(|(named, _)| *named).collect();
        let parameters = as_parameters(&mut asked, &flags);
        let ranges = parameters.into_iter().zip(physical).map(|(parameter, (_, ends))| (parameter, ends));
        let plain = self.places().into_iter().filter_map(|(parameter, place)| {
            let Stretch { from, to, .. } = place?.over(parameter)?;
            Some((parameter, (from, to)))
        });
        let stretch = |(parameter, (from, to))| {
            let unit = asked.units.of(parameter);
            Stretch { parameter, from: from / unit, to: to / unit }
        };
        let over: Vec<Stretch> = plain.chain(ranges).map(stretch).collect();
        let listed = first.iter().map(|(parameter, value)| (*parameter, value / asked.units.of(*parameter)));
        let starts: Vec<(Parameter, f64)> =
            listed.chain(over.iter().map(|stretch| (stretch.parameter, stretch.from))).collect();
        let of_machines = starts.iter().any(|(parameter, _)| matches!(parameter, Parameter::Physical(_)));
        if of_machines {
            asked.system = asked.system.with_all(starts)?;
            asked = asked.refreshed();
        } else if is_machine && !starts.is_empty() {
            // what varies are parameters of the oscillator, in the units of the machine
            asked.system.machine = None;
            for (parameter, value) in starts {
                asked.system = asked.system.with(parameter, value)?;
            }
        }
        Ok((asked, over))
    }
}

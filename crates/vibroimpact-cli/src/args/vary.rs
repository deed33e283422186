//! VARY: a parameter that varies over a range, and the system without it.

use super::SystemArgs;
use super::parameter_flag::{ParameterFlag, flag};
use crate::failure::Failure;
use vibroimpact_report::Asked;
use vibroimpact_study::{Parameter, SystemPlan};

impl SystemArgs {
    /// The system with results in SI units if one of these parameters is in SI units.
    pub(crate) fn over(&self, varied: &[ParameterFlag]) -> Result<Asked, Failure> {
        varied.iter().try_for_each(|parameter| self.excitation.allows(*parameter))?;
        let mut asked = self.asked()?;
        let Some(si) = varied.iter().find(|named| named.si) else { return Ok(asked) };
        if asked.units.scales.is_none() {
            return Err(Failure::bad(format!(
                "{} needs the system in physical units\nhint: --mass-kg, --stiffness-n-per-m, --force-n ...; {} is nondimensional",
                si.flag(),
                flag(si.parameter)
            )));
        }
        asked.units.si = true;
        asked.units.hertz = varied.iter().any(|named| named.si && named.parameter == Parameter::Beta);
        Ok(asked)
    }

    /// The system in which the parameters that vary have their first values. They may not have other values. For each
    /// parameter the flags are given that make it vary and set its range. A system in physical units must be given
    /// completely, because its units depend on all quantities; its values are then replaced.
    pub(crate) fn varied(&self, varied: &[(ParameterFlag, f64, [&str; 2])]) -> Result<Asked, Failure> {
        let mut args = *self;
        for (named, first, _) in varied.iter().filter(|(named, ..)| named.si) {
            args.machine.complete_with(*named, *first);
        }
        for (ParameterFlag { parameter, .. }, _, [varies, over]) in varied {
            let same = |other: &Parameter| other == parameter || other.is_frequency() && parameter.is_frequency();
            if let Some(given) = Parameter::ALL.into_iter().filter(same).find(|p| args.slot(*p).is_some()) {
                return Err(Failure::bad(format!(
                    "--{} cannot go together with --{varies} {}\nhint: leave it out, --{over} has its values",
                    flag(given),
                    flag(*parameter)
                )));
            }
            if *parameter == Parameter::Restitution && args.second_stop_follows() {
                return Err(Failure::bad(
                    "the restitution varies and that of the second stop is not given\nhint: --second-restitution E2",
                ));
            }
        }
        // in a system in physical units, the values are replaced in its units
        let machine = args.is_machine();
        let replaced = |parameter: Parameter| {
            machine && ![Parameter::Restitution, Parameter::SecondRestitution].contains(&parameter)
        };
        for (named, first, _) in varied.iter().filter(|(named, ..)| !replaced(named.parameter)) {
            *args.slot(named.parameter) = Some(*first);
        }
        let asked = args.over(&varied.iter().map(|(named, ..)| *named).collect::<Vec<_>>())?;
        let set = |system: SystemPlan, (named, first, _): &(ParameterFlag, f64, _)| {
            system.with(named.parameter, first / asked.units.of(named.parameter))
        };
        let mut own = varied.iter().filter(|(named, ..)| replaced(named.parameter));
        Ok(Asked { system: own.try_fold(asked.system, set)?, ..asked })
    }
}

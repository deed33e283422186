//! FIELDS: quantities of each motion beside its label.

use crate::failure::Failure;
use clap::Args;
use vibroimpact_study::{Quantity, unknown_quantity};

/// The quantities to report.
#[derive(Clone, Debug, Args)]
pub(crate) struct FieldsArgs {
    /// Quantities of each motion to report too: impact-speed-max,power. Of a machine by path: power,
    /// stop.NAME.impact-speed-max, q.NAME.displacement-rms and all others that `vibro settle --machine` has in JSON. All
    /// of an oscillator: impact-speed-max, impact-speed-mean, impacts-per-period, impact-rate, impulse-max,
    /// impulse-per-period, impact-loss-per-period, impact-power, damping-loss-per-period, damping-power, work-per-period,
    /// power, displacement-min, displacement-max, displacement-amplitude, displacement-mean, displacement-rms,
    /// velocity-max, velocity-rms, acceleration-max, sticking-fraction
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = FieldName::parse, help_heading = "Output")]
    fields: Vec<FieldName>,
}

/// The name of a quantity: of an oscillator, or else of a machine.
#[derive(Clone, Debug)]
pub(crate) enum FieldName {
    Quantity(Quantity),
    Path(String),
}

impl FieldsArgs {
    /// The quantities of an oscillator.
    pub(crate) fn quantities(&self) -> Result<Vec<Quantity>, Failure> {
        let one = |field: &FieldName| match field {
            FieldName::Quantity(quantity) => Ok(*quantity),
            FieldName::Path(path) => {
                Err(Failure::bad(format!("--fields: {}", unknown_quantity(path).replace('_', "-"))))
            }
        };
        self.fields.iter().map(one).collect()
    }

    /// The paths of quantities of a machine.
    pub(crate) fn paths(&self) -> Vec<String> {
        self.fields.iter().map(FieldName::path).collect()
    }

    /// Adds a quantity, if it is not there.
    pub(super) fn add(&mut self, field: Option<&FieldName>) {
        self.fields.extend(field.filter(|field| self.fields.iter().all(|own| own.path() != field.path())).cloned());
    }
}

impl FieldName {
    /// Parses the name of a quantity of an oscillator or machine. What a machine has is known only when it is read.
    pub(super) fn parse(name: &str) -> Result<Self, String> {
        Ok(quantity(name).map_or_else(|_| Self::Path(name.trim().to_owned()), Self::Quantity))
    }

    /// Its path in a machine; of an oscillator its name.
    pub(super) fn path(&self) -> String {
        match self {
            Self::Quantity(quantity) => quantity.name().to_owned(),
            // the names of quantities have underscores there, those of stops are as they are
            Self::Path(path) => match path.rsplit_once('.') {
                Some((part, name)) => format!("{part}.{}", name.replace('-', "_")),
                None => path.replace('-', "_"),
            },
        }
    }
}

/// Parses the name of a quantity.
pub(crate) fn quantity(name: &str) -> Result<Quantity, String> {
    Quantity::from_name(name).ok_or_else(|| unknown_quantity(name).replace('_', "-"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[derive(clap::Parser)]
    struct Alone {
        #[command(flatten)]
        args: FieldsArgs,
    }

    #[test]
    fn the_help_names_all_quantities() {
        let help = Alone::command().render_long_help().to_string();
        let words: Vec<&str> = help.split([' ', ',', '\n']).collect();
        for known in Quantity::ALL {
            let flag = known.name().replace('_', "-");
            assert!(words.contains(&flag.as_str()), "{flag}: {help}");
            assert_eq!(Quantity::from_name(&flag), Some(known));
        }
        assert!(quantity("speed").is_err_and(|why| why.contains("impact-speed-max")));
    }
}

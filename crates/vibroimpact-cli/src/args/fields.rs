//! FIELDS: quantities of each motion beside its label.

use clap::Args;
use vibroimpact_study::{Quantity, unknown_quantity};

/// The quantities to report.
#[derive(Clone, Debug, Args)]
pub(crate) struct FieldsArgs {
    /// Quantities of each motion to report too: impact-speed-max,power. All: impact-speed-max, impact-speed-mean,
    /// impacts-per-period, impact-rate, impulse-max, impulse-per-period, impact-loss-per-period, impact-power,
    /// damping-loss-per-period, damping-power, work-per-period, power, displacement-min, displacement-max,
    /// displacement-amplitude, displacement-mean, displacement-rms, velocity-max, velocity-rms, acceleration-max,
    /// sticking-fraction
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = quantity, help_heading = "Output")]
    pub(crate) fields: Vec<Quantity>,
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

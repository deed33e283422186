//! START: the start of a motion.

use super::number;
use clap::Args;
use vibroimpact_report::Units;
use vibroimpact_study::StartPlan;

#[derive(Clone, Copy, Debug, Args)]
#[command(next_help_heading = "Start")]
pub(crate) struct StartArgs {
    /// Position, not beyond the stop [default: 0, or on the stop when the gap is negative]
    #[arg(long, value_parser = number, value_name = "X", allow_hyphen_values = true)]
    x: Option<f64>,

    /// Velocity
    #[arg(long, value_parser = number, value_name = "V", default_value_t = 0.0, allow_hyphen_values = true)]
    v: f64,

    /// Phase of the force in radians [default: 0]
    #[arg(long, value_parser = number, value_name = "P", allow_hyphen_values = true)]
    pub(crate) phase: Option<f64>,
}

impl StartArgs {
    pub(crate) fn plan(&self, units: &Units) -> StartPlan {
        StartPlan {
            x: self.x.map(|x| x / units.length()),
            v: self.v / units.velocity(),
            phase: self.phase.unwrap_or(0.0),
        }
    }
}

//! A machine instead of an oscillator, and its start.

use super::{SetArgs, number};
use crate::failure::Failure;
use crate::machine_file;
use clap::Args;
use vibroimpact::events::MachineStart;
use vibroimpact::machine::Machine;

#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "Machine")]
pub(crate) struct OfMachineArgs {
    /// A machine of the catalogue or a file with a table [machine], instead of the system above
    #[arg(long, value_name = "NAME|FILE")]
    pub(crate) machine: Option<String>,

    #[command(flatten)]
    set: SetArgs,

    /// Coordinates at the start, one for each, separated by commas [default: 0 each]
    #[arg(long, value_parser = number, value_delimiter = ',', value_name = "A,B,...", allow_hyphen_values = true, requires = "machine")]
    q: Vec<f64>,

    /// Velocities at the start, one for each coordinate [default: 0 each]
    #[arg(long, value_parser = number, value_delimiter = ',', value_name = "A,B,...", allow_hyphen_values = true, requires = "machine")]
    qdot: Vec<f64>,
}

impl OfMachineArgs {
    /// The machine with its changed numbers, and the start; `None` if none is named.
    pub(crate) fn asked(&self, phase: f64) -> Result<Option<(&str, Machine, MachineStart)>, Failure> {
        let Some(name) = &self.machine else { return Ok(None) };
        let machine = self.set.apply(machine_file::read(name)?)?.machine()?;
        Ok(Some((name, machine, MachineStart { q: self.q.clone(), qdot: self.qdot.clone(), phase })))
    }
}

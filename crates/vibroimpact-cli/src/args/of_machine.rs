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
    /// A machine of the catalogue or a machine file, instead of the system above
    #[arg(long, value_name = "NAME|FILE")]
    pub(crate) machine: Option<String>,

    #[command(flatten)]
    set: SetArgs,

    /// Coordinates at the start, one for each, separated by commas [default: those that the machine file says, or 0]
    #[arg(long, value_parser = number, value_delimiter = ',', value_name = "A,B,...", allow_hyphen_values = true, requires = "machine")]
    q: Vec<f64>,

    /// Velocities at the start, one for each coordinate [default: likewise]
    #[arg(long, value_parser = number, value_delimiter = ',', value_name = "A,B,...", allow_hyphen_values = true, requires = "machine")]
    qdot: Vec<f64>,
}

impl OfMachineArgs {
    /// The machine with its changed numbers, and the start; `None` if none is named. A phase of 0 is that of the table
    /// `[start]`.
    pub(crate) fn asked(&self, phase: f64) -> Result<Option<(&str, Machine, MachineStart)>, Failure> {
        let Some(name) = &self.machine else { return Ok(None) };
        let source = self.set.apply(machine_file::read(name)?)?;
        let (machine, start) = (source.machine()?, source.start()?);
        let given = |typed: &[f64], written: Vec<f64>| if typed.is_empty() { written } else { typed.to_vec() };
        let phase = if phase == 0.0 { start.phase } else { phase };
        Ok(Some((
            name,
            machine,
            MachineStart { q: given(&self.q, start.q), qdot: given(&self.qdot, start.qdot), phase },
        )))
    }
}

//! A machine instead of an oscillator, and its start.

use super::{SetArgs, number};
use crate::failure::Failure;
use crate::machine_file;
use clap::Args;
use vibroimpact_study::machine::{MachineSource, NumberText, StartText, VectorText};

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
    /// The machine with its changed numbers and its start, and its name; `None` if none is named. What is not given of the
    /// start is that of the table `[start]`.
    pub(crate) fn asked(&self, phase: Option<f64>) -> Result<Option<(&str, MachineSource)>, Failure> {
        let Some(name) = &self.machine else { return Ok(None) };
        let mut source = self.set.apply(machine_file::read(name)?)?;
        let numbers = |given: &[f64]| VectorText::List(given.iter().map(|value| NumberText::Value(*value)).collect());
        let start = source.start.get_or_insert_default();
        if !self.q.is_empty() {
            start.q = Some(numbers(&self.q));
        }
        if !self.qdot.is_empty() {
            start.qdot = Some(numbers(&self.qdot));
        }
        if let Some(phase) = phase {
            start.phase = Some(NumberText::Value(phase));
        }
        if *start == StartText::default() {
            source.start = None;
        }
        Ok(Some((name, source)))
    }
}

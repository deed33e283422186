//! A machine instead of an oscillator, its start, and the axes of its grids.

use super::ranged::axis_values;
use super::{SetArgs, number};
use crate::failure::Failure;
use crate::{machine_file, state_file};
use clap::Args;
use vibroimpact_study::machine::{MachineSource, NumberText, StartText, VectorText};
use vibroimpact_study::{Axis, Coordinate, Variable};

#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "Machine")]
pub(crate) struct MachineArgs {
    /// A machine of the catalogue or a machine file, instead of the system above
    #[arg(long, value_name = "NAME|FILE")]
    pub(crate) machine: Option<String>,

    #[command(flatten)]
    set: SetArgs,
}

#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "Machine")]
pub(crate) struct StartOfMachineArgs {
    /// Coordinates at the start, one for each, separated by commas [default: those that the machine file says, or 0]
    #[arg(long, value_parser = number, value_delimiter = ',', value_name = "A,B,...", allow_hyphen_values = true, requires = "machine")]
    q: Vec<f64>,

    /// Velocities at the start, one for each coordinate [default: likewise]
    #[arg(long, value_parser = number, value_delimiter = ',', value_name = "A,B,...", allow_hyphen_values = true, requires = "machine")]
    qdot: Vec<f64>,

    /// A state that `vibro simulate --json` or `vibro settle --json` wrote, with its contacts: that of the last event, or of the
    /// motion; FILE#/events/2 is the state of the third event
    #[arg(long, value_name = "FILE", requires = "machine", conflicts_with_all = ["q", "qdot"])]
    start: Option<String>,
}

#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "Machine")]
pub(crate) struct MachineAxesArgs {
    /// What varies over a machine, once for each axis: the path of a number, or q.NAME, qdot.NAME and phase of the start; A:B:N is N
    /// values from A to B, A:B:N:log is N values in equal ratios, and A,B,C is a list
    #[arg(long, value_parser = axis, value_name = "PATH=A:B:N", allow_hyphen_values = true, requires = "machine")]
    axis: Vec<Axis<String>>,
}

/// The axes of a study of exponents, of an oscillator or of a machine.
#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "Axes")]
pub(crate) struct StudyAxesArgs {
    /// What varies, once for each axis: a parameter, or x, v and phase of the start; of a machine the path of a number, or q.NAME,
    /// qdot.NAME and phase. A:B:N is N values from A to B, A:B:N:log is N values in equal ratios, and A,B,C is a list
    #[arg(long, value_parser = axis, value_name = "NAME=A:B:N", allow_hyphen_values = true)]
    axis: Vec<Axis<String>>,
}

impl StudyAxesArgs {
    pub(crate) fn count(&self) -> usize {
        self.axis.len()
    }

    /// As axes of a machine.
    pub(crate) fn of_machine(&self) -> Vec<Axis<Variable>> {
        typed(&self.axis)
    }

    /// As axes of an oscillator.
    pub(crate) fn of_oscillator(&self) -> Result<Vec<Axis<Variable>>, Failure> {
        let axis = |Axis { vary, over }: &Axis<String>| {
            let vary = Coordinate::named(&vary.replace('-', "_")).ok_or_else(|| {
                Failure::bad(format!(
                    "`{vary}` cannot vary\nhint: a parameter, such as gap or inverse-beta, or x, v or phase"
                ))
            })?;
            Ok(Axis { vary: vary.into(), over: over.clone() })
        };
        self.axis.iter().map(axis).collect()
    }
}

/// Reads an axis as it is typed.
fn axis(text: &str) -> Result<Axis<String>, String> {
    let (vary, over) =
        text.split_once('=').ok_or("an axis is PATH=A:B:N, for example stop.wall.gap=0:2:41".to_owned())?;
    Ok(Axis { vary: vary.trim().to_owned(), over: axis_values(over)? })
}

fn typed(axes: &[Axis<String>]) -> Vec<Axis<Variable>> {
    let axis = |Axis { vary, over }: &Axis<String>| Axis { vary: Variable::Path(vary.clone()), over: over.clone() };
    axes.iter().map(axis).collect()
}

impl MachineAxesArgs {
    pub(crate) fn axes(&self) -> Vec<Axis<Variable>> {
        typed(&self.axis)
    }
}

impl MachineArgs {
    /// The machine with its changed numbers and its start. What is not given of the start is that of the table `[start]`.
    pub(crate) fn source(&self, start: Option<(&StartOfMachineArgs, Option<f64>)>) -> Result<MachineSource, Failure> {
        let name = self.machine.as_deref().unwrap_or_default();
        let mut source = self.set.apply(machine_file::read(name)?)?;
        let Some((given, phase)) = start else { return Ok(source) };
        let numbers = |given: &[f64]| VectorText::List(given.iter().map(|value| NumberText::Value(*value)).collect());
        if let Some(file) = &given.start {
            source.start = Some(state_file::read(file)?);
        }
        let start = source.start.get_or_insert_default();
        if !given.q.is_empty() || !given.qdot.is_empty() {
            // contacts belong to the coordinates and velocities with which they came
            (start.contacts, start.exact) = Default::default();
        }
        if !given.q.is_empty() {
            start.q = Some(numbers(&given.q));
        }
        if !given.qdot.is_empty() {
            start.qdot = Some(numbers(&given.qdot));
        }
        if let Some(phase) = phase {
            start.phase = Some(NumberText::Value(phase));
        }
        if *start == StartText::default() {
            source.start = None;
        }
        Ok(source)
    }
}

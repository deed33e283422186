//! The system of a command, an oscillator or a machine, and the question about it.

use super::{
    ColourArgs, FieldsArgs, MachineArgs, MachineAxesArgs, RangedSystemArgs, StartArgs, StartOfMachineArgs, StoreArgs,
    StudyAxesArgs, SystemArgs, Varied,
};
use super::{Interval, VariedNamed};
use crate::args::plane::{Ends, Value};
use crate::failure::Failure;
use clap::Args;
use vibroimpact_report::{Asked, Units};
use vibroimpact_study::machine::MachineSource;
use vibroimpact_study::{Axis, Plan, StartPlan, Stretch, Target, Task, Variable};

/// The system of a command.
#[allow(clippy::large_enum_variant, reason = "there is one of them")]
pub(crate) enum AskedSystem<'a> {
    /// An oscillator, and the units of the results.
    Oscillator(Asked),
    /// A machine with its start, and its name.
    Machine(Box<MachineSource>, &'a str),
}

/// A plan, the units of its results, and the name of its machine.
pub(crate) struct Question<'a> {
    pub(crate) plan: Plan,
    pub(crate) units: Units,
    pub(crate) machine: Option<&'a str>,
}

/// A system, and the start of a motion.
#[derive(Clone, Debug, Args)]
pub(crate) struct StartedArgs {
    #[command(flatten)]
    system: SystemArgs,
    #[command(flatten)]
    start: StartArgs,
    #[command(flatten)]
    machine: MachineArgs,
    #[command(flatten)]
    of_machine: StartOfMachineArgs,
}

impl StartedArgs {
    /// The system, and the start of an oscillator, which is a part of the task.
    pub(crate) fn asked(&self) -> Result<(AskedSystem<'_>, Option<StartPlan>), Failure> {
        self.asked_as(|| self.system.asked())
    }

    /// The same, with the oscillator that is made so.
    pub(crate) fn asked_as(
        &self,
        oscillator: impl FnOnce() -> Result<Asked, Failure>,
    ) -> Result<(AskedSystem<'_>, Option<StartPlan>), Failure> {
        let system = self.machine.or_oscillator(Some((&self.of_machine, self.start.phase)), oscillator)?;
        let start = system.start(&self.start);
        Ok((system, start))
    }

    /// The numbers of the oscillator.
    pub(crate) const fn system(&self) -> &SystemArgs {
        &self.system
    }
}

impl MachineArgs {
    /// The machine that is named, with this start; without a name the oscillator.
    pub(crate) fn or_oscillator(
        &self,
        start: Option<(&StartOfMachineArgs, Option<f64>)>,
        oscillator: impl FnOnce() -> Result<Asked, Failure>,
    ) -> Result<AskedSystem<'_>, Failure> {
        Ok(match &self.machine {
            Some(name) => AskedSystem::Machine(Box::new(self.source(start)?), name),
            None => AskedSystem::Oscillator(oscillator()?),
        })
    }
}

impl<'a> AskedSystem<'a> {
    /// Whether it is a machine.
    pub(crate) const fn is_machine(&self) -> bool {
        matches!(self, Self::Machine(..))
    }

    /// The units of starts, ranges and results; a machine has those of its numbers.
    pub(crate) fn units(&self) -> Units {
        match self {
            Self::Oscillator(asked) => asked.units,
            Self::Machine(..) => Units::default(),
        }
    }

    /// The start of an oscillator, which is a part of the task.
    pub(crate) fn start(&self, start: &StartArgs) -> Option<StartPlan> {
        match self {
            Self::Oscillator(asked) => Some(start.plan(&asked.units)),
            Self::Machine(..) => None,
        }
    }

    /// What varies, and its unit.
    pub(crate) fn variable(&self, varied: &Varied) -> Result<(Variable, f64), Failure> {
        match self {
            Self::Oscillator(asked) => {
                let parameter = varied.parameter()?;
                Ok((parameter.into(), asked.units.of(parameter)))
            }
            Self::Machine(..) => Ok((Variable::Path(varied.path()), 1.0)),
        }
    }

    /// What varies, and a value of it.
    pub(crate) fn target(&self, varied: &Varied, to: f64) -> Result<Target<Variable>, Failure> {
        let (parameter, unit) = self.variable(varied)?;
        Ok(Target { parameter, to: to / unit })
    }

    /// What varies with another number, and its last value.
    pub(crate) fn also(&self, also: Option<&VariedNamed<Value>>) -> Result<Option<Target<Variable>>, Failure> {
        also.map(|VariedNamed(varied, Value(to))| self.target(varied, *to)).transpose()
    }

    /// What varies, and its range.
    pub(crate) fn stretch(&self, varied: &Varied, (from, to): (f64, f64)) -> Result<Stretch<Variable>, Failure> {
        let (parameter, unit) = self.variable(varied)?;
        Ok(Stretch { parameter, from: from / unit, to: to / unit })
    }

    /// What varies with another number, and its values at both ends.
    pub(crate) fn ends(&self, also: Option<&VariedNamed<Ends>>) -> Result<Option<Stretch<Variable>>, Failure> {
        also.map(|VariedNamed(varied, Ends(from, to))| self.stretch(varied, (*from, *to))).transpose()
    }

    /// The axes over the ranges of an oscillator, or over numbers of a machine.
    pub(crate) fn ranged(
        &self,
        ranges: &RangedSystemArgs,
        of_machine: &MachineAxesArgs,
    ) -> Result<Vec<Axis<Variable>>, Failure> {
        if self.is_machine() { Ok(of_machine.axes()) } else { ranges.axes() }
    }

    /// The axes of a study of exponents.
    pub(crate) fn axes(&self, axes: &StudyAxesArgs) -> Result<Vec<Axis<Variable>>, Failure> {
        match self {
            Self::Oscillator(_) => axes.of_oscillator(),
            Self::Machine(..) => Ok(axes.of_machine()),
        }
    }

    /// The names of quantities to report, and the one that colours a figure.
    pub(crate) fn fields(&self, colour: &ColourArgs, fields: &FieldsArgs) -> Result<Vec<String>, Failure> {
        self.paths(&colour.with(fields))
    }

    /// The names of quantities to report.
    pub(crate) fn paths(&self, fields: &FieldsArgs) -> Result<Vec<String>, Failure> {
        match self {
            Self::Oscillator(_) => Ok(fields.quantities()?.iter().map(|quantity| quantity.name().to_owned()).collect()),
            Self::Machine(..) => Ok(fields.paths()),
        }
    }

    /// The question of a task, which is checked.
    pub(crate) fn question(self, task: impl Into<Task>) -> Result<Question<'a>, Failure> {
        self.stored(task, None)
    }

    /// The same, with the size of tiles and shards of a store.
    pub(crate) fn stored(self, task: impl Into<Task>, store: Option<&StoreArgs>) -> Result<Question<'a>, Failure> {
        let (tile, shard) = store.map_or((None, None), |store| (store.tile, store.shard));
        let question = match self {
            Self::Oscillator(Asked { system, units }) => {
                let plan = Plan { units: units.plan(), ..Plan::new(system, task) };
                Question { plan, units, machine: None }
            }
            Self::Machine(source, name) => {
                Question { plan: Plan::new(*source, task), units: Units::default(), machine: Some(name) }
            }
        };
        let question = Question { plan: Plan { tile, shard, ..question.plan }, ..question };
        question.plan.check()?;
        Ok(question)
    }
}

/// A range of what varies.
impl VariedNamed<Interval> {
    /// Its ends.
    pub(crate) const fn ends(&self) -> (f64, f64) {
        (self.1.0, self.1.1)
    }
}

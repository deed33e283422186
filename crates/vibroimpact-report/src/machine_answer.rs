//! A plan of a machine, its result, and everything that is reported of it: the JSON object, the table and the figure.

use crate::AnswerError;
use crate::figure::coloured;
use crate::{ReportError, Shown, Table, figure, table};
use vibroimpact::events::MachineStart;
use vibroimpact::machine::Machine;
use vibroimpact::orbit::MachineCycle;
use vibroimpact::verdict::MachineVerdict;
use vibroimpact_plot::Figure;
use vibroimpact_study::machine::MachineSource;
use vibroimpact_study::{
    Control, MachineBranchPlan, MachineDiagram, MachinePlan, MachineResults, MachineTask, run_machine,
};

/// The largest number of characters of a title over an axis of ordinary width.
const TITLE: usize = 45;

/// A plan of a machine and its result. Its [`Serialize`](serde::Serialize) form is the JSON object that the command
/// prints with `--json`.
#[derive(Clone, Debug)]
pub struct MachineAnswer {
    /// The name under which the machine was asked for.
    pub name: String,
    /// The plan.
    pub plan: MachinePlan,
    /// The machine of the plan.
    pub machine: Machine,
    /// The start of the plan, with a number for each coordinate and velocity.
    pub start: MachineStart,
    /// The result.
    pub results: MachineResults,
}

/// Runs a plan of a machine, like [`run_machine`].
///
/// # Errors
/// [`AnswerError`] for an invalid plan, or when stopped.
pub fn machine_answer(name: &str, plan: &MachinePlan, control: &Control<'_>) -> Result<MachineAnswer, AnswerError> {
    let results = run_machine(plan, control)?;
    let (machine, start) = plan.described()?;
    Ok(MachineAnswer { name: name.to_owned(), plan: plan.clone(), machine, start, results })
}

/// The title of a figure of ordinary width: that of the machine file. A long title is cut at its first colon, or replaced
/// by `name`.
pub(crate) fn machine_title(machine: &MachineSource, name: &str) -> String {
    let title = machine.title.as_deref().unwrap_or(name);
    let part = title.split_once(": ").map_or(title, |(part, _)| part);
    let fits = [title, part, name].into_iter().find(|text| text.chars().count() <= TITLE);
    vibroimpact_plot::plain(fits.unwrap_or(name))
}

impl MachineAnswer {
    /// The line that the command prints with `--json`, without the line break.
    #[must_use]
    pub fn json(&self) -> String {
        // texts and numbers can always be written as JSON
        serde_json::to_string(self).unwrap_or_default()
    }

    /// The title of a figure: that of the machine file, or the name.
    #[must_use]
    pub fn title(&self) -> String {
        self.plan.machine.title.clone().unwrap_or_else(|| self.name.clone())
    }

    /// The figure that the command draws with `--plot`, that of a map or basin in the colours of a quantity, if one is given;
    /// `None` for a task without one. The orbit diagram behind a branch is computed here.
    ///
    /// # Errors
    /// [`AnswerError`] for a result that cannot be drawn, or when stopped.
    pub fn figure(&self, shown: &Shown, control: &Control<'_>) -> Result<Option<Figure>, AnswerError> {
        let title = machine_title(&self.plan.machine, &self.name);
        if let Some(colour) = &shown.colour {
            return Ok(Some(match &self.results {
                MachineResults::Basin(found) => coloured::of_machine_basin(found, colour, title)?,
                MachineResults::Map(found) => coloured::of_machine_map(found, colour, title)?,
                _ => return Err(ReportError::NoColours.into()),
            }));
        }
        Ok(Some(match &self.results {
            MachineResults::Simulate(found) => {
                let title = vibroimpact_plot::plain(&self.title());
                figure::machine_waveform::figure(&self.machine, &self.start, found, title)?
            }
            MachineResults::Settle(found) => {
                let MachineVerdict::Periodic(cycle) = &found.verdict else {
                    return Err(ReportError::NoCycle(figure::label(&found.verdict.label())).into());
                };
                self.one_period(cycle, &title)?
            }
            MachineResults::Branch(found) => {
                let MachineTask::Branch(plan) = &self.plan.task else { return Ok(None) };
                let behind = if shown.diagram { self.behind(plan, control)? } else { None };
                figure::branch::of_machine(found, &plan.cut(&self.plan.machine)?, behind.as_ref(), title)
            }
            MachineResults::Curve(found) => {
                let MachineTask::Curve(plan) = &self.plan.task else { return Ok(None) };
                figure::curve::of_machine(found, plan, title)
            }
            MachineResults::Basin(found) => figure::basin::of_machine(found, title)?,
            MachineResults::Map(found) => figure::map::of_machine(found, title)?,
            MachineResults::Diagram(found) => figure::diagram::of_machine(found, title)?,
            MachineResults::Lyapunov(found, Some(points)) => {
                let label = figure::label(&found.motion.label());
                figure::machine_section::figure(points, &self.machine, format!("{title}: {label}"))
            }
            MachineResults::Attractors(_) | MachineResults::Lyapunov(..) | MachineResults::Orbit(_) => return Ok(None),
        }))
    }

    /// The orbit diagram over the range of a branch; `None` if there is no machine at one end, where no branch can come either.
    fn behind(&self, plan: &MachineBranchPlan, control: &Control<'_>) -> Result<Option<MachineDiagram>, AnswerError> {
        let task = MachineTask::Diagram(plan.diagram(&self.plan.machine)?);
        let plan = MachinePlan { task, ..self.plan.clone() };
        if plan.check().is_err() {
            return Ok(None);
        }
        let found = run_machine(&plan, control)?;
        Ok(if let MachineResults::Diagram(found) = found { Some(found) } else { None })
    }

    /// The waveform of one period of a cycle.
    fn one_period(&self, cycle: &MachineCycle, title: &str) -> Result<Figure, AnswerError> {
        let forced = cycle.label.periods > 0;
        let periods = forced.then(|| f64::from(cycle.label.periods));
        // without forcing, to the first event after the period
        let impacts = if forced { None } else { Some(cycle.events.len() as u64 + 1) };
        let task = MachineTask::Simulate { impacts, periods };
        let plan = MachinePlan { task, ..self.plan.clone() }.starting(&cycle.state);
        let MachineResults::Simulate(mut found) = run_machine(&plan, &Control::default())? else {
            return Err(ReportError::NoCycle(cycle.label.to_string()).into()); // the task of the plan is to simulate
        };
        if !forced {
            found.events.retain(|event| event.time <= cycle.period);
            found.shown_until = cycle.period;
        }
        let title = format!("{title}: {}", figure::label(&cycle.label.to_string()));
        Ok(figure::machine_waveform::figure(&self.machine, &cycle.state, &found, title)?)
    }

    /// The table that the command writes with `--csv`; `None` for a task without one. Points of a waveform are a hundredth of
    /// the forcing period apart by default, or a thousandth of the whole time without forcing.
    ///
    /// # Errors
    /// [`AnswerError`] for a result that cannot be tabulated.
    pub fn table(&self, shown: &Shown) -> Result<Option<Table<'_>>, AnswerError> {
        Ok(Some(match &self.results {
            MachineResults::Simulate(found) => {
                let until = found.shown_until;
                let step = shown.step.unwrap_or_else(|| self.machine.period().unwrap_or(0.1 * until) / 100.0);
                table::machine_waveform::table(&self.machine, &self.start, (until, step))?
            }
            MachineResults::Attractors(census) => table::machine_tables::attractors(&self.machine, census),
            MachineResults::Branch(found) => {
                let MachineTask::Branch(plan) = &self.plan.task else { return Ok(None) };
                table::machine_branch::table(&self.machine, &plan.cut(&self.plan.machine)?, found)
            }
            MachineResults::Curve(found) => {
                let MachineTask::Curve(plan) = &self.plan.task else { return Ok(None) };
                table::machine_curve::table(&self.machine, plan, found)
            }
            MachineResults::Basin(found) => table::machine_tables::basin(found),
            MachineResults::Map(found) => table::machine_tables::map(found),
            MachineResults::Diagram(found) => table::diagram::of_machine(found, &self.machine),
            MachineResults::Lyapunov(_, Some(points)) => table::machine_section::table(&self.machine, points),
            MachineResults::Settle(_) | MachineResults::Orbit(_) | MachineResults::Lyapunov(..) => return Ok(None),
        }))
    }
}

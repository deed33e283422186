//! The answer to a plan of a machine.

use crate::AnswerError;
use crate::answer::Shown;
use crate::figure::branch::Picture;
use crate::figure::overlay::Overlay;
use crate::figure::{coloured, tracks};
use crate::json::branch::BranchAnswer;
use crate::json::curve::CurveAnswer;
use crate::json::orbit::OrbitAnswer;
use crate::response::ResponseView;
use crate::scene::{self, View};
use crate::{ReportError, Table, Units, figure, table};
use vibroimpact::continuation::machine::{CurvePoint, SolutionPoint};
use vibroimpact::events::{Limits, Motion, Start};
use vibroimpact::machine::Machine;
use vibroimpact::orbit::machine::Cycle;
use vibroimpact::verdict::{CountedMotion, Verdict};
use vibroimpact_plot::{Figure, plain};
use vibroimpact_study::machine::MachineSource;
use vibroimpact_study::{
    Branches, Control, CurvePlan, Cut, Diagram, EventCurve, Plan, PlanError, PointsPlan, RegionPlan, ResponseCurves,
    Results, Simulated, Task, machine, run,
};

/// The largest number of characters of a title over an axis of ordinary width.
const TITLE: usize = 45;

/// The number of forcing periods that are shown of a settled motion that is no cycle.
const PERIODS: f64 = 24.0;
/// The largest number of events in the waveform of a settled motion.
const MOST_EVENTS: usize = 200_000;

/// A plan of a machine and its result.
#[derive(Clone, Debug)]
pub struct Answer {
    /// The name under which the machine was asked for.
    pub name: String,
    /// The plan.
    pub plan: Plan,
    /// The machine of the plan as it is written.
    pub source: MachineSource,
    /// The machine of the plan.
    pub machine: Machine,
    /// The start of the plan, with a number for each coordinate and velocity.
    pub start: Start,
    /// The result.
    pub results: machine::Results,
}

/// The title of a figure of ordinary width: that of the machine file. A long title is cut at its first colon, or replaced
/// by `name`.
pub(crate) fn machine_title(machine: &MachineSource, name: &str) -> String {
    let title = machine.title.as_deref().unwrap_or(name);
    let part = title.split_once(": ").map_or(title, |(part, _)| part);
    let fits = [title, part, name].into_iter().find(|text| text.chars().count() <= TITLE);
    plain(fits.unwrap_or(name))
}

impl Answer {
    /// The title of a figure: that of the machine file, or the name.
    #[must_use]
    pub fn title(&self) -> String {
        self.source.title.clone().unwrap_or_else(|| self.name.clone())
    }

    /// As [`Answer::figure`](super::Answer::figure).
    ///
    /// # Errors
    /// [`AnswerError`] for a result that cannot be drawn, or when stopped.
    pub fn figure(&self, shown: &Shown, control: &Control<'_>) -> Result<Option<Figure>, AnswerError> {
        let title = machine_title(&self.source, &self.name);
        if let Some(colour) = &shown.colour {
            return Ok(Some(match &self.results {
                machine::Results::Basin(found) => coloured::of_basin(found, colour, &Units::default(), title)?,
                machine::Results::Map(found) => coloured::of_map(found, colour, &Units::default(), title)?,
                _ => return Err(ReportError::NoColours.into()),
            }));
        }
        Ok(Some(match &self.results {
            machine::Results::Simulate(found) => {
                let title = plain(&self.title());
                figure::machine_waveform::figure(&self.machine, &self.start, found, title)?
            }
            machine::Results::Settle(found) => {
                let (from, time) = self.steady(&found.verdict)?;
                let title = format!("{title}: {}", figure::label(&found.verdict.label()));
                match (shown.view.unwrap_or_default(), &found.verdict) {
                    (View::Waveform, _) => self.waveform(&from, time, title)?,
                    (View::Phase, _) => scene::machine_portrait(&self.machine, (&from, time), title)?,
                    (View::Multipliers, Verdict::Periodic(cycle)) => {
                        scene::multipliers(&cycle.multipliers, &cycle.stabilities()).title(title)
                    }
                    (View::Multipliers, other) => {
                        return Err(ReportError::NoMultipliers(other.label().into_owned()).into());
                    }
                    (View::Sections, _) => return Err(ReportError::MachineSections.into()),
                }
            }
            machine::Results::Branch(found) => {
                let answer = self.branches(found)?;
                let path = answer.quantity.as_deref();
                let behind = if shown.diagram { self.behind(path, control)? } else { None };
                let picture = Picture {
                    cut: &self.cut()?,
                    units: &Units::default(),
                    shown: if path.is_some() { tracks::Shown::Quantity } else { tracks::Shown::Speeds },
                    ordinate: path.map_or_else(|| "speed of closing".to_owned(), plain),
                    behind: behind.as_ref(),
                    inadmissible: false,
                };
                figure::branch::figure(&answer.branches, &picture, title)?
            }
            machine::Results::Curve(found) => {
                figure::curve::figure(&self.curve(found)?, (&self.curve_plan()?, &Units::default()), title)
            }
            machine::Results::Region(found) => {
                let Task::Region(plan) = &self.plan.task else { return Ok(None) };
                let plan: RegionPlan<String> = plan.typed()?;
                figure::region::figure(found, &plan, (plan.neutral(&self.source), &Units::default()), title)
            }
            machine::Results::Response(found) => {
                let Some(view) = self.response(found) else { return Ok(None) };
                figure::response::figure(&view, title)
            }
            machine::Results::Basin(found) => figure::basin::figure(found, &Units::default(), title)?,
            machine::Results::Map(found) if found.axes.is_empty() => {
                let labels = found.points.iter().map(|motions| motions.first().map(|motion| (*motion.label).into()));
                let points = PointsPlan::Listed(found.columns.clone());
                figure::scattered::figure(&points, labels, &Units::default(), title)?
            }
            machine::Results::Map(found) => {
                figure::map::figure(found, &Units::default(), title, Overlay::default().cells())?
            }
            machine::Results::Diagram(found) => figure::diagram::figure(found, &Units::default(), title)?,
            machine::Results::Lyapunov(found, Some(points)) => {
                let label = figure::label(&found.motion.label());
                figure::section::of_machine(points, &self.machine, format!("{title}: {label}"))
            }
            machine::Results::Attractors(census) => {
                let share = |found: &CountedMotion<Machine>| (found.verdict.label().into_owned(), census.share(found));
                figure::bars::shares(&census.by_share().into_iter().map(share).collect::<Vec<_>>(), title)
            }
            machine::Results::Margins(found) => {
                let label = figure::label(&found.motion.label());
                figure::bars::margins(found, (&self.machine, &Units::default()), format!("{title}: {label}"))?
            }
            machine::Results::Lyapunov(..) => return Ok(None),
            machine::Results::Orbit(found) => {
                let answer = OrbitAnswer::of_machine(&self.machine, found);
                figure::orbits::figure(&answer, "speed of closing".to_owned(), title)
            }
        }))
    }

    /// The response as it is told; `None` if the plan is that of another task.
    #[must_use]
    pub fn response<'a>(&'a self, found: &'a ResponseCurves) -> Option<ResponseView<'a>> {
        let Task::Response(plan) = &self.plan.task else { return None };
        Some(ResponseView::of_machine(found, plan, &self.machine))
    }

    /// The line of its branches.
    ///
    /// # Errors
    /// [`PlanError`] for a number that the machine does not have, and for another task.
    pub fn cut(&self) -> Result<Cut<String>, PlanError> {
        let Task::Branch(plan) = &self.plan.task else { return Err(PlanError::NoLabel) };
        plan.typed::<String>()?.cut(&self.source)
    }

    /// The plan of its curve.
    ///
    /// # Errors
    /// As [`Self::cut`].
    pub fn curve_plan(&self) -> Result<CurvePlan<String>, PlanError> {
        if let Task::Curve(plan) = &self.plan.task { plan.typed() } else { Err(PlanError::NoLabel) }
    }

    /// The answer to `vibro branch`.
    ///
    /// # Errors
    /// As [`Self::cut`].
    pub fn branches<'a>(&'a self, found: &'a Branches<Cycle, SolutionPoint>) -> Result<BranchAnswer<'a>, PlanError> {
        Ok(BranchAnswer::of_machine(found, &self.cut()?, (&self.machine, &self.source)))
    }

    /// The answer to `vibro curve`.
    ///
    /// # Errors
    /// As [`Self::cut`].
    pub fn curve<'a>(
        &'a self,
        found: &'a EventCurve<Cycle, SolutionPoint, CurvePoint>,
    ) -> Result<CurveAnswer<'a>, PlanError> {
        Ok(CurveAnswer::of_machine(&self.machine, &self.curve_plan()?, found))
    }

    /// The orbit diagram over the range of a branch, of closings or of a quantity; `None` if there is no machine at one end,
    /// where no branch can come either.
    fn behind(
        &self,
        quantity: Option<&str>,
        control: &Control<'_>,
    ) -> Result<Option<Diagram<String, String>>, AnswerError> {
        let Task::Branch(plan) = &self.plan.task else { return Ok(None) };
        let mut diagram = plan.typed::<String>()?.diagram(&self.source)?;
        if let Some(path) = quantity {
            path.clone_into(&mut diagram.show);
        }
        let plan = Plan { task: diagram.into(), ..self.plan.clone() };
        if plan.check().is_err() {
            return Ok(None);
        }
        let found = run(&plan, control)?;
        Ok(if let Results::Machine(machine::Results::Diagram(found)) = found { Some(found) } else { None })
    }

    /// A state of a settled motion, and the time over which it is shown: one period of a cycle, [`PERIODS`] forcing periods of
    /// another motion.
    fn steady(&self, verdict: &Verdict<Machine>) -> Result<(Start, f64), ReportError> {
        let none = || ReportError::NoCycle(figure::label(&verdict.label()));
        let from = verdict.reached(&self.machine).ok_or_else(none)?;
        let time = match verdict {
            Verdict::Periodic(cycle) => cycle.period,
            _ => PERIODS * self.machine.period().ok_or_else(none)?,
        };
        Ok((from, time))
    }

    /// The waveform of a motion from a state over a time.
    fn waveform(&self, from: &Start, time: f64, title: String) -> Result<Figure, AnswerError> {
        let limits = Limits::default();
        let limits = Limits { time: limits.time.max(time), ..limits };
        let motion = Motion::new(&self.machine, from, limits);
        let motion = motion.map_err(|error| ReportError::Plan(PlanError::Machine(error.into())))?;
        let events = motion.take_while(|event| event.time <= time).take(MOST_EVENTS).collect();
        let found = Simulated { events, reason: "time_limit", time, horizon: None, shown_until: time };
        Ok(figure::machine_waveform::figure(&self.machine, from, &found, title)?)
    }

    /// As [`Answer::table`](super::Answer::table).
    ///
    /// # Errors
    /// [`AnswerError`] for a result that cannot be tabulated.
    pub fn table(&self, shown: &Shown) -> Result<Option<Table<'_>>, AnswerError> {
        Ok(Some(match &self.results {
            machine::Results::Simulate(found) => {
                let until = found.shown_until;
                let step = shown.step.unwrap_or_else(|| self.machine.period().unwrap_or(0.1 * until) / 100.0);
                table::waveform::of_machine(&self.machine, &self.start, (until, step))?
            }
            machine::Results::Settle(found) => match (shown.view.unwrap_or_default(), &found.verdict) {
                (View::Waveform | View::Phase, verdict) => {
                    let (from, time) = self.steady(verdict)?;
                    let step = self.machine.period().unwrap_or(time) / 100.0;
                    table::waveform::of_machine(&self.machine, &from, (time, step))?
                }
                (View::Multipliers, Verdict::Periodic(cycle)) => table::multipliers(&cycle.multipliers),
                (View::Multipliers, other) => return Err(ReportError::NoMultipliers(other.label().into_owned()).into()),
                (View::Sections, _) => return Err(ReportError::MachineSections.into()),
            },
            machine::Results::Attractors(census) => table::attractors::of_machine(&self.machine, census),
            machine::Results::Branch(found) => {
                table::branch::table(self.branches(found)?, Some(&self.machine), (&self.cut()?, &Units::default()))
            }
            machine::Results::Curve(found) => {
                let plan = (&self.curve_plan()?, &Units::default());
                table::curve::table(self.curve(found)?, Some(&self.machine), plan)
            }
            machine::Results::Margins(found) => table::margins::table(found, &self.machine, Units::default()),
            machine::Results::Region(found) => {
                let Task::Region(plan) = &self.plan.task else { return Ok(None) };
                table::region::table(found, &plan.typed::<String>()?, &Units::default())
            }
            machine::Results::Response(found) => {
                let Some(view) = self.response(found) else { return Ok(None) };
                table::response::table(view)
            }
            machine::Results::Basin(found) => table::basin::of_machine(&self.machine, found)?,
            machine::Results::Map(found) => table::map::table(found, &self.machine, (Units::default(), true))?,
            machine::Results::Diagram(found) => table::diagram::table(found, &self.machine, Units::default())?,
            machine::Results::Lyapunov(_, Some(points)) => table::section::of_machine(&self.machine, points),
            machine::Results::Orbit(found) => {
                let answer = OrbitAnswer::of_machine(&self.machine, found);
                table::orbits::table(answer, Some(&self.machine), &Units::default())
            }
            machine::Results::Lyapunov(..) => return Ok(None),
        }))
    }
}

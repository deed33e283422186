//! A plan, its result, and everything that is reported of it: the JSON object, the table and the figure.

mod machine;
mod oscillator;
mod told;

pub use told::Told;
pub(crate) use told::{BasinOf, BranchesOf, CurveOf};

use crate::figure::branch::Picture;
use crate::figure::coloured::{self, Coloured};
use crate::figure::overlay::Overlay;
use crate::figure::{self, tracks};
use crate::json::branch::BranchAnswer;
use crate::scene::View;
use crate::task::curve::CurveAnswer;
use crate::task::orbit::OrbitAnswer;
use crate::{AnswerError, ReportError, Table, Units, table, task, text};
use serde::Serialize;
use vibroimpact::math::Multiplier;
use vibroimpact::verdict::{CountedMotion, PaperRule, PaperVerdict, Verdict};
use vibroimpact_plot::{Figure, plain};
use vibroimpact_study::diagram::{Diagram, ShowText};
use vibroimpact_study::machine::MachineSource;
use vibroimpact_study::{
    Control, CurvePlan, Cut, CycleOf, Dynamics, Name, Orbit, Plan, PlanError, PlanResults, PointsPlan, RegionPlan,
    Results, System, SystemPlan, Task, run,
};

/// A plan and its result, in memory. Its [`Serialize`] form is the JSON object that the command prints with `--json`.
#[derive(Clone, Debug, Serialize)]
#[serde(untagged)]
pub enum Answer {
    /// Of an oscillator.
    Oscillator(Box<AnswerOf<SystemPlan>>),
    /// Of a machine.
    Machine(Box<AnswerOf<MachineSource>>),
}

/// The answer for one kind of system.
#[derive(Clone, Debug)]
pub struct AnswerOf<D: Dynamics> {
    /// The plan, [complete](Plan::complete).
    pub plan: Plan,
    /// The name under which a machine was asked for.
    pub name: String,
    /// The system as it is written in the plan.
    pub written: D,
    /// The system; for a plane, that of the first corner.
    pub system: D::System,
    /// The start of the task, or of the machine, with a number for each coordinate and velocity.
    pub start: D::Start,
    /// The units of all reported values; those of a machine are those of its numbers.
    pub units: Units,
    /// The result.
    pub results: Results<D>,
    /// The verdict of the rule of the 1971 paper on a settled motion of an oscillator, if requested.
    pub paper_rule: Option<(PaperRule, PaperVerdict)>,
}

/// Options for the figure and the table of an answer.
#[derive(Clone, Debug)]
pub struct Shown {
    /// The view of a settled motion, a simulated motion or an attractor.
    pub view: Option<View>,
    /// Time between the points of a simulated waveform. Default: a hundredth of the forcing period; of a machine without
    /// forcing, a thousandth of the whole time.
    pub step: Option<f64>,
    /// Whether to simulate the orbit diagram and to draw it behind a branch.
    pub diagram: bool,
    /// Whether to draw the inadmissible solutions of a branch.
    pub inadmissible: bool,
    /// The quantity whose values are the colours of a map or basin.
    pub colour: Option<Coloured>,
    /// The layers of a map, and a point and a line over it.
    pub overlay: Overlay,
}

impl Default for Shown {
    fn default() -> Self {
        Self { view: None, step: None, diagram: true, inadmissible: false, colour: None, overlay: Overlay::default() }
    }
}

/// Runs a plan in memory, like [`run`]. The units of the plan, if it has any, are those of the results; `units` are
/// those of a plan of an oscillator without units. A machine has the name of its title, or [another](Answer::named).
///
/// # Errors
/// [`AnswerError`] for an invalid plan, or when stopped.
pub fn answer(plan: &Plan, units: Units, control: &Control<'_>) -> Result<Answer, AnswerError> {
    let plan = plan.complete()?;
    let results = run(&plan, control)?;
    Ok(match &plan.system {
        System::Oscillator(system) => {
            let units = if plan.units.is_some() { Units::of_plan(&plan) } else { units };
            Answer::Oscillator(answer_of(*system, (&plan, "oscillator"), results, units)?)
        }
        System::Machine(machine) => {
            let name = machine.title.as_deref().unwrap_or("machine");
            Answer::Machine(answer_of((**machine).clone(), (&plan, name), results, Units::default())?)
        }
    })
}

fn answer_of<D: Dynamics>(
    written: D,
    (plan, name): (&Plan, &str),
    results: PlanResults,
    units: Units,
) -> Result<Box<AnswerOf<D>>, PlanError> {
    // a plan has no results of another system
    let results = D::own(results).ok_or(PlanError::OfOscillator)?;
    let setup = written.setup_of(&plan.task)?;
    let (system, start, plan, name) = (setup.system, setup.start, plan.clone(), name.to_owned());
    Ok(Box::new(AnswerOf { plan, name, written, system, start, units, results, paper_rule: None }))
}

impl Answer {
    /// The plan, [complete](Plan::complete).
    #[must_use]
    pub const fn plan(&self) -> &Plan {
        match self {
            Self::Oscillator(answer) => &answer.plan,
            Self::Machine(answer) => &answer.plan,
        }
    }

    /// The same, to be changed in what is shown of the results.
    pub const fn plan_mut(&mut self) -> &mut Plan {
        match self {
            Self::Oscillator(answer) => &mut answer.plan,
            Self::Machine(answer) => &mut answer.plan,
        }
    }

    /// The same; a machine has this name.
    #[must_use]
    pub fn named(mut self, name: &str) -> Self {
        if let Self::Machine(answer) = &mut self {
            name.clone_into(&mut answer.name);
        }
        self
    }

    /// The line that the command prints with `--json`, without the line break.
    #[must_use]
    pub fn json(&self) -> String {
        // texts and numbers can always be written as JSON
        serde_json::to_string(self).unwrap_or_default()
    }

    /// The same without what takes longest to compute: the harmonics and the transient of a settled motion.
    #[must_use]
    pub fn brief(&self) -> String {
        match self {
            Self::Oscillator(answer) => answer.brief(),
            Self::Machine(answer) => answer.brief(),
        }
    }

    /// The text that the command prints without `--json`.
    ///
    /// # Errors
    /// [`PlanError`] for a number that the system does not have.
    pub fn text(&self) -> Result<String, PlanError> {
        match self {
            Self::Oscillator(answer) => text::text_of(answer),
            Self::Machine(answer) => text::text_of(answer),
        }
    }

    /// The figure that the command draws with `--plot`. For a settled motion it shows the motion after the transient;
    /// for exponents it shows both sections, if points of them were requested. `None` for a view that the answer does not
    /// have. The orbit diagram behind a branch is computed here.
    ///
    /// # Errors
    /// [`AnswerError`] for a result that cannot be drawn, or when stopped.
    pub fn figure(&self, shown: &Shown, control: &Control<'_>) -> Result<Option<Figure>, AnswerError> {
        match self {
            Self::Oscillator(answer) => answer.figure(shown, control),
            Self::Machine(answer) => answer.figure(shown, control),
        }
    }

    /// The table that the command writes with `--csv`; for a simulation the waveform. `None` for
    /// exponents without points of their sections.
    ///
    /// # Errors
    /// [`AnswerError`] for a result that cannot be tabulated.
    pub fn table(&self, shown: &Shown) -> Result<Option<Table<'_>>, AnswerError> {
        match self {
            Self::Oscillator(answer) => answer.table(shown),
            Self::Machine(answer) => answer.table(shown),
        }
    }
}

/// The plan of another task than that of the results, which does not occur.
const OTHER: PlanError = PlanError::NoLabel;

type DiagramOf<D> = Diagram<<D as Dynamics>::Name, <D as Dynamics>::Shown>;

impl<D: Told> AnswerOf<D> {
    /// As [`Answer::figure`].
    pub(crate) fn figure(&self, shown: &Shown, control: &Control<'_>) -> Result<Option<Figure>, AnswerError> {
        let mut figure = self.plain_figure(shown, control)?;
        if let Some(figure) = &mut figure {
            shown.overlay.add(figure, &self.plan, control)?;
        }
        Ok(figure)
    }

    /// The figure without what lies over it.
    fn plain_figure(&self, shown: &Shown, control: &Control<'_>) -> Result<Option<Figure>, AnswerError> {
        let (units, view) = (&self.units, shown.view.unwrap_or_default());
        let title = |varied: &[&str]| self.written.title(&self.name, units, varied);
        let of_axes = |axes: &[vibroimpact_study::Axis<D::Coordinate>]| {
            title(&axes.iter().map(|axis| axis.vary.text()).collect::<Vec<_>>())
        };
        if let Some(colour) = &shown.colour {
            return Ok(Some(match &self.results {
                Results::Map(found) => coloured::of_map(found, colour, units, of_axes(&found.axes))?,
                Results::Basin(found) => coloured::of_basin(found, colour, units, title(&[]))?,
                _ => return Err(ReportError::NoColours.into()),
            }));
        }
        Ok(Some(match &self.results {
            Results::Settle(found) => D::settled_figure(self, found, view)?,
            Results::Simulate(found) => return Ok(D::simulated_figure(self, found, view)?),
            Results::Lyapunov(found, Some(points)) if matches!(view, View::Waveform | View::Sections) => {
                D::section_figure(self, found, points)
            }
            _ if view != View::Waveform => return Ok(None),
            Results::Lyapunov(..) => return Ok(None),
            Results::Orbit(found) => {
                let [speed, _] = D::speeds(self);
                task::orbit::figure(&self.orbits(found), speed, title(&[]))
            }
            Results::Basin(found) => figure::basin::figure(found, units, title(&[]))?,
            Results::Map(found) if found.axes.is_empty() => {
                let labels = found.points.iter().map(|motions| motions.first().map(|motion| (*motion.label).into()));
                figure::scattered::figure(&PointsPlan::Listed(found.columns.clone()), labels, units, title(&[]))?
            }
            Results::Map(found) => figure::map::figure(found, units, of_axes(&found.axes), shown.overlay.cells())?,
            Results::Diagram(found) => {
                let cut = found.plan.cut();
                let varied: Vec<&str> = cut.names().map(Name::text).collect();
                figure::diagram::figure(found, units, title(&varied))?
            }
            Results::Response(found) => {
                let Task::Response(task) = &self.plan.task else { return Err(OTHER.into()) };
                figure::response::figure(&D::response(self, found)?, title(&[task.vary.text()]))
            }
            Results::Branch(found) => {
                let (answer, cut) = (self.branches(found)?, self.cut()?);
                let quantity = answer.quantity.as_deref();
                let behind = if shown.diagram { self.behind(quantity, control)? } else { None };
                let [_, speed] = D::speeds(self);
                let picture = Picture {
                    cut: &cut,
                    units,
                    shown: if quantity.is_some() { tracks::Shown::Quantity } else { tracks::Shown::Speeds },
                    ordinate: quantity.map_or(speed, plain),
                    behind: behind.as_ref(),
                    inadmissible: shown.inadmissible,
                };
                let varied: Vec<&str> = cut.names().map(Name::text).collect();
                figure::branch::figure(&answer.branches, &picture, title(&varied))?
            }
            Results::Curve(found) => {
                let plan = self.curve_plan()?;
                let title = title(&[plan.vary.parameter.text(), plan.and.parameter.text()]);
                figure::curve::figure(&self.curve(found)?, (&plan, units), title)
            }
            Results::Region(found) => {
                let plan = self.region_plan()?;
                let title = title(&[plan.across.parameter.text(), plan.up.parameter.text()]);
                figure::region::figure(found, &plan, (plan.neutral(&self.written), units), title)
            }
            Results::Attractors(census) => {
                let share =
                    |found: &CountedMotion<D::System>| (found.verdict.label().into_owned(), census.share(found));
                figure::bars::shares(&census.by_share().into_iter().map(share).collect::<Vec<_>>(), title(&[]))
            }
            Results::Edge(found) => task::edge::figure(self, found, &title(&[])),
            Results::Margins(found) => {
                let varied: Vec<&str> = found.parameters.iter().map(|of| of.scope.parameter.text()).collect();
                let title = [title(&varied), figure::label(&found.motion.label())].join(": ");
                let title = title.trim_start_matches(": ").to_owned();
                figure::bars::margins(found, (&self.system, units), title)?
            }
        }))
    }

    /// The orbit diagram over the range of a branch, of closings or of a quantity; `None` if there is no machine at one end,
    /// where no branch can come either.
    fn behind(&self, quantity: Option<&str>, control: &Control<'_>) -> Result<Option<DiagramOf<D>>, AnswerError> {
        let Task::Branch(plan) = &self.plan.task else { return Ok(None) };
        let mut diagram = plan.typed::<D::Name>()?.diagram(&self.written)?;
        if let Some(path) = quantity {
            diagram.show = D::Shown::try_from(&ShowText::Word(path.to_owned()))?;
        }
        let plan = Plan { task: diagram.into(), ..self.plan.clone() };
        if plan.check().is_err() {
            return Ok(None);
        }
        let found = D::own(run(&plan, control)?);
        Ok(if let Some(Results::Diagram(found)) = found { Some(found) } else { None })
    }

    /// The multipliers of a settled motion.
    fn multipliers(&self, verdict: &Verdict<D::System>) -> Result<Vec<Multiplier>, ReportError> {
        let all = D::multipliers(self, verdict);
        if all.is_empty() { Err(ReportError::NoMultipliers(verdict.label().into_owned())) } else { Ok(all) }
    }

    /// The line of its branches.
    pub(crate) fn cut(&self) -> Result<Cut<D::Name>, PlanError> {
        let Task::Branch(plan) = &self.plan.task else { return Err(OTHER) };
        plan.typed::<D::Name>()?.cut(&self.written)
    }

    /// The plan of its curve.
    pub(crate) fn curve_plan(&self) -> Result<CurvePlan<D::Name>, PlanError> {
        if let Task::Curve(plan) = &self.plan.task { plan.typed() } else { Err(OTHER) }
    }

    /// The plan of its regions.
    pub(crate) fn region_plan(&self) -> Result<RegionPlan<D::Name>, PlanError> {
        if let Task::Region(plan) = &self.plan.task { plan.typed() } else { Err(OTHER) }
    }

    /// The answer to `vibro branch`.
    pub(crate) fn branches<'a>(&'a self, found: &'a BranchesOf<D>) -> Result<BranchAnswer<'a>, PlanError> {
        let cut = self.cut()?;
        Ok(BranchAnswer::new(self, found, &cut, D::shown_on_branches(self, found, &cut).as_ref()))
    }

    /// The same without quantities of its points, for the text.
    pub(crate) fn branches_in_words<'a>(&'a self, found: &'a BranchesOf<D>) -> Result<BranchAnswer<'a>, PlanError> {
        Ok(BranchAnswer::new(self, found, &self.cut()?, None))
    }

    /// The answer to `vibro curve`.
    pub(crate) fn curve<'a>(&'a self, found: &'a CurveOf<D>) -> Result<CurveAnswer<'a>, PlanError> {
        Ok(CurveAnswer::new(self, found, &self.curve_plan()?))
    }

    /// The answer to `vibro orbit`.
    pub(crate) fn orbits<'a>(&'a self, found: &'a [Orbit<CycleOf<D>>]) -> OrbitAnswer<'a> {
        OrbitAnswer { orbits: found.iter().map(|orbit| D::orbit(self, orbit)).collect() }
    }

    /// As [`Answer::table`].
    pub(crate) fn table(&self, shown: &Shown) -> Result<Option<Table<'_>>, AnswerError> {
        let (units, view, machine) = (&self.units, shown.view.unwrap_or_default(), D::machine(self));
        Ok(Some(match &self.results {
            Results::Simulate(found) => {
                let until = found.shown_until;
                let step = shown.step.unwrap_or_else(|| D::period(self).unwrap_or(0.1 * until) / 100.0);
                D::waveform_table(self, &self.start, (until, step))?
            }
            Results::Settle(found) if view == View::Multipliers => {
                table::multipliers(self.multipliers(&found.verdict)?)
            }
            Results::Settle(found) => D::settled_table(self, found, view)?,
            Results::Attractors(found) => task::attractors::table(self, found),
            Results::Orbit(found) => task::orbit::table(self.orbits(found), machine, units),
            Results::Basin(found) => task::basin::table(self, found)?,
            Results::Map(found) => task::map::table(found, &self.system, (*units, machine.is_some()))?,
            Results::Diagram(found) => task::diagram::table(found, &self.system, *units)?,
            Results::Lyapunov(_, Some(points)) => {
                task::lyapunov::table(points, &self.system, &D::names(self), self.units)
            }
            Results::Lyapunov(..) => return Ok(None),
            Results::Branch(found) => table::cycles::branches(self.branches(found)?, machine, (&self.cut()?, units)),
            Results::Curve(found) => task::curve::table(self.curve(found)?, machine, (&self.curve_plan()?, units)),
            Results::Region(found) => task::region::table(found, &self.region_plan()?, units),
            Results::Response(found) => task::response::table(D::response(self, found)?),
            Results::Edge(found) => task::edge::table(self, found),
            Results::Margins(found) => task::margins::table(found, &self.system, *units),
        }))
    }
}

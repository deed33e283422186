//! What is told of the answers of a machine.

use super::AnswerOf;
use super::told::{BranchesOf, Told};
use crate::json::branch::{self, Along, EventOf};
use crate::json::event::StateObject;
use crate::json::motion::MotionObject;
use crate::json::system::SystemObject;
use crate::scene::{self, View};
use crate::table::Remark;
use crate::task::curve;
use crate::task::orbit::OrbitObject;
use crate::task::response::ResponseView;
use crate::task::simulate::Events;
use crate::{AnswerError, BranchQuantity, ReportError, Table, Units, figure, table};
use vibroimpact::chaos::Exponents;
use vibroimpact::continuation::machine::{CurvePoint, SolutionPoint};
use vibroimpact::events::{Event, Motion, Start};
use vibroimpact::machine::Machine;
use vibroimpact::math::Multiplier;
use vibroimpact::orbit::machine::Cycle;
use vibroimpact::verdict::{Settled, Verdict};
use vibroimpact_plot::{Figure, plain};
use vibroimpact_study::machine::MachineSource;
use vibroimpact_study::{
    CurvePlan, Cut, Orbit, PlanError, ResponseCurves, SectionPoints, Simulated, Task, motion_limits,
};

/// The largest number of characters of a title over an axis of ordinary width.
const TITLE: usize = 45;

/// The number of forcing periods that are shown of a settled motion that is no cycle.
const PERIODS: f64 = 24.0;
/// The largest number of events in the waveform of a settled motion.
const MOST_EVENTS: usize = 200_000;

impl AnswerOf<MachineSource> {
    /// A state of a settled motion, and the time over which it is shown: one period of a cycle, [`PERIODS`] forcing periods of
    /// another motion.
    fn steady(&self, verdict: &Verdict<Machine>) -> Result<(Start, f64), ReportError> {
        let none = || ReportError::NoCycle(figure::label(&verdict.label()));
        let from = verdict.reached(&self.system).ok_or_else(none)?;
        let time = match verdict {
            Verdict::Periodic(cycle) => cycle.period,
            _ => PERIODS * self.system.period().ok_or_else(none)?,
        };
        Ok((from, time))
    }

    /// The title of the figure of a motion.
    fn title(&self, verdict: &Verdict<Machine>) -> String {
        format!("{}: {}", self.written.title(&self.name, &self.units, &[]), figure::label(&verdict.label()))
    }

    /// The waveform of a motion from a state over a time.
    fn waveform(&self, from: &Start, time: f64, title: String) -> Result<Figure, AnswerError> {
        let motion = Motion::new(&self.system, from, motion_limits(&self.system, time));
        let motion = motion.map_err(|error| ReportError::Plan(PlanError::Machine(error.into())))?;
        let events = motion.take_while(|event| event.time <= time).take(MOST_EVENTS).collect();
        let found = Simulated { events, reason: "time_limit", time, until: time, horizon: None, shown_until: time };
        Ok(figure::machine_waveform::figure(&self.system, from, &found, title)?)
    }
}

impl Told for MachineSource {
    fn machine(of: &AnswerOf<Self>) -> Option<&Machine> {
        Some(&of.system)
    }

    fn system(of: &AnswerOf<Self>) -> SystemObject<'_> {
        SystemObject::of_machine(&of.name, &of.system)
    }

    fn state(of: &AnswerOf<Self>) -> StateObject<'_> {
        StateObject::of(&of.system, &of.start)
    }

    fn numbers(_: &AnswerOf<Self>, start: &Start) -> (Vec<f64>, Vec<f64>) {
        (start.q.clone(), start.qdot.clone())
    }

    fn names(of: &AnswerOf<Self>) -> (Vec<String>, Vec<String>) {
        let all = &of.system.parts().coordinates;
        (all.iter().map(|name| format!("q.{name}")).collect(), all.iter().map(|name| format!("qdot.{name}")).collect())
    }

    fn motion<'a>(of: &'a AnswerOf<Self>, verdict: &'a Verdict<Machine>) -> MotionObject<'a> {
        MotionObject::of_machine(&of.system, verdict)
    }

    fn multipliers(_: &AnswerOf<Self>, verdict: &Verdict<Machine>) -> Vec<Multiplier> {
        Self::cycle_of_machine(verdict).map_or_else(Vec::new, |cycle| cycle.multipliers.clone())
    }

    fn cycle_of_machine(verdict: &Verdict<Machine>) -> Option<&Cycle> {
        if let Verdict::Periodic(cycle) = verdict { Some(cycle) } else { None }
    }

    fn remark(verdict: &Verdict<Machine>) -> Remark {
        (verdict.closed(), verdict.seen_events())
    }

    fn orbit<'a>(of: &'a AnswerOf<Self>, orbit: &'a Orbit<Cycle>) -> OrbitObject<'a> {
        OrbitObject::of_machine(&of.system, &orbit.cycle)
    }

    fn events<'a>(of: &'a AnswerOf<Self>, found: &'a Simulated<Event>) -> Events<'a> {
        Events::Machine((&of.system, &of.start), found.until, found.events.len())
    }

    fn shown_on_branches(of: &AnswerOf<Self>, found: &BranchesOf<Self>, cut: &Cut<String>) -> Option<String> {
        BranchQuantity::of(&of.system, &of.written, cut, found).map(|quantity| quantity.path)
    }

    fn branch_point<'a>(
        (written, machine, _): Along<'a, Self>,
        point: &'a SolutionPoint,
        cut: &Cut<String>,
        show: Option<&String>,
    ) -> (branch::PointObject<'a>, EventOf<'a>) {
        let quantity = show.map(|path| BranchQuantity::at_path(path.clone(), written, cut));
        (branch::PointObject::of_machine(point, machine, cut, quantity.as_ref()), EventOf::Machine(machine))
    }

    fn curve_point<'a>(of: &'a AnswerOf<Self>, point: &'a CurvePoint, _: &CurvePlan<String>) -> curve::PointObject<'a> {
        curve::PointObject::of_machine(&of.system, point)
    }

    fn response<'a>(of: &'a AnswerOf<Self>, found: &'a ResponseCurves) -> Result<ResponseView<'a>, PlanError> {
        let Task::Response(plan) = &of.plan.task else { return Err(PlanError::NoLabel) };
        Ok(ResponseView::of_machine(found, plan, &of.system))
    }

    /// That of the machine file. A long title is cut at its first colon, or replaced by `name`.
    fn title(&self, name: &str, _: &Units, _: &[&str]) -> String {
        let title = self.title.as_deref().unwrap_or(name);
        let part = title.split_once(": ").map_or(title, |(part, _)| part);
        let fits = [title, part, name].into_iter().find(|text| text.chars().count() <= TITLE);
        plain(fits.unwrap_or(name))
    }

    fn speeds(_: &AnswerOf<Self>) -> [String; 2] {
        ["speed of closing".to_owned(), "speed of closing".to_owned()]
    }

    fn simulated_figure(
        of: &AnswerOf<Self>,
        found: &Simulated<Event>,
        view: View,
    ) -> Result<Option<Figure>, ReportError> {
        let title = plain(of.written.title.as_deref().unwrap_or(&of.name));
        Ok(match view {
            View::Phase => Some(scene::machine_portrait(&of.system, (&of.start, found.shown_until), title)?),
            View::Waveform => Some(figure::machine_waveform::figure(&of.system, &of.start, found, title)?),
            View::Multipliers | View::Sections => None,
        })
    }

    fn settled_figure(of: &AnswerOf<Self>, found: &Settled<Machine>, view: View) -> Result<Figure, AnswerError> {
        let (from, time) = of.steady(&found.verdict)?;
        let title = of.title(&found.verdict);
        Ok(match (view, &found.verdict) {
            (View::Waveform, _) => of.waveform(&from, time, title)?,
            (View::Phase, _) => scene::machine_portrait(&of.system, (&from, time), title)?,
            (View::Multipliers, Verdict::Periodic(cycle)) => {
                scene::multipliers(&cycle.multipliers, &cycle.stabilities()).title(title)
            }
            (View::Multipliers, other) => return Err(ReportError::NoMultipliers(other.label().into_owned()).into()),
            (View::Sections, _) => return Err(ReportError::MachineSections.into()),
        })
    }

    fn section_figure(of: &AnswerOf<Self>, found: &Exponents<Machine>, points: &SectionPoints) -> Figure {
        figure::section::of_machine(points, &of.system, of.title(&found.motion))
    }

    fn waveform_table<'a>(of: &'a AnswerOf<Self>, from: &Start, span: (f64, f64)) -> Result<Table<'a>, ReportError> {
        table::waveform::of_machine(&of.system, from, span)
    }

    fn settled_table<'a>(
        of: &'a AnswerOf<Self>,
        found: &'a Settled<Machine>,
        view: View,
    ) -> Result<Table<'a>, ReportError> {
        if view == View::Sections {
            return Err(ReportError::MachineSections);
        }
        let (from, time) = of.steady(&found.verdict)?;
        let step = of.system.period().unwrap_or(time) / 100.0;
        Self::waveform_table(of, &from, (time, step))
    }
}

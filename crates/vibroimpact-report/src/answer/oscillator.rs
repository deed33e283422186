//! The answer to a plan of an oscillator.

use crate::answer::Shown;
use crate::figure::branch::Picture;
use crate::figure::plane::varied;
use crate::figure::{self, coloured, title, tracks};
use crate::json::branch::BranchAnswer;
use crate::json::curve::CurveAnswer;
use crate::json::orbit::OrbitAnswer;
use crate::response::ResponseView;
use crate::scene::{View, Viewed, phase_portrait};
use crate::{AnswerError, Asked, ReportError, ShownValue as _, Table, table};
use vibroimpact::Oscillator;
use vibroimpact::verdict::{CountedMotion, PaperRule, PaperVerdict};
use vibroimpact_plot::Figure;
use vibroimpact_study::diagram::Show;
use vibroimpact_study::{
    BranchPlan, Branches, Control, CurvePlan, Cut, EventCurve, Name, Parameter, Plan, PlanError, RegionPlan, Results,
    Task, run,
};

/// A plan of an oscillator and its result.
#[derive(Clone, Debug)]
pub struct Answer {
    /// The plan, [complete](Plan::complete).
    pub plan: Plan,
    /// The system, and the units of all reported values.
    pub asked: Asked,
    /// The oscillator; for a plane, that of the first corner.
    pub osc: Oscillator,
    /// The result.
    pub results: Results,
    /// The verdict of the rule of the 1971 paper on a settled motion, if requested.
    pub paper_rule: Option<(PaperRule, PaperVerdict)>,
}

impl Answer {
    /// The JSON object without what takes longest to compute: the harmonics and the transient of a settled motion.
    #[must_use]
    pub fn brief(&self) -> String {
        // texts and numbers can always be written as JSON
        let brief = self.brief_document().map(|object| serde_json::to_string(&object));
        brief.unwrap_or_else(|| serde_json::to_string(self)).unwrap_or_default()
    }

    /// As [`Answer::figure`](super::Answer::figure).
    ///
    /// # Errors
    /// [`AnswerError`] for a result that cannot be drawn, or when stopped.
    pub fn figure(&self, shown: &Shown, control: &Control<'_>) -> Result<Option<Figure>, AnswerError> {
        let mut figure = self.plain_figure(shown, control)?;
        if let Some(figure) = &mut figure {
            shown.overlay.add(figure, &self.plan, control)?;
        }
        Ok(figure)
    }

    /// The figure without what lies over it.
    fn plain_figure(&self, shown: &Shown, control: &Control<'_>) -> Result<Option<Figure>, AnswerError> {
        let Self { asked, osc, plan, .. } = self;
        let default = shown.view.is_none_or(|view| view == View::Waveform);
        if let Some(colour) = &shown.colour {
            return Ok(Some(match &self.results {
                Results::Map(found) => {
                    let title = figure::title_without(asked, &varied(&found.axes));
                    coloured::of_map(found, colour, &asked.units, title)?
                }
                Results::Basin(found) => coloured::of_basin(found, colour, &asked.units, title(asked))?,
                _ => return Err(ReportError::NoColours.into()),
            }));
        }
        Ok(Some(match (&plan.task, &self.results) {
            (_, Results::Settle(start, found)) => {
                Viewed::new(shown.view.unwrap_or_default(), (osc, *start), found, asked)?.figure()
            }
            (_, Results::Simulate(start, found)) if shown.view == Some(View::Phase) => {
                phase_portrait(asked, osc, *start, (0.0, found.shown_until))
            }
            (_, Results::Lyapunov(_, _, Some(points))) if default || shown.view == Some(View::Sections) => {
                figure::section::figure(points, osc, asked)
            }
            _ if !default => return Ok(None),
            (_, Results::Simulate(start, found)) => {
                let span = (0.0, found.shown_until);
                figure::waveform::figure(osc, *start, span, &asked.units, title(asked))
            }
            (_, Results::Orbit(found)) => {
                let ordinate = asked.units.named("speed before the impact", "m/s");
                figure::orbits::figure(&OrbitAnswer::of_oscillator(found, osc, &asked.units), ordinate, title(asked))
            }
            (_, Results::Basin(found)) => figure::basin::figure(found, &asked.units, title(asked))?,
            (_, Results::Map(found)) => {
                let title = figure::title_without(asked, &varied(&found.axes));
                figure::map::figure(found, &asked.units, title, shown.overlay.cells())?
            }
            (_, Results::Diagram(found)) => {
                let numbers: Vec<Parameter> = found.plan.cut().names().copied().collect();
                figure::diagram::figure(found, &asked.units, figure::title_without(asked, &numbers))?
            }
            (Task::Response(task), Results::Response(found)) => {
                let view = ResponseView::of_oscillator(found, task, &asked.units)?;
                let vary = Parameter::of(task.vary.text())?;
                figure::response::figure(&view, figure::title_without(asked, &[vary]))
            }
            (Task::Branch(task), Results::Branch(found)) => {
                let answer = self.branches(found)?;
                let task: BranchPlan = task.typed()?;
                let behind = if shown.diagram {
                    let plan = Plan::new(asked.system, task.diagram(&asked.system)?);
                    if let Results::Diagram(behind) = run(&plan, control)? { Some(behind) } else { None }
                } else {
                    None
                };
                let cut = task.cut(&asked.system)?;
                let picture = Picture {
                    cut: &cut,
                    units: &asked.units,
                    shown: tracks::Shown::Speeds,
                    ordinate: Show::Velocity.ordinate(&asked.units),
                    behind: behind.as_ref(),
                    inadmissible: shown.inadmissible,
                };
                let varied: Vec<Parameter> = cut.names().copied().collect();
                figure::branch::figure(&answer.branches, &picture, figure::title_without(asked, &varied))?
            }
            (_, Results::Curve(found)) => {
                let plan = self.curve_plan()?;
                let title = figure::title_without(asked, &[plan.vary.parameter, plan.and.parameter]);
                figure::curve::figure(&self.curve(found)?, (&plan, &asked.units), title)
            }
            (Task::Region(task), Results::Region(found)) => {
                let task: RegionPlan = task.typed()?;
                let title = figure::title_without(asked, &[task.across.parameter, task.up.parameter]);
                figure::region::figure(found, &task, (task.neutral(&asked.system), &asked.units), title)
            }
            (_, Results::Attractors(census)) => {
                let share = |found: &CountedMotion| (found.verdict.label().into_owned(), census.share(found));
                figure::bars::shares(&census.by_share().into_iter().map(share).collect::<Vec<_>>(), title(asked))
            }
            (_, Results::Margins(_, found)) => {
                let varied: Vec<Parameter> = found.parameters.iter().map(|of| of.scope.parameter).collect();
                let label = figure::label(&found.motion.label());
                let title = [figure::title_without(asked, &varied), label].join(": ");
                figure::bars::margins(found, (osc, &asked.units), title.trim_start_matches(": ").to_owned())?
            }
            _ => return Ok(None),
        }))
    }

    /// The line of its branches.
    ///
    /// # Errors
    /// [`PlanError`] for a parameter that the system does not have, and for another task.
    pub fn cut(&self) -> Result<Cut, PlanError> {
        let Task::Branch(plan) = &self.plan.task else { return Err(PlanError::NoLabel) };
        plan.typed::<Parameter>()?.cut(&self.asked.system)
    }

    /// The plan of its curve.
    ///
    /// # Errors
    /// As [`Self::cut`].
    pub fn curve_plan(&self) -> Result<CurvePlan, PlanError> {
        if let Task::Curve(plan) = &self.plan.task { plan.typed() } else { Err(PlanError::NoLabel) }
    }

    /// The answer to `vibro branch`.
    ///
    /// # Errors
    /// As [`Self::cut`].
    pub fn branches<'a>(&self, found: &'a Branches) -> Result<BranchAnswer<'a>, PlanError> {
        Ok(BranchAnswer::of_oscillator(found, &self.cut()?, &self.asked))
    }

    /// The answer to `vibro curve`.
    ///
    /// # Errors
    /// As [`Self::cut`].
    pub fn curve<'a>(&self, found: &'a EventCurve) -> Result<CurveAnswer<'a>, PlanError> {
        Ok(CurveAnswer::of_oscillator(found, &self.curve_plan()?, &self.asked))
    }

    /// As [`Answer::table`](super::Answer::table).
    ///
    /// # Errors
    /// [`AnswerError`] for a result that cannot be tabulated.
    pub fn table(&self, shown: &Shown) -> Result<Option<Table<'_>>, AnswerError> {
        let Self { asked, osc, plan, .. } = self;
        let units = &asked.units;
        Ok(Some(match (&plan.task, &self.results) {
            (_, Results::Simulate(start, found)) => {
                let step = shown.step.unwrap_or(osc.period() / 100.0);
                table::waveform::table(osc, *start, (found.shown_until, step), *units)?
            }
            (_, Results::Settle(start, found)) => {
                let view = Viewed::new(shown.view.unwrap_or_default(), (osc, *start), found, asked)?;
                view.table()?.kept()
            }
            (_, Results::Attractors(found)) => table::attractors::table(found, osc, units),
            (_, Results::Orbit(found)) => {
                table::orbits::table(OrbitAnswer::of_oscillator(found, osc, units), None, units)
            }
            (_, Results::Basin(found)) => table::basin::table(found, units)?,
            (_, Results::Map(found)) => table::map::table(found, &asked.system, (*units, false))?,
            (_, Results::Diagram(found)) => table::diagram::table(found, &asked.system, *units)?,
            (_, Results::Lyapunov(_, _, Some(points))) => table::section::table(points, osc, *units),
            (_, Results::Branch(found)) => table::branch::table(self.branches(found)?, None, (&self.cut()?, units)),
            (_, Results::Curve(found)) => table::curve::table(self.curve(found)?, None, (&self.curve_plan()?, units)),
            (Task::Region(task), Results::Region(found)) => {
                table::region::table(found, &task.typed::<Parameter>()?, units)
            }
            (Task::Response(task), Results::Response(found)) => {
                table::response::table(ResponseView::of_oscillator(found, task, units)?)
            }
            (_, Results::Margins(_, found)) => table::margins::table(found, osc, *units),
            _ => return Ok(None),
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Units, answer};
    use core::sync::atomic::AtomicBool;
    use core::sync::atomic::Ordering;
    use vibroimpact_study::{StartPlan, SystemPlan};

    const S: SystemPlan = SystemPlan {
        beta: None,
        inverse_beta: Some(1.3),
        gap: 0.75,
        restitution: 0.5,
        damping: 0.0,
        second_stop: None,
        body: None,
    };

    #[test]
    fn an_answer_goes_to_another_thread() {
        const fn sends<T: Send + Sync + 'static>() {}
        sends::<Answer>();
        sends::<AnswerError>();
    }

    #[test]
    fn stopped_before_it_begins() {
        let stop = AtomicBool::new(true);
        let control = Control { stop: &stop, ..Control::default() };
        let start = StartPlan::default();
        for task in [
            Task::Settle { start: Some(start), impacts: None },
            Task::Orbit { label: "1/1".into() },
            Task::Attractors { starts: 9, seed: 1, impacts: None },
        ] {
            let end = answer(&Plan::new(S, task), Units::default(), &control);
            assert!(matches!(end, Err(AnswerError::Stopped(_))), "{end:?}");
        }
    }

    /// Without the stop flag each of these takes minutes: exponents and sections of a motion with chatter.
    #[test]
    fn stopped_on_the_way() {
        let two = r#""system":{"inverse_beta":7.3,"gap":0.05,"restitution":0.5,"damping":1e-4,"second_stop":{"gap":0.065,"restitution":0.55}}"#;
        let u = r#""system":{"inverse_beta":1.11,"gap":3,"restitution":0.5}"#;
        for (system, task) in [
            (two, r#""lyapunov":{"impacts":10000000,"transient":1000000,"points":100000}"#),
            (u, r#""lyapunov":{"impacts":10000000,"transient":1000000}"#),
        ] {
            let plan: Plan = serde_json::from_str(&format!(r#"{{"version":1,{system},"task":{{{task}}}}}"#)).unwrap();
            let stop = AtomicBool::new(false);
            std::thread::scope(|scope| {
                scope.spawn(|| {
                    std::thread::sleep(std::time::Duration::from_millis(100));
                    stop.store(true, Ordering::Relaxed);
                });
                let end = answer(&plan, Units::default(), &Control { stop: &stop, ..Control::default() });
                assert!(matches!(end, Err(AnswerError::Stopped(_))), "{task}");
            });
        }
    }

    /// A figure over three axes is an error of the report, not of the plan.
    #[test]
    fn what_is_refused() {
        let ask = |text: &str| answer(&serde_json::from_str(text).unwrap(), Units::default(), &Control::default());
        let basin = |axes: &str| {
            format!(
                r#"{{"version":1,"system":{{"inverse_beta":1.3,"gap":0.75,"restitution":0.5}},"task":{{"basin":{{"axes":[{axes}]}}}}}}"#
            )
        };
        let x = r#"{"vary":"x","over":"0:0.7:2"}"#;
        let line = ask(&basin(x)).unwrap();
        assert!(line.figure(&Shown::default(), &Control::default()).is_ok());
        let others = r#"{"vary":"v","over":"0:1:2"},{"vary":"phase","over":"0:1:2"}"#;
        let undrawn = ask(&basin(&format!("{x},{others}"))).unwrap().figure(&Shown::default(), &Control::default());
        assert!(matches!(undrawn, Err(AnswerError::Report(ReportError::Axes(3)))), "{undrawn:?}");
        let mut text = Vec::new();
        line.table(&Shown::default()).unwrap().unwrap().write(&mut text).unwrap();
        assert!(text.starts_with(b"x,label\n0,"));
        assert!(
            line.json()
                .contains(r#""axes":[{"vary":"x","over":{"from":0.0,"to":0.7,"count":2}}],"refused":0,"cells":[0,0]"#),
            "{}",
            line.json()
        );
        let beyond = ask(&basin(&x.replace("0.7", "0.8")));
        assert!(matches!(beyond, Err(AnswerError::Plan(PlanError::System(_)))), "{beyond:?}");
        let gap = r#"{"vary":"gap","over":"1:2:2"}"#;
        let varied = ask(&basin(&format!("{x},{gap}")));
        assert!(matches!(varied, Err(AnswerError::Plan(PlanError::WrongAxis { .. }))), "{varied:?}");
        let exponents = basin(gap).replace("basin", "lyapunov");
        assert!(ask(&exponents).unwrap_err().to_string().contains("no axis gap"));
    }
}

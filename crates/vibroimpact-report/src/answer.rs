//! One door from a plan to all that is told about it.

use crate::figure::{self, title};
use crate::{Asked, ReportError, Table, Units, json, table};
use core::sync::atomic::Ordering;
use serde::{Serialize, Serializer};
use vibroimpact::chaos::{Exponents, Section, exponents_while, section_while};
use vibroimpact::orbit::{FindOptions, Orbit, find_while};
use vibroimpact::verdict::{Census, SettleOptions, Settled, StartBox, settle_while};
use vibroimpact::{Label, Oscillator, Start};
use vibroimpact_plot::Figure;
use vibroimpact_study::{
    Basin, BranchPlan, Branches, Control, CurvePlan, Cut, Diagram, EventCurve, Plan, PlanError, RegionMap, RegionPlan,
    Regions, RunError, Simulated, Stopped, StoreError, Task, attractors, basin, branches, curve, diagram, map,
    most_impacts, regions, simulate,
};

/// A plan and its result, in memory. As JSON (it is [`Serialize`]) it is the object that the command prints with `--json`.
#[derive(Clone, Debug)]
pub struct Answer {
    /// The plan, [as the command writes it](complete).
    pub plan: Plan,
    /// The system, and the units of everything told.
    pub asked: Asked,
    /// The oscillator; of a plane, that at its first corner.
    pub osc: Oscillator,
    /// What was found.
    pub found: Found,
}

/// The result of each task.
#[derive(Clone, Debug)]
pub enum Found {
    /// The events of a motion.
    Simulate(Start, Simulated),
    /// What a motion settles into.
    Settle(Start, Settled),
    /// The steady motions, of so many starts of that sequence.
    Attractors((u64, u64), Census),
    /// The orbits of a label.
    Orbit(Vec<Orbit>),
    /// The motion of each start.
    Basin(Basin),
    /// The motions at each point.
    Map(RegionMap),
    /// The motions at each value.
    Diagram(Diagram),
    /// Exponents, what the motion is, and its sections where points of them were asked for.
    Lyapunov(Start, Exponents, Option<Section>),
    /// A branch and those that begin on it.
    Branch(BranchPlan, Cut, Branches),
    /// A curve of events.
    Curve(CurvePlan, EventCurve),
    /// Where a motion exists and is stable.
    Region(RegionPlan, Regions),
}

/// Why there is no answer, or no figure or table of it.
#[derive(Debug, thiserror::Error)]
pub enum AnswerError {
    /// The question makes no sense.
    #[error(transparent)]
    Plan(PlanError),
    /// It was stopped from outside.
    #[error(transparent)]
    Stopped(#[from] Stopped),
    /// It cannot be drawn, or not be tabulated.
    #[error(transparent)]
    Report(ReportError),
}

impl From<PlanError> for AnswerError {
    fn from(error: PlanError) -> Self {
        Self::Plan(error)
    }
}

impl From<RunError> for AnswerError {
    fn from(error: RunError) -> Self {
        match error {
            RunError::Plan(error) => Self::Plan(error),
            RunError::Stopped(error) => Self::Stopped(error),
        }
    }
}

impl From<ReportError> for AnswerError {
    fn from(error: ReportError) -> Self {
        match error {
            ReportError::Plan(error) | ReportError::Store(StoreError::Plan(error)) => Self::Plan(error),
            error => Self::Report(error),
        }
    }
}

/// The same question as the command of its task writes it: what varies has its first value in the system, and a number of
/// impacts is given.
///
/// # Errors
/// [`PlanError`] for a parameter of a second stop that is not there.
pub fn complete(plan: &Plan) -> Result<Plan, PlanError> {
    let mut plan = plan.canonical()?;
    match &mut plan.task {
        Task::Simulate { impacts, periods, .. } => *impacts = Some(most_impacts(*impacts, *periods)),
        Task::Region(region) => {
            let (p, q) = (region.across, region.up);
            plan.system = plan.system.with(p.parameter, p.from)?.with(q.parameter, q.from)?;
        }
        _ => {}
    }
    Ok(plan)
}

/// How much there is to do and what is counted, where progress is told: `(40000, "starts")`.
#[must_use]
pub fn work(plan: &Plan) -> Option<(u64, &'static str)> {
    match &plan.task {
        Task::Attractors { starts, .. } => Some((*starts, "starts")),
        Task::Basin(basin) => Some((basin.starts(), "starts")),
        Task::Map(map) => Some((map.points(), "points")),
        Task::Diagram(diagram) => Some((u64::from(diagram.over.count()).saturating_mul(diagram.runs()), "motions")),
        Task::Region(_) => Some((2, "regions")),
        _ => None,
    }
}

/// Runs a plan in memory: every point of a grid, without refinement. A map is nondimensional whatever the units.
///
/// `control.stop` is heeded at every point of a grid, every event of a motion, every seed of a search for orbits, every step round
/// a region and every point of a branch or curve.
///
/// # Errors
/// [`AnswerError`] for a plan that makes no sense, or when stopped. Exponents over axes are no one answer but a study.
pub fn answer(plan: &Plan, units: Units, control: &Control<'_>) -> Result<Answer, AnswerError> {
    let plan = complete(plan)?;
    plan.check()?;
    let system = plan.system;
    let osc = system.oscillator()?;
    let go_on = || !control.stop.load(Ordering::Relaxed);
    let none = Stopped { done: 0, total: work(&plan).map_or(1, |(total, _)| total) };
    if !go_on() {
        return Err(none.into());
    }
    let found = match &plan.task {
        Task::Simulate { start, impacts, periods } => {
            let start = start.start(&osc)?;
            let impacts = most_impacts(*impacts, *periods);
            Found::Simulate(start, simulate(&osc, start, impacts, *periods, control)?)
        }
        Task::Settle { start } => {
            let start = start.start(&osc)?;
            Found::Settle(start, settle_while(&osc, start, &SettleOptions::default(), go_on).ok_or(none)?)
        }
        Task::Attractors { starts, seed } => {
            let (area, which, options) = (StartBox::natural(&osc), (*starts, *seed), SettleOptions::default());
            Found::Attractors(which, attractors(&osc, area, which, &options, control)?)
        }
        Task::Orbit { label } => {
            let label: Label = label.parse().map_err(PlanError::from)?;
            Found::Orbit(find_while(&osc, label, FindOptions::default(), go_on).ok_or(none)?)
        }
        Task::Basin(task) => Found::Basin(basin(&system, task, control)?),
        Task::Map(task) => Found::Map(map(&system, task, control)?),
        Task::Diagram(task) => Found::Diagram(diagram(&system, task, control)?),
        Task::Lyapunov(task) => {
            if let Some(axis) = task.axes.first() {
                let (task, known) = ("measurement of one motion", "none: over axes it is a study, for `vibro run`");
                return Err(PlanError::WrongAxis { task, name: axis.vary.name(), known }.into());
            }
            let start = task.start.start(&osc)?;
            let points = match task.points {
                Some(n) => Some(section_while(&osc, start, task.transient, n, go_on).ok_or(none)?),
                None => None,
            };
            let found = exponents_while(&osc, start, &task.options(), go_on).ok_or(none)?;
            Found::Lyapunov(start, found, points)
        }
        Task::Branch(task) => Found::Branch(task.clone(), task.cut(&system)?, branches(&system, task, control)?),
        Task::Curve(task) => Found::Curve(task.clone(), curve(&system, task, control)?),
        Task::Region(task) => Found::Region(task.clone(), regions(&system, task, control)?),
    };
    Ok(Answer { asked: Asked { system, units }, osc, found, plan })
}

impl Serialize for Answer {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let Self { plan, asked, osc, found } = self;
        match found {
            Found::Simulate(start, found) => json::simulate::document(asked, plan, (osc, start), found).serialize(to),
            Found::Settle(start, found) => json::settle::document(asked, plan, (osc, start), found, None).serialize(to),
            Found::Attractors(which, found) => {
                json::attractors::document(asked, plan, osc, *which, found).serialize(to)
            }
            Found::Orbit(found) => json::orbit::document(asked, plan, osc, found).serialize(to),
            Found::Basin(found) => json::basin::document(asked, plan, osc, found).serialize(to),
            Found::Map(found) => json::map::document(plan, found).serialize(to),
            Found::Diagram(found) => json::diagram::document(asked, plan, osc, found).serialize(to),
            Found::Lyapunov(start, found, _) => {
                json::lyapunov::document(asked, plan, (osc, start), found).serialize(to)
            }
            Found::Branch(_, cut, found) => json::branch::document(asked, plan, osc, found, cut).serialize(to),
            Found::Curve(task, found) => json::curve::document(asked, plan, osc, (task, found)).serialize(to),
            Found::Region(task, found) => json::region::document(asked, plan, (task, found)).serialize(to),
        }
    }
}

impl Answer {
    /// The line that the command prints with `--json`, without its end.
    #[must_use]
    pub fn json(&self) -> String {
        // texts and numbers always become JSON
        serde_json::to_string(self).unwrap_or_default()
    }

    /// The figure that the command draws with `--plot`: of a settled motion the steady one, of exponents both sections, where points
    /// of them were asked for. Attractors and orbits have none. Behind a branch is what simulation finds, which is computed here.
    ///
    /// # Errors
    /// [`AnswerError`] for what cannot be drawn, or when stopped.
    pub fn figure(&self, control: &Control<'_>) -> Result<Option<Figure>, AnswerError> {
        let Self { asked, osc, .. } = self;
        Ok(Some(match &self.found {
            Found::Simulate(start, found) => {
                let span = (0.0, found.shown_until(osc));
                figure::waveform::figure(osc, *start, span, &asked.units, title(&asked.system))
            }
            Found::Settle(start, found) => figure::settle::figure(osc, *start, found, asked),
            Found::Attractors(..) | Found::Orbit(_) | Found::Lyapunov(_, _, None) => return Ok(None),
            Found::Basin(found) => figure::basin::figure(found, asked)?,
            Found::Map(found) => figure::map::figure(found, &asked.system)?,
            Found::Diagram(found) => figure::diagram::figure(found, asked)?,
            Found::Lyapunov(_, _, Some(points)) => figure::section::figure(points, osc, asked),
            Found::Branch(task, cut, found) => {
                let behind = diagram(&asked.system, &task.diagram(&asked.system)?, control)?;
                figure::branch::figure(&found.followed, cut, Some(&behind), false, asked)?
            }
            Found::Curve(task, found) => figure::curve::figure(found, task, asked),
            Found::Region(task, found) => figure::region::figure(found, task, asked),
        }))
    }

    /// The table that the command writes with `--csv`; of a simulation the waveform, a hundredth of the forcing period apart.
    /// Orbits have none.
    ///
    /// # Errors
    /// [`ReportError`] for what cannot be tabulated.
    pub fn table(&self) -> Result<Option<Table<'_>>, ReportError> {
        let (units, osc) = (&self.asked.units, &self.osc);
        Ok(Some(match &self.found {
            Found::Simulate(start, found) => {
                table::waveform::table(osc, *start, (found.shown_until(osc), osc.period() / 100.0), *units)?
            }
            Found::Settle(start, found) => table::waveform::steady(osc, *start, found, *units)?,
            Found::Attractors(_, found) => table::attractors::table(found, osc),
            Found::Orbit(_) | Found::Lyapunov(_, _, None) => return Ok(None),
            Found::Basin(found) => table::basin::table(found, units)?,
            Found::Map(found) => table::map::table(found),
            Found::Diagram(found) => table::diagram::table(found, *units)?,
            Found::Lyapunov(_, _, Some(points)) => table::section::table(points, osc, *units),
            Found::Branch(_, cut, found) => table::branch::table(found, cut, units),
            Found::Curve(task, found) => table::curve::table(found, task, units),
            Found::Region(task, found) => table::region::table(found, task, units),
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::sync::atomic::AtomicBool;
    use vibroimpact_study::{Parameter, StartPlan, Stretch, SystemPlan};

    const S: SystemPlan = SystemPlan {
        beta: None,
        inverse_beta: Some(1.3),
        gap: 0.75,
        restitution: 0.5,
        damping: 0.0,
        second_stop: None,
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
        for task in
            [Task::Settle { start }, Task::Orbit { label: "1/1".into() }, Task::Attractors { starts: 9, seed: 1 }]
        {
            let end = answer(&Plan::new(S, task), Units::default(), &control);
            assert!(matches!(end, Err(AnswerError::Stopped(_))), "{end:?}");
        }
    }

    /// Minutes of work each, were it not for the flag: exponents and sections of a motion that chatters, and a search for long orbits.
    #[test]
    fn stopped_on_the_way() {
        let two = r#""system":{"inverse_beta":7.3,"gap":0.05,"restitution":0.5,"damping":1e-4,"second_stop":{"gap":0.065,"restitution":0.55}}"#;
        let u = r#""system":{"inverse_beta":1.11,"gap":3,"restitution":0.5}"#;
        for (system, task) in [
            (two, r#""lyapunov":{"impacts":10000000,"transient":1000000,"points":100000}"#),
            (u, r#""lyapunov":{"impacts":10000000,"transient":1000000}"#),
            (two, r#""orbit":{"label":"3000/2000"}"#),
        ] {
            let plan: Plan = serde_json::from_str(&format!(r#"{{"version":1,{system},"task":{{{task}}}}}"#)).unwrap();
            let stop = AtomicBool::new(false);
            let begun = std::time::Instant::now();
            std::thread::scope(|scope| {
                scope.spawn(|| {
                    std::thread::sleep(std::time::Duration::from_millis(100));
                    stop.store(true, Ordering::Relaxed);
                });
                let end = answer(&plan, Units::default(), &Control { stop: &stop, ..Control::default() });
                assert!(matches!(end, Err(AnswerError::Stopped(_))), "{task}");
            });
            assert!(begun.elapsed().as_secs_f64() < 1.5, "{task} {:?}", begun.elapsed());
        }
    }

    /// A figure of three axes cannot be drawn, which is no fault of the question.
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
        let undrawn = line.figure(&Control::default());
        assert!(matches!(undrawn, Err(AnswerError::Report(ReportError::Axes(1)))), "{undrawn:?}");
        let mut text = Vec::new();
        line.table().unwrap().unwrap().write(&mut text).unwrap();
        assert!(text.starts_with(b"x,label\n0,"));
        assert!(line.json().contains(r#""x":{"from":0.0,"to":0.7,"count":2},"v":0.0,"phase":0.0"#), "{}", line.json());
        let beyond = ask(&basin(&x.replace("0.7", "0.8")));
        assert!(matches!(beyond, Err(AnswerError::Plan(PlanError::System(_)))), "{beyond:?}");
        let gap = r#"{"vary":"gap","over":"1:2:2"}"#;
        let varied = ask(&basin(&format!("{x},{gap}")));
        assert!(matches!(varied, Err(AnswerError::Plan(PlanError::WrongAxis { .. }))), "{varied:?}");
        let exponents = basin(gap).replace("basin", "lyapunov");
        assert!(ask(&exponents).unwrap_err().to_string().contains("no axis gap"));
    }

    #[test]
    fn a_plan_is_completed_as_the_command_writes_it() {
        let start = StartPlan::default();
        let short = Plan::new(S, Task::Simulate { start, impacts: None, periods: Some(3.0) });
        let Task::Simulate { impacts, .. } = complete(&short).unwrap().task else { panic!("another task") };
        assert_eq!(impacts, Some(1_000_000));
        let over = |parameter, from, to| Stretch { parameter, from, to };
        let (across, up) = (over(Parameter::Beta, 0.5, 0.6), over(Parameter::Gap, -1.0, 2.0));
        let region = Plan::new(S, Task::Region(RegionPlan { label: "1/1".into(), across, up, grid: 3 }));
        let system = complete(&region).unwrap().system;
        assert_eq!((system.beta, system.inverse_beta, system.gap), (Some(0.5), None, -1.0));
        assert_eq!(work(&region), Some((2, "regions")));
    }
}

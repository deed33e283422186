//! How far a cycle of a machine is from the nearest event of its branch in each of its numbers.

use super::branch::OrbitLine;
use super::orbits;
use super::verdicts::settle;
use crate::machine::MachineSource;
use crate::margins::check_within;
use crate::{Control, Cut, MarginsPlan, PlanError, RunError};
use vibroimpact::continuation::{Direction, machine::SolutionPoint};
use vibroimpact::events::Start;
use vibroimpact::machine::Machine;
use vibroimpact::orbit::machine::Cycle;
use vibroimpact::verdict::Verdict;

/// The largest number of points of a branch.
const MOST_POINTS: u32 = 20_000;
/// How often the end of a range is moved half way to the value, while no machine has it.
const HALVINGS: u32 = 12;

/// The distances of a motion from its nearest events.
#[derive(Clone, Debug)]
pub struct MachineMargins {
    /// The motion.
    pub motion: Verdict<Machine>,
    /// The nearest events in each number; empty for a motion that is no cycle.
    pub numbers: Vec<NumberMargin>,
}

/// The nearest events in one number.
#[derive(Clone, Debug)]
pub struct NumberMargin {
    /// The path of the number.
    pub path: String,
    /// Its value.
    pub value: f64,
    /// The ends of the range in which events are looked for.
    pub low: f64,
    /// See above.
    pub high: f64,
    /// The nearest event at a smaller value; `None` if there is none up to the end.
    pub down: Option<NumberEvent>,
    /// The nearest event at a larger value.
    pub up: Option<NumberEvent>,
}

/// An event of a branch, and what follows.
#[derive(Clone, Debug)]
pub struct NumberEvent {
    /// The point with the event.
    pub point: SolutionPoint,
    /// The label beyond; `None` if the branch ends.
    pub after: Option<String>,
}

impl NumberMargin {
    /// Both directions, each with the end of its range.
    #[must_use]
    pub const fn ends(&self) -> [(&'static str, f64, Option<&NumberEvent>); 2] {
        [("down", self.low, self.down.as_ref()), ("up", self.high, self.up.as_ref())]
    }

    /// The change that counts as 1: the size of the value.
    #[must_use]
    pub fn scale(&self) -> f64 {
        if self.value == 0.0 { 1.0 } else { self.value.abs() }
    }
}

impl MachineMargins {
    /// The number, the direction and the change in units of its scale of the nearest event; `None` if there is none.
    #[must_use]
    pub fn nearest(&self) -> Option<(&NumberMargin, &'static str, f64)> {
        let events = self.numbers.iter().flat_map(|number| {
            let end = move |(way, _, event): (&'static str, f64, Option<&NumberEvent>)| {
                event.map(|event| (number, way, (event.point.value - number.value).abs() / number.scale()))
            };
            number.ends().into_iter().filter_map(end)
        });
        events.min_by(|a, b| a.2.total_cmp(&b.2))
    }
}

impl MarginsPlan<String> {
    /// The numbers that vary.
    fn paths(&self, source: &MachineSource) -> Result<Vec<String>, PlanError> {
        if !self.vary.is_empty() {
            return Ok(self.vary.iter().map(|one| one.parameter.clone()).collect());
        }
        Ok(source.free_numbers()?.0.into_iter().map(|(path, _)| path).collect())
    }

    /// Checks everything that can be checked without running the plan.
    ///
    /// # Errors
    /// [`PlanError`] names the first invalid value.
    pub fn check(&self, source: &MachineSource, machine: &Machine) -> Result<(), PlanError> {
        check_within(self.within)?;
        orbits::check(machine, (self.label.as_deref(), None))?;
        if self.lines.is_some() || self.vary.iter().any(|one| one.scale.is_some()) {
            return Err(PlanError::NoBox);
        }
        self.vary.iter().try_for_each(|one| Ok(source.number(&one.parameter).map(drop)?))
    }
}

/// The motion of a plan and its nearest events.
pub(super) fn margins(
    source: &MachineSource,
    (machine, start): (&Machine, &Start),
    plan: &MarginsPlan<String>,
    control: &Control<'_>,
) -> Result<MachineMargins, RunError> {
    let motion = match &plan.label {
        Some(label) => Verdict::Periodic(orbits::chosen((machine, start), (Some(label), None), control)?.cycle),
        None => settle(machine, start, None, control)?.verdict,
    };
    let mut numbers = Vec::new();
    if let Verdict::Periodic(cycle) = &motion {
        for path in plan.paths(source)? {
            numbers.push(margin(source, cycle, path, plan.within, control)?);
            (control.progress)(numbers.len() as u64);
        }
    }
    Ok(MachineMargins { motion, numbers })
}

/// The nearest events of a cycle in one number.
fn margin(
    source: &MachineSource,
    cycle: &Cycle,
    path: String,
    within: f64,
    control: &Control<'_>,
) -> Result<NumberMargin, RunError> {
    let value = source.number(&path).map_err(PlanError::from)?;
    let ends = match value {
        _ if path.ends_with(".restitution") => [0.0, 1.0],
        0.0 => [1.0 - within, within - 1.0],
        _ => [(value / within).min(value * within), (value / within).max(value * within)],
    };
    // where no machine has such a number, as where two stops leave no room
    let allowed = |mut end: f64| {
        let there = |end: f64| source.with(&path, end).is_ok_and(|source| source.machine().is_ok());
        for _ in 0..HALVINGS {
            if there(end) {
                return end;
            }
            end = value + 0.5 * (end - value);
        }
        value
    };
    let [low, high] = ends.map(allowed);
    let mut found = NumberMargin { path, value, low, high, down: None, up: None };
    if low < high {
        let line =
            OrbitLine::new(source, &Cut { vary: found.path.clone(), ends: (low, high), also: None }, MOST_POINTS);
        let nearest =
            |end: f64, way| if end == value { Ok(None) } else { line.first_event((value, cycle), way, control) };
        let event = |(point, after)| NumberEvent { point, after };
        found.down = nearest(low, Direction::Down)?.map(event);
        found.up = nearest(high, Direction::Up)?.map(event);
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{BranchPlan, Plan, Results, ScaledParameter, Task, machine, run};

    /// The nearest events are those of the branches in each number alone.
    #[test]
    fn the_first_events_of_branches() {
        let source = MachineSource::open("two-mass-hammer").unwrap();
        let vary = vec!["frequency".to_owned(), "stop.anvil.gap".to_owned(), "stop.anvil.restitution".to_owned()];
        let scaled = vary.iter().map(|path| ScaledParameter { parameter: path.clone(), scale: None });
        let task = Task::from(MarginsPlan { vary: scaled.collect(), ..MarginsPlan::default() });
        let plan = Plan::new(source.clone(), task);
        assert_eq!(Plan::from_text(&plan.to_toml()).unwrap(), plan);
        let Results::Machine(machine::Results::Margins(found)) = run(&plan, &Control::default()).unwrap() else {
            panic!()
        };
        assert_eq!(found.motion.label(), "1/1");
        let mut events = 0;
        for (margin, path) in found.numbers.iter().zip(vary) {
            for (_, limit, event) in margin.ends() {
                let branch = BranchPlan {
                    label: None,
                    orbit: None,
                    vary: path.clone(),
                    to: limit,
                    also: None,
                    points: 5000,
                    follow: 0,
                };
                let plan = Plan::new(source.clone(), Task::from(branch));
                let Results::Machine(machine::Results::Branch(branch)) = run(&plan, &Control::default()).unwrap()
                else {
                    panic!()
                };
                let first = branch.followed[0].points.iter().find(|point| point.event.is_some()).unwrap();
                match event {
                    Some(event) => {
                        let apart = (event.point.value - first.value).abs();
                        assert!(apart < 1e-9 && event.point.event == first.event, "{path} {event:?}");
                        events += 1;
                    }
                    None => assert!(first.value == limit, "{path} {:?}", first.event),
                }
            }
        }
        assert!(events >= 2 && found.nearest().is_some(), "{events}");
    }
}

//! Branches of a machine in one number or along a line through two, and the branches that begin at their flips and branch
//! points.

use super::orbits;
use crate::branch::{DIAGRAM_VALUES, MOST_FOLLOWED};
use crate::diagram::{DEFAULT_KEEP, DEFAULT_TRANSIENT, SPEED, SweepDirection};
use crate::machine::MachineSource;
use crate::{
    BranchPlan, Branches, Control, Cut, DiagramPlan, Followed, Origin, PlanError, RunError, Span, Stopped, Stretch,
    Target, limits,
};
use core::ops::RangeInclusive;
use std::collections::VecDeque;
use vibroimpact::continuation::{
    BranchOptions, Direction,
    machine::{Branch, BranchEvent, Family, SolutionPoint},
};
use vibroimpact::events::Start;
use vibroimpact::machine::Machine;
use vibroimpact::orbit::machine::Cycle;

impl BranchPlan<String> {
    /// Checks the orbit, the numbers that vary and their ranges.
    pub(crate) fn check(&self, source: &MachineSource, machine: &Machine) -> Result<(), PlanError> {
        limits::check("follow", self.follow, 0..=MOST_FOLLOWED)?;
        orbits::check(machine, (self.label.as_deref(), self.orbit))?;
        let cut = self.cut(source)?;
        let (from, to) = cut.ends;
        let name = || self.vary.clone().into();
        if to == from {
            return Err(PlanError::Nowhere { name: name(), value: from });
        }
        if !to.is_finite() {
            return Err(PlanError::Endless { name: name(), from, to });
        }
        cut.check(source)?;
        limits::branch_points(self.points)?;
        cut.source(source, to)?.parts()?;
        Ok(())
    }

    /// The line along which the orbit is followed.
    ///
    /// # Errors
    /// [`PlanError::Machine`] if a path leads to no number.
    pub fn cut(&self, source: &MachineSource) -> Result<Cut<String>, PlanError> {
        let from = |Target { parameter: path, to }: &Target<String>| {
            source.number(path).map(|from| Stretch { parameter: path.clone(), from, to: *to })
        };
        let also = self.also.as_ref().map(from).transpose()?;
        Ok(Cut { vary: self.vary.clone(), ends: (source.number(&self.vary)?, self.to), also })
    }

    /// The plan of an orbit diagram over the same range.
    ///
    /// # Errors
    /// [`PlanError`] for an invalid plan.
    pub fn diagram(&self, source: &MachineSource) -> Result<DiagramPlan<String, String>, PlanError> {
        let Cut { vary, ends, also } = self.cut(source)?;
        let over = Span::new(ends.0, ends.1, DIAGRAM_VALUES)?.into();
        let (direction, transient, keep) = (SweepDirection::Both, DEFAULT_TRANSIENT, DEFAULT_KEEP);
        Ok(DiagramPlan { vary, over, also, show: SPEED.to_owned(), direction, transient, keep })
    }
}

/// The branch of an orbit along a line, and the branches that begin on it.
pub(super) fn branch(
    source: &MachineSource,
    problem: (&Machine, &Start),
    plan: &BranchPlan<String>,
    control: &Control<'_>,
) -> Result<Branches<Cycle, SolutionPoint>, RunError> {
    let cut = plan.cut(source)?;
    let (from, to) = cut.ends;
    let chosen = orbits::chosen(problem, (plan.label.as_deref(), plan.orbit), control)?;
    let line = OrbitLine::new(source, &cut, plan.points);
    let direction = if to > from { Direction::Up } else { Direction::Down };
    let points = line.trace((from, &chosen.cycle), direction, control)?;
    let further = line.beginning_on(&points, plan.follow as usize, &mut Vec::new(), control)?;
    let followed = core::iter::once(Followed { origin: None, points }).chain(further).collect();
    Ok(Branches { chosen, followed, lost: Vec::new() })
}

/// A line through numbers of a machine along which orbits are followed.
pub struct OrbitLine {
    family: Family,
    range: RangeInclusive<f64>,
    options: BranchOptions,
}

/// The label and the value of the number at an event at which branches begin.
pub type BranchPlace = (String, f64);

/// Two values of the number are the same event if they differ by less than this, relative to the range.
const SAME: f64 = 1e-7;

impl OrbitLine {
    /// A line, and the largest number of points of each branch.
    #[must_use]
    pub fn new(source: &MachineSource, cut: &Cut<String>, points: u32) -> Self {
        let (from, to) = cut.ends;
        let family = cut.family(source);
        let options = BranchOptions { points, ..BranchOptions::default() };
        Self { family, range: from.min(to)..=from.max(to), options }
    }

    fn begin(&self, (value, cycle): (f64, &Cycle), direction: Direction) -> Result<Branch, PlanError> {
        Branch::new((&self.family, value), cycle, &self.range, direction, self.options)
            .map_err(|error| PlanError::MachineBranch(error.to_string()))
    }

    /// The branch of a cycle at a value of the number in one direction.
    ///
    /// # Errors
    /// [`PlanError::MachineBranch`] if the cycle is not there, [`Stopped`] when stopped.
    pub fn trace(
        &self,
        at: (f64, &Cycle),
        direction: Direction,
        control: &Control<'_>,
    ) -> Result<Vec<SolutionPoint>, RunError> {
        let mut branch = self.begin(at, direction)?;
        let mut found = Vec::new();
        while !control.stopping() {
            let Some(point) = branch.next() else { return Ok(found) };
            found.push(point);
        }
        Err(Stopped { done: found.len() as u64, total: u64::from(self.options.points) }.into())
    }

    /// The first event of the branch of a cycle at a value of the number in one direction, and the label beyond it unless the branch
    /// ends; `None` if there is none in the range.
    ///
    /// # Errors
    /// As [`trace`](Self::trace).
    pub fn first_event(
        &self,
        at: (f64, &Cycle),
        direction: Direction,
        control: &Control<'_>,
    ) -> Result<Option<(SolutionPoint, Option<String>)>, RunError> {
        let mut branch = self.begin(at, direction)?;
        let mut done = 0;
        while !control.stopping() {
            let Some(point) = branch.next() else { return Ok(None) };
            match point.event {
                Some(BranchEvent::EndOfRange) => return Ok(None),
                Some(event) if event.ends() => return Ok(Some((point, None))),
                Some(_) => {
                    let after = branch.next().map(|next| next.cycle.label.to_string());
                    return Ok(Some((point, after)));
                }
                None => done += 1,
            }
        }
        Err(Stopped { done, total: u64::from(self.options.points) }.into())
    }

    /// At most so many of the branches that begin at flips and branch points of a branch, and of these branches in turn. Events
    /// in `seen` are left out, and those that are passed are added to it.
    ///
    /// # Errors
    /// [`Stopped`] when stopped.
    pub fn beginning_on(
        &self,
        points: &[SolutionPoint],
        most: usize,
        seen: &mut Vec<BranchPlace>,
        control: &Control<'_>,
    ) -> Result<Vec<Followed<SolutionPoint>>, RunError> {
        let scale = 0.25 * (self.range.end() - self.range.start());
        let mut waiting: VecDeque<Origin<SolutionPoint>> = origins(points, 0).collect();
        let mut followed = Vec::new();
        while let (Some(begin), true) = (waiting.pop_front(), followed.len() < most) {
            let origin = &begin.point;
            let label = origin.cycle.label.to_string();
            let known = |(of, value): &BranchPlace| *of == label && (value - origin.value).abs() <= 4.0 * SAME * scale;
            if seen.iter().any(known) {
                continue;
            }
            seen.push((label, origin.value));
            for (value, cycle) in origin.leaving(&self.family, scale) {
                if !self.range.contains(&value) || followed.len() >= most {
                    continue;
                }
                let away = if value > origin.value { Direction::Up } else { Direction::Down };
                match self.trace((value, &cycle), away, control) {
                    Ok(points) => {
                        waiting.extend(origins(&points, followed.len() + 1));
                        followed.push(Followed { origin: Some(begin.clone()), points });
                    }
                    Err(RunError::Stopped(stopped)) => return Err(stopped.into()),
                    // a cycle that ceases to exist at once has no branch
                    Err(RunError::Plan(_)) => {}
                }
            }
        }
        Ok(followed)
    }
}

/// The points of branch number `branch` at which other branches begin.
fn origins(points: &[SolutionPoint], branch: usize) -> impl Iterator<Item = Origin<SolutionPoint>> + '_ {
    let begins = |point: &&SolutionPoint| matches!(point.event, Some(BranchEvent::Flip | BranchEvent::BranchPoint));
    points.iter().filter(begins).map(move |point| Origin { branch, point: point.clone() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::CATALOGUE;
    use crate::{Plan, Results, Task, machine, run};

    fn hammer() -> MachineSource {
        CATALOGUE.iter().find(|entry| entry.name == "two-mass-hammer").unwrap().source().unwrap()
    }

    fn asked(vary: &str, to: f64, also: Option<(&str, f64)>) -> BranchPlan<String> {
        let also = also.map(|(path, to)| Target { parameter: path.to_owned(), to });
        BranchPlan { label: None, orbit: None, vary: vary.to_owned(), to, also, points: 500, follow: 0 }
    }

    fn followed(source: &MachineSource, plan: &BranchPlan<String>) -> Branches<Cycle, SolutionPoint> {
        let plan = Plan::new(source.clone(), Task::from(plan.clone()));
        let Results::Machine(machine::Results::Branch(found)) = run(&plan, &Control::default()).unwrap() else {
            panic!()
        };
        found
    }

    fn grazing(found: &Branches<Cycle, SolutionPoint>) -> f64 {
        let is_grazing = |point: &&SolutionPoint| matches!(point.event, Some(BranchEvent::Grazing { .. }));
        found.followed[0].points.iter().find(is_grazing).unwrap().value
    }

    #[test]
    fn a_line_meets_the_grazing_that_its_first_number_meets_alone_there() {
        let source = hammer();
        let line = asked("frequency", 1.0, Some(("stop.anvil.gap", 0.6)));
        let found = followed(&source, &line);
        let value = grazing(&found);
        let gap = line.cut(&source).unwrap().values(value).nth(1).unwrap();
        assert!(gap > 0.5 && gap < 0.6, "{gap}");
        let there = source.with("stop.anvil.gap", gap).unwrap();
        assert!((grazing(&followed(&there, &asked("frequency", 1.0, None))) - value).abs() < 1e-9);
        let ends = [1.2, 1.0].map(|end| line.cut(&source).unwrap().values(end).nth(1));
        assert_eq!(ends, [Some(0.5), Some(0.6)]);
        assert_eq!(line.diagram(&source).unwrap().cut(), line.cut(&source).unwrap());
    }

    #[test]
    fn the_number_of_the_orbit() {
        let source = hammer().with("frequency", 1.06).unwrap();
        let of = |orbit| BranchPlan { label: Some("2/1".into()), orbit, ..asked("frequency", 1.065, None) };
        let begins = |orbit| {
            let found = followed(&source, &of(orbit));
            let first = &found.followed[0].points[0].cycle;
            (found.chosen.among, first.stable(), first.fastest())
        };
        let number = |number| Some(crate::OrbitNumber { number, count: 2 });
        let (one, two) = (begins(Some(1)), begins(Some(2)));
        assert_eq!((one.0, one.1, two.0, two.1), (number(1), false, number(2), true));
        assert!(one.2 < two.2);
        // the stable one by default
        assert_eq!(begins(None), two);
        let refused = |plan: BranchPlan<String>| {
            let plan = Plan::new(source.clone(), Task::from(plan));
            run(&plan, &Control::default()).unwrap_err().to_string()
        };
        for orbit in [0, 3] {
            let said = refused(of(Some(orbit)));
            assert!(said.starts_with(&format!("there is no orbit 2/1 number {orbit}; found: 2")), "{said}");
        }
        let unlabelled = BranchPlan { label: None, ..of(Some(1)) };
        assert!(refused(unlabelled).starts_with("the number of an orbit is given without a label"));
        let twice = asked("frequency", 1.0, Some(("frequency", 1.1)));
        assert!(refused(twice).starts_with("frequency and frequency cannot vary together"));
        let endless = asked("frequency", 1.0, Some(("b", f64::NAN)));
        assert!(refused(endless).starts_with("b is to go from 0.5 to NaN"));
    }

    #[test]
    fn a_plan_survives_json() {
        let full =
            BranchPlan { label: Some("2/1".into()), orbit: Some(1), follow: 2, ..asked("b", 0.7, Some(("mu", 0.6))) };
        let text = serde_json::to_string(&full).unwrap();
        assert_eq!(serde_json::from_str::<BranchPlan<String>>(&text).unwrap(), full);
        let short = r#"{"vary":"b","to":0.7,"points":500}"#;
        let plan: BranchPlan<String> = serde_json::from_str(short).unwrap();
        assert_eq!(plan, asked("b", 0.7, None));
        assert_eq!(serde_json::to_string(&plan).unwrap(), short);
    }
}

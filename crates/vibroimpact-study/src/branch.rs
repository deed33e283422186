//! Branches of periodic orbits of any system in one number or along a line through two, and the branches that begin at their flips
//! and branch points.

use crate::chosen::Chosen;
use crate::diagram::{DEFAULT_KEEP, DEFAULT_TRANSIENT, Shown, SweepDirection};
use crate::dynamics::{CycleOf, Dynamics, PointOf, Setup};
use crate::name::{Name, Written, renamed};
use crate::orbit_line::Solution;
use crate::plan_text::is_usual;
use crate::{Control, Cut, DiagramPlan, Parameter, PlanError, RunError, Span, Stretch, Target, limits};
use serde::{Deserialize, Serialize};
use vibroimpact::continuation::{Direction, SolutionPoint};
use vibroimpact::orbit::Cycle;

/// Default maximum number of points of a branch.
pub const DEFAULT_BRANCH_POINTS: u32 = 5_000;
/// Maximum number of further branches.
const MOST_FOLLOWED: u32 = 100;
/// Number of values of the orbit diagram drawn behind a branch.
const DIAGRAM_VALUES: u32 = 401;

/// An orbit that is followed in one parameter, or along a line through two.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields, bound = "V: Name")]
#[schemars(rename = "BranchPlan", bound = "V: Name")]
pub struct BranchPlan<V = Parameter> {
    /// m/n of the orbit at the system given, `inf/n` for one with a complete chatter, m/T of a machine without forcing. A machine
    /// has that of the motion from its start when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub label: Option<String>,
    /// The number that varies, from its value in the system.
    #[serde(with = "crate::name")]
    #[schemars(with = "Written")]
    pub vary: V,
    /// The other end of its range.
    pub to: f64,
    /// An end on the other side of its value in the system: the orbit is followed to both ends. When absent, to `to` only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub back: Option<f64>,
    /// A second number that varies with it, in proportion, from its value in the system to this value at `to`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub also: Option<Target<V>>,
    /// Which of the orbits, counted from 1, the fastest last; when absent the stable one, else the fastest motion.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub orbit: Option<u32>,
    /// How many of the branches that begin at flips and branch points are followed as well: 0 to 100.
    #[serde(default, skip_serializing_if = "is_usual")]
    pub follow: u32,
    /// Largest number of points of each branch, 2 to 100000.
    #[serde(default = "points")]
    pub points: u32,
}

const fn points() -> u32 {
    DEFAULT_BRANCH_POINTS
}

renamed!(BranchPlan: names vary, parts also, others label to back orbit follow points);

impl<V> BranchPlan<V> {
    /// The branch of the motion from the start, up to a value.
    #[must_use]
    pub const fn new(vary: V, to: f64) -> Self {
        let points = DEFAULT_BRANCH_POINTS;
        Self { label: None, vary, to, back: None, also: None, orbit: None, follow: 0, points }
    }
}

impl<V: Name> BranchPlan<V> {
    /// Checks everything that can be checked without running the plan.
    pub(crate) fn check<D: Dynamics<Name = V>>(&self, of: &Setup<'_, D>) -> Result<(), PlanError> {
        of.check_orbit((self.label.as_deref(), self.orbit), false)?;
        let start = of.written.number(&self.vary)?;
        if start == self.to {
            return Err(PlanError::Nowhere { name: self.vary.text().to_owned().into(), value: self.to });
        }
        of.written.check_line(&self.cut(of.written)?)?;
        if let Some(back) = self.back.filter(|back| (start < self.to) != (*back < start) || *back == start) {
            let (name, to) = (self.vary.text(), self.to);
            let hint = "a branch is followed both ways from the system";
            let sentence = format!("{name} = {start} of the system does not lie between {back} and {to}\nhint: {hint}");
            return Err(PlanError::refused(sentence));
        }
        limits::check("follow", self.follow, 0..=MOST_FOLLOWED)?;
        limits::branch_points(self.points)
    }

    /// The line along which the orbit is followed.
    ///
    /// # Errors
    /// [`PlanError`] for an invalid system, or for a number that it does not have.
    pub fn cut<D: Dynamics<Name = V>>(&self, system: &D) -> Result<Cut<V>, PlanError> {
        let start = system.number(&self.vary)?;
        let other = |Target { parameter, to }: &Target<V>| {
            let at = system.number(parameter)?;
            // the line goes on straight beyond the system
            let from = self.back.map_or(at, |back| at + (back - start) * ((to - at) / (self.to - start)));
            Ok::<_, PlanError>(Stretch { parameter: parameter.clone(), from, to: *to })
        };
        let also = self.also.as_ref().map(other).transpose()?;
        Ok(Cut { vary: self.vary.clone(), ends: (self.back.unwrap_or(start), self.to), also })
    }

    /// The plan of an orbit diagram of the closings of stops over the same range.
    ///
    /// # Errors
    /// [`PlanError`] for an invalid plan.
    pub fn diagram<D: Dynamics<Name = V>>(&self, system: &D) -> Result<DiagramPlan<V, D::Shown>, PlanError> {
        let Cut { vary, ends, also } = self.cut(system)?;
        let over = Span::new(ends.0, ends.1, DIAGRAM_VALUES)?.into();
        let (direction, transient, keep) = (SweepDirection::Both, DEFAULT_TRANSIENT, DEFAULT_KEEP);
        Ok(DiagramPlan { vary, over, also, show: D::Shown::closings(), direction, transient, keep })
    }
}

/// The event at which a further branch begins, on a branch of any system.
#[derive(Clone, Debug, PartialEq)]
pub struct Origin<P = SolutionPoint> {
    /// The branch on which the event lies, as an index into [`Branches::followed`].
    pub branch: usize,
    /// The point of that branch.
    pub point: P,
}

/// One branch that was followed.
#[derive(Clone, Debug, PartialEq)]
pub struct Followed<P = SolutionPoint> {
    /// Where it begins; `None` for the first branch.
    pub origin: Option<Origin<P>>,
    /// The point from which it was followed both ways; `None` if that is the first one.
    pub start: Option<usize>,
    /// Its points. Events are those on the way from the start.
    pub points: Vec<P>,
}

/// A branch, the branches that begin on it, the branches that begin on those, and so on.
#[derive(Clone, Debug, PartialEq)]
pub struct Branches<C = Cycle, P = SolutionPoint> {
    /// The orbit at which the first branch begins.
    pub chosen: Chosen<C>,
    /// All branches; the branch of the chosen orbit comes first.
    pub followed: Vec<Followed<P>>,
    /// Events at which a further branch was expected but could not be followed.
    pub lost: Vec<Origin<P>>,
}

/// Follows the orbit of a plan and the branches that begin on its branch.
///
/// # Errors
/// [`RunError`] for an orbit that does not exist, or when stopped. The stop flag is read at every seed of the search and at every
/// point.
pub(crate) fn branches<D: Dynamics>(
    of: &Setup<'_, D>,
    plan: &BranchPlan<D::Name>,
    control: &Control<'_>,
) -> Result<Branches<CycleOf<D>, PointOf<D>>, RunError> {
    let cut = plan.cut(of.written)?;
    let from = of.written.number(&plan.vary)?;
    let chosen = of.chosen((plan.label.as_deref(), plan.orbit), control)?;
    let line = of.written.line(&cut, from, plan.points)?;
    let (direction, opposite) =
        if plan.to > from { (Direction::Up, Direction::Down) } else { (Direction::Down, Direction::Up) };
    let mut points = line.trace((from, &chosen.cycle), direction, control)?;
    let mut start = None;
    // a closed branch is whole already
    if plan.back.is_some() && !points.last().is_some_and(Solution::closes) {
        let mut back = line.trace((from, &chosen.cycle), opposite, control)?;
        back.reverse();
        start = back.len().checked_sub(1);
        // both begin with the orbit itself
        points = back.into_iter().chain(points.into_iter().skip(1)).collect();
    }
    let (further, lost) = line.beginning_on(&points, plan.follow as usize, &mut Vec::new(), control)?;
    let followed = core::iter::once(Followed { origin: None, start, points }).chain(further).collect();
    Ok(Branches { chosen, followed, lost })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::{CATALOGUE, MachineSource};
    use crate::{Plan, PlanResults, Results, StartPlan, SystemPlan, Task, run};
    use vibroimpact::Label;
    use vibroimpact::continuation::{BranchEvent, machine::SolutionPoint};
    use vibroimpact::orbit::machine::Cycle;

    fn branches(system: &SystemPlan, plan: &BranchPlan, control: &Control<'_>) -> Result<Branches, RunError> {
        let problem = system.setup(StartPlan::default())?;
        plan.check(&problem)?;
        super::branches(&problem, plan, control)
    }

    fn plan() -> (SystemPlan, BranchPlan) {
        let system = SystemPlan::from_inverse_beta(1.11, 1.5, 0.5);
        (system, BranchPlan { label: Some("1/1".into()), ..BranchPlan::new(Parameter::Gap, 2.5) })
    }

    #[test]
    fn the_doubling_of_one_impact_a_period_and_what_begins_there() {
        let (system, plan) = plan();
        let found = branches(&system, &BranchPlan { follow: 1, ..plan }, &Control::default()).unwrap();
        assert_eq!((found.followed.len(), found.lost.len()), (2, 0));
        let flip = found.followed[0].points.iter().find(|p| p.event == Some(BranchEvent::Flip)).unwrap();
        assert!((flip.value - 1.829_006_189_683_6).abs() < 1e-12);
        let second = &found.followed[1];
        let origin = second.origin.as_ref().unwrap();
        assert_eq!((origin.branch, origin.point.value), (0, flip.value));
        assert_eq!(second.points[1].cycle.label, Label::new(2, 2));
        assert!(second.points.last().unwrap().event.unwrap().ends());
    }

    #[test]
    fn along_a_line_through_two_parameters() {
        let (system, plan) = plan();
        let also = Some(Target { parameter: Parameter::InverseBeta, to: 1.05 });
        let line = BranchPlan { also, ..plan };
        let flip_on = |system: &SystemPlan, plan: &BranchPlan| {
            let found = branches(system, plan, &Control::default()).unwrap();
            found.followed[0].points.iter().find(|p| p.event == Some(BranchEvent::Flip)).unwrap().value
        };
        let value = flip_on(&system, &line);
        // the same flip as with the gap varied alone, at the frequency of that point of the line
        let there = line.cut(&system).unwrap().system(&system, value).unwrap();
        let below = SystemPlan { gap: value - 0.1, ..there };
        assert!((flip_on(&below, &BranchPlan { also: None, ..line.clone() }) - value).abs() < 1e-11);
        assert!(there.inverse_beta.is_some_and(|x| x > 1.05 && x < 1.11));
        let behind = line.diagram(&system).unwrap();
        assert_eq!(behind.cut(), line.cut(&system).unwrap());
    }

    #[test]
    fn both_ways_along_a_line() {
        let (system, plan) = plan();
        let also = Some(Target { parameter: Parameter::InverseBeta, to: 1.05 });
        let both = BranchPlan { also, back: Some(0.5), ..plan };
        let cut = both.cut(&system).unwrap();
        // the line through the system and its end goes on straight
        let second = cut.values(1.5).nth(1).unwrap();
        assert!(
            cut.ends == (0.5, 2.5) && (second - 1.11).abs() < 1e-15 && (cut.also.unwrap().from - 1.17).abs() < 1e-15
        );
        let found = branches(&system, &both, &Control::default()).unwrap();
        let (start, points) = (found.followed[0].start.unwrap(), &found.followed[0].points);
        assert_eq!([0, start, points.len() - 1].map(|k| points[k].value), [0.5, 1.5, 2.5]);
        assert!(points.iter().filter(|point| point.value == 1.5).count() == 1);
        for back in [2.0, 1.5, 3.0] {
            let message = BranchPlan { back: Some(back), ..both.clone() }
                .check(&system.setup(StartPlan::default()).unwrap())
                .unwrap_err()
                .to_string();
            assert!(message.starts_with("gap = 1.5 of the system does not lie between"), "{message}");
        }
    }

    #[test]
    fn it_stops_when_told_to() {
        let (system, plan) = plan();
        let stop = core::sync::atomic::AtomicBool::new(true);
        let stopped = branches(&system, &plan, &Control { stop: &stop, ..Control::default() });
        assert!(matches!(stopped, Err(RunError::Stopped(_))), "{stopped:?}");
    }

    #[test]
    fn an_orbit_that_rests() {
        let system = SystemPlan::from_inverse_beta(1.11, -0.5, 0.5);
        let plan = BranchPlan { label: Some("inf/1".into()), to: -0.2, ..plan().1 };
        let found = branches(&system, &plan, &Control::default()).unwrap();
        let [branch] = found.followed.as_slice() else { panic!("{} branches", found.followed.len()) };
        let [.., over, last] = &branch.points[..] else { panic!("{:?}", branch.points) };
        assert!(matches!(over.event, Some(BranchEvent::Sticking { begins: false, .. })) && over.value < -0.36);
        assert_eq!((last.event, last.value), (Some(BranchEvent::ImpactLimit), over.value));
        assert!(branch.points.iter().all(|point| point.stable() && point.cycle.rests.len() == 1));
        // at gap 0 there is no such orbit
        let nothing = branches(&SystemPlan { gap: 0.0, ..system }, &plan, &Control::default()).unwrap_err().to_string();
        assert!(nothing.starts_with("no admissible orbit inf/1 was found"), "{nothing}");
    }

    fn hammer() -> MachineSource {
        CATALOGUE.iter().find(|entry| entry.name == "two-mass-hammer").unwrap().source().unwrap()
    }

    fn asked(vary: &str, to: f64, also: Option<(&str, f64)>) -> BranchPlan<String> {
        let also = also.map(|(path, to)| Target { parameter: path.to_owned(), to });
        BranchPlan { label: None, orbit: None, vary: vary.to_owned(), to, back: None, also, points: 500, follow: 0 }
    }

    fn followed(source: &MachineSource, plan: &BranchPlan<String>) -> Branches<Cycle, SolutionPoint> {
        let plan = Plan::new(source.clone(), Task::from(plan.clone()));
        let PlanResults::Machine(Results::Branch(found)) = run(&plan, &Control::default()).unwrap() else { panic!() };
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
}

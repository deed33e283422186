//! Branches of periodic orbits in one parameter or along a line through two, and the branches that begin at their flips
//! and branch points.

use crate::chosen::{Chosen, choose, label};
use crate::diagram::{DEFAULT_KEEP, DEFAULT_TRANSIENT, Show, SweepDirection};
use crate::name::{Name, Written};
use crate::{
    Control, Cut, DiagramPlan, Parameter, PlanError, RunError, Span, Stopped, Stretch, SystemPlan, Target, limits,
};
use core::ops::RangeInclusive;
use serde::{Deserialize, Serialize};
use vibroimpact::continuation::{Branch, BranchError, BranchEvent, BranchOptions, Direction, SolutionPoint};
use vibroimpact::orbit::Cycle;
use vibroimpact::verdict::Count;
use vibroimpact::{Label, Oscillator, ParameterPath};

/// Default maximum number of points of a branch.
pub const DEFAULT_BRANCH_POINTS: u32 = 5_000;
/// Maximum number of further branches.
pub(crate) const MOST_FOLLOWED: u32 = 100;
/// Number of values of the orbit diagram drawn behind a branch.
pub(crate) const DIAGRAM_VALUES: u32 = 401;

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
    #[schemars(with = "Written<V>")]
    pub vary: V,
    /// The other end of its range.
    pub to: f64,
    /// A second number that varies with it, in proportion, from its value in the system.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub also: Option<Target<V>>,
    /// Which of the orbits, counted from 1, the fastest last; when absent the stable one, else the fastest motion.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub orbit: Option<u32>,
    /// How many of the branches that begin at flips and branch points are followed as well: 0 to 100.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub follow: u32,
    /// Points of each branch at most.
    #[serde(default = "points")]
    pub points: u32,
}

#[allow(clippy::trivially_copy_pass_by_ref)] // serde passes a reference
const fn is_zero(count: &u32) -> bool {
    *count == 0
}

const fn points() -> u32 {
    DEFAULT_BRANCH_POINTS
}

impl<V> BranchPlan<V> {
    /// The same with other names of the numbers that vary.
    pub(crate) fn named<W, E>(&self, name: &impl Fn(&V) -> Result<W, E>) -> Result<BranchPlan<W>, E> {
        let Self { label, to, orbit, follow, points, .. } = self;
        let also = self.also.as_ref().map(|also| also.named(name)).transpose()?;
        let (label, vary) = (label.clone(), name(&self.vary)?);
        Ok(BranchPlan { label, vary, to: *to, also, orbit: *orbit, follow: *follow, points: *points })
    }
}

impl BranchPlan {
    /// Checks everything that can be checked without running the plan.
    ///
    /// # Errors
    /// [`PlanError`] names the first invalid value.
    pub fn check(&self, system: &SystemPlan) -> Result<(), PlanError> {
        label(self.label.as_deref())?;
        let cut = self.cut(system)?;
        cut.check(system)?;
        if cut.ends.0 == self.to {
            return Err(PlanError::Nowhere { name: self.vary.name().into(), value: self.to });
        }
        limits::check("follow", self.follow, 0..=MOST_FOLLOWED)?;
        limits::branch_points(self.points)
    }

    /// The line along which the orbit is followed.
    ///
    /// # Errors
    /// [`PlanError`] for an invalid system, or for a parameter of a second stop if there is none.
    pub fn cut(&self, system: &SystemPlan) -> Result<Cut, PlanError> {
        let from = |Target { parameter, to }| system.value(parameter).map(|from| Stretch { parameter, from, to });
        let also = self.also.map(from).transpose()?;
        Ok(Cut { vary: self.vary, ends: (system.value(self.vary)?, self.to), also })
    }

    /// The plan of an orbit diagram over the same range.
    ///
    /// # Errors
    /// [`PlanError`] for an invalid plan.
    pub fn diagram(&self, system: &SystemPlan) -> Result<DiagramPlan, PlanError> {
        let Cut { vary, ends, also } = self.cut(system)?;
        Ok(DiagramPlan {
            vary,
            over: Span::new(ends.0, ends.1, DIAGRAM_VALUES)?.into(),
            also,
            show: Show::Velocity,
            direction: SweepDirection::Both,
            transient: DEFAULT_TRANSIENT,
            keep: DEFAULT_KEEP,
        })
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
    /// Its points.
    pub points: Vec<P>,
}

/// A branch, the branches that begin on it, the branches that begin on those, and so on.
#[derive(Clone, Debug, PartialEq)]
pub struct Branches<C = Cycle, P = SolutionPoint> {
    /// The orbit at which the first branch begins.
    pub chosen: Chosen<C>,
    /// All branches; the branch of the chosen orbit comes first.
    pub followed: Vec<Followed<P>>,
    /// Events of an oscillator at which a further branch was expected but could not be followed.
    pub lost: Vec<Origin<P>>,
}

/// Follows the orbit of a plan and the branches that begin on its branch.
///
/// # Errors
/// [`RunError`] for an invalid plan, for an orbit that does not exist, or when stopped. The stop flag is read at every
/// seed of the search and at every point.
pub(crate) fn branches(system: &SystemPlan, plan: &BranchPlan, control: &Control<'_>) -> Result<Branches, RunError> {
    plan.check(system)?;
    let osc = system.oscillator()?;
    let cut = plan.cut(system)?;
    let vary = cut.varying(system, cut.ends.0)?;
    let from = vary.get(&osc).map_err(PlanError::from)?;
    let label = label(plan.label.as_deref())?;
    let stopped = |done: usize| Stopped { done: done as u64, total: u64::from(plan.follow) + 1 };
    let chosen = choose(&osc, label, plan.orbit, &|| !control.stopping())?.ok_or_else(|| stopped(0))?;
    let range = from.min(plan.to)..=from.max(plan.to);
    let direction = if plan.to > from { Direction::Up } else { Direction::Down };
    let options = BranchOptions { points: plan.points, ..BranchOptions::default() };
    let first = Branch::new(&osc, &chosen.cycle, vary.clone(), range.clone(), direction, options);
    let ground = Ground { osc, vary, range, options, control };
    let points = ground.points(first.map_err(PlanError::from)?);
    let mut all = Branches { chosen, followed: vec![Followed { origin: None, points }], lost: Vec::new() };
    all.follow(&ground, plan.follow as usize);
    if control.stopping() {
        return Err(stopped(all.followed.len() - 1).into());
    }
    Ok(all)
}

/// The data common to all branches of a plan.
struct Ground<'a, 'c> {
    osc: Oscillator,
    vary: ParameterPath,
    range: RangeInclusive<f64>,
    options: BranchOptions,
    control: &'a Control<'c>,
}

impl Ground<'_, '_> {
    /// The points of a branch; ends early when the run is stopped.
    fn points(&self, branch: Branch) -> Vec<SolutionPoint> {
        branch.take_while(|_| !self.control.stopping()).collect()
    }

    /// The branches that begin at an event.
    fn from(&self, point: &SolutionPoint) -> Result<Vec<Branch>, BranchError> {
        let range = self.range.clone();
        if point.event == Some(BranchEvent::Flip) {
            return Ok(vec![Branch::from_flip(&self.osc, point, self.vary.clone(), range, self.options)?]);
        }
        let both = Branch::from_branch_point(&self.osc, point, self.vary.clone(), range, self.options)?;
        Ok(both.into_iter().collect())
    }
}

/// Two values of the parameter are the same event if they differ by less than this, relative to their size.
const SAME: f64 = 1e-7;

impl Branches {
    /// Follows the branches that begin at the events of all branches so far, until there are `most` further branches.
    fn follow(&mut self, ground: &Ground<'_, '_>, most: usize) {
        let mut seen: Vec<(f64, Label)> = Vec::new();
        let mut at = 0;
        while at < self.followed.len() && self.followed.len() <= most {
            let begins = |point: &&SolutionPoint| {
                matches!(point.event, Some(BranchEvent::Flip | BranchEvent::BranchPoint)) && point.physical
            };
            let origins: Vec<SolutionPoint> = self.followed[at].points.iter().filter(begins).cloned().collect();
            for point in origins {
                let known = |(value, label): &(f64, Label)| {
                    *label == point.cycle.label && (value - point.value).abs() <= SAME * (1.0 + value.abs())
                };
                if seen.iter().any(known) || self.followed.len() > most {
                    continue;
                }
                seen.push((point.value, point.cycle.label));
                let origin = Origin { branch: at, point };
                match ground.from(&origin.point) {
                    Ok(found) => {
                        for branch in found.into_iter().take(most + 1 - self.followed.len()) {
                            let points = ground.points(branch);
                            seen.extend(points.iter().filter_map(other_end));
                            self.followed.push(Followed { origin: Some(origin.clone()), points });
                        }
                    }
                    Err(_) => self.lost.push(origin),
                }
            }
            at += 1;
        }
    }
}

/// The flip at which a branch of twice the period ends. The branch that begins at this flip is already known.
fn other_end(point: &SolutionPoint) -> Option<(f64, Label)> {
    let Count::Finite(impacts) = point.cycle.label.impacts else { return None };
    let half = Label::new(impacts / 2, point.cycle.label.periods / 2);
    (point.event == Some(BranchEvent::Halving)).then_some((point.value, half))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Plan, Task};

    fn plan() -> (SystemPlan, BranchPlan) {
        let system = SystemPlan { inverse_beta: Some(1.11), gap: 1.5, restitution: 0.5, ..SystemPlan::default() };
        let branch = BranchPlan {
            label: Some("1/1".into()),
            vary: Parameter::Gap,
            to: 2.5,
            also: None,
            orbit: None,
            follow: 0,
            points: 5000,
        };
        (system, branch)
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
    fn it_stops_when_told_to() {
        let (system, plan) = plan();
        let stop = core::sync::atomic::AtomicBool::new(true);
        let stopped = branches(&system, &plan, &Control { stop: &stop, ..Control::default() });
        assert!(matches!(stopped, Err(RunError::Stopped(_))), "{stopped:?}");
    }

    #[test]
    fn an_orbit_that_rests() {
        let system = SystemPlan { inverse_beta: Some(1.11), gap: -0.5, restitution: 0.5, ..SystemPlan::default() };
        let plan = BranchPlan { label: Some("inf/1".into()), to: -0.2, ..plan().1 };
        let found = branches(&system, &plan, &Control::default()).unwrap();
        let [branch] = found.followed.as_slice() else { panic!("{} branches", found.followed.len()) };
        let last = branch.points.last().unwrap();
        assert!(matches!(last.event, Some(BranchEvent::EndOfRest { .. })) && last.value < -0.36);
        assert!(branch.points.iter().all(|point| point.stable() && point.cycle.rests.len() == 1));
        // at gap 0 there is no such orbit
        let nothing = branches(&SystemPlan { gap: 0.0, ..system }, &plan, &Control::default()).unwrap_err().to_string();
        assert!(nothing.starts_with("no admissible orbit inf/1 was found"), "{nothing}");
    }

    #[test]
    fn a_plan_survives_json_and_nonsense_is_refused() {
        let (system, good) = plan();
        let whole = Plan::new(system, Task::from(good.clone()));
        assert_eq!(whole.check(), Ok(()));
        let text = serde_json::to_string(&whole).unwrap();
        assert_eq!(serde_json::from_str::<Plan>(&text).unwrap(), whole);
        let short: BranchPlan = serde_json::from_str(r#"{"label": "1/1", "vary": "gap", "to": 2.5}"#).unwrap();
        assert_eq!(short, good);
        for (branch, sentence) in [
            (BranchPlan { label: Some("1/0".into()), ..good.clone() }, "label `1/0` is not m/n"),
            (BranchPlan { to: 1.5, ..good.clone() }, "gap is to go from 1.5 to 1.5"),
            (BranchPlan { to: f64::NAN, ..good.clone() }, "gap delta = NaN"),
            (BranchPlan { vary: Parameter::SecondGap, ..good.clone() }, "second_gap is to vary"),
            (BranchPlan { follow: 101, ..good.clone() }, "follow = 101 lies outside 0 <= follow <= 100"),
            (BranchPlan { points: 1, ..good.clone() }, "points = 1 lies outside 2 <= points <= 100000"),
        ] {
            let message = branch.check(&system).unwrap_err().to_string();
            assert!(message.starts_with(sentence), "{message}");
        }
    }
}

//! The nearest event of a motion in each number of its system, up and down.

use super::plan::MarginsPlan;
use super::scope::Scope;
use super::tried_box::MotionBox;
use crate::dynamics::{Dynamics, PointOf, Setup};
use crate::orbit_line::Solution;
use crate::{Control, Cut, Parameter, RunError};
use vibroimpact::Oscillator;
use vibroimpact::continuation::{Direction, SolutionPoint};
use vibroimpact::verdict::{Label, System, Verdict};

/// The distances of a motion of any system from its nearest events.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionMargins<S: System = Oscillator, V = Parameter, P = SolutionPoint> {
    /// The motion.
    pub motion: Verdict<S>,
    /// The nearest events in each number; empty for a motion that is not periodic.
    pub parameters: Vec<ParameterMargin<V, P>>,
    /// The box in which the motion was found; `None` for a motion that is not periodic, or not stable, and for a machine.
    pub motion_box: Option<MotionBox>,
}

/// The nearest events in one number.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterMargin<V = Parameter, P = SolutionPoint> {
    /// The number, its range and its scale.
    pub scope: Scope<V>,
    /// The nearest event at a smaller value.
    pub down: MarginEnd<P>,
    /// The nearest event at a larger value.
    pub up: MarginEnd<P>,
}

/// The nearest event in one direction.
#[derive(Clone, Debug, PartialEq)]
pub struct MarginEnd<P = SolutionPoint> {
    /// The value of the number at the event; without an event the end of the range.
    pub value: f64,
    /// The point of the branch with its event; `None` if there is no event up to the end of the range.
    pub point: Option<P>,
    /// The label beyond the event; `None` if there is none, or if the branch ends.
    pub after: Option<Label>,
}

impl<P> MarginEnd<P> {
    /// The change of the number to this end.
    #[must_use]
    pub fn distance<V>(&self, scope: &Scope<V>) -> f64 {
        self.value - scope.value
    }

    /// The change relative to the size of the value; `None` for a value 0.
    #[must_use]
    pub fn relative<V>(&self, scope: &Scope<V>) -> Option<f64> {
        (scope.value != 0.0).then(|| self.distance(scope) / scope.value.abs())
    }

    /// The size of the change in units of the scale of the number.
    #[must_use]
    pub fn scaled<V>(&self, scope: &Scope<V>) -> f64 {
        self.distance(scope).abs() / scope.scale
    }
}

impl<V, P> ParameterMargin<V, P> {
    /// Both ends, the lower one first, with their names and the ends of the range.
    #[must_use]
    pub const fn ends(&self) -> [(&'static str, f64, &MarginEnd<P>); 2] {
        [("down", self.scope.low, &self.down), ("up", self.scope.high, &self.up)]
    }
}

impl<S: System, V, P> MotionMargins<S, V, P> {
    /// The number, the direction and the end of the event with the smallest change in units of the scale of its number; `None`
    /// if there is no event in the ranges.
    #[must_use]
    pub fn nearest(&self) -> Option<(&ParameterMargin<V, P>, &'static str, &MarginEnd<P>)> {
        let ends = self.parameters.iter().flat_map(|one| one.ends().map(|(way, _, end)| (one, way, end)));
        let events = ends.filter(|(.., end)| end.point.is_some());
        events.min_by(|(a, _, one), (b, _, other)| one.scaled(&a.scope).total_cmp(&other.scaled(&b.scope)))
    }
}

/// The largest number of points of a branch.
const MOST_POINTS: u32 = 20_000;

/// The margins of a motion of a system.
type MarginsOf<D> = MotionMargins<<D as Dynamics>::System, <D as Dynamics>::Name, PointOf<D>>;

/// The motion of a plan, its nearest events, and the box in which it was found.
///
/// # Errors
/// [`RunError`] for a label that no orbit has, for an orbit that cannot be followed, or when stopped. The stop flag is read at every
/// seed of the search, at every impact, at every point of a branch and at every line of the box.
pub(crate) fn margins<D: Dynamics>(
    of: &Setup<'_, D>,
    plan: &MarginsPlan<D::Name>,
    control: &Control<'_>,
) -> Result<MarginsOf<D>, RunError> {
    let motion = match &plan.label {
        Some(label) => Verdict::Periodic(of.chosen((Some(label), None), control)?.cycle),
        None => D::settle(&of.system, &of.start, None, &|| !control.stopping())?.verdict,
    };
    let mut all = MotionMargins { motion, parameters: Vec::new(), motion_box: None };
    let Some(cycle) = D::cycle(&of.system, &all.motion) else { return Ok(all) };
    for scope in plan.scopes(of.written)? {
        let cut = Cut { vary: scope.parameter.clone(), ends: (scope.low, scope.high), also: None };
        let line = of.written.line(&cut, scope.value, MOST_POINTS)?;
        let end = |limit: f64, direction| {
            let at = (scope.value, &cycle);
            let found = if limit == scope.value { None } else { line.first_event(at, direction, control)? };
            Ok::<_, RunError>(match found {
                Some((point, after)) => MarginEnd { value: point.value(), point: Some(point), after },
                None => MarginEnd { value: limit, point: None, after: None },
            })
        };
        let (down, up) = (end(scope.low, Direction::Down)?, end(scope.high, Direction::Up)?);
        all.parameters.push(ParameterMargin { scope, down, up });
        (control.progress)(all.parameters.len() as u64);
    }
    all.motion_box = of.written.motion_box(&cycle, &all.parameters, plan, control)?;
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SystemPlan;
    use crate::dynamics::at_rest;
    use crate::machine::MachineSource;
    use crate::margins::{Loss, ScaledParameter};
    use crate::{BranchPlan, Parameter, Plan, PlanResults, Results, SecondStop, StartPlan, Task, run};
    use vibroimpact::continuation::BranchEvent;
    use vibroimpact::orbit::one_impact;

    /// The gaps of the fold and of the flip of 1/1 in closed form, from the amplitude equations.
    fn fold_and_flip(beta: f64, eps: f64, zeta: f64) -> (f64, f64) {
        let (wd, period) = ((1.0 - zeta * zeta).sqrt(), core::f64::consts::TAU / beta);
        let (e, c, s) = ((-zeta * period).exp(), (wd * period).cos(), (wd * period).sin());
        let (m11, m12, m22) = (e * (c + zeta * s / wd), e * s / wd, e * (c - zeta * s / wd));
        let den = m11 + m22 - 1.0 - e * e;
        let (a, b) = ((1.0 + eps) * m12 / den, 1.0 - (1.0 + eps) * (m22 - e * e) / den);
        let f = 1.0 / ((1.0 - beta * beta).powi(2) + (2.0 * zeta * beta).powi(2)).sqrt();
        let q = (-(1.0 + (eps * e).powi(2)) + 2.0 * eps * e * c) / ((1.0 + eps) * m12);
        let rho = -(q + (1.0 - beta * beta) * a - 2.0 * zeta * b) / (beta * beta);
        let velocity = f / ((rho - a).powi(2) + (b / beta).powi(2)).sqrt();
        (f * (1.0 + (beta * a / b).powi(2)).sqrt() * a.signum(), rho * velocity)
    }

    fn found(system: &SystemPlan, plan: &MarginsPlan) -> MotionMargins {
        margins(&system.setup(plan.start()).unwrap(), plan, &Control::default()).unwrap()
    }

    /// Whether 1/1 exists and is stable, from its closed form.
    fn one_exists(osc: &Oscillator) -> bool {
        one_impact(osc, 1).iter().any(|orbit| orbit.physical && orbit.cycle.stable())
    }

    fn one() -> MarginsPlan {
        MarginsPlan { label: Some("1/1".into()), ..MarginsPlan::default() }
    }

    const SYSTEM: SystemPlan =
        SystemPlan { beta: Some(1.0 / 1.11), inverse_beta: None, ..SystemPlan::from_inverse_beta(1.11, 1.5, 0.5) };

    #[test]
    fn the_distances_are_those_of_the_closed_form() {
        let (_, flip) = fold_and_flip(1.0 / 1.11, 0.5, 0.0);
        assert!((flip - 1.829_006_189_683_6).abs() < 1e-12);
        let all = found(&SYSTEM, &one());
        let names: Vec<_> = all.parameters.iter().map(|of| of.scope.parameter).collect();
        assert_eq!(names, [Parameter::Beta, Parameter::Gap, Parameter::Restitution, Parameter::Damping]);
        let gap = &all.parameters[1];
        assert_eq!(gap.up.point.as_ref().and_then(|point| point.event), Some(BranchEvent::Flip));
        assert!((gap.up.distance(&gap.scope) - (flip - 1.5)).abs() < 1e-11);
        assert!((gap.up.relative(&gap.scope).unwrap() - (flip - 1.5) / 1.5).abs() < 1e-11);
        // the flip in the restitution: in closed form the gap of the flip is that of the system
        let eps = &all.parameters[2];
        let flips = |end: &&MarginEnd| end.point.as_ref().is_some_and(|point| point.event == Some(BranchEvent::Flip));
        let event = [&eps.down, &eps.up].into_iter().find(flips).unwrap();
        assert!((fold_and_flip(1.0 / 1.11, event.value, 0.0).1 - 1.5).abs() < 1e-9, "{event:?}");
        // without damping it is the lower end of its range
        let damping = &all.parameters[3];
        assert_eq!((damping.down.value, damping.down.point.is_none()), (0.0, true));
        // a fold: the larger gap at which the damped motion exists
        let system = SystemPlan { beta: Some(1.4), restitution: 0.7, damping: 0.05, gap: 2.0, ..SYSTEM };
        let (fold, _) = fold_and_flip(1.4, 0.7, 0.05);
        let gap = &found(&system, &one()).parameters[1];
        assert_eq!(gap.up.point.as_ref().and_then(|point| point.event), Some(BranchEvent::Fold));
        assert!((gap.up.value - fold).abs() < 1e-9, "{} {fold}", gap.up.value);
    }

    #[test]
    fn the_events_are_those_of_the_branches() {
        let system = SystemPlan { beta: Some(1.0259), gap: 0.6, restitution: 0.65, damping: 0.02, ..SYSTEM };
        let all = found(&system, &MarginsPlan::default());
        let mut events = 0;
        for margin in &all.parameters {
            for (_, limit, end) in margin.ends() {
                let usual = BranchPlan::new(margin.scope.parameter, limit);
                let task = BranchPlan { label: Some("1/1".into()), points: 20_000, ..usual };
                let branches = crate::branch::branches(&at_rest(&system), &task, &Control::default()).unwrap();
                let points = &branches.followed[0].points;
                let first = points.iter().find(|point| point.event.is_some()).unwrap();
                assert!((first.value - end.value).abs() < 1e-9 * (1.0 + end.value.abs()), "{margin:?}");
                assert_eq!(first.event.unwrap() == BranchEvent::EndOfRange, end.point.is_none());
                events += usize::from(end.point.is_some());
            }
        }
        assert!(events >= 3, "{events}");
        let (margin, _, end) = all.nearest().unwrap();
        let size = |margin: &ParameterMargin, end: &MarginEnd| end.relative(&margin.scope).unwrap().abs();
        for other in &all.parameters {
            for (.., one) in other.ends().into_iter().filter(|(.., one)| one.point.is_some()) {
                assert!(size(margin, end) <= size(other, one));
            }
        }
    }

    /// The motion exists at other points of the box than those that were tried, and does not exist at its edge.
    #[test]
    fn the_box_contains_the_motion_and_ends_where_it_is_lost() {
        let system = SystemPlan { damping: 0.01, ..SYSTEM };
        let all = found(&system, &one());
        let found = all.motion_box.as_ref().unwrap();
        assert!(found.size > 0.01 && found.size <= found.largest, "{found:?}");
        assert!(found.lines > 8 + 16 + 200 && found.points > 1000, "{found:?}");
        let at = |values: &[f64]| {
            let values = all.parameters.iter().zip(values);
            values.fold(system, |of, (one, value)| of.with(one.scope.parameter, *value).unwrap()).oscillator().unwrap()
        };
        // a linear congruential generator
        let mut state = 12_345_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            f64::from(u32::try_from(state >> 32).unwrap()) / f64::from(u32::MAX)
        };
        for _ in 0..2000 {
            let size = found.size;
            let values: Vec<f64> =
                all.parameters.iter().map(|one| one.scope.at(size * (2.0 * random() - 1.0))).collect();
            assert!(one_exists(&at(&values)), "{values:?} {found:?}");
        }
        let edge = found.edge.as_ref().unwrap();
        assert!(edge.loss == Loss::Unstable && !one_exists(&at(&edge.values)), "{edge:?}");
        // a box in one parameter ends at its nearest event
        let vary = vec![ScaledParameter { parameter: Parameter::Gap, scale: Some(0.1) }];
        let alone = margins(&at_rest(&system), &MarginsPlan { vary, ..one() }, &Control::default()).unwrap();
        let (margin, _, end) = alone.nearest().unwrap();
        let (size, to) = (alone.motion_box.as_ref().unwrap().size, end.distance(&margin.scope).abs() / 0.1);
        assert!(size <= to && size > to * (1.0 - 1e-5), "{size} {to}");
    }

    #[test]
    fn motions_without_margins_and_other_motions() {
        // chaos
        let chaos = found(&SystemPlan { gap: 3.0, ..SYSTEM }, &MarginsPlan::default());
        assert!(
            matches!(chaos.motion, Verdict::Chaotic(_)) && chaos.parameters.is_empty() && chaos.motion_box.is_none()
        );
        // without damping motions without impacts are many
        let far = found(&SystemPlan { gap: 40.0, ..SYSTEM }, &MarginsPlan::default());
        assert!(matches!(far.motion, Verdict::NoImpact(_)) && far.parameters.is_empty());
        // with damping there is one; it reaches the stop where the amplitude is the gap
        let system = SystemPlan { beta: Some(2.0), gap: 0.4, damping: 0.1, ..SYSTEM };
        let free = found(&system, &MarginsPlan::default());
        let gap = &free.parameters[1];
        assert!(gap.down.point.as_ref().and_then(Solution::event_name) == Some("grazing"));
        assert!((gap.down.value - system.oscillator().unwrap().free_amplitude()).abs() < 1e-12);
        assert!(free.motion_box.unwrap().size > 0.0);
        // an unstable orbit has distances, and no box
        let slow = found(&SystemPlan { gap: 2.0, ..SYSTEM }, &one());
        assert!(slow.motion_box.is_none() && slow.parameters.len() == 4);
        // a motion that sticks
        let rests = found(&SystemPlan { gap: -0.5, ..SYSTEM }, &MarginsPlan::default());
        assert_eq!(rests.motion.label(), "inf/1");
        assert!(rests.motion_box.unwrap().size > 0.0 && rests.parameters[1].up.point.is_some());
        // two stops
        let second_stop = Some(SecondStop { gap: 1.0, restitution: 0.6 });
        let two = SystemPlan { beta: Some(0.8), gap: 1.0, restitution: 0.6, damping: 0.05, second_stop, ..SYSTEM };
        let both = found(&two, &MarginsPlan::default());
        assert!(
            both.parameters.len() == 6 && both.motion_box.unwrap().lines > 12 + 64 + 200,
            "{:?}",
            both.motion.label()
        );
        // the start decides which motion it is
        let other = StartPlan { v: 1.0, ..StartPlan::default() };
        let plan = Plan::new(SYSTEM, Task::Margins(MarginsPlan { start: Some(other), ..MarginsPlan::default() }));
        let found = run(&plan, &Control::default());
        assert!(matches!(found, Ok(PlanResults::Oscillator(Results::Margins(_)))));
    }

    #[test]
    fn it_stops_when_told_to() {
        let stop = core::sync::atomic::AtomicBool::new(true);
        let stopped = margins(&at_rest(&SYSTEM), &one(), &Control { stop: &stop, ..Control::default() });
        assert!(matches!(stopped, Err(RunError::Stopped(_))), "{stopped:?}");
    }

    /// The nearest events are those of the branches in each number alone.
    #[test]
    fn the_first_events_of_branches() {
        let source = MachineSource::open("two-mass-hammer").unwrap();
        let vary = vec!["frequency".to_owned(), "stop.anvil.gap".to_owned(), "stop.anvil.restitution".to_owned()];
        let scaled = vary.iter().map(|path| ScaledParameter { parameter: path.clone(), scale: None });
        let task = Task::from(MarginsPlan { vary: scaled.collect(), ..MarginsPlan::default() });
        let plan = Plan::new(source.clone(), task);
        assert_eq!(Plan::from_text(&plan.to_toml()).unwrap(), plan);
        let PlanResults::Machine(Results::Margins(found)) = run(&plan, &Control::default()).unwrap() else { panic!() };
        assert_eq!(found.motion.label(), "1/1");
        let mut events = 0;
        for (margin, path) in found.parameters.iter().zip(vary) {
            for (_, limit, end) in margin.ends() {
                let plan = Plan::new(source.clone(), Task::from(BranchPlan::new(path.clone(), limit)));
                let PlanResults::Machine(Results::Branch(branch)) = run(&plan, &Control::default()).unwrap() else {
                    panic!()
                };
                let first = branch.followed[0].points.iter().find(|point| point.event.is_some()).unwrap();
                match &end.point {
                    Some(point) => {
                        let apart = (point.value - first.value).abs();
                        assert!(apart < 1e-9 && point.event == first.event, "{path} {point:?}");
                        events += 1;
                    }
                    None => assert!(first.value == limit, "{path} {:?}", first.event),
                }
            }
        }
        assert!(events >= 2 && found.nearest().is_some(), "{events}");
    }
}

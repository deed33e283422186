//! Curves of events of an orbit of any system in a plane of two numbers. A curve begins at an event on a branch in the first one.

use crate::chosen::Chosen;
use crate::dynamics::{CycleOf, Dynamics, PointOf, Setup, not_stopped};
use crate::name::{Name, renamed};
use crate::orbit_line::{Along, OrbitLine, Solution};
use crate::{Control, Parameter, PlanError, RunError, Stretch, limits};
use serde::{Deserialize, Serialize};
use vibroimpact::continuation::{CurveEvent, CurvePoint, Direction, SolutionPoint};
use vibroimpact::math::sort_by;
use vibroimpact::orbit::Cycle;
use vibroimpact::verdict::System;

/// What holds along a curve. Torus, corner, sticking and holding are of machines only.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FollowedEvent {
    /// A multiplier is +1 and the numbers turn.
    Fold,
    /// A multiplier is -1.
    Flip,
    /// A pair of complex multipliers lies on the unit circle.
    Torus,
    /// A stop is touched with speed zero.
    Grazing,
    /// Two events happen at the same time.
    Corner,
    /// A rest on a stop begins or ends to be a part of the orbit.
    Sticking,
    /// A friction joint begins or ends to hold in the orbit.
    Holding,
}

impl FollowedEvent {
    /// Its name in plans and tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Fold => "fold",
            Self::Flip => "flip",
            Self::Torus => "torus",
            Self::Grazing => "grazing",
            Self::Corner => "corner",
            Self::Sticking => "sticking",
            Self::Holding => "holding",
        }
    }
}

/// A curve through an event of the branch of an orbit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields, bound = "V: Name")]
#[schemars(rename = "CurvePlan", bound = "V: Name")]
pub struct CurvePlan<V = Parameter> {
    /// The label of the orbit at the system given; a machine has that of the motion from its start when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub label: Option<String>,
    /// What holds along the curve.
    pub kind: FollowedEvent,
    /// The number in which the orbit is followed to the event, and its range.
    pub vary: Stretch<V>,
    /// The other one.
    pub and: Stretch<V>,
    /// Which of the orbits, as for a branch.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub orbit: Option<u32>,
    /// Which of the events of that kind, counted from 1 from small values to large; when absent the nearest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub event: Option<u32>,
    /// The largest number of points in each direction: 2 to 100000. 20000, or 5000 of a machine, when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub points: Option<u32>,
}

renamed!(CurvePlan: names, parts vary and, others label kind orbit event points);

impl<V> CurvePlan<V> {
    /// The curve through the nearest event of the orbit with a label.
    #[must_use]
    pub fn new(label: &str, kind: FollowedEvent, vary: Stretch<V>, and: Stretch<V>) -> Self {
        Self { label: Some(label.to_owned()), kind, vary, and, orbit: None, event: None, points: None }
    }
}

impl<V: Name> CurvePlan<V> {
    /// Checks everything that can be checked without running the plan.
    pub(crate) fn check<D: Dynamics<Name = V>>(&self, of: &Setup<'_, D>) -> Result<(), PlanError> {
        of.check_orbit((self.label.as_deref(), self.orbit), true)?;
        D::check_curve(self.kind)?;
        self.points.map_or(Ok(()), limits::branch_points)?;
        of.written.check_plane(&self.vary, &self.and)?;
        for stretch in [&self.vary, &self.and] {
            let value = of.written.number(&stretch.parameter)?;
            let Stretch { parameter, from, to } = stretch;
            if !(*from..=*to).contains(&value) {
                let outside = format!("{} = {value} lies outside the range from {from} to {to}", parameter.text());
                let hint = "the orbit to begin with is looked for at the system given";
                return Err(PlanError::refused(format!("{outside}\nhint: {hint}")));
            }
        }
        Ok(())
    }
}

/// A curve of any system, followed in both directions from the event at which it begins.
#[derive(Clone, Debug, PartialEq)]
pub struct EventCurve<C = Cycle, E = SolutionPoint, P = CurvePoint> {
    /// The orbit whose branch contains the event.
    pub chosen: Chosen<C>,
    /// The stop or joint of a curve of grazing, sticking or holding of a machine, or the stops and joints of a corner.
    pub places: Vec<usize>,
    /// The events of the requested kind on its branch, in order of rising values.
    pub events: Vec<E>,
    /// Index of the event through which the curve passes.
    pub through: usize,
    /// The points of the curve from one end to the other.
    pub points: Vec<P>,
    /// Index of the event among the points.
    pub begin: usize,
}

/// A curve of a system.
type CurveOf<D> = EventCurve<CycleOf<D>, PointOf<D>, <D as Dynamics>::CurvePoint>;

/// Follows an orbit in the first number to an event, and then follows the event in the plane.
///
/// # Errors
/// [`RunError`] for an orbit that does not exist, if there is no event of the requested kind, or when stopped. The stop flag is read
/// at every seed of the search and at every point.
pub(crate) fn curve<D: Dynamics>(
    of: &Setup<'_, D>,
    plan: &CurvePlan<D::Name>,
    control: &Control<'_>,
) -> Result<CurveOf<D>, RunError> {
    let chosen = of.chosen((plan.label.as_deref(), plan.orbit), control)?;
    let (line, own) = D::line_of_events(of, plan)?;
    let events = events::<D>(&line, (own, &chosen.cycle), plan, control)?;
    let off = |index: &usize| (events[*index].value() - own).abs();
    let through = match plan.event {
        Some(given) => (given as usize).checked_sub(1).filter(|index| *index < events.len()),
        None => (0..events.len()).min_by(|a, b| off(a).total_cmp(&off(b))),
    };
    let through = through.ok_or_else(|| PlanError::NoEvent {
        kind: plan.kind.name(),
        label: D::System::label(&chosen.cycle),
        name: plan.vary.parameter.text().to_owned().into(),
        from: plan.vary.from,
        to: plan.vary.to,
        count: events.len(),
        asked: plan.event,
    })?;
    let ([forth, back], places) = D::curve(of, plan, line, &events[through])?;
    let forth: Vec<D::CurvePoint> = forth.take_while(|_| !control.stopping()).collect();
    let closed = forth.last().is_some_and(|point| D::curve_event(point) == Some(CurveEvent::Closed));
    // the event itself is the first point of both directions, so one copy is skipped
    let back = back.skip(1).take_while(|_| !control.stopping());
    let mut points: Vec<D::CurvePoint> = if closed { Vec::new() } else { back.collect() };
    not_stopped(control)?;
    points.reverse();
    let begin = points.len();
    points.extend(forth);
    Ok(EventCurve { chosen, places, events, through, points, begin })
}

/// The events of the requested kind on the branch of the orbit, up to both ends of the range, as long as the label is
/// unchanged.
fn events<D: Dynamics>(
    line: &OrbitLine<D::Along>,
    (own, cycle): (f64, &CycleOf<D>),
    plan: &CurvePlan<D::Name>,
    control: &Control<'_>,
) -> Result<Vec<PointOf<D>>, RunError> {
    let label = D::System::label(cycle);
    let mut events: Vec<PointOf<D>> = Vec::new();
    for (direction, beyond) in [(Direction::Up, own >= plan.vary.to), (Direction::Down, own <= plan.vary.from)] {
        if beyond {
            continue;
        }
        let branch = D::Along::branch(line, (own, cycle), direction).map_err(PlanError::from)?;
        for point in branch.take_while(|point| point.label() == label && !control.stopping()) {
            let near = |other: &PointOf<D>| (other.value() - point.value()).abs() <= 1e-9 * (1.0 + point.value().abs());
            if point.is(plan.kind) && !events.iter().any(near) {
                events.push(point);
            }
        }
    }
    not_stopped(control)?;
    sort_by(&mut events, |a, b| a.value().total_cmp(&b.value()));
    Ok(events)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::CATALOGUE;
    use crate::{Body, Parameter, Plan, PlanResults, Results, StartPlan, SystemPlan, Task, run};

    fn curve(system: &SystemPlan, plan: &CurvePlan, control: &Control<'_>) -> Result<EventCurve, RunError> {
        let problem = system.setup(StartPlan::default())?;
        plan.check(&problem)?;
        super::curve(&problem, plan, control)
    }

    fn plan() -> (SystemPlan, CurvePlan) {
        let system = SystemPlan::from_inverse_beta(1.11, 1.5, 0.5);
        let vary = Stretch { parameter: Parameter::Gap, from: 0.0, to: 3.0 };
        let and = Stretch { parameter: Parameter::InverseBeta, from: 1.05, to: 1.2 };
        (system, CurvePlan::new("1/1", FollowedEvent::Flip, vary, and))
    }

    #[test]
    fn the_flip_of_one_impact_a_period() {
        let (system, plan) = plan();
        let found = curve(&system, &plan, &Control::default()).unwrap();
        assert!((found.events[found.through].value - 1.829_006_189_683_6).abs() < 1e-12);
        let at = &found.points[found.begin];
        assert!((at.values.0 - 1.829_006_189_683_6).abs() < 1e-9 && (at.values.1 - 1.11).abs() < 1e-9);
        for point in &found.points {
            let one = point.cycle.multipliers;
            assert!(one.iter().any(|m| (m.re + 1.0).abs() < 1e-6), "{one:?}");
        }
        assert!(found.points[0].event.is_some() && found.points.last().unwrap().event.is_some());
    }

    /// With the frequency held, the gap of the flip in units of the static deflection is one number: in the plane of gap and
    /// force the curve is a straight line through the origin. Over mass and stiffness it is that of one frequency ratio.
    #[test]
    fn numbers_of_a_body() {
        let body = Body {
            mass_kg: Some(0.8),
            stiffness_n_per_m: Some(12e3),
            force_n: Some(30.0),
            damping_ns_per_m: Some(4.0),
            omega_rad_per_s: Some((12e3_f64 / 0.8).sqrt() / 1.11),
            gap_m: Some(3.75e-3),
            restitution: Some(0.5),
            ..Body::default()
        };
        let system = SystemPlan::of_body(&body).unwrap();
        let over = |number, from, to| Stretch { parameter: Parameter::Body(number), from, to };
        let flip = |vary, and| {
            curve(&system, &CurvePlan::new("1/1", FollowedEvent::Flip, vary, and), &Control::default()).unwrap()
        };
        use crate::BodyNumber::{Force, Gap, Stiffness};
        let line = flip(over(Gap, 0.0, 9e-3), over(Force, 15.0, 60.0));
        assert!(line.points.len() > 10);
        let slope = line.events[line.through].value / 30.0;
        for CurvePoint { values: (gap, force), .. } in &line.points {
            assert!((gap / force / slope - 1.0).abs() < 1e-9, "{gap} {force}");
        }
        let (one, other) = (line.points[0].values.1, line.points.last().unwrap().values.1);
        assert!((one - other).abs() > 39.0, "{one} {other} {:?}", line.points.last().unwrap().event);

        // each point of the curve is a flip of the body with that force and stiffness
        let curved = flip(over(Force, 10.0, 60.0), over(Stiffness, 10e3, 14e3));
        assert!(curved.points.len() > 5);
        for CurvePoint { values: (force, stiffness), cycle, .. } in &curved.points {
            let there = Body { force_n: Some(*force), stiffness_n_per_m: Some(*stiffness), ..body };
            let osc = SystemPlan::of_body(&there).unwrap().oscillator().unwrap();
            let again = vibroimpact::orbit::refine(&osc, cycle).expect("an orbit").cycle;
            assert!(
                again.multipliers.iter().any(|m| (m.re + 1.0).abs() + m.im.abs() < 1e-7),
                "{force} {stiffness}: {:?}",
                again.multipliers
            );
        }
    }

    fn of_a_ball(kind: FollowedEvent, event: Option<u32>) -> Plan {
        let entry = CATALOGUE.iter().find(|entry| entry.name == "bouncing-ball").unwrap();
        let source = entry.source().unwrap().with("Gamma", 1.2).unwrap();
        let stretch = |path: &str, from, to| Stretch { parameter: path.to_owned(), from, to };
        let usual = CurvePlan::new("1/1", kind, stretch("Gamma", 0.2, 3.0), stretch("e", 0.2, 0.9));
        Plan::new(source, Task::from(CurvePlan { event, points: Some(500), ..usual }))
    }

    /// The fold of the ball on a table in closed form.
    #[test]
    fn the_ball_on_a_table() {
        let plan = of_a_ball(FollowedEvent::Fold, None);
        let text = serde_json::to_string(&plan).unwrap();
        assert_eq!(serde_json::from_str::<Plan>(&text).unwrap(), plan);
        let PlanResults::Machine(Results::Curve(found)) = run(&plan, &Control::default()).unwrap() else { panic!() };
        assert!(found.points.len() > 20 && found.points[found.begin].event.is_none());
        for point in &found.points {
            let (gamma, e) = point.values;
            assert!((gamma - core::f64::consts::PI * (1.0 - e) / (1.0 + e)).abs() < 1e-9, "{gamma} {e}");
        }
        assert!(found.points[0].event.is_some() && found.points.last().unwrap().event.is_some());
    }

    #[test]
    fn nonsense_is_refused() {
        let told = |plan: &Plan| run(plan, &Control::default()).unwrap_err().to_string();
        assert!(told(&of_a_ball(FollowedEvent::Torus, None)).starts_with("no torus was found on the branch of 1/1"));
        assert!(told(&of_a_ball(FollowedEvent::Flip, Some(4))).starts_with("there is no flip number 4 on the branch"));
        let changed = |of: &dyn Fn(&mut Stretch<String>, &mut Stretch<String>)| {
            let mut plan = of_a_ball(FollowedEvent::Fold, None);
            let Task::Curve(asked) = &plan.task else { panic!() };
            let mut asked: CurvePlan<String> = asked.typed().unwrap();
            let CurvePlan { vary, and, .. } = &mut asked;
            of(vary, and);
            plan.task = asked.into();
            told(&plan)
        };
        assert!(changed(&|_, and| and.to = 1.5).contains("restitution"), "{}", changed(&|_, and| and.to = 1.5));
        assert!(changed(&|vary, _| vary.from = 2.0).starts_with("Gamma = 1.2 lies outside the range from 2 to 3"));
        assert!(changed(&|vary, _| vary.to = -1.0).starts_with("Gamma from 0.2 to -1 is no range"));
        assert!(changed(&|vary, and| *and = vary.clone()).contains("Gamma"));
    }
}

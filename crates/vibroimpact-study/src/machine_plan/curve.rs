//! Curves of events of an orbit of a machine in a plane of two of its numbers. A curve begins at an event on a branch in the
//! first one.

use super::cut::{check_plane, plane};
use super::orbits;
use crate::machine::MachineSource;
use crate::{
    Control, CurvePlan, Cut, DEFAULT_BRANCH_POINTS, EventCurve, FollowedEvent, PlanError, RunError, Stopped, Stretch,
    limits,
};
use vibroimpact::continuation::{
    BranchOptions, CurveEvent, CurveKind, CurveOptions, Direction,
    machine::{Branch, BranchEvent, Curve, CurvePoint, SolutionPoint},
};
use vibroimpact::events::Start;
use vibroimpact::machine::Machine;
use vibroimpact::math::sort_by;
use vibroimpact::orbit::machine::Cycle;

/// Whether an event of a branch is of a kind.
const fn is(kind: FollowedEvent, event: BranchEvent) -> bool {
    match kind {
        FollowedEvent::Fold => matches!(event, BranchEvent::Fold),
        FollowedEvent::Flip => matches!(event, BranchEvent::Flip),
        FollowedEvent::Torus => matches!(event, BranchEvent::Torus),
        FollowedEvent::Grazing => {
            matches!(event, BranchEvent::Grazing { .. } | BranchEvent::LossOfContact { .. })
        }
        FollowedEvent::Corner => matches!(event, BranchEvent::Corner { .. }),
        FollowedEvent::Sticking => matches!(event, BranchEvent::Sticking { .. }),
        FollowedEvent::Holding => matches!(event, BranchEvent::Holding { .. }),
    }
}

/// The longest step: longer than that of the oscillator, because a point takes more work.
const LONGEST: f64 = 0.1;

impl CurvePlan<String> {
    /// Checks the label, both numbers and their ranges.
    pub(crate) fn check(&self, source: &MachineSource, machine: &Machine) -> Result<(), PlanError> {
        orbits::check(machine, (self.label.as_deref(), self.orbit))?;
        let Self { vary, and, points, .. } = self;
        for Stretch { parameter: path, from, to } in [vary, and] {
            let value = source.number(path).map_err(PlanError::from)?;
            let (name, from, to) = (path.clone().into(), *from, *to);
            if from < to && !(from..=to).contains(&value) {
                return Err(PlanError::Outside { name, value, from, to });
            }
        }
        points.map_or(Ok(()), limits::branch_points)?;
        check_plane(source, vary, and)
    }
}

/// Follows an orbit in the first number to an event, and then follows the event in the plane.
pub(super) fn curve(
    source: &MachineSource,
    (machine, start): (&Machine, &Start),
    asked: &CurvePlan<String>,
    control: &Control<'_>,
) -> Result<EventCurve<Cycle, SolutionPoint, CurvePoint>, RunError> {
    let CurvePlan { vary, and, .. } = asked;
    let chosen = orbits::chosen((machine, start), (asked.label.as_deref(), asked.orbit), control)?;
    let cycle = &chosen.cycle;
    let label = cycle.label;
    let stopped = |done| if control.stopping() { Err(Stopped { done, total: 2 }) } else { Ok(()) };
    stopped(0)?;
    let own = source.number(&vary.parameter).map_err(PlanError::from)?;
    let family = Cut { vary: vary.parameter.clone(), ends: (vary.from, vary.to), also: None }.family(source);
    let mut events: Vec<SolutionPoint> = Vec::new();
    for (direction, end) in [(Direction::Up, vary.to), (Direction::Down, vary.from)] {
        if own == end {
            continue;
        }
        let range = vary.from..=vary.to;
        let branch = Branch::new((&family, own), cycle, &range, direction, BranchOptions::default())
            .map_err(|error| PlanError::MachineBranch(error.to_string()))?;
        for point in branch.take_while(|point| point.cycle.label == label && !control.stopping()) {
            let known = |other: &SolutionPoint| (other.value - point.value).abs() <= 1e-9 * (1.0 + point.value.abs());
            if point.event.is_some_and(|event| is(asked.kind, event)) && !events.iter().any(known) {
                events.push(point);
            }
        }
    }
    stopped(0)?;
    sort_by(&mut events, |a, b| a.value.total_cmp(&b.value));
    let off = |index: &usize| (events[*index].value - own).abs();
    let through = match asked.event {
        Some(given) => (given as usize).checked_sub(1).filter(|index| *index < events.len()),
        None => (0..events.len()).min_by(|a, b| off(a).total_cmp(&off(b))),
    };
    let through = through.ok_or_else(|| PlanError::NoEvent {
        kind: asked.kind.name(),
        label,
        name: vary.parameter.clone().into(),
        from: vary.from,
        to: vary.to,
        count: events.len(),
        asked: asked.event,
    })?;
    let plane = plane(source, vary, and);
    let at = (events[through].value, source.number(&and.parameter).map_err(PlanError::from)?);
    let options = CurveOptions { longest: LONGEST, points: asked.points.unwrap_or(DEFAULT_BRANCH_POINTS) };
    let [forth, back] = Curve::through(&plane, at, &events[through], options)
        .map_err(|error| PlanError::MachineBranch(error.to_string()))?;
    let places = match forth.kind() {
        CurveKind::Grazing { stop } | CurveKind::Sticking { stop } => vec![stop],
        CurveKind::Holding { joint } => vec![joint],
        CurveKind::Corner { first, second } => vec![first, second],
        _ => Vec::new(),
    };
    let forth: Vec<CurvePoint> = forth.take_while(|_| !control.stopping()).collect();
    let closed = forth.last().is_some_and(|point| point.event == Some(CurveEvent::Closed));
    // the event itself is the first point of both directions, so one copy is skipped
    let mut points: Vec<CurvePoint> =
        if closed { Vec::new() } else { back.skip(1).take_while(|_| !control.stopping()).collect() };
    stopped(1)?;
    points.reverse();
    let begin = points.len();
    points.extend(forth);
    Ok(EventCurve { chosen, places, events, through, points, begin })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::CATALOGUE;
    use crate::{Plan, Results, Task, machine, run};

    fn plan(kind: FollowedEvent, event: Option<u32>) -> Plan {
        let entry = CATALOGUE.iter().find(|entry| entry.name == "bouncing-ball").unwrap();
        let source = entry.source().unwrap().with("Gamma", 1.2).unwrap();
        let stretch = |path: &str, from, to| Stretch { parameter: path.to_owned(), from, to };
        Plan::new(
            source,
            Task::from(CurvePlan {
                label: Some("1/1".to_owned()),
                orbit: None,
                kind,
                vary: stretch("Gamma", 0.2, 3.0),
                and: stretch("e", 0.2, 0.9),
                event,
                points: Some(500),
            }),
        )
    }

    /// The fold of the ball on a table in closed form.
    #[test]
    fn the_ball_on_a_table() {
        let plan = plan(FollowedEvent::Fold, None);
        let text = serde_json::to_string(&plan).unwrap();
        assert_eq!(serde_json::from_str::<Plan>(&text).unwrap(), plan);
        let Results::Machine(machine::Results::Curve(found)) = run(&plan, &Control::default()).unwrap() else {
            panic!()
        };
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
        assert!(told(&plan(FollowedEvent::Torus, None)).starts_with("no torus was found on the branch of 1/1"));
        assert!(told(&plan(FollowedEvent::Flip, Some(4))).starts_with("there is no flip number 4 on the branch"));
        let changed = |of: &dyn Fn(&mut Stretch<String>, &mut Stretch<String>)| {
            let mut plan = plan(FollowedEvent::Fold, None);
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

//! Orbits, branches and curves of machines that are oscillators, compared with those of the oscillator to the last digit.

use crate::{System, is_long, systems};
use vibroimpact::continuation;
use vibroimpact::continuation::{
    Branch, BranchEvent, BranchOptions, Curve, CurveEvent, CurveOptions, Direction, Frame, SolutionPoint,
    machine::{Family, Plane},
};
use vibroimpact::events::EventKind;
use vibroimpact::machine::{Machine, MachineParts};
use vibroimpact::orbit;
use vibroimpact::orbit::{Cycle, FindOptions, find, find_machine_while};
use vibroimpact::{Label, Oscillator, Parameter, Side, Start};

/// How far a number is changed.
const SPAN: f64 = 0.05;

/// Whether the impacts of a machine in the units of its oscillator are those of the oscillator.
fn same_cycle(own: &orbit::machine::Cycle, cycle: &Cycle) -> bool {
    let impacts = own.events.iter().zip(&cycle.points).all(|(event, point)| {
        let place = if point.state.side == Side::Upper { 0 } else { 1 };
        let (phase, speed) = (point.state.phase, point.state.velocity);
        event.kind == EventKind::Impact && (event.place, event.phase, event.speed) == (place, phase, speed)
    });
    impacts
        && own.events.len() == cycle.points.len()
        && own.label == cycle.label
        && own.multipliers == cycle.multipliers
}

/// The events of a branch of the oscillator that the machine's has too.
fn name(event: BranchEvent) -> Option<&'static str> {
    let only = matches!(event, BranchEvent::Sticking { .. } | BranchEvent::NoConvergence | BranchEvent::ImpactLimit);
    (!only).then(|| event.name())
}

/// How many points of the branch of the machine are those of the oscillator, up to where that of the oscillator ends alone.
fn compared(own: &[continuation::machine::SolutionPoint], other: &[SolutionPoint], text: &str) -> usize {
    let until = other.iter().position(|point| point.event.is_some_and(|event| name(event).is_none()));
    let until = until.unwrap_or(other.len());
    assert!(own.len() >= until, "{text}: {} of {until}", own.len());
    for (a, b) in own.iter().zip(&other[..until]) {
        assert_eq!(a.value, b.value, "{text}");
        assert_eq!(a.event.map(|event| event.name()), b.event.and_then(name), "{text} at {}", b.value);
        assert!(same_cycle(&a.cycle, &b.cycle), "{text} at {}: {:?} {:?}", b.value, a.cycle, b.cycle);
    }
    if until == other.len() {
        assert_eq!(own.len(), until, "{text}");
    }
    until
}

/// The paths of the machine and the parameters that are the same numbers.
const NUMBERS: [(&str, Parameter); 3] = [
    ("stop.upper.gap", Parameter::Gap),
    ("frequency", Parameter::Beta),
    ("stop.upper.restitution", Parameter::Restitution),
];

#[test]
fn branches_to_the_last_digit() {
    let (mut branches, mut points, mut events) = (0, 0, 0);
    let count = if is_long() { 64 } else { 24 };
    let labels = [Label::new(1, 1), Label::new(2, 1), Label::new(1, 2), Label::new(1, 3)];
    let each = systems().flat_map(|system| labels.map(|label| (label, system.clone())));
    for (k, (label, system)) in each.enumerate() {
        let (machine, osc) = (system.machine(), &system.oscillator);
        let orbits: Vec<_> = find(osc, label, FindOptions::default()).into_iter().filter(|of| of.physical).collect();
        let own = find_machine_while(&machine, label, [], &|| true).unwrap();
        if orbits.iter().any(|orbit| !orbit.cycle.rests.is_empty()) {
            continue;
        }
        assert_eq!(own.len(), orbits.len(), "{}", system.text);
        let (Some(orbit), Some(cycle)) = (orbits.last(), own.last()) else { continue };
        assert!(same_cycle(cycle, &orbit.cycle), "{}", system.text);
        let (path, parameter) = NUMBERS[branches % NUMBERS.len()];
        let (family, value) = Family::of_path(&machine, path).unwrap();
        let least = if parameter == Parameter::Gap { value - SPAN } else { value * (1.0 - SPAN) };
        let most = if parameter == Parameter::Restitution { (value + SPAN).min(1.0) } else { value + SPAN };
        if least >= most || value > most || machine.with(path, least).is_err() {
            continue;
        }
        let direction = if k % 3 == 0 { Direction::Up } else { Direction::Down };
        let options = BranchOptions::default();
        let of_oscillator = Branch::new(osc, &orbit.cycle, parameter, least..=most, direction, options);
        let Ok(of_oscillator) = of_oscillator else { continue };
        let of_oscillator: Vec<SolutionPoint> = of_oscillator.collect();
        let of_machine: Vec<continuation::machine::SolutionPoint> =
            continuation::machine::Branch::new((&family, value), cycle, &(least..=most), direction, options)
                .unwrap()
                .collect();
        points += compared(&of_machine, &of_oscillator, &system.text);
        events += of_machine.iter().filter(|point| point.event.is_some()).count();
        assert!(of_machine.last().unwrap().event.unwrap().ends(), "{}", system.text);
        branches += 1;
        if branches == count {
            break;
        }
    }
    assert!(
        branches == count && points > 15 * count && events > count,
        "{branches} branches, {points} points, {events} events"
    );
}

#[test]
fn curves_to_the_last_digit() {
    let (mut curves, mut points) = (0, 0);
    let most = if is_long() { 64 } else { 16 };
    let labels = [Label::new(1, 1), Label::new(2, 1), Label::new(1, 2), Label::new(1, 3)];
    let ways = labels.map(|label| [Direction::Up, Direction::Down].map(|way| (label, way)));
    for (system, (label, way)) in
        systems().flat_map(|system| ways.as_flattened().iter().map(move |way| (system.clone(), *way)))
    {
        let (machine, osc) = (system.machine(), &system.oscillator);
        let gap = osc.gap();
        let orbits: Vec<_> = find(osc, label, FindOptions::default()).into_iter().filter(|of| of.physical).collect();
        let Some(orbit) = orbits.last().filter(|orbit| orbit.cycle.rests.is_empty()) else { continue };
        let own = find_machine_while(&machine, label, [], &|| true).unwrap();
        let ranges = (gap - 1.0..=gap + 1.0, 0.8 * osc.beta()..=1.25 * osc.beta());
        let (family, value) = Family::of_path(&machine, "stop.upper.gap").unwrap();
        let options = BranchOptions::default();
        let at = (&family, value);
        // beyond the other stop the machine is no oscillator
        if machine.with("stop.upper.gap", gap - 1.0).is_err() {
            continue;
        }
        let Ok(branch) = Branch::new(osc, &orbit.cycle, Parameter::Gap, ranges.0.clone(), way, options) else {
            continue;
        };
        let is = |event| matches!(event, Some(BranchEvent::Fold | BranchEvent::Flip));
        let mut branch = branch.take_while(|point| point.cycle.rests.is_empty());
        let Some(event) = branch.find(|point| is(point.event)) else { continue };
        let own = continuation::machine::Branch::new(at, own.last().unwrap(), &ranges.0, way, options).unwrap();
        let is = |event| matches!(event, Some(BranchEvent::Fold | BranchEvent::Flip));
        let Some(own) = own.into_iter().find(|point| is(point.event)) else { continue };
        assert_eq!(own.value, event.value, "{}", system.text);
        let plane = Plane::of_paths(&machine, ("stop.upper.gap", "frequency"), ranges.clone()).unwrap();
        let frame = Frame { plane: (Parameter::Gap, Parameter::Beta).into(), ranges };
        let options = CurveOptions { points: 200, ..CurveOptions::default() };
        let Ok(of_oscillator) = Curve::through(osc, &event, Parameter::Gap, &frame, options) else { continue };
        let of_machine = continuation::machine::Curve::through(&plane, (own.value, osc.beta()), &own, options).unwrap();
        for (one, other) in of_machine.into_iter().zip(of_oscillator) {
            assert_eq!(one.kind(), other.kind());
            let admissible = other.take_while(|point| point.physical);
            let own: Vec<_> = one.collect();
            for (one, other) in own.iter().zip(admissible) {
                let limit = one.event.filter(|event| *event == CurveEvent::StepLimit);
                let name = limit.or(other.event).map(|event| event.name());
                assert_eq!((one.values, one.event.map(|event| event.name())), (other.values, name));
                assert!(same_cycle(&one.cycle, &other.cycle), "{}: {one:?} {other:?}", system.text);
                // where all speeds vanish the multipliers change without bound
                let slow = one.cycle.events.iter().any(|event| event.speed < 1e-3);
                assert!(slow || one.residual < 1e-4 || one.event.is_some(), "{}: {one:?}", system.text);
                points += 1;
            }
            assert!(own.last().is_some_and(|last| last.event.is_some()), "{}", system.text);
        }
        curves += 1;
        if curves == most {
            break;
        }
    }
    assert!(curves == most && points > 1000, "{curves} curves, {points} points");
}

/// The machine of the review: the branch of 4/1 over the gap takes about as long as that of its oscillator.
fn hammer() -> (System, Machine) {
    let oscillator = Oscillator::from_inverse_beta(1.8, 0.25, 0.5).unwrap();
    let system = System { oscillator, start: Start::at_rest(&oscillator), text: String::new() };
    let machine = system.machine();
    (system, machine)
}

/// In other units the branch is the same, in these units, and events have the places of the machine's stops.
#[test]
fn in_the_units_of_the_machine() {
    let (system, _) = hammer();
    let osc = &system.oscillator;
    let orbit = find(osc, Label::new(4, 1), FindOptions::default()).pop().unwrap();
    let options = BranchOptions::default();
    let want: Vec<SolutionPoint> =
        Branch::new(osc, &orbit.cycle, Parameter::Gap, 0.25..=0.6, Direction::Up, options).unwrap().collect();
    // 2 kg on 800 N/m: the unit of time is 0.05 s, that of length 4 N / (800 N/m); the stop is below
    let parts = MachineParts::new(["body"])
        .with_mass(0, 2.0)
        .with_link(&[1.0], 800.0, 0.0)
        .with_frequency(osc.beta() / 0.05)
        .with_force(0, 1, 0.0, -4.0)
        .with_rigid_stop("floor", &[-2.0], 2.0 * 0.005 * 0.25, 0.5);
    let machine = Machine::new(parts).unwrap();
    let cycle = find_machine_while(&machine, Label::new(4, 1), [], &|| true).unwrap().pop().unwrap();
    let (family, value) = Family::of_path(&machine, "stop.floor.gap").unwrap();
    let range = value..=2.0 * 0.005 * 0.6;
    let own: Vec<continuation::machine::SolutionPoint> =
        continuation::machine::Branch::new((&family, value), &cycle, &range, Direction::Up, options).unwrap().collect();
    let events = |points: &[continuation::machine::SolutionPoint]| -> Vec<(&'static str, f64)> {
        let name = |point: &continuation::machine::SolutionPoint| point.event.map(|event| (event.name(), point.value));
        points.iter().filter_map(name).collect()
    };
    let want: Vec<(&str, f64)> = want.iter().filter_map(|point| Some((name(point.event?)?, point.value))).collect();
    let found = events(&own);
    assert!(want.len() >= 4);
    for ((name, gap), (own, floor)) in want.iter().zip(&found) {
        assert_eq!(name, own);
        assert!((floor / 0.01 - gap).abs() < 1e-12, "{name} {gap} {floor}");
    }
    for point in own.iter().filter(|point| point.event.is_none()) {
        let speed = point.cycle.events[0].speed;
        assert!(point.cycle.events.iter().all(|event| event.place == 0 && event.speed <= speed));
        let event = &point.cycle.events[0];
        assert!((event.q[0] * -2.0 - point.value).abs() < 1e-15 && event.qdot[0] > 0.0);
        assert!((event.qdot[0] - 0.5 * speed / 2.0).abs() < 1e-12);
    }
}

/// How long both take; run by hand: `cargo test --release -p vibroimpact --test one_coordinate time -- --ignored --nocapture`.
#[test]
#[ignore = "a measurement"]
fn time_of_a_branch() {
    let (system, machine) = hammer();
    let osc = &system.oscillator;
    let orbit = find(osc, Label::new(4, 1), FindOptions::default()).pop().unwrap();
    let cycle = find_machine_while(&machine, Label::new(4, 1), [], &|| true).unwrap().pop().unwrap();
    let options = BranchOptions::default();
    for (path, parameter) in NUMBERS {
        let (family, value) = Family::of_path(&machine, path).unwrap();
        let to = if parameter == Parameter::Gap { 0.6 } else { value + 0.3 };
        let time = |of: &dyn Fn() -> usize| {
            let best = (0..20).map(|_| {
                let begin = std::time::Instant::now();
                let points = of();
                (begin.elapsed().as_secs_f64(), points)
            });
            best.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap()
        };
        let one =
            time(&|| Branch::new(osc, &orbit.cycle, parameter, value..=to, Direction::Up, options).unwrap().count());
        let other = time(&|| {
            continuation::machine::Branch::new((&family, value), &cycle, &(value..=to), Direction::Up, options)
                .unwrap()
                .count()
        });
        println!("{path}: oscillator {one:?}, machine {other:?}, {}", other.0 / one.0);
    }
}

//! The branches of both over the gap.

use crate::{System, is_long, some};
use vibroimpact::continuation::machine;
use vibroimpact::continuation::{
    Branch, BranchEvent, BranchOptions, CurveKind, CurveOptions, Direction,
    machine::{Curve, Family, Plane, SolutionPoint},
};
use vibroimpact::events;
use vibroimpact::orbit::one_impact;
use vibroimpact::verdict::{SettleOptions, Verdict, settle, settle_unreduced};
use vibroimpact::{Oscillator, Parameter, Start};

/// How far the gap is changed.
const SPAN: f64 = 0.05;

/// Values of the same event differ by less.
const CLOSE: f64 = 1e-9;

/// Whether the events are the same at the same gaps. Towards a complete chatter, impacts appear at ever smaller distances: how many of
/// these the branches show differs, and what follows does not. Where the only impact is lost, that of the machine ends, and with
/// damping that of the oscillator goes on without impacts.
fn same(want: &[(&str, f64)], events: &[(&str, f64)]) -> bool {
    let alike = |(a, b): &(&(&str, f64), &(&str, f64))| a.0 == b.0 && (a.1 - b.1).abs() < CLOSE;
    let count = want.iter().zip(events).take_while(alike).count();
    let (want, events) = (&want[count..], &events[count..]);
    let limit = |of: &[(&str, f64)]| of.iter().position(|event| !["grazing", "fold"].contains(&event.0));
    match (want, events) {
        ([], []) => true,
        ([first @ ("grazing", _), ("end of range", _)], [last]) if last.0 == "loss of contact" => {
            (first.1 - last.1).abs() < CLOSE
        }
        _ => match (limit(want), limit(events)) {
            (Some(one), Some(other)) if (one, other) != (0, 0) && want[one].0 == "sticking begins" => {
                alike(&(&want[one], &events[other])) && same(&want[one + 1..], &events[other + 1..])
            }
            _ => false,
        },
    }
}

/// The same events at the same gaps, on cycles without rest.
#[test]
fn the_same_branches() {
    let options = SettleOptions { chaos_over: 0, max_impacts: 2_000, ..SettleOptions::default() };
    let (mut branches, mut told, mut differ) = (0, 0, Vec::new());
    for (place, system) in some().enumerate() {
        let machine = system.machine();
        let Verdict::Periodic(cycle) = settle(&system.oscillator, system.start, &options).verdict else { continue };
        let Verdict::Periodic(found) = settle_unreduced(&machine, &system.machine_start(), &options).unwrap().verdict
        else {
            continue;
        };
        if cycle.label != found.label || cycle.points.is_empty() || !cycle.rests.is_empty() {
            continue;
        }
        let gap = system.oscillator.gap();
        let range = gap - SPAN..=gap + SPAN;
        let direction = if place % 2 == 0 { Direction::Up } else { Direction::Down };
        let branch = BranchOptions::default();
        let Ok(own) = Branch::new(&system.oscillator, &cycle, Parameter::Gap, range.clone(), direction, branch) else {
            continue;
        };
        let own: Vec<_> = own.collect();
        let (family, value) = Family::of_path(&machine, "stop.upper.gap").unwrap();
        let other = match machine::Branch::unreduced((&family, value), &found, &range, direction, branch) {
            Ok(other) => other.collect::<Vec<_>>(),
            Err(error) => {
                differ.push(format!("{} {}: {error:?}", system.text, cycle.label));
                continue;
            }
        };
        branches += 1;
        let want: Vec<_> =
            own.iter().filter_map(|point| point.event.as_ref().map(|event| (event.name(), point.value))).collect();
        let events: Vec<_> =
            other.iter().filter_map(|point| point.event.as_ref().map(|event| (event.name(), point.value))).collect();
        told += want.len();
        if !same(&want, &events) {
            let first = want.iter().zip(&events).find(|(a, b)| a.0 != b.0 || (a.1 - b.1).abs() >= CLOSE);
            let counts = (want.len(), events.len(), want.last(), events.last());
            differ.push(format!("{} {}: {first:?} of {counts:?}", system.text, cycle.label));
        }
    }
    let summary = format!("{branches} branches, {told} events");
    let least = if is_long() { (60, 100) } else { (10, 20) };
    assert!(differ.is_empty(), "{summary}, {} differ\n{differ:#?}", differ.len());
    assert!(branches >= least.0 && told >= least.1, "{summary}");
}

/// Where 2/2 becomes 1/1 repeated twice, 1/1 has its flip.
#[test]
fn a_halving_is_the_flip_of_the_half() {
    let oscillator = Oscillator::from_inverse_beta(1.11, 1.83, 0.5).unwrap();
    let system = System { oscillator, start: Start::at_rest(&oscillator), text: String::new() };
    let machine = system.machine();
    let options = SettleOptions::default();
    let Verdict::Periodic(cycle) = settle_unreduced(&machine, &system.machine_start(), &options).unwrap().verdict
    else {
        panic!()
    };
    assert_eq!(cycle.label.to_string(), "2/2");
    let (family, value) = Family::of_path(&machine, "stop.upper.gap").unwrap();
    let branch = BranchOptions::default();
    let found = [Direction::Up, Direction::Down].into_iter().find_map(|direction| {
        let points = machine::Branch::unreduced((&family, value), &cycle, &(1.6..=2.2), direction, branch).unwrap();
        points.last().filter(|point| point.event == Some(BranchEvent::Halving))
    });
    let halving = found.unwrap();
    // the other cycle, from where it is stable
    let osc = Oscillator::from_inverse_beta(1.11, 1.65, 0.5).unwrap();
    let orbits = one_impact(&osc, 1);
    let once = &orbits.iter().find(|orbit| orbit.physical && orbit.cycle.stable()).unwrap().cycle;
    let mut points = Branch::new(&osc, once, Parameter::Gap, 1.6..=2.2, Direction::Up, branch).unwrap();
    let flip = points.find(|point| point.event == Some(BranchEvent::Flip)).unwrap();
    assert!((halving.value - flip.value).abs() < 1e-12, "{} {}", halving.value, flip.value);
    let twice = halving.cycle;
    assert!(twice.label.to_string() == "2/2" && twice.residual < 1e-11, "{} {}", twice.label, twice.residual);
    let speeds: Vec<f64> = twice.events.iter().map(|event| event.speed).collect();
    assert!(speeds.iter().all(|speed| (speed - flip.cycle.points[0].state.velocity).abs() < 1e-9), "{speeds:?}");
}

/// A chatter ends to be complete where the oscillator says, on the way there and back. On branches of cycles with a complete
/// chatter there is no other event: how many of its impacts are followed before the rest is summed is none.
#[test]
fn a_chatter_begins_and_ends_at_its_limit() {
    let at = |gap: f64| {
        let oscillator = Oscillator::new(0.187_812_295_714_788_97, gap, 0.350_601_472_659_036_5).unwrap();
        System { oscillator, start: Start::at_rest(&oscillator), text: String::new() }
    };
    let options = BranchOptions::default();
    let oscillator = at(1.0).oscillator;
    let once = settle(&oscillator, Start::at_rest(&oscillator), &SettleOptions::default());
    let Verdict::Periodic(cycle) = once.verdict else { panic!("{}", once.verdict.label()) };
    let branch = Branch::new(&oscillator, &cycle, Parameter::Gap, 0.95..=1.0, Direction::Down, options).unwrap();
    let chatter = branch.into_iter().find(|point| matches!(point.event, Some(BranchEvent::Sticking { .. }))).unwrap();
    for (from, direction, begins, close) in [(1.0, Direction::Down, true, 1e-12), (0.951, Direction::Up, false, 1e-12)]
    {
        let machine = at(from).machine();
        let settled = settle_unreduced(&machine, &at(from).machine_start(), &SettleOptions::default()).unwrap();
        let Verdict::Periodic(cycle) = settled.verdict else { panic!("{}", settled.verdict.label()) };
        let (family, value) = Family::of_path(&machine, "stop.upper.gap").unwrap();
        let branch = machine::Branch::unreduced((&family, value), &cycle, &(0.95..=1.0), direction, options).unwrap();
        let events: Vec<(BranchEvent, f64)> =
            branch.filter_map(|point| point.event.map(|event| (event, point.value))).collect();
        let limit = |event: &(BranchEvent, f64)| matches!(event.0, BranchEvent::Sticking { .. });
        let place = events.iter().position(limit).unwrap();
        assert_eq!(events[place].0, BranchEvent::Sticking { stop: 0, begins, detail: None });
        assert!((events[place].1 - chatter.value).abs() < close, "{} {}", events[place].1, chatter.value);
        // on its side with the chatter there is only the end of the range
        let inside = if begins { &events[place + 1..] } else { &events[..place] };
        assert!(inside.iter().all(|event| event.0 == BranchEvent::EndOfRange), "{inside:?}");
        assert_eq!(inside.len(), usize::from(begins));
    }
}

/// The curve of complete chatters over gap and restitution, against bisections with the oscillator.
#[test]
fn a_curve_of_complete_chatters() {
    let of = |gap: f64, e: f64| {
        let oscillator = Oscillator::new(0.187_812_295_714_788_97, gap, e).ok()?;
        Some(System { oscillator, start: Start::at_rest(&oscillator), text: String::new() })
    };
    let make = move |gap: f64, e: f64| Some(of(gap, e)?.machine());
    let machine = make(1.0, 0.35).unwrap();
    let settled = settle_unreduced(&machine, &events::Start::default(), &SettleOptions::default()).unwrap();
    let Verdict::Periodic(cycle) = settled.verdict else { panic!("{}", settled.verdict.label()) };
    let (family, value) = Family::of_path(&machine, "stop.upper.gap").unwrap();
    let options = BranchOptions::default();
    let mut branch =
        machine::Branch::unreduced((&family, value), &cycle, &(0.95..=1.0), Direction::Down, options).unwrap();
    let limit = |point: &SolutionPoint| matches!(point.event, Some(BranchEvent::Sticking { .. }));
    let point = branch.find(limit).unwrap();
    let plane = Plane::new(make, (0.5..=1.5, 0.05..=0.9));
    let options = CurveOptions { longest: 0.1, points: 400 };
    let [forth, back] = Curve::unreduced(&plane, (point.value, 0.35), &point, options).unwrap();
    assert_eq!(forth.kind(), CurveKind::Sticking { stop: 0 });
    let (forth, back): (Vec<_>, Vec<_>) = (forth.collect(), back.collect());
    let ends: Vec<f64> = [&forth, &back].map(|points| points.last().unwrap().values.1).to_vec();
    assert_eq!(ends, [0.05, 0.9]);
    let mut compared = 0;
    for point in forth.iter().chain(&back).step_by(6) {
        assert_eq!(point.cycle.label.to_string(), "inf/1");
        let (gap, e) = point.values;
        let oscillator = of(gap + 0.02, e).unwrap().oscillator;
        let settled = settle(&oscillator, Start::at_rest(&oscillator), &SettleOptions::default());
        let Verdict::Periodic(cycle) = settled.verdict else { continue };
        let range = gap - 0.01..=gap + 0.03;
        let Ok(mut branch) =
            Branch::new(&oscillator, &cycle, Parameter::Gap, range, Direction::Down, BranchOptions::default())
        else {
            continue;
        };
        let Some(limit) = branch.find(|point| matches!(point.event, Some(BranchEvent::Sticking { .. }))) else {
            continue;
        };
        assert!((limit.value - gap).abs() < 1e-11, "{e}: {gap} {}", limit.value);
        compared += 1;
    }
    assert!(compared >= 8, "{compared}");
}

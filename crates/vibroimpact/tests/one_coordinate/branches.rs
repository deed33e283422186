//! The branches of both over the gap.

use crate::{System, is_long, some};
use vibroimpact::continuation::{
    Branch, BranchEvent, BranchOptions, Direction, MachineBranch, MachineBranchEvent, MachineFamily,
};
use vibroimpact::orbit::one_impact;
use vibroimpact::verdict::{MachineVerdict, SettleOptions, Verdict, settle, settle_machine};
use vibroimpact::{Oscillator, Parameter, Start};

/// How far the gap is changed.
const SPAN: f64 = 0.05;

/// The same events at the same gaps, on cycles without rest. Four of 64 branches of machines differ: two with restitution 0,
/// where the branch of the oscillator ends or the change has another name; one with folds closer than 1e-6 to each other;
/// and one on which two stops are struck almost at the same time.
#[test]
fn the_same_branches() {
    let options = SettleOptions { chaos_over: 0, max_impacts: 2_000, ..SettleOptions::default() };
    let (mut branches, mut told, mut differ) = (0, 0, Vec::new());
    for (place, system) in some().enumerate() {
        let machine = system.machine();
        let Verdict::Periodic(cycle) = settle(&system.oscillator, system.start, &options).verdict else { continue };
        let MachineVerdict::Periodic(found) =
            settle_machine(&machine, &system.machine_start(), &options).unwrap().verdict
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
        let (family, value) = MachineFamily::of_path(&machine, "stop.upper.gap").unwrap();
        let other = match MachineBranch::new((&family, value), &found, &range, direction, branch) {
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
        let same =
            want.len() == events.len() && want.iter().zip(&events).all(|(a, b)| a.0 == b.0 && (a.1 - b.1).abs() < 1e-9);
        if !same {
            let first = want.iter().zip(&events).find(|(a, b)| a.0 != b.0 || (a.1 - b.1).abs() >= 1e-9);
            let counts = (want.len(), events.len(), want.last(), events.last());
            differ.push(format!("{} {}: {first:?} of {counts:?}", system.text, cycle.label));
        }
    }
    let summary = format!("{branches} branches, {told} events");
    let (most, least) = if is_long() { (4, (60, 100)) } else { (2, (10, 20)) };
    assert!(differ.len() <= most, "{summary}, {} differ\n{differ:#?}", differ.len());
    assert!(branches >= least.0 && told >= least.1, "{summary}");
}

/// Where 2/2 becomes 1/1 repeated twice, 1/1 has its flip.
#[test]
fn a_halving_is_the_flip_of_the_half() {
    let oscillator = Oscillator::from_inverse_beta(1.11, 1.83, 0.5).unwrap();
    let system = System { oscillator, start: Start::at_rest(&oscillator), text: String::new() };
    let machine = system.machine();
    let options = SettleOptions::default();
    let MachineVerdict::Periodic(cycle) = settle_machine(&machine, &system.machine_start(), &options).unwrap().verdict
    else {
        panic!()
    };
    assert_eq!(cycle.label.to_string(), "2/2");
    let (family, value) = MachineFamily::of_path(&machine, "stop.upper.gap").unwrap();
    let branch = BranchOptions::default();
    let found = [Direction::Up, Direction::Down].into_iter().find_map(|direction| {
        let points = MachineBranch::new((&family, value), &cycle, &(1.6..=2.2), direction, branch).unwrap();
        points.last().filter(|point| point.event == Some(MachineBranchEvent::Halving))
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

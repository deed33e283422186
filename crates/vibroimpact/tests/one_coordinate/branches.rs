//! The branches of both over the gap.

use crate::{is_long, some};
use vibroimpact::Parameter;
use vibroimpact::continuation::{Branch, BranchOptions, Direction, MachineBranch, MachineFamily};
use vibroimpact::verdict::{MachineVerdict, SettleOptions, Verdict, settle, settle_machine};

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

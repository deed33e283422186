//! Machines of equal parts that do not act on each other, things at one place, and impacts at one time: what holds of one part holds
//! of several.

use crate::branches_beyond::{events, settled, traced};
use vibroimpact::continuation::{BranchEvent, Direction};
use vibroimpact::events::{EventKind, Start};
use vibroimpact::machine::{ImpactLaw, Machine, MachineParts};
use vibroimpact::orbit::{Label, Stability, find_machine_while, machine::Cycle};
use vibroimpact::verdict::{Census, SettleOptions, scattered_machine_starts, settle_machine};

fn moduli(cycle: &Cycle) -> Vec<f64> {
    cycle.multipliers.iter().map(|multiplier| multiplier.modulus()).collect()
}

fn close(found: &[f64], wanted: &[f64], within: f64) {
    assert!(found.len() == wanted.len(), "{found:?} instead of {wanted:?}");
    assert!(found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < within), "{found:?} instead of {wanted:?}");
}

/// `count` equal masses of 1, each along its own coordinate and with the links, forces, stops and joints that `add` adds.
fn equal(count: usize, frequency: f64, add: impl Fn(MachineParts, usize, &[f64]) -> MachineParts) -> Machine {
    let parts = MachineParts::new((0..count).map(|k| format!("x{k}"))).with_frequency(frequency);
    let with = |parts: MachineParts, k: usize| {
        let own: Vec<f64> = (0..count).map(|i| if i == k { 1.0 } else { 0.0 }).collect();
        add(parts.with_mass(k, 1.0), k, &own)
    };
    Machine::new((0..count).fold(parts, with)).unwrap()
}

/// `count` times a mass on a spring under a force, with a stop of this gap and restitution, and a joint with this sliding force and limit.
fn rubbing(
    count: usize,
    (frequency, force): (f64, f64),
    (gap, restitution): (f64, f64),
    (sliding, limit): (f64, f64),
) -> Machine {
    equal(count, frequency, |parts, k, own| {
        parts
            .with_link(own, 1.0, 0.05)
            .with_force(k, 1, 0.0, force)
            .with_rigid_stop(&format!("s{k}"), own, gap, restitution)
            .with_joint(&format!("j{k}"), own, sliding, limit, 0.0)
    })
}

/// The same where the impact makes the joint turn back.
fn sliding(count: usize) -> Machine {
    rubbing(count, (1.5, 1.0), (0.0, 0.5), (0.2, 0.2))
}

/// The derivative of an impact that reverses a joint was divided among all impacts at the same time, so equal parts had multipliers
/// -0.301 and -0.159, and a stable motion could be unstable.
#[test]
fn joints_that_several_impacts_reverse_have_the_multipliers_of_one() {
    let [one, two, three] = [1, 2, 3].map(|count| moduli(&settled(&sliding(count), &Start::default()).unwrap()));
    assert!((one[0] - 0.301_471).abs() < 1e-6);
    close(&two, &[one[0], one[0], 0.0, 0.0], 1e-12);
    close(&three, &[one[0], one[0], one[0], 0.0, 0.0, 0.0], 1e-12);
}

/// Two bodies, of which the first strikes the second, and the second a wall, without restitution and in turn.
fn in_turn(forced: &[usize], friction: f64) -> MachineParts {
    let mut parts = MachineParts::new(["b0", "b1"]).with_frequency(1.2);
    parts.impacts = ImpactLaw::InTurn;
    for k in 0..2 {
        parts = parts.with_mass(k, 1.0);
    }
    for k in forced {
        parts = parts.with_force(*k, 1, 0.0, 1.0);
    }
    let joint = |parts: MachineParts, name: &str, own: &[f64]| match friction > 0.0 {
        true => parts.with_joint(name, own, friction, 1.5 * friction, 0.0),
        false => parts,
    };
    joint(joint(parts, "j0", &[1.0, 0.0]), "j1", &[0.0, 1.0])
}

/// A body that is struck while it touches a wall, which it has reached just before without speed: the wall's gap is zero in neighbours
/// too and times nothing. All multipliers were infinite; simulated neighbours come nearer by 0.12 in each period.
#[test]
fn a_gap_that_a_flight_begins_on_times_no_other_impact() {
    let parts = in_turn(&[0], 0.2)
        .with_link(&[1.0, 0.0], 1.0, 0.05)
        .with_link(&[0.0, 1.0], 1.0, 0.0)
        .with_rigid_stop("s0", &[1.0, -1.0], 0.5, 0.0)
        .with_rigid_stop("s1", &[0.0, 1.0], 0.5, 0.0);
    let cycle = settled(&Machine::new(parts).unwrap(), &Start::default()).unwrap();
    assert_eq!(cycle.label, Label::new(5, 1));
    close(&moduli(&cycle), &[0.120_343, 0.0, 0.0, 0.0], 1e-6);
}

/// A body that is struck while it rests on a wall is pushed into the wall again and again: how many of these impacts are above rounding
/// errors is no property of the motion. A branch had ever more corners of both stops.
#[test]
fn impacts_in_turn_without_end_are_no_corners() {
    let parts = in_turn(&[0, 1], 0.0)
        .with_link(&[1.0, 0.0], 1.0, 0.05)
        .with_link(&[0.0, 1.0], 1.0, 0.05)
        .with_rigid_stop("s0", &[1.0, -1.0], 0.3, 0.0)
        .with_rigid_stop("s1", &[0.0, 1.0], 0.3, 0.0);
    let machine = Machine::new(parts).unwrap();
    let cycle = settled(&machine, &Start::default()).unwrap();
    for (path, range, direction) in
        [("stop.s1.gap", (0.3, 0.33), Direction::Up), ("frequency", (1.2, 1.22), Direction::Up)]
    {
        let found = events(&traced((&machine, path), &cycle, range, direction));
        assert_eq!(found, [(BranchEvent::EndOfRange, range.1)], "{path}");
    }
}

/// `count` hammers beside each other, each with so many anvils at one place.
fn hammers(count: usize, anvils: usize) -> Machine {
    let mut parts = MachineParts::new((0..2 * count).map(|k| format!("x{k}"))).with_frequency(1.2);
    for k in 0..count {
        let unit = |i: usize| {
            let mut unit = vec![0.0; 2 * count];
            unit[2 * k + i] = 1.0;
            unit
        };
        let (frame, head) = (unit(0), unit(1));
        let between: Vec<f64> = frame.iter().zip(&head).map(|(a, b)| a - b).collect();
        parts = parts
            .with_mass(2 * k, 1.0)
            .with_mass(2 * k + 1, 0.5)
            .with_link(&frame, 1.0, 0.1)
            .with_link(&between, 1.0, 0.1)
            .with_force(2 * k, 1, 0.0, 1.0);
        for anvil in 0..anvils {
            parts = parts.with_rigid_stop(&format!("anvil{k}_{anvil}"), &head, 0.5, 0.6);
        }
    }
    Machine::new(parts).unwrap()
}

/// Impacts that appear on two stops at once are one event of the cycle beyond: as two of them they led nowhere, and the branch lost
/// the turn at the grazing contact, the unstable cycles and their fold.
#[test]
fn stops_at_one_place_and_equal_parts_have_the_branch_of_one() {
    let events_of = |machine: &Machine| {
        let cycle = settled(machine, &Start::default()).unwrap();
        events(&traced((machine, "frequency"), &cycle, (0.9, 1.2), Direction::Down))
    };
    let names = |found: &[(BranchEvent, f64)]| found.iter().map(|(event, _)| event.name()).collect::<Vec<_>>();
    let one = events_of(&hammers(1, 1));
    assert_eq!(names(&one), ["grazing", "fold", "grazing", "fold", "flip", "end of range"]);
    assert!(matches!(one[0].0, BranchEvent::Grazing { stop: 0, also: None, appears: true, turns: true, .. }));
    for (machine, also) in [(hammers(1, 2), None), (hammers(2, 1), Some(1))] {
        let found = events_of(&machine);
        assert_eq!(names(&found), names(&one));
        assert!(one.iter().zip(&found).all(|((_, at), (_, beside))| (at - beside).abs() < 1e-7), "{found:?}");
        assert!(matches!(found[0].0, BranchEvent::Grazing { stop: 0, also: other, turns: true, .. } if other == also));
    }
}

/// A number of one of two equal parts takes their impacts, which are at one time at the beginning, apart: the branch stopped there and
/// said that this was the end of its range.
#[test]
fn a_number_of_one_part_leads_on() {
    let cycle = settled(&hammers(2, 1), &Start::default()).unwrap();
    for (path, range, direction, end) in [
        ("stop.anvil1_0.gap", (0.4, 0.5), Direction::Down, 0.4),
        ("stop.anvil0_0.gap", (0.5, 0.55), Direction::Up, 0.55),
        ("stop.anvil0_0.restitution", (0.6, 0.7), Direction::Up, 0.7),
    ] {
        let points = traced((&hammers(2, 1), path), &cycle, range, direction);
        assert_eq!(events(&points), [(BranchEvent::EndOfRange, end)], "{path}");
        // the other part moves as before
        let (first, last) = (moduli(&cycle), moduli(&points.last().unwrap().cycle));
        assert!(
            last.iter().any(|of| (of - first[0]).abs() < 1e-8) && last.iter().any(|of| (of - first[0]).abs() > 1e-4)
        );
    }
}

/// Elastic balls in a row beside another row: impacts in turn of one row have the derivative of that row alone. Of the second one all
/// rounds were one, and the product of its multipliers was a quarter of what Liouville's formula gives.
#[test]
fn impacts_in_turn_of_equal_parts_have_the_multipliers_of_one() {
    let rows = |count: usize, stops: usize| {
        let n = 3 * count;
        let mut parts = MachineParts::new((0..n).map(|k| format!("x{k}"))).with_frequency(0.7);
        parts.impacts = ImpactLaw::InTurn;
        let unit = |k: usize, sign: f64| (0..n).map(move |i| if i == k { sign } else { 0.0 });
        for k in 0..n {
            parts = parts.with_mass(k, 1.0).with_link(&unit(k, 1.0).collect::<Vec<_>>(), 1.0, 0.2);
        }
        for row in 0..count {
            parts = parts.with_force(3 * row, 1, 0.0, 1.0);
            for k in 3 * row..3 * row + 2 {
                let along: Vec<f64> = unit(k, 1.0).zip(unit(k + 1, 1.0)).map(|(a, b)| a - b).collect();
                for stop in 0..stops {
                    parts = parts.with_rigid_stop(&format!("s{k}_{stop}"), &along, 0.0, 1.0);
                }
            }
        }
        let start = Start { q: vec![0.0; n], ..Start::default() };
        let cycle = settled(&Machine::new(parts).unwrap(), &start).unwrap();
        // the bodies move on together after an impact, and no chatter is in it
        let impacts = u32::try_from(2 * count * stops).unwrap();
        assert!(stops > 1 || cycle.label == Label::new(impacts, 1), "{}", cycle.label);
        moduli(&cycle)
    };
    let (one, two, doubled) = (rows(1, 1), rows(2, 1), rows(1, 2));
    assert!(
        (one[0] - 0.793_593).abs() < 1e-6
            && (one[0] * one[3] - (-0.2 * core::f64::consts::TAU / 0.7).exp()).abs() < 1e-6
    );
    let twice: Vec<f64> = one.iter().flat_map(|of| [*of, *of]).collect();
    close(&two, &twice, 1e-9);
    // a second stop at each place changes nothing
    close(&doubled, &one, 1e-9);
}

/// Where the only impacts of equal parts have no speed, at one time, the motion without impacts follows: the branch ended there without
/// convergence.
#[test]
fn impacts_of_equal_parts_are_lost_together() {
    let masses = |count: usize| {
        equal(count, 1.5, |parts, k, own| {
            let parts = parts.with_link(own, 1.0, 0.1).with_force(k, 1, 0.0, 1.0);
            parts.with_rigid_stop(&format!("s{k}"), own, 0.2, 0.5)
        })
    };
    let end = |count: usize| {
        let machine = masses(count);
        let cycle = settled(&machine, &Start::default()).unwrap();
        let found = events(&traced((&machine, "frequency"), &cycle, (1.5, 2.5), Direction::Up));
        found.into_iter().find(|(event, _)| event.place().is_some()).unwrap()
    };
    let one = end(1);
    assert!(matches!(one.0, BranchEvent::Grazing { stop: 0, appears: false, .. }));
    for (event, at) in [end(2), end(3)] {
        assert!(
            matches!(event, BranchEvent::LossOfContact { stop: 0, .. }) && (at - one.1).abs() < 1e-7,
            "{event:?} {at}"
        );
    }
}

/// A particle in a cage that it never touches stays where friction takes it: its motions are a family of cycles, which was undecided,
/// because Newton's equations are singular there.
#[test]
fn a_cycle_of_a_family_is_neutral() {
    let parts = MachineParts::new(["frame", "particle"])
        .with_mass(0, 1.0)
        .with_mass(1, 0.5)
        .with_link(&[1.0, 0.0], 1.0, 0.05)
        .with_frequency(3.0)
        .with_force(0, 1, 0.0, 0.5)
        .with_rigid_stop("right", &[-1.0, 1.0], 1.0, 0.5)
        .with_rigid_stop("left", &[1.0, -1.0], 1.0, 0.5)
        .with_joint("floor", &[-1.0, 1.0], 0.05, 0.05, 0.0);
    let cycle = settled(&Machine::new(parts).unwrap(), &Start::default()).unwrap();
    assert_eq!((cycle.stability(), cycle.label), (Stability::Neutral, Label::new(0, 1)));
    assert!((cycle.multipliers[0].re - 1.0).abs() < 1e-12 && moduli(&cycle)[1] < 0.8 && cycle.residual < 1e-13);
}

/// The motion without events is one orbit, wherever the search for it begins.
#[test]
fn the_steady_motion_is_one_orbit() {
    let machine = hammers(1, 1).with("stop.anvil0_0.gap", 9.0).unwrap();
    let starts = (0..20).map(|k| Start { q: vec![0.1 * f64::from(k), 0.0], ..Start::default() });
    let found = find_machine_while(&machine, Label::new(0, 1), starts, &|| true).unwrap();
    assert_eq!(found.len(), 1);
}

/// Equal oscillators that touch move as one, whether an impact closed the stop between them or they come together without end. The
/// stop pushes nothing, but attractors counted two motions.
#[test]
fn touching_without_force_is_no_motion_of_its_own() {
    let parts =
        equal(2, 1.0, |parts, k, own| parts.with_link(own, 1.0, 0.1).with_force(k, 1, 0.0, 1.0)).parts().clone();
    let machine = Machine::new(parts.with_rigid_stop("s", &[1.0, -1.0], 0.0, 0.5)).unwrap();
    let verdict = |k: u64| {
        let start = scattered_machine_starts(&machine, 1, k);
        settle_machine(&machine, &start, &SettleOptions::default()).unwrap().verdict
    };
    let verdicts: Vec<_> = (0..40).map(verdict).collect();
    let some = |closed: usize| verdicts.iter().any(|verdict| verdict.closed().len() == closed);
    assert!(some(0) && some(1));
    let mut census = Census::default();
    for verdict in &verdicts {
        census.add(verdict);
    }
    assert_eq!(census.motions().len(), 1, "{:?}", census.motions());
}

/// Holds of equal parts begin and end at one time: each at its own in neighbours, so that the multipliers are those of one.
#[test]
fn holds_of_equal_parts_have_the_multipliers_of_one() {
    let cycles = [1, 2, 3]
        .map(|count| settled(&rubbing(count, (0.8, 0.6), (0.5, 0.4), (0.15, 0.2)), &Start::default()).unwrap());
    let holds = cycles[0].events.iter().filter(|event| event.kind == EventKind::Hold).count();
    assert!(holds > 0, "{:?}", cycles[0].events);
    let one = moduli(&cycles[0]);
    for (count, cycle) in cycles.iter().enumerate() {
        let all: Vec<f64> = one.iter().flat_map(|of| vec![*of; count + 1]).collect();
        close(&moduli(cycle), &all, 1e-9);
    }
}

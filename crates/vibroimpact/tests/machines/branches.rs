//! Branches of machines of one coordinate against those of the oscillator.

use vibroimpact::continuation::machine;
use vibroimpact::continuation::{Branch, BranchEvent, BranchOptions, Direction, SolutionPoint, machine::Family};
use vibroimpact::events;
use vibroimpact::machine::{Machine, MachineParts, Opening, StopLaw};
use vibroimpact::orbit::{FindOptions, find, find_machine_while, machine::Cycle};
use vibroimpact::verdict::{SettleOptions, Verdict, scattered_machine_starts, settle, settle_machine};
use vibroimpact::{Label, Oscillator, Parameter, Side, Start};

pub(crate) fn of(osc: &Oscillator) -> Machine {
    with(osc, MachineParts::new(["mass"]))
}

/// The same beside a mass that stands still: it is not computed as the oscillator.
pub(crate) fn beside_another(osc: &Oscillator) -> Machine {
    with(osc, MachineParts::new(["mass", "other"]).with_mass(1, 0.7).with_link(&[0.0, 1.0], 2.0, 0.3))
}

fn with(osc: &Oscillator, parts: MachineParts) -> Machine {
    let along: Vec<f64> = (0..parts.coordinates.len()).map(|i| if i == 0 { 1.0 } else { 0.0 }).collect();
    let parts = parts
        .with_mass(0, 1.0)
        .with_link(&along, 1.0, 2.0 * osc.damping())
        .with_frequency(osc.beta())
        .with_force(0, 1, 0.0, 1.0)
        .with_rigid_stop("stop", &along, osc.gap(), osc.restitution());
    Machine::new(parts).unwrap()
}

#[test]
fn the_same_events() {
    for (inverse, gap, eps, zeta, start, range, direction) in [
        (1.11, 1.0, 0.5, 0.0, (0.0, 0.0), (0.0, 4.0), Direction::Up),
        (1.3, 0.75, 0.5, 0.05, (0.0, 0.0), (0.1, 2.0), Direction::Up),
        (1.3, 0.75, 0.5, 0.05, (0.0, 0.0), (0.1, 2.0), Direction::Down),
        (0.8, 0.5, 0.7, 0.1, (0.0, 0.0), (0.0, 3.0), Direction::Up),
    ] {
        let osc = Oscillator::from_inverse_beta(inverse, gap, eps).unwrap().with_damping(zeta).unwrap();
        let (x, v) = start;
        let options = SettleOptions::default();
        let Verdict::Periodic(cycle) = settle(&osc, Start { x, v, phase: 0.0 }, &options).verdict else { panic!() };
        let machine = of(&osc);
        let own = events::Start { q: vec![x], qdot: vec![v], phase: 0.0, ..events::Start::default() };
        let Verdict::Periodic(found) = settle_machine(&machine, &own, &options).unwrap().verdict else { panic!() };
        let range = range.0..=range.1;
        let expected: Vec<_> =
            Branch::new(&osc, &cycle, Parameter::Gap, range.clone(), direction, BranchOptions::default())
                .unwrap()
                .filter_map(|point| point.event.map(|event| (event, point.value)))
                .collect();
        let (family, gap) = Family::of_path(&machine, "stop.stop.gap").unwrap();
        let events: Vec<_> = machine::Branch::new((&family, gap), &found, &range, direction, BranchOptions::default())
            .unwrap()
            .filter_map(|point| point.event.map(|event| (event, point.value)))
            .collect();
        assert_eq!(events.len(), expected.len(), "{expected:?} {events:?}");
        for ((want, at), (event, value)) in expected.iter().zip(&events) {
            assert_eq!(want.name(), event.name());
            assert!((at - value).abs() < 1e-9, "{} {at} {value}", want.name());
            if let (BranchEvent::Grazing { turns, .. }, BranchEvent::Grazing { turns: found, .. }) = (want, event) {
                assert_eq!(turns, found);
            }
        }
    }
}

/// Numbers between 0 and 1.
pub(crate) fn sequence() -> impl FnMut() -> f64 {
    let mut state = 5_u64;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(state >> 33).unwrap()) / f64::from(1_u32 << 31)
    }
}

/// A machine of two coordinates with one stop of each kind.
pub(crate) fn random_machine(case: usize, random: &mut impl FnMut() -> f64) -> Machine {
    let parts = MachineParts::new(["a", "b"])
        .with_mass(0, 1.0)
        .with_mass(1, 0.5 + random())
        .with_link(&[1.0, -1.0], 0.5 + random(), 0.05 + 0.2 * random())
        .with_link(&[0.0, 1.0], 0.5 + random(), 0.05 + 0.2 * random())
        .with_frequency(0.5 + random())
        .with_force(1, 1, 0.3, 0.9);
    let gap = 0.2 + 0.8 * random();
    let soft = |preload, damping, opening| StopLaw::Compliant { stiffness: 20.0, damping, preload, opening };
    let parts = match case % 5 {
        0 => parts.with_rigid_stop("stop", &[1.0, 0.0], gap, 0.4 + 0.5 * random()),
        1 => parts.with_stop("stop", &[1.0, 0.0], gap, soft(0.0, 0.0, Opening::Force)),
        2 => parts.with_stop("stop", &[1.0, -1.0], gap, soft(0.0, 0.8, Opening::Force)),
        3 => parts.with_stop("stop", &[1.0, 0.0], gap, soft(0.3, 0.0, Opening::Position)),
        _ => parts.with_rigid_stop("stop", &[1.0, 0.0], gap, 0.6).with_joint("floor", &[0.0, 1.0], 0.2, 0.2, 0.0),
    };
    Machine::new(parts).unwrap()
}

/// Beside each event of random branches, motions that begin close to the cycle settle into it if its multipliers say that
/// it is stable, and leave it otherwise.
#[test]
fn simulation_beside_events() {
    let mut random = sequence();
    let options = SettleOptions::default();
    let mut confirmed = std::collections::BTreeMap::new();
    for case in 0..7 {
        let machine = random_machine(case, &mut random);
        let settled = settle_machine(&machine, &events::Start::default(), &options).unwrap();
        let Verdict::Periodic(found) = settled.verdict else { continue };
        let limits = BranchOptions { points: 200, ..BranchOptions::default() };
        for (path, range, direction) in
            [("stop.stop.gap", -0.2..=2.0, Direction::Down), ("frequency", 0.35..=1.6, Direction::Up)]
        {
            let (family, value) = Family::of_path(&machine, path).unwrap();
            let branch = machine::Branch::new((&family, value), &found, &range, direction, limits).unwrap();
            let points: Vec<_> = branch.collect();
            for (k, point) in points.iter().enumerate() {
                let Some(event) = point.event.filter(|event| !event.ends()) else { continue };
                let beside = points[..k].iter().rev().take(5).chain(points[k + 1..].iter().take(5));
                let mut both = (false, false);
                for other in beside.filter(|other| other.event.is_none()) {
                    let largest = other.cycle.multipliers[0].modulus();
                    // at the event itself no neighbourhood is left
                    if (other.value - point.value).abs() < 1e-3 || (0.97..1.03).contains(&largest) || largest > 1e3 {
                        continue;
                    }
                    let there = machine.with(path, other.value).unwrap();
                    let mut start = other.cycle.state.clone();
                    start.q[0] += 1e-7;
                    let settled = settle_machine(&there, &start, &options).unwrap();
                    let same =
                        matches!(&settled.verdict, Verdict::Periodic(cycle) if cycle.same_as(&other.cycle, 1e-6));
                    assert_eq!(
                        same,
                        largest < 1.0,
                        "case {case} {path} {} beside {event:?} at {}: {} multiplier {largest}, settled {}",
                        other.value,
                        point.value,
                        other.cycle.label,
                        settled.verdict.label()
                    );
                    if largest < 1.0 { both.0 = true } else { both.1 = true }
                }
                *confirmed.entry(event.name()).or_insert(0) += i32::from(both.0 || both.1);
            }
        }
    }
    assert!(confirmed.values().sum::<i32>() >= 20, "{confirmed:?}");
}

/// At a flip the cycle of twice the period begins: on the stable side of the flip it is what motions settle into.
#[test]
fn doubled_beside_a_flip() {
    let osc = Oscillator::from_inverse_beta(1.11, 1.5, 0.5).unwrap();
    let machine = of(&osc);
    let settled = settle_machine(&machine, &events::Start::default(), &SettleOptions::default()).unwrap();
    let Verdict::Periodic(cycle) = settled.verdict else { panic!() };
    let (family, gap) = Family::of_path(&machine, "stop.stop.gap").unwrap();
    let range = 1.0..=3.0;
    let mut branch =
        machine::Branch::new((&family, gap), &cycle, &range, Direction::Up, BranchOptions::default()).unwrap();
    let flip = branch.find(|point| point.event == Some(BranchEvent::Flip)).unwrap();
    let (value, doubled) = flip.leaving(&family, 0.5).pop().unwrap();
    assert_eq!(doubled.label.to_string(), "2/2");
    assert!(doubled.stable() && value > flip.value && doubled.residual < 1e-11);
    // followed back, it ends on the branch from which it came
    let range = 1.0..=3.0;
    let back =
        machine::Branch::new((&family, value), &doubled, &range, Direction::Down, BranchOptions::default()).unwrap();
    let end = back.last().unwrap();
    assert_eq!(end.event, Some(BranchEvent::Halving));
    assert!((end.value - flip.value).abs() < 1e-7, "{} {}", end.value, flip.value);
}

/// Where the symmetric cycle between two stops alike loses its symmetry, two cycles that are mirror images of each other begin:
/// those of the oscillator.
#[test]
fn both_cycles_beside_a_branch_point() {
    let osc = Oscillator::new(2.0, 0.4, 0.8).unwrap().with_damping(0.02).unwrap().with_second_stop(0.4, 0.8).unwrap();
    let parts = of(&osc).parts().clone().with_rigid_stop("below", &[-1.0], 0.4, 0.8);
    let machine = Machine::new(parts).unwrap();
    let label = Label::new(2, 1);
    let orbits = find(&osc, label, FindOptions::default());
    let orbit = &orbits.iter().find(|orbit| orbit.physical && orbit.cycle.stable()).unwrap().cycle;
    let (range, options) = (1.5..=2.0, BranchOptions::default());
    let branch = Branch::new(&osc, orbit, Parameter::Beta, range.clone(), Direction::Down, options).unwrap();
    let expected = branch.into_iter().find(|point| point.event == Some(BranchEvent::BranchPoint)).unwrap();
    let starts = (0..16).map(|k| scattered_machine_starts(&machine, 1, k));
    let cycles = find_machine_while(&machine, label, starts, &|| true).unwrap();
    let cycle = cycles.iter().find(|cycle| cycle.stable()).unwrap();
    let (family, beta) = Family::of_path(&machine, "frequency").unwrap();
    let mut branch = machine::Branch::new((&family, beta), cycle, &range, Direction::Down, options).unwrap();
    let point = branch.find(|point| point.event == Some(BranchEvent::BranchPoint)).unwrap();
    assert!((point.value - expected.value).abs() < 1e-9, "{} {}", point.value, expected.value);
    let leaving = point.leaving(&family, 0.125);
    let [one, other] = leaving.as_slice() else { panic!("{} cycles", leaving.len()) };
    let speeds = |(_, cycle): &(f64, Cycle)| {
        [0, 1].map(|stop| cycle.events.iter().find(|event| event.closes() && event.place == stop).unwrap().speed)
    };
    let ([above, below], mirrored) = (speeds(one), speeds(other));
    assert!((above - below).abs() > 1e-4 && one.0 == other.0, "{above} {below}");
    assert!((above - mirrored[1]).abs() < 1e-9 && (below - mirrored[0]).abs() < 1e-9, "{mirrored:?}");
    // a branch of the oscillator passes through them
    let there = Branch::from_branch_point(&osc, &expected, Parameter::Beta, range, options).unwrap();
    let upper = |point: &SolutionPoint| {
        point.cycle.points.iter().find(|impact| impact.state.side == Side::Upper).unwrap().state.velocity
    };
    let met = there.into_iter().any(|branch| {
        let points: Vec<SolutionPoint> = branch.take(40).collect();
        points.windows(2).any(|pair| {
            let [a, b] = [&pair[0], &pair[1]].map(|point| (point.value, upper(point)));
            // the speed changes with the square root of the number beside the branch point, so it is between both
            let between = |x: f64, a: f64, b: f64| x >= a.min(b) && x <= a.max(b);
            between(one.0, a.0, b.0) && between(above, a.1, b.1)
        })
    });
    assert!(met, "{above} at {}", one.0);
}

/// Between two torus bifurcations a pair of complex multipliers lies outside the unit circle, and motions that begin close
/// to the cycle leave it; beyond both they settle into it.
#[test]
fn torus_bifurcations() {
    let mut random = sequence();
    let machines: Vec<Machine> = (0..34).map(|case| random_machine(case, &mut random)).collect();
    let options = SettleOptions::default();
    let (mut found, mut inside, mut outside) = (0, 0, 0);
    for case in [13, 33] {
        let settled = settle_machine(&machines[case], &events::Start::default(), &options).unwrap();
        let Verdict::Periodic(cycle) = settled.verdict else { panic!("case {case}") };
        let (family, value) = Family::of_path(&machines[case], "frequency").unwrap();
        let branch =
            machine::Branch::new((&family, value), &cycle, &(0.35..=1.8), Direction::Up, BranchOptions::default())
                .unwrap();
        let points: Vec<_> = branch.collect();
        for (k, point) in points.iter().enumerate() {
            if point.event != Some(BranchEvent::Torus) {
                continue;
            }
            found += 1;
            let multiplier = point.cycle.multipliers[0];
            assert!((multiplier.modulus() - 1.0).abs() < 1e-9 && multiplier.im.abs() > 0.1, "{multiplier:?}");
            let beside = points[k - 3..k + 4].iter().filter(|other| other.event.is_none());
            for other in beside.filter(|other| (other.cycle.multipliers[0].modulus() - 1.0).abs() > 2e-3) {
                let mut start = other.cycle.state.clone();
                start.q[0] += 1e-6;
                let there = family.at(other.value).unwrap();
                let settled = settle_machine(&there, &start, &options).unwrap().verdict;
                let same = matches!(&settled, Verdict::Periodic(cycle) if cycle.same_as(&other.cycle, 1e-6));
                assert_eq!(same, other.cycle.stable(), "case {case} at {}: {}", other.value, settled.label());
                if same { inside += 1 } else { outside += 1 }
            }
        }
    }
    assert!(found == 4 && inside >= 8 && outside >= 3, "{found} {inside} {outside}");
}

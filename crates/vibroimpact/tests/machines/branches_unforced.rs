//! Branches of limit cycles of machines without forcing.

use crate::drift::{cycle, settled};
use crate::limit_cycles::{on_belt, pair};
use std::collections::BTreeMap;
use std::f64::consts::PI;
use vibroimpact::continuation::{
    BranchEvent, BranchOptions, Direction,
    machine::{Branch, Family, SolutionPoint},
};
use vibroimpact::events::{EventKind, Limits, Motion, Samples, Start};
use vibroimpact::machine::{Machine, MachineParts, Opening, StopLaw};
use vibroimpact::orbit::{find_machine_while, machine::Cycle};
use vibroimpact::regime::ContactState;
use vibroimpact::verdict::{Label, Verdict, scattered_machine_starts};

/// Whether the long run is asked for.
fn is_long() -> bool {
    std::env::var("VIBROIMPACT_LONG").is_ok_and(|value| value == "1")
}

fn from(
    machine: &Machine,
    cycle: &Cycle,
    (path, low, high): (&str, f64, f64),
    direction: Direction,
) -> Vec<SolutionPoint> {
    let (family, value) = Family::of_path(machine, path).unwrap();
    let options = BranchOptions { points: 2_000, ..BranchOptions::default() };
    Branch::new((&family, value), cycle, &(low..=high), direction, options).unwrap().collect()
}

/// The branch of the motion that begins at rest on the belt.
pub(crate) fn branch(machine: &Machine, over: (&str, f64, f64), direction: Direction) -> Vec<SolutionPoint> {
    let mut qdot = vec![0.0; machine.n()];
    qdot[0] = machine.number("friction.belt.belt").unwrap();
    from(
        machine,
        &cycle(machine, &Start { q: vec![0.0; machine.n()], qdot, phase: 0.0, ..Start::default() }),
        over,
        direction,
    )
}

/// The period of stick-slip in closed form at each point, over each number.
#[test]
fn stick_slip_in_closed_form() {
    let machine = on_belt((0.2, 0.4), 0.3, 0.0);
    for over in
        [("friction.belt.belt", 0.01, 3.0), ("friction.belt.static", 0.21, 2.0), ("friction.belt.sliding", 0.0, 0.39)]
    {
        let path = over.0;
        for direction in [Direction::Up, Direction::Down] {
            let points = branch(&machine, over, direction);
            assert_eq!(points.last().unwrap().event, Some(BranchEvent::EndOfRange), "{path}");
            for SolutionPoint { value, cycle, event, .. } in &points {
                assert!(event.is_none_or(|event| event.ends()), "{path} {value}: {event:?}");
                let there = machine.with(path, *value).unwrap();
                let of = |path| there.number(path).unwrap();
                let (belt, jump) = (of("friction.belt.belt"), of("friction.belt.static") - of("friction.belt.sliding"));
                let expected = 2.0 * jump / belt + PI + 2.0 * (belt / jump).atan();
                assert!(
                    (cycle.period - expected).abs() < 1e-12 * expected,
                    "{path} {value}: {} {expected}",
                    cycle.period
                );
                assert_eq!(cycle.label.to_string(), "0/T");
                assert!(cycle.multipliers.len() == 1 && cycle.multipliers[0].modulus() < 1e-12);
            }
        }
    }
}

/// Simulation from close to a point settles into its cycle if that is stable, and leaves it otherwise. Returns the number of
/// points that were compared.
fn compared(machine: &Machine, path: &str, points: &[SolutionPoint]) -> (u32, u32) {
    let mut counts = (0, 0);
    let step = if is_long() { 5 } else { 15 };
    for (k, SolutionPoint { value, cycle, event, .. }) in points.iter().enumerate() {
        let apart = |other: &SolutionPoint| other.event.is_none() || (other.value - value).abs() > 1e-4;
        let beside = &points[k.saturating_sub(4)..(k + 5).min(points.len())];
        let largest = cycle.multipliers[0].modulus();
        if k % step > 0 || event.is_some() || !beside.iter().all(apart) || (0.97..1.03).contains(&largest) {
            continue;
        }
        let there = machine.with(path, *value).unwrap();
        let mut start = cycle.state.clone();
        start.q[1] += 1e-8;
        let found = settled(&there, &start);
        let same = matches!(&found, Verdict::Periodic(found) if found.same_as(cycle, 1e-6));
        assert_eq!(same, cycle.stable(), "{path} {value}: {} {}", found.label(), cycle.label);
        if let Verdict::Periodic(found) = &found
            && same
        {
            assert!((found.period - cycle.period).abs() < 1e-11 * cycle.period);
        }
        if same { counts.0 += 1 } else { counts.1 += 1 }
    }
    counts
}

/// Points of branches with a stop, through changes of their events, against simulation: every fifteenth of
/// two machines, or with `VIBROIMPACT_LONG=1` every fifth of three.
#[test]
fn simulation_agrees() {
    let (mut events, mut counts) = (BTreeMap::new(), (0, 0));
    let all = [(0.2, 0.9, 0.5), (0.15, 0.65, 0.9), (0.12, 0.6, 0.2)];
    for (belt, gap, restitution) in all.into_iter().take(if is_long() { 3 } else { 2 }) {
        let machine = pair(belt, gap, restitution);
        for over in [
            ("stop.stop.gap", 0.57, 1.2),
            ("friction.belt.belt", 0.05, 0.4),
            ("stop.stop.restitution", 0.0, 1.0),
            ("stiffness.low.low", 1.2, 2.2),
        ] {
            for direction in [Direction::Up, Direction::Down] {
                let points = branch(&machine, over, direction);
                let own = compared(&machine, over.0, &points);
                counts = (counts.0 + own.0, counts.1 + own.1);
                for event in points.iter().filter_map(|point| point.event) {
                    *events.entry(event.name()).or_insert(0) += 1;
                }
            }
        }
    }
    assert!(counts.0 > 50 && counts.1 > 15, "{counts:?}");
    for name in ["fold", "flip", "torus", "grazing", "corner", "holding ends"] {
        assert!(events.contains_key(name), "{name} {events:?}");
    }
}

/// A hold that ends at an impact, or by its own limit just after: where both are at one time, events change their order.
#[test]
fn a_joint_that_an_impact_frees() {
    let points = branch(&pair(0.2, 0.9, 0.5), ("stiffness.low.low", 1.2, 2.2), Direction::Down);
    let at =
        points.iter().position(|point| (point.value - 1.348_381_87).abs() < 1e-7 && point.event.is_some()).unwrap();
    assert_eq!(points[at].event, Some(BranchEvent::Corner { first: 1, second: 0 }));
    let apart = |cycle: &Cycle| {
        let time = |kind| cycle.events.iter().find(|event| event.kind == kind).unwrap().time;
        time(EventKind::Slip) - time(EventKind::Impact)
    };
    assert_eq!(apart(&points[at - 1].cycle), 0.0);
    assert!((1e-8..1e-4).contains(&apart(&points[at + 1].cycle)), "{}", apart(&points[at + 1].cycle));
}

/// Without its closing the cycle is the one of half its period, which does not depend on the stop.
#[test]
fn the_smallest_period_beyond_a_grazing_contact() {
    let machine = pair(0.15, 0.65, 0.9);
    let points = branch(&machine, ("stop.stop.gap", 0.6, 1.2), Direction::Up);
    let at = points.iter().position(|p| matches!(p.event, Some(BranchEvent::Grazing { .. }))).unwrap();
    let (before, after) = (&points[at - 1].cycle, &points[at + 1].cycle);
    assert_eq!((before.label.to_string().as_str(), after.label.to_string().as_str()), ("1/T", "0/T"));
    assert!((before.period / after.period - 3.0).abs() < 1e-2, "{} {}", before.period, after.period);
    for SolutionPoint { value, cycle, .. } in &points[at + 1..] {
        assert!((cycle.period - after.period).abs() < 1e-12 * after.period);
        let there = machine.with("stop.stop.gap", *value).unwrap();
        let simulated = settled(&there, &cycle.state);
        assert!(matches!(simulated, Verdict::Periodic(found) if found.same_as(cycle, 1e-9)), "{value}");
    }
}

/// At a flip begins the branch of twice the period. It ends there too.
#[test]
fn a_branch_from_a_flip() {
    let machine = pair(0.2, 0.9, 0.5);
    let over = ("stiffness.low.low", 1.2, 3.0);
    let points = branch(&machine, over, Direction::Down);
    let flip = points.iter().find(|point| point.event == Some(BranchEvent::Flip)).unwrap();
    assert!((flip.cycle.multipliers[0].re + 1.0).abs() < 1e-10);
    let (family, _) = Family::of_path(&machine, over.0).unwrap();
    let (value, doubled) = flip.leaving(&family, 0.25 * (over.2 - over.1)).pop().unwrap();
    assert_eq!(doubled.label.to_string(), "2/T");
    assert!((doubled.period / flip.cycle.period - 2.0).abs() < 1e-2);
    let there = machine.with(over.0, value).unwrap();
    let mut halved = false;
    for direction in [Direction::Up, Direction::Down] {
        let points = from(&there, &doubled, over, direction);
        compared(&machine, over.0, &points);
        let last = points.last().unwrap();
        if last.event == Some(BranchEvent::Halving) {
            assert!((last.value - flip.value).abs() < 1e-7, "{} {}", last.value, flip.value);
            halved = true;
        }
    }
    assert!(halved);
}

/// A mass between two belts that move in opposite directions, with another one between two stops: the cycle that is its own
/// mirror image loses this symmetry, and two cycles begin that are mirror images of each other.
#[test]
fn both_cycles_beside_a_branch_point() {
    let parts = MachineParts::new(["low", "high"])
        .with_mass(0, 1.0)
        .with_mass(1, 0.54)
        .with_link(&[1.0, 0.0], 1.0, 0.01)
        .with_link(&[1.0, -1.0], 1.12, 0.09)
        .with_rigid_stop("right", &[0.0, 1.0], 0.53, 0.74)
        .with_rigid_stop("left", &[0.0, -1.0], 0.53, 0.74)
        .with_joint("up", &[1.0, 0.0], 0.3, 0.83, 0.1)
        .with_joint("down", &[1.0, 0.0], 0.3, 0.83, -0.1);
    let machine = Machine::new(parts).unwrap();
    let symmetric = cycle(&machine, &Start { q: vec![0.3, 0.1], qdot: vec![0.1, 0.3], phase: 0.0, ..Start::default() });
    let speeds = |cycle: &Cycle| {
        [0, 1].map(|stop| cycle.events.iter().find(|event| event.closes() && event.place == stop).unwrap().speed)
    };
    let [right, left] = speeds(&symmetric);
    assert!((right - left).abs() < 1e-9 && symmetric.stable(), "{right} {left}");
    let over = ("stiffness.high.high", 0.9, 1.2);
    let points = from(&machine, &symmetric, over, Direction::Down);
    let point = points.iter().find(|point| point.event == Some(BranchEvent::BranchPoint)).unwrap();
    let (family, _) = Family::of_path(&machine, over.0).unwrap();
    let leaving = point.leaving(&family, 0.25 * (over.2 - over.1));
    let [one, other] = leaving.as_slice() else { panic!("{} cycles at {}", leaving.len(), point.value) };
    let ([right, left], mirrored) = (speeds(&one.1), speeds(&other.1));
    assert!((right - left).abs() > 1e-4 && one.0 == other.0, "{right} {left}");
    assert!((right - mirrored[1]).abs() < 1e-9 && (left - mirrored[0]).abs() < 1e-9, "{right} {left} {mirrored:?}");
    let there = machine.with(over.0, one.0).unwrap();
    for (_, cycle) in &leaving {
        // the motion from its state returns there after one period
        let motion = Motion::new(&there, &cycle.state, Limits::default()).unwrap();
        let events: Vec<_> = motion.into_iter().take(2 * cycle.events.len()).collect();
        let (first, last) = (&events[cycle.events.len() - 1], events.last().unwrap());
        assert!((last.time - first.time - cycle.period).abs() < 1e-8, "{} {}", last.time - first.time, cycle.period);
    }
}

/// A constant force pulls a carriage with drag, which pulls a block on the ground by a spring: nothing holds them in place.
#[test]
fn a_drifting_cycle() {
    let parts = MachineParts::new(["carriage", "block"])
        .with_mass(0, 20.0)
        .with_mass(1, 1.0)
        .with_link(&[1.0, 0.0], 0.0, 5.0)
        .with_link(&[1.0, -1.0], 1.0, 0.02)
        .with_constant(0, 0.9)
        .with_joint("ground", &[0.0, 1.0], 0.3, 0.6, 0.0);
    let machine = Machine::new(parts).unwrap();
    let start = Start { q: vec![0.0; 2], qdot: vec![0.0; 2], phase: 0.0, ..Start::default() };
    let cycle = cycle(&machine, &start);
    for over in [("constant.carriage", 0.65, 1.4), ("friction.ground.sliding", 0.1, 0.5)] {
        for direction in [Direction::Up, Direction::Down] {
            let points = from(&machine, &cycle, over, direction);
            assert!(compared(&machine, over.0, &points).0 > 3);
            for SolutionPoint { cycle, .. } in &points {
                // both move on by the same
                assert!(cycle.drift[0] > 0.1 && (cycle.drift[0] - cycle.drift[1]).abs() < 1e-12 * cycle.drift[0]);
            }
        }
    }
}

/// The search from scattered starts finds the cycle of a branch where no motion settles into it, coexisting stable ones, and an
/// unstable one on the border of their basins.
#[test]
fn limit_cycles_with_a_label() {
    let find = |machine: &Machine, label| {
        let starts = (0..48).map(|k| scattered_machine_starts(machine, 1, k));
        find_machine_while(machine, Label::unforced(label).unwrap(), starts, &|| true).unwrap()
    };
    let points = branch(&pair(0.2, 0.9, 0.5), ("stop.stop.gap", 0.7, 1.2), Direction::Down);
    let unstable = points.last().unwrap();
    assert_eq!((unstable.value, unstable.event), (0.7, Some(BranchEvent::EndOfRange)));
    let found = find(&pair(0.2, 0.7, 0.5), "1/T");
    assert!(!unstable.cycle.stable() && found.iter().any(|cycle| cycle.same_as(&unstable.cycle, 1e-8)), "{found:?}");
    let machine = pair(0.15, 0.688, 0.9);
    let (none, one) = (find(&machine, "0/T"), find(&machine, "1/T"));
    assert!(none.len() == 1 && one.len() > 1, "{none:?} {one:?}");
    // the unstable one and a stable one meet at a fold
    let fold = |cycle: &Cycle| {
        let points = from(&machine, cycle, ("stop.stop.gap", 0.6, 0.9), Direction::Up);
        points.iter().find(|point| point.event == Some(BranchEvent::Fold)).map(|point| point.value)
    };
    let unstable = one.iter().find(|cycle| !cycle.stable()).and_then(fold).unwrap();
    let mut stable = one.iter().filter(|cycle| cycle.stable()).filter_map(fold);
    assert!(stable.any(|value| (value - unstable).abs() < 1e-10), "{unstable}");
    for cycle in none.iter().chain(&one).filter(|cycle| cycle.stable()) {
        let simulated = settled(&machine, &cycle.state);
        assert!(matches!(simulated, Verdict::Periodic(found) if found.same_as(cycle, 1e-9)));
    }
}

/// Where the velocity of the sliding mass reaches that of the belt, it is held from there on, and all that follows is another
/// motion, in which the stop closes once more. The branch ends, and says why.
#[test]
fn the_begin_of_a_hold_that_changes_all_that_follows() {
    let soft = StopLaw::Compliant { stiffness: 20.0, damping: 0.0, preload: 0.0, opening: Opening::Force };
    let parts = MachineParts::new(["a", "b"])
        .with_mass(0, 1.0)
        .with_mass(1, 0.978_470_655)
        .with_link(&[1.0, 0.0], 1.429_642_21, 0.009_955_438_9)
        .with_link(&[1.0, -1.0], 0.726_226_645, 0.023_784_187_8)
        .with_stop("stop", &[0.0, 1.0], 0.697_548_818, soft)
        .with_joint("belt", &[1.0, 0.0], 0.174_757_666, 0.492_439_166, 0.106_863_861);
    let machine = Machine::new(parts).unwrap();
    let points = branch(&machine, ("friction.belt.belt", 0.1, 0.5), Direction::Up);
    let events: Vec<_> = points.iter().filter_map(|point| Some((point.event?, point.value))).collect();
    let [(BranchEvent::Holding { joint: 1, begins: true }, value), (BranchEvent::Discontinuity, _)] = events[..] else {
        panic!("{events:?}")
    };
    // before, the velocity of the sliding mass comes ever closer to that of the belt
    let nearest = |belt: f64, cycle: &Cycle| {
        let there = machine.with("friction.belt.belt", belt).unwrap();
        let times = (cycle.period, cycle.period / 20_000.0);
        let samples = Samples::new(&there, &cycle.state, Limits::default(), times).unwrap();
        let rates: Vec<f64> = samples
            .map(|sample| if sample.states[1] == ContactState::Holding { 0.0 } else { sample.qdot[0] - belt })
            .collect();
        let highest = rates.windows(3).filter(|rates| rates[1] < 0.0 && rates[0] < rates[1] && rates[2] < rates[1]);
        highest.map(|rates| rates[1]).fold(f64::NEG_INFINITY, f64::max)
    };
    let at = points.iter().position(|point| point.event.is_some()).unwrap();
    let [(early, rate), (late, slower)] =
        [&points[at - 2], &points[at - 1]].map(|point| (point.value, nearest(point.value, &point.cycle)));
    assert!(rate < slower && slower < 0.0, "{rate} {slower}");
    let zero = late - slower * (late - early) / (slower - rate);
    assert!((zero - value).abs() < 2e-2 * (value - late), "{zero} {value} {late}");
    let before = &points[at - 1];
    // beyond, no motion with these events is left
    let beyond = settled(&machine.with("friction.belt.belt", value + 1e-6).unwrap(), &before.cycle.state);
    assert!(!matches!(beyond, Verdict::Periodic(found) if (found.period / before.cycle.period - 1.0).abs() < 1e-2));
}

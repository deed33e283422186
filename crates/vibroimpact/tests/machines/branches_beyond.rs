//! Branches of machines through events at which the motion is not smooth, against simulation beside them.

use crate::curves::hammer;
use vibroimpact::continuation::{
    BranchEvent, BranchOptions, Direction,
    machine::{Branch, Family, SolutionPoint},
};
use vibroimpact::events::Start;
use vibroimpact::machine::{HarmonicMotion, Machine, MachineParts, Opening, StopLaw};
use vibroimpact::math::Matrix;
use vibroimpact::orbit::{Label, Stability, machine::Cycle};
use vibroimpact::verdict::{SettleOptions, Verdict, settle_machine};

pub(crate) fn settled(machine: &Machine, start: &Start) -> Option<Cycle> {
    match settle_machine(machine, start, &SettleOptions::default()).unwrap().verdict {
        Verdict::Periodic(cycle) => Some(cycle),
        _ => None,
    }
}

pub(crate) fn traced(
    (machine, path): (&Machine, &str),
    cycle: &Cycle,
    range: (f64, f64),
    direction: Direction,
) -> Vec<SolutionPoint> {
    let (family, value) = Family::of_path(machine, path).unwrap();
    let options = BranchOptions { points: 400, ..BranchOptions::default() };
    Branch::new((&family, value), cycle, &(range.0..=range.1), direction, options).unwrap().collect()
}

/// The events of a branch.
pub(crate) fn events(points: &[SolutionPoint]) -> Vec<(BranchEvent, f64)> {
    points.iter().filter_map(|point| Some((point.event?, point.value))).collect()
}

/// Beside all events, at stable points, motions that begin close to the cycle settle into it. Returns how many were compared.
pub(crate) fn agrees_with_simulation((machine, path): (&Machine, &str), points: &[SolutionPoint]) -> usize {
    let mut compared = 0;
    for (k, point) in points.iter().enumerate().filter(|(_, point)| point.event.is_some()) {
        let others = points[..k].iter().rev().take(6).chain(points[k + 1..].iter().take(6));
        for other in others.filter(|other| other.event.is_none() && (other.value - point.value).abs() > 1e-6) {
            // a multiplier is without limit at a grazing contact, so the cycle attracts little of its neighbourhood
            let near = points.iter().any(|event| event.event.is_some() && (event.value - other.value).abs() < 1e-6);
            if near || other.cycle.multipliers[0].modulus() > 0.9 {
                continue;
            }
            let there = machine.with(path, other.value).unwrap();
            let cycle = settled(&there, &other.cycle.state).unwrap();
            assert_eq!(cycle.label, other.cycle.label, "{path} {} beside {:?}", other.value, point.event);
            compared += 1;
        }
    }
    compared
}

/// Two masses, coupled by their inertia too, one on a joint whose static limit exceeds its sliding force.
fn with_static_friction(mass: f64) -> (Machine, Start) {
    let pair = |a: f64, b: f64, c: f64| {
        let mut matrix = Matrix::zeros(2, 2);
        for (i, j, value) in [(0, 0, a), (0, 1, b), (1, 0, b), (1, 1, c)] {
            matrix[(i, j)] = value;
        }
        matrix
    };
    let law = StopLaw::Compliant { stiffness: 92.04, damping: 5.0, preload: 0.1, opening: Opening::Force };
    let mut parts = MachineParts::new(["x1", "x2"]);
    parts.mass = pair(mass, 0.4576, 1.521);
    parts.stiffness = pair(1.056, -0.5364, 0.5364);
    parts.damping = pair(0.0701, -0.01973, 0.01973);
    parts.constant = vec![-0.1162, -0.0942];
    let parts = parts
        .with_frequency(0.5291)
        .with_force(0, 1, -0.3813, -0.836)
        .with_force(0, 2, -0.1056, -0.8552)
        .with_rigid_stop("s0", &[1.0, -1.0], 0.0, 0.7199)
        .with_stop("s1", &[0.0, -1.0], 0.4182, law)
        .with_joint("f0", &[1.0, 0.0], 0.194, 0.291, 0.0);
    let start = Start { q: vec![-0.4459, 0.3194], qdot: vec![-0.6075, 0.2837], phase: 1.938, ..Start::default() };
    (Machine::new(parts).unwrap(), start)
}

/// A hold that lasts ceases where the velocity of its joint only touches zero: with a static limit above the sliding force the
/// motion is not continuous there, and the branch goes on where the cycle without this hold begins to exist. Between both there
/// are cycles of several periods.
#[test]
fn f42j_a_hold_that_vanishes() {
    let (machine, start) = with_static_friction(1.53);
    let cycle = settled(&machine, &start).unwrap();
    let points = traced((&machine, "mass.x1"), &cycle, (0.918, 1.53), Direction::Down);
    let events = events(&points);
    let at = events.iter().position(|(event, _)| *event == BranchEvent::Jump).unwrap();
    let (last, value) = events[at - 1];
    assert!(last == BranchEvent::Holding { joint: 2, begins: false }, "{events:?}");
    assert!((value - 1.075_901_139).abs() < 1e-8 && (events[at].1 - 1.073_511_5).abs() < 1e-6, "{events:?}");
    assert!(matches!(events.last(), Some((BranchEvent::EndOfRange, end)) if *end == 0.918), "{events:?}");
    assert!(agrees_with_simulation((&machine, "mass.x1"), &points) > 10);
    // simulation beside both, and between them
    let label = |mass: f64, from: &SolutionPoint| {
        settled(&with_static_friction(mass).0, &from.cycle.state).unwrap().label.to_string()
    };
    let beside = points.iter().find(|point| point.event == Some(BranchEvent::Jump)).unwrap();
    assert_eq!([1.07595, 1.0755, 1.0745, 1.0734].map(|mass| label(mass, beside)), ["3/1", "6/2", "6/2", "3/1"]);
}

/// One mass that strikes a preloaded, damped stop twice in a period.
fn preloaded_mass() -> Machine {
    let law = StopLaw::Compliant { stiffness: 40.5863, damping: 0.4704, preload: 0.1317, opening: Opening::Position };
    let parts = MachineParts::new(["x"])
        .with_mass(0, 0.597)
        .with_link(&[1.0], 0.5406, 0.1628)
        .with_frequency(0.7198)
        .with_force(0, 1, 0.191, 1.3297)
        .with_stop("stop", &[1.0], 0.3605, law);
    Machine::new(parts).unwrap()
}

/// Three masses, two of which strike each other on a preloaded, damped stop.
fn preloaded_chain() -> Machine {
    let law = StopLaw::Compliant { stiffness: 35.4867, damping: 2.9538, preload: 0.1956, opening: Opening::Position };
    let parts = MachineParts::new(["a", "b", "c"])
        .with_mass(0, 1.2581)
        .with_mass(1, 1.1805)
        .with_mass(2, 1.1011)
        .with_link(&[1.0, 0.0, 0.0], 0.6526, 0.2383)
        .with_link(&[-1.0, 1.0, 0.0], 1.4186, 0.1529)
        .with_link(&[0.0, -1.0, 1.0], 0.811, 0.0746)
        .with_frequency(1.0164)
        .with_force(1, 1, 0.4735, 0.9277)
        .with_stop("stop", &[0.0, 1.0, -1.0], 0.5733, law);
    Machine::new(parts).unwrap()
}

/// Where a contact of a preloaded, damped stop begins or ceases to be a part of the cycle, the branch goes on with a grazing event.
/// There the multiplier is without limit, and the number turns back.
#[test]
fn f42k_preloaded_contacts_that_graze() {
    let grazing = |appears| BranchEvent::Grazing { stop: 0, also: None, appears, turns: true, detail: None };
    let (fold, flip, end) = (BranchEvent::Fold, BranchEvent::Flip, BranchEvent::EndOfRange);
    let lost = BranchEvent::LossOfContact { stop: 0, detail: None };
    let (mass, chain) = (preloaded_mass(), preloaded_chain());
    let mut compared = 0;
    for (machine, path, range, direction, want) in [
        (
            &mass,
            "frequency",
            (0.53985, 0.93574),
            Direction::Down,
            vec![(grazing(true), 0.570_747_424), (fold, 0.578_750_564), (end, 0.53985)],
        ),
        (
            &mass,
            "frequency",
            (0.53985, 0.93574),
            Direction::Up,
            vec![(fold, 0.819_535_091), (grazing(false), 0.811_413_849), (end, 0.93574)],
        ),
        (
            &chain,
            "frequency",
            (0.7623, 1.32132),
            Direction::Up,
            vec![(fold, 1.224_270_718), (flip, 1.206_562_463), (lost, 1.206_189_790)],
        ),
        (
            &chain,
            "stop.stop.gap",
            (0.1733, 1.3733),
            Direction::Down,
            vec![(grazing(true), 0.266_724_676), (fold, 0.275_504_284), (end, 0.1733)],
        ),
    ] {
        let cycle = settled(machine, &Start::default()).unwrap();
        let points = traced((machine, path), &cycle, range, direction);
        let found = events(&points);
        assert_eq!(found.len(), want.len(), "{path} {direction:?}: {found:?}");
        for ((event, value), (expected, at)) in found.iter().zip(&want) {
            assert!(event == expected && (value - at).abs() < 1e-8, "{path} {direction:?}: {found:?}");
        }
        let near = agrees_with_simulation((machine, path), &points);
        assert!(near > 2, "{path} {direction:?} {found:?} {near}");
        compared += near;
    }
    assert!(compared > 30, "{compared}");
}

/// A stop on which the structure rests while another one is struck is pushed and does not close: it is not counted.
#[test]
fn f42l_labels_count_closings_only() {
    // the first body is pressed on the wall; the second one strikes it from the other side
    let parts = MachineParts::new(["anvil", "hammer"])
        .with_mass(0, 1.0)
        .with_mass(1, 0.5)
        .with_link(&[1.0, 0.0], 1.0, 0.1)
        .with_link(&[0.0, 1.0], 0.6, 0.1)
        .with_constant(0, 30.0)
        .with_frequency(0.9)
        .with_force(1, 1, 0.0, 0.7)
        .with_rigid_stop("wall", &[1.0, 0.0], 0.1, 0.0)
        .with_rigid_stop("head", &[-1.0, 1.0], 0.3, 0.5);
    let machine = Machine::new(parts).unwrap();
    let start = Start { q: vec![0.1, 0.0], qdot: vec![0.0, 0.0], phase: 0.0, ..Start::default() };
    let cycle = settled(&machine, &start).unwrap();
    let closings = |place| cycle.events.iter().filter(|event| event.closes() && event.place == place).count();
    assert!(cycle.events.iter().any(|event| event.closes() && event.place == 1 && event.with == [0]), "{cycle:?}");
    assert_eq!(cycle.counts.iter().map(|count| *count as usize).collect::<Vec<_>>(), [closings(0), closings(1)]);
    assert!(closings(0) == 0 && closings(1) > 0 && cycle.label.to_string().starts_with(&format!("{}/", closings(1))));
}

/// The capsule of the catalogue: a closed stop loses its force for an instant, and beyond it opens and closes again. That is a grazing
/// contact, in both directions. With 30 digits, from the closed forms of the regimes between the events, it is at the frequency
/// 0.123374360093306278.
#[test]
fn f42n_a_closed_stop_that_opens_for_no_time() {
    let mut parts = MachineParts::new(["mass", "capsule"])
        .with_mass(0, 1.0)
        .with_mass(1, 5.0)
        .with_link(&[1.0, -1.0], 1.0, 0.1)
        .with_force(0, 1, 1.6, 0.0)
        .with_stop(
            "plate",
            &[1.0, -1.0],
            0.02,
            StopLaw::Compliant { stiffness: 15.0, damping: 0.0, preload: 0.0, opening: Opening::Force },
        )
        .with_joint("surface", &[0.0, 1.0], 1.0, 1.0, 0.0);
    for (from, to, direction, appears) in
        [(0.1232, 0.1236, Direction::Up, true), (0.1236, 0.1232, Direction::Down, false)]
    {
        parts.frequency = Some(from);
        let machine = Machine::new(parts.clone()).unwrap();
        let cycle = settled(&machine, &Start::default()).unwrap();
        let range = (f64::min(from, to), f64::max(from, to));
        let points = traced((&machine, "frequency"), &cycle, range, direction);
        let events = events(&points);
        let grazing = BranchEvent::Grazing { stop: 0, also: None, appears, turns: false, detail: None };
        assert!(
            matches!(events.as_slice(), [(event, _), (BranchEvent::EndOfRange, _)] if *event == grazing),
            "{events:?}"
        );
        assert!((events[0].1 - 0.123_374_360_093_306_28).abs() < 2e-15, "{events:?}");
    }
}

/// A hold with a static limit above its sliding force ends, and the cycle beyond is another one. It exists right there, and the branch
/// says with a jump that it does not continue the motion.
#[test]
fn a_hold_that_ends_in_a_jump() {
    let machine = |frequency: f64| {
        let parts = MachineParts::new(["x0", "x1"])
            .with_frequency(frequency)
            .with_mass(0, 1.328_142_036_290_394)
            .with_link(&[1.0, 0.0], 0.864_963_678_733_350_8, 0.040_037_357_332_829_26)
            .with_mass(1, 0.748_117_126_780_899_4)
            .with_link(&[-1.0, 1.0], 1.317_285_143_524_758_1, 0.121_547_426_989_143_24)
            .with_force(0, 1, -0.164_961_417_137_048_15, 1.492_879_042_427_676_8)
            .with_rigid_stop("stop", &[-1.0, 1.0], -0.101_773_904_033_291_03, 0.742_753_547_749_479_3)
            .with_joint("floor", &[0.0, 1.0], 0.349_176_882_905_587_6, 0.546_401_058_361_651_5, 0.0);
        Machine::new(parts).unwrap()
    };
    let from = machine(1.2831);
    let cycle = settled(&from, &Start::default().within_stops(&from)).unwrap();
    let points = traced((&from, "frequency"), &cycle, (1.08, 1.3), Direction::Down);
    let at = points.iter().position(|point| matches!(point.event, Some(BranchEvent::Holding { begins: false, .. })));
    let [.., before, end, beyond] = &points[..at.unwrap() + 2] else { panic!("{:?}", events(&points)) };
    assert!((end.value - 1.098_300_354).abs() < 1e-8, "{:?}", events(&points));
    assert_eq!(beyond.event, Some(BranchEvent::Jump), "{:?}", events(&points));
    let apart = |a: &SolutionPoint, b: &SolutionPoint| (a.cycle.fastest() - b.cycle.fastest()).abs();
    assert!(apart(end, beyond) > 10.0 * apart(before, end), "{} {}", apart(end, beyond), apart(before, end));
}

/// At a bifurcation a multiplier is on the unit circle, whatever its last digits are.
#[test]
fn a_cycle_at_a_bifurcation_is_not_stable() {
    let family = Family::new(|frequency| hammer(frequency, 0.5));
    let cycle = settled(&hammer(1.2, 0.5).unwrap(), &Start::default()).unwrap();
    let branch = Branch::new((&family, 1.2), &cycle, &(0.8..=1.2), Direction::Down, BranchOptions::default()).unwrap();
    let mut bifurcations = 0;
    for point in branch {
        if matches!(point.event, Some(BranchEvent::Fold | BranchEvent::Flip | BranchEvent::Torus)) {
            bifurcations += 1;
            let (each, multipliers) = (point.cycle.stabilities(), &point.cycle.multipliers);
            assert!(each.contains(&Stability::Neutral), "{:?} {multipliers:?}", point.event);
        }
    }
    assert!(bifurcations > 1);
}

/// Bodies on tables that shake, with this restitution.
fn balls(n: usize, restitution: f64, gamma: f64) -> Machine {
    let mut parts = MachineParts::new((1..=n).map(|k| format!("b{k}"))).with_frequency(1.0);
    for k in 0..n {
        let down: Vec<f64> = parts.along(k).iter().map(|w| -w).collect();
        let name = format!("f{}", k + 1);
        parts = parts.with_mass(k, 1.0).with_constant(k, -1.0).with_rigid_stop(&name, &down, 0.0, restitution);
        parts.stops[k].motion = vec![HarmonicMotion { order: 1, cos: 0.0, sin: gamma }];
    }
    Machine::new(parts).unwrap()
}

/// A table with an acceleration of exactly g pushes a ball at all times but one, at which it does not push. The verdict was undecided.
#[test]
fn a_ball_on_a_table_of_exactly_g_rests_for_ever() {
    let verdict = |n: usize, restitution: f64, gamma: f64| {
        let start = Start { q: vec![1.0; n], ..Start::default() };
        settle_machine(&balls(n, restitution, gamma), &start, &SettleOptions::default()).unwrap().verdict
    };
    for (n, restitution) in [(1, 0.4), (2, 0.4), (1, 0.0)] {
        assert!(matches!(verdict(n, restitution, 1.0), Verdict::Stuck(_)), "{n} {restitution}");
        assert!(matches!(verdict(n, restitution, 1.0 + 1e-6), Verdict::Periodic(_)), "{n} {restitution}");
    }
}

/// Where the table is accelerated less than a falling body a ball rests for ever: the branch of its motion ends there, at the
/// frequency sqrt(1/Gamma), or at Gamma = 1. It ended without convergence or turned back at a `change`. Two balls beside each other are one
/// ball twice, and the upper one of a stack has nothing to say.
#[test]
fn f42x_a_branch_ends_where_a_ball_rests_for_ever() {
    let mut stack = balls(2, 0.0, 1.5).parts().clone();
    (stack.stops[1].direction, stack.stops[1].motion) = (vec![1.0, -1.0], Vec::new());
    let stack = Machine::new(stack).unwrap();
    let cases = [
        (stack, "frequency", 0.5, (1.0 / 1.5_f64).sqrt()),
        (balls(1, 0.4, 1.2), "frequency", 0.7, (1.0 / 1.2_f64).sqrt()),
        (balls(2, 0.4, 1.2), "frequency", 0.7, (1.0 / 1.2_f64).sqrt()),
        (balls(1, 0.5, 1.2), "stop.f1.motion.1.sin", 0.9, 1.0),
    ];
    for (machine, path, low, limit) in cases {
        let start = Start { q: vec![3.0; machine.n()], ..Start::default() };
        let cycle = settled(&machine, &start).unwrap();
        let high = machine.number(path).unwrap();
        let (family, value) = Family::of_path(&machine, path).unwrap();
        let branch = Branch::new((&family, value), &cycle, &(low..=high), Direction::Down, BranchOptions::default());
        let points: Vec<SolutionPoint> = branch.unwrap().collect();
        let found = events(&points);
        let [(BranchEvent::RestForEver { stop: 0 }, at)] = found[..] else { panic!("{path}: {found:?}") };
        assert!((at - limit).abs() < 1e-12, "{path}: {at} instead of {limit}");
        // the flight vanishes on the way there
        assert!(points[points.len() - 2].value - limit < 3e-3, "{path}");
    }
}

/// A chatter that moves a friction joint: how many of its impacts are followed, each with the joint that turns back after it, is no event.
/// Over the frequency it was a `corner` eleven times, although simulation has the same events on both sides.
#[test]
fn f42y_a_chatter_with_a_joint_has_no_corners() {
    let parts = MachineParts::new(["x"])
        .with_mass(0, 1.0)
        .with_link(&[1.0], 1.0, 0.1)
        .with_frequency(0.5)
        .with_force(0, 1, 0.0, 1.5)
        .with_rigid_stop("wall", &[1.0], 0.5, 0.6)
        .with_joint("guide", &[1.0], 0.2, 0.2, 0.0);
    let machine = Machine::new(parts).unwrap();
    let cycle = settled(&machine, &Start::default()).unwrap();
    let points = traced((&machine, "frequency"), &cycle, (0.3, 0.5), Direction::Down);
    assert_eq!(events(&points), [(BranchEvent::EndOfRange, 0.3)]);
}

/// Two balls beside each other have the branch of one, through the end of their rests and all grazing contacts and folds beyond. Their
/// impacts are at the same times, so the gap of only one of them times an event, and nothing tied the place of the other one: cycles of
/// free bodies that strike together had no branch, and this one turned back at a `change`.
#[test]
fn f42z_bodies_beside_each_other_have_the_branch_of_one() {
    let events_of = |n: usize| -> Vec<(BranchEvent, f64)> {
        let machine = balls(n, 0.4, 1.2);
        let cycle = settled(&machine, &Start { q: vec![1.0; n], ..Start::default() }).unwrap();
        events(&traced((&machine, "frequency"), &cycle, (1.0, 1.213), Direction::Up))
    };
    let (one, two) = (events_of(1), events_of(2));
    assert!(one.iter().any(|(event, _)| *event == BranchEvent::Flip));
    assert!(
        matches!(one[0], (BranchEvent::Sticking { stop: 0, begins: false, .. }, at) if (at - 1.209_992_208).abs() < 1e-8)
    );
    // where the impacts of a chatter have just become finitely many, the one that is left first is not always told
    let told = |all: &[(BranchEvent, f64)]| all.iter().filter(|(_, at)| *at > 1.2103).copied().collect::<Vec<_>>();
    let (one, two) = (told(&one), told(&two));
    assert_eq!(one.len(), two.len(), "{one:?} {two:?}");
    for ((event, at), (other, beside)) in one.into_iter().zip(two) {
        // of two balls both stops are named
        let (alone, also) = match other {
            BranchEvent::Grazing { stop, also, appears, turns, detail } => {
                (BranchEvent::Grazing { stop, also: None, appears, turns, detail }, also)
            }
            other => (other, None),
        };
        assert_eq!(event, alone);
        assert!(also.is_none_or(|also| also == 1), "{other:?}");
        assert!((at - beside).abs() < 1e-7, "{event:?} at {at} and {beside}");
    }
}

/// Pairs of equal bodies with a preloaded stop and friction between them, under opposite forces.
fn rubbing_pairs(count: usize, frequency: f64) -> Machine {
    let law = StopLaw::Compliant { stiffness: 30.0, damping: 1.0, preload: 0.1, opening: Opening::Force };
    let along = |factors: &[(usize, f64)]| {
        let mut direction = vec![0.0; 2 * count];
        factors.iter().for_each(|(k, factor)| direction[*k] = *factor);
        direction
    };
    let mut parts = MachineParts::new((0..2 * count).map(|k| format!("x{k}"))).with_frequency(frequency);
    for pair in 0..count {
        let (a, b) = (2 * pair, 2 * pair + 1);
        for (k, force) in [(a, 1.0), (b, -1.0)] {
            parts = parts.with_mass(k, 1.0).with_link(&along(&[(k, 1.0)]), 1.0, 0.1).with_force(k, 1, 0.0, force);
        }
        let between = along(&[(a, 1.0), (b, -1.0)]);
        parts = parts.with_stop(&format!("c{pair}"), &between, 0.3, law).with_joint(
            &format!("f{pair}"),
            &between,
            0.1,
            0.1,
            0.0,
        );
    }
    Machine::new(parts).unwrap()
}

/// Where friction acts beside a stop, its joint turns back just when the gap is least. A grazing contact there is inserted around that:
/// the branch ended without convergence, although the stable 3/1 follows. From the other side it has the same events, and so have two
/// pairs beside each other.
#[test]
fn f42za_a_contact_that_grazes_where_a_joint_turns_back() {
    let along = |count: usize, frequency: f64, direction: Direction| {
        let machine = rubbing_pairs(count, frequency);
        let cycle = settled(&machine, &Start::default()).unwrap();
        let points = traced((&machine, "frequency"), &cycle, (0.6, 0.64), direction);
        let mut found = events(&points);
        assert_eq!(found.pop().unwrap().0, BranchEvent::EndOfRange);
        (found, points.last().unwrap().cycle.label)
    };
    let (down, label) = along(1, 0.64, Direction::Down);
    let expected = [
        BranchEvent::Grazing { stop: 0, also: None, appears: true, turns: true, detail: None },
        BranchEvent::Corner { first: 0, second: 0 },
        BranchEvent::Fold,
    ];
    assert_eq!(down.iter().map(|(event, _)| *event).collect::<Vec<_>>(), expected);
    assert_eq!(label, Label::new(3, 1));
    let mut back = along(1, 0.61, Direction::Up).0;
    back.reverse();
    for other in [back, along(2, 0.64, Direction::Down).0] {
        assert_eq!(down.len(), other.len(), "{other:?}");
        for ((event, at), (other, there)) in down.iter().zip(&other) {
            assert!((at - there).abs() < 1e-8, "{event:?} at {at}, {other:?} at {there}");
        }
    }
}

/// A rigid stop that is there twice has the branch of one, from a cycle with a complete chatter: at the rest both stops pushed, which
/// has no solution, so there was no branch.
#[test]
fn f42zb_the_branch_of_a_chatter_on_a_stop_that_is_there_twice() {
    let of = |stops: &[&str]| {
        let parts = MachineParts::new(["a", "b"])
            .with_frequency(0.9)
            .with_mass(0, 1.0)
            .with_mass(1, 1.0)
            .with_link(&[1.0, 0.0], 1.0, 0.1)
            .with_link(&[0.0, 1.0], 1.0, 0.1)
            .with_force(0, 1, 0.0, 1.0);
        let machine =
            Machine::new(stops.iter().fold(parts, |parts, name| parts.with_rigid_stop(name, &[1.0, -1.0], 0.1, 0.6)))
                .unwrap();
        let cycle = settled(&machine, &Start::default()).unwrap();
        events(&traced((&machine, "frequency"), &cycle, (0.8, 0.9), Direction::Down))
    };
    let (one, two) = (of(&["s"]), of(&["s", "again"]));
    assert_eq!(one.len(), two.len(), "{one:?} {two:?}");
    for ((event, at), (other, there)) in one.iter().zip(&two) {
        assert!(event.place() == other.place() && (at - there).abs() < 1e-8, "{event:?} {other:?}");
    }
}

/// Just before a hold begins a joint slides on for an instant, and what rounding leaves of its velocity decides which of two equal
/// joints is found at zero first: the events of two pairs were other ones than those of one, and the hold began up to 1e-4 elsewhere.
#[test]
fn f42zc_holds_of_two_pairs_begin_where_those_of_one_do() {
    let of = |count: usize| {
        let machine = rubbing_pairs(count, 1.0);
        let cycle = settled(&machine, &Start::default()).unwrap();
        events(&traced((&machine, "frequency"), &cycle, (1.0, 1.12), Direction::Up))
    };
    let (one, two) = (of(1), of(2));
    let holding = |event: &BranchEvent| matches!(event, BranchEvent::Holding { .. });
    assert!(one.len() == 4 && one[..3].iter().all(|(event, _)| holding(event)), "{one:?}");
    assert_eq!(one.len(), two.len(), "{two:?}");
    for ((event, at), (other, there)) in one.iter().zip(&two) {
        assert!(holding(event) == holding(other) && (at - there).abs() < 1e-8, "{event:?} {at}, {other:?} {there}");
    }
}

/// A chain of bodies with these masses, links from each to the one before (stiffness and damping), a link of the first to the
/// ground, and a force on the last.
pub(crate) fn chain(mass: &[f64], link: &[(f64, f64)], frequency: f64, (cos, sin): (f64, f64)) -> MachineParts {
    let n = mass.len();
    let mut parts = MachineParts::new(["a", "b", "c", "d"].into_iter().take(n));
    for (i, (mass, (stiffness, damping))) in mass.iter().zip(link).enumerate() {
        parts = parts.with_mass(i, *mass);
        for (matrix, value) in [(&mut parts.stiffness, *stiffness), (&mut parts.damping, *damping)] {
            matrix[(i, i)] += value;
            if i > 0 {
                matrix[(i - 1, i - 1)] += value;
                matrix[(i - 1, i)] -= value;
                matrix[(i, i - 1)] -= value;
            }
        }
    }
    parts.with_frequency(frequency).with_force(n - 1, 1, cos, sin)
}

/// A stop without rebound is grazed like any other: beyond, the mass passes it, and the branch goes on to the end of its range. The
/// slow impacts of a chatter on another stop are no grazing contacts.
#[test]
fn a_stop_without_rebound_is_grazed() {
    let machine = Machine::new(
        chain(&[0.98, 1.213, 0.56], &[(1.478, 0.135), (1.174, 0.19), (0.613, 0.218)], 0.6028, (0.404, 1.346))
            .with_stop("plastic", &[0.0, -1.0, 1.0], -0.2, StopLaw::Rigid { restitution: 0.0 })
            .with_stop("other", &[-1.0, 0.0, 0.0], 0.547, StopLaw::Rigid { restitution: 0.133 }),
    )
    .unwrap();
    let cycle = settled(&machine, &Start::default().within_stops(&machine)).unwrap();
    let points = traced((&machine, "stiffness.a"), &cycle, (1.72, 4.2), Direction::Down);
    let found = events(&points);
    let gone = BranchEvent::Grazing { stop: 0, also: None, appears: false, turns: true, detail: None };
    assert!(found.iter().any(|(event, _)| *event == gone), "{found:?}");
    assert_eq!(found.last().unwrap().0, BranchEvent::EndOfRange, "{found:?}");
    assert!(agrees_with_simulation((&machine, "stiffness.a"), &points) > 4);
}

/// Towards a chatter that is complete at the release, impacts appear one after another at folds: the cycle with one impact more has
/// the same label, and is not the way back. The values come closer together by the factor l^5/e^2 with (2 + l) l^2 = e (1 + 2 l), and
/// at their limit a rest begins.
#[test]
fn impacts_of_a_chatter_appear_at_folds() {
    let law = StopLaw::Rigid { restitution: 0.123 };
    let parts = chain(&[0.9324, 0.6371], &[(1.4024, 0.116), (1.0213, 0.1916)], 0.4377, (0.0499, 0.9558));
    let machine = Machine::new(parts.with_stop("stop", &[-1.0, 1.0], 0.2195, law)).unwrap();
    let cycle = settled(&machine, &Start::default().within_stops(&machine)).unwrap();
    let found = events(&traced((&machine, "frequency"), &cycle, (0.434, 0.438), Direction::Down));
    let appears = |event: &BranchEvent| matches!(event, BranchEvent::Grazing { appears: true, turns: true, .. });
    let at: Vec<f64> = found.iter().filter(|(event, _)| appears(event)).map(|(_, at)| *at).collect();
    let [.., before, last] = at[..] else { panic!("{found:?}") };
    assert!(at.len() >= 4, "{found:?}");
    let l: f64 = 0.291_5;
    let factor = l.powi(5) / (0.123 * 0.123);
    let limit = last + (last - before) * factor / (1.0 - factor);
    let [.., (begins, complete), (ends, _), (BranchEvent::EndOfRange, _)] = found[..] else { panic!("{found:?}") };
    let sticking = |begins: bool| BranchEvent::Sticking { stop: 0, begins, detail: None };
    assert_eq!((begins, ends), (sticking(true), sticking(false)), "{found:?}");
    assert!((complete - limit).abs() < 0.02 * (last - before).abs(), "{complete} {limit}: {at:?}");
}

/// The first body strikes the second and a wall at one time. Before, the impact on the wall opens the gap between them; beyond, they
/// strike first and the wall is struck with another speed: the motion is not continuous there.
#[test]
fn two_impacts_change_their_order() {
    let machine = Machine::new(
        chain(&[0.7127, 0.6937, 0.89], &[(1.483, 0.0676), (0.9722, 0.0675), (0.5596, 0.044)], 1.354, (-0.2528, 1.3069))
            .with_stop("between", &[-1.0, 1.0, 0.0], 0.0641, StopLaw::Rigid { restitution: 0.411 })
            .with_stop("wall", &[-1.0, 0.0, 0.0], 0.8336, StopLaw::Rigid { restitution: 0.157 }),
    )
    .unwrap();
    let cycle = settled(&machine, &Start::default().within_stops(&machine)).unwrap();
    let found = events(&traced((&machine, "stiffness.a"), &cycle, (1.53, 3.18), Direction::Down));
    let [.., (corner, at), (end, there)] = found[..] else { panic!("{found:?}") };
    assert_eq!((corner, end), (BranchEvent::Corner { first: 0, second: 1 }, BranchEvent::Discontinuity), "{found:?}");
    assert!(at == there && (at - 1.745).abs() < 0.01, "{found:?}");
}

/// A body on a belt, with a stop or without one.
fn on_belt(frequency: f64, force: f64, joint: (f64, f64, f64), stop: Option<f64>) -> Machine {
    let (sliding, limit, belt) = joint;
    let mut parts = MachineParts::new(["a"])
        .with_mass(0, 1.0)
        .with_link(&[1.0], 1.0, 0.1)
        .with_frequency(frequency)
        .with_force(0, 1, force, 0.0)
        .with_joint("belt", &[1.0], sliding, limit, belt);
    if let Some(gap) = stop {
        parts = parts.with_rigid_stop("wall", &[1.0], gap, 0.5);
    }
    Machine::new(parts).unwrap()
}

fn from(machine: &Machine, path: &str, (range, direction): ((f64, f64), Direction)) -> Vec<(BranchEvent, f64)> {
    events(&traced((machine, path), &settled(machine, &Start::default()).unwrap(), range, direction))
}

/// Where a hold begins the branch goes on along the cycles in which it lasts: here it turns back, and again at a fold 2e-8 farther. It jumped to
/// the stable cycle beyond, at a place that depended on the range.
#[test]
fn a_hold_begins_beside_a_fold() {
    let machine = |frequency| on_belt(frequency, 0.567, (0.26, 0.26, 0.621), Some(0.707));
    let up = from(&machine(0.9), "frequency", ((0.9, 1.5), Direction::Up));
    let down = from(&machine(1.444), "frequency", ((1.3, 1.444), Direction::Down));
    let hold = up.iter().position(|(event, _)| matches!(event, BranchEvent::Holding { begins: true, .. })).unwrap();
    let [.., (_, begins), (BranchEvent::Fold, fold)] = up[..hold + 2] else { panic!("{up:?}") };
    assert!(begins - fold > 1e-8 && begins - fold < 3e-8, "{up:?}");
    let back = down.iter().position(|(event, _)| matches!(event, BranchEvent::Holding { begins: false, .. })).unwrap();
    let [.., (BranchEvent::Fold, other), (_, ends)] = down[..=back] else { panic!("{down:?}") };
    assert!((ends - begins).abs() < 1e-11 && (other - fold).abs() < 1e-11, "{up:?} {down:?}");
}

/// Where the motion is not continuous, the branch goes on where the cycles beyond begin to exist: at the same number, whatever its range.
#[test]
fn a_jump_is_where_its_cycles_begin() {
    let parts = MachineParts::new(["a"])
        .with_mass(0, 1.0)
        .with_link(&[1.0], 1.0, 0.05)
        .with_frequency(1.3)
        .with_force(0, 1, 0.0, 0.5)
        .with_joint("belt", &[1.0], 0.3, 0.45, 0.4);
    let machine = Machine::new(parts).unwrap();
    let jump = |end: f64| {
        let found = from(&machine, "frequency", ((1.3, end), Direction::Up));
        let at = found.iter().position(|(event, _)| *event == BranchEvent::Jump).unwrap();
        assert!(matches!(found[at - 1].0, BranchEvent::Holding { begins: true, .. }), "{found:?}");
        (found[at - 1].1, found[at].1)
    };
    for (event, there) in [jump(1.55), jump(1.7), jump(3.0)] {
        assert!((event - 1.515_088_253_71).abs() < 1e-10 && (there - event).abs() < 1e-12, "{event} {there}");
    }
}

/// Close to an impact without speed its joint holds right after it: between both events the number changes by 5e-8 only. The branch skipped
/// them and went back along itself.
#[test]
fn a_hold_begins_beside_a_grazing_contact() {
    let machine = |frequency: f64| {
        let parts = MachineParts::new(["a"])
            .with_mass(0, 1.0)
            .with_link(&[1.0], 1.0, 0.1)
            .with_frequency(frequency)
            .with_force(0, 1, 1.258, 0.0)
            .with_joint("floor", &[1.0], 0.334, 0.334, 0.0)
            .with_rigid_stop("wall", &[1.0], 0.19, 0.8);
        Machine::new(parts).unwrap()
    };
    let found = from(&machine(0.65), "frequency", ((0.65, 0.67), Direction::Up));
    let [
        (BranchEvent::Fold, _),
        (BranchEvent::Holding { begins: true, .. }, begins),
        (BranchEvent::Grazing { appears: false, turns: true, .. }, grazing),
        (BranchEvent::EndOfRange, 0.67),
    ] = found[..]
    else {
        panic!("{found:?}")
    };
    assert!(begins - grazing > 4e-8 && begins - grazing < 6e-8, "{found:?}");
}

/// A joint holds where the gap is least: rounding decides whether a flight has that least gap, and where its function jumped was taken for the
/// grazing contact, 5e-8 away. From the other side it has no such function.
#[test]
fn a_contact_grazes_where_a_hold_begins() {
    let machine = |frequency: f64| {
        let parts = MachineParts::new(["a"])
            .with_mass(0, 1.0)
            .with_link(&[1.0], 1.0, 0.1)
            .with_frequency(frequency)
            .with_force(0, 1, 0.588, 0.0)
            .with_joint("floor", &[1.0], 0.207, 0.2198, 0.0)
            .with_rigid_stop("wall", &[1.0], 0.217, 0.8);
        Machine::new(parts).unwrap()
    };
    let grazing = |begin: f64, direction: Direction| {
        let found = from(&machine(begin), "frequency", ((0.543, 0.584), direction));
        assert!(matches!(found[0].0, BranchEvent::Grazing { .. }), "{found:?}");
        found[0].1
    };
    let (up, down) = (grazing(0.543, Direction::Up), grazing(0.584, Direction::Down));
    assert!((up - down).abs() < 1e-10, "{up} {down}");
}

/// At a corner where the number turns the cycle before the corner before lies close by: the branch took it and went back along itself, to a
/// hold that ends with the force of a joint whose static limit exceeds its sliding force, which it passed as if the motion were continuous.
/// Now the way back has the same events.
#[test]
fn a_corner_at_which_the_number_turns() {
    let law = StopLaw::Compliant { stiffness: 10.0, damping: 0.2, preload: 0.0, opening: Opening::Force };
    let machine = |frequency: f64| {
        let parts = MachineParts::new(["a", "b"])
            .with_mass(0, 1.0)
            .with_mass(1, 0.571)
            .with_link(&[1.0, 0.0], 1.0, 0.02)
            .with_link(&[1.0, -1.0], 0.91, 0.079)
            .with_frequency(frequency)
            .with_force(0, 1, 1.013, 0.0)
            .with_joint("between", &[1.0, -1.0], 0.353, 0.3625, 0.0)
            .with_stop("wall", &[1.0, 0.0], 0.403, law);
        Machine::new(parts).unwrap()
    };
    let up = from(&machine(0.47), "frequency", ((0.47, 0.48), Direction::Up));
    let names: Vec<_> = up.iter().map(|(event, _)| event.name()).collect();
    let expected = ["corner", "holding ends", "jump", "corner", "corner", "fold", "grazing", "end of range"];
    assert_eq!(names, expected, "{up:?}");
    let mut down = from(&machine(0.48), "frequency", ((0.47, 0.48), Direction::Down));
    down.truncate(4);
    down.reverse();
    for ((event, at), (other, there)) in up[3..7].iter().zip(&down) {
        assert_eq!(event.name(), other.name(), "{up:?} {down:?}");
        assert!((at - there).abs() < 1e-9, "{event:?} at {at}, {other:?} at {there}");
    }
}

/// A hold ends as in the test above, and the next cycle with the events beyond is far from it: the branch ends there or jumps.
#[test]
fn a_hold_that_ends_with_a_static_limit_is_not_continuous() {
    let law = StopLaw::Compliant { stiffness: 10.0, damping: 0.2, preload: 0.0, opening: Opening::Force };
    let parts = MachineParts::new(["a"])
        .with_mass(0, 1.0)
        .with_link(&[1.0], 1.0, 0.2)
        .with_frequency(0.562)
        .with_force(0, 1, 1.252, 0.0)
        .with_joint("belt", &[1.0], 0.405, 0.4439, 0.683)
        .with_stop("wall", &[1.0], 0.886, law);
    let found = from(&Machine::new(parts).unwrap(), "frequency", ((0.562, 0.58), Direction::Up));
    assert!(matches!(found[0].0, BranchEvent::Holding { begins: false, .. }), "{found:?}");
    assert!(matches!(found[1].0, BranchEvent::Jump | BranchEvent::Discontinuity), "{found:?}");
}

/// The velocity of a body that a belt holds for an instant has the amplitude of the belt: force over damping at resonance. Beyond, there are no
/// events. The branch ended with a discontinuity.
#[test]
fn the_only_hold_of_a_cycle_ends() {
    let machine = on_belt(1.0, 0.3, (0.2, 0.2, 0.3), None);
    let found = from(&machine, "force.1.cos.a", ((0.02, 0.3), Direction::Down));
    let Some((BranchEvent::LossOfContact { stop: 0, .. }, at)) = found.last() else { panic!("{found:?}") };
    assert!((at - 0.03).abs() < 1e-12, "{at}");
}

/// Friction alone has no velocity at its events: what rounding left there decided that its cycles were neutral.
#[test]
fn a_cycle_with_friction_is_stable() {
    let machine = on_belt(0.5, 1.3, (0.3, 0.3, 0.0), None);
    let cycle = settled(&machine, &Start::default()).unwrap();
    let points = traced((&machine, "force.1.cos.a"), &cycle, (1.3, 1.4), Direction::Up);
    assert!(points.iter().all(|point| point.cycle.stable()), "{:?}", events(&points));
}

/// With another unit of mass the branch is the same: by a power of four to the last bit. Equations were solved in the units of the user,
/// and gaps were compared with mass-normalised coordinates.
#[test]
fn a_branch_has_no_unit_of_mass() {
    let of = |unit: f64| {
        let parts = MachineParts::new(["a", "b"])
            .with_mass(0, unit)
            .with_mass(1, 0.685 * unit)
            .with_link(&[1.0, 0.0], unit, 0.01 * unit)
            .with_link(&[0.0, 1.0], 0.846 * unit, 0.1 * unit)
            .with_frequency(1.278)
            .with_force(0, 1, 0.781 * unit, 0.0)
            .with_rigid_stop("w", &[1.0, -1.0], 0.274, 0.3)
            .with_rigid_stop("z", &[-1.0, 1.0], 0.936, 0.6);
        let machine = Machine::new(parts).unwrap();
        from(&machine, "force.1.cos.a", ((0.781 * unit, 1.44 * unit), Direction::Up))
    };
    let one = of(1.0);
    assert!(one.len() > 10, "{one:?}");
    for unit in [4.0, 2_f64.powi(40)] {
        let scaled: Vec<(BranchEvent, f64)> = of(unit).into_iter().map(|(event, at)| (event, at / unit)).collect();
        assert_eq!(scaled, one);
    }
}

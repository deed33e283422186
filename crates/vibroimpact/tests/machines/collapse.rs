//! Impacts on several stops in turn that accumulate, and starts on and beyond several stops.

use vibroimpact::events::{End, Event, EventKind, Limits, Motion, Start};
use vibroimpact::machine::{HarmonicMotion, ImpactLaw, Machine, MachineParts};

/// A body on another one on a table, under gravity 1.
fn stack((low, high): (f64, f64), restitution: f64) -> Machine {
    let parts = MachineParts::new(["low", "high"])
        .with_mass(0, low)
        .with_mass(1, high)
        .with_constant(0, -low)
        .with_constant(1, -high)
        .with_rigid_stop("table", &[-1.0, 0.0], 0.0, restitution)
        .with_rigid_stop("bodies", &[1.0, -1.0], 0.0, restitution);
    Machine::new(parts).unwrap()
}

fn events(machine: &Machine, start: &Start) -> (Vec<Event>, Option<End>) {
    let mut motion = Motion::new(machine, start, Limits::default()).unwrap();
    let events = motion.by_ref().take(20_000).collect();
    (events, motion.end())
}

/// The end of all impacts of the stack, from rest at heights 1 and 2, by its recursion in the height of the lower body and
/// the distance of the two, which loses no digits however close they come.
fn ends_at((low, high): (f64, f64), e: f64) -> f64 {
    let (mut h, mut u, mut d, mut w, mut time) = (1.0_f64, 0.0_f64, 1.0_f64, 0.0_f64, 0.0_f64);
    for _ in 0..10_000 {
        let table = u + (u * u + 2.0 * h).sqrt();
        let bodies = if w < 0.0 { -d / w } else { f64::INFINITY };
        let s = table.min(bodies);
        h += s * (u - 0.5 * s);
        u -= s;
        d += w * s;
        time += s;
        if table < bodies {
            (h, w, u) = (0.0, w + (1.0 + e) * u, -e * u);
        } else {
            (d, u, w) = (0.0, u + high / (low + high) * (1.0 + e) * w, -e * w);
        }
        if u.abs() + w.abs() < 1e-200 {
            break;
        }
    }
    time
}

/// A heavy body on a light one: both stops are struck in turn, and the time of all impacts is that of the recursion.
#[test]
fn a_stack_collapses() {
    for (masses, restitution) in [((0.2, 1.0), 0.3), ((0.2, 1.0), 0.2), ((0.1, 1.0), 0.35), ((0.05, 1.0), 0.5)] {
        let machine = stack(masses, restitution);
        let start = Start { q: vec![1.0, 2.0], qdot: vec![0.0; 2], phase: 0.0, ..Start::default() };
        let (seen, end) = events(&machine, &start);
        let last = seen.last().unwrap();
        assert_eq!(end, Some(End::Stuck), "{masses:?} {restitution} {last:?}");
        assert_eq!((last.kind, last.place, last.with.as_slice()), (EventKind::Collapse, 0, &[1][..]));
        let expected = ends_at(masses, restitution);
        assert!((last.time - expected).abs() < 1e-12, "{masses:?} {restitution}: {} {expected}", last.time);
        assert!(last.q.iter().chain(&last.qdot).all(|x| x.abs() < 1e-15), "{last:?}");
        let impacts: Vec<usize> = seen.iter().filter(|event| event.closes()).map(|event| event.place).collect();
        assert!(impacts.len() > 10 && impacts.windows(2).rev().take(10).all(|pair| pair[0] != pair[1]), "{impacts:?}");
    }
}

/// Bodies without a force that presses them together come to rest on each other too, and fly on together.
#[test]
fn free_bodies_fly_on_together() {
    let parts = MachineParts::new(["a", "b", "c"])
        .with_mass(0, 1.0)
        .with_mass(1, 1.0)
        .with_mass(2, 1.0)
        .with_rigid_stop("ab", &[1.0, -1.0, 0.0], 0.5, 0.05)
        .with_rigid_stop("bc", &[0.0, 1.0, -1.0], 0.5, 0.05);
    let start = Start { q: vec![0.0; 3], qdot: vec![1.0, 0.0, -0.7], phase: 0.0, ..Start::default() };
    let (seen, end) = events(&Machine::new(parts).unwrap(), &start);
    let last = seen.last().unwrap();
    assert_eq!((end, last.kind, last.place, &last.with[..]), (Some(End::Never), EventKind::Collapse, 0, &[1][..]));
    assert!(seen.len() < 40, "{}", seen.len());
    let together = &seen.last().unwrap().qdot;
    assert!(together.iter().all(|v| (v - 0.1).abs() < 1e-14), "{together:?}");
}

/// A table that moves up throws both bodies of a stack that begins at rest on it: the impact goes through the lower one.
#[test]
fn a_start_on_several_stops() {
    for (e, other) in [(0.3, 0.3), (0.5, 0.0), (0.0, 0.9)] {
        let parts = MachineParts::new(["low", "high"])
            .with_mass(0, 0.2)
            .with_mass(1, 1.0)
            .with_constant(0, -0.2)
            .with_constant(1, -1.5)
            .with_rigid_stop("bodies", &[1.0, -1.0], 0.0, other)
            .with_rigid_stop("table", &[-1.0, 0.0], 0.0, e);
        let machine = Machine::new(parts).unwrap();
        // the stop of the table is struck because the body comes down on it
        let start = Start { q: vec![0.0, 0.0], qdot: vec![-1.8, -1.8], phase: 0.0, ..Start::default() };
        let (seen, _) = events(&machine, &start);
        let first = &seen[0];
        assert_eq!((first.kind, machine.name_of(first.place), first.time), (EventKind::Impact, "table", 0.0));
        // Moreau's law: both gaps were closed, that of the bodies without velocity
        assert!((first.qdot[0] - e * 1.8).abs() < 1e-15, "{first:?}");
        assert!((first.qdot[1] - first.qdot[0]).abs() < 1e-15, "{first:?}");
        for event in &seen {
            assert!(event.q[1] - event.q[0] > -1e-12 && event.q[0] > -1e-12, "{event:?}");
        }
    }
}

/// A sum is taken where nothing but rounding errors of the time is left of it: of two bodies above a floor, which strike it and each
/// other in turn (120 digits), and of a body on a wall whose impacts move a friction joint (60 digits). Coordinates have rounding
/// errors of their size, which slow impacts would make errors of 1e-11 of the time.
#[test]
fn f42v_sums_have_all_digits() {
    let mut column = MachineParts::new(["b1", "b2"]);
    for k in 0..2 {
        column = column.with_mass(k, 0.3).with_constant(k, -2.943);
    }
    let (e, height) = (0.137_042_763_668_395_57, 0.813_111_630_910_721_6);
    let column = column.with_rigid_stop("floor", &[-1.0, 0.0], height, e).with_rigid_stop("c1", &[1.0, -1.0], 0.17, e);
    let joined = MachineParts::new(["x"])
        .with_mass(0, 1.0)
        .with_link(&[1.0], 1.542_838_702_471_810_4, 0.073_095_482_576_397_47)
        .with_frequency(1.380_945_407_879_099)
        .with_force(0, 1, 0.0, 1.434_578_803_373_377_7)
        .with_rigid_stop("wall", &[1.0], 0.2, 0.27)
        .with_joint("j1", &[1.0], 0.320_167_054_250_303_34, 0.320_167_054_250_303_34, 0.0)
        .with_joint("j2", &[1.0], 0.099_187_537_673_043_31, 0.099_187_537_673_043_31, 0.0);
    let cases =
        [(column, EventKind::Collapse, 0.452_767_434_846_136_73), (joined, EventKind::Stick, 1.447_724_466_195_656)];
    for (parts, kind, expected) in cases {
        let (seen, _) = events(&Machine::new(parts).unwrap(), &Start::default());
        let sum = seen.iter().find(|event| event.kind == kind).unwrap();
        assert!((sum.time - expected).abs() < 2e-14, "{} instead of {expected}", sum.time);
    }
}

/// A start beyond several stops becomes a valid one, and one that is valid stays the same bits.
#[test]
fn starts_beyond_stops_become_valid() {
    let parts = MachineParts::new(["a", "b"]).with_mass(0, 0.3).with_mass(1, 1.7).with_frequency(1.1);
    let parts = parts.with_rigid_stop("between", &[1.0, -1.0], 0.1, 0.5).with_rigid_stop("wall", &[0.0, 1.0], 0.7, 0.2);
    let machine = Machine::new(parts).unwrap();
    for k in 0..200 {
        let x = f64::from(k);
        let q = vec![3.0 * (0.7 * x).sin(), 2.0 * (1.3 * x).cos()];
        let start = Start { q, qdot: vec![0.1, -0.2], phase: 0.4, ..Start::default() };
        let within = start.within_stops(&machine);
        let valid = |start: &Start| Motion::new(&machine, start, Limits::default()).is_ok();
        assert!(valid(&within), "{start:?} {within:?}");
        if start.q[0] - start.q[1] < 0.1 && start.q[1] < 0.7 {
            assert_eq!(within, start);
        }
    }
}

/// Three bodies beside each other that close on each other and on a wall at one time.
fn row(mass: [f64; 3], restitution: [f64; 3], push: f64) -> MachineParts {
    let parts = MachineParts::new(["a", "b", "c"]).with_constant(2, push);
    let parts = (0..3).fold(parts, |parts, k| parts.with_mass(k, mass[k]));
    let stops = [("wall", [-1.0, 0.0, 0.0]), ("ab", [1.0, -1.0, 0.0]), ("bc", [0.0, 1.0, -1.0])];
    let all = stops.into_iter().zip(restitution);
    all.fold(parts, |parts, ((name, along), e)| parts.with_rigid_stop(name, &along, 0.0, e))
}

/// The last body follows the second one without a rebound, each time that this is slowed down by the first one between it and the
/// wall. The impacts of the other two are summed, and it stops with them; a small force on it must not leave it its velocity.
#[test]
fn a_body_beside_a_collapse_is_struck_too() {
    for push in [0.01, 0.0, -0.01] {
        let machine = Machine::new(row([0.1, 2.0, 0.1], [0.75, 0.1, 0.0], push)).unwrap();
        let start = Start { qdot: vec![-1.3, -0.3, -1.3], ..Start::default() };
        let (seen, _) = events(&machine, &start);
        let last = seen.last().unwrap();
        assert!(last.qdot == [0.0; 3] && last.q == [0.0; 3] && last.time == 0.0, "{push}: {last:?}");
    }
}

/// A body that strikes a wall again and again rubs on another one, and turns the joint back each time. All impacts come to one instant,
/// in which friction has no impulse, so the other body keeps its velocity.
#[test]
fn a_joint_slides_on_after_a_collapse() {
    for speed in [0.02, 0.1] {
        let parts = MachineParts::new(["a", "b", "c"]).with_mass(0, 0.4).with_mass(1, 1.0).with_mass(2, 1.0);
        let parts = parts.with_constant(2, -0.5).with_joint("rub", &[-1.0, 1.0, 0.0], 0.046, 0.046, 0.0);
        let parts = parts.with_rigid_stop("ca", &[-1.0, 0.0, 1.0], 0.0, 0.0);
        let machine = Machine::new(parts.with_rigid_stop("wall", &[1.0, 0.0, 0.0], 0.0, 0.5)).unwrap();
        let start = Start { q: vec![-3e-4, 0.0, -3e-4], qdot: vec![0.35, speed, 0.35], ..Start::default() };
        let (seen, _) = events(&machine, &start);
        let last = seen.iter().rfind(|event| event.time < 1e-3).unwrap();
        assert!(last.qdot[0].abs() < 1e-15, "{last:?}");
        // the sliding force acts for less than a thousandth
        assert!((last.qdot[1] - speed).abs() < 0.046 * 1e-3, "{speed}: {last:?}");
    }
}

/// Bodies come to rest on a moving table, and the upper one rubs on the ground: its joint slides with the table, and turns back where
/// the table does.
#[test]
fn a_collapse_on_a_moving_table() {
    let frequency = 0.878;
    let mut parts = row([0.552, 0.1, 1.557], [0.5, 0.5, 0.1], -1.557).with_constant(0, -0.552).with_constant(1, -0.1);
    parts.impacts = ImpactLaw::InTurn;
    parts.stops[0].motion.push(HarmonicMotion { order: 1, cos: 0.0, sin: 0.2 });
    parts.stops[1].gap = 0.3;
    let parts = parts.with_frequency(frequency).with_link(&[0.0, 0.0, 1.0], 2.124, 0.013);
    let machine = Machine::new(parts.with_joint("rub", &[0.0, 0.0, 1.0], 0.131, 0.131, 0.0)).unwrap();
    let start = Start { qdot: vec![-1.0, 0.0, 1.0], ..Start::default() };
    let motion = Motion::new(&machine, &start, Limits::default()).unwrap();
    let seen: Vec<Event> = motion.take_while(|event| event.time < 5.7).collect();
    let on_table = |event: &Event| event.kind == EventKind::Collapse && event.place == 0;
    let at = seen.iter().position(on_table).unwrap();
    let table = 0.2 * frequency * (frequency * seen[at].time).cos();
    assert!(seen[at].qdot.iter().all(|v| (v - table).abs() < 1e-12), "{:?} {table}", seen[at]);
    let slips: Vec<(f64, f64)> = seen[at..]
        .iter()
        .filter(|event| event.kind == EventKind::Slip)
        .map(|event| (event.time, event.speed))
        .collect();
    let turn = |k: f64| (k * core::f64::consts::FRAC_PI_2) / frequency;
    let expected = [(seen[at].time, 1.0), (turn(1.0), -1.0), (turn(3.0), 1.0)];
    assert_eq!(slips.len(), expected.len(), "{slips:?}");
    for ((time, way), (at, forward)) in slips.into_iter().zip(expected) {
        assert!((time - at).abs() < 1e-12 && way == forward, "{time} {at} {way}");
    }
}

/// A moving table presses two bodies against a fixed stop until there is no room between them: no motion goes on from there.
#[test]
fn no_room_is_left() {
    let mut parts = MachineParts::new(["a", "b"]).with_mass(0, 2.0).with_mass(1, 0.4).with_frequency(2.0);
    parts = parts.with_rigid_stop("table", &[-1.0, 0.0], 0.0, 0.1).with_rigid_stop("ab", &[1.0, -1.0], 0.0, 0.0);
    parts.stops[0].motion.push(HarmonicMotion { order: 1, cos: 0.0, sin: 2.0 });
    let machine = Machine::new(parts.with_rigid_stop("top", &[0.0, 1.0], 1.0, 0.9)).unwrap();
    let (seen, end) = events(&machine, &Start { qdot: vec![4.0; 2], ..Start::default() });
    assert_eq!(end, Some(End::Inconsistent));
    // the table reaches the stop where 2 sin 2t is 1
    let time = seen.last().unwrap().time;
    assert!((time - 0.261_799_387_799_149_4).abs() < 1e-9, "{time}");
}

/// A body bounces without losses on a floor; another one clings to it by dry friction, which takes the energy: it slips after each
/// impact and is held again. In the frame of the first one the other one moves by the same parts in each bounce, so that its place at
/// the end is a geometric sum: m u'' = -f while it slips, and both rise with the momentum that is left.
#[test]
fn a_body_beside_a_sum_goes_its_way() {
    let parts = MachineParts::new(["a", "b"])
        .with_mass(0, 3.0)
        .with_mass(1, 2.0)
        .with_constant(0, -1.0)
        .with_rigid_stop("floor", &[-1.0, 0.0], 0.1, 1.0)
        .with_joint("grip", &[1.0, -1.0], 0.4, 0.4, 0.0);
    let machine = Machine::new(parts).unwrap();
    let start = Start { q: vec![0.0; 2], qdot: vec![-0.5; 2], ..Start::default() };
    let (seen, end) = events(&machine, &start);
    let last = seen.last().unwrap();
    assert_eq!(end, Some(End::Stuck), "{last:?}");
    // all energy is taken by the friction over the way of one along the other
    let energy = 0.5 * 5.0 * 0.25 + 0.1;
    let way = |k: usize| seen[k].q[0] - seen[k].q[1];
    let rubbed: f64 = (1..seen.len()).map(|k| 0.4 * (way(k) - way(k - 1)).abs()).sum();
    assert!((rubbed - energy).abs() < 1e-9, "{rubbed} {energy}");
    assert!((last.q[1] + 1.9125).abs() < 1e-9, "{last:?}");
}

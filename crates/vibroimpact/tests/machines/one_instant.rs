//! Events at one time, contacts that touch without force, and contacts that depend on each other.

use std::f64::consts::PI;
use vibroimpact::events::{End, Event, EventKind, Limits, Motion, Start};
use vibroimpact::machine::{HarmonicMotion, ImpactLaw, Machine, MachineParts, Opening, StopLaw};
use vibroimpact::verdict::{SettleOptions, Verdict, settle_machine};

fn events(parts: &MachineParts, start: &Start, count: usize) -> (Vec<Event>, Option<End>) {
    let machine = Machine::new(parts.clone()).unwrap();
    let mut motion = Motion::new(&machine, start, Limits::default()).unwrap();
    let events: Vec<Event> = motion.by_ref().take(count).collect();
    (events, motion.end())
}

fn start(q: &[f64], qdot: &[f64]) -> Start {
    Start { q: q.to_vec(), qdot: qdot.to_vec(), ..Start::default() }
}

fn label(parts: &MachineParts, start: &Start) -> String {
    settle_machine(&Machine::new(parts.clone()).unwrap(), start, &SettleOptions::default())
        .unwrap()
        .verdict
        .label()
        .into_owned()
}

/// Oscillators of mass and stiffness 1 with this damping, driven with amplitude 1.
fn oscillators(count: usize, damping: f64, frequency: f64) -> MachineParts {
    let names: Vec<String> = (0..count).map(|i| format!("x{i}")).collect();
    let mut parts = MachineParts::new(names).with_frequency(frequency);
    for i in 0..count {
        let along = parts.along(i);
        parts = parts.with_mass(i, 1.0).with_link(&along, 1.0, damping).with_force(i, 1, 0.0, 1.0);
    }
    parts
}

/// A body that lies on a stop without load does not hide the impact of another body, at pi/6 with speed sqrt(3)/2.
#[test]
fn f42a_an_idle_rest_hides_no_impact() {
    let parts = MachineParts::new(["b", "c"])
        .with_mass(0, 1.0)
        .with_mass(1, 1.0)
        .with_link(&[0.0, 1.0], 1.0, 0.0)
        .with_rigid_stop("s", &[-1.0, 0.0], 0.0, 0.5)
        .with_rigid_stop("w", &[0.0, 1.0], 0.5, 0.5);
    let (found, _) = events(&parts, &start(&[], &[0.0, 1.0]), 3);
    assert_eq!((found[0].kind, found[0].place), (EventKind::Impact, 1));
    assert!((found[0].time - PI / 6.0).abs() < 4e-16 && (found[0].speed - 0.75_f64.sqrt()).abs() < 4e-16);
}

/// Two equal bodies in contact under equal forces move as one: the wall is struck at the time that an adaptive integrator
/// gives (order 8, relative tolerance 1e-12), and both keep together.
#[test]
fn f42b_equal_bodies_in_contact_move_together() {
    let mut parts = oscillators(2, 0.1, 1.2);
    for force in &mut parts.forces {
        (force.cos, force.sin) = (force.sin.clone(), force.cos.clone());
    }
    let parts = parts.with_rigid_stop("wall", &[-1.0, 0.0], 1.0, 0.5).with_rigid_stop("c", &[1.0, -1.0], 0.0, 0.5);
    let (found, _) = events(&parts, &Start::default(), 20);
    assert!((found[0].time - 3.528_402_82).abs() < 1e-8, "{:?}", found[0]);
    assert!(found.iter().all(|event| (event.q[0] - event.q[1]).abs() < 1e-15));
    // and without the wall nothing happens
    let free = oscillators(2, 0.1, 1.0).with_rigid_stop("s", &[1.0, -1.0], 0.0, 0.5);
    assert_eq!(label(&free, &Start::default()), "0");
}

/// One plastic body on another on a shaking table, with nothing but gravity between: the motion of one body.
#[test]
fn f42c_a_stack_is_one_body() {
    let table = |parts: MachineParts, sin: f64| {
        let down: Vec<f64> = parts.along(0).iter().map(|x| -x).collect();
        let mut parts = parts.with_rigid_stop("table", &down, 0.0, 0.0);
        parts.stops.last_mut().unwrap().motion.push(HarmonicMotion { order: 1, cos: 0.0, sin });
        parts.with_frequency(1.0)
    };
    for sin in [1.2, 1.5, 2.0, 2.6, 3.0] {
        let one = table(MachineParts::new(["a"]).with_mass(0, 1.0).with_constant(0, -1.0), sin);
        let two = MachineParts::new(["a", "b"])
            .with_mass(0, 1.0)
            .with_mass(1, 1.0)
            .with_constant(0, -1.0)
            .with_constant(1, -1.0);
        let two = table(two, sin).with_rigid_stop("contact", &[1.0, -1.0], 0.0, 0.0);
        let on_table = |parts: &MachineParts| -> Vec<f64> {
            let (found, _) = events(parts, &Start::default(), 60);
            let own = found.iter().filter(|event| event.place == 0 && event.kind == EventKind::Impact);
            own.map(|event| event.time).take(8).collect()
        };
        let (single, stacked) = (on_table(&one), on_table(&two));
        assert_eq!(single.len(), stacked.len());
        assert!(!single.is_empty());
        for (a, b) in single.iter().zip(&stacked) {
            assert!((a - b).abs() < 1e-12 * (1.0 + a), "{sin}: {single:?} {stacked:?}");
        }
    }
}

/// Five equal pendulums in contact, the first one let go: together the others leave with 2/5, in turn the last one leaves
/// with the whole speed, as with gaps of 1e-9.
#[test]
fn f42d_a_cradle_by_both_laws() {
    let mut parts = MachineParts::new(["a", "b", "c", "d", "e"]);
    for i in 0..5 {
        let along = parts.along(i);
        parts = parts.with_mass(i, 1.0).with_link(&along, 1.0, 0.0);
    }
    for i in 0..4 {
        let direction: Vec<f64> = (0..5)
            .map(|k| {
                if k == i {
                    1.0
                } else if k == i + 1 {
                    -1.0
                } else {
                    0.0
                }
            })
            .collect();
        parts = parts.with_rigid_stop(["p", "q", "r", "s"][i], &direction, 0.0, 1.0);
    }
    let let_go = start(&[-1.0, 0.0, 0.0, 0.0, 0.0], &[]);
    let (found, _) = events(&parts, &let_go, 1);
    assert!((found[0].time - PI / 2.0).abs() < 1e-15);
    let close = |found: &[f64], want: [f64; 5]| found.iter().zip(want).all(|(a, b)| (a - b).abs() < 1e-14);
    assert!(close(&found[0].qdot, [-0.6, 0.4, 0.4, 0.4, 0.4]), "{:?}", found[0]);
    parts.impacts = ImpactLaw::InTurn;
    let (found, end) = events(&parts, &let_go, 40);
    assert!(close(&found.iter().find(|event| event.place == 3).unwrap().qdot, [0.0, 0.0, 0.0, 0.0, 1.0]), "{found:?}");
    assert_eq!(end, None);
    // the last one comes back after half a period, and so on; no energy is lost
    assert!((found.last().unwrap().qdot.iter().map(|v| v * v).sum::<f64>() - 1.0).abs() < 1e-12);
}

/// The same stop twice, and a compliant stop at the place of a rigid one, change nothing; two joints are one of their sum.
#[test]
fn f42e_dependent_contacts() {
    let free = oscillators(1, 0.1, 0.7);
    let rigid = free.clone().with_rigid_stop("hard", &[1.0], 0.2, 0.5);
    let soft = StopLaw::Compliant { stiffness: 50.0, damping: 0.0, preload: 0.0, opening: Opening::Force };
    let (want, _) = events(&rigid, &Start::default(), 8);
    for parts in [
        rigid.clone().with_rigid_stop("again", &[1.0], 0.2, 0.5),
        free.clone().with_stop("soft", &[1.0], 0.2, soft).with_rigid_stop("hard", &[1.0], 0.2, 0.5),
    ] {
        let (found, _) = events(&parts, &Start::default(), 8);
        for (a, b) in found.iter().zip(&want) {
            let close = |one: f64, other: f64| (one - other).abs() < 1e-13;
            assert!(a.kind == b.kind && close(a.time, b.time) && close(a.speed, b.speed), "{a:?} {b:?}");
        }
    }
    let one = oscillators(1, 0.1, 0.9).with_joint("both", &[1.0], 0.2, 0.2, 0.0);
    let two =
        oscillators(1, 0.1, 0.9).with_joint("left", &[1.0], 0.1, 0.1, 0.0).with_joint("right", &[1.0], 0.1, 0.1, 0.0);
    let (one, _) = events(&one, &Start::default(), 30);
    let (two, _) = events(&two, &Start::default(), 60);
    for (a, pair) in one.iter().zip(two.chunks_exact(2)) {
        for b in pair {
            assert!(a.kind == b.kind && (a.time - b.time).abs() < 1e-13 * (1.0 + a.time), "{a:?} {b:?}");
        }
    }
}

/// A plate dropped flat on two or three supports stays flat, whatever its moment of inertia.
#[test]
fn f42f_a_plate_stays_flat() {
    for (inertia, middle) in [(0.3, false), (1.0 / 3.0, false), (1.0, true), (2.0, false), (0.07, true)] {
        let mut parts = MachineParts::new(["heave", "pitch"])
            .with_mass(0, 1.0)
            .with_mass(1, inertia)
            .with_constant(0, -1.0)
            .with_rigid_stop("left", &[-1.0, 1.0], 0.0, 0.3)
            .with_rigid_stop("right", &[-1.0, -1.0], 0.0, 0.3);
        if middle {
            parts = parts.with_rigid_stop("middle", &[-1.0, 0.0], 0.0, 0.3);
        }
        let (found, _) = events(&parts, &start(&[1.0, 0.0], &[]), if middle { 9 } else { 6 });
        let (mut speed, mut time, per) = (2.0_f64.sqrt(), 2.0_f64.sqrt(), if middle { 3 } else { 2 });
        for group in found.chunks_exact(per) {
            for event in group {
                assert!((event.time - time).abs() < 1e-14 && (event.speed - speed).abs() < 1e-14, "{event:?}");
                assert!(event.qdot[1].abs() < 1e-16, "{event:?}");
            }
            speed *= 0.3;
            time += 2.0 * speed;
        }
    }
}

/// A mass that rests on a wall beside a friction joint along the same direction leaves the wall when its force overcomes the
/// joint too: sin phase = (gap - sliding) / force.
#[test]
fn f42g_a_joint_holds_beside_a_stop() {
    let parts = MachineParts::new(["x"])
        .with_mass(0, 1.0)
        .with_link(&[1.0], 1.0, 0.1)
        .with_frequency(0.5)
        .with_force(0, 1, 0.0, 1.5)
        .with_rigid_stop("wall", &[1.0], 0.5, 0.0)
        .with_joint("guide", &[1.0], 0.2, 0.2, 0.0);
    let (found, _) = events(&parts, &Start::default(), 12);
    let release = found.iter().find(|event| event.kind == EventKind::Release).expect("a release");
    assert!((release.phase - (PI - 0.2_f64.asin())).abs() < 1e-14, "{release:?}");
}

/// A symmetric beam of three modes in loose damped supports goes on: supports that open at one time do not reopen each other.
#[test]
fn f42h_symmetric_supports() {
    let mut parts =
        MachineParts::new(["m1", "m2", "m3"]).with_frequency(9.0).with_force(0, 1, 0.0, 8.0).with_force(2, 1, 0.0, 3.0);
    for (k, rate) in [5.0_f64, 20.0, 45.0].into_iter().enumerate() {
        let along = parts.along(k);
        parts = parts.with_mass(k, 1.0).with_link(&along, rate * rate, 0.04 * rate);
    }
    let soft = StopLaw::Compliant { stiffness: 4e4, damping: 20.0, preload: 0.0, opening: Opening::Force };
    let shapes = [("a", 0.951_056_516_295_153_5, 1.0), ("b", 0.951_056_516_295_153_6, -1.0)];
    for (name, first, side) in shapes {
        let shape = [first, side * 0.587_785_252_292_473_2, -0.587_785_252_292_473];
        parts = parts.with_stop(&format!("plus-{name}"), &shape, 0.01, soft);
        parts = parts.with_stop(&format!("minus-{name}"), &shape.map(|x| -x), 0.01, soft);
    }
    let (found, end) = events(&parts, &Start::default(), 400);
    assert_eq!((found.len(), end), (400, None));
    assert!(found.last().unwrap().time > 6.0, "{:?}", found.last());
    assert!(found.iter().all(|event| event.q[1].abs() < 1e-9), "the second mode has no force");
}

/// The same oscillator twice is the oscillator: the same impacts at the same times, and the same multipliers twice.
#[test]
fn f42i_an_oscillator_beside_itself() {
    let one = oscillators(1, 0.05, 0.6).with_rigid_stop("s", &[1.0], 0.05, 0.9);
    let two = oscillators(2, 0.05, 0.6).with_rigid_stop("s", &[1.0, 0.0], 0.05, 0.9).with_rigid_stop(
        "t",
        &[0.0, 1.0],
        0.05,
        0.9,
    );
    let settle = |parts: &MachineParts| {
        let machine = Machine::new(parts.clone()).unwrap();
        let settled = settle_machine(&machine, &Start::default(), &SettleOptions::default()).unwrap();
        let Verdict::Periodic(cycle) = settled.verdict else { panic!("periodic") };
        (cycle.label, cycle.multipliers)
    };
    let ((label_one, own), (label_two, all)) = (settle(&one), settle(&two));
    assert_eq!((label_one.to_string().as_str(), label_two.to_string().as_str()), ("6/2", "12/2"));
    for (k, multiplier) in all.iter().enumerate() {
        let same = own.iter().any(|of| (of.re - multiplier.re).abs() + (of.im - multiplier.im).abs() < 1e-9);
        assert!(same, "{k}: {own:?} {all:?}");
    }
}

/// A body that rides on a moving stop beside a joint to the ground slides on it, also where the stop turns.
#[test]
fn f42j_a_moving_stop_moves_a_joint() {
    let mut parts = MachineParts::new(["x"])
        .with_mass(0, 1.0)
        .with_constant(0, -1.0)
        .with_frequency(0.5)
        .with_rigid_stop("table", &[-1.0], 0.0, 0.0)
        .with_joint("guide", &[1.0], 0.1, 0.2, 0.0);
    parts.stops[0].motion.push(HarmonicMotion { order: 1, cos: 0.0, sin: 1.0 });
    let (found, _) = events(&parts, &Start::default(), 8);
    let slips: Vec<&Event> = found.iter().filter(|event| event.kind == EventKind::Slip).collect();
    assert!(found.iter().all(|event| event.kind != EventKind::Hold), "{found:?}");
    // the table turns at odd multiples of a quarter of its period
    for (k, slip) in slips.iter().take(4).enumerate() {
        assert!((slip.time - PI * (2.0 * k as f64 + 1.0)).abs() < 1e-12, "{slip:?}");
    }
    assert!(slips.len() > 3);
}

/// A plastic wall and a preloaded stop at one gap: after an impact without rebound the velocity along both is a rounding error of
/// that before, so the preloaded stop is met without velocity, in every unit of mass and length. It was compared with the velocity after the
/// impact, and in pounds and inches it closed, opened and was touched beside most impacts: the label was 2/1.
#[test]
fn f42p_a_preloaded_stop_at_the_gap_of_a_plastic_wall() {
    for (mass, length) in [(1.0, 1.0), (4.0, 0.5), (0.453_592_37, 0.0254), (3.0, 0.1), (0.7, 39.37)] {
        let force = mass * length;
        let law = StopLaw::Compliant {
            stiffness: 148.91 * mass,
            damping: 1.58 * mass,
            preload: 0.678_958_474_499_992_4 * force,
            opening: Opening::Force,
        };
        let parts = MachineParts::new(["b"])
            .with_mass(0, mass)
            .with_link(&[1.0], 0.908_577_396_946_280_7 * mass, 0.14 * mass)
            .with_frequency(1.87)
            .with_force(0, 1, 0.0, 1.43 * force)
            .with_rigid_stop("wall", &[1.0], 0.5 * length, 0.0)
            .with_stop("soft", &[1.0], 0.5 * length, law);
        let start = start(&[], &[-0.118_875_815_293_503_72 * length]);
        let (found, _) = events(&parts, &start, 40);
        // the first impact comes to rest until 1.507; all others are left at once
        assert_eq!(found[5].kind, EventKind::Impact);
        assert!(found[5..].iter().all(|event| event.kind == EventKind::Impact && event.place == 0), "{length}");
        assert_eq!(label(&parts, &start), "1/1", "{length}");
    }
}

/// Where two stops are struck at one time and one before the other, by however little, would lead elsewhere, the event says so: a bar
/// dropped flat on two feet, unless its inertia is that at which an impact on one foot does not move the other one; two balls never.
#[test]
fn f42w_a_tie_that_decides_is_told() {
    let ties = |inertia: f64, feet: [&[f64]; 2]| {
        let parts = MachineParts::new(["one", "other"])
            .with_mass(0, 1.0)
            .with_mass(1, inertia)
            .with_constant(0, -1.0)
            .with_constant(1, if feet[0][1] == 0.0 { -1.0 } else { 0.0 })
            .with_rigid_stop("left", feet[0], 0.5, 0.5)
            .with_rigid_stop("right", feet[1], 0.5, 0.5);
        let (found, _) = events(&parts, &Start::default(), 2);
        assert!(found.iter().all(|event| event.kind == EventKind::Impact && event.time == 1.0), "{found:?}");
        assert_eq!(found[0].qdot, found[1].qdot);
        [found[0].tie, found[1].tie]
    };
    let feet: [&[f64]; 2] = [&[-1.0, -1.0], &[-1.0, 1.0]];
    assert_eq!(ties(0.25, feet), [true, true]);
    assert_eq!(ties(1.0, feet), [false, false]);
    assert_eq!(ties(1.0, [&[-1.0, 0.0], &[0.0, -1.0]]), [false, false]);
}

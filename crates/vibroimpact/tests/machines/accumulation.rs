//! Impacts that accumulate: on several stops at the same times, in turn with a joint that slips and holds, without a load,
//! on some of the stops only.

use std::f64::consts::{PI, TAU};
use vibroimpact::events::{End, Event, EventKind, Limits, Motion, Start};
use vibroimpact::machine::{Machine, MachineParts, Opening, StopLaw};
use vibroimpact::verdict::{Count, SettleOptions, Verdict, settle_machine};

fn events(machine: &Machine, start: &Start, most: usize) -> (Vec<Event>, Option<End>) {
    let mut motion = Motion::new(machine, start, Limits::default()).unwrap();
    let events = motion.by_ref().take(most).collect();
    (events, motion.end())
}

/// No speed is a rounding error.
fn assert_speeds(events: &[Event]) {
    for event in events.iter().filter(|event| event.kind == EventKind::Impact) {
        assert!(event.speed > 1e-12, "{event:?}");
    }
}

/// Two beads in front of a wall, without any force.
fn two_beads(restitution: f64) -> Machine {
    let parts = MachineParts::new(["a", "b"])
        .with_mass(0, 1.0)
        .with_mass(1, 1.0)
        .with_rigid_stop("wall", &[-1.0, 0.0], 0.0, restitution)
        .with_rigid_stop("ab", &[1.0, -1.0], 0.0, restitution);
    Machine::new(parts).unwrap()
}

/// The end of all impacts of the two beads in 300 digits.
#[test]
fn beads_without_a_load_come_to_rest() {
    let times = [
        (0.17, 0.888_037_915_855_060_5),
        (0.1, 0.852_136_674_048_540_2),
        (0.05, 0.841_570_646_714_560_9),
        (0.01, 0.835_166_397_379_352_7),
        (0.001, 0.833_888_842_771_192_6),
    ];
    for (restitution, time) in times {
        let machine = two_beads(restitution);
        let start = Start { q: vec![1.0, 1.001], qdot: vec![-1.0, -1.4], ..Start::default() };
        let (seen, end) = events(&machine, &start, 1000);
        let last = seen.last().unwrap();
        assert_eq!(last.kind, EventKind::Collapse, "{restitution}: {end:?} {last:?}");
        assert!((last.time - time).abs() < 2e-13, "{restitution}: {} {time}", last.time);
        assert!(last.q.iter().chain(&last.qdot).all(|x| x.abs() < 1e-13), "{restitution}: {last:?}");
        assert!(matches!(end, Some(End::Stuck | End::Never)), "{restitution}: {end:?}");
        assert!(seen.len() < 100, "{restitution}: {}", seen.len());
    }
}

/// A column of ten beads that falls on a floor: the lower five come to rest on each other at a time known by 300 digits, and the
/// upper ones go on.
#[test]
fn a_part_of_a_column_comes_to_rest() {
    let names: Vec<String> = (1..=10).map(|k| format!("b{k}")).collect();
    let mut parts = MachineParts::new(names.iter().map(String::as_str));
    for k in 0..10 {
        parts = parts.with_mass(k, 1.0).with_constant(k, -9.81);
    }
    for k in 0..10 {
        let mut direction = [0.0; 10];
        direction[k] = -1.0;
        if k > 0 {
            direction[k - 1] = 1.0;
        }
        parts = parts.with_rigid_stop(&format!("c{k}"), &direction, if k == 0 { 0.9 } else { 0.05 }, 0.5);
    }
    let machine = Machine::new(parts).unwrap();
    let (seen, _) = events(&machine, &Start::default(), 3000);
    let rest = seen.iter().find(|event| event.kind == EventKind::Collapse).unwrap();
    let mut stops = rest.with.clone();
    stops.push(rest.place);
    stops.sort_unstable();
    assert_eq!(stops, [0, 1, 2, 3, 4], "{rest:?}");
    assert!((rest.time - 0.474_657_811_676_884).abs() < 1e-11, "{}", rest.time);
    for k in 0..5 {
        assert!(
            (rest.q[k] + 0.9 + 0.05 * f64::from(u32::try_from(k).unwrap())).abs() < 1e-12 && rest.qdot[k].abs() < 1e-12
        );
    }
    // the others fall freely
    let fall = 0.5 * 9.81 * rest.time * rest.time;
    assert!((5..10).all(|k| (rest.q[k] + fall).abs() < 1e-12), "{rest:?}");
    assert_speeds(&seen);
}

/// An oscillator of mass `m` before a stop, as often as there are masses.
fn copies(masses: &[f64], restitution: f64) -> Machine {
    let names: Vec<String> = (0..masses.len()).map(|k| format!("m{k}")).collect();
    let mut parts = MachineParts::new(names.iter().map(String::as_str)).with_frequency(0.6);
    for (k, m) in masses.iter().enumerate() {
        let mut one = vec![0.0; masses.len()];
        one[k] = 1.0;
        parts = parts.with_mass(k, *m).with_link(&one, *m, 0.05 * m).with_force(k, 1, 0.0, *m).with_rigid_stop(
            &format!("s{k}"),
            &one,
            0.05,
            restitution,
        );
    }
    Machine::new(parts).unwrap()
}

/// The same oscillator twice has the impacts of one, at the same times, and rests with it.
#[test]
fn equal_oscillators_chatter_together() {
    for masses in [vec![1.0, 1.0], vec![1.0, 3.0], vec![0.3, 0.7, 1.9]] {
        for restitution in [0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9] {
            let (one, _) = events(&copies(&[1.0], restitution), &Start::default(), 120);
            let count = masses.len();
            let (all, _) = events(&copies(&masses, restitution), &Start::default(), 120 * count);
            for (k, event) in one.iter().enumerate() {
                for own in &all[k * count..(k + 1) * count] {
                    let apart = (own.time - event.time).abs();
                    assert!(own.kind == event.kind && apart < 1e-10, "{masses:?} {restitution} {k}: {own:?} {event:?}");
                }
            }
            assert_speeds(&all);
        }
    }
}

fn settled(machine: &Machine, start: &Start) -> Verdict<Machine> {
    let options = SettleOptions { chaos_over: 0, max_impacts: 4_000, ..SettleOptions::default() };
    settle_machine(machine, start, &options).unwrap().verdict
}

#[test]
fn equal_oscillators_settle_alike() {
    for restitution in [0.2, 0.35, 0.5, 0.65, 0.8, 0.9] {
        let label = |machine: &Machine| match settled(machine, &Start::default()) {
            Verdict::Periodic(cycle) => (cycle.label.impacts, cycle.label.periods),
            other => panic!("{restitution}: {other:?}"),
        };
        let (one, two) = (label(&copies(&[1.0], restitution)), label(&copies(&[1.0, 1.0], restitution)));
        let expected = match one.0 {
            Count::Finite(impacts) => Count::Finite(2 * impacts),
            other => other,
        };
        assert_eq!((expected, one.1), two, "{restitution}");
    }
}

/// Two balls on a table that shakes with 1.2 g.
#[test]
fn two_balls_chatter_together() {
    let mut parts = MachineParts::new(["b1", "b2"]).with_frequency(1.0);
    for k in 0..2 {
        let mut down = [0.0; 2];
        down[k] = -1.0;
        parts = parts.with_mass(k, 1.0).with_constant(k, -1.0).with_rigid_stop(&format!("f{k}"), &down, 0.0, 0.4);
        parts.stops[k].motion = vec![vibroimpact::machine::HarmonicMotion { order: 1, cos: 0.0, sin: 1.2 }];
    }
    let machine = Machine::new(parts).unwrap();
    let start = Start { q: vec![1.0, 1.0], qdot: vec![], ..Start::default() };
    let Verdict::Periodic(cycle) = settled(&machine, &start) else { panic!("no cycle") };
    assert_eq!((cycle.label.impacts, cycle.label.periods), (Count::Infinite, 1));
}

/// An oscillator with a friction joint before a stop.
fn rubbing() -> Machine {
    let parts = MachineParts::new(["x"])
        .with_mass(0, 1.0)
        .with_link(&[1.0], 1.0, 0.1)
        .with_frequency(0.5)
        .with_force(0, 1, 0.0, 1.5)
        .with_rigid_stop("wall", &[1.0], 0.5, 0.6)
        .with_joint("guide", &[1.0], 0.2, 0.2, 0.0);
    Machine::new(parts).unwrap()
}

/// At rest on the stop the mass is held by the joint too: it leaves when the force on it is -0.2, 1.5 sin(phase) = 0.3.
#[test]
fn a_chatter_with_friction_is_complete() {
    let machine = rubbing();
    let Verdict::Periodic(cycle) = settled(&machine, &Start::default()) else { panic!("no cycle") };
    assert_eq!((cycle.label.impacts, cycle.label.periods), (Count::Infinite, 1));
    let release = PI - 0.2_f64.asin();
    let near = |event: &&Event| (event.phase - release).abs() < 1e-12;
    let leaves = cycle.events.iter().find(near).unwrap_or_else(|| panic!("{:?}", cycle.events));
    assert!((leaves.q[0] - 0.5).abs() < 1e-13 && leaves.qdot[0].abs() < 1e-13, "{leaves:?}");
    let (seen, _) = events(&machine, &Start::default(), 2000);
    assert_speeds(&seen);
    // at most so many events in a period
    assert!(seen.last().unwrap().time > 20.0 * TAU / 0.5, "{}", seen.last().unwrap().time);
}

/// A body on a slope of unit direction (s, c) from the normal: it bounces on a table that moves it along a friction joint with
/// each impact. The position along the joint by a time stepping of Moreau's, without events.
struct Slider {
    /// Direction of the stop and of the joint.
    stop: [f64; 2],
    force: [f64; 2],
    sliding: f64,
    restitution: f64,
}

impl Slider {
    fn machine(&self) -> Machine {
        let parts = MachineParts::new(["x", "y"])
            .with_mass(0, 1.0)
            .with_mass(1, 1.0)
            .with_constant(0, self.force[0])
            .with_constant(1, self.force[1])
            .with_rigid_stop("table", &self.stop, 0.0, self.restitution)
            .with_joint("guide", &[1.0, 0.0], self.sliding, self.sliding, 0.0);
        Machine::new(parts).unwrap()
    }

    /// Position and velocity at a time, from (0, height) at rest.
    fn stepped(&self, height: f64, until: f64, steps: u32) -> ([f64; 2], [f64; 2]) {
        let h = until / f64::from(steps);
        let w = self.stop;
        let square = w[0] * w[0] + w[1] * w[1];
        let (mut q, mut v) = ([0.0, height], [0.0, 0.0]);
        for _ in 0..steps {
            for i in 0..2 {
                q[i] += 0.5 * h * v[i];
            }
            let gap = -(w[0] * q[0] + w[1] * q[1]);
            let before = -(w[0] * v[0] + w[1] * v[1]);
            let free = [v[0] + h * self.force[0], v[1] + h * self.force[1]];
            // impulses of stop and joint by Gauss and Seidel
            let (mut push, mut rub) = (0.0_f64, 0.0_f64);
            for _ in 0..60 {
                let rate =
                    |push: f64, rub: f64| -(w[0] * (free[0] - w[0] * push + rub) + w[1] * (free[1] - w[1] * push));
                if gap <= 0.0 {
                    push = (push - (rate(push, rub) + self.restitution * before) / square).max(0.0);
                }
                let slide = free[0] - w[0] * push + rub;
                rub = (rub - slide).clamp(-h * self.sliding, h * self.sliding);
            }
            v = [free[0] - w[0] * push + rub, free[1] - w[1] * push];
            for i in 0..2 {
                q[i] += 0.5 * h * v[i];
            }
        }
        (q, v)
    }
}

/// Bodies that come to rest on a table by impacts that move them along a joint: it holds at the end if the force at rest is within
/// its limit, and slides on else.
#[test]
fn impacts_that_move_a_joint() {
    for (k, slope, along, sliding, restitution) in [
        (0, 0.3, 0.0, 0.5, 0.5),
        (1, 0.3, 0.0, 0.2, 0.5),
        (2, 0.3, 0.1, 0.6, 0.7),
        (3, -0.5, 0.2, 0.4, 0.3),
        (4, -0.5, 0.2, 0.2, 0.6),
        (5, 0.1, 0.3, 0.5, 0.4),
        (6, 0.8, 0.0, 0.9, 0.5),
    ] {
        let slider = Slider { stop: [-slope, -1.0], force: [along, -1.0], sliding, restitution };
        let machine = slider.machine();
        let start = Start { q: vec![0.0, 0.1], ..Start::default() };
        let (seen, _) = events(&machine, &start, 500);
        let stick = seen.iter().find(|event| event.kind == EventKind::Stick && event.place == 0);
        let stick = stick.unwrap_or_else(|| panic!("{k}: {:?}", seen.last()));
        assert_speeds(&seen);
        // at rest on the table the joint bears the force along the table
        let t = [1.0, -slope];
        let pull = (t[0] * along - t[1]) / t[0];
        let holds = seen
            .iter()
            .skip_while(|event| event.time < stick.time)
            .any(|event| event.kind == EventKind::Hold && event.place == 1);
        let last = seen.last().unwrap();
        if pull.abs() < sliding {
            assert!(holds && last.qdot.iter().all(|v| v.abs() < 1e-9), "{k}: {pull} {last:?}");
        } else {
            assert!(!holds && stick.qdot[0].abs() > 1e-3, "{k}: {pull} {stick:?}");
        }
        let until = stick.time;
        let (q, v) = slider.stepped(0.1, until, 400_000);
        for i in 0..2 {
            let apart = ((q[i] - stick.q[i]).abs(), (v[i] - stick.qdot[i]).abs());
            assert!(apart.0 < 2e-4 && apart.1 < 2e-3, "{k}: {q:?} {v:?} {stick:?}");
        }
    }
}

/// A press: its ram, guided with friction in the frame, strikes a die at the frame.
fn press(frequency_hz: f64) -> Machine {
    let law = StopLaw::Compliant { stiffness: 5e6, damping: 400.0, preload: 0.0, opening: Opening::Force };
    let parts = MachineParts::new(["frame", "ram"])
        .with_mass(0, 200.0)
        .with_mass(1, 50.0)
        .with_constant(0, -1962.0)
        .with_constant(1, -490.5)
        .with_frequency(TAU * frequency_hz)
        .with_link(&[1.0, 0.0], 2e6, 1500.0)
        .with_link(&[-1.0, 1.0], 1e5, 0.0)
        .with_force(1, 1, 800.0, 0.0)
        .with_rigid_stop("die", &[1.0, -1.0], 0.002, 0.4)
        .with_stop("buffer", &[-1.0, 1.0], 0.004, law)
        .with_joint("guide", &[-1.0, 1.0], 20.0, 30.0, 0.0);
    Machine::new(parts).unwrap()
}

/// Its motion is decided at all frequencies, and followed for as long as it is asked for.
#[test]
fn a_press_with_a_guide_is_decided() {
    for frequency in [8.0, 9.0, 10.0, 11.0, 12.0, 13.0, 14.0] {
        let machine = press(frequency);
        let (seen, end) = events(&machine, &Start::default(), 1500);
        assert!(seen.len() == 1500 || matches!(end, Some(End::Never | End::Stuck)), "{frequency}: {end:?}");
        let verdict = settled(&machine, &Start::default());
        assert!(!matches!(verdict, Verdict::Undecided(_)), "{frequency}: {verdict:?}");
    }
}

/// A bar dropped flat on two feet, or three, bounces without pitch, whatever its inertia: the sum of all flights is that of a ball.
#[test]
fn a_bar_on_its_feet_comes_to_rest_flat() {
    let time = (2.0_f64 / 9.81).sqrt() * 3.0;
    for inertia in [1.0 / 3.0, 0.3, 1.0, 2.0] {
        for feet in [vec![1.0, -1.0], vec![1.0, 0.0, -1.0], vec![1.0, 0.5, -0.5, -1.0]] {
            let mut parts =
                MachineParts::new(["z", "p"]).with_mass(0, 1.0).with_mass(1, inertia).with_constant(0, -9.81);
            for (k, at) in feet.iter().enumerate() {
                parts = parts.with_rigid_stop(&format!("foot{k}"), &[-1.0, *at], 0.0, 0.5);
            }
            let machine = Machine::new(parts).unwrap();
            let start = Start { q: vec![1.0, 0.0], ..Start::default() };
            let (seen, end) = events(&machine, &start, 500);
            let last = seen.last().unwrap();
            assert_eq!((end, last.kind), (Some(End::Stuck), EventKind::Stick), "{inertia} {feet:?} {last:?}");
            assert!((last.time - time).abs() < 1e-12, "{inertia} {feet:?}: {} {time}", last.time);
            assert!(
                seen.iter().all(|event| event.q[1].abs() < 1e-14 && event.qdot[1].abs() < 1e-14),
                "{inertia} {feet:?}"
            );
            let sticks = seen.iter().filter(|event| event.kind == EventKind::Stick && event.time == last.time);
            assert_eq!(sticks.count(), feet.len());
            assert_speeds(&seen);
        }
    }
}

/// A ball gives all its speed to another one and rests exactly beside a spring, whose gap is zero and stays so: the search for the wall that the
/// other one strikes next ran out of its steps.
#[test]
fn a_body_at_rest_beside_an_open_stop_hides_no_event() {
    let soft = StopLaw::Compliant { stiffness: 30.0, damping: 0.0, preload: 0.0, opening: Opening::Force };
    for gap in [0.0, 0.1] {
        let parts = MachineParts::new(["b0", "b1"])
            .with_mass(0, 1.0)
            .with_mass(1, 1.0)
            .with_rigid_stop("balls", &[1.0, -1.0], -gap, 1.0)
            .with_stop("spring", &[0.0, 1.0], gap, soft)
            .with_rigid_stop("wall", &[-1.0, 0.0], 0.5, 1.0);
        let machine = Machine::new(parts).unwrap();
        let start = Start { q: vec![0.0, gap], qdot: vec![0.0, -1.0], ..Start::default() };
        let (found, end) = events(&machine, &start, 5);
        let told: Vec<(EventKind, usize, f64)> = found.iter().map(|of| (of.kind, of.place, of.time)).collect();
        let (impact, half) = (EventKind::Impact, PI / 30.0_f64.sqrt());
        let wanted =
            [(impact, 0, 0.0), (impact, 2, 0.5), (impact, 0, 1.0), (EventKind::Close, 1, 1.0), (impact, 0, 1.0 + half)];
        assert_eq!(told.len(), wanted.len(), "{told:?} {end:?}");
        for (told, wanted) in told.iter().zip(&wanted) {
            assert!(
                (told.0, told.1) == (wanted.0, wanted.1) && (told.2 - wanted.2).abs() < 1e-14,
                "{told:?} {wanted:?}"
            );
        }
    }
}

//! Samples of machines: they meet the events, the forces that they tell move the masses as they do and are those of closed forms,
//! and states at given times and crossings of a position are among them.

use super::case::{Case, cases};
use vibroimpact::events::{Event, EventKind, Limits, Motion, Sample, Samples, Start, crossings, states_at};
use vibroimpact::machine::{HarmonicMotion, Machine, MachineParts, Opening, StopLaw};
use vibroimpact::regime::ContactState;

const UNTIL: f64 = 3.0;
const STEP: f64 = 1e-3;

fn samples(case: &Case) -> Vec<Sample> {
    let limits = Limits { time: 1e3, ..Limits::default() };
    Samples::new(&case.machine, &case.start, limits, (UNTIL, STEP)).unwrap().collect()
}

/// The cases whose closed stops are not too stiff for the step.
fn chosen() -> impl Iterator<Item = Case> {
    let all = cases().into_iter().flat_map(|(_, cases)| cases);
    all.filter(|case| !case.name.starts_with("stiff")).step_by(9)
}

/// The force on each coordinate: all of the equation of motion but the acceleration.
pub(crate) fn force(machine: &Machine, sample: &Sample) -> Vec<f64> {
    let parts = machine.parts();
    let n = parts.n();
    (0..n)
        .map(|i| {
            let mut sum = parts.constant[i];
            for j in 0..n {
                sum -= parts.damping[(i, j)] * sample.qdot[j] + parts.stiffness[(i, j)] * sample.q[j];
            }
            for force in &parts.forces {
                let angle = f64::from(force.order) * sample.phase;
                sum += force.cos[i] * angle.cos() + force.sin[i] * angle.sin();
            }
            let stops = parts.stops.iter().map(|stop| stop.direction[i]);
            let directions = stops.chain(parts.joints.iter().map(|joint| joint.direction[i]));
            sum - directions.zip(&sample.forces).map(|(w, force)| w * force).sum::<f64>()
        })
        .collect()
}

/// By Simpson's rule over pairs of equal steps without an event.
#[test]
fn the_forces_that_are_told_move_the_masses() {
    let (mut checked, mut pushed) = (0_u32, 0_u32);
    for case in chosen() {
        let parts = case.machine.parts();
        let wave = samples(&case);
        for window in wave.windows(3) {
            let [a, b, c] = window else { continue };
            let equal = ((b.time - a.time) / (c.time - b.time) - 1.0).abs() < 1e-9;
            if !(equal && a.states == b.states && b.states == c.states) {
                continue;
            }
            let [fa, fb, fc] = [a, b, c].map(|sample| force(&case.machine, sample));
            let push = |i: usize| (c.time - a.time) / 6.0 * (fa[i] + 4.0 * fb[i] + fc[i]);
            for i in 0..parts.n() {
                let gain: f64 = (0..parts.n()).map(|j| parts.mass[(i, j)] * (c.qdot[j] - a.qdot[j])).sum();
                let size = 1.0 + fa.iter().chain(&a.forces).fold(0.0_f64, |most, force| most.max(force.abs()));
                assert!((gain - push(i)).abs() < 1e-9 * size, "{} at {}: {gain} and {}", case.name, b.time, push(i));
            }
            checked += 1;
            pushed += u32::from(a.forces.iter().any(|force| *force != 0.0));
        }
    }
    assert!(checked > 100_000 && pushed > 20_000, "{checked} windows, {pushed} with forces");
}

#[test]
fn samples_meet_the_events() {
    let mut met = 0_u32;
    for case in chosen() {
        let limits = Limits { time: 1e3, ..Limits::default() };
        let motion = Motion::new(&case.machine, &case.start, limits).unwrap();
        let events: Vec<_> = motion.take_while(|event| event.time < UNTIL).take(10_000).collect();
        let wave = samples(&case);
        let size = wave.iter().flat_map(|s| s.q.iter().chain(&s.qdot)).fold(1.0_f64, |most, x| most.max(x.abs()));
        for event in events.iter().filter(|event| event.time > 0.0 && event.kind != EventKind::Graze) {
            // the two sides; at one time there may be several events, of which the last has the velocities after all
            let last = events.iter().rfind(|other| other.time == event.time).unwrap();
            let sides: Vec<_> = wave.iter().filter(|sample| sample.time == event.time).collect();
            // where a motion ends there is nothing after it
            if sides.len() == 1 && wave.last().is_some_and(|sample| sample.time == event.time) {
                continue;
            }
            let [before, .., after] = sides.as_slice() else { panic!("{}: {event:?}", case.name) };
            for (i, q) in event.q.iter().enumerate() {
                assert!((before.q[i] - q).abs() < 1e-12 * size, "{}: {event:?} {before:?}", case.name);
                assert!((after.q[i] - q).abs() < 1e-12 * size, "{}: {event:?} {after:?}", case.name);
                // an impact whose rebounds are summed is followed by rest
                let summed = last.kind == EventKind::Impact && after.states[last.place] == ContactState::Resting;
                let allowed = if summed { last.speed } else { 1e-12 * size };
                assert!((after.qdot[i] - last.qdot[i]).abs() < allowed, "{}: {event:?} {after:?}", case.name);
            }
            match event.kind {
                EventKind::Impact => {
                    assert!(before.gaps[event.place].abs() < 1e-12 * size, "{}: {event:?} {before:?}", case.name);
                }
                // the surface of a damped stop may not have come back
                EventKind::Close => {
                    assert!(before.gaps[event.place] < 1e-12 * size, "{}: {before:?}", case.name);
                }
                EventKind::Stick => assert_eq!(after.states[event.place], ContactState::Resting),
                EventKind::Release => assert_eq!(before.states[event.place], ContactState::Resting),
                _ => {}
            }
            met += 1;
        }
        for sample in &wave {
            for (j, stop) in case.machine.stops().iter().enumerate() {
                let rigid = matches!(stop.law, StopLaw::Rigid { .. });
                assert!(!rigid || sample.gaps[j] > -1e-12 * size, "{}: {sample:?}", case.name);
            }
        }
    }
    assert!(met > 950, "{met} events");
}

fn wave(machine: &Machine, start: &Start, span: (f64, f64)) -> Vec<Sample> {
    Samples::new(machine, start, Limits::default(), span).unwrap().collect()
}

/// A mass of 100 kg on a spring of 10 kN/m strikes a spring of 1 MN/m at its place of rest with 1 m/s.
#[test]
fn the_force_of_a_spring_is_its_closed_form() {
    let law = StopLaw::Compliant { stiffness: 1e6, damping: 0.0, preload: 0.0, opening: Opening::Force };
    let parts = MachineParts::new(["mass"]).with_mass(0, 100.0).with_link(&[1.0], 1e4, 0.0);
    let machine = Machine::new(parts.with_stop("stop", &[1.0], 0.0, law)).unwrap();
    let start = Start { qdot: vec![1.0], ..Start::default() };
    let wave = wave(&machine, &start, (0.6, 1e-3));
    let rate = 1.01e4_f64.sqrt();
    let contact = core::f64::consts::PI / rate;
    let mut pressed = 0;
    for sample in &wave {
        let t = sample.time;
        if t <= contact {
            let want = 1e6 * (rate * t).sin() / rate;
            assert!((sample.forces[0] - want).abs() < 1e-9, "{sample:?}: {want}");
            assert!((sample.gaps[0] + want / 1e6).abs() < 1e-15);
            pressed += 1;
        } else if t < contact + core::f64::consts::PI / 10.0 {
            let slow = (10.0 * (t - contact)).sin();
            assert!((sample.q[0] + 0.1 * slow).abs() < 1e-14 && sample.forces[0] == 0.0, "{sample:?}");
        }
    }
    // 0, 1, ..., 31 ms; the two sides of the opening are at the end of the contact within rounding
    assert!((32..=34).contains(&pressed), "{pressed}");
    let even: Vec<f64> = wave.iter().filter(|sample| sample.even).map(|sample| sample.time).collect();
    assert_eq!(even.len(), 601);
    assert!(even.iter().zip(0_u32..).all(|(time, k)| *time == f64::from(k) * 1e-3 || *time == 0.6));
}

/// A mass on a table that shakes with an acceleration of 0.9 of gravity.
#[test]
fn a_table_carries_what_rests_on_it() {
    let mut parts = MachineParts::new(["mass"]).with_mass(0, 2.0).with_constant(0, -2.0).with_frequency(3.0);
    parts = parts.with_rigid_stop("table", &[-1.0], 0.0, 0.5);
    parts.stops[0].motion = vec![HarmonicMotion { order: 1, cos: 0.0, sin: 0.1 }];
    let machine = Machine::new(parts).unwrap();
    let start = Start { qdot: vec![0.3], ..Start::default() };
    for sample in wave(&machine, &start, (5.0, 0.01)) {
        // the surface is at 0.1 sin 3t
        let (up, push) = (0.1 * (3.0 * sample.time).sin(), 2.0 * (1.0 - 0.9 * (3.0 * sample.time).sin()));
        assert!((sample.q[0] - up).abs() < 1e-15 && sample.gaps[0] == 0.0, "{sample:?}");
        assert!((sample.forces[0] - push).abs() < 1e-14, "{sample:?}: {push}");
        assert_eq!(sample.states, [ContactState::Resting]);
    }
}

/// A block on a belt sticks to it until the spring pulls with the largest force.
#[test]
fn friction_holds_and_slides() {
    let parts = MachineParts::new(["block"]).with_mass(0, 1.0).with_link(&[1.0], 1.0, 0.0);
    let machine = Machine::new(parts.with_joint("belt", &[1.0], 0.5, 0.8, 0.1)).unwrap();
    let start = Start { qdot: vec![0.1], ..Start::default() };
    let wave = wave(&machine, &start, (9.0, 0.1));
    let held: Vec<_> = wave.iter().filter(|sample| sample.states[0] == ContactState::Holding).collect();
    assert!(held.len() > 70 && held.iter().all(|sample| (sample.forces[0] + sample.q[0]).abs() < 1e-15));
    let slides: Vec<_> = wave.iter().filter(|sample| sample.states[0] == ContactState::Backward).collect();
    assert!(slides.len() > 4 && slides.iter().all(|sample| sample.forces[0] == -0.5));
}

#[test]
fn ends_and_single_points() {
    let parts = MachineParts::new(["x"]).with_mass(0, 1.0);
    let machine = Machine::new(parts.with_rigid_stop("wall", &[1.0], 1.0, 0.0)).unwrap();
    let start = Start { qdot: vec![1.0], ..Start::default() };
    let times = |span| wave(&machine, &start, span).iter().map(|sample| (sample.time, sample.even)).collect::<Vec<_>>();
    assert_eq!(times((0.0, 0.5)), [(0.0, true)]);
    assert_eq!(times((0.75, 0.5)), [(0.0, true), (0.5, true), (0.75, false)]);
    // the impact at 1 is also an equal step
    assert_eq!(times((1.5, 0.5)), [(0.0, true), (0.5, true), (1.0, false), (1.0, true), (1.5, true)]);
    assert_eq!(times((1.0, 0.5)), [(0.0, true), (0.5, true), (1.0, true)]);
    assert!(times((-1.0, 0.5)).is_empty() && times((1.0, 0.0)).is_empty() && times((f64::NAN, 0.5)).is_empty());
}

/// Two masses, one of which strikes a wall.
fn machine() -> Machine {
    let mut parts = MachineParts::new(["body", "shoe"]).with_mass(0, 1.0).with_mass(1, 2.0).with_frequency(1.3);
    parts = parts.with_link(&[1.0, -1.0], 1.0, 0.05).with_link(&[0.0, 1.0], 1.5, 0.02);
    parts = parts.with_force(1, 1, 0.0, 0.4);
    Machine::new(parts.with_rigid_stop("wall", &[1.0, 0.0], 0.3, 0.7)).unwrap()
}

fn start() -> Start {
    Start { q: vec![-0.2, 0.1], qdot: vec![0.4, 0.0], ..Start::default() }
}

#[test]
fn the_states_are_those_of_the_waveform() {
    let (machine, start) = (machine(), start());
    let wave: Vec<Sample> =
        Samples::new(&machine, &start, Limits::default(), (40.0, 0.25)).unwrap().filter(|s| s.even).collect();
    let times: Vec<f64> = wave.iter().map(|sample| sample.time).collect();
    let states = states_at(&machine, &start, &times).unwrap();
    assert_eq!(states.len(), 161);
    assert!(states.iter().zip(&wave).all(|(state, sample)| state.as_ref() == Some(sample)));
    // at the time of an impact the state after it
    let impact = Motion::new(&machine, &start, Limits::default()).unwrap().find(Event::closes).unwrap();
    let there = states_at(&machine, &start, &[impact.time]).unwrap().remove(0).unwrap();
    assert!((there.qdot[0] - impact.qdot[0]).abs() < 1e-14 && impact.qdot[0] < 0.0);
    assert_eq!(states_at(&machine, &start, &[f64::NAN, -1.0]).unwrap(), [None, None]);
}

#[test]
fn the_crossings_are_where_a_fine_waveform_changes_its_side() {
    let (machine, start) = (machine(), start());
    let fine: Vec<Sample> = Samples::new(&machine, &start, Limits::default(), (60.0, 1e-3)).unwrap().collect();
    for (coordinate, position) in [(0, 0.0), (0, 0.25), (1, 0.05), (0, -0.4)] {
        let found = crossings(&machine, &start, (coordinate, position), 60.0).unwrap();
        let away = |sample: &Sample| sample.q[coordinate] - position;
        let changes: Vec<f64> =
            fine.windows(2).filter(|pair| away(&pair[0]) * away(&pair[1]) < 0.0).map(|pair| pair[0].time).collect();
        assert!(changes.len() > 5, "{}", changes.len());
        assert_eq!(found.len(), changes.len(), "{coordinate} {position}");
        let times: Vec<f64> = found.iter().map(|event| event.time).collect();
        let states = states_at(&machine, &start, &times).unwrap();
        for ((crossing, time), state) in found.iter().zip(&changes).zip(states) {
            let state = state.unwrap();
            assert!((crossing.time - time).abs() < 2e-3 && (crossing.q[coordinate] - position).abs() < 1e-13);
            let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-13);
            assert!(near(&state.q, &crossing.q) && near(&state.qdot, &crossing.qdot), "{crossing:?} {state:?}");
        }
        assert!(found.windows(2).all(|pair| pair[0].qdot[coordinate] * pair[1].qdot[coordinate] < 0.0));
    }
    for position in [0.3, 0.4, f64::NAN] {
        assert!(crossings(&machine, &start, (0, position), 60.0).is_err(), "{position}");
    }
}

//! Samples of machines: they meet the events, and the forces that they tell move the masses as they do.

use super::case::{Case, cases};
use vibroimpact::events::{EventKind, Limits, Motion, Sample, Samples};
use vibroimpact::machine::Machine;
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
                let rigid = matches!(stop.law, vibroimpact::machine::StopLaw::Rigid { .. });
                assert!(!rigid || sample.gaps[j] > -1e-12 * size, "{}: {sample:?}", case.name);
            }
        }
    }
    assert!(met > 950, "{met} events");
}

//! Machines that are computed as the oscillator they are, and the same machines followed as any other.

use crate::verdicts::beside;
use crate::{System, some, systems};
use std::borrow::Cow;
use vibroimpact::events;
use vibroimpact::events::Limits;
use vibroimpact::lanes::Width;
use vibroimpact::machine::{HarmonicMotion, Machine, MachineParts, Opening, StopLaw};
use vibroimpact::motion::{EventKind, Motion};
use vibroimpact::verdict::{
    Chaos, KnownMotions, NoImpact, SettleOptions, Verdict, settle, settle_each_machine, settle_machine,
    settle_machine_many, settle_unreduced,
};
use vibroimpact::{Oscillator, Side, Start, scenario};

/// How a machine differs from the oscillator that it is.
#[derive(Clone, Copy, Debug)]
struct Dress {
    mass: f64,
    stiffness: f64,
    /// Amplitude and phase of the force on the oscillator.
    force: (f64, f64),
    constant: f64,
    /// The motion of the stops: sine and cosine.
    swing: (f64, f64),
    /// The lengths of the directions of the stops.
    directions: (f64, f64),
    mirrored: bool,
}

const PLAIN: Dress = Dress {
    mass: 1.0,
    stiffness: 1.0,
    force: (1.0, 0.0),
    constant: 0.0,
    swing: (0.0, 0.0),
    directions: (1.0, 1.0),
    mirrored: false,
};

/// Each of the ways alone, and all together.
const DRESSES: [Dress; 7] = [
    Dress { mass: 2.5, stiffness: 0.3, force: (1e-3, 0.0), ..PLAIN },
    Dress { force: (1.0, 2.1), ..PLAIN },
    Dress { constant: -1.3, ..PLAIN },
    Dress { swing: (0.4, -1.1), ..PLAIN },
    Dress { directions: (0.7, 3.0), ..PLAIN },
    Dress { mirrored: true, ..PLAIN },
    Dress {
        mass: 0.02,
        stiffness: 700.0,
        force: (35.0, -2.5),
        constant: 60.0,
        swing: (-0.03, 0.02),
        directions: (4.0, 0.25),
        mirrored: true,
    },
];

impl Dress {
    /// The machine in this dress that is the oscillator. With two stops it is not mirrored.
    fn machine(&self, osc: &Oscillator) -> Machine {
        let (m, k) = (self.mass, self.stiffness);
        let mirrored = self.mirrored && osc.stop(Side::Lower).is_none();
        let (c, omega) = (2.0 * osc.damping() * (k * m).sqrt(), osc.beta() * (k / m).sqrt());
        let (amplitude, phase) = self.force;
        let (sin, cos) = self.swing;
        let sign = if mirrored { -1.0 } else { 1.0 };
        let (re, im) = (k - m * omega * omega, omega * c);
        let mut parts = MachineParts::new(["body"])
            .with_mass(0, m)
            .with_link(&[1.0], k, c)
            .with_frequency(omega)
            .with_constant(0, self.constant)
            .with_force(
                0,
                1,
                sign * amplitude * phase.sin() + re * cos + im * sin,
                sign * amplitude * phase.cos() + re * sin - im * cos,
            );
        // the lower stop is the first
        for (side, stop) in osc.stops().collect::<Vec<_>>().into_iter().rev() {
            let length = if side == Side::Upper { self.directions.0 } else { self.directions.1 };
            let w = sign * side.sign() * length;
            let at = self.constant / k + sign * side.sign() * stop.gap * amplitude / k;
            parts = parts.with_rigid_stop(&format!("{side:?}"), &[w], w * at, stop.restitution);
            if self.swing != (0.0, 0.0) {
                let motion = HarmonicMotion { order: 1, cos: -w * cos, sin: -w * sin };
                parts.stops.last_mut().unwrap().motion.push(motion);
            }
        }
        Machine::new(parts).unwrap()
    }
}

fn start_of(machine: &Machine, start: Start) -> events::Start {
    let (q, qdot, phase) = machine.reduced().unwrap().state(start);
    events::Start { q: vec![q], qdot: vec![qdot], phase, ..events::Start::default() }
}

fn near(a: f64, b: f64, within: f64) -> bool {
    (a - b).abs() <= within * (1.0 + b.abs())
}

/// In a machine of unit mass, stiffness and force nothing changes, to the last bit: oscillator, start and back.
#[test]
fn units_are_exact() {
    for system in systems() {
        let reduction = system.machine().reduced().unwrap();
        assert_eq!(reduction.oscillator, system.oscillator, "{}", system.text);
        let Start { x, v, phase } = system.start;
        assert_eq!(reduction.start(x, v, phase), Some(system.start), "{}", system.text);
        assert_eq!(reduction.state(system.start), (x, v, phase), "{}", system.text);
        assert_eq!((reduction.length(), reduction.time(), reduction.sign()), (1.0, 1.0, 1.0));
        assert_eq!(reduction.stop(Side::Upper), Some(0));
    }
}

/// The events of the machine, by its own equations, are those of the oscillator: times, stops, speeds and states.
#[test]
fn events_in_any_dress() {
    let mut impacts = 0;
    for (k, system) in systems().take(140).enumerate() {
        let dress = DRESSES[k % DRESSES.len()];
        let (osc, machine) = (system.oscillator, dress.machine(&system.oscillator));
        let same = machine.reduced().unwrap();
        let fault = format!("{dress:?} {}", system.text);
        assert!(
            near(same.oscillator.beta(), osc.beta(), 1e-14) && near(same.oscillator.gap(), osc.gap(), 1e-12),
            "{fault}"
        );
        let start = start_of(&machine, system.start);
        let motion = events::Motion::new(&machine, &start, Limits::default()).unwrap();
        let own = motion.filter(|event| event.kind == events::EventKind::Impact);
        let of = Motion::new(&osc, system.start).filter_map(|event| match event.kind {
            EventKind::Impact { velocity_before, .. } => Some((event, velocity_before)),
            _ => None,
        });
        // the first ones, before rounding errors grow
        for (event, (expected, speed)) in own.zip(of).take(4) {
            impacts += 1;
            assert!(near(event.time / same.time(), expected.time, 1e-9), "{fault}: {event:?} {expected:?}");
            assert_eq!(Some(event.place), same.stop(expected.side), "{fault}");
            assert!(near(event.speed / same.speed(expected.side, 1.0), speed, 1e-8), "{fault}: {event:?} {expected:?}");
            let back = same.start(event.q[0], event.qdot[0], event.phase).unwrap();
            let stop = same.oscillator.stop(expected.side).unwrap();
            assert_eq!(back.x, expected.side.sign() * stop.gap, "{fault}");
            assert!(near(back.v.abs(), stop.restitution * speed, 1e-8), "{fault}: {back:?} {expected:?}");
        }
    }
    assert!(impacts > 250, "{impacts}");
}

/// A start on a stop stays there, both ways, also on one that moves; one beyond is none.
#[test]
fn on_a_stop() {
    let osc = Oscillator::new(0.8, 0.37, 0.6).unwrap().with_second_stop(1.13, 0.4).unwrap();
    for dress in DRESSES {
        let machine = dress.machine(&osc);
        let same = machine.reduced().unwrap();
        for k in 0..40 {
            for (side, stop) in same.oscillator.stops() {
                let at = Start { x: side.sign() * stop.gap, v: 0.3, phase: 0.157 * f64::from(k) };
                let (q, qdot, phase) = same.state(at);
                assert_eq!(same.start(q, qdot, phase).unwrap().x, at.x, "{dress:?} {side:?}");
                let beyond = q + 1e-9 * side.sign() * same.sign() * (1.0 + q.abs());
                assert_eq!(same.start(beyond, qdot, phase), None, "{dress:?} {side:?}");
                let start = events::Start { q: vec![q], qdot: vec![qdot], phase, ..events::Start::default() };
                assert!(events::Motion::new(&machine, &start, Limits::default()).is_ok());
            }
        }
    }
}

/// What is no oscillator is not computed as one.
#[test]
fn other_machines() {
    let parts = || {
        MachineParts::new(["x"])
            .with_mass(0, 1.0)
            .with_link(&[1.0], 1.0, 0.1)
            .with_frequency(0.7)
            .with_force(0, 1, 0.0, 1.0)
    };
    let stop = |parts: MachineParts| parts.with_rigid_stop("a", &[1.0], 0.5, 0.5);
    let is = |parts: MachineParts| Machine::new(parts).unwrap().reduced().is_some();
    assert!(is(stop(parts())) && is(stop(parts()).with_rigid_stop("b", &[-1.0], 0.5, 0.5)));
    assert!(is(stop(parts()).with_force(0, 2, 0.0, 0.0)));
    assert!(!is(parts()));
    assert!(!is(stop(parts()).with_rigid_stop("b", &[2.0], 0.5, 0.5)));
    assert!(!is(stop(parts()).with_force(0, 2, 0.0, 0.1)));
    assert!(!is(stop(parts()).with_joint("j", &[1.0], 0.1, 0.1, 0.0)));
    let soft = StopLaw::Compliant { stiffness: 9.0, damping: 0.0, preload: 0.0, opening: Opening::Force };
    assert!(!is(parts().with_stop("a", &[1.0], 0.5, soft)));
    let mut apart = stop(parts()).with_rigid_stop("b", &[-1.0], 0.5, 0.5);
    let motion = |cos, order| vec![HarmonicMotion { order, cos, sin: 0.0 }];
    apart.stops[0].motion = motion(0.1, 1);
    assert!(!is(apart.clone()));
    apart.stops[1].motion = motion(0.1, 1);
    assert!(!is(apart.clone()));
    apart.stops[1].motion = motion(-0.1, 1);
    assert!(is(apart.clone()));
    apart.stops[1].motion = motion(-0.1, 2);
    assert!(!is(apart));
    let mut still = stop(parts());
    still.forces.clear();
    assert!(!is(still.clone()));
    // the wall alone drives it
    still.stops[0].motion = motion(0.1, 1);
    assert!(is(still.clone()));
    still.stiffness[(0, 0)] = 0.0;
    assert!(!is(still));
    let two = MachineParts::new(["x", "y"]).with_mass(0, 1.0).with_mass(1, 1.0).with_link(&[1.0, 0.0], 1.0, 0.0);
    assert!(!is(two.with_frequency(1.0).with_force(0, 1, 1.0, 0.0).with_rigid_stop("a", &[1.0, 0.0], 1.0, 0.5)));
}

/// Both verdicts on a machine: the labels, and of a cycle the fastest speed and the multipliers.
fn compare(machine: &Machine, start: &events::Start) -> Result<(String, String), String> {
    let options = SettleOptions::default();
    let found = settle_machine(machine, start, &options).unwrap().verdict;
    let own = settle_unreduced(machine, start, &options).unwrap().verdict;
    match (&found, &own) {
        (Verdict::Periodic(a), Verdict::Periodic(b)) if a.label == b.label => {
            let within = if a.counts.iter().sum::<u32>() > 0 && a.events.len() > 40 { 1e-6 } else { 1e-8 };
            if !near(a.fastest() / b.fastest(), 1.0, within) || a.counts != b.counts || !near(a.period, b.period, 1e-13)
            {
                return Err(format!("{} {} and {}", a.label, a.fastest(), b.fastest()));
            }
            for (one, two) in a.multipliers.iter().zip(&b.multipliers) {
                if !near(one.modulus(), two.modulus(), 1e-6) {
                    return Err(format!("{} {one:?} and {two:?}", a.label));
                }
            }
        }
        (Verdict::Chaotic(Chaos { spectrum: a, .. }), Verdict::Chaotic(Chaos { spectrum: b, .. })) => {
            let closings = (&a.impact_rate, &b.impact_rate);
            for (one, two) in a.exponents.iter().zip(&b.exponents).chain([closings]) {
                if (one.value - two.value).abs() > 2.0 * (one.error + two.error) {
                    return Err(format!("{one:?} and {two:?}"));
                }
            }
        }
        _ => {}
    }
    Ok((found.label().into_owned(), own.label().into_owned()))
}

/// The paper's points in any dress, from rest and elsewhere: with and without the reduction the same motions.
#[test]
fn the_papers_points() {
    let mut labels = std::collections::BTreeMap::<String, u32>::new();
    for point in scenario::PAPER {
        for dress in [PLAIN].into_iter().chain(DRESSES) {
            let machine = dress.machine(&point.oscillator());
            for (x, v) in [(0.0, 0.0), (-2.0, 0.0), (0.1, -1.0)] {
                let (found, own) = compare(&machine, &start_of(&machine, Start { x, v, phase: 0.0 })).unwrap();
                assert_eq!(found, own, "{} {dress:?} {x} {v}", point.name);
                *labels.entry(found).or_default() += 1;
            }
        }
    }
    assert!(labels.contains_key("chaotic") && labels.contains_key("4/1") && labels.contains_key("0"), "{labels:?}");
}

/// The random systems in any dress. The oscillator decides more: it completes a measurement beyond the budget. Where a chaotic
/// transient ends in one of several motions, rounding errors of the start can decide which.
#[test]
fn random_systems() {
    let (mut same, mut decided, mut sensitive, mut differ) = (0, 0, 0, Vec::new());
    for (k, system) in some().enumerate() {
        let dress = DRESSES[k % DRESSES.len()];
        let machine = dress.machine(&system.oscillator);
        match compare(&machine, &start_of(&machine, system.start)) {
            Ok((found, own)) if found == own => same += 1,
            Ok((_, own)) if own == "undecided" => decided += 1,
            Ok((_, own)) if beside(&system, &SettleOptions::default()).any(|label| label == own) => sensitive += 1,
            Ok((found, own)) => differ.push(format!("{dress:?} {}: {found} {own}", system.text)),
            Err(fault) => differ.push(format!("{dress:?} {}: {fault}", system.text)),
        }
    }
    let summary = format!("{same} agree, {decided} decided, {sensitive} sensitive");
    assert!(differ.is_empty() && decided <= 2 && sensitive <= 2, "{summary}; {differ:#?}");
}

/// A machine of unit mass, stiffness and force has the verdicts of the oscillator.
#[test]
fn the_oscillators_verdicts() {
    let options = SettleOptions::default();
    let mut converted = 0;
    for System { oscillator, start, text } in some() {
        let system = System { oscillator, start, text };
        let expected = settle(&oscillator, start, &options);
        let found = settle_machine(&system.machine(), &system.machine_start(), &options).unwrap();
        match (&expected.verdict, &found.verdict) {
            (Verdict::Periodic(a), Verdict::Periodic(b)) => {
                assert_eq!(a.label, b.label, "{}", system.text);
                // the sum of a chatter has an error, which the motion after it enlarges
                let within = if a.rests.is_empty() { 1e-12 } else { 1e-7 };
                assert!(near(a.fastest(), b.fastest(), within), "{} {} {}", system.text, a.fastest(), b.fastest());
            }
            (Verdict::Chaotic(a), Verdict::Chaotic(Chaos { spectrum, .. })) => {
                assert_eq!(a.spectrum.exponents[..], spectrum.exponents[..], "{}", system.text);
            }
            _ => continue,
        }
        converted += 1;
        assert_eq!((expected.impacts, expected.time), (found.impacts, found.time), "{}", system.text);
    }
    assert!(converted > 30, "{converted}");
}

/// Ever gentler impacts at Q: the machine follows thousands of them and comes to the same end, no impact in the limit. The state
/// that is given moves on without one.
#[test]
fn a_limit_that_grazes() {
    let options = SettleOptions::default();
    let (osc, mut limits) = (scenario::Q.oscillator(), 0);
    for k in 0..20 {
        let machine = DRESSES[k % DRESSES.len()].machine(&osc);
        let start = Start { x: 1.5 - 0.15 * f64::from(u32::try_from(k).unwrap()), v: 0.5, phase: 0.0 };
        if !matches!(settle(&osc, start, &options).verdict, Verdict::NoImpact(NoImpact::GrazeLimit { .. })) {
            continue;
        }
        limits += 1;
        let (found, own) = compare(&machine, &start_of(&machine, start)).unwrap();
        assert_eq!((found.as_str(), own.as_str()), ("0", "0"), "{k}");
        let verdict = settle_machine(&machine, &start_of(&machine, start), &options).unwrap().verdict;
        let reached = verdict.reached(&machine).unwrap();
        let motion = events::Motion::new(&machine, &reached, Limits::default()).unwrap();
        let scale = machine.reduced().unwrap().speed(Side::Upper, 1.0);
        for event in motion.take(50) {
            assert!(event.speed < 1e-6 * scale, "{k} {event:?}");
        }
    }
    assert!(limits > 3, "{limits}");
}

/// The basin of S: 3600 starts, none with another label, in one call and in parts, at any width of the lanes, and as the machine's
/// own motions.
#[test]
fn a_basin() {
    let machine = DRESSES[6].machine(&scenario::S.oscillator());
    let at = |k: u32, from: f64, to: f64| from + (to - from) * f64::from(k) / 59.0;
    let grid = (0..3600).map(|k| Start { x: at(k % 60, -2.0, 0.75), v: at(k / 60, -2.0, 2.0), phase: 0.0 });
    let starts: Vec<events::Start> = grid.map(|start| start_of(&machine, start)).collect();
    let options = SettleOptions::default();
    let survey: Vec<events::Start> = starts.iter().step_by(200).cloned().collect();
    let (none, known) = (KnownMotions::default(), KnownMotions::survey(&machine, &survey, &options));
    let labels = |starts: &[events::Start], known: &KnownMotions, width: Width| -> Vec<String> {
        let found = settle_machine_many(&machine, starts, known, &options, width, &|| true, &|| false).unwrap();
        let counted: u64 = found.motions.iter().map(|motion| motion.count).sum();
        assert_eq!((counted, found.seen.len()), (starts.len() as u64, starts.len()));
        found.cells.iter().map(|cell| found.motions[cell.unwrap() as usize].verdict.label().into_owned()).collect()
    };
    let all = labels(&starts, &known, Width::best());
    assert_eq!(all.iter().filter(|label| *label == "1/1").count(), 1595);
    assert_eq!(all.iter().filter(|label| *label == "2/1").count(), 2005);
    assert_eq!(labels(&starts, &none, Width::Portable), all);
    let parts: Vec<String> = starts.chunks(77).flat_map(|part| labels(part, &known, Width::best())).collect();
    assert_eq!(parts, all);
    for k in (0..3600).step_by(9) {
        let own = settle_unreduced(&machine, &starts[k], &options).unwrap().verdict.label();
        assert_eq!(own, all[k], "{k}");
    }
}

/// Starts of many machines together, with starts beyond a stop, with contacts, and a machine that is no oscillator among them: each
/// as alone.
#[test]
fn many_machines() {
    let options = SettleOptions { max_impacts: 6000, ..SettleOptions::default() };
    let mut problems = Vec::new();
    for (k, system) in systems().take(36).enumerate() {
        let dress = DRESSES[k % DRESSES.len()];
        let mut machine = dress.machine(&system.oscillator);
        let beside = |v: f64| start_of(&machine, Start { v, ..system.start });
        let mut starts = vec![beside(system.start.v), beside(0.5), beside(-1.0)];
        starts.push(events::Start { q: vec![machine.stops()[0].direction[0].signum() * 1e9], ..starts[0].clone() });
        let state = events::Motion::with_states(&machine, &starts[0], Limits::default()).unwrap().nth(2);
        starts.extend(state.and_then(|event| event.state).map(|state| *state));
        if k % 9 == 0 {
            let small = 1e-3 * machine.parts().stiffness[(0, 0)];
            machine = Machine::new(machine.parts().clone().with_force(0, 3, small, 0.0)).unwrap();
            starts.truncate(2);
        }
        problems.push((machine, starts));
    }
    let alone: Vec<Vec<Option<Cow<'_, str>>>> = problems
        .iter()
        .map(|(machine, starts)| {
            let one = |start| settle_machine(machine, start, &options).ok().map(|found| found.verdict.label());
            starts.iter().map(one).collect()
        })
        .collect();
    assert!(
        alone.iter().flatten().any(Option::is_none) && alone.iter().flatten().flatten().any(|label| label == "chaotic")
    );
    for width in Width::ALL.into_iter().filter(|width| width.available()) {
        let all = settle_each_machine(&problems, &options, width, &|| true, &|| false).unwrap();
        for ((found, expected), (machine, _)) in all.iter().zip(&alone).zip(&problems) {
            let label = |cell: &Option<u32>| cell.map(|cell| found.motions[cell as usize].verdict.label());
            let labels: Vec<_> = found.cells.iter().map(label).collect();
            assert_eq!(&labels, expected, "{:?}", machine.parts());
        }
    }
    assert!(settle_each_machine(&problems, &options, Width::best(), &|| true, &|| true).is_none());
    assert!(settle_each_machine(&problems, &options, Width::best(), &|| false, &|| false).is_none());
}

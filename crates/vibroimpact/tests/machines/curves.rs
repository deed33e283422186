//! Curves of events of machines in two numbers: against closed forms, against those of the oscillator, and against
//! simulation on both sides.

use crate::branches::{beside_another, of, random_machine, sequence};
use crate::closed_forms::ball;
use core::f64::consts::PI;
use vibroimpact::continuation::machine;
use vibroimpact::continuation::{
    Branch, BranchEvent, BranchOptions, Curve, CurveEvent, CurveKind, CurveOptions, Direction, Frame,
    machine::{CurvePoint, Family, Plane, SolutionPoint},
};
use vibroimpact::events;
use vibroimpact::machine::{Machine, MachineParts, Opening, StopLaw};
use vibroimpact::orbit::{find_machine_while, machine::Cycle};
use vibroimpact::verdict::{SettleOptions, Verdict, scattered_machine_starts, settle, settle_machine};
use vibroimpact::{Label, Oscillator, Parameter, Start};

fn settled(machine: &Machine, start: &events::Start) -> Verdict<Machine> {
    settle_machine(machine, start, &SettleOptions::default()).unwrap().verdict
}

fn cycle(machine: &Machine, start: &events::Start) -> Cycle {
    let Verdict::Periodic(cycle) = settled(machine, start) else { panic!("no cycle") };
    cycle
}

/// The events of a branch.
fn events(
    (family, value): (&Family, f64),
    cycle: &Cycle,
    range: core::ops::RangeInclusive<f64>,
    direction: Direction,
) -> Vec<SolutionPoint> {
    let branch = machine::Branch::new((family, value), cycle, &range, direction, BranchOptions::default()).unwrap();
    branch.filter(|point| point.event.is_some()).collect()
}

/// Both directions of a curve, from one end to the other.
fn whole([forth, back]: [machine::Curve; 2]) -> Vec<CurvePoint> {
    let mut points: Vec<CurvePoint> = back.skip(1).collect();
    points.reverse();
    points.extend(forth);
    points
}

const OPTIONS: CurveOptions = CurveOptions { longest: 0.1, points: 400 };

/// Fold and flip of the ball on a table in closed form over restitution and acceleration.
#[test]
fn ball_on_a_table() {
    let plane = |gamma: (f64, f64)| {
        Plane::new(
            |gamma, e| (gamma > 0.0 && (0.0..=1.0).contains(&e)).then(|| ball(gamma, e)),
            (gamma.0..=gamma.1, 0.1..=1.0),
        )
    };
    let (e, between) = (0.5, 1.2_f64);
    let machine = ball(between, e);
    let found = (0..48).find_map(|k| {
        let phase = 2.0 * PI * f64::from(k) / 48.0;
        let (height, rate) = (between * phase.sin(), between * phase.cos());
        let start = events::Start { q: vec![height + 1e-9], qdot: vec![rate + PI], phase, ..events::Start::default() };
        match settled(&machine, &start) {
            Verdict::Periodic(cycle) if cycle.label.to_string() == "1/1" => Some(cycle),
            _ => None,
        }
    });
    let cycle = found.expect("the locked motion is stable between the fold and the flip");
    let family = Family::new(move |gamma| (gamma > 0.0).then(|| ball(gamma, e)));
    let fold = |e: f64| PI * (1.0 - e) / (1.0 + e);
    let flip = |e: f64| fold(e).hypot(2.0 * (1.0 + e * e) / ((1.0 + e) * (1.0 + e)));
    for (direction, kind, law) in
        [(Direction::Up, CurveKind::Flip, &flip as &dyn Fn(f64) -> f64), (Direction::Down, CurveKind::Fold, &fold)]
    {
        let found = events((&family, between), &cycle, 0.1..=4.0, direction);
        let point = found.iter().find(|point| point.event.is_some_and(|event| event.name() == kind.name())).unwrap();
        let curves = machine::Curve::through(&plane((0.05, 4.0)), (point.value, e), point, OPTIONS).unwrap();
        assert_eq!(curves[0].kind(), kind);
        let points = whole(curves);
        let (mut low, mut high) = (1.0_f64, 0.0_f64);
        for point in &points {
            let (gamma, e) = point.values;
            assert!((gamma - law(e)).abs() < 1e-9, "{kind:?} {gamma} {e}: {}", law(e));
            (low, high) = (low.min(e), high.max(e));
        }
        assert!(points.len() > 20 && low < 0.35 && high > 0.95, "{} {low} {high}", points.len());
    }
}

/// Curves of machines of one coordinate end at the edges of the frame where those of the oscillator do.
#[test]
fn the_curves_of_the_oscillator() {
    ends_of_curves(of);
}

/// The same by the equations of the machine.
#[test]
fn the_curves_of_the_oscillator_beside_another_mass() {
    ends_of_curves(beside_another);
}

fn ends_of_curves(machine_of: fn(&Oscillator) -> Machine) {
    let mut compared = std::collections::BTreeMap::new();
    for (inverse, gap, eps, zeta, betas) in
        [(1.11, 1.0, 0.5, 0.0, (0.88, 0.92)), (1.3, 0.75, 0.5, 0.05, (0.72, 0.82)), (0.8, 0.5, 0.7, 0.1, (1.2, 1.3))]
    {
        let osc = Oscillator::from_inverse_beta(inverse, gap, eps).unwrap().with_damping(zeta).unwrap();
        let machine = machine_of(&osc);
        let Verdict::Periodic(known) =
            settle(&osc, Start { x: 0.0, v: 0.0, phase: 0.0 }, &SettleOptions::default()).verdict
        else {
            panic!()
        };
        let found = cycle(&machine, &events::Start::default());
        let ranges = (0.1..=4.0, betas.0..=betas.1);
        let frame = Frame { plane: (Parameter::Gap, Parameter::Beta).into(), ranges: ranges.clone() };
        let plane = Plane::of_paths(&machine, ("stop.stop.gap", "frequency"), ranges).unwrap();
        for direction in [Direction::Up, Direction::Down] {
            let (family, value) = Family::of_path(&machine, "stop.stop.gap").unwrap();
            let own = events((&family, value), &found, 0.1..=4.0, direction);
            let branch = Branch::new(&osc, &known, Parameter::Gap, 0.1..=4.0, direction, BranchOptions::default());
            for point in branch.unwrap() {
                let kind = match point.event {
                    Some(BranchEvent::Fold) => CurveKind::Fold,
                    Some(BranchEvent::Flip) => CurveKind::Flip,
                    Some(BranchEvent::Grazing { .. } | BranchEvent::LossOfContact { .. }) => {
                        CurveKind::Grazing { stop: 0 }
                    }
                    _ => continue,
                };
                let Ok(theirs) = Curve::through(&osc, &point, Parameter::Gap, &frame, CurveOptions::default()) else {
                    continue;
                };
                let same = |other: &&SolutionPoint| (other.value - point.value).abs() < 1e-8;
                let Some(own) = own.iter().find(same) else { continue };
                let ours = machine::Curve::through(&plane, (own.value, osc.beta()), own, OPTIONS).unwrap();
                let ends: Vec<(f64, f64)> = ours
                    .into_iter()
                    .filter_map(|curve| curve.last().filter(|p| p.event == Some(CurveEvent::EndOfBox)))
                    .map(|point| point.values)
                    .collect();
                for end in theirs.into_iter().filter_map(Iterator::last) {
                    if end.event != Some(CurveEvent::EndOfBox) || !end.physical {
                        continue;
                    }
                    let off = |(p, q): &(f64, f64)| (p - end.values.0).abs().max((q - end.values.1).abs());
                    let nearest = ends.iter().map(off).fold(f64::INFINITY, f64::min);
                    assert!(nearest < 1e-9, "{kind:?} {point:?}: {end:?} {ends:?}");
                    *compared.entry(format!("{kind:?}")).or_insert(0) += 1;
                }
            }
        }
    }
    assert!(compared.len() == 3 && compared.values().all(|count| *count >= 2), "{compared:?}");
}

/// The two-mass hammer of the catalogue.
pub(crate) fn hammer(frequency: f64, gap: f64) -> Option<Machine> {
    let parts = MachineParts::new(["frame", "head"])
        .with_mass(0, 1.0)
        .with_mass(1, 0.5)
        .with_link(&[1.0, 0.0], 1.0, 0.1)
        .with_link(&[1.0, -1.0], 1.0, 0.1)
        .with_frequency(frequency)
        .with_force(0, 1, 0.0, 1.0)
        .with_rigid_stop("anvil", &[0.0, 1.0], gap, 0.6);
    Machine::new(parts).ok()
}

/// Beside curves of flips and of grazing of two masses, simulation finds the cycle of the curve on one side only.
#[test]
fn two_masses_on_both_sides() {
    let machine = hammer(1.2, 0.5).unwrap();
    let found = cycle(&machine, &events::Start::default());
    let family = Family::new(|frequency| hammer(frequency, 0.5));
    let all = events((&family, 1.2), &found, 0.8..=1.2, Direction::Down);
    let plane = Plane::new(hammer, (0.7..=1.4, 0.3..=0.7));
    let mut confirmed = std::collections::BTreeMap::new();
    for kind in ["grazing", "flip"] {
        let event = all.iter().find(|point| point.event.is_some_and(|event| event.name() == kind)).unwrap();
        let points = whole(machine::Curve::through(&plane, (event.value, 0.5), event, OPTIONS).unwrap());
        let ordinary: Vec<_> = points.iter().filter(|point| point.event.is_none()).collect();
        for point in ordinary.iter().step_by(ordinary.len().div_ceil(5)) {
            assert!(point.residual < 1e-9, "{point:?}");
            let (frequency, gap) = point.values;
            let label = point.cycle.label;
            let side = |by: f64| settled(&hammer(frequency + by, gap).unwrap(), &point.cycle.state).label();
            let (one, two) = (side(-2e-3), side(2e-3));
            assert!(
                (one == label.to_string()) != (two == label.to_string()),
                "{:?} {label}: {one} {two}",
                point.values
            );
            *confirmed.entry(kind).or_insert(0) += 1;
        }
    }
    assert!(confirmed.values().all(|count| *count >= 4), "{confirmed:?}");
}

/// The amplitude of the displacement at the stop of the steady motion without contact.
fn amplitude(machine: &Machine, frequency: f64) -> f64 {
    // (K - w^2 M + i w C) q = f as real equations of twice the size
    let (parts, n) = (machine.parts(), 2);
    let mut a = [[0.0_f64; 5]; 4];
    for i in 0..n {
        for j in 0..n {
            let stiff = parts.stiffness[(i, j)] - frequency * frequency * parts.mass[(i, j)];
            let damped = frequency * parts.damping[(i, j)];
            (a[i][j], a[i][j + n], a[i + n][j], a[i + n][j + n]) = (stiff, -damped, damped, stiff);
        }
        let force = &parts.forces[0];
        (a[i][4], a[i + n][4]) = (force.cos[i], -force.sin[i]);
    }
    for k in 0..4 {
        let pivot = (k..4).max_by(|i, j| a[*i][k].abs().total_cmp(&a[*j][k].abs())).unwrap();
        a.swap(k, pivot);
        let row = a[k];
        for (i, other) in a.iter_mut().enumerate() {
            if i != k {
                let factor = other[k] / row[k];
                other.iter_mut().zip(&row).for_each(|(x, y)| *x -= factor * y);
            }
        }
    }
    let q: Vec<f64> = (0..4).map(|k| a[k][4] / a[k][k]).collect();
    let w = &machine.stops()[0].direction;
    (w[0] * q[0] + w[1] * q[1]).hypot(w[0] * q[2] + w[1] * q[3])
}

/// Along curves of loss of contact, of rigid and of compliant stops, the gap is the amplitude of the motion without contact.
#[test]
fn loss_of_contact_in_closed_form() {
    let mut random = sequence();
    let machines: Vec<Machine> = (0..4).map(|case| random_machine(case, &mut random)).collect();
    let mut compared = 0;
    for machine in [&machines[0], &machines[1], &machines[3]] {
        let found = cycle(machine, &events::Start::default());
        let (family, value) = Family::of_path(machine, "frequency").unwrap();
        let all = events((&family, value), &found, 0.35..=1.7, Direction::Up);
        let loss = |point: &&SolutionPoint| matches!(point.event, Some(BranchEvent::LossOfContact { .. }));
        let event = all.iter().find(loss).unwrap();
        let paths = ("stop.stop.gap", "frequency");
        let plane = Plane::of_paths(machine, paths, (0.2..=2.0, 0.3..=1.8)).unwrap();
        let gap = machine.number("stop.stop.gap").unwrap();
        for point in whole(machine::Curve::through(&plane, (gap, event.value), event, OPTIONS).unwrap()) {
            let (gap, frequency) = point.values;
            assert!((gap - amplitude(machine, frequency)).abs() < 1e-9, "{:?}", point.values);
            assert_eq!((point.cycle.label.to_string().as_str(), point.touch.is_some()), ("0", true));
            compared += 1;
        }
    }
    assert!(compared > 150, "{compared}");
}

/// A curve of torus bifurcations of a compliant stop: at the edges of a frame are the torus bifurcations of branches there.
#[test]
fn torus_bifurcations() {
    let mut random = sequence();
    let machine = (0..14).map(|case| random_machine(case, &mut random)).last().unwrap();
    let found = cycle(&machine, &events::Start::default());
    let (family, value) = Family::of_path(&machine, "frequency").unwrap();
    let all = events((&family, value), &found, 0.35..=1.8, Direction::Up);
    let event = all.iter().find(|point| point.event == Some(BranchEvent::Torus)).unwrap();
    let gap = machine.number("stop.stop.gap").unwrap();
    let ranges = (gap - 0.01..=gap + 0.01, 0.35..=1.8);
    let plane = Plane::of_paths(&machine, ("stop.stop.gap", "frequency"), ranges).unwrap();
    let points = whole(machine::Curve::through(&plane, (gap, event.value), event, OPTIONS).unwrap());
    for point in &points {
        let pair = point.cycle.multipliers[0];
        assert!((pair.modulus() - 1.0).abs() < 1e-9 && pair.im > 0.1 && point.residual < 1e-9, "{pair:?}");
    }
    for end in [&points[0], &points[points.len() - 1]] {
        assert_eq!(end.event, Some(CurveEvent::EndOfBox));
        let there = machine.with("stop.stop.gap", end.values.0).unwrap();
        let found = cycle(&there, &events::Start::default());
        let (family, value) = Family::of_path(&there, "frequency").unwrap();
        let torus = events((&family, value), &found, 0.35..=1.8, Direction::Up)
            .into_iter()
            .filter(|point| point.event == Some(BranchEvent::Torus));
        let nearest = torus.map(|point| (point.value - end.values.1).abs()).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-9, "{:?} {nearest}", end.values);
    }
    // to its ends: strong resonances
    let plane = Plane::of_paths(&machine, ("stop.stop.gap", "frequency"), (0.0..=2.0, 0.35..=1.8)).unwrap();
    let points = whole(machine::Curve::through(&plane, (gap, event.value), event, OPTIONS).unwrap());
    let mut ends = [points[0].event.unwrap(), points[points.len() - 1].event.unwrap()].map(|event| event.name());
    ends.sort_unstable();
    assert_eq!(ends, ["1:1", "1:2"]);
}

/// Two equal masses side by side, driven alike, each with a stop: at equal gaps they strike at the same time.
#[test]
fn corners() {
    let parts = MachineParts::new(["a", "b"])
        .with_mass(0, 1.0)
        .with_mass(1, 1.0)
        .with_link(&[1.0, 0.0], 1.0, 0.2)
        .with_link(&[0.0, 1.0], 1.0, 0.2)
        .with_link(&[1.0, -1.0], 0.2, 0.02)
        .with_frequency(1.1)
        .with_force(0, 1, 0.0, 1.0)
        .with_force(1, 1, 0.0, 1.0)
        .with_rigid_stop("one", &[1.0, 0.0], 0.3, 0.6)
        .with_rigid_stop("two", &[0.0, 1.0], 0.4, 0.6);
    let machine = Machine::new(parts).unwrap();
    let found = cycle(&machine, &events::Start::default());
    let (family, value) = Family::of_path(&machine, "stop.one.gap").unwrap();
    let all = events((&family, value), &found, 0.3..=0.6, Direction::Up);
    let event = all.iter().find(|point| matches!(point.event, Some(BranchEvent::Corner { .. }))).unwrap();
    assert!((event.value - 0.4).abs() < 1e-9, "{all:?}");
    let plane = Plane::of_paths(&machine, ("stop.one.gap", "stop.two.gap"), (0.1..=0.8, 0.1..=0.8)).unwrap();
    let points = whole(machine::Curve::through(&plane, (event.value, 0.4), event, OPTIONS).unwrap());
    let (mut low, mut high) = (1.0_f64, 0.0_f64);
    for point in &points {
        let (p, q) = point.values;
        assert!(
            (p - q).abs() < 1e-9 && point.cycle.label.to_string() == "2/1",
            "{:?} {}",
            point.values,
            point.cycle.label
        );
        (low, high) = (low.min(p), high.max(p));
    }
    assert!(points.len() > 20 && (low - 0.1).abs().max((high - 0.8).abs()) < 1e-12, "{} {low} {high}", points.len());
    // at a corner of the frame one of both numbers is exactly that of its edge
    for end in [0.1, 0.8] {
        assert!(points.iter().any(|point| point.values.0 == end || point.values.1 == end), "{end}");
    }
}

/// Between the grazing of 1/1 and the fold of 2/1 two orbits 2/1 exist, and the unstable one lies on the branch between both.
#[test]
fn the_unstable_orbit_between_two_stable_ones_is_found() {
    let machine = hammer(1.06, 0.5).unwrap();
    let starts = (0..48).map(|k| scattered_machine_starts(&machine, 1, k));
    let found = find_machine_while(&machine, Label::new(2, 1), starts, &|| true).unwrap();
    assert_eq!(found.iter().map(Cycle::stable).collect::<Vec<_>>(), [false, true]);
    let begin = cycle(&hammer(1.2, 0.5).unwrap(), &events::Start::default());
    let family = Family::new(|frequency| hammer(frequency, 0.5));
    let options = BranchOptions::default();
    let branch = machine::Branch::new((&family, 1.2), &begin, &(0.95..=1.2), Direction::Down, options).unwrap();
    let points: Vec<SolutionPoint> = branch.collect();
    let sides: Vec<(f64, f64)> = points
        .windows(2)
        .filter(|pair| pair[0].cycle.label == Label::new(2, 1) && (pair[0].value - 1.06) * (pair[1].value - 1.06) < 0.0)
        .map(|pair| (pair[0].cycle.fastest(), pair[1].cycle.fastest()))
        .collect();
    assert_eq!(sides.len(), 2);
    for ((one, two), cycle) in sides.iter().zip(&found) {
        let speed = cycle.fastest();
        assert!(one.min(*two) < speed && speed < one.max(*two), "{one} {two} {speed}");
    }
}

/// As many points as are asked for.
#[test]
fn the_number_of_points() {
    let begin = cycle(&hammer(1.2, 0.5).unwrap(), &events::Start::default());
    let family = Family::new(|frequency| hammer(frequency, 0.5));
    let options = BranchOptions { points: 5, ..BranchOptions::default() };
    let branch = machine::Branch::new((&family, 1.2), &begin, &(0.8..=1.2), Direction::Down, options).unwrap();
    let points: Vec<SolutionPoint> = branch.collect();
    assert_eq!((points.len(), points[4].event), (5, Some(BranchEvent::StepLimit)));
    let all = events((&family, 1.2), &begin, 1.0..=1.2, Direction::Down);
    let plane = Plane::new(hammer, (0.7..=1.4, 0.3..=0.7));
    let limited = CurveOptions { points: 7, ..OPTIONS };
    for curve in machine::Curve::through(&plane, (all[0].value, 0.5), &all[0], limited).unwrap() {
        let points: Vec<CurvePoint> = curve.collect();
        assert_eq!((points.len(), points[6].event), (7, Some(CurveEvent::StepLimit)));
    }
}

/// Two equal masses whose stops, rigid or compliant, close together, one with another gap.
fn equal_pair(rigid: bool, frequency: f64, gap: f64) -> Option<Machine> {
    let mut parts = MachineParts::new(["a", "b"]).with_frequency(frequency);
    for (k, (along, gap)) in [([1.0, 0.0], gap), ([0.0, 1.0], 0.2)].into_iter().enumerate() {
        parts = parts.with_mass(k, 1.0).with_link(&along, 1.0, 0.1).with_force(k, 1, 0.0, 1.0);
        let compliant = StopLaw::Compliant { stiffness: 20.0, damping: 0.5, preload: 0.0, opening: Opening::default() };
        let law = if rigid { StopLaw::Rigid { restitution: 0.5 } } else { compliant };
        parts = parts.with_stop(&format!("s{k}"), &along, gap, law);
    }
    Machine::new(parts).ok()
}

/// A curve over a number of one of two equal parts ends where their stops do not close together any more, on both sides: it was a
/// `touch` on one side.
#[test]
fn stops_that_closed_together_close_one_after_another() {
    for rigid in [true, false] {
        let machine = equal_pair(rigid, 1.5, 0.2).unwrap();
        let found = cycle(&machine, &events::Start::default());
        let family = Family::new(move |frequency| equal_pair(rigid, frequency, 0.2));
        let all = events((&family, 1.5), &found, 1.5..=2.5, Direction::Up);
        let event = all.iter().find(|point| point.event.is_some_and(|event| event.name() == "flip")).unwrap();
        let plane = Plane::new(move |frequency, gap| equal_pair(rigid, frequency, gap), (1.0..=4.0, 0.05..=1.0));
        let points = whole(machine::Curve::through(&plane, (event.value, 0.2), event, OPTIONS).unwrap());
        let ends = [points[0].event.unwrap(), points[points.len() - 1].event.unwrap()];
        for end in ends {
            assert!(matches!(end, CurveEvent::Corner { .. }), "{rigid} {ends:?}");
            let (first, second) = (end.place().unwrap(), end.also().unwrap());
            assert_eq!(first + second, 1, "{ends:?}");
        }
    }
}

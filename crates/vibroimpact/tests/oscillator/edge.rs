//! The border between the starts of two motions, and the saddle on it.

use vibroimpact::edge::{EdgeError, EdgeOptions, edge};
use vibroimpact::events;
use vibroimpact::machine::{Machine, MachineParts};
use vibroimpact::verdict::{SettleOptions, Verdict, settle};
use vibroimpact::{Start, scenario};

/// The starts at x = 0 nearest to rest that lead to 1/1 and to 2/1.
fn starts() -> [Start; 2] {
    let osc = scenario::S.oscillator();
    ["1/1", "2/1"].map(|label| {
        let start = |k: i32| Start { x: 0.0, v: 0.05 * f64::from(k), phase: 0.0 };
        let leads = |start: &Start| settle(&osc, *start, &SettleOptions::default()).verdict.label() == label;
        (0..40).flat_map(|k| [start(k), start(-k)]).find(leads).unwrap()
    })
}

#[test]
fn the_saddle_lies_between_both_motions() {
    let osc = scenario::S.oscillator();
    let found = edge(&osc, &starts(), &EdgeOptions::default()).unwrap();
    let Some(Verdict::Periodic(saddle)) = found.saddle.clone() else { panic!("a saddle") };
    assert!(!saddle.stable() && saddle.residual < 1e-11, "{saddle:?}");
    let labels = found.sides.each_ref().map(Verdict::label);
    assert_ne!(labels[0], labels[1]);
    // a little faster and a little slower than on the saddle: the motions on both sides
    let beside = [1.0 - 1e-6, 1.0 + 1e-6].map(|part| {
        let mut impact = saddle.points[0].state;
        impact.velocity *= part;
        let start = Start { x: osc.gap(), v: -0.5 * impact.velocity, phase: impact.phase };
        settle(&osc, start, &SettleOptions::default()).verdict
    });
    let reached = |side: &Verdict| beside.iter().any(|of| of.same_as(side, 1e-6));
    assert!(found.sides.iter().all(reached), "{labels:?} {:?}", beside.each_ref().map(Verdict::label));
}

#[test]
fn the_pair_stays_on_both_sides_of_the_border() {
    let osc = scenario::S.oscillator();
    let options = EdgeOptions { laps: 12, ..EdgeOptions::default() };
    let found = edge(&osc, &starts(), &options).unwrap();
    for point in &found.track {
        let verdict = settle(&osc, point.state, &options.settle).verdict;
        assert!(verdict.same_as(&found.sides[0], 1e-6) && point.apart < 1e-5, "{point:?}");
    }
}

#[test]
fn starts_without_a_border_are_refused() {
    let osc = scenario::S.oscillator();
    let same = edge(&osc, &[starts()[0]; 2], &EdgeOptions::default());
    assert!(matches!(same, Err(EdgeError::SameMotion(_))), "{same:?}");
    let other = Start { phase: 1.0, ..starts()[1] };
    assert!(matches!(edge(&osc, &[starts()[0], other], &EdgeOptions::default()), Err(EdgeError::Phases(..))));
}

/// The oscillator of point S as a machine beside a body that nothing moves, so that it is followed as a machine.
fn machine() -> Machine {
    let osc = scenario::S.oscillator();
    let parts = MachineParts::new(["mass", "other"])
        .with_mass(0, 1.0)
        .with_mass(1, 1.0)
        .with_link(&[1.0, 0.0], 1.0, 0.0)
        .with_link(&[0.0, 1.0], 3.0, 0.2)
        .with_frequency(osc.beta())
        .with_force(0, 1, 0.0, 1.0)
        .with_rigid_stop("stop", &[1.0, 0.0], osc.gap(), 0.5);
    Machine::new(parts).unwrap()
}

#[test]
fn the_saddle_of_a_machine_is_that_of_the_oscillator() {
    let osc = scenario::S.oscillator();
    let starts = starts();
    let own = edge(&osc, &starts, &EdgeOptions::default()).unwrap();
    let starts = starts.map(|start| events::Start {
        q: vec![start.x, 0.0],
        qdot: vec![start.v, 0.0],
        ..events::Start::default()
    });
    let found = edge(&machine(), &starts, &EdgeOptions::default()).unwrap();
    assert!((own.part - found.part).abs() < 1e-8, "{starts:?} {} {}", own.part, found.part);
    let (Some(Verdict::Periodic(own)), Some(Verdict::Periodic(found))) = (own.saddle, found.saddle) else {
        panic!("saddles")
    };
    assert_eq!(own.label, found.label);
    assert!((own.fastest() - found.fastest()).abs() < 1e-10);
    assert!((own.multipliers[0].re - found.multipliers[0].re).abs() < 1e-8, "{own:?} {found:?}");
}

//! What numbers of 53 bits cannot know about a motion that comes to rest: how many periods pass until the next rest.

use vibroimpact::events::Start;
use vibroimpact::machine::{HarmonicMotion, Machine, MachineParts};
use vibroimpact::orbit::{Count, Label, find_machine_while};
use vibroimpact::verdict::{SettleOptions, Undecided, UndecidedCause, Verdict, settle_machine};

fn ball(amplitude: f64, restitution: f64) -> Machine {
    let mut parts = MachineParts::new(["ball"])
        .with_mass(0, 1.0)
        .with_frequency(1.0)
        .with_constant(0, -1.0)
        .with_rigid_stop("table", &[-1.0], 0.0, restitution);
    parts.stops[0].motion.push(HarmonicMotion { order: 1, cos: 0.0, sin: amplitude });
    Machine::new(parts).unwrap()
}

fn settled(machine: &Machine, q: f64, qdot: f64) -> Verdict<Machine> {
    let start = Start { q: vec![q], qdot: vec![qdot], phase: 0.0, ..Start::default() };
    settle_machine(machine, &start, &SettleOptions::default()).unwrap().verdict
}

/// 1. With 60 digits these are inf/38 and inf/122, and a change of 1e-16 at the release gives 29 or 49, and 84, 175 or 98 periods.
#[test]
fn long_ways_from_a_release_to_a_rest() {
    for amplitude in [1.72, 5.0] {
        let verdict = settled(&ball(amplitude, 0.5), 3.0, 1.0);
        let Verdict::Undecided(Undecided { why, .. }) = verdict else { panic!("{amplitude}: {}", verdict.label()) };
        assert_eq!(why, UndecidedCause::Unconfirmed, "{amplitude}");
        // whatever the start
        for (q, qdot) in [(7.0, 0.0), (5.5, -0.3)] {
            let verdict = settled(&ball(amplitude, 0.5), q, qdot);
            assert!(!matches!(verdict, Verdict::Periodic(_)), "{amplitude} {q}: {}", verdict.label());
        }
    }
}

/// 2. Short ways are known, and so are their cycles.
#[test]
fn short_ways() {
    for (amplitude, restitution, label) in
        [(1.1, 0.5, "inf/1"), (1.3, 0.5, "inf/1"), (1.5, 0.4, "inf/1"), (1.2, 0.3, "inf/1")]
    {
        let verdict = settled(&ball(amplitude, restitution), 3.0, 1.0);
        assert_eq!(verdict.label(), label, "{amplitude} {restitution}");
    }
}

/// 3. No search for orbits returns them either.
#[test]
fn no_orbit_is_found() {
    let machine = ball(1.72, 0.5);
    let start = Start { q: vec![3.0], qdot: vec![1.0], phase: 0.0, ..Start::default() };
    for periods in [29, 30, 38, 49] {
        let label = Label { impacts: Count::Infinite, periods };
        let found = find_machine_while(&machine, label, [start.clone()], &|| true).unwrap();
        assert!(found.is_empty(), "{label}: {}", found.len());
    }
}

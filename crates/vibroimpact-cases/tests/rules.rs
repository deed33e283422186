//! The rules that every motion keeps, on machines of all families.

use vibroimpact::events::{End, EventKind, Limits, Motion, Start};
use vibroimpact_cases::{Budget, Case, DrawnFamily, FAMILIES, faults, rounded};

/// Everyday 10 machines of each family; with `VIBROIMPACT_LONG=1` 60, more than a thousand together.
#[test]
fn motions_keep_all_rules() {
    let count = if std::env::var("VIBROIMPACT_LONG").is_ok() { 60 } else { 10 };
    let mut wrong = Vec::new();
    for family in FAMILIES {
        for seed in 0..count {
            for fault in faults(&family.case(seed), Budget::default()) {
                wrong.push(format!("{} {seed}: {fault}", family.name));
            }
        }
    }
    assert!(wrong.is_empty(), "{}:\n{}", wrong.len(), wrong.join("\n"));
}

/// Machines that have broken a rule once: free bodies that strike each other within 1e-12 of time, impacts at one instant,
/// symmetric rests, a light body that has not moved.
#[test]
fn mended_machines_keep_all_rules() {
    let mended = [
        ("columns", [170, 371, 579, 724]),
        ("chains", [99, 189, 603, 606]),
        ("plates", [0, 1, 432, 649]),
        ("beads", [0, 1, 342, 739]),
        ("light", [0, 1, 2, 64]),
    ];
    for (name, seeds) in mended {
        let family = FAMILIES.iter().find(|family| family.name == name).unwrap();
        for seed in seeds {
            let found = faults(&family.case(seed), Budget::default());
            assert!(found.is_empty(), "{name} {seed}: {}", found[0]);
        }
    }
}

/// The motions of a case with these rounding errors end after few events.
fn come_to_an_end(case: &Case, roundings: impl IntoIterator<Item = u64>) {
    for seed in roundings {
        let (machine, start) = rounded(case, seed);
        let mut motion = Motion::new(&machine, &start, Limits::default()).expect("a motion");
        let events = motion.by_ref().take(10_000).count();
        assert_eq!(motion.end(), Some(End::Never), "{seed}: {events} events");
    }
}

/// Equal bodies on soft contacts that decay together: what they do to each other ends as rounding errors, not at the limit of the
/// search.
#[test]
fn soft_cradles_come_to_an_end() {
    // of the last one a contact closed as the third power of the time, and 200000 windows did not tell it from a touch
    come_to_an_end(&DrawnFamily::named("cradles").unwrap().case(5), [39, 42, 49, 52, 53, 57]);
}

/// A chain of equal bodies that touch, which swing against each other ever more gently. Its motions end whatever rounding errors are
/// added: to put a body exactly on a stop once moved others off the stops on which they rested, and the flight after that ended at
/// the same stop again and again, without an event.
#[test]
fn chains_that_touch_come_to_an_end() {
    come_to_an_end(&DrawnFamily::named("chains").unwrap().case(50), 0..60);
}

/// Nothing loads this chain, so its motion in any scale is the same: slow impacts come when they come to bodies a million times as
/// fast. While bodies moved on their places were taken for rounding errors, and five impacts of a period happened at one time.
#[test]
fn slow_impacts_come_as_fast_ones() {
    const SCALE: f64 = (1_u64 << 24) as f64;
    let case = DrawnFamily::named("chains").unwrap().case(50);
    let of =
        |start: &Start| -> Vec<_> { Motion::new(&case.machine, start, Limits::default()).unwrap().take(62).collect() };
    let all = of(&case.start);
    let begin = all.iter().position(|event| event.time > 4.5 && event.kind == EventKind::Impact).unwrap();
    let scaled = |of: &[f64]| of.iter().map(|value| SCALE * value).collect();
    let again = of(&Start { q: scaled(&all[begin].q), qdot: scaled(&all[begin].qdot), ..Start::default() });
    assert_eq!(all.len() - begin, 36);
    for (late, fast) in all[begin + 1..].iter().zip(&again) {
        let (time, speed) = (late.time - all[begin].time, late.speed * SCALE);
        assert!((time - fast.time).abs() < 1e-4 * fast.time, "{} {time} {}", late.speed, fast.time);
        assert!((speed - fast.speed).abs() < 2e-2 * fast.speed, "{} {speed} {}", late.speed, fast.speed);
    }
}

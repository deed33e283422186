//! The families draw what they promise: valid machines and starts, and maps of them onto themselves.
#![allow(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::collections::BTreeSet;
use vibroimpact::events::{Limits, Motion};
use vibroimpact_cases::{Case, FAMILIES, Symmetry};

fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// A map of a machine onto itself: matrices, forces and stops become each other.
fn is_symmetry(case: &Case, symmetry: &Symmetry) -> bool {
    let parts = case.machine.parts();
    let n = parts.n();
    let same = |a: f64, b: f64| (a - b).abs() <= 1e-13 * (1.0 + a.abs());
    let matrices = [&parts.mass, &parts.damping, &parts.stiffness].iter().all(|matrix| {
        let image =
            |i: usize, j: usize| symmetry.signs[i] * symmetry.signs[j] * matrix[(symmetry.from[i], symmetry.from[j])];
        (0..n).all(|i| (0..n).all(|j| same(matrix[(i, j)], image(i, j))))
    });
    let vectors = parts.forces.iter().flat_map(|force| [&force.cos, &force.sin]).chain([&parts.constant]);
    let start = [&case.start.q, &case.start.qdot].into_iter().filter(|vector| !vector.is_empty());
    let vectors = vectors.chain(start).all(|vector| apart(vector, &symmetry.image(vector)) < 1e-13);
    let stops = parts.stops.iter().enumerate().all(|(j, stop)| {
        let image = &parts.stops[symmetry.places[j]];
        apart(&image.direction, &symmetry.image(&stop.direction)) < 1e-13
            && (image.gap, image.law, &image.motion) == (stop.gap, stop.law, &stop.motion)
    });
    matrices && vectors && stops && parts.joints.is_empty()
}

#[test]
fn machines_starts_and_symmetries_are_valid() {
    let names: BTreeSet<&str> = FAMILIES.iter().map(|family| family.name).collect();
    assert_eq!(names.len(), FAMILIES.len());
    let (mut symmetric, mut equal, mut same, mut rigid) = (0, 0, 0, 0);
    for family in FAMILIES {
        for seed in 0..300 {
            let case = family.case(seed);
            let motion = Motion::new(&case.machine, &case.start, Limits::default());
            assert!(motion.is_ok(), "{} {seed}: {:?}", family.name, motion.err());
            for symmetry in &case.symmetries {
                assert!(is_symmetry(&case, symmetry), "{} {seed}: {symmetry:?} {:#?}", family.name, case.machine);
            }
            symmetric += usize::from(!case.symmetries.is_empty());
            equal += usize::from(!case.equal.is_empty());
            same += usize::from(case.same_as.is_some());
            rigid += usize::from(case.has_rigid_stop());
        }
    }
    assert!(symmetric > 2000 && equal > 300 && same > 200, "{symmetric} {equal} {same}");
    assert!((100..300 * FAMILIES.len() - 500).contains(&rigid), "{rigid}");
}

//! Oscillators as text: the value of each parameter by its name in plans.

use crate::values::{damping, gap, odd, plain, ratio, restitution, typed};
use proptest::prelude::*;

/// Parameters and their values as text.
pub type SystemValues = Vec<(&'static str, String)>;

/// An oscillator. One of twelve lacks a parameter or has an invalid value.
pub(crate) fn system() -> BoxedStrategy<SystemValues> {
    let second = prop::option::weighted(0.15, (second_gap(), prop::option::weighted(0.4, restitution())));
    let fault = prop::option::weighted(0.08, (0..4_usize, prop::option::of(odd())));
    (any::<bool>(), ratio(), restitution(), prop::option::weighted(0.3, damping()), second, fault)
        .prop_flat_map(|(inverse, beta, eps, zeta, second, fault)| {
            let given: f64 = beta.parse().unwrap_or(1.0);
            let ratio = if inverse { 1.0 / given } else { given };
            (Just((inverse, beta, eps, zeta, second, fault)), gap(ratio))
        })
        .prop_map(|((inverse, beta, eps, zeta, second, fault), gap)| {
            let name = if inverse { "inverse_beta" } else { "beta" };
            let mut values = vec![(name, beta), ("gap", gap), ("restitution", eps)];
            values.extend(zeta.map(|zeta| ("damping", zeta)));
            if let Some((gap, eps)) = second {
                values.push(("second_gap", gap));
                values.extend(eps.map(|eps| ("second_restitution", eps)));
            }
            if let Some((place, odd)) = fault {
                let place = place % values.len();
                match odd {
                    Some(odd) => values[place].1 = odd,
                    None => drop(values.remove(place)),
                }
            }
            values
        })
        .boxed()
}

fn second_gap() -> crate::values::ProptestText {
    prop_oneof![6 => (0.0..4.0_f64).prop_map(typed), 1 => plain()].boxed()
}

/// A start: `x`, `v` and `phase`, each of them optional.
pub(crate) fn start() -> BoxedStrategy<SystemValues> {
    let x = prop_oneof![6 => (-6.0..1.0_f64).prop_map(typed), 1 => plain()];
    let phase = prop_oneof![
        5 => (0.0..core::f64::consts::TAU).prop_map(typed),
        1 => prop::sample::select(vec!["6.283185307179586", "-1e-17", "4.71238898038469", "1e15", "1e18", "1e300"]).prop_map(str::to_owned),
        1 => crate::values::number(),
    ];
    let v = prop_oneof![6 => (-6.0..6.0_f64).prop_map(typed), 1 => crate::values::number()];
    (prop::option::weighted(0.5, x), prop::option::weighted(0.6, v), prop::option::weighted(0.5, phase))
        .prop_map(|(x, v, phase)| {
            let given = [("x", x), ("v", v), ("phase", phase)];
            given.into_iter().filter_map(|(name, value)| Some((name, value?))).collect()
        })
        .boxed()
}

/// A parameter with a range of valid values.
pub(crate) fn parameter() -> BoxedStrategy<(&'static str, f64, f64)> {
    prop::sample::select(vec![
        ("inverse_beta", 0.4, 2.0),
        ("beta", 0.4, 2.0),
        ("gap", -0.9, 3.0),
        ("restitution", 0.0, 1.0),
        ("damping", 0.0, 0.4),
        ("second_gap", 0.1, 2.0),
        ("second_restitution", 0.0, 1.0),
    ])
    .boxed()
}

/// The system without the parameters that vary, so that none is given twice.
pub(crate) fn without(values: SystemValues, varied: &[&str]) -> SystemValues {
    let frequency = |name: &str| matches!(name, "beta" | "inverse_beta");
    let same = |a: &str, b: &str| a == b || frequency(a) && frequency(b);
    let mut left: SystemValues =
        values.into_iter().filter(|(name, _)| !varied.iter().any(|other| same(name, other))).collect();
    // the restitution of a second stop is invalid without a second stop
    let second =
        |values: &SystemValues| values.iter().any(|(name, _)| *name == "second_gap") || varied.contains(&"second_gap");
    if varied.contains(&"second_restitution") && !second(&left) {
        left.push(("second_gap", "1".to_owned()));
    }
    left
}

//! The expansion of a machine, written as TOML and as JSON, reads as the same machine to the last bit.

use proptest::prelude::*;
use vibroimpact::machine::{
    FrictionJoint, HarmonicForce, HarmonicMotion, Machine, MachineParts, Opening, Stop, StopLaw,
};
use vibroimpact::math::Matrix;
use vibroimpact_study::machine::{MachineSource, no_files};

/// Numbers with all their bits, and zeros of both signs.
fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        3 => -1e3..1e3,
        1 => Just(0.0),
        1 => Just(-0.0),
        1 => prop::num::f64::NORMAL.prop_map(|x| x % 1e30),
        1 => prop::num::f64::SUBNORMAL,
        1 => (-5i32..5).prop_map(f64::from),
    ]
}

fn positive() -> impl Strategy<Value = f64> {
    number().prop_map(f64::abs)
}

fn vector(n: usize) -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(number(), n)
}

fn direction(n: usize) -> impl Strategy<Value = Vec<f64>> {
    vector(n).prop_map(|mut vector| {
        if vector.iter().all(|value| *value == 0.0) {
            vector[0] = 1.0;
        }
        vector
    })
}

/// A diagonally dominant matrix; sometimes diagonal, with a zero of the other sign beside the diagonal, or zero.
fn matrix(n: usize, least: f64) -> impl Strategy<Value = Matrix> {
    (prop::collection::vec(-1.0..1.0, n * n), prop::collection::vec(0.0..10.0, n), 0..4).prop_map(
        move |(inside, diagonal, kind)| {
            let mut matrix = Matrix::zeros(n, n);
            for i in 0..n {
                matrix[(i, i)] = if kind == 3 { least } else { diagonal[i] + n as f64 };
                for j in 0..i {
                    let value = match kind {
                        0 => inside[i * n + j],
                        1 => -0.0,
                        _ => 0.0,
                    };
                    (matrix[(i, j)], matrix[(j, i)]) = (value, value);
                }
            }
            matrix
        },
    )
}

fn law() -> impl Strategy<Value = StopLaw> {
    prop_oneof![
        (0.0..=1.0).prop_map(|restitution| StopLaw::Rigid { restitution }),
        (1e-3..1e6, positive(), positive(), any::<bool>()).prop_map(|(stiffness, damping, preload, force)| {
            let opening = if force { Opening::Force } else { Opening::Position };
            StopLaw::Compliant { stiffness, damping, preload, opening }
        }),
    ]
}

fn motion() -> impl Strategy<Value = Vec<HarmonicMotion>> {
    prop::collection::vec((number(), number()), 0..3).prop_map(|all| {
        let orders = [2, 1, 7];
        all.into_iter().zip(orders).map(|((cos, sin), order)| HarmonicMotion { order, cos, sin }).collect()
    })
}

fn machine() -> impl Strategy<Value = Machine> {
    (1usize..5).prop_flat_map(|n| {
        let structure = (matrix(n, 1.0), matrix(n, 0.0), matrix(n, 0.0), vector(n), 1e-3..1e3);
        let forces = prop::collection::vec((vector(n), vector(n)), 0..3);
        let stops = prop::collection::vec((direction(n), number(), motion(), law()), 0..4);
        let joints = prop::collection::vec((direction(n), positive(), positive(), number()), 0..3);
        (structure, forces, stops, joints).prop_filter_map(
            "two rigid stops without room",
            |((mass, damping, stiffness, constant, frequency), forces, stops, joints)| {
                let n = constant.len();
                let forces = forces.into_iter().zip([1, 3, 2]);
                let named = |kind: &str, k: usize| format!("{kind}-{k}");
                let parts = MachineParts {
                    coordinates: (0..n).map(|k| named("q", k)).collect(),
                    mass,
                    damping,
                    stiffness,
                    constant,
                    impacts: vibroimpact::machine::ImpactLaw::Together,
                    frequency: Some(frequency),
                    forces: forces.map(|((cos, sin), order)| HarmonicForce { order, cos, sin }).collect(),
                    stops: (stops.into_iter().enumerate())
                        .map(|(k, (direction, gap, motion, law))| Stop {
                            name: named("stop", k),
                            direction,
                            gap,
                            motion,
                            law,
                        })
                        .collect(),
                    joints: (joints.into_iter().enumerate())
                        .map(|(k, (direction, sliding, more, belt))| FrictionJoint {
                            name: named("joint", k),
                            direction,
                            sliding,
                            limit: sliding + more,
                            belt,
                        })
                        .collect(),
                };
                Machine::new(parts).ok()
            },
        )
    })
}

/// All numbers with their signs of zero: equality does not tell 0 from -0.
fn bits(machine: &Machine) -> String {
    format!("{:?}", machine.parts())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_expansion_reads_as_the_same_machine(machine in machine()) {
        let source = MachineSource::from(&machine);
        let toml = source.to_toml();
        let read = MachineSource::from_text(&toml, no_files).unwrap();
        prop_assert_eq!(&read, &source);
        prop_assert_eq!(bits(&read.machine().unwrap()), bits(&machine), "{}", toml);
        prop_assert_eq!(read.expansion().unwrap(), source.clone());
        let json = serde_json::to_string(&source).unwrap();
        let read = MachineSource::from_text(&json, no_files).unwrap();
        prop_assert_eq!(bits(&read.machine().unwrap()), bits(&machine), "{}", json);
    }

    /// Each number of the expansion, and each that is written, can be read and set.
    #[test]
    fn every_path_reads_and_writes(machine in machine()) {
        let source = MachineSource::from(&machine);
        for path in source.paths().unwrap() {
            prop_assert_eq!(source.number(&path).unwrap().to_bits(), machine.number(&path).unwrap().to_bits());
            let other = source.with(&path, 0.625).unwrap();
            prop_assert_eq!(other.number(&path).unwrap(), 0.625, "{}", path);
            prop_assert_eq!(other.parts().unwrap().number(&path).unwrap(), 0.625, "{}", path);
        }
    }
}

//! Branches of machines through events at which the motion is not smooth, against simulation beside them.

use vibroimpact::continuation::{BranchOptions, Direction, MachineBranch, MachineBranchEvent, MachineFamily, MachinePoint};
use vibroimpact::events::MachineStart;
use vibroimpact::machine::{Machine, MachineParts, Opening, StopLaw};
use vibroimpact::math::Matrix;
use vibroimpact::orbit::MachineCycle;
use vibroimpact::verdict::{MachineVerdict, SettleOptions, settle_machine};

fn settled(machine: &Machine, start: &MachineStart) -> Option<MachineCycle> {
    match settle_machine(machine, start, &SettleOptions::default()).unwrap().verdict {
        MachineVerdict::Periodic(cycle) => Some(cycle),
        _ => None,
    }
}

fn traced(
    (machine, path): (&Machine, &str),
    cycle: &MachineCycle,
    range: (f64, f64),
    direction: Direction,
) -> Vec<MachinePoint> {
    let (family, value) = MachineFamily::of_path(machine, path).unwrap();
    let options = BranchOptions { points: 400, ..BranchOptions::default() };
    MachineBranch::new((&family, value), cycle, &(range.0..=range.1), direction, options).unwrap().collect()
}

/// The events of a branch.
fn events(points: &[MachinePoint]) -> Vec<(MachineBranchEvent, f64)> {
    points.iter().filter_map(|point| Some((point.event?, point.value))).collect()
}

/// Beside all events, at stable points, motions that begin close to the cycle settle into it. Returns how many were compared.
fn agrees_with_simulation((machine, path): (&Machine, &str), points: &[MachinePoint]) -> usize {
    let mut compared = 0;
    for (k, point) in points.iter().enumerate().filter(|(_, point)| point.event.is_some()) {
        let others = points[..k].iter().rev().take(6).chain(points[k + 1..].iter().take(6));
        for other in others.filter(|other| other.event.is_none() && (other.value - point.value).abs() > 1e-6) {
            // a multiplier is without limit at a grazing contact, so the cycle attracts little of its neighbourhood
            let near = points.iter().any(|event| event.event.is_some() && (event.value - other.value).abs() < 1e-6);
            if near || other.cycle.multipliers[0].modulus() > 0.9 {
                continue;
            }
            let there = machine.with(path, other.value).unwrap();
            let cycle = settled(&there, &other.cycle.state).unwrap();
            assert_eq!(cycle.label, other.cycle.label, "{path} {} beside {:?}", other.value, point.event);
            compared += 1;
        }
    }
    compared
}

/// Two masses, coupled by their inertia too, one on a joint whose static limit exceeds its sliding force.
fn with_static_friction(mass: f64) -> (Machine, MachineStart) {
    let pair = |a: f64, b: f64, c: f64| {
        let mut matrix = Matrix::zeros(2, 2);
        for (i, j, value) in [(0, 0, a), (0, 1, b), (1, 0, b), (1, 1, c)] {
            matrix[(i, j)] = value;
        }
        matrix
    };
    let law = StopLaw::Compliant { stiffness: 92.04, damping: 5.0, preload: 0.1, opening: Opening::Force };
    let mut parts = MachineParts::new(["x1", "x2"]);
    parts.mass = pair(mass, 0.4576, 1.521);
    parts.stiffness = pair(1.056, -0.5364, 0.5364);
    parts.damping = pair(0.0701, -0.01973, 0.01973);
    parts.constant = vec![-0.1162, -0.0942];
    let parts = parts
        .with_frequency(0.5291)
        .with_force(0, 1, -0.3813, -0.836)
        .with_force(0, 2, -0.1056, -0.8552)
        .with_rigid_stop("s0", &[1.0, -1.0], 0.0, 0.7199)
        .with_stop("s1", &[0.0, -1.0], 0.4182, law)
        .with_joint("f0", &[1.0, 0.0], 0.194, 0.291, 0.0);
    let start = MachineStart { q: vec![-0.4459, 0.3194], qdot: vec![-0.6075, 0.2837], phase: 1.938 };
    (Machine::new(parts).unwrap(), start)
}

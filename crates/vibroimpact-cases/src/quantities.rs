//! Gaps, forces and energies of a machine from its numbers alone, without anything that computes its motion.

use vibroimpact::events::Sample;
use vibroimpact::machine::{Machine, Opening, Stop, StopLaw};
use vibroimpact::math::{Matrix, sin_cos};
use vibroimpact::regime::ContactState;

/// The sum of products.
#[must_use]
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The largest absolute value.
#[must_use]
pub(crate) fn largest(vector: &[f64]) -> f64 {
    vector.iter().fold(0.0, |most, value| most.max(value.abs()))
}

/// $`a^T M a`$.
#[must_use]
pub(crate) fn square(matrix: &Matrix, vector: &[f64]) -> f64 {
    dot(&matrix.apply(vector), vector)
}

/// A gap, its rate, and the sizes of the terms of both.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gap {
    pub(crate) value: f64,
    pub(crate) rate: f64,
    pub(crate) size: f64,
}

/// The displacement and the velocity of a stop at a phase of the forcing.
pub(crate) fn surface_of(stop: &Stop, frequency: f64, phase: f64) -> (f64, f64) {
    stop.motion.iter().fold((0.0, 0.0), |(r, rate), motion| {
        let order = f64::from(motion.order);
        let (sin, cos) = sin_cos(order * phase);
        (r + motion.cos * cos + motion.sin * sin, rate + order * frequency * (motion.sin * cos - motion.cos * sin))
    })
}

/// The gap of a stop.
pub(crate) fn gap(machine: &Machine, j: usize, sample: &Sample) -> Gap {
    let stop = &machine.stops()[j];
    let (r, rate) = surface_of(stop, machine.parts().frequency.unwrap_or(0.0), sample.phase);
    let terms: f64 = stop.direction.iter().zip(&sample.q).map(|(w, q)| (w * q).abs()).sum();
    Gap {
        value: stop.gap - dot(&stop.direction, &sample.q) - r,
        rate: -dot(&stop.direction, &sample.qdot) - rate,
        size: stop.gap.abs() + terms + r.abs(),
    }
}

/// The harmonic force on each coordinate.
pub(crate) fn drive(machine: &Machine, phase: f64) -> Vec<f64> {
    let mut force = vec![0.0; machine.n()];
    for harmonic in &machine.parts().forces {
        let (sin, cos) = sin_cos(f64::from(harmonic.order) * phase);
        for (i, force) in force.iter_mut().enumerate() {
            *force += harmonic.cos[i] * cos + harmonic.sin[i] * sin;
        }
    }
    force
}

/// Stiffness, damping, preload and opening of a compliant stop.
pub(crate) const fn compliant(law: &StopLaw) -> Option<(f64, f64, f64, Opening)> {
    match *law {
        StopLaw::Rigid { .. } => None,
        StopLaw::Compliant { stiffness, damping, preload, opening } => Some((stiffness, damping, preload, opening)),
    }
}

/// The force of a closed compliant stop.
pub(crate) fn contact_force(law: &StopLaw, gap: &Gap) -> f64 {
    compliant(law).map_or(0.0, |(k, c, p, _)| p - k * gap.value - c * gap.rate)
}

/// The energy of a compliant stop whose surface is this deep.
pub(crate) fn contact_energy(law: &StopLaw, depth: f64) -> f64 {
    compliant(law).map_or(0.0, |(k, _, p, _)| (0.5 * k * depth + p) * depth)
}

/// The energy of structure and closed stops, and the size of its terms. The velocities are taken relative to `frame`.
pub(crate) fn energy(machine: &Machine, sample: &Sample, frame: f64) -> (f64, f64) {
    let parts = machine.parts();
    let relative: Vec<f64> = sample.qdot.iter().map(|v| v - frame).collect();
    let kinetic = 0.5 * square(&parts.mass, &relative);
    let potential = 0.5 * square(&parts.stiffness, &sample.q);
    let weight: f64 = -dot(&parts.constant, &sample.q);
    let mut contact = 0.0;
    for (j, stop) in parts.stops.iter().enumerate() {
        if sample.states[j] == ContactState::Closed {
            contact += contact_energy(&stop.law, -gap(machine, j, sample).value);
        }
    }
    (kinetic + potential + weight + contact, kinetic + potential + weight.abs() + contact.abs())
}

/// The power of all forces but those of springs and of constant forces: what drives, and what takes energy away.
pub(crate) fn power(machine: &Machine, sample: &Sample) -> f64 {
    let parts = machine.parts();
    let mut power = dot(&drive(machine, sample.phase), &sample.qdot) - square(&parts.damping, &sample.qdot);
    for (j, stop) in parts.stops.iter().enumerate() {
        let (_, rate) = surface_of(stop, parts.frequency.unwrap_or(0.0), sample.phase);
        match sample.states[j] {
            ContactState::Closed => {
                let gap = gap(machine, j, sample);
                let damping = compliant(&stop.law).map_or(0.0, |(_, c, ..)| c);
                power += contact_force(&stop.law, &gap) * rate - damping * gap.rate * gap.rate;
            }
            ContactState::Resting => power += sample.forces[j] * rate,
            _ => {}
        }
    }
    for (k, joint) in parts.joints.iter().enumerate() {
        power -= sample.forces[parts.stops.len() + k] * dot(&joint.direction, &sample.qdot);
    }
    power
}

/// An estimate of the highest frequency of the structure with all its compliant stops closed, and of its forcing: the
/// root of the trace of $`M^{-1}K`$, at most $`\sqrt n`$ too large.
pub(crate) fn fastest(machine: &Machine) -> f64 {
    let parts = machine.parts();
    let Some(factor) = parts.mass.cholesky() else { return 1.0 };
    let solve = |vector: &[f64]| factor.solve_lower_transposed(&factor.solve_lower(vector));
    let trace = |of: &Matrix| (0..machine.n()).map(|j| solve(&of.column(j))[j]).sum::<f64>();
    let (mut stiffness, mut damping) = (trace(&parts.stiffness), trace(&parts.damping));
    for stop in &parts.stops {
        if let Some((k, c, ..)) = compliant(&stop.law) {
            let softness = dot(&stop.direction, &solve(&stop.direction));
            stiffness += k * softness;
            damping += c * softness;
        }
    }
    let orders = parts.forces.iter().map(|force| force.order);
    let orders = orders.chain(parts.stops.iter().flat_map(|stop| stop.motion.iter().map(|motion| motion.order)));
    let forcing = f64::from(orders.max().unwrap_or(0)) * parts.frequency.unwrap_or(0.0);
    stiffness.max(0.0).sqrt().max(damping).max(forcing)
}

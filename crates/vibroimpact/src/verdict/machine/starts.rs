//! Starts of a machine, spread evenly over a box that its motions fill.

use super::super::attractors::{SAME, mix};
use crate::events::{Limits, Motion, Start};
use crate::machine::{Machine, StopLaw};
use crate::math::{add_scaled, dot};
use crate::regime::Normal;
use core::f64::consts::TAU;

/// The sizes of coordinates and velocities of the box: for each coordinate the largest of the static deflection under all
/// forces, friction among them where a belt moves, the gaps along it and what the forcing moves in a quarter of its period. A belt takes
/// bodies along with its velocity.
fn sizes(machine: &Machine) -> (Vec<f64>, Vec<f64>) {
    let parts = machine.parts();
    let n = machine.n();
    let rate = parts.frequency.unwrap_or(1.0);
    let mut reach = vec![0.0_f64; n];
    // the friction of a joint and the velocity of its belt, along each coordinate
    let belts = || machine.joints().iter().filter(|joint| joint.belt != 0.0);
    let dragged =
        |i: usize| belts().map(|joint| joint.limit.max(joint.sliding) * joint.direction[i].abs()).sum::<f64>();
    let taken = |i: usize| {
        let own = belts().filter(|joint| joint.direction[i] != 0.0);
        own.map(|joint| (joint.belt / joint.direction[i]).abs()).fold(0.0_f64, f64::max)
    };
    for (i, reach) in reach.iter_mut().enumerate() {
        let push: f64 = parts.constant[i].abs()
            + dragged(i)
            + parts.forces.iter().map(|force| force.cos[i].abs() + force.sin[i].abs()).sum::<f64>();
        let spring = parts.stiffness[(i, i)].max(parts.mass[(i, i)] * rate * rate);
        *reach = 2.0 * push / spring.max(f64::MIN_POSITIVE);
    }
    let mut size = 0.0_f64;
    for stop in machine.stops() {
        let largest = stop.direction.iter().fold(0.0_f64, |most, w| most.max(w.abs())).max(f64::MIN_POSITIVE);
        let swing: f64 = stop.motion.iter().map(|motion| motion.cos.abs() + motion.sin.abs()).sum();
        size = size.max((stop.gap.abs() + swing) / largest);
    }
    let most = reach.iter().fold(size, |most, reach| most.max(*reach));
    // coordinates without a force of their own move with the others
    let x: Vec<f64> = reach.iter().map(|reach| reach.max(size).max(0.5 * most).max(SAME)).collect();
    let v = (0..n).map(|i| {
        let own = (parts.stiffness[(i, i)] / parts.mass[(i, i)]).max(0.0).sqrt();
        (x[i] * 0.5 * (own + rate).min(4.0 * rate)).max(2.0 * taken(i))
    });
    let v = v.collect();
    (x, v)
}

/// The start with the index `index` in the sequence of this `seed`.
///
/// The first start is at rest at 0, if this is allowed. The others are points of low discrepancy in a box (the additive
/// recurrence of the generalised golden ratio, shifted by the seed), moved off rigid stops that they would lie beyond. They
/// are the same on every machine.
#[must_use]
#[allow(clippy::cast_precision_loss)] // 53 bits are kept on purpose
pub fn scattered_machine_starts(machine: &Machine, seed: u64, index: u64) -> Start {
    let n = machine.n();
    let mut start = Start { q: vec![0.0; n], qdot: vec![0.0; n], ..Start::default() };
    if index > 0 {
        let (x, v) = sizes(machine);
        let dimensions = 2 * n + 1;
        // g^(d+1) = g + 1
        let mut g = 1.5_f64;
        for _ in 0..60 {
            g = libm::pow(1.0 + g, 1.0 / (dimensions as f64 + 1.0));
        }
        let unit = |k: usize| {
            let shift = mix(seed.wrapping_mul(dimensions as u64).wrapping_add(k as u64 + 1)) >> 11;
            let turn = libm::pow(g, -(k as f64 + 1.0)) * (index + 1) as f64 + shift as f64 / (1_u64 << 53) as f64;
            turn - turn.floor()
        };
        for i in 0..n {
            start.q[i] = x[i] * (2.0 * unit(i) - 1.0);
            start.qdot[i] = v[i] * (2.0 * unit(n + i) - 1.0);
        }
        start.phase = TAU * unit(2 * n);
        if machine.parts().frequency.is_none() {
            start.phase = 0.0;
        }
    }
    cleared(machine, start)
}

/// The start with coordinates moved off rigid stops; at rest at 0 moved alike if they cannot be told.
fn cleared(machine: &Machine, mut start: Start) -> Start {
    let normal = Normal::new(machine);
    let rigid = |j: &usize| matches!(machine.stops()[*j].law, StopLaw::Rigid { .. });
    for _ in 0..100 {
        if Motion::new(machine, &start, Limits::default()).is_ok() {
            return start;
        }
        let mut x = normal.to_normal(&start.q);
        for j in (0..machine.stops().len()).filter(rigid) {
            let w = &normal.directions[j];
            let wall = normal.walls[j].constant;
            let swing: f64 = normal.walls[j].harmonics.iter().map(|(a, b)| a.abs() + b.abs()).sum();
            let beyond = dot(w, &x) - (wall - swing);
            if beyond > 0.0 {
                // to the other side of the stop, as far as it was beyond
                add_scaled(&mut x, -(beyond * 1.5 + 1e-9 * wall.abs()) / dot(w, w), w);
            }
        }
        start.q = normal.to_machine(&x);
    }
    start
}

//! What the equations of branches and of curves share: weights, and residuals with their derivatives by the unknowns of the
//! events.

use crate::events::StateShape;
use crate::machine::Machine;
use crate::orbit::{MachineFrame, MachineRing};
use core::f64::consts::TAU;

/// Adapts the weights of the unknowns of a ring, the first of `w`, to the period: without forcing a change of all times by a
/// part of the period has the same length for each period. Returns whether there is no forcing.
pub(crate) fn weigh(weights: &mut [f64], ring: &MachineRing, w: &[f64]) -> bool {
    if ring.periods > 0 {
        return false;
    }
    #[allow(clippy::cast_precision_loss)] // a few dozen
    let m = ring.len() as f64;
    // the first unknown is the period, with another sign
    let radian = w[0] / TAU;
    let width = weights.len() / ring.len();
    weights.iter_mut().step_by(width).for_each(|weight| *weight = 1.0 / (m * radian * radian));
    true
}

/// The weights of the unknowns of a ring, for the largest coordinates and velocities `sizes`.
pub(crate) fn weights(machine: &Machine, ring: &MachineRing, sizes: (f64, f64)) -> Vec<f64> {
    #[allow(clippy::cast_precision_loss)] // a few dozen
    let m = ring.len() as f64;
    let width = StateShape::of(machine).size() + 1;
    let n = machine.n();
    let weight = |i: usize| {
        let size = match i {
            0 => 1.0,
            i if i <= n => sizes.0,
            i if i <= 2 * n => sizes.1,
            _ => sizes.0,
        };
        1.0 / (m * size * size).max(f64::MIN_POSITIVE)
    };
    (0..ring.len() * width).map(|i| weight(i % width)).collect()
}

/// The residuals of the events of `ring`, whose unknowns are the first of `w`, and their derivatives in rows as long as `w`.
/// The columns of the unknowns that follow are zero.
pub(crate) fn linearised(frame: &MachineFrame<'_>, ring: &MachineRing, w: &[f64]) -> Option<(Vec<f64>, Vec<f64>)> {
    let blocks = ring.blocks(frame)?;
    let length = w.len();
    let mut rows = vec![0.0; length * length];
    ring.fill(&mut rows, length, &blocks, 1.0);
    let mut miss: Vec<f64> = blocks.into_iter().flat_map(|block| block.miss).collect();
    // the sizes of surfaces that do not stand back are 0
    let (m, shape) = (ring.len(), &frame.shape);
    let width = shape.size() + 1;
    for (k, event) in ring.events.iter().enumerate() {
        for (s, _) in shape.surfaces.iter().enumerate().filter(|(_, j)| !event.back[**j]) {
            let place = 1 + 2 * shape.n + s;
            miss[((k + m - 1) % m) * width + place] -= w[k * width + place];
        }
    }
    Some((miss, rows))
}

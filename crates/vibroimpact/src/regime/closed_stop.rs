//! A closed compliant stop: its gap as a function of the modes.

use super::signal::{Observable, Signal};
use crate::math::Matrix;

/// A closed stop.
#[derive(Clone, Debug)]
pub(crate) struct ClosedStop {
    pub(crate) place: usize,
    /// Its stiffness, damping and preload.
    pub(crate) law: (f64, f64, f64),
    /// Its gap, and the rate of this.
    pub(crate) gap: Observable,
    pub(crate) rate: Observable,
}

/// A prescribed signal less the motion along a direction: the gap of a stop from the place of its wall, or its rate from that
/// of its wall. `share` are the components of the direction in the free directions, with exact zeros, so that the little by
/// which soft modes move a stiff stop keeps its digits. `from` are the free coordinates or velocities as functions of the modes,
/// $`E_1y + E_2z`$ with $`z = \dot y - `$ `slip`.
pub(super) fn less_motion(prescribed: Signal, share: &[f64], from: &[Matrix; 2], slip: &[Signal]) -> Observable {
    let [position, velocity] = [0, 1].map(|i| from[i].apply_transposed(share).iter().map(|x| -x).collect::<Vec<f64>>());
    let mut signal = prescribed;
    for (factor, slip) in velocity.iter().zip(slip) {
        signal.add(-factor, slip);
    }
    Observable { position, velocity, signal }
}

//! Periodic motions of machines.
//!
//! | idea | file |
//! |---|---|
//! | a machine and the structures of its regimes | `frame` |
//! | the motion over a time, with its derivative | `lap` |
//! | a cycle, by Newton's method on the state between two events | [`MachineCycle`] |

mod cycle;
mod frame;
mod lap;

pub use cycle::MachineCycle;
pub(crate) use cycle::distance as machine_distance;
pub(crate) use frame::MachineFrame;
pub(crate) use lap::MachineLap;

//! Branches and curves of machines. The tracer, the driver, the options, the errors and the events of curves are those of
//! oscillators.
//!
//! | idea | folder |
//! |---|---|
//! | the branch of a cycle in one number of a machine | `branch` |
//! | the curve of an event in a plane of two numbers | `curve` |

mod branch;
mod curve;

pub use branch::{MachineBranch, MachineBranchEvent, MachineFamily, MachinePoint};
pub use curve::{MachineCurve, MachineCurvePoint, MachinePlane};

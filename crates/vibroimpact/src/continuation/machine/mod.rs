//! Branches and curves of machines. The tracer, the driver, the options, the errors and the events of curves are those of
//! oscillators.
//!
//! | idea | folder |
//! |---|---|
//! | the branch of a cycle in one number of a machine | `branches` |
//! | the curve of an event in a plane of two numbers | `curves` |

mod branches;
mod curves;

pub use branches::{MachineBranch, MachineBranchEvent, MachineFamily, MachinePoint};
pub use curves::{MachineCurve, MachineCurvePoint, MachinePlane};

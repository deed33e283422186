//! Branches and curves of machines. The tracer, the driver, the options, the errors and the events of curves are those of
//! oscillators.
//!
//! | idea | folder |
//! |---|---|
//! | the branch of a cycle in one number of a machine | `branches` |
//! | the curve of an event in a plane of two numbers | `curves` |
//! | both, of a machine that is an oscillator those of the oscillator | [`MachineBranch`], [`MachineCurve`] |
//! | the plane of these oscillators, for curves and regions | [`MachinePlane::reduced`] |
//! | the region of a plane of two numbers in which a motion exists or is stable | [`MachinePlane::region_while`] |

mod branches;
mod curves;
mod reduced_branch;
mod reduced_curve;
mod reduced_plane;
mod region;

pub use branches::{MachineBranchEvent, MachineFamily, MachinePoint};
pub use curves::{MachineCurvePoint, MachinePlane};
pub use reduced_branch::MachineBranch;
pub use reduced_curve::MachineCurve;

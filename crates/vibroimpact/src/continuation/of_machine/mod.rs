//! Branches of cycles of machines, traced by the same tracer as those of the oscillator.
//!
//! | idea | file |
//! |---|---|
//! | a machine as a function of one number | [`MachineFamily`] |
//! | the equations of all events, with a number of the machine among the unknowns | `equations` |
//! | the problem that the tracer solves: test functions, admissible solutions | `problem` |
//! | a point of a branch, and its events | [`MachinePoint`], [`MachineBranchEvent`] |
//! | where a tracer begins | `beginning` |
//! | how the events of a motion differ from those of a signature | `change` |
//! | the branch beyond such a change | `beyond` |
//! | the cycle of twice the period beside a flip | `switch` |
//! | the branch | [`MachineBranch`] |

mod beginning;
mod beyond;
mod branch;
mod change;
mod equations;
mod family;
mod point;
mod problem;
mod switch;

pub use branch::{MachineBranch, MachineBranchError};
pub use family::MachineFamily;
pub use point::{MachineBranchEvent, MachinePoint};

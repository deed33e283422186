//! Machines: linear structures of any number of coordinates, with stops and friction joints.
//!
//! | idea | file |
//! |---|---|
//! | the numbers of a machine, before they are checked | [`MachineParts`] |
//! | the checks, and their errors | `checks`, [`MachineError`] |
//! | a checked machine, its numbers by path | [`Machine`], `path` |

mod checks;
mod error;
mod parts;
mod path;
mod value;

pub use error::{MachineError, MachineFault};
pub use parts::{FrictionJoint, HarmonicForce, HarmonicMotion, MachineParts, MachineStop, Opening, StopLaw};
pub use value::Machine;

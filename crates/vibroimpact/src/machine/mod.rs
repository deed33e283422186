//! Machines: linear structures of any number of coordinates, with stops and friction joints.
//!
//! | idea | file |
//! |---|---|
//! | the numbers of a machine, before they are checked | [`MachineParts`] |
//! | the checks, and their errors | `checks`, [`MachineError`] |
//! | damping by the ratios of the modes | [`modal_damping`] |
//! | a checked machine, its numbers by path | [`Machine`], `path` |
//! | the derivatives of its numbers by another one | `rate` |
//! | the contact of a mass with a spring and a damper, in closed form | [`SpringDamper`] |
//! | the oscillator that a machine of one coordinate is | [`Machine::reduced`], [`OneCoordinate`] |

mod checks;
mod error;
mod modal;
mod parts;
mod path;
mod rate;
mod reduced;
mod spring_damper;
mod value;

pub use checks::MOST_COORDINATES;
pub use error::{Fault, MachineError};
pub use modal::modal_damping;
pub use parts::{FrictionJoint, HarmonicForce, HarmonicMotion, ImpactLaw, MachineParts, Opening, Stop, StopLaw};
pub(crate) use rate::RateGrid;
pub(crate) use reduced::VariedReduction;
pub use reduced::{OneCoordinate, Reduction, RigidStop};
pub use spring_damper::SpringDamper;
pub use value::Machine;

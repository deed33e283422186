//! Events of machines: impacts and contacts, rest, friction, in order.
//!
//! | idea | file |
//! |---|---|
//! | an event, a start, the end of a motion | [`MachineEvent`], [`MachineStart`], [`MachineEnd`] |
//! | the law of impact | `impulses` |
//! | the state at one time | `place` |
//! | which stops rest and which joints hold | `resolve` |
//! | the motion as an iterator over its events | [`MachineMotion`] |
//! | what it does between two events | `stretch` |
//! | states, gaps and forces at equal steps | [`MachineSamples`], `samples` |

mod event;
mod impulses;
mod motion;
mod place;
mod resolve;
mod samples;
mod stretch;

pub use event::{MachineEnd, MachineEvent, MachineEventKind, MachineLimits, MachineStart};
pub use motion::MachineMotion;
pub use samples::{MachineSample, MachineSamples};

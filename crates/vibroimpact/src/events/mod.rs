//! Events of machines: impacts and contacts, rest, friction, in order.
//!
//! | idea | file |
//! |---|---|
//! | an event, a start, the end of a motion | [`MachineEvent`], [`MachineStart`], [`MachineEnd`] |
//! | the law of impact | `impulses` |
//! | the state at one time | `place` |
//! | which stops rest and which joints hold | `resolve` |
//! | the motion as an iterator over its events | [`MachineMotion`] |

mod event;
mod impulses;
mod motion;
mod place;
mod resolve;

pub use event::{MachineEnd, MachineEvent, MachineEventKind, MachineLimits, MachineStart};
pub use motion::MachineMotion;

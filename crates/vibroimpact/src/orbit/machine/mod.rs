//! Periodic motions of machines.
//!
//! | idea | file |
//! |---|---|
//! | a machine and the structures of its regimes | `frame` |
//! | the motion over a time, with its derivative where it is asked for | `lap` |
//! | the multipliers of a cycle | `multipliers` |
//! | whether rounding errors decide the period of one that rests | `rounding` |
//! | the events of a cycle as unknowns | `ring` |
//! | their equations, and the derivatives | `flight` |
//! | how many impacts of a chatter are among them | `chatters` |
//! | the events of a motion | `of_motion` |
//! | where a motion passes the states of a cycle | `crossing` |
//! | guesses of unstable ones between two that are stable | `border` |
//! | guesses without forcing: where a motion comes close to an earlier state | `near_returns` |
//! | all with a label, from many guesses | [`find_machine_while`] |
//! | a cycle | [`Cycle`] |
//! | the same, by Newton's method on the state between two events | `closing` |
//! | cycles of the oscillator that a machine is, in its numbers | `reduced` |

mod border;
mod chatters;
mod closing;
mod crossing;
mod cycle;
mod find;
mod flight;
mod frame;
mod lap;
mod multipliers;
mod near_returns;
mod of_motion;
mod reduced;
mod ring;
mod rounding;

pub(crate) use chatters::{Chatter, Rebound};
pub(crate) use crossing::passing;
pub use cycle::Cycle;
pub(crate) use cycle::Neighbours;
pub use find::{find_machine_while, find_unreduced};
pub(crate) use frame::MachineFrame;
pub(crate) use lap::MachineLap;
pub(crate) use near_returns::near_returns;
pub(crate) use of_motion::events_of;
pub(crate) use reduced::flying;
pub(crate) use ring::{MachineBlock, MachineRing, Push, RingEvent};
pub(crate) use rounding::rounding_decides;

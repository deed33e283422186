//! What is particular to verdicts on motions of machines.
//!
//! | idea | file |
//! |---|---|
//! | states that a motion reaches | [`State`] |
//! | what the record of a motion needs to know of a machine | `returns` |
//! | starts spread over the states of a machine | [`scattered_machine_starts`] |
//! | from a start to a verdict | [`settle_machine`] |
//! | impacts that fade away | `fading` |
//! | the same for a machine that is an oscillator | `reduced` |
//! | many starts: of one machine, of several | [`settle_machine_many`], [`settle_each_machine`], [`Settlement`] |

mod fading;
mod many;
mod outcome;
mod reduced;
mod returns;
mod settle;
mod starts;

pub use many::{KnownMotions, Settlement, settle_each_machine, settle_machine_many};
pub use outcome::State;
pub(crate) use reduced::Reduced;
pub(crate) use returns::{Recorded, Step};
pub(crate) use settle::settle_as;
pub use settle::{longest_flight, settle_machine, settle_machine_while, settle_unreduced};
pub use starts::scattered_machine_starts;

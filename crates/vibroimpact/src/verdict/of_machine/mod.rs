//! Verdicts on motions of machines.
//!
//! | idea | file |
//! |---|---|
//! | what the record of a motion needs to know of a machine | `returns` |
//! | the last part of a motion, for its quantities | [`MachineTail`] |
//! | starts spread over the states of a machine | [`scattered_machine_starts`] |
//! | the possible verdicts | [`MachineVerdict`] |
//! | from a start to a verdict | [`settle_machine`] |
//! | the same for a machine that is an oscillator | `reduced` |
//! | many starts: of one machine, of several | [`settle_machine_many`], [`settle_each_machine`] |

mod many;
mod outcome;
mod reduced;
mod returns;
mod settle;
mod starts;
mod tail;

pub use many::{KnownMotions, MachineSettlement, settle_each_machine, settle_machine_many};
pub use outcome::{MachineSettled, MachineUndecided, MachineVerdict};
pub(crate) use reduced::Reduced;
pub(crate) use returns::{Recorded, Step};
pub use settle::{settle_machine, settle_machine_while, settle_unreduced};
pub use starts::scattered_machine_starts;
pub use tail::MachineTail;

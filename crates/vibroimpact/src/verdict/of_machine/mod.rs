//! Verdicts on motions of machines.
//!
//! | idea | file |
//! |---|---|
//! | what the record of a motion needs to know of a machine | `returns` |
//! | from a start to a verdict | [`settle_machine`] |

mod returns;
mod settle;

pub use settle::{MachineSettled, MachineUndecided, MachineVerdict, settle_machine, settle_machine_while};

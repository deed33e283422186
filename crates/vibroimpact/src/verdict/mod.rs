//! Verdicts: what a motion settles into, proved rather than timed out.
//!
//! | idea | file |
//! |---|---|
//! | the name m/n | [`Label`] |
//! | what a motion can settle into | [`Verdict`] |
//! | from a start to a verdict | [`settle`] |
//! | ever gentler impacts: the limit without impacts | [`graze_limit`] |
//! | the 1971 paper's own rule | [`paper_rule`] |
//! | the distinct motions from many starts, and their shares | [`Census`], [`attractors`] |

mod attractors;
pub mod graze_limit;
mod label;
mod outcome;
mod paper_rule;
mod recurrence;
mod settle;

pub use attractors::{Census, Found, StartBox, attractors, scattered_starts};
pub use label::{Count, Label, LabelError};
pub use outcome::{NoImpact, Undecided, Verdict};
pub use paper_rule::{PaperRule, PaperVerdict, paper_rule};
pub use settle::{SettleOptions, Settled, settle};

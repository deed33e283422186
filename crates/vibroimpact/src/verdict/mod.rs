//! Verdicts: the motion that follows after the transient, with a criterion for each kind.
//!
//! | idea | file |
//! |---|---|
//! | the label m/n | [`Label`] |
//! | the possible verdicts, of any [`System`] | [`Verdict`] |
//! | what is particular to an oscillator | `oscillator` |
//! | from a start to a verdict: the loop for any system, and an oscillator | [`settle`], `follow` |
//! | the latest returns, recurrence, chaos: for the oscillator and for machines | `record`, `recurrence`, `recurring` |
//! | what is particular to machines | [`machine`] |
//! | many starts side by side: of one oscillator, of several; what both need | [`settle_many`], [`settle_each`], `abreast`, `settlement` |
//! | neighbourhoods of cycles that no motion leaves | `trapping_region` |
//! | ever gentler impacts: the limit without impacts | [`graze_limit`] |
//! | the rule of the 1971 paper | [`paper_rule`] |
//! | the distinct motions from many starts, and their shares | [`Census`], [`attractors`] |

mod abreast;
mod attractors;
mod each;
mod follow;
pub mod graze_limit;
pub mod machine;
mod many;
mod options;
mod oscillator;
mod outcome;
mod paper_rule;
mod record;
mod recurrence;
mod recurring;
mod settle;
mod settlement;
mod trapping_region;

pub use crate::orbit::{Count, Label, LabelError, Stability};
pub use attractors::{Census, CountedMotion, StartBox, attractors, scattered_starts};
pub use each::{Counted, settle_each};
pub(crate) use follow::{Follow, Releases, ended};
pub use machine::{
    KnownMotions, scattered_machine_starts, settle_each_machine, settle_machine, settle_machine_many,
    settle_machine_while, settle_unreduced,
};
pub(crate) use machine::{Recorded, Reduced, Step, settle_as};
pub use many::{KnownAttractors, settle_many};
pub use options::SettleOptions;
pub use oscillator::{NoImpact, Reason};
pub use outcome::{Chaos, Settled, System, Undecided, UndecidedCause, Verdict};
pub use paper_rule::{PaperRule, PaperVerdict, paper_rule};
pub use settle::{settle, settle_while};
pub use settlement::{Ending, Settlement};

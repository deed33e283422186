//! Branches: how a cycle changes with one parameter, and its events.
//!
//! | idea | file |
//! |---|---|
//! | the branch, by its impacts or by its release | [`Branch`], [`BranchOptions`] |
//! | a point of a branch | [`SolutionPoint`] |
//! | branches by the equations of the impacts: the problem of the tracer, the steps, their events | `problem`, `impact_branch`, `events` |
//! | a grazing event, and the cycle beyond it | `touch`, `graze` |
//! | the complete chatter to which a branch tends on which impacts appear one after another | `accumulation` |
//! | transitions to and from the motion without impacts | `free` |
//! | branches that begin at a flip or a branch point | `switch` |
//! | branches of cycles that stick, by their release | `resting` |

mod accumulation;
mod branch;
mod events;
mod free;
mod graze;
mod impact_branch;
mod options;
mod point;
mod problem;
mod resting;
mod switch;
mod touch;

pub use branch::Branch;
pub(crate) use options::scale;
pub use options::{BranchError, BranchOptions, Direction};
pub use point::SolutionPoint;
pub(crate) use problem::{COARSE, RULES};

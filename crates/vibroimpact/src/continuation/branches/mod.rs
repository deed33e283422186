//! Branches: how a cycle changes with one parameter, through the events on the way.
//!
//! | idea | file |
//! |---|---|
//! | the branch | [`Branch`], [`BranchOptions`] |
//! | a point of a branch, and what happens there | [`SolutionPoint`], [`BranchEvent`] |
//! | by the equations of its impacts: what is traced, step by step; the events of a step | `problem`, `impact_branch`, `events` |
//! | a grazing impact, and the cycle on its other side | `touch`, `graze` |
//! | impact after impact: the chatter at the end | `accumulation` |
//! | the motion without impacts: to it and from it | `free` |
//! | branches that begin at a flip or a branch point | `switch` |
//! | by its release, where a cycle rests on a stop | `resting` |

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
pub use options::{BranchError, BranchOptions, Direction};
pub use point::{BranchEvent, Change, SolutionPoint, Touch};

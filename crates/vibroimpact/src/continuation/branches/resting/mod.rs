//! Branches of cycles that rest on a stop, by their release.
//!
//! | idea | file |
//! |---|---|
//! | the branch | `rest_branch` |
//! | whether the motions at two values of the parameter are alike | `likeness` |
//! | what happens between two values | `rest_events` |

mod likeness;
pub(super) mod rest_branch;
mod rest_events;

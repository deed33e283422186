//! Branches of cycles that stick, by their release.
//!
//! | idea | file |
//! |---|---|
//! | the branch | `rest_branch` |
//! | comparing the motions at two values of the parameter | `likeness` |
//! | the event between two values | `rest_events` |

mod likeness;
pub(super) mod rest_branch;
mod rest_events;

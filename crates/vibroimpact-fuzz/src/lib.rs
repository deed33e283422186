//! Random and adversarial questions, with checks of every answer.
//!
//! | family | questions | file |
//! |---|---|---|
//! | commands | command lines of `vibro`, each run as a process | [`command`] |
//! | plans | plans in TOML and JSON, valid and mutated, run in memory | [`plan`] |
//! | stores | stores with damaged bytes, read and repaired by `vibro` | [`store`] |
//! | page | requests to the explorer, without a socket | [`page`] |
//! | verdicts | starts settled alone and in batches | [`verdicts`] |
//! | machines | degenerate machines of `vibroimpact-cases`, their motions and answers about them | [`machines`] |
//!
//! Case number `k` of a family depends only on the seed, the family and `k`, so a case can be run again by its number.
//! Each family runs in a worker, a process of its own with a memory limit. If a worker aborts or hangs, this is a fault
//! of its current case, and another worker continues with the next case. A case with a fault is reduced before it is
//! printed.

pub mod case;
pub mod command;
pub mod driver;
pub mod limits;
pub mod machines;
pub mod options;
pub mod page;
pub mod plan;
pub mod rules;
pub mod store;
pub mod system;
pub mod values;
pub mod verdicts;
pub mod worker;

pub use options::{Family, FuzzOptions};

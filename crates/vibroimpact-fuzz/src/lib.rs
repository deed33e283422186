//! Random and adversarial questions, and what must hold of every answer.
//!
//! | family | what is asked | file |
//! |---|---|---|
//! | commands | command lines of `vibro`, each run as a process | [`command`] |
//! | plans | plans in TOML and JSON, valid and mutated, run in memory | [`plan`] |
//! | stores | stores with damaged bytes, read and mended by `vibro` | [`store`] |
//! | page | requests to the explorer, without a socket | [`page`] |
//! | verdicts | starts settled alone and among others | [`verdicts`] |
//!
//! Case number `k` of a family follows from the seed, the family and `k` alone, so a case can be run again by its number. Each
//! family runs in a worker, a process of its own with a limit of memory: a worker that aborts or hangs is a fault of the
//! case it was at, and another worker goes on behind it. A case with a fault is made smaller before it is printed.

pub mod case;
pub mod command;
pub mod driver;
pub mod family;
pub mod limits;
pub mod options;
pub mod page;
pub mod plan;
pub mod rules;
pub mod store;
pub mod system;
pub mod values;
pub mod verdicts;
pub mod worker;

pub use family::Family;
pub use options::FuzzOptions;

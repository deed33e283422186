//! Why a store cannot be used.

use std::io;
use thiserror::Error;
use vibroimpact_study::{PlanError, Stopped};

/// Why a store cannot be used. The sentence names the place, and what to do.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum StoreError {
    /// The plan makes no sense.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// Stopped from outside; what is finished is kept.
    #[error("stopped after {} of {} points", .0.done, .0.total)]
    Stopped(Stopped),
    /// An object cannot be read.
    #[error("cannot read `{key}` of the store {place}: {error}")]
    Read {
        /// The store.
        place: String,
        /// The object.
        key: String,
        /// Why.
        error: io::Error,
    },
    /// An object cannot be written.
    #[error(
        "cannot write `{key}` of the store {place}: {error}\nhint: the tiles that are finished are kept; resume the study when that is mended"
    )]
    Write {
        /// The store.
        place: String,
        /// The object.
        key: String,
        /// Why.
        error: io::Error,
    },
    /// A store cannot be begun.
    #[error("the store {place} cannot be begun: {error}\nhint: choose a folder that can be written")]
    Begin {
        /// The store.
        place: String,
        /// Why.
        error: io::Error,
    },
    /// There is no store.
    #[error("there is no store at {0}")]
    Absent(String),
    /// Something else is there.
    #[error("{0} is not empty, and no store of this program\nhint: a store needs a folder of its own")]
    Foreign(String),
    /// A store that a later program wrote.
    #[error(
        "the store {place} has format {found}; this program knows format {known}\nhint: use the version of vibroimpact that wrote it ({program}), or a later one"
    )]
    Newer {
        /// The store.
        place: String,
        /// Its format.
        found: u64,
        /// That of this program.
        known: u64,
        /// The program that wrote it.
        program: String,
    },
    /// A store of another plan.
    #[error("the store {place} holds another plan ({theirs}, not {ours})\nhint: choose another folder for this one")]
    OtherPlan {
        /// The store.
        place: String,
        /// The hash of its plan.
        theirs: String,
        /// The hash of the plan given.
        ours: String,
    },
    /// A store that another version began: its tiles might differ in a last bit.
    #[error(
        "the store {place} was begun by vibroimpact {theirs}; this is {ours}, whose results may differ\nhint: finish it with that version, or begin another store"
    )]
    OtherVersion {
        /// The store.
        place: String,
        /// The version that began it.
        theirs: String,
        /// This one.
        ours: String,
    },
    /// A tile that is done has a chunk that is not whole.
    #[error(
        "`{key}` of tile {tile} in the store {place} is missing, cut short or has a wrong check sum\nhint: resuming the study computes the tile anew"
    )]
    DamagedTile {
        /// The store.
        place: String,
        /// The tile.
        tile: u64,
        /// The chunk.
        key: String,
    },
    /// What describes the store is damaged.
    #[error(
        "`{key}` of the store {place} is damaged: {why}\nhint: running the plan it was made from into it again mends it"
    )]
    Damaged {
        /// The store.
        place: String,
        /// The object.
        key: String,
        /// How.
        why: String,
    },
    /// A part of a job array that does not exist.
    #[error("tiles {index}/{of} is no part of a whole: I/N needs 1 <= I <= N")]
    Part {
        /// Which part.
        index: u64,
        /// Of how many.
        of: u64,
    },
    /// The operating system starts no threads.
    #[error("threads cannot be started: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// A place that this build cannot reach.
    #[error("{place}: {why}")]
    Unreachable {
        /// The place.
        place: String,
        /// Why.
        why: String,
    },
}

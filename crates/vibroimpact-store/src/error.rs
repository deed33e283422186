//! The errors of stores.

use std::io;
use thiserror::Error;
use vibroimpact_study::{PlanError, Stopped};

/// The reason why a store cannot be used. The message names the place and the remedy.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum StoreError {
    /// The plan is invalid.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// The run was stopped by its caller; complete tiles are kept.
    #[error("stopped after {} of {} points", .0.done, .0.total)]
    Stopped(Stopped),
    /// The sample of an estimate ended before any of its points was finished.
    #[error("no point of the sample was finished\nhint: a longer budget")]
    NotSampled,
    /// An object cannot be read.
    #[error("cannot read `{key}` of the store {place}: {error}")]
    Read {
        /// The store.
        place: String,
        /// The object.
        key: String,
        /// The cause.
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
        /// The cause.
        error: io::Error,
    },
    /// The store cannot be created.
    #[error("the store {place} cannot be begun: {error}\nhint: choose a folder that can be written")]
    Begin {
        /// The store.
        place: String,
        /// The cause.
        error: io::Error,
    },
    /// There is no store at this place.
    #[error("there is no store at {0}")]
    Absent(String),
    /// The place contains something else.
    #[error("{0} is not empty, and no store of this program\nhint: a store needs a folder of its own")]
    Foreign(String),
    /// The store was written by a later program with another format.
    #[error(
        "the store {place} has format {found}; this program knows format {known}\nhint: use the version of vibroimpact that wrote it ({program}), or a later one"
    )]
    Newer {
        /// The store.
        place: String,
        /// The format of the store.
        found: u64,
        /// The format of this program.
        known: u64,
        /// The program that wrote it.
        program: String,
    },
    /// The store belongs to another plan.
    #[error("the store {place} holds another plan ({theirs}, not {ours})\nhint: choose another folder for this one")]
    OtherPlan {
        /// The store.
        place: String,
        /// The hash of its plan.
        theirs: String,
        /// The hash of the given plan.
        ours: String,
    },
    /// The store was begun by another version, whose tiles might differ in a last bit.
    #[error(
        "the store {place} was begun by vibroimpact {theirs}; this is {ours}, whose results may differ\nhint: finish it with that version, or begin another store"
    )]
    OtherVersion {
        /// The store.
        place: String,
        /// The version that began it.
        theirs: String,
        /// The version of this program.
        ours: String,
    },
    /// A complete tile has a damaged chunk.
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
    /// The metadata of the store are damaged.
    #[error(
        "`{key}` of the store {place} is damaged: {why}\nhint: running the plan it was made from into it again mends it"
    )]
    Damaged {
        /// The store.
        place: String,
        /// The object.
        key: String,
        /// A description of the damage.
        why: String,
    },
    /// The part of a job array does not exist.
    #[error("tiles {index}/{of} is no part of a whole: I/N needs 1 <= I <= N")]
    Part {
        /// Number of the part.
        index: u64,
        /// Number of parts.
        of: u64,
    },
    /// The operating system cannot start threads.
    #[error("threads cannot be started: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// This build cannot access the place.
    #[error("{place}: {why}")]
    Unreachable {
        /// The place.
        place: String,
        /// The cause.
        why: String,
    },
}

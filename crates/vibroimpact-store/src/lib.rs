//! A study on disk: a Zarr v3 group, one array for each field, one chunk for each tile.
//!
//! Everything that computes fills tiles of the same store with the same bytes. A tile is done exactly when the chunk of
//! its status, which is written last, is there and whole. Objects appear whole or not at all, so that a process may be
//! killed at any moment, and several may work on one store without knowing of each other.
//!
//! # Places
//!
//! A folder, or with the feature `s3` a bucket of any object store that speaks S3, called `s3://BUCKET/PREFIX`; both come to
//! the same objects with the same bytes. All that is asked of a place is in [`Shelf`]. How a bucket is reached stands in the
//! environment, by the usual names:
//!
//! | variable | meaning |
//! |---|---|
//! | `AWS_ACCESS_KEY_ID`, `AWS_SECRET_ACCESS_KEY` | who asks; without them the role of the machine, where it has one |
//! | `AWS_SESSION_TOKEN` | for a key that is lent |
//! | `AWS_REGION` | where the bucket is; `us-east-1` unless given |
//! | `AWS_ENDPOINT_URL` | the server, `https://...`; Amazon's unless given |
//! | `AWS_ALLOW_HTTP` | `true` allows a server without encryption, as on one's own machine |
//!
//! The files of `aws configure` are not read. The bucket has to be there. A server that cannot be reached is given up after
//! some three seconds, one that never says a word after thirty; one that has answered once may be away for a minute and a half.
//!
//! # Files
//!
//! | idea | file |
//! |---|---|
//! | objects by name: a folder, or a bucket | `shelf.rs`, `bucket.rs` |
//! | an array: its description, its chunks as bytes | `chunk.rs` |
//! | the arrays of a study | `layout.rs` |
//! | what describes the store | `root.rs` |
//! | filling tiles, over threads, until all are there | `run.rs` |
//! | what only the whole can say | `conclude.rs` |
//! | how far it is, and what is damaged | `check.rs` |
//! | whether what describes it is whole | `described.rs` |

#[cfg(feature = "s3")]
mod bucket;
mod check;
mod chunk;
mod conclude;
mod described;
mod error;
mod handle;
mod layout;
mod read;
mod root;
mod run;
mod shelf;

#[cfg(feature = "s3")]
pub use bucket::Bucket;
pub use check::{Damage, Progress, Verified};
pub use error::StoreError;
pub use handle::{FORMAT, Store};
pub use run::{Part, Ran};
pub use shelf::{Folder, Item, Shelf};

use handle::VERSION;
use layout::{DONE, Layout};
use root::{Found, ROOT, read_root};
use serde_json::Value;
use std::io;
use std::path::Path;
use std::sync::Arc;
use vibroimpact_study::study::{Cells, Study};
use vibroimpact_study::{Column, Plan};

/// The shelf at a place: a folder, or `s3://bucket/prefix`.
///
/// # Errors
/// [`StoreError::Unreachable`] for a bucket where this build has no access to any.
pub fn shelf(place: &str) -> Result<Arc<dyn Shelf>, StoreError> {
    if place.trim().is_empty() {
        return Err(StoreError::Unreachable { place: "the store".into(), why: "its name is empty".into() });
    }
    if place.trim() == "-" {
        return Err(StoreError::Unreachable {
            place: "the store".into(),
            why: "`-` is stdout elsewhere, and a store is a folder".into(),
        });
    }
    match place.split_once("://") {
        None => Ok(Arc::new(Folder::new(Path::new(place)))),
        #[cfg(feature = "s3")]
        Some(("s3", _)) => Ok(Arc::new(Bucket::new(place)?)),
        #[cfg(not(feature = "s3"))]
        Some(("s3", _)) => Err(StoreError::Unreachable {
            place: place.to_owned(),
            why: "this build reaches folders only\nhint: build with `--features s3`".to_owned(),
        }),
        Some(_) => Err(StoreError::Unreachable {
            place: place.to_owned(),
            why: "a store lies in a folder or at s3://BUCKET/PREFIX".to_owned(),
        }),
    }
}

impl Store {
    /// Opens the store of a plan, and begins it if there is none.
    ///
    /// # Errors
    /// [`StoreError`] for a plan that makes no sense or fills no grid, a place that cannot be used, or a store of another plan.
    pub fn create(shelf: Arc<dyn Shelf>, plan: &Plan) -> Result<Self, StoreError> {
        let plan = &plan.canonical()?;
        let store = Self::over(shelf, plan, VERSION.to_owned())?;
        let mut fresh = false;
        match store.root() {
            Ok(root) => return store.joined(&root),
            Err(StoreError::Absent(_)) => {
                let there = store.shelf.list("").map_err(|error| store.unread("", error))?;
                if there.iter().any(|item| item.key == ROOT) {
                    // another process has begun it since
                    let root = store.root()?;
                    return store.joined(&root);
                }
                // one that another process is beginning just now has arrays, but nothing else
                let known = |key: &str| store.described().any(|array| key.starts_with(&format!("{}/", array.name)));
                if there.iter().any(|item| !known(&item.key)) {
                    return Err(StoreError::Foreign(store.place()));
                }
                fresh = true;
            }
            // the plan is given: what describes it can be written anew
            Err(StoreError::Damaged { .. }) => {}
            Err(other) => return Err(other),
        }
        store.describe().map_err(|failure| match failure {
            StoreError::Write { place, error, .. } if fresh => StoreError::Begin { place, error },
            other => other,
        })?;
        Ok(store)
    }

    /// Itself, if what is there is of the same plan.
    fn joined(self, root: &Value) -> Result<Self, StoreError> {
        let found = self.found(root)?;
        if found.hash != self.plan.hash() {
            return Err(StoreError::OtherPlan { place: self.place(), theirs: found.hash, ours: self.plan.hash() });
        }
        Ok(Self { begun_by: found.version, ..self })
    }

    /// Opens a store that is there.
    ///
    /// # Errors
    /// [`StoreError`] where there is none, or none that this program can read.
    pub fn open(shelf: Arc<dyn Shelf>) -> Result<Self, StoreError> {
        let place = shelf.name();
        let root = read_root(shelf.as_ref())?;
        let found = Found::of(&root, &place)?;
        let plan: Plan = serde_json::from_str(&found.plan).map_err(|error| StoreError::Damaged {
            place,
            key: ROOT.into(),
            why: format!("its plan does not read: {error}"),
        })?;
        let store = Self::over(shelf, &plan, found.version)?;
        // another version may write the same plan in other words
        if store.is_ours() && store.plan.hash() != found.hash {
            let why =
                format!("its plan has the name {}, not {}: one of them was changed", store.plan.hash(), found.hash);
            return Err(store.defect(ROOT, why));
        }
        Ok(store)
    }

    fn over(shelf: Arc<dyn Shelf>, plan: &Plan, begun_by: String) -> Result<Self, StoreError> {
        let study = Study::new(plan)?;
        let layout = Layout::new(&study).map_err(|why| StoreError::Unreachable { place: shelf.name(), why })?;
        Ok(Self { shelf, plan: plan.clone(), study, layout, begun_by })
    }

    /// The plan.
    #[must_use]
    pub const fn plan(&self) -> &Plan {
        &self.plan
    }

    /// What is computed.
    #[must_use]
    pub const fn study(&self) -> &Study {
        &self.study
    }

    /// Where it is.
    #[must_use]
    pub fn place(&self) -> String {
        self.shelf.name()
    }

    /// The version of the program that began it.
    #[must_use]
    pub fn begun_by(&self) -> &str {
        &self.begun_by
    }

    fn put(&self, key: &str, bytes: &[u8]) -> Result<(), StoreError> {
        let failed = |error| StoreError::Write { place: self.place(), key: key.to_owned(), error };
        self.shelf.put(key, bytes).map_err(failed)
    }

    /// Writes an object unless these very bytes are there.
    fn settle(&self, key: &str, bytes: &[u8]) -> Result<(), StoreError> {
        if self.get(key)?.as_deref() == Some(bytes) { Ok(()) } else { self.put(key, bytes) }
    }

    fn get(&self, key: &str) -> Result<Option<Vec<u8>>, StoreError> {
        self.shelf.get(key).map_err(|error| self.unread(key, error))
    }

    fn unread(&self, key: &str, error: io::Error) -> StoreError {
        StoreError::Read { place: self.place(), key: key.to_owned(), error }
    }

    fn defect(&self, key: &str, why: String) -> StoreError {
        StoreError::Damaged { place: self.place(), key: key.to_owned(), why }
    }

    /// Whether a tile is done: its status is there and whole.
    fn done(&self, tile: u64) -> Result<bool, StoreError> {
        let (array, place) = (&self.layout.status, self.layout.status_place(tile));
        let Some(bytes) = self.get(&array.key(&place))? else { return Ok(false) };
        Ok(array.decode(&place, bytes) == Ok(Cells::Numbers(Column::I8(vec![DONE]))))
    }

    /// Computes a tile and writes it, its status last; nothing is written if stopped.
    fn fill(&self, tile: u64, tick: &(dyn Fn() -> bool + Sync)) -> Result<bool, StoreError> {
        let Some(columns) = self.study.tile(tile, tick) else { return Ok(false) };
        self.write_tile(tile, &columns)?;
        Ok(true)
    }

    /// Writes the columns of a tile, as [`Study::tile`] gives them, and then its status.
    ///
    /// # Errors
    /// [`StoreError`] when the place cannot be written.
    pub fn write_tile(&self, tile: u64, columns: &[Column]) -> Result<(), StoreError> {
        for (field, column) in columns.iter().enumerate() {
            self.write(tile, field, column)?;
        }
        let (array, place) = (&self.layout.status, self.layout.status_place(tile));
        let done = Cells::Numbers(Column::I8(vec![DONE]));
        let bytes = array.encode(&place, &done).map_err(|why| self.defect(&array.name, why))?;
        self.put(&array.key(&place), &bytes)
    }

    fn write(&self, tile: u64, field: usize, column: &Column) -> Result<(), StoreError> {
        let (array, place) = (&self.layout.arrays[field], self.layout.place(tile, field));
        let chunk = Cells::Numbers(self.layout.padded(tile, field, column));
        let bytes = array.encode(&place, &chunk).map_err(|why| self.defect(&array.name, why))?;
        self.put(&array.key(&place), &bytes)
    }

    /// The column of a field in a tile, if it is there and whole.
    fn read(&self, tile: u64, field: usize) -> Result<Option<Column>, StoreError> {
        let (array, place) = (&self.layout.arrays[field], self.layout.place(tile, field));
        let Some(bytes) = self.get(&array.key(&place))? else { return Ok(None) };
        Ok(match array.decode(&place, bytes) {
            Ok(Cells::Numbers(chunk)) => Some(self.layout.unpadded(tile, field, &chunk)),
            _ => None,
        })
    }

    /// Whether this version began it.
    fn is_ours(&self) -> bool {
        self.begun_by == VERSION
    }

    /// Refuses to add tiles to a store that another version began.
    fn same_version(&self) -> Result<(), StoreError> {
        if self.is_ours() {
            return Ok(());
        }
        let (theirs, ours) = (self.begun_by.clone(), VERSION.to_owned());
        Err(StoreError::OtherVersion { place: self.place(), theirs, ours })
    }
}

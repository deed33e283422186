//! A study on disk: a Zarr v3 group with one array for each field and one chunk for each tile.
//!
//! All programs that fill a store write the same bytes. A tile is complete exactly if the chunk of its status, which is
//! written last, exists and is undamaged. Objects appear complete or not at all, so a process may be killed at any
//! moment, and several processes may work on one store without communication.
//!
//! # Places
//!
//! A store is in a folder or, with the feature `s3`, in a bucket of any object store with the S3 protocol, named
//! `s3://BUCKET/PREFIX`. Both contain the same objects with the same bytes. [`Shelf`] is the interface that a place
//! must implement. Access to a bucket is configured by the usual environment variables:
//!
//! | variable | meaning |
//! |---|---|
//! | `AWS_ACCESS_KEY_ID`, `AWS_SECRET_ACCESS_KEY` | the credentials; by default those of the role of the machine, if it has one |
//! | `AWS_SESSION_TOKEN` | the session token of temporary credentials |
//! | `AWS_REGION` | the region of the bucket; default `us-east-1` |
//! | `AWS_ENDPOINT_URL` | the server, `https://...`; default: that of Amazon |
//! | `AWS_ALLOW_HTTP` | `true` allows a server without encryption, for example on the same machine |
//!
//! The files of `aws configure` are not read. The bucket must exist. The attempt to use a server ends after about three
//! seconds if it cannot be reached, and after thirty seconds if it does not answer. A server that has answered once may
//! be unreachable for a minute and a half.
//!
//! # Files
//!
//! | idea | file |
//! |---|---|
//! | objects by name, in a folder, a bucket or memory | `shelf.rs`, `bucket.rs`, `memory.rs` |
//! | an array: its metadata, its chunks as bytes | `chunk.rs` |
//! | the arrays of a study | `layout.rs` |
//! | the metadata of the store | `root.rs` |
//! | which tiles are in which shard, the bytes of a shard | `shards.rs` |
//! | tiles that wait for their shard, and its completion | `sharded.rs` |
//! | tiles in memory until their shard is complete | `held.rs` |
//! | parts of tiles that are computed point after point | `begun.rs` |
//! | filling tiles by several threads until all are complete, or the time is spent | `run.rs` |
//! | which tiles come first | `order.rs` |
//! | the processor time of each tile, beside the store | `costs.rs`, `clock.rs` |
//! | the final tables | `conclude.rs` |
//! | how often each number occurs in a field | `count.rs` |
//! | equal chunks, which are compressed once | `recent.rs` |
//! | what a study will cost | `estimate.rs` |
//! | progress and verification | `check.rs` |
//! | verification of the metadata | `described.rs` |

mod begun;
#[cfg(feature = "s3")]
mod bucket;
mod check;
mod checksum;
mod chunk;
mod clock;
mod codec;
mod conclude;
mod costs;
mod count;
mod described;
mod error;
mod estimate;
mod held;
mod layout;
mod memory;
mod metadata;
mod order;
mod read;
mod recent;
mod root;
mod run;
mod sharded;
mod shards;
mod shelf;

#[cfg(feature = "s3")]
pub use bucket::Bucket;
pub use check::{Damage, Progress, Verified};
pub use costs::{RegionCost, TileCosts};
pub use error::StoreError;
pub use estimate::{Estimate, Sampling, estimate};
pub use memory::Memory;
pub use run::{Part, Ran};
pub use shelf::{Folder, Item, Shelf};

use begun::BEGUN;
use costs::Costs;
use layout::Layout;
use root::{Found, ROOT, read_root};
use serde_json::Value;
use shards::{LOOSE, Shards};
use std::io;
use std::path::Path;
use std::sync::Arc;
use vibroimpact_study::Column;
use vibroimpact_study::Plan;
use vibroimpact_study::study::{Cells, Study};

/// The latest format of stores that this program knows: 1 without shards, 2 with shards. A store with a later format is
/// refused.
pub const FORMAT: u64 = 2;
/// The format of stores whose tiles are files of their own.
pub(crate) const PLAIN: u64 = 1;
/// The version of this program.
pub(crate) const VERSION: &str = env!("CARGO_PKG_VERSION");

/// A study and the place where it is stored.
pub struct Store {
    pub(crate) shelf: Arc<dyn Shelf>,
    pub(crate) plan: Plan,
    pub(crate) study: Study,
    pub(crate) layout: Layout,
    /// The version that began it.
    pub(crate) begun_by: String,
    /// The costs of its tiles, if they are recorded.
    pub(crate) costs: Option<Costs>,
}

/// The shelf at a place: a folder or `s3://bucket/prefix`.
///
/// # Errors
/// [`StoreError::Unreachable`] for a bucket if this build does not support buckets.
pub fn shelf(place: &str) -> Result<Arc<dyn Shelf>, StoreError> {
    let refused = |place: &str, why: &str| StoreError::Unreachable { place: place.to_owned(), why: why.to_owned() };
    match place.trim() {
        "" => return Err(refused("the store", "its name is empty")),
        "-" => return Err(refused("the store", "`-` is stdout elsewhere, and a store is a folder")),
        _ => {}
    }
    match place.split_once("://") {
        None => Ok(Arc::new(Folder::new(Path::new(place)))),
        #[cfg(feature = "s3")]
        Some(("s3", _)) => Ok(Arc::new(Bucket::new(place)?)),
        #[cfg(not(feature = "s3"))]
        Some(("s3", _)) => Err(refused(place, "this build reaches folders only\nhint: build with `--features s3`")),
        Some(_) => Err(refused(place, "a store lies in a folder or at s3://BUCKET/PREFIX")),
    }
}

/// The shelf for the costs of the tiles of the store at a place: beside it, under its name with `.costs`.
///
/// # Errors
/// As for [`shelf`].
pub fn costs_beside(place: &str) -> Result<Arc<dyn Shelf>, StoreError> {
    shelf(&format!("{}.costs", place.trim_end_matches(['/', '\\'])))
}

impl Store {
    /// Opens the store of a plan, and creates it if it does not exist.
    ///
    /// # Errors
    /// [`StoreError`] for a plan that is invalid or has no grid, a place that cannot be used, or a store of another
    /// plan.
    pub fn create(shelf: Arc<dyn Shelf>, plan: &Plan) -> Result<Self, StoreError> {
        let plan = &plan.canonical()?;
        let store = Self::over(shelf, plan, VERSION.to_owned(), FORMAT)?;
        let mut fresh = false;
        match store.root() {
            Ok(root) => return store.joined(&root),
            Err(StoreError::Absent(_)) => {
                let there = store.list("")?;
                if there.iter().any(|item| item.key == ROOT) {
                    // another process has created the store in the meantime
                    let root = store.root()?;
                    return store.joined(&root);
                }
                // a store that another process is creating at this moment contains only arrays
                let known = |key: &str| {
                    [LOOSE, BEGUN].iter().any(|folder| key.starts_with(folder))
                        || store.described().any(|array| key.starts_with(&format!("{}/", array.name)))
                };
                if there.iter().any(|item| !known(&item.key)) {
                    return Err(StoreError::Foreign(store.place()));
                }
                fresh = true;
            }
            // the plan is given, so damaged metadata can be written again
            Err(StoreError::Damaged { .. }) => {}
            Err(other) => return Err(other),
        }
        store.describe().map_err(|failure| match failure {
            StoreError::Write { place, error, .. } if fresh => StoreError::Begin { place, error },
            other => other,
        })?;
        Ok(store)
    }

    /// This store, if the existing root belongs to the same plan.
    fn joined(self, root: &Value) -> Result<Self, StoreError> {
        let found = Found::of(root, &self.place())?;
        if found.hash != self.plan.hash() {
            return Err(StoreError::OtherPlan { place: self.place(), theirs: found.hash, ours: self.plan.hash() });
        }
        Self::of(self.shelf, self.plan, self.study, found.version, found.format).with_layout_of(root, found.format)
    }

    /// Opens an existing store.
    ///
    /// # Errors
    /// [`StoreError`] if there is no store, or none that this program can read.
    pub fn open(shelf: Arc<dyn Shelf>) -> Result<Self, StoreError> {
        let place = shelf.name();
        let root = read_root(shelf.as_ref())?;
        let found = Found::of(&root, &place)?;
        let plan = Plan::from_json(&found.plan).map_err(|error| StoreError::Damaged {
            place,
            key: ROOT.into(),
            why: format!("its plan does not read: {error}"),
        })?;
        let Found { hash, version, format, .. } = found;
        let store = Self::over(shelf, &plan, version, format)?.with_layout_of(&root, format)?;
        // another version may write the same plan as another text
        if store.is_ours() && store.plan.hash() != hash {
            let why = format!("its plan has the name {}, not {}: one of them was changed", store.plan.hash(), hash);
            return Err(store.defect(ROOT, why));
        }
        Ok(store)
    }

    /// This store with the tiles and fields with which one of this root and format was begun.
    fn with_layout_of(self, root: &Value, format: u64) -> Result<Self, StoreError> {
        let (tiles, absent) = (self.begun_tiles(root)?, self.absent_fields(root)?);
        if tiles.is_none() && absent.is_empty() {
            return Ok(self);
        }
        let lengths = tiles.unwrap_or_default();
        let study = self.study.with_tiles(&lengths, |name| !absent.iter().any(|absent| absent == name));
        Ok(Self::of(self.shelf, self.plan, study, self.begun_by, format))
    }

    fn over(shelf: Arc<dyn Shelf>, plan: &Plan, begun_by: String, format: u64) -> Result<Self, StoreError> {
        Ok(Self::of(shelf, plan.clone(), Study::new(plan)?, begun_by, format))
    }

    fn of(shelf: Arc<dyn Shelf>, plan: Plan, study: Study, begun_by: String, format: u64) -> Self {
        let shards = if format == PLAIN { None } else { Shards::of(study.grid(), plan.shard) };
        let layout = Layout::new(&study, shards);
        Self { shelf, plan, study, layout, begun_by, costs: None }
    }

    /// Number of tiles of a shard along each dimension; `None` for a store without shards.
    #[must_use]
    pub fn shard(&self) -> Option<&[usize]> {
        self.layout.shards.as_ref().map(|shards| shards.side.as_slice())
    }

    /// The format of this store.
    const fn format(&self) -> u64 {
        if self.layout.shards.is_some() { FORMAT } else { PLAIN }
    }

    /// The plan of the study.
    #[must_use]
    pub const fn plan(&self) -> &Plan {
        &self.plan
    }

    /// The study.
    #[must_use]
    pub const fn study(&self) -> &Study {
        &self.study
    }

    /// The name of the place.
    #[must_use]
    pub fn place(&self) -> String {
        self.shelf.name()
    }

    /// The version of the program that created the store.
    #[must_use]
    pub fn begun_by(&self) -> &str {
        &self.begun_by
    }

    fn put(&self, key: &str, bytes: &[u8]) -> Result<(), StoreError> {
        let failed = |error| StoreError::Write { place: self.place(), key: key.to_owned(), error };
        self.shelf.put(key, bytes).map_err(failed)
    }

    /// Writes an object unless it already has these bytes.
    fn settle(&self, key: &str, bytes: &[u8]) -> Result<(), StoreError> {
        if self.get(key)?.as_deref() == Some(bytes) { Ok(()) } else { self.put(key, bytes) }
    }

    fn get(&self, key: &str) -> Result<Option<Vec<u8>>, StoreError> {
        self.shelf.get(key).map_err(|error| self.unread(key, error))
    }

    fn list(&self, prefix: &str) -> Result<Vec<Item>, StoreError> {
        self.shelf.list(prefix).map_err(|error| self.unread(prefix, error))
    }

    fn unread(&self, key: &str, error: io::Error) -> StoreError {
        StoreError::Read { place: self.place(), key: key.to_owned(), error }
    }

    fn defect(&self, key: &str, why: String) -> StoreError {
        StoreError::Damaged { place: self.place(), key: key.to_owned(), why }
    }

    /// Whether the status of a tile, or of its shard, exists and is undamaged.
    fn stated(&self, tile: u64) -> Result<bool, StoreError> {
        let Some(bytes) = self.get(&self.layout.status_key(tile))? else { return Ok(false) };
        Ok(self.layout.status.decode(&bytes).as_ref() == Ok(&self.layout.all_done(tile)))
    }

    /// Whether a tile is complete, that is, it waits for its shard, or its status exists and is undamaged. In this order,
    /// because the status is written before the tile that waits is removed.
    fn done(&self, tile: u64) -> Result<bool, StoreError> {
        Ok(self.waiting(tile)?.is_some() || self.stated(tile)?)
    }

    /// Computes a tile and writes it, with its status last. Writes nothing if stopped.
    fn fill(&self, tile: u64, tick: &(dyn Fn() -> bool + Sync)) -> Result<bool, StoreError> {
        let Some(columns) = self.continued(tile, tick)? else { return Ok(false) };
        self.write_tile(tile, &columns)?;
        self.forget_begun(tile)?;
        Ok(true)
    }

    /// Writes the columns of a tile, as returned by [`Study::tile`], and then its status. In a store with shards the tile is
    /// one object that waits for the others of its shard.
    ///
    /// # Errors
    /// [`StoreError`] if the place cannot be written.
    pub fn write_tile(&self, tile: u64, columns: &[Column]) -> Result<(), StoreError> {
        let chunks = self.chunks(tile, columns)?;
        if let Some(shards) = &self.layout.shards {
            return self.put_waiting(shards, tile, &chunks);
        }
        for (field, chunk) in chunks.iter().enumerate() {
            self.put(&self.layout.key(tile, field), chunk)?;
        }
        let (key, bytes) = self.status_object(tile)?;
        self.put(&key, &bytes)
    }

    /// The status that says that a tile, or all tiles of its shard, are complete.
    fn status_object(&self, tile: u64) -> Result<(String, Vec<u8>), StoreError> {
        let array = &self.layout.status;
        let bytes = array.encode(&self.layout.all_done(tile)).map_err(|why| self.defect(&array.name, why))?;
        Ok((self.layout.status_key(tile), bytes))
    }

    /// The chunks of a tile in the arrays of all fields.
    fn chunks(&self, tile: u64, columns: &[Column]) -> Result<Vec<Vec<u8>>, StoreError> {
        columns.iter().enumerate().map(|(field, column)| self.encoded(tile, field, column)).collect()
    }

    /// The chunk of a tile in the array of a field.
    fn encoded(&self, tile: u64, field: usize, column: &Column) -> Result<Vec<u8>, StoreError> {
        let array = &self.layout.arrays[field];
        let encode = |chunk| array.encode(&Cells::Numbers(chunk));
        let bytes = self.layout.recent[field].bytes(&self.layout.padded(tile, field, column), encode);
        bytes.map_err(|why| self.defect(&array.name, why))
    }

    /// The column of a field in a tile from its chunk, unless it is damaged.
    fn decoded(&self, tile: u64, field: usize, chunk: &[u8]) -> Option<Column> {
        match self.layout.arrays[field].decode(chunk) {
            Ok(Cells::Numbers(chunk)) => Some(self.layout.unpadded(tile, field, &chunk)),
            _ => None,
        }
    }

    /// The chunk of a field in a tile, and its column, if it exists and is undamaged.
    ///
    /// Another process may complete the shard of a tile that waits. It writes the shard, then the status, and removes the
    /// tile last, so a tile that is neither in the shard nor waits has moved if the shard has it now.
    fn sound(&self, tile: u64, field: usize) -> Result<Option<(Vec<u8>, Column)>, StoreError> {
        let both = |chunk: Vec<u8>| self.decoded(tile, field, &chunk).map(|column| (chunk, column));
        let Some(shards) = &self.layout.shards else {
            return Ok(self.get(&self.layout.key(tile, field))?.and_then(both));
        };
        if let Some(found) = self.in_shard(shards, tile, field)?.and_then(both) {
            return Ok(Some(found));
        }
        match self.waiting(tile)?.and_then(|chunks| chunks.into_iter().nth(field)).and_then(both) {
            None => Ok(self.in_shard(shards, tile, field)?.and_then(both)),
            found => Ok(found),
        }
    }

    /// The column of a field in a tile, if it exists and is undamaged.
    fn read(&self, tile: u64, field: usize) -> Result<Option<Column>, StoreError> {
        Ok(self.sound(tile, field)?.map(|(_, column)| column))
    }

    /// Whether this version created the store.
    fn is_ours(&self) -> bool {
        self.begun_by == VERSION
    }

    /// Refuses to add tiles to a store that another version created.
    fn same_version(&self) -> Result<(), StoreError> {
        if self.is_ours() {
            return Ok(());
        }
        let (theirs, ours) = (self.begun_by.clone(), VERSION.to_owned());
        Err(StoreError::OtherVersion { place: self.place(), theirs, ours })
    }
}

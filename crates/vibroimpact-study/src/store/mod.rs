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
//! | filling tiles, over threads, until all are there | `run.rs` |
//! | what only the whole can say | `conclude.rs` |
//! | how far it is, and what is damaged | `check.rs` |

#[cfg(feature = "s3")]
mod bucket;
mod check;
mod chunk;
mod conclude;
mod error;
mod layout;
mod read;
mod run;
mod shelf;

#[cfg(feature = "s3")]
pub use bucket::Bucket;
pub use check::{Damage, Progress, Verified};
pub use error::StoreError;
pub use run::{Part, Ran};
pub use shelf::{Folder, Item, Shelf};

use crate::study::{Cells, Study};
use crate::{Column, Plan};
use chunk::Chunked;
use layout::{DONE, Layout};
use serde_json::{Map, Value, json};
use std::io;
use std::path::Path;
use std::sync::Arc;

/// The version of the arrangement described here; a store of a later one is refused.
pub const FORMAT: u64 = 1;
/// This program.
const VERSION: &str = env!("CARGO_PKG_VERSION");
/// What describes the whole store; written when everything else that is there from the beginning is.
const ROOT: &str = "zarr.json";

/// A study and where it is stored.
pub struct Store {
    shelf: Arc<dyn Shelf>,
    plan: Plan,
    study: Study,
    layout: Layout,
    /// The version that began it.
    begun_by: String,
}

/// The shelf at a place: a folder, or `s3://bucket/prefix`.
///
/// # Errors
/// [`StoreError::Unreachable`] for a bucket where this build has no access to any.
pub fn shelf(place: &str) -> Result<Arc<dyn Shelf>, StoreError> {
    if place.trim().is_empty() {
        return Err(StoreError::Unreachable { place: "the store".into(), why: "its name is empty".into() });
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
            }
            // the plan is given: what describes it can be written anew
            Err(StoreError::Damaged { .. }) => {}
            Err(other) => return Err(other),
        }
        store.describe()?;
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
        Self::over(shelf, &plan, found.version)
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

    fn root(&self) -> Result<Value, StoreError> {
        read_root(self.shelf.as_ref())
    }

    fn found(&self, root: &Value) -> Result<Found, StoreError> {
        Found::of(root, &self.place())
    }

    /// The arrays that are there from the beginning.
    fn described(&self) -> impl Iterator<Item = &Chunked> {
        let Layout { arrays, status, coordinates, .. } = &self.layout;
        arrays.iter().chain([status]).chain(coordinates.iter().map(|(array, _)| array))
    }

    /// Writes what is there from the beginning.
    fn describe(&self) -> Result<(), StoreError> {
        let mut descriptions = Map::new();
        for array in self.described() {
            let description = array.description().map_err(|why| self.defect(&array.name, why))?;
            self.put(&array.description_key(), &pretty(&description))?;
            descriptions.insert(array.name.clone(), description);
        }
        for (array, values) in &self.layout.coordinates {
            let bytes = array.encode(&[0], values).map_err(|why| self.defect(&array.name, why))?;
            self.put(&array.key(&[0]), &bytes)?;
        }
        self.write_root(&descriptions, false)
    }

    fn write_root(&self, descriptions: &Map<String, Value>, complete: bool) -> Result<(), StoreError> {
        let plan = serde_json::to_string(&self.plan).map_err(|error| self.defect(ROOT, error.to_string()))?;
        let root = json!({
            "zarr_format": 3,
            "node_type": "group",
            "attributes": {
                "Conventions": "CF-1.11",
                "title": self.plan.title(),
                "source": format!("vibroimpact {}", self.begun_by),
                "references": "Fukaya and Irie (1971); every motion is settled to a proved verdict",
                "vibroimpact_format": FORMAT,
                "vibroimpact_version": self.begun_by,
                "plan": plan,
                "plan_hash": self.plan.hash(),
                "complete": i32::from(complete),
            },
            "consolidated_metadata": { "kind": "inline", "must_understand": false, "metadata": descriptions },
        });
        self.put(ROOT, &pretty(&root))
    }

    fn put(&self, key: &str, bytes: &[u8]) -> Result<(), StoreError> {
        let failed = |error| StoreError::Write { place: self.place(), key: key.to_owned(), error };
        self.shelf.put(key, bytes).map_err(failed)
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

    /// Refuses to add tiles to a store that another version began.
    fn same_version(&self) -> Result<(), StoreError> {
        if self.begun_by == VERSION {
            return Ok(());
        }
        let (theirs, ours) = (self.begun_by.clone(), VERSION.to_owned());
        Err(StoreError::OtherVersion { place: self.place(), theirs, ours })
    }
}

/// JSON for people too.
fn pretty(value: &Value) -> Vec<u8> {
    let mut bytes = serde_json::to_vec_pretty(value).unwrap_or_default();
    bytes.push(b'\n');
    bytes
}

fn read_root(shelf: &dyn Shelf) -> Result<Value, StoreError> {
    let place = shelf.name();
    let damaged = |why: String| StoreError::Damaged { place: place.clone(), key: ROOT.into(), why };
    match shelf.get(ROOT) {
        Ok(Some(bytes)) => serde_json::from_slice(&bytes).map_err(|error| damaged(error.to_string())),
        Ok(None) => Err(StoreError::Absent(place)),
        // the folder is a file
        Err(error) if error.kind() == io::ErrorKind::NotADirectory => Err(StoreError::Foreign(place)),
        Err(error) => Err(StoreError::Read { place, key: ROOT.into(), error }),
    }
}

/// What the description of a store says of it.
struct Found {
    plan: String,
    hash: String,
    version: String,
}

impl Found {
    fn of(root: &Value, place: &str) -> Result<Self, StoreError> {
        let attribute = |name: &str| root.get("attributes").and_then(|all| all.get(name));
        let word = |name: &str| attribute(name).and_then(Value::as_str).map(str::to_owned);
        let Some(format) = attribute("vibroimpact_format").and_then(Value::as_u64) else {
            return Err(StoreError::Foreign(place.to_owned()));
        };
        if format > FORMAT {
            let program = word("vibroimpact_version").unwrap_or_else(|| "unknown".into());
            return Err(StoreError::Newer { place: place.to_owned(), found: format, known: FORMAT, program });
        }
        match (word("plan"), word("plan_hash"), word("vibroimpact_version")) {
            (Some(plan), Some(hash), Some(version)) => Ok(Self { plan, hash, version }),
            _ => Err(StoreError::Damaged {
                place: place.to_owned(),
                key: ROOT.into(),
                why: "the plan is missing".into(),
            }),
        }
    }
}

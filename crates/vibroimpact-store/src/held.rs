//! Tiles that a run holds in memory until their shard is complete. Tiles that take little time would otherwise be written, read
//! and removed for the shard alone, which can take longer than their computation.
//!
//! The tiles that are held of a shard take together at most [`MOST`]; then they are written as tiles that wait. So a process
//! that is killed loses no more than that for each shard that it is computing, beside the tiles that are not complete.

use crate::shards::{self, Shards, loose_prefix};
use crate::{Store, StoreError};
use core::time::Duration;
use std::collections::{BTreeMap, HashMap};
use std::sync::{Mutex, PoisonError};
use vibroimpact_study::Column;

/// Maximum processor time of the tiles that are held of a shard.
const MOST: Duration = Duration::from_secs(1);

/// The chunks of all fields of some tiles.
type TileChunks = BTreeMap<u64, Vec<Vec<u8>>>;

/// The tiles of each shard that are not written yet, and the processor time that they took.
#[derive(Default)]
pub(crate) struct Held(Mutex<HashMap<u64, (TileChunks, Duration)>>);

impl Held {
    /// Adds a tile. Returns the tiles of its shard if they take too much time together to be held.
    fn add(&self, shard: u64, (tile, chunks): (u64, Vec<Vec<u8>>), cost: Duration) -> TileChunks {
        let mut held = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let (tiles, time) = held.entry(shard).or_default();
        tiles.insert(tile, chunks);
        *time += cost;
        if *time > MOST { held.remove(&shard).unwrap_or_default().0 } else { TileChunks::new() }
    }

    /// Removes the tiles of a shard.
    fn take(&self, shard: u64) -> TileChunks {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).remove(&shard).unwrap_or_default().0
    }

    /// Removes all tiles.
    fn take_all(&self) -> Vec<TileChunks> {
        let mut held = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        held.drain().map(|(_, (tiles, _))| tiles).collect()
    }
}

impl Store {
    /// Holds a tile that took some processor time, or writes it if its chunks are files of their own, or if it can be
    /// continued after a part of it, which is removed when it is complete.
    pub(crate) fn hold(&self, held: &Held, tile: u64, columns: &[Column], cost: Duration) -> Result<(), StoreError> {
        let Some(shards) = self.layout.shards.as_ref().filter(|_| !self.study.continues()) else {
            return self.write_tile(tile, columns);
        };
        self.write_waiting(shards, &held.add(shards.of_tile(tile), (tile, self.chunks(tile, columns)?), cost))
    }

    /// Writes tiles as tiles that wait for their shard.
    fn write_waiting(&self, shards: &Shards, tiles: &TileChunks) -> Result<(), StoreError> {
        tiles.iter().try_for_each(|(tile, chunks)| self.put_waiting(shards, *tile, chunks))
    }

    /// Writes all tiles that are held.
    pub(crate) fn write_held(&self, held: &Held) -> Result<(), StoreError> {
        let Some(shards) = &self.layout.shards else { return Ok(()) };
        held.take_all().into_iter().try_for_each(|tiles| self.write_waiting(shards, &tiles))
    }

    /// Completes a shard of which this run has no more tiles to compute: at once if all of its tiles are held, otherwise if the
    /// others are there.
    pub(crate) fn complete_held(&self, held: &Held, shard: u64) -> Result<(), StoreError> {
        let Some(shards) = &self.layout.shards else { return Ok(()) };
        let (mut tiles, order) = (held.take(shard), shards.tiles(shard));
        let first = shards.first(shard);
        if tiles.len() < order.iter().flatten().count() {
            self.write_waiting(shards, &tiles)?;
            return self.complete_shard(shard).map(drop);
        }
        for field in 0..self.layout.fields.len() {
            let chunk =
                |tile: &Option<u64>| tiles.get_mut(tile.as_ref()?).map(|chunks| core::mem::take(&mut chunks[field]));
            let chunks: Vec<Option<Vec<u8>>> = order.iter().map(chunk).collect();
            self.put(&self.layout.key(first, field), &shards::assemble(&chunks))?;
        }
        self.close_shard(first, &self.list(&loose_prefix(shard))?)
    }
}

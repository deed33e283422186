//! Stores with shards: tiles that wait for their shard, its completion when all are there, and its verification.

use crate::check::Damage;
use crate::checksum;
use crate::described::of_store;
use crate::held::Held;
use crate::run::State;
use crate::shards::{self, Chunks, LOOSE, Shards, loose_prefix};
use crate::shelf::Item;
use crate::{Store, StoreError};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::sync::atomic::{AtomicU64, Ordering};

/// The shards of a run, and how many of its tiles are missing in each.
#[derive(Default)]
pub(crate) struct Unfinished {
    missing: HashMap<u64, AtomicU64>,
    /// The tiles that are complete and not written yet.
    pub(crate) held: Held,
    /// The shards of which no tile of this run is missing.
    pub(crate) closed: Vec<u64>,
}

impl Store {
    /// The chunks of a tile that waits for its shard; `None` if there is none, or it is damaged.
    pub(crate) fn waiting(&self, tile: u64) -> Result<Option<Vec<Vec<u8>>>, StoreError> {
        let Some(shards) = &self.layout.shards else { return Ok(None) };
        let found = self.get(&shards.loose_key(tile))?.and_then(|bytes| shards::unbundle(&bytes));
        Ok(found.filter(|chunks| chunks.len() == self.layout.fields.len()))
    }

    /// The chunk of a tile in its shard, if there is one whose index is undamaged.
    pub(crate) fn in_shard(&self, shards: &Shards, tile: u64, field: usize) -> Result<Option<Vec<u8>>, StoreError> {
        let key = self.layout.key(tile, field);
        let failed = |error| self.unread(&key, error);
        let Some((tail, length)) = self.shelf.tail(&key, shards.index_length()).map_err(failed)? else {
            return Ok(None);
        };
        let entry = shards::index(&tail, length).and_then(|index| index.get(shards.chunk(tile)).copied().flatten());
        let Some((offset, count)) = entry else { return Ok(None) };
        self.shelf.range(&key, offset, count).map_err(failed)
    }

    /// The chunks of a field in a shard, and whether its bytes are exactly those of its chunks.
    fn shard_chunks(&self, shards: &Shards, shard: u64, field: usize) -> Result<(Chunks, bool), StoreError> {
        let none = (vec![None; shards.chunks()], false);
        let Some(bytes) = self.get(&self.layout.key(shards.first(shard), field))? else { return Ok(none) };
        let Some(chunks) = shards::chunks(&bytes, shards.index_length()) else { return Ok(none) };
        let exact = shards::assemble(&chunks) == bytes;
        Ok((chunks, exact))
    }

    /// The states of the given tiles; `None` if stopped. Each shard is read once.
    pub(crate) fn states_in_shards(
        &self,
        shards: &Shards,
        tiles: &[u64],
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Vec<State>>, StoreError> {
        let of_shard = shards.grouped(tiles);
        let states = |(shard, tiles): (&u64, &Vec<u64>)| -> Result<Option<Vec<(u64, State)>>, StoreError> {
            if stop() {
                return Ok(None);
            }
            let fields = 0..self.layout.fields.len();
            let all = fields.map(|field| Ok(self.shard_chunks(shards, *shard, field)?.0));
            let mut all = all.collect::<Result<Vec<_>, StoreError>>()?;
            let state = |tile: &u64| {
                let chunk = shards.chunk(*tile);
                let own: Vec<Option<Vec<u8>>> = all.iter_mut().map(|chunks| chunks[chunk].take()).collect();
                Ok((*tile, self.state_in_shard(*tile, own)?))
            };
            tiles.iter().map(state).collect::<Result<Vec<_>, StoreError>>().map(Some)
        };
        let found: Option<Vec<Vec<(u64, State)>>> =
            of_shard.par_iter().map(states).collect::<Result<Option<Vec<_>>, StoreError>>()?;
        let Some(found) = found else { return Ok(None) };
        let known: HashMap<u64, State> = found.into_iter().flatten().collect();
        Ok(Some(tiles.iter().map(|tile| known.get(tile).copied().unwrap_or(State::Open)).collect()))
    }

    /// The state of a tile with these chunks in its shard.
    fn state_in_shard(&self, tile: u64, own: Vec<Option<Vec<u8>>>) -> Result<State, StoreError> {
        let torn: Vec<usize> = own
            .into_iter()
            .enumerate()
            .filter(|(field, chunk)| chunk.as_ref().and_then(|chunk| self.decoded(tile, *field, chunk)).is_none())
            .map(|(field, _)| field)
            .collect();
        if torn.is_empty() {
            return Ok(State::Whole);
        }
        if let Some(chunks) = self.waiting(tile)?
            && torn.iter().all(|field| self.decoded(tile, *field, &chunks[*field]).is_some())
        {
            return Ok(State::Whole);
        }
        if !self.claimed(tile)? {
            return Ok(State::Open);
        }
        // another process may have moved the tile since its shard was read
        for field in torn {
            if self.read(tile, field)?.is_none() {
                return Ok(State::Damaged);
            }
        }
        Ok(State::Whole)
    }

    /// Number of tiles whose shard is complete, or that wait for it; `stated` and `waiting` are the objects of both.
    pub(crate) fn count_in_shards(&self, shards: &Shards, stated: &[Item], waiting: &[Item]) -> u64 {
        let stated: BTreeSet<&str> = stated.iter().map(|item| item.key.as_str()).collect();
        let waiting: BTreeSet<&str> = waiting.iter().map(|item| item.key.as_str()).collect();
        let done = |tile: &u64| {
            stated.contains(self.layout.status_key(*tile).as_str())
                || waiting.contains(shards.loose_key(*tile).as_str())
        };
        (0..self.study.grid().tiles()).filter(done).count() as u64
    }

    /// The shards of the tiles of a run, of which `open` are missing or damaged.
    pub(crate) fn unfinished_shards(&self, mine: &[u64], open: &[u64]) -> Unfinished {
        let mut missing: HashMap<u64, AtomicU64> = HashMap::new();
        let Some(shards) = &self.layout.shards else { return Unfinished::default() };
        for tile in open {
            *missing.entry(shards.of_tile(*tile)).or_default().get_mut() += 1;
        }
        let closed: BTreeSet<u64> =
            mine.iter().map(|tile| shards.of_tile(*tile)).filter(|shard| !missing.contains_key(shard)).collect();
        Unfinished { missing, closed: closed.into_iter().collect(), ..Unfinished::default() }
    }

    /// Completes the shard of a tile if the tile was the last one that this run had to add to it.
    pub(crate) fn complete_if_last(&self, unfinished: &Unfinished, tile: u64) -> Result<(), StoreError> {
        let Some(shards) = &self.layout.shards else { return Ok(()) };
        let shard = shards.of_tile(tile);
        let last = unfinished.missing.get(&shard).is_some_and(|left| left.fetch_sub(1, Ordering::AcqRel) == 1);
        if last { self.complete_held(&unfinished.held, shard) } else { Ok(()) }
    }

    /// Writes a shard and its status if all its tiles are there, and removes their objects. Returns whether it is complete.
    /// Nothing is written if it is complete already.
    pub(crate) fn complete_shard(&self, shard: u64) -> Result<bool, StoreError> {
        let Some(shards) = &self.layout.shards else { return Ok(true) };
        let (tiles, first) = (shards.tiles(shard), shards.first(shard));
        let waiting = self.list(&loose_prefix(shard))?;
        let there = self.get(&self.layout.key(first, 0))?.is_some();
        if waiting.len() < tiles.iter().flatten().count() && !there {
            return Ok(false);
        }
        let complete = || -> Result<bool, StoreError> {
            let exact = |field| Ok(self.shard_chunks(shards, shard, field)?.1);
            let all = (0..self.layout.fields.len()).map(exact).collect::<Result<Vec<_>, StoreError>>()?;
            Ok(all.into_iter().all(|exact| exact) && self.stated(first)?)
        };
        if waiting.is_empty() && complete()? {
            return Ok(true);
        }
        let waits: BTreeSet<&str> = waiting.iter().map(|item| item.key.as_str()).collect();
        for field in 0..self.layout.fields.len() {
            let (old, exact) = self.shard_chunks(shards, shard, field)?;
            let mut chunks = vec![None; tiles.len()];
            let (mut kept, known) = (0, tiles.iter().flatten().count());
            for (tile, (chunk, old)) in tiles.iter().zip(chunks.iter_mut().zip(old)) {
                let Some(tile) = tile else { continue };
                // a tile that was damaged in the shard and computed again waits
                let new = if waits.contains(shards.loose_key(*tile).as_str()) { self.waiting(*tile)? } else { None };
                let new =
                    new.and_then(|chunks| chunks.into_iter().nth(field)).filter(|new| checksum::content(new).is_some());
                *chunk = new.or_else(|| {
                    kept += 1;
                    old.filter(|old| checksum::content(old).is_some())
                });
                if chunk.is_none() {
                    // there is none, or another process has just completed the shard and removed the tile
                    return complete();
                }
            }
            let bytes = shards::assemble(&chunks);
            let key = self.layout.key(first, field);
            if !exact || kept < known {
                self.put(&key, &bytes)?;
            }
        }
        self.close_shard(first, &waiting)?;
        Ok(true)
    }

    /// Writes the status of the shard of a tile, when its chunks are written, and removes the tiles that waited for it.
    pub(crate) fn close_shard(&self, tile: u64, waiting: &[Item]) -> Result<(), StoreError> {
        let (key, bytes) = self.status_object(tile)?;
        self.settle(&key, &bytes)?;
        self.remove(waiting)
    }

    /// Writes a tile as one object that waits for the others of its shard.
    pub(crate) fn put_waiting(&self, shards: &Shards, tile: u64, chunks: &[Vec<u8>]) -> Result<(), StoreError> {
        self.put(&shards.loose_key(tile), &shards::bundle(chunks))
    }

    /// Completes all shards.
    pub(crate) fn complete_shards(&self) -> Result<(), StoreError> {
        let Some(shards) = &self.layout.shards else { return Ok(()) };
        let waiting = self.list(LOOSE)?;
        let folders: BTreeSet<&str> = waiting.iter().filter_map(|item| Some(item.key.rsplit_once('/')?.0)).collect();
        for shard in 0..shards.count() {
            let tile = shards.first(shard);
            let waits = folders.contains(loose_prefix(shard).trim_end_matches('/'));
            if (waits || !self.stated(tile)?) && !self.complete_shard(shard)? {
                return Err(StoreError::DamagedTile { place: self.place(), tile, key: self.layout.key(tile, 0) });
            }
        }
        Ok(())
    }

    /// Replaces chunks of a field in a shard, all at once.
    pub(crate) fn replace_chunks(
        &self,
        shard: u64,
        field: usize,
        new: BTreeMap<u64, Vec<u8>>,
    ) -> Result<(), StoreError> {
        let Some(shards) = &self.layout.shards else { return Ok(()) };
        let Some(first) = new.keys().next().copied() else { return Ok(()) };
        let (mut chunks, _) = self.shard_chunks(shards, shard, field)?;
        for (tile, chunk) in new {
            chunks[shards.chunk(tile)] = Some(chunk);
        }
        self.settle(&self.layout.key(first, field), &shards::assemble(&chunks))
    }

    /// Removes the objects of tiles whose shards are complete.
    pub(crate) fn sweep_waiting(&self) -> Result<(), StoreError> {
        if self.layout.shards.is_none() {
            return Ok(());
        }
        self.remove(&self.list(LOOSE)?)
    }

    /// Removes objects.
    pub(crate) fn remove(&self, items: &[Item]) -> Result<(), StoreError> {
        let failed = |key: &str, error| StoreError::Write { place: self.place(), key: key.to_owned(), error };
        items.iter().try_for_each(|item| self.shelf.remove(&item.key).map_err(|error| failed(&item.key, error)))
    }

    /// The faults of shards whose tiles are all undamaged: bytes that are no chunk, and a missing or damaged status. `states`
    /// are those of all tiles.
    pub(crate) fn shard_damage(&self, states: &[State]) -> Result<Vec<Damage>, StoreError> {
        let Some(shards) = &self.layout.shards else { return Ok(Vec::new()) };
        let state = |tile: u64| usize::try_from(tile).ok().and_then(|tile| states.get(tile)).copied();
        let faults = |shard: u64| -> Result<Vec<Damage>, StoreError> {
            let (mut tiles, first) = (shards.tiles(shard).into_iter().flatten(), shards.first(shard));
            let mut damage = Vec::new();
            let there = self.get(&self.layout.key(first, 0))?.is_some();
            if !there || tiles.any(|tile| state(tile) != Some(State::Whole)) {
                return Ok(damage);
            }
            for field in 0..self.layout.fields.len() {
                if !self.shard_chunks(shards, shard, field)?.1 {
                    damage.push(of_store(format!("`{}` is not what its chunks give", self.layout.key(first, field))));
                }
            }
            if !self.stated(first)? {
                damage.push(of_store(format!("`{}` is missing or damaged", self.layout.status_key(first))));
            }
            Ok(damage)
        };
        let all: Result<Vec<Vec<Damage>>, StoreError> = (0..shards.count()).into_par_iter().map(faults).collect();
        Ok(all?.into_iter().flatten().collect())
    }
}

//! How often each number occurs in a field of integers. Large stores have many tiles with the same chunk, which is decoded
//! once; and each shard is read once.

use crate::shards::{self, Chunks};
use crate::{Store, StoreError};
use std::collections::HashMap;
use vibroimpact_study::study::EachCount;

/// Number of different chunks that are known at the same time.
const KNOWN: usize = 256;

impl Store {
    /// Calls `each` for each complete tile, in any order, with its number and how often each number occurs in a field of
    /// integers, the smallest number first.
    ///
    /// # Errors
    /// [`StoreError`] if the place cannot be read, or if a tile is damaged.
    pub fn count(&self, field: usize, each: EachCount<'_>) -> Result<(), StoreError> {
        let mut known: HashMap<Vec<u8>, Vec<(i32, u64)>> = HashMap::new();
        let mut of_tile = |tile: u64, chunk: Option<Vec<u8>>| -> Result<(), StoreError> {
            // a chunk at the edge of the grid has padding, which is not counted
            let full = self.layout.grid.tile(tile) == self.layout.grid.full_tile(tile);
            if let Some(counts) = chunk.as_ref().filter(|_| full).and_then(|chunk| known.get(chunk)) {
                each(tile, counts);
                return Ok(());
            }
            if let Some(chunk) = chunk
                && let Some(column) = self.decoded(tile, field, &chunk)
            {
                let counts = column.counts();
                each(tile, &counts);
                if known.len() == KNOWN {
                    known.clear();
                }
                if full {
                    known.insert(chunk, counts);
                }
            } else if let Some(column) = self.kept(tile, field)? {
                // it waits for its shard, where it is missing or damaged
                each(tile, &column.counts());
            }
            Ok(())
        };
        let Some(shards) = &self.layout.shards else {
            for tile in 0..self.layout.grid.tiles() {
                of_tile(tile, self.get(&self.layout.key(tile, field))?)?;
            }
            return Ok(());
        };
        for shard in 0..shards.count() {
            let tiles = shards.tiles(shard);
            let bytes = self.get(&self.layout.key(shards.first(shard), field))?;
            let chunks: Option<Chunks> = bytes.and_then(|bytes| shards::chunks(&bytes, shards.index_length()));
            let chunks = chunks.unwrap_or_else(|| vec![None; tiles.len()]);
            for (tile, chunk) in tiles.into_iter().zip(chunks) {
                if let Some(tile) = tile {
                    of_tile(tile, chunk)?;
                }
            }
        }
        Ok(())
    }
}

//! The conclusion of a store whose tiles are all complete: the final tables, and the texts of all labels that occur.

use crate::layout::{array_of, array_of_table};
use crate::root::Conclusion;
use crate::{Store, StoreError};
use std::collections::{BTreeMap, BTreeSet};
use vibroimpact_study::Column;
use vibroimpact_study::study::{EachCount, StudyTable, Tiles, meaning_of};

impl Tiles for &Store {
    type Error = StoreError;

    fn read(&mut self, tile: u64, field: usize) -> Result<Column, StoreError> {
        let key = || self.layout.key(tile, field);
        Store::read(self, tile, field)?.ok_or_else(|| self.defect(&key(), "its check sum is wrong".into()))
    }

    fn counts(&mut self, _: u64, field: usize, each: EachCount<'_>) -> Result<(), StoreError> {
        self.count(field, each)
    }

    fn write(&mut self, tile: u64, field: usize, column: &Column) -> Result<(), StoreError> {
        let chunk = self.encoded(tile, field, column)?;
        self.put(&self.layout.key(tile, field), &chunk)
    }
}

/// Access to the tiles of a store with shards. The chunks of a shard are replaced all at once, so a shard has either its
/// preliminary or its final form, whatever other processes do.
struct InShards<'a> {
    store: &'a Store,
    /// The new chunks of each shard and field.
    new: BTreeMap<(u64, usize), BTreeMap<u64, Vec<u8>>>,
}

impl Tiles for InShards<'_> {
    type Error = StoreError;

    fn read(&mut self, tile: u64, field: usize) -> Result<Column, StoreError> {
        Tiles::read(&mut &*self.store, tile, field)
    }

    fn counts(&mut self, _: u64, field: usize, each: EachCount<'_>) -> Result<(), StoreError> {
        self.store.count(field, each)
    }

    fn write(&mut self, tile: u64, field: usize, column: &Column) -> Result<(), StoreError> {
        let Some(shards) = &self.store.layout.shards else { return Ok(()) };
        let chunk = self.store.encoded(tile, field, column)?;
        self.new.entry((shards.of_tile(tile), field)).or_default().insert(tile, chunk);
        Ok(())
    }
}

impl Store {
    /// Adds the tables and the texts of labels, and marks the store as complete. Objects that already have the right
    /// bytes are not written, so a complete store may be in a place that cannot be written.
    pub(crate) fn conclude(&self) -> Result<(), StoreError> {
        if !self.is_ours() && self.concluded()? {
            // another version may use other texts
            return Ok(());
        }
        self.complete_shards()?;
        let conclusion = if self.layout.shards.is_some() {
            let mut tiles = InShards { store: self, new: BTreeMap::new() };
            let conclusion = self.conclusion(&mut tiles)?;
            for ((shard, field), new) in tiles.new {
                self.replace_chunks(shard, field, new)?;
            }
            conclusion
        } else {
            let mut tiles = self;
            self.conclusion(&mut tiles)?
        };
        self.settle_all(&self.descriptions(Some(&conclusion))?)?;
        self.sweep_waiting()?;
        self.sweep_begun()?;
        self.shelf.sweep().map_err(|error| self.unread("", error))
    }

    /// The final tables, computed from complete tiles. Tiles are written again as described at [`Study::conclude`].
    ///
    /// [`Study::conclude`]: vibroimpact_study::Study::conclude
    pub(crate) fn conclusion(&self, tiles: &mut impl Tiles<Error = StoreError>) -> Result<Conclusion, StoreError> {
        let tables = self.study.conclude(tiles)?;
        let mut labelled = Vec::new();
        for (number, field) in self.layout.fields.iter().enumerate().filter(|(_, field)| field.name == "label") {
            let array = array_of(field, (&self.layout.grid, self.layout.shards.as_ref()), &self.labels(number)?);
            labelled.push((number, array.map_err(|why| self.defect(&field.name, why))?));
        }
        let array = |table: StudyTable| match array_of_table(&table) {
            Ok(array) => Ok((array, table.values)),
            Err(why) => Err(self.defect(table.name, why)),
        };
        Ok(Conclusion { labelled, tables: tables.into_iter().map(array).collect::<Result<_, _>>()? })
    }

    /// The labels m/n that occur, with their codes.
    fn labels(&self, field: usize) -> Result<Vec<(i32, String)>, StoreError> {
        let mut codes = BTreeSet::new();
        self.count(field, &mut |_, counts| codes.extend(counts.iter().map(|(code, _)| *code)))?;
        Ok(codes.into_iter().filter(|code| *code > 0).filter_map(|code| Some((code, meaning_of(code)?))).collect())
    }
}

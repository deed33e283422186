//! The conclusion of a store whose tiles are all complete: the final tables, and the texts of all labels that occur.

use crate::layout::{array_of, array_of_table};
use crate::root::Conclusion;
use crate::{Store, StoreError};
use std::collections::{BTreeMap, BTreeSet};
use vibroimpact_study::Column;
use vibroimpact_study::study::{EachCount, StudyTable, Tiles, meaning_of};

/// What is done with a column of a tile, by the number of its field, whose cycles have got their final numbers.
type Renumbered<'a> = &'a mut dyn FnMut(u64, usize, &Column) -> Result<(), StoreError>;

/// The complete tiles of a store.
struct Complete<'a> {
    store: &'a Store,
    write: Renumbered<'a>,
}

impl Tiles for Complete<'_> {
    type Error = StoreError;

    fn read(&mut self, tile: u64, field: usize) -> Result<Column, StoreError> {
        let key = || self.store.layout.key(tile, field);
        self.store.read(tile, field)?.ok_or_else(|| self.store.defect(&key(), "its check sum is wrong".into()))
    }

    fn counts(&mut self, _: u64, field: usize, each: EachCount<'_>) -> Result<(), StoreError> {
        self.store.count(field, each)
    }

    fn write(&mut self, tile: u64, field: usize, column: &Column) -> Result<(), StoreError> {
        (self.write)(tile, field, column)
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
        // The chunks of a shard are replaced all at once, so that a shard has either its preliminary or its final form,
        // whatever other processes do.
        let mut of_shards: BTreeMap<(u64, usize), BTreeMap<u64, Vec<u8>>> = BTreeMap::new();
        let conclusion = self.conclusion(&mut |tile, field, column| {
            let chunk = self.encoded(tile, field, column)?;
            let Some(shards) = &self.layout.shards else { return self.put(&self.layout.key(tile, field), &chunk) };
            of_shards.entry((shards.of_tile(tile), field)).or_default().insert(tile, chunk);
            Ok(())
        })?;
        for ((shard, field), new) in of_shards {
            self.replace_chunks(shard, field, new)?;
        }
        self.settle_all(&self.descriptions(Some(&conclusion))?)?;
        self.sweep_waiting()?;
        self.sweep_begun()?;
        self.shelf.sweep().map_err(|error| self.unread("", error))
    }

    /// The final tables, computed from complete tiles. `write` is called as described at [`Study::conclude`]; no column is
    /// read after it.
    ///
    /// [`Study::conclude`]: vibroimpact_study::Study::conclude
    pub(crate) fn conclusion(&self, write: Renumbered<'_>) -> Result<Conclusion, StoreError> {
        let tables = self.study.conclude(&mut Complete { store: self, write })?;
        let mut labelled = Vec::new();
        for (number, field) in self.layout.fields.iter().enumerate().filter(|(_, field)| field.name == "label") {
            let array = array_of(field, (&self.layout.grid, self.layout.shards.as_ref()), &self.labels(number)?);
            labelled.push((number, array));
        }
        let array = |table: StudyTable| (array_of_table(&table), table.values);
        Ok(Conclusion { labelled, tables: tables.into_iter().map(array).collect() })
    }

    /// The labels m/n that occur, with their codes.
    fn labels(&self, field: usize) -> Result<Vec<(i32, String)>, StoreError> {
        let mut codes = BTreeSet::new();
        self.count(field, &mut |_, counts| codes.extend(counts.iter().map(|(code, _)| *code)))?;
        Ok(codes.into_iter().filter(|code| *code > 0).filter_map(|code| Some((code, meaning_of(code)?))).collect())
    }
}

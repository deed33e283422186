//! When all tiles are there: what only the whole can say, and the names of all labels that occur.

use super::chunk::Chunked;
use super::layout::{array_of, array_of_table};
use super::root::pretty;
use super::{Store, StoreError};
use crate::field::Column;
use crate::study::{Tiles, label_of};
use serde_json::Map;
use std::collections::BTreeSet;

impl Tiles for &Store {
    type Error = StoreError;

    fn read(&mut self, tile: u64, field: usize) -> Result<Column, StoreError> {
        let key = || self.layout.arrays[field].key(&self.layout.place(tile, field));
        Store::read(self, tile, field)?.ok_or_else(|| self.defect(&key(), "its check sum is wrong".into()))
    }

    fn write(&mut self, tile: u64, field: usize, column: &Column) -> Result<(), StoreError> {
        Store::write(self, tile, field, column)
    }
}

impl Store {
    /// Adds the tables and the dictionary of labels, and marks the store as complete. What stands there already is not
    /// written again, so that a store that is complete may lie where nothing can be written.
    pub(super) fn conclude(&self) -> Result<(), StoreError> {
        if !self.is_ours() && self.concluded()? {
            // another version may say the same in other words
            return Ok(());
        }
        let mut tiles = self;
        let tables = self.study.conclude(&mut tiles)?;
        let mut descriptions = Map::new();
        let mut describe = |array: &Chunked| {
            let description = array.description().map_err(|why| self.defect(&array.name, why))?;
            self.settle(&array.description_key(), &pretty(&description))?;
            descriptions.insert(array.name.clone(), description);
            Ok::<(), StoreError>(())
        };
        for (number, (field, array)) in self.layout.fields.iter().zip(&self.layout.arrays).enumerate() {
            if field.name == "label" {
                let labels = self.labels(number)?;
                let array = array_of(field, &self.layout.grid, &labels).map_err(|why| self.defect(field.name, why))?;
                describe(&array)?;
            } else {
                describe(array)?;
            }
        }
        describe(&self.layout.status)?;
        for (array, _) in &self.layout.coordinates {
            describe(array)?;
        }
        for table in &tables {
            let array = array_of_table(table).map_err(|why| self.defect(table.name, why))?;
            let first = vec![0; table.dimensions.len()];
            let bytes = array.encode(&first, &table.values).map_err(|why| self.defect(table.name, why))?;
            self.settle(&array.key(&first), &bytes)?;
            describe(&array)?;
        }
        self.write_root(&descriptions, true)?;
        self.shelf.sweep().map_err(|error| self.unread("", error))
    }

    /// The labels m/n that occur, with their numbers.
    fn labels(&self, field: usize) -> Result<Vec<(i32, String)>, StoreError> {
        let mut codes = BTreeSet::new();
        let mut tiles = self;
        for tile in 0..self.layout.grid.tiles() {
            let column = Tiles::read(&mut tiles, tile, field)?;
            let mut last = None;
            for code in column.whole() {
                if last != Some(*code) {
                    codes.insert(*code);
                    last = Some(*code);
                }
            }
        }
        Ok(codes.into_iter().filter(|code| *code > 0).filter_map(|code| Some((code, label_of(code)?))).collect())
    }
}

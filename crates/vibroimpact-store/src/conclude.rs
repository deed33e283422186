//! The conclusion of a store whose tiles are all complete: the final tables, and the texts of all labels that occur.

use crate::layout::{array_of, array_of_table};
use crate::root::Conclusion;
use crate::{Store, StoreError};
use std::collections::BTreeSet;
use vibroimpact_study::Column;
use vibroimpact_study::study::{StudyTable, Tiles, label_of};

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
    /// Adds the tables and the texts of labels, and marks the store as complete. Objects that already have the right
    /// bytes are not written, so a complete store may be in a place that cannot be written.
    pub(crate) fn conclude(&self) -> Result<(), StoreError> {
        if !self.is_ours() && self.concluded()? {
            // another version may use other texts
            return Ok(());
        }
        let mut tiles = self;
        let conclusion = self.conclusion(&mut tiles)?;
        self.settle_all(&self.descriptions(Some(&conclusion))?)?;
        self.shelf.sweep().map_err(|error| self.unread("", error))
    }

    /// The final tables, computed from complete tiles. Tiles are written again as described at [`Study::conclude`].
    ///
    /// [`Study::conclude`]: vibroimpact_study::Study::conclude
    pub(crate) fn conclusion(&self, tiles: &mut impl Tiles<Error = StoreError>) -> Result<Conclusion, StoreError> {
        let tables = self.study.conclude(tiles)?;
        let mut labelled = Vec::new();
        for (number, field) in self.layout.fields.iter().enumerate().filter(|(_, field)| field.name == "label") {
            let array = array_of(field, &self.layout.grid, &self.labels(number)?);
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

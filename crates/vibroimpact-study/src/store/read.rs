//! A store as arrays in memory, for figures and tables.

use super::{Store, StoreError};
use crate::Block;
use crate::field::Column;

impl Store {
    /// Number of the field of that name.
    #[must_use]
    pub fn field(&self, name: &str) -> Option<usize> {
        self.layout.fields.iter().position(|field| field.name == name)
    }

    /// The columns of a tile, one for each field; of a tile that is not done, what stands for that.
    ///
    /// # Errors
    /// [`StoreError`] when the place cannot be read.
    pub fn tile(&self, tile: u64) -> Result<(Block, Vec<Column>), StoreError> {
        let block = self.study.grid().tile(tile);
        let column = |(number, field): (usize, &crate::Field)| {
            Ok(self.read(tile, number)?.unwrap_or_else(|| field.empty(block.points())))
        };
        let columns = self.layout.fields.iter().enumerate().map(column).collect::<Result<_, StoreError>>()?;
        Ok((block, columns))
    }

    /// The array of a field over the whole grid, in row-major order.
    ///
    /// # Errors
    /// [`StoreError`] when the place cannot be read.
    pub fn column(&self, field: usize) -> Result<Column, StoreError> {
        let grid = self.study.grid();
        let (all, width) = (grid.whole(), self.layout.fields[field].width());
        let mut whole = self.layout.fields[field].empty(all.points());
        for tile in 0..grid.tiles() {
            if let Some(part) = self.read(tile, field)? {
                grid.tile(tile).rows(&all, width, |at, from, len| whole.copy(at, &part, from, len));
            }
        }
        Ok(whole)
    }
}

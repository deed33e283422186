//! The contents of a store as arrays in memory, for figures and tables.

use crate::{Store, StoreError};
use vibroimpact_study::Plan;
use vibroimpact_study::study::StudyArrays;
use vibroimpact_study::{Block, Column, Study};

impl StudyArrays for Store {
    type Error = StoreError;

    fn plan(&self) -> &Plan {
        self.plan()
    }

    fn study(&self) -> &Study {
        self.study()
    }

    fn array(&self, field: usize) -> Result<Column, StoreError> {
        self.column(field)
    }
}

impl Store {
    /// Number of the field with this name.
    #[must_use]
    pub fn field(&self, name: &str) -> Option<usize> {
        self.layout.fields.iter().position(|field| field.name == name)
    }

    /// The columns of a tile, one for each field. A tile that is not complete has fill values.
    ///
    /// # Errors
    /// [`StoreError`] if the place cannot be read, or if the tile is damaged.
    pub fn tile(&self, tile: u64) -> Result<(Block, Vec<Column>), StoreError> {
        let columns = (0..self.layout.fields.len()).map(|field| self.tile_field(tile, field));
        Ok((self.study.grid().tile(tile), columns.collect::<Result<_, StoreError>>()?))
    }

    /// The column of a field in a tile; empty if the tile is not complete.
    ///
    /// # Errors
    /// As for [`Store::tile`].
    pub fn tile_field(&self, tile: u64, field: usize) -> Result<Column, StoreError> {
        let points = || self.study.grid().tile(tile).points();
        Ok(self.kept(tile, field)?.unwrap_or_else(|| self.layout.fields[field].empty(points())))
    }

    /// The array of a field over the whole grid, in row-major order.
    ///
    /// # Errors
    /// [`StoreError`] if the place cannot be read, or if a tile is damaged.
    pub fn column(&self, field: usize) -> Result<Column, StoreError> {
        let grid = self.study.grid();
        let (all, width) = (grid.whole(), self.layout.fields[field].width());
        let mut whole = self.layout.fields[field].empty(all.points());
        for tile in 0..grid.tiles() {
            if let Some(part) = self.kept(tile, field)? {
                grid.tile(tile).rows(&all, width, |at, from, len| whole.copy(at, &part, from, len));
            }
        }
        Ok(whole)
    }

    /// Whether a tile is said to be complete, by its object or by its status, even if they are damaged. In this order,
    /// because the status is written before the object is removed.
    pub(crate) fn claimed(&self, tile: u64) -> Result<bool, StoreError> {
        if let Some(shards) = &self.layout.shards
            && self.get(&shards.loose_key(tile))?.is_some()
        {
            return Ok(true);
        }
        Ok(self.get(&self.layout.status_key(tile))?.is_some())
    }

    /// The column of a field in a tile; `None` if the tile is not complete.
    pub(crate) fn kept(&self, tile: u64, field: usize) -> Result<Option<Column>, StoreError> {
        let found = self.read(tile, field)?;
        if found.is_some() || !self.claimed(tile)? {
            return Ok(found);
        }
        // a damaged chunk of a complete tile is an error; fill values would be taken for results
        let key = self.layout.key(tile, field);
        Err(StoreError::DamagedTile { place: self.place(), tile, key })
    }
}

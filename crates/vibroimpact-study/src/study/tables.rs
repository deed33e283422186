//! What a study concludes in: tables of its cycles, from tiles that are read once more.

use crate::Column;

/// A small array about the whole, over dimensions of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyTable {
    /// Its name.
    pub name: &'static str,
    /// A sentence that says what it is.
    pub long_name: &'static str,
    /// Its unit.
    pub units: &'static str,
    /// Its dimensions and their lengths, the slowest first.
    pub dimensions: Vec<(&'static str, usize)>,
    /// Its values, in row-major order.
    pub values: Cells,
}

/// The values of a [`StudyTable`].
#[derive(Clone, Debug, PartialEq)]
pub enum Cells {
    /// Numbers.
    Numbers(Column),
    /// Words.
    Text(Vec<String>),
}

/// The finished tiles of a study, wherever they are kept.
pub trait Tiles {
    /// Why they cannot be read or written.
    type Error;

    /// Field number `field` of tile number `tile`.
    ///
    /// # Errors
    /// When it cannot be read.
    fn read(&mut self, tile: u64, field: usize) -> Result<Column, Self::Error>;

    /// Replaces field number `field` of tile number `tile`.
    ///
    /// # Errors
    /// When it cannot be written.
    fn write(&mut self, tile: u64, field: usize, column: &Column) -> Result<(), Self::Error>;
}

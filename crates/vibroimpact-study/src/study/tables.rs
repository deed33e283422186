//! The final tables of a study, computed from the complete tiles, and access to its arrays, independent of where they are stored.

use super::Study;
use crate::{Column, Plan, Unit};

/// A small array about the whole study, with dimensions of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyTable {
    /// Its name.
    pub name: &'static str,
    /// One line of text that describes it.
    pub long_name: &'static str,
    /// Its unit.
    pub unit: Unit,
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
    /// Texts.
    Text(Vec<String>),
}

/// Called with the number of a tile and the [counts](Column::counts) of a field in it.
pub type EachCount<'a> = &'a mut dyn FnMut(u64, &[(i32, u64)]);

/// Access to the complete tiles of a study, independent of where they are stored.
pub trait Tiles {
    /// The error of a failed read or write.
    type Error;

    /// Field number `field` of tile number `tile`.
    ///
    /// # Errors
    /// If it cannot be read.
    fn read(&mut self, tile: u64, field: usize) -> Result<Column, Self::Error>;

    /// Calls `each` for each of the `tiles` tiles, in any order, with the counts of a field of integers.
    ///
    /// # Errors
    /// If one cannot be read.
    fn counts(&mut self, tiles: u64, field: usize, each: EachCount<'_>) -> Result<(), Self::Error> {
        for tile in 0..tiles {
            each(tile, &self.read(tile, field)?.counts());
        }
        Ok(())
    }

    /// Replaces field number `field` of tile number `tile`.
    ///
    /// # Errors
    /// If it cannot be written.
    fn write(&mut self, tile: u64, field: usize, column: &Column) -> Result<(), Self::Error>;
}

/// Read access to the arrays of a study; implemented by stores.
pub trait StudyArrays {
    /// The error of a failed read.
    type Error;

    /// The plan of the study.
    fn plan(&self) -> &Plan;

    /// The study.
    fn study(&self) -> &Study;

    /// The whole array of a field, in row-major order (the first dimension slowest).
    ///
    /// # Errors
    /// If the array cannot be read.
    fn array(&self, field: usize) -> Result<Column, Self::Error>;

    /// The number of the field with this name.
    fn field_number(&self, name: &str) -> Option<usize> {
        self.study().fields().iter().position(|field| field.name == name)
    }
}

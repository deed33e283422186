//! The arrays of a study over its whole grid, wherever they are kept.

use super::Study;
use crate::{Column, Plan};

/// Reads the arrays of a study; a store implements it.
pub trait StudyArrays {
    /// Why an array cannot be read.
    type Error;

    /// The plan of the study.
    fn plan(&self) -> &Plan;

    /// The study.
    fn study(&self) -> &Study;

    /// The whole array of a field, the first of the dimensions slowest.
    ///
    /// # Errors
    /// When it cannot be read.
    fn array(&self, field: usize) -> Result<Column, Self::Error>;

    /// The number of the field of this name.
    fn field_number(&self, name: &str) -> Option<usize> {
        self.study().fields().iter().position(|field| field.name == name)
    }
}

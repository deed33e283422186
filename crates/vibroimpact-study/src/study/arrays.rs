//! Access to the arrays of a study over its whole grid, independent of where they are stored.

use super::Study;
use crate::Column;
use crate::Plan;

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

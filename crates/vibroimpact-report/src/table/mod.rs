//! Tables: a header, commas, a line feed after each row; numbers in the shortest form that reads back as the same double.

pub mod attractors;
pub mod basin;
pub mod branch;
pub mod curve;
pub mod diagram;
pub mod map;
pub mod region;
pub mod section;
pub mod waveform;

use core::fmt;
use std::io::{self, Write};

/// A table that is made row by row.
pub struct Table<'a> {
    /// Names of the columns, commas between.
    pub header: String,
    /// The rows, commas between the cells of each.
    pub rows: Box<dyn Iterator<Item = String> + 'a>,
}

impl<'a> Table<'a> {
    /// The same with its rows in memory, where what they are made from does not last.
    #[must_use]
    pub fn kept(self) -> Table<'static> {
        let rows: Vec<String> = self.rows.collect();
        Table { header: self.header, rows: Box::new(rows.into_iter()) }
    }

    /// Of a header and rows.
    #[must_use]
    pub fn new(header: String, rows: impl Iterator<Item = String> + 'a) -> Self {
        Self { header, rows: Box::new(rows) }
    }

    /// Writes the header and all rows.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write(self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "{}", self.header)?;
        for row in self.rows {
            writeln!(out, "{row}")?;
        }
        Ok(())
    }
}

impl fmt::Debug for Table<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Table").field("header", &self.header).finish_non_exhaustive()
    }
}

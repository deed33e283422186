//! Tables with a header, commas, and a line feed after each row. Numbers have the shortest form that reads back as the
//! same double.

pub(crate) mod cycles;
pub(crate) mod remarks;
pub mod waveform;

use crate::number::Number;
use core::fmt;
use std::io::{self, Write};
use vibroimpact::math::Multiplier;

/// The multipliers of a cycle, one row each.
pub(crate) fn multipliers(all: Vec<Multiplier>) -> Table<'static> {
    let row = |m: Multiplier| format!("{},{}", Number(m.re), Number(m.im));
    Table::new("re,im".to_owned(), all.into_iter().map(row))
}

/// A table whose rows are made one by one.
pub struct Table<'a> {
    /// The names of the columns, separated by commas.
    pub header: String,
    /// The rows, with cells separated by commas.
    pub rows: Box<dyn Iterator<Item = String> + 'a>,
}

impl<'a> Table<'a> {
    /// The same table with its rows in memory, for data that are dropped before the table.
    pub(crate) fn kept(self) -> Table<'static> {
        let rows: Vec<String> = self.rows.collect();
        Table { header: self.header, rows: Box::new(rows.into_iter()) }
    }

    /// A table with a header and rows.
    pub(crate) fn new(header: String, rows: impl Iterator<Item = String> + 'a) -> Self {
        Self { header, rows: Box::new(rows) }
    }

    /// Writes the header and all rows.
    ///
    /// # Errors
    /// The errors of `out`.
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

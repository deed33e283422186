//! Tables with a header, commas, and a line feed after each row. Numbers have the shortest form that reads back as the
//! same double.

pub(crate) mod cycles;
pub mod waveform;

use crate::answer::Told;
use crate::json::event::Stops;
use crate::number::Number;
use core::fmt;
use std::io::{self, Write};
use vibroimpact::math::Multiplier;
use vibroimpact::verdict::Verdict;

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

/// The stops that stay closed for ever in a motion, and the number of events over which chaos was seen.
pub(crate) type Remark = (Vec<usize>, Option<u64>);

/// The names of stops with blanks between, after a comma.
fn stops_of(system: &impl Stops, stops: &[usize]) -> String {
    format!(",{}", stops.iter().map(|stop| system.name_of_stop(*stop)).collect::<Vec<_>>().join(" "))
}

/// The columns that say more of some labels than the label, where such motions are in a table: the stops that stay closed for ever,
/// and the number of events over which chaos was seen.
#[derive(Clone, Copy)]
pub(crate) struct Remarks {
    stops: bool,
    events: bool,
}

impl Remarks {
    pub(crate) fn of(motions: impl Iterator<Item = Remark>) -> Self {
        motions.fold(Self { stops: false, events: false }, |so_far, (stops, events)| Self {
            stops: so_far.stops || !stops.is_empty(),
            events: so_far.events || events.is_some(),
        })
    }

    pub(crate) fn heads(self) -> impl Iterator<Item = &'static str> {
        [("stop", self.stops), ("seen_events", self.events)].into_iter().filter_map(|(name, here)| here.then_some(name))
    }

    /// The cells of a motion, each after a comma.
    pub(crate) fn cells(self, system: &impl Stops, (stops, events): &Remark) -> String {
        let mut cells = String::new();
        if self.stops {
            cells.push_str(&stops_of(system, stops));
        }
        if self.events {
            cells.push_str(&events.map_or_else(|| ",".to_owned(), |events| format!(",{events}")));
        }
        cells
    }
}

/// The remarks on the motions of a table of verdicts.
pub(crate) fn remarks<'a, D: Told<System: 'a>>(verdicts: impl Iterator<Item = &'a Verdict<D::System>>) -> Remarks {
    Remarks::of(verdicts.map(D::remark))
}

//! The columns of the short table of a store of a machine that say more of some labels than the label, as in the table of the
//! command without a store.

use std::io;
use vibroimpact_store::{Store, StoreError};
use vibroimpact_study::study::{closed_of, has_closed};
use vibroimpact_study::{Column, Field};

/// The fields of a store that say more of some labels, where there are such motions.
#[derive(Default)]
pub(super) struct Remarks {
    /// The names of the stops.
    stops: Vec<String>,
    /// The fields of the stops that stay closed for ever, which are one column.
    closed: Vec<usize>,
    /// The field of the number of events over which chaos was seen.
    seen: Option<usize>,
}

impl Remarks {
    /// The remarks of a store with these fields.
    pub(super) fn of(store: &Store, fields: &[Field], failed: impl Fn(&StoreError) -> io::Error) -> io::Result<Self> {
        let Some(machine) = store.plan().machine() else { return Ok(Self::default()) };
        // whether there is a motion with a remark in a field
        let some = |k: usize| {
            let mut some = false;
            store
                .count(k, &mut |_, own| some |= own.iter().any(|(number, _)| *number >= 0))
                .map_err(|error| failed(&error))?;
            Ok::<bool, io::Error>(some)
        };
        let mut closed: Vec<usize> = (0..fields.len()).filter(|k| has_closed(&fields[*k].name)).collect();
        let mut any = false;
        for k in &closed {
            any |= some(*k)?;
        }
        if !any {
            closed.clear();
        }
        let mut seen = fields.iter().position(|field| field.name == "seen_events");
        if let Some(k) = seen {
            seen = some(k)?.then_some(k);
        }
        let (machine, _) = machine.described().map_err(io::Error::other)?;
        Ok(Self { stops: machine.stops().iter().map(|stop| stop.name.clone()).collect(), closed, seen })
    }

    /// Whether field number `k` is a column.
    pub(super) fn has(&self, k: usize) -> bool {
        self.seen == Some(k) || self.is_stop(k)
    }

    /// Whether field number `k` is the column of stops.
    pub(super) fn is_stop(&self, k: usize) -> bool {
        self.closed.first() == Some(&k)
    }

    /// The names of the stops of a motion, which is number `at` in its columns.
    pub(super) fn stops(&self, columns: &[Column], at: usize) -> String {
        let closed = closed_of(self.closed.iter().map(|k| columns[*k].whole()[at]));
        let name = |stop: usize| self.stops.get(stop).map_or("", String::as_str);
        closed.into_iter().map(name).collect::<Vec<_>>().join(" ")
    }
}

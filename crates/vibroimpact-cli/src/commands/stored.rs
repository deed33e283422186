//! Common part of the commands that fill a store: run, report the numbers of tiles, and write tables and figures.

use crate::commands::outputs::Outputs;
use crate::failure::Failure;
use crate::report::stored as report;
use crate::session::Session;
use serde::Serialize;
use vibroimpact_report::figure::coloured::Coloured;
use vibroimpact_report::figure::stored::figure;
use vibroimpact_store::{Part, Ran, Store, StoreError, shelf};
use vibroimpact_study::{StudyPlan, counted};

/// The fields about the store in a JSON object.
#[derive(Serialize)]
pub(super) struct Filled {
    store: String,
    tiles: u64,
    /// Tiles that this run computed.
    computed: u64,
    /// Tiles that were already complete.
    found: u64,
    /// Among the computed tiles, those that were damaged before.
    mended: u64,
    /// Missing tiles of other parts.
    left: u64,
}

/// Opens the store at a place.
pub(super) fn open(place: &str) -> Result<Store, Failure> {
    Ok(Store::open(shelf(place)?)?)
}

/// Opens the store of a plan, and creates it if absent.
fn begin(plan: &StudyPlan, place: &str) -> Result<Store, Failure> {
    Ok(Store::create(shelf(place)?, plan)?)
}

/// Computes the missing tiles of a part, and prints their numbers.
pub(super) fn fill(store: &Store, part: Part, session: &Session) -> Result<Filled, Failure> {
    let grid = store.study().grid();
    let total = if part == Part::ALL { grid.points() } else { part.points(grid) };
    let ran: Result<Ran, StoreError> = session.tiled(total, "points", |control, _| store.run(part, control));
    let Ran { computed, found, mended, left } = ran?;
    let filled = Filled { store: store.place(), tiles: grid.tiles(), computed, found, mended, left };
    session.note(&filled.sentence());
    Ok(filled)
}

impl Filled {
    fn sentence(&self) -> String {
        let mut text = format!("{}: {} of {} computed", self.store, self.computed, counted(self.tiles, "tile"));
        if self.mended > 0 {
            text.push_str(&format!(", {} of them because of damage", self.mended));
        }
        if self.found > 0 {
            text.push_str(&format!(", {} found there", self.found));
        }
        text.push_str(&match self.left {
            0 => "; complete".to_owned(),
            left => format!("; {left} left to other parts"),
        });
        text
    }
}

/// Fills a store according to the flags of a command, then writes the requested outputs from it.
pub(super) fn run(
    plan: &StudyPlan,
    place: &str,
    part: Part,
    (outputs, colour): (Outputs, Option<Coloured>),
    session: &Session,
) -> Result<(), Failure> {
    let store = begin(plan, place)?;
    let filled = fill(&store, part, session)?;
    if filled.left > 0 && outputs.any_file() {
        session.note("hint: tables and figures are written when all tiles are there: `vibro export`, `vibro plot`");
        return Ok(());
    }
    let (json, silent) = (outputs.json(), outputs.any());
    outputs.stream(session, |out| report::table(&store, false, out), || figure(&store, colour.as_ref()))?;
    if json {
        return session.print_json(&report::StoredFields::new(&store, Some(filled))?);
    }
    if silent || filled.left > 0 {
        return Ok(());
    }
    session.print(&report::summary(&store)?)
}

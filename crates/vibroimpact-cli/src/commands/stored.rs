//! Common part of the commands that fill a store: run, report the numbers of tiles, and write tables and figures.

use crate::args::{Filling, end};
use crate::commands::outputs::Outputs;
use crate::failure::Failure;
use crate::report::stored as report;
use crate::session::Session;
use serde::Serialize;
use std::sync::Arc;
use vibroimpact_report::Shown;
use vibroimpact_report::figure::overlay::Overlay;
use vibroimpact_report::figure::stored::figure;
use vibroimpact_store::{Memory, Part, Ran, Store, StoreError, costs_beside, shelf};
use vibroimpact_study::study::check_memory;
use vibroimpact_study::{Control, Plan, Study, System, counted};

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
    /// Missing tiles: those of other parts, and those for which there was no time.
    left: u64,
    /// Whether the time was spent before all tiles of this part were complete. The command then ends without an object.
    #[serde(skip)]
    spent: bool,
}

/// Opens the store at a place.
pub(super) fn open(place: &str) -> Result<Store, Failure> {
    Ok(Store::open(shelf(place)?)?.with_costs(costs_beside(place)?))
}

/// Opens the store of a plan, and creates it if absent.
fn begin(plan: &Plan, place: &str) -> Result<Store, Failure> {
    Ok(Store::create(shelf(place)?, plan)?.with_costs(costs_beside(place)?))
}

/// Computes the missing tiles of a part, and prints their numbers.
pub(super) fn fill(store: &Store, filling: &Filling<'_>, session: &Session) -> Result<Filled, Failure> {
    let (grid, part) = (store.study().grid(), filling.part);
    let until = filling.budget.and_then(end);
    let total = store.points_of(part);
    let ran: Result<Ran, StoreError> =
        session.tiled(total, "points", |control, _| store.run_until(part, until, control));
    let Ran { computed, found, mended, left, spent } = ran?;
    let filled = Filled { store: store.place(), tiles: grid.tiles(), computed, found, mended, left, spent };
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
            left if self.spent => format!("; {left} left"),
            left => format!("; {left} left to other parts"),
        });
        text
    }

    /// The end of the command: a run whose time was spent is stopped.
    pub(super) fn end(&self) -> Result<(), Failure> {
        if !self.spent {
            return Ok(());
        }
        let done = self.tiles - self.left;
        Err(Failure::Stopped(format!(
            "the budget is spent, {done} of {} are there; `vibro resume {}` goes on",
            counted(self.tiles, "tile"),
            self.store
        )))
    }
}

/// Refuses what the figure of a study cannot show.
pub(super) fn check_overlay(overlay: &Overlay, plan: &Plan, coloured: bool) -> Result<(), Failure> {
    match &plan.system {
        System::Oscillator(_) => Ok(overlay.check(plan, coloured)?),
        System::Machine(_) if overlay.plain() => Ok(()),
        System::Machine(_) => Err(Failure::bad("--layers, --mark and --line are for maps without --machine")),
    }
}

/// Fills a store according to the flags of a command, then writes the requested outputs from it.
pub(super) fn run(
    plan: &Plan,
    filling: &Filling<'_>,
    (outputs, shown): (Outputs, Shown),
    session: &Session,
) -> Result<(), Failure> {
    let store = begin(plan, filling.place)?;
    let filled = fill(&store, filling, session)?;
    filled.end()?;
    if filled.left > 0 && outputs.any_file() {
        session.note("hint: tables and figures are written when all tiles are there: `vibro export`, `vibro plot`");
        return Ok(());
    }
    tell(&store, Some(filled), (outputs, shown), session)
}

/// Computes a study, in a store if one is named, and writes the requested outputs.
pub(super) fn filled(
    plan: &Plan,
    filling: Option<Filling<'_>>,
    outputs: (Outputs, Shown),
    session: &Session,
) -> Result<(), Failure> {
    match filling {
        Some(filling) => run(plan, &filling, outputs, session),
        None => run_in_memory(plan, outputs, session),
    }
}

/// Computes a study in memory, and writes the requested outputs.
fn run_in_memory(plan: &Plan, (outputs, shown): (Outputs, Shown), session: &Session) -> Result<(), Failure> {
    // before anything is allocated
    check_memory(&Study::new(plan)?)?;
    let store = Store::create(Arc::new(Memory::default()), plan)?;
    let total = store.study().grid().points();
    session.tiled(total, "points", |control, _| store.run(Part::ALL, control))?;
    tell(&store, None, (outputs, shown), session)
}

/// Writes the table and the figure of a store, then the JSON object or the summary.
fn tell(
    store: &Store,
    filled: Option<Filled>,
    (outputs, shown): (Outputs, Shown),
    session: &Session,
) -> Result<(), Failure> {
    let (json, silent) = (outputs.json(), outputs.any());
    let drawn = |control: &Control<'_>| figure(store, shown.colour.as_ref(), &shown.overlay, control);
    outputs.stream(session, |out| report::table(store, false, out), || session.watched(None, drawn))?;
    let left = filled.as_ref().is_some_and(|filled| filled.left > 0);
    if json {
        // a store has its points itself
        if filled.is_none()
            && let Some(object) = report::points(store)?
        {
            return session.print_json(&object);
        }
        return session.print_json(&report::StoredFields::new(store, filled)?);
    }
    if silent || left {
        return Ok(());
    }
    session.print(&report::summary(store)?)
}

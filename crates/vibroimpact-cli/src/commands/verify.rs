//! `vibro verify`: the verification of a store against its plan.

use super::stored;
use crate::args::whole;
use crate::failure::Failure;
use crate::session::Session;
use clap::Args;
use serde::Serialize;
use vibroimpact_store::Verified;
use vibroimpact_study::counted;

/// Check a store: its metadata, all check sums, and a sample of tiles that are computed again
///
/// The store is not changed. `vibro resume` mends what is damaged. The exit code is 1 if anything is wrong.
#[derive(Clone, Debug, Args)]
pub(crate) struct Verify {
    /// The store
    #[arg(value_name = "STORE")]
    store: String,

    /// Tiles to compute again and compare byte by byte
    #[arg(long, value_parser = whole::<u64>, value_name = "N", default_value_t = 8)]
    sample: u64,

    /// Which sample
    #[arg(long, value_parser = whole::<u64>, value_name = "S", default_value_t = 1)]
    seed: u64,

    /// Print one JSON object instead of text
    #[arg(long, help_heading = "Output")]
    json: bool,
}

#[derive(Serialize)]
struct VerifyFields {
    store: String,
    checked: u64,
    recomputed: u64,
    open: u64,
    damage: Vec<Wrong>,
}

#[derive(Serialize)]
struct Wrong {
    /// `None` for a fault of the whole store.
    tile: Option<u64>,
    what: String,
}

pub(super) fn run(args: &Verify, session: &Session) -> Result<(), Failure> {
    let store = stored::open(&args.store)?;
    let found = session.tiled(store.sample_points(args.sample), "points", |control, _| {
        store.verify(args.sample, args.seed, control)
    })?;
    let Verified { checked, recomputed, open, damage } = found;
    let (count, place) = (damage.len(), store.place());
    if args.json {
        let damage = damage.into_iter().map(|wrong| Wrong { tile: wrong.tile, what: wrong.what }).collect();
        session.print_json(&VerifyFields { store: place.clone(), checked, recomputed, open, damage })?;
    } else {
        let mut text = format!("check sums read: {}; computed again: {recomputed}\n", counted(checked, "tile"));
        if open > 0 {
            text.push_str(&format!("not computed yet: {}\n", counted(open, "tile")));
        }
        for wrong in &damage {
            let of = wrong.tile.map_or_else(String::new, |tile| format!("tile {tile}: "));
            text.push_str(&format!("{of}{}\n", wrong.what));
        }
        if damage.is_empty() {
            text.push_str("nothing is wrong\n");
        }
        session.print(&text)?;
    }
    if count == 0 {
        return Ok(());
    }
    let faults = counted(count as u64, "fault");
    Err(Failure::Failed(format!("{faults} in {place}\nhint: `vibro resume {place}` writes anew what is damaged")))
}

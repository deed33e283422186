//! `vibro resume`: computes the missing tiles of a store.

use super::stored;
use crate::args::{BudgetArgs, Filling, tiles};
use crate::failure::Failure;
use crate::report::stored as report;
use crate::session::Session;
use clap::Args;
use vibroimpact_store::Part;

/// Compute the tiles of a store that are missing or damaged
///
/// The check sums of all finished tiles are read; a tile that is missing, cut short or altered is computed again. The
/// result is, byte for byte, that of a run without interruption.
#[derive(Clone, Debug, Args)]
pub(crate) struct Resume {
    /// The store
    #[arg(value_name = "STORE")]
    store: String,

    /// Only part I of N of the tiles, for an array of jobs
    #[arg(long, value_parser = tiles, value_name = "I/N")]
    tiles: Option<Part>,

    #[command(flatten)]
    budget: BudgetArgs,

    /// Print one JSON object with what was done
    #[arg(long, help_heading = "Output")]
    json: bool,
}

pub(super) fn run(args: &Resume, session: &Session) -> Result<(), Failure> {
    let store = stored::open(&args.store)?;
    let part = args.tiles.unwrap_or(Part::ALL);
    let filling = Filling { place: &args.store, part, budget: args.budget.get() };
    let filled = stored::fill(&store, &filling, session)?;
    filled.end()?;
    if args.json {
        return session.print_json(&report::StoredFields::new(&store, Some(filled))?);
    }
    Ok(())
}

//! STORE: the store for the results of a grid, which is filled tile by tile.

use super::whole;
use clap::Args;
use std::time::{Duration, Instant};
use vibroimpact_store::Part;
use vibroimpact_study::typed::duration;

#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "Store")]
pub(crate) struct StoreArgs {
    /// Keep the results in a Zarr store in this folder, tile by tile: what is there already is not computed again
    #[arg(long, value_name = "DIR")]
    pub(crate) store: Option<String>,

    /// Points of a tile along each axis, 1 to 4096 [default: by task]
    #[arg(long, value_parser = whole::<u32>, value_name = "N", requires = "store")]
    pub(crate) tile: Option<u32>,

    /// Tiles of a shard along each axis, 1 to 1024; 1 for none [default: shards for more than 4096 tiles]
    #[arg(long, value_parser = whole::<u32>, value_name = "N", requires = "store")]
    pub(crate) shard: Option<u32>,

    /// Begin no tile after this time, as 90s, 30m, 8h or 2d; tiles that were begun are finished, and `vibro resume` goes on
    #[arg(long, value_parser = duration, value_name = "TIME", allow_hyphen_values = true, requires = "store")]
    budget: Option<Duration>,
}

/// The time that a command may use to fill a store.
#[derive(Clone, Debug, Args)]
pub(crate) struct BudgetArgs {
    /// Begin no tile after this time, as 90s, 30m, 8h or 2d; tiles that were begun are finished, and `vibro resume` goes on
    #[arg(long, value_parser = duration, value_name = "TIME", allow_hyphen_values = true, help_heading = "Store")]
    budget: Option<Duration>,
}

impl BudgetArgs {
    pub(crate) const fn get(&self) -> Option<Duration> {
        self.budget
    }
}

/// The moment at which a time is spent, if it begins now.
pub(crate) fn end(budget: Duration) -> Option<Instant> {
    Instant::now().checked_add(budget)
}

/// What fills a store: the place, which part of the tiles, and for how long.
#[derive(Clone, Debug)]
pub(crate) struct Filling<'a> {
    pub(crate) place: &'a str,
    pub(crate) part: Part,
    pub(crate) budget: Option<Duration>,
}

impl StoreArgs {
    /// The filling of the store, if one is named.
    pub(crate) fn filling(&self) -> Option<Filling<'_>> {
        let place = self.store.as_deref()?;
        Some(Filling { place, part: Part::ALL, budget: self.budget })
    }
}

/// Reads `I/N`: part I of N of the tiles.
pub(crate) fn tiles(text: &str) -> Result<Part, String> {
    let bad = || format!("`{}` is not I/N with whole numbers 1 <= I <= N", text.chars().take(60).collect::<String>());
    let (index, of) = text.split_once('/').ok_or_else(bad)?;
    let (Ok(index), Ok(of)) = (index.trim().parse(), of.trim().parse()) else { return Err(bad()) };
    Part::new(index, of).map_err(|_| bad())
}

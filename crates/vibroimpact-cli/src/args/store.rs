//! STORE: the store for the results of a grid, which is filled tile by tile.

use super::whole;
use crate::failure::Failure;
use clap::Args;
use core::str::FromStr;
use vibroimpact_store::Part;
use vibroimpact_study::Plan;

#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "Store")]
pub(crate) struct StoreArgs {
    /// Keep the results in a Zarr store in this folder, tile by tile: what is there already is not computed again
    #[arg(long, value_name = "DIR")]
    pub(crate) store: Option<String>,

    /// Points of a tile along each axis, 1 to 4096 [default: by task]
    #[arg(long, value_parser = whole::<u32>, value_name = "N", requires = "store")]
    pub(crate) tile: Option<u32>,
}

impl StoreArgs {
    /// The plan with the requested size of tiles.
    pub(crate) fn tiled(&self, plan: Plan) -> Result<Plan, Failure> {
        let plan = Plan { tile: self.tile, ..plan };
        plan.check()?;
        Ok(plan)
    }
}

/// `I/N`: part I of N of the tiles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tiles(pub(crate) Part);

impl FromStr for Tiles {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let bad =
            || format!("`{}` is not I/N with whole numbers 1 <= I <= N", text.chars().take(60).collect::<String>());
        let (index, of) = text.split_once('/').ok_or_else(bad)?;
        let (Ok(index), Ok(of)) = (index.trim().parse(), of.trim().parse()) else { return Err(bad()) };
        Part::new(index, of).map(Self).map_err(|_| bad())
    }
}

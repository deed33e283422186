//! What motions of a machine from scattered starts settle into.

use crate::map::{check_impacts, options};
use crate::{Control, PlanError, RunError, limits, tiles};
use vibroimpact::events::Start;
use vibroimpact::lanes::Width;
use vibroimpact::machine::Machine;
use vibroimpact::verdict::{Census, KnownMotions, scattered_machine_starts, settle_machine_many};

/// Starts of a tile.
const TILE: u32 = 4;
/// The same of machines that are oscillators, whose starts share lanes.
const WIDE_TILE: u32 = 256;

/// Checks a number of starts and a budget of events.
pub(crate) fn check_starts(starts: u64, impacts: Option<u32>) -> Result<(), PlanError> {
    limits::starts(starts, limits::MOST_STARTS)?;
    check_impacts(impacts)
}

/// The number of starts of a tile, of a machine or of machines like it.
pub(crate) fn tile(machine: &Machine) -> u32 {
    if machine.reduced().is_some() { WIDE_TILE } else { TILE }
}

/// The distinct motions from scattered starts, and how many lead to each.
pub(super) fn attractors(
    machine: &Machine,
    (starts, seed, impacts): (u64, u64, Option<u32>),
    control: &Control<'_>,
) -> Result<Census<Machine>, RunError> {
    let (options, known) = (options(impacts), KnownMotions::default());
    let parts = tiles(starts, u64::from(tile(machine)), control, |range, tick| {
        let starts: Vec<Start> = range.map(|k| scattered_machine_starts(machine, seed, k)).collect();
        settle_machine_many(machine, &starts, &known, &options, Width::best(), &|| !control.stopping(), &|| tick())
    })?;
    let mut census = Census::default();
    for found in parts.into_iter().flatten().flat_map(|part| part.motions) {
        census.add_found(&found);
    }
    Ok(census)
}

//! What motions of a machine settle into, and their exponents.

use crate::map::{check_impacts, options};
use crate::{Control, PlanError, RunError, Stopped, limits, tiles};
use vibroimpact::events::Start;
use vibroimpact::lanes::Width;
use vibroimpact::machine::{Machine, MachineError};
use vibroimpact::verdict::{
    Census, KnownMotions, Settled, scattered_machine_starts, settle_machine_many, settle_machine_while,
};

/// Starts of a tile.
const TILE: u32 = 4;
/// The same of machines that are oscillators, whose starts share lanes.
const WIDE_TILE: u32 = 256;

pub(super) fn refused(error: MachineError) -> RunError {
    RunError::Plan(PlanError::Machine(error.into()))
}

/// Checks a number of starts and a budget of events.
pub(crate) fn check_starts(starts: u64, impacts: Option<u32>) -> Result<(), PlanError> {
    limits::starts(starts, limits::MOST_STARTS)?;
    check_impacts(impacts)
}

/// The verdict on a motion.
pub(super) fn settle(
    machine: &Machine,
    start: &Start,
    impacts: Option<u32>,
    control: &Control<'_>,
) -> Result<Settled<Machine>, RunError> {
    let settled = settle_machine_while(machine, start, &options(impacts), &|| !control.stopping()).map_err(refused)?;
    settled.ok_or_else(|| Stopped { done: 0, total: 1 }.into())
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

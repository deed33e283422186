//! The motions of one system from many scattered starts, computed by several threads.

use crate::study::{BasinFill, Fill, tiles_of};
use crate::{Control, RunError, SystemPlan, tiles};
use vibroimpact::events::Start;
use vibroimpact::lanes::Width;
use vibroimpact::machine::Machine;
use vibroimpact::verdict::{Census, KnownMotions, SettleOptions, scattered_machine_starts, settle_machine_many};

/// Number of starts of a tile.
const TILE: u32 = 1024;
/// The same of a machine.
const MACHINE_TILE: u32 = 4;
/// The same of machines that are oscillators, whose starts share lanes.
const WIDE_TILE: u32 = 256;

/// Settles scattered starts of the natural box of the system and counts the distinct motions. The result is that of
/// [`vibroimpact::verdict::attractors`], but it is computed by several threads.
pub(crate) fn attractors(
    system: &SystemPlan,
    (starts, seed): (u64, u64),
    options: &SettleOptions,
    control: &Control<'_>,
) -> Result<Census, RunError> {
    let task = BasinFill::scattered(system, (starts, seed), options, Some(TILE))?;
    let mut merged = Census::default();
    for (_, tile) in tiles_of(&task.over().grid, control, |block, tick| task.compute(block, tick))? {
        for found in tile.met.motions() {
            merged.add_found(found);
        }
    }
    Ok(merged)
}

/// The number of starts of a tile, of a machine or of machines like it.
pub(crate) fn tile(machine: &Machine) -> u32 {
    if machine.reduced().is_some() { WIDE_TILE } else { MACHINE_TILE }
}

/// The distinct motions from scattered starts, and how many lead to each.
pub(crate) fn machine_attractors(
    machine: &Machine,
    (starts, seed): (u64, u64),
    options: &SettleOptions,
    control: &Control<'_>,
) -> Result<Census<Machine>, RunError> {
    let known = KnownMotions::default();
    let parts = tiles(starts, u64::from(tile(machine)), control, |range, tick| {
        let starts: Vec<Start> = range.map(|k| scattered_machine_starts(machine, seed, k)).collect();
        settle_machine_many(machine, &starts, &known, options, Width::best(), &|| !control.stopping(), &|| tick())
    })?;
    let mut census = Census::default();
    for found in parts.into_iter().flatten().flat_map(|part| part.motions) {
        census.add_found(&found);
    }
    Ok(census)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// With a small budget more starts are undecided, as with the same budget one after another.
    #[test]
    fn as_one_after_another() {
        let of = SystemPlan::from_inverse_beta;
        let (whole, small) = (SettleOptions::default(), SettleOptions::at_most(50));
        for (system, starts, options) in [(of(0.7, 2.5, 0.5), (100, 3), &whole), (of(1.11, 3.0, 0.5), (30, 1), &small)]
        {
            let serial = vibroimpact::verdict::attractors(&system.oscillator().unwrap(), starts.0, starts.1, options);
            let threaded = attractors(&system, starts, options, &Control::default()).unwrap();
            let summary =
                |c: &Census| c.motions().iter().map(|f| (f.verdict.label().into_owned(), f.count)).collect::<Vec<_>>();
            assert_eq!(summary(&serial), summary(&threaded));
            assert!(starts.0 == 100 || summary(&serial).iter().any(|(label, _)| label == "undecided"));
        }
    }
}

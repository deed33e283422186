//! The motions of one system from many scattered starts, computed by several threads.

use crate::study::{BasinFill, tiles_of};
use crate::{Control, RunError, SystemPlan};
use vibroimpact::verdict::{Census, SettleOptions};

/// Number of starts of a tile.
const TILE: u32 = 1024;
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
    for (_, tile) in tiles_of(&task, control)? {
        for found in tile.met.motions() {
            merged.add_found(found);
        }
    }
    Ok(merged)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_one_after_another() {
        let system = SystemPlan { inverse_beta: Some(0.7), gap: 2.5, restitution: 0.5, ..SystemPlan::default() };
        let osc = system.oscillator().unwrap();
        let serial = vibroimpact::verdict::attractors(&osc, 100, 3, &SettleOptions::default());
        let threaded = attractors(&system, (100, 3), &SettleOptions::default(), &Control::default()).unwrap();
        let summary =
            |c: &Census| c.motions().iter().map(|f| (f.verdict.label().into_owned(), f.count)).collect::<Vec<_>>();
        assert_eq!(summary(&serial), summary(&threaded));
    }

    /// With a small budget more starts are undecided, as with the same budget one after another.
    #[test]
    fn within_a_budget() {
        let system = SystemPlan { inverse_beta: Some(1.11), gap: 3.0, restitution: 0.5, ..SystemPlan::default() };
        let osc = system.oscillator().unwrap();
        let options = SettleOptions::at_most(50);
        let serial = vibroimpact::verdict::attractors(&osc, 30, 1, &options);
        let threaded = attractors(&system, (30, 1), &options, &Control::default()).unwrap();
        let undecided = |census: &Census| {
            census
                .motions()
                .iter()
                .filter(|found| found.verdict.label() == "undecided")
                .map(|found| found.count)
                .sum::<u64>()
        };
        assert!(undecided(&threaded) > 0);
        assert_eq!(undecided(&serial), undecided(&threaded));
    }
}

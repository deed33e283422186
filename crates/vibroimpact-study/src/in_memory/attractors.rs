//! The motions of one system from many scattered starts, computed by several threads.

use crate::study::{BasinFill, tiles_of};
use crate::{Control, RunError, SystemPlan};
use vibroimpact::verdict::Census;

/// Number of starts of a tile.
const TILE: u32 = 1024;
/// Settles scattered starts of the natural box of the system and counts the distinct motions. The result is that of
/// [`vibroimpact::verdict::attractors`], but it is computed by several threads.
pub(crate) fn attractors(
    system: &SystemPlan,
    (starts, seed): (u64, u64),
    control: &Control<'_>,
) -> Result<Census, RunError> {
    let task = BasinFill::scattered(system, (starts, seed), Some(TILE))?;
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
    use vibroimpact::verdict::SettleOptions;

    #[test]
    fn as_one_after_another() {
        let system = SystemPlan { inverse_beta: Some(0.7), gap: 2.5, restitution: 0.5, ..SystemPlan::default() };
        let osc = system.oscillator().unwrap();
        let serial = vibroimpact::verdict::attractors(&osc, 100, 3, &SettleOptions::default());
        let threaded = attractors(&system, (100, 3), &Control::default()).unwrap();
        let summary =
            |c: &Census| c.motions().iter().map(|f| (f.verdict.label().into_owned(), f.count)).collect::<Vec<_>>();
        assert_eq!(summary(&serial), summary(&threaded));
    }
}

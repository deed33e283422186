//! The motions of one system from many scattered starts, over threads.

use crate::{Control, Stopped, tiles};
use vibroimpact::Oscillator;
use vibroimpact::lanes::Width;
use vibroimpact::verdict::{Census, KnownAttractors, SettleOptions, StartBox, scattered_starts, settle_many};

/// Starts of a tile.
const TILE: u64 = 1024;
/// Starts settled beforehand, to know the cycles and their traps ...
const SURVEY: u64 = 24;
/// ... where there are more starts than this.
const WORTH_A_SURVEY: u64 = 500;

/// Settles `starts` scattered starts of the box and counts the distinct motions; the same as
/// [`vibroimpact::verdict::attractors`], but over threads.
///
/// # Errors
/// [`Stopped`] when stopped from outside.
pub(crate) fn attractors(
    osc: &Oscillator,
    area: StartBox,
    (starts, seed): (u64, u64),
    options: &SettleOptions,
    control: &Control<'_>,
) -> Result<Census, Stopped> {
    let start = |index: u64| scattered_starts(osc, area, seed, index);
    // small questions are not worth a survey
    let surveyed = if starts > WORTH_A_SURVEY { SURVEY } else { 0 };
    let survey = KnownAttractors::survey(osc, (0..surveyed).map(start), options);
    let parts = tiles(starts, TILE, control, |range, tick| {
        settle_many(osc, range, start, &survey, options, Width::best(), tick).motions
    })?;
    let mut merged = Census::default();
    for found in parts.iter().flatten() {
        merged.add_found(found);
    }
    Ok(merged)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_one_after_another() {
        let osc = vibroimpact::scenario::Q.oscillator();
        let options = SettleOptions::default();
        let serial = vibroimpact::verdict::attractors(&osc, 100, 3, &options);
        let threaded = attractors(&osc, StartBox::natural(&osc), (100, 3), &options, &Control::default()).unwrap();
        let summary =
            |c: &Census| c.motions().iter().map(|f| (f.verdict.label().into_owned(), f.count)).collect::<Vec<_>>();
        assert_eq!(summary(&serial), summary(&threaded));
    }
}

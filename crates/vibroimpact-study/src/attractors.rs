//! The motions of one system from many scattered starts, over threads.

use crate::{Control, Stopped, tiles};
use vibroimpact::Oscillator;
use vibroimpact::verdict::{Census, SettleOptions, StartBox, scattered_starts, settle};

/// Settles `starts` scattered starts of the box and counts the distinct motions; the same as
/// [`vibroimpact::verdict::attractors`], but over threads.
///
/// # Errors
/// [`Stopped`] when stopped from outside.
pub fn attractors(
    osc: &Oscillator,
    area: StartBox,
    (starts, seed): (u64, u64),
    options: &SettleOptions,
    control: &Control<'_>,
) -> Result<Census, Stopped> {
    let parts = tiles(starts, 16, control, |range, tick| {
        let mut census = Census::default();
        for index in range {
            census.add(&settle(osc, scattered_starts(osc, area, seed, index), options).verdict);
            if tick() {
                break;
            }
        }
        census
    })?;
    let mut merged = Census::default();
    for found in parts.iter().flat_map(|part| part.motions()) {
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

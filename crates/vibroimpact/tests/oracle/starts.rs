//! Random starts. An ordinary run asks twenty thousand; `VIBROIMPACT_LONG=1` asks a hundred thousand, the same ones among
//! them.

use super::case::Case;
use super::long::is_long;
use super::random::Random;
use super::referee::verdict;
use super::tally::on_all_cores;
use core::f64::consts::TAU;
use vibroimpact::flight::SearchLimits;

const STARTS: u64 = 10_000;
const STARTS_LONG: u64 = 100_000;
/// Cells an ordinary question may take; fifty periods of the slower motion where they fit.
const CELLS: f64 = 1500.0;

/// Fifty periods of the slower of force and oscillator; for most questions no more than [`CELLS`] cells.
pub(crate) fn horizon(case: &Case, long: bool) -> f64 {
    let cell = 0.7 / (1.0 + 2.0 * case.zeta).max(case.beta.sqrt());
    let whole = 50.0 * TAU * (1.0 / case.beta).max(1.0);
    if long { whole } else { whole.min(CELLS * cell) }
}

/// That time in periods of the slower motion.
pub(crate) fn periods(case: &Case, horizon: f64) -> f64 {
    horizon / TAU * case.beta.min(1.0)
}

#[test]
fn random_starts() {
    let starts = if is_long() { STARTS_LONG } else { STARTS };
    let tally = on_all_cores(starts, 200, |index, tally| {
        let case = Random::new(1, index).case();
        let horizon = horizon(&case, index % 64 == 0);
        let mut limits = SearchLimits::default();
        if index % 8 != 0 {
            // looking much further than the referee does takes time and proves nothing
            limits.periods = limits.periods.min(periods(&case, 1.1 * horizon));
        }
        tally.add(case, verdict(&case, limits, horizon));
    });
    println!("{tally}");
    assert!(
        tally.total() == starts
            && tally.impacts > starts / 2
            && tally.never > starts / 20
            && tally.until > starts / 2000
    );
    tally.expect_no_fault();
}

//! The attractors of many starts as text.

use crate::report::certainty::certainty;
use crate::report::leading::leading;
use crate::report::words::{by_stop, meaning, multipliers, table};
use vibroimpact::Oscillator;
use vibroimpact::quantities::{Quantity, of_verdict};
use vibroimpact::verdict::{Census, CountedMotion, StartBox, Verdict};
use vibroimpact_report::Units;
use vibroimpact_report::number::{percent, short};

/// The box of the starts, and one row for each motion.
pub(crate) fn text(census: &Census, starts: u64, osc: &Oscillator, units: &Units) -> String {
    let StartBox { x, v, .. } = StartBox::natural(osc);
    let heads = ["share", "starts", "<label", "multipliers", "impact speed", "power in", "<meaning"].map(str::to_owned);
    let row = |found: &&CountedMotion| {
        let all = of_verdict(osc, &found.verdict);
        let of = |quantity| all.map_or_else(|| "-".into(), |all| units.text(&all, quantity));
        vec![
            percent(census.share(found)),
            found.count.to_string(),
            found.verdict.label().into_owned(),
            found.verdict.multipliers(osc).map_or_else(|| "-".into(), multipliers),
            of(Quantity::ImpactSpeedMax),
            of(Quantity::Power),
            meaning(&found.verdict) + &by_stop(&found.verdict, osc),
        ]
    };
    let undecided = |found: &&CountedMotion| matches!(found.verdict, Verdict::Undecided(_));
    let motions = leading(census.by_share(), |found| census.share(found), undecided);
    let rows = motions.rows(row, "motion", (2, 0, heads.len()));
    let head = format!(
        "starts  {starts} in x {} to {}, v {} to {}, all phases\n\n",
        short(x.0 * units.length()),
        short(x.1 * units.length()),
        short(v.0 * units.velocity()),
        short(v.1 * units.velocity())
    );
    head + &table(&heads, &rows) + &certainty(census.by_share().iter().map(|found| found.count), census.total())
}

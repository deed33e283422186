//! The attractors of many starts as text.

use crate::report::certainty::certainty;
use crate::report::leading::leading;
use crate::report::motion::{InUnits, Teller};
use crate::report::words::{multipliers, table};
use vibroimpact::Oscillator;
use vibroimpact::machine::Machine;
use vibroimpact::quantities::Quantity;
use vibroimpact::verdict::{Census, CountedMotion, StartBox, Verdict};
use vibroimpact_report::Units;
use vibroimpact_report::number::{percent, short};

/// The box of the starts, and one row for each motion.
pub(crate) fn text(census: &Census, starts: u64, osc: &Oscillator, units: &Units) -> String {
    let StartBox { x, v, .. } = StartBox::natural(osc);
    let head = format!(
        "starts  {starts} in x {} to {}, v {} to {}, all phases\n\n",
        short(x.0 * units.length()),
        short(x.1 * units.length()),
        short(v.0 * units.velocity()),
        short(v.1 * units.velocity())
    );
    head + &rows(&InUnits(osc, units), census)
}

/// The same of a machine.
pub(crate) fn of_machine(census: &Census<Machine>, machine: &Machine) -> String {
    format!("starts  {}\n\n", census.total()) + &rows(machine, census)
}

/// One row for each motion, and how certain the shares are.
fn rows<T: Teller>(teller: &T, census: &Census<T::System>) -> String {
    let heads = ["share", "starts", "<label", "multipliers", "impact speed", "power in", "<meaning"].map(str::to_owned);
    let row = |found: &&CountedMotion<T::System>| {
        let verdict = &found.verdict;
        let all = teller.multipliers(verdict).filter(|all| !all.is_empty());
        vec![
            percent(census.share(found)),
            found.count.to_string(),
            verdict.label().into_owned(),
            all.map_or_else(|| "-".into(), |all| multipliers(&all)),
            teller.quantity(verdict, Quantity::ImpactSpeedMax),
            teller.quantity(verdict, Quantity::Power),
            teller.meaning(verdict) + &teller.by_stop(verdict),
        ]
    };
    let undecided = |found: &&CountedMotion<T::System>| matches!(found.verdict, Verdict::Undecided(_));
    let motions = leading(census.by_share(), |found| census.share(found), undecided);
    let rows = motions.rows(row, "motion", (2, 0, heads.len()));
    table(&heads, &rows) + &certainty(census.by_share().iter().map(|found| found.count), census.total())
}

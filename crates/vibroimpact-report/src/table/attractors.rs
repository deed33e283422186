//! The attractors: one row for each, the most frequent first.

use super::Table;
use super::cycle::{drifts, numbered, parts};
use super::quantities::{cells, columns, finite};
use super::remarks::remarks;
use crate::Units;
use crate::json::motion::multipliers;
use crate::number::Number;
use vibroimpact::Oscillator;
use vibroimpact::machine::Machine;
use vibroimpact::orbit::machine::Cycle;
use vibroimpact::quantities::{Quantity, machine_quantities, machine_quantity_paths, of_verdict};
use vibroimpact::verdict::{Census, Verdict};

/// Label, share and number of the starts, real and imaginary part of both multipliers if the motion has any, and all
/// quantities in these units.
#[must_use]
pub fn table(found: &Census, osc: &Oscillator, units: &Units) -> Table<'static> {
    let row = |motion: &&vibroimpact::verdict::CountedMotion| {
        let parts = parts(&motion.verdict.multipliers(osc).map_or_else(Vec::new, |both| multipliers(&both)), 2);
        let quantities = cells(&Quantity::ALL, of_verdict(osc, &motion.verdict), units);
        format!("{},{},{}{parts}{quantities}", motion.verdict.label(), Number(found.share(motion)), motion.count)
    };
    let rows: Vec<String> = found.by_share().iter().map(row).collect();
    let header = ["label", "share", "starts"].map(str::to_owned).into_iter().chain(numbered(2)).collect::<Vec<_>>();
    Table::new(format!("{}{}", header.join(","), columns(&Quantity::ALL, units)), rows.into_iter())
}

/// One row a motion: label, share, starts, counts of each stop, real and imaginary part of all multipliers, the drift of a
/// machine that can be translated, all quantities by path.
pub(crate) fn of_machine<'a>(machine: &'a Machine, census: &'a Census<Machine>) -> Table<'a> {
    let stops = machine.stops().iter().map(|stop| format!("count.{}", stop.name));
    let paths = machine_quantity_paths(machine);
    let undefined = vec![f64::NAN; paths.len()];
    let header =
        ["label", "share", "starts"].into_iter().map(str::to_owned).chain(stops).chain(numbered(2 * machine.n()));
    let drifting =
        census.motions().iter().any(|found| cycle_of(&found.verdict).is_some_and(|cycle| cycle.translations() > 0));
    let remarks = remarks(census.motions().iter().map(|found| &found.verdict));
    let header = header.chain(drifts(machine).filter(|_| drifting)).chain(remarks.heads().map(str::to_owned));
    let header = header.chain(paths).collect::<Vec<_>>().join(",");
    let rows = census.by_share().into_iter().map(move |found| {
        let mut row = format!("{},{},{}", found.verdict.label(), Number(census.share(found)), found.count);
        let cycle = cycle_of(&found.verdict);
        let (counts, factors) = (cycle.map(|cycle| &cycle.counts), cycle.map(|cycle| multipliers(&cycle.multipliers)));
        for k in 0..machine.stops().len() {
            row.push_str(&counts.map_or_else(|| ",".to_owned(), |counts| format!(",{}", counts[k])));
        }
        row.push_str(&parts(&factors.unwrap_or_default(), 2 * machine.n()));
        if drifting {
            let undefined = vec![f64::NAN; machine.n()];
            row.push_str(&finite(cycle.map_or(&undefined, |cycle| &cycle.drift)));
        }
        row.push_str(&remarks.cells(machine, &found.verdict.closed(), found.verdict.seen_events()));
        let values = machine_quantities(machine, &found.verdict)
            .map_or_else(|| undefined.clone(), |found| found.iter().map(|(.., measured)| measured.value).collect());
        row.push_str(&finite(&values));
        row
    });
    Table::new(header, rows)
}

const fn cycle_of(verdict: &Verdict<Machine>) -> Option<&Cycle> {
    match verdict {
        Verdict::Periodic(cycle) => Some(cycle),
        _ => None,
    }
}

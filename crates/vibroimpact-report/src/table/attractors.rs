//! The attractors: one row for each, the most frequent first.

use super::Table;
use super::orbits::{drifts, finite, numbered, parts};
use super::remarks::remarks;
use crate::FieldName;
use crate::answer::{AnswerOf, Told};
use crate::json::motion::multipliers;
use crate::number::Number;
use vibroimpact::verdict::Census;
use vibroimpact_study::Name;

/// The table of `vibro attractors`: label, share, starts, of a machine the counts of each stop, real and imaginary part of all
/// multipliers if the motion has any, the drift of a machine that can be translated, what stops and events say more of the label, all
/// quantities.
pub(crate) fn table<'a, D: Told>(of: &'a AnswerOf<D>, census: &'a Census<D::System>) -> Table<'a> {
    let (machine, system) = (D::machine(of), &of.system);
    let (n, stops) = machine.map_or((1, 0), |machine| (machine.n(), machine.stops().len()));
    let quantities: Vec<D::Quantity> =
        D::quantity_names(system).iter().filter_map(|name| D::Quantity::of(name).ok()).collect();
    let cycle_of = |found| D::cycle_of_machine(found).filter(|cycle| cycle.translations() > 0);
    let drifting = census.motions().iter().any(|found| cycle_of(&found.verdict).is_some());
    let remarks = remarks::<D>(census.motions().iter().map(|found| &found.verdict));
    let counts = machine.into_iter().flat_map(|machine| machine.stops()).map(|stop| format!("count.{}", stop.name));
    let drift = machine.into_iter().flat_map(drifts).filter(|_| drifting);
    let header: Vec<String> = (["label", "share", "starts"].map(str::to_owned).into_iter().chain(counts))
        .chain(numbered(2 * n).chain(drift).chain(remarks.heads().map(str::to_owned)))
        .chain(quantities.iter().map(|quantity| quantity.column(&of.units)))
        .collect();
    let rows = census.by_share().into_iter().map(move |found| {
        let mut row = format!("{},{},{}", found.verdict.label(), Number(census.share(found)), found.count);
        let cycle = D::cycle_of_machine(&found.verdict);
        for k in 0..stops {
            row.push_str(&cycle.map_or_else(|| ",".to_owned(), |cycle| format!(",{}", cycle.counts[k])));
        }
        row.push_str(&parts(&multipliers(&D::multipliers(of, &found.verdict)), 2 * n));
        if drifting {
            row.push_str(&finite(cycle.map_or(&vec![f64::NAN; n], |cycle| &cycle.drift)));
        }
        row.push_str(&remarks.cells(system, &D::remark(&found.verdict)));
        let values = D::quantities(system, &found.verdict).unwrap_or_else(|| vec![f64::NAN; quantities.len()]);
        let scaled = values.iter().zip(&quantities).map(|(value, quantity)| value * quantity.unit(&of.units));
        row + &finite(&scaled.collect::<Vec<_>>())
    });
    Table::new(header.join(","), rows)
}

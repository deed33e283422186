//! The attractors to which scattered starts lead, and their shares.

use crate::json::motion::{SharedMotion, multipliers};
use crate::number::{Number, percent};
use crate::table::cycles::{drifts, finite, numbered, parts};
use crate::table::remarks;
use crate::task::certainty::{Certainty, certainty};
use crate::text::Teller;
use crate::text::words::leading;
use crate::text::words::{self, aligned};
use crate::{AnswerOf, FieldName, Table, Told, Units};
use schemars::JsonSchema;
use serde::Serialize;
use vibroimpact::Oscillator;
use vibroimpact::quantities::Quantity;
use vibroimpact::verdict::{Census, CountedMotion, StartBox, Verdict};
use vibroimpact_study::Name;

/// The answer to `vibro attractors`.
#[derive(JsonSchema, Serialize)]
pub(crate) struct AttractorsAnswer<'a> {
    /// The motions, the most frequent first.
    motions: Vec<SharedMotion<'a>>,
    #[serde(flatten)]
    certainty: Certainty,
    /// The number of starts.
    starts: u64,
    /// The seed of their sequence.
    seed: u64,
    /// The box of the starts of an oscillator.
    #[serde(rename = "box", skip_serializing_if = "Option::is_none")]
    area: Option<Area>,
}

/// The box of scattered starts.
#[derive(JsonSchema, Serialize)]
pub struct Area {
    x: (f64, f64),
    v: (f64, f64),
    phase: (f64, f64),
}

impl Area {
    /// The natural box of an oscillator.
    pub(crate) fn natural(osc: &Oscillator, units: &Units) -> Self {
        let area = StartBox::natural(osc);
        let scaled = |(a, b): (f64, f64), unit: f64| (a * unit, b * unit);
        Self { x: scaled(area.x, units.length()), v: scaled(area.v, units.velocity()), phase: area.phase }
    }
}

impl<'a> AttractorsAnswer<'a> {
    /// The motions of a sequence of starts.
    pub(crate) fn new<D: Told>(of: &'a AnswerOf<D>, census: &'a Census<D::System>, seed: u64) -> Self {
        let shared = census.by_share().into_iter().map(|found| SharedMotion {
            motion: D::motion(of, &found.verdict),
            share: census.share(found),
            starts: found.count,
        });
        let certainty = Certainty::of(census.by_share().into_iter().map(|found| found.count), census.total());
        Self { motions: shared.collect(), certainty, starts: census.total(), seed, area: D::area(of) }
    }
}

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

/// Where the starts are, one row for each motion, and how certain the shares are.
pub(crate) fn text<D: Teller>(of: &AnswerOf<D>, census: &Census<D::System>) -> String {
    let heads = ["share", "starts", "<label", "multipliers", "impact speed", "power in", "<meaning"].map(str::to_owned);
    let row = |found: &&CountedMotion<D::System>| {
        let verdict = &found.verdict;
        let all = D::multipliers(of, verdict);
        vec![
            percent(census.share(found)),
            found.count.to_string(),
            verdict.label().into_owned(),
            if all.is_empty() { "-".into() } else { words::multipliers(&all) },
            D::quantity_text(of, verdict, Quantity::ImpactSpeedMax),
            D::quantity_text(of, verdict, Quantity::Power),
            D::meaning(of, verdict) + &D::by_stop(of, verdict),
        ]
    };
    let undecided = |found: &&CountedMotion<D::System>| matches!(found.verdict, Verdict::Undecided(_));
    let motions = leading(census.by_share(), |found| census.share(found), undecided);
    let rows = motions.rows(row, "motion", (2, 0, heads.len()));
    let certain = certainty(census.by_share().iter().map(|found| found.count), census.total());
    D::scattered(of, census.total()) + &aligned(&heads, &rows) + &certain
}

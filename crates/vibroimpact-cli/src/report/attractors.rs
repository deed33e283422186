//! The attractors of many starts as text.

use crate::report::certainty::certainty;
use crate::report::leading::leading;
use crate::report::motion::Teller;
use crate::report::words::{multipliers, table};
use vibroimpact::quantities::Quantity;
use vibroimpact::verdict::{Census, CountedMotion, Verdict};
use vibroimpact_report::AnswerOf;
use vibroimpact_report::number::percent;

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
            if all.is_empty() { "-".into() } else { multipliers(&all) },
            D::quantity_text(of, verdict, Quantity::ImpactSpeedMax),
            D::quantity_text(of, verdict, Quantity::Power),
            D::meaning(of, verdict) + &D::by_stop(of, verdict),
        ]
    };
    let undecided = |found: &&CountedMotion<D::System>| matches!(found.verdict, Verdict::Undecided(_));
    let motions = leading(census.by_share(), |found| census.share(found), undecided);
    let rows = motions.rows(row, "motion", (2, 0, heads.len()));
    let certain = certainty(census.by_share().iter().map(|found| found.count), census.total());
    D::scattered(of, census.total()) + &table(&heads, &rows) + &certain
}

//! The motions of a basin as text.

use crate::report::certainty::certainty;
use crate::report::leading::leading;
use crate::report::motion::Teller;
use crate::report::words::table;
use vibroimpact::verdict::Verdict;
use vibroimpact_report::AnswerOf;
use vibroimpact_report::number::{percent, short};
use vibroimpact_study::basin::BasinMeasures;
use vibroimpact_study::{Basin, counted};

/// One row for each motion with the number and the share of its starts, how certain the shares are, and what is told beside it.
pub(crate) fn text<D: Teller>(of: &AnswerOf<D>, found: &Basin<D::System, D::Coordinate, D::Quantity>) -> String {
    let motion = |m: usize| (&found.motions[m].verdict, found.motions[m].count, found.share(m));
    let motions: Vec<_> = found.by_count().into_iter().map(motion).collect();
    let counts: Vec<u64> = motions.iter().map(|motion| motion.1).collect();
    let heads = ["share", "starts", "<label", "<meaning"].map(str::to_owned);
    let row = |(verdict, count, share): &(&Verdict<D::System>, u64, f64)| {
        let meaning = D::meaning(of, verdict) + &D::by_stop(of, verdict);
        vec![percent(*share), count.to_string(), verdict.label().into_owned(), meaning]
    };
    let motions = leading(motions, |motion| motion.2, |motion| matches!(motion.0, Verdict::Undecided(_)));
    let total = counts.iter().sum();
    let table = table(&heads, &motions.rows(row, "motion", (2, 0, heads.len())));
    table + &certainty(counts.into_iter(), total) + &D::of_basin(found)
}

/// The entropies and the uncertainty exponent.
pub(super) fn sentences(of: &BasinMeasures) -> String {
    let Some(boundary) = of.boundary_entropy else { return String::new() };
    let mut text = format!(
        "\n  basin entropy {}, boundary entropy {} in boxes of {} x {} starts\n",
        short(of.entropy),
        short(boundary),
        of.side,
        of.side
    );
    if boundary > core::f64::consts::LN_2 {
        text.push_str("  the boundary entropy exceeds ln 2: the boundary is fractal at this resolution\n");
    }
    if let Some(exponent) = &of.uncertainty {
        text.push_str(&format!(
            "  uncertainty exponent {} +- {} (1 for a smooth boundary)\n",
            short(exponent.value),
            short(exponent.error)
        ));
    }
    if let Some(of) = &of.merging {
        let said = if of.wada() { "all basins have one boundary (Wada)" } else { "the basins have several boundaries" };
        text.push_str(&format!(
            "  merging method, {} motions: boundaries differ by up to {}, {} of their starts lie within {} of all: {said} at this resolution\n",
            of.motions,
            counted(of.radius as u64, "start"),
            percent(of.common),
            of.limit
        ));
    }
    text
}

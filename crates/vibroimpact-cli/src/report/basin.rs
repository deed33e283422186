//! The motions of a basin as text.

use crate::report::certainty::certainty;
use crate::report::leading::leading;
use crate::report::words::{by_stop, meaning, table};
use vibroimpact::Oscillator;
use vibroimpact::verdict::Verdict;
use vibroimpact_report::json::basin::by_count;
use vibroimpact_report::number::{percent, short};
use vibroimpact_study::basin::BasinMeasures;
use vibroimpact_study::{Basin, counted};

/// One row for each motion.
pub(crate) fn text(found: &Basin, osc: &Oscillator) -> String {
    let heads = ["share", "starts", "<label", "<meaning"].map(str::to_owned);
    let row = |m: &usize| {
        let motion = &found.motions[*m];
        let label = motion.verdict.label().into_owned();
        let meaning = meaning(&motion.verdict) + &by_stop(&motion.verdict, osc);
        vec![percent(found.share(*m)), motion.count.to_string(), label, meaning]
    };
    let undecided = |m: &usize| matches!(found.motions[*m].verdict, Verdict::Undecided(_));
    let motions = leading(by_count(found), |m| found.share(*m), undecided);
    let text = table(&heads, &motions.rows(row, "motion", (2, 0, heads.len())))
        + &certainty(found.motions.iter().map(|motion| motion.count), found.cells.len() as u64);
    text + &found.measures().map_or_else(String::new, |measures| sentences(&measures))
}

/// The entropies and the uncertainty exponent.
fn sentences(of: &BasinMeasures) -> String {
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

//! The motions of a basin as text.

use crate::report::leading::leading;
use crate::report::words::{meaning, table};
use vibroimpact::verdict::Verdict;
use vibroimpact_report::json::basin::by_count;
use vibroimpact_report::number::{percent, short};
use vibroimpact_study::Basin;
use vibroimpact_study::basin::BasinMeasures;

/// One row for each motion.
pub(crate) fn text(found: &Basin) -> String {
    let heads = ["share", "starts", "<label", "<meaning"].map(str::to_owned);
    let row = |m: &usize| {
        let motion = &found.motions[*m];
        let label = motion.verdict.label().into_owned();
        vec![percent(found.share(*m)), motion.count.to_string(), label, meaning(&motion.verdict)]
    };
    let undecided = |m: &usize| matches!(found.motions[*m].verdict, Verdict::Undecided(_));
    let motions = leading(by_count(found), |m| found.share(*m), undecided);
    let text = table(&heads, &motions.rows(row, "motion", (2, 0, heads.len())));
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
    text
}

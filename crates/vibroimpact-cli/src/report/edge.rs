//! The border between the starts of two motions as text.

use crate::report::motion::Teller;
use crate::report::words;
use core::fmt::Write;
use vibroimpact::edge::{Bordered as _, Edge};
use vibroimpact_report::AnswerOf;
use vibroimpact_report::number::{precise, short};
use vibroimpact_study::counted;

/// Both motions, where the border lies, and to which motion that on it leads.
pub(crate) fn text<D: Teller>(of: &AnswerOf<D>, found: &Edge<D::System>) -> String {
    let sides = found.sides.each_ref().map(|side| side.label());
    let mut text = format!(
        "border between {} and {}, at {} of the way from the first start to the second\n",
        sides[0],
        sides[1],
        precise(found.part)
    );
    let laps = found.track.len().saturating_sub(1);
    match &found.saddle {
        Some(saddle) => {
            let _ = writeln!(
                text,
                "the motion on the border comes close to this one after {}:",
                counted(laps as u64, "lap")
            );
            let by_stop = D::by_stop(of, saddle);
            let _ = writeln!(text, "{}{by_stop}: {}", saddle.label(), D::meaning(of, saddle));
            text.push_str(&D::events_text(of, saddle));
            if let Some(stability) = D::stability_words(of, saddle) {
                let multipliers = D::multipliers(of, saddle);
                let _ = writeln!(text, "  {stability}; multipliers {}", words::multipliers(&multipliers));
            }
        }
        None => text.push_str(&format!(
            "the motion on the border came back to none of its earlier states in {}\n",
            counted(laps as u64, "lap")
        )),
    }
    if let Some(last) = found.track.last() {
        let (q, qdot) = D::numbers(of, &last.state);
        let numbers = |all: &[f64]| all.iter().map(|value| precise(*value)).collect::<Vec<_>>().join(", ");
        let _ = writeln!(
            text,
            "  last state on it: q = {}, qdot = {}, phase {}, known to {}",
            numbers(&q),
            numbers(&qdot),
            short(of.system.phase(&last.state)),
            short(last.apart)
        );
    }
    text
}

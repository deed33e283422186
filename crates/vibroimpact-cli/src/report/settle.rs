//! A settled motion as text.

use crate::report::words::{motion, seconds};
use vibroimpact::Oscillator;
use vibroimpact::verdict::{PaperRule, PaperVerdict, Settled, Verdict};
use vibroimpact_report::Units;
use vibroimpact_report::number::short;
use vibroimpact_study::counted;

/// The motion, how long it was followed, and the verdict of the rule of the paper.
pub(crate) fn text(
    settled: &Settled,
    paper: Option<(PaperRule, PaperVerdict)>,
    osc: &Oscillator,
    units: &Units,
) -> String {
    let mut text = motion(&settled.verdict, osc, units);
    text.push_str(&format!(
        "  followed for {}, until time {}{}\n",
        counted(settled.impacts, "impact"),
        seconds(settled.time, units),
        if matches!(settled.verdict, Verdict::Undecided(_)) { "; not settled by then" } else { "" }
    ));
    if let Some(chaos) = settled.transient {
        text.push_str(&format!("  chaotic before: a transient that had ended at impact {}\n", chaos.impacts));
    }
    if let Some((rule, verdict)) = paper {
        text.push_str(&format!(
            "\nthe paper's rule ({} %, at most {} impacts): {}\n",
            rule.percent,
            rule.limit,
            said(verdict)
        ));
    }
    text
}

fn said(verdict: PaperVerdict) -> String {
    match verdict {
        PaperVerdict::Settled { m, n, impacts } => {
            format!("settled into {m}/{} (n = {}) after {impacts} impacts", n.round(), short(n))
        }
        PaperVerdict::Unstable => "unstable, not settled within the limit".into(),
        PaperVerdict::NoMoreImpacts => "the impacts ceased".into(),
        PaperVerdict::Sticks => "the mass came to rest on the stop".into(),
    }
}

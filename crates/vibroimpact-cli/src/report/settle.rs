//! A settled motion as text.

use crate::report::motion::Teller;
use crate::report::words::seconds;
use vibroimpact::verdict::{PaperRule, PaperVerdict, Settled, Verdict};
use vibroimpact_report::AnswerOf;
use vibroimpact_report::number::short;
use vibroimpact_study::counted;

/// The motion, how long it was followed, and what is told beside it.
pub(crate) fn text<D: Teller>(of: &AnswerOf<D>, settled: &Settled<D::System>) -> String {
    let (event, more) = D::followed(of, settled);
    let open = if matches!(settled.verdict, Verdict::Undecided(_)) { "; not settled by then" } else { "" };
    let (events, time) = (counted(settled.impacts, event), seconds(settled.time, &of.units));
    format!("{}  followed for {events}, until time {time}{open}\n{more}", D::told(of, &settled.verdict))
}

/// The verdict of the rule of the paper.
pub(crate) fn of_paper(rule: PaperRule, verdict: PaperVerdict) -> String {
    let PaperRule { percent, limit, .. } = rule;
    format!("\nthe paper's rule ({percent} %, at most {limit} impacts): {}\n", said(verdict))
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

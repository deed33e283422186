//! A settled motion as text.

use crate::report::motion::{InUnits, Teller};
use crate::report::words::seconds;
use vibroimpact::Oscillator;
use vibroimpact::machine::Machine;
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
    let told = InUnits(osc, units);
    let mut text = told.motion(&settled.verdict);
    text.push_str(&followed(
        &counted(settled.impacts, "impact"),
        &seconds(settled.time, units),
        matches!(settled.verdict, Verdict::Undecided(_)),
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

/// The same of a machine.
pub(crate) fn of_machine(settled: &Settled<Machine>, machine: &Machine) -> String {
    let mut text = machine.motion(&settled.verdict);
    let events = counted(settled.impacts, "event");
    text.push_str(&followed(&events, &short(settled.time), matches!(settled.verdict, Verdict::Undecided(_))));
    if settled.transient.is_some() {
        text.push_str("  chaotic before: a transient that has ended\n");
    }
    text
}

/// How long a motion was followed.
fn followed(events: &str, time: &str, undecided: bool) -> String {
    let open = if undecided { "; not settled by then" } else { "" };
    format!("  followed for {events}, until time {time}{open}\n")
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

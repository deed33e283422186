//! The motions of an orbit diagram as text.

use crate::report::words::table;
use vibroimpact_report::json::diagram::{Counts, counts};
use vibroimpact_report::number::short;
use vibroimpact_report::{Units, Varied};
use vibroimpact_study::diagram::Shown;
use vibroimpact_study::{Cut, Diagram, Stretch, counted};

/// What varies, and one row for each sweep.
pub(crate) fn text<V: Varied, S: Shown>(found: &Diagram<V, S>, units: &Units) -> String {
    let plan = &found.plan;
    let values = counted(plan.over.count() as u64, "value");
    format!("{values} of {}\n\n{}{}", range(&plan.cut(), units), of_sweeps(&counts(found)), unrepeated(found))
}

/// The ranges of what varies along a line.
pub(crate) fn range<V: Varied>(cut: &Cut<V>, units: &Units) -> String {
    let first = Stretch { parameter: cut.vary.clone(), from: cut.ends.0, to: cut.ends.1 };
    let all = core::iter::once(&first).chain(&cut.also).map(|stretch| over(stretch, units));
    all.collect::<Vec<_>>().join(", ")
}

/// The range of a number.
pub(crate) fn over<V: Varied>(Stretch { parameter, from, to }: &Stretch<V>, units: &Units) -> String {
    let unit = parameter.unit(units);
    format!("{} from {} to {}", parameter.words(units), short(from * unit), short(to * unit))
}

/// How many of the motions did not repeat within what is shown of them.
fn unrepeated<V, S: Shown>(found: &Diagram<V, S>) -> String {
    let (transient, keep) = (found.plan.transient, found.plan.keep);
    let noun = if found.plan.show.is_closings() { "impact" } else { "forcing period" };
    let count = found.steps.iter().filter(|step| step.points.len() as u64 >= keep).count() as u64;
    // of a single point nothing can repeat
    if keep < 2 || count == 0 {
        return String::new();
    }
    format!(
        "\n  {} did not repeat within the {} shown, after {}: chaotic, of a longer period, or not settled by then\n",
        counted(count, "motion"),
        counted(keep, noun),
        counted(transient, noun)
    )
}

/// One row for each sweep.
fn of_sweeps(counts: &[Counts]) -> String {
    let heads = ["<sweep", "motions", "with impacts", "none", "stuck", "undecided", "points"].map(str::to_owned);
    let row = |c: &Counts| {
        let counts = [c.motions, c.impact, c.none, c.stuck, c.undecided, c.points];
        core::iter::once(c.sweep.to_owned()).chain(counts.map(|n| n.to_string())).collect()
    };
    table(&heads, &counts.iter().map(row).collect::<Vec<Vec<String>>>())
}

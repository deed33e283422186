//! The motions of an orbit diagram as text.

use crate::report::branch::named;
use crate::report::words::table;
use vibroimpact_report::Units;
use vibroimpact_report::json::diagram::{Counts, counts};
use vibroimpact_report::number::short;
use vibroimpact_study::diagram::Show;
use vibroimpact_study::{Diagram, Stretch, counted};

/// The parameters that vary, and one row for each sweep.
pub(crate) fn text(found: &Diagram, units: &Units) -> String {
    let plan = &found.plan;
    let ((from, to), unit) = (plan.over.ends(), units.of(plan.vary));
    let name = named(plan.vary, units);
    let heads = ["<sweep", "motions", "with impacts", "none", "stuck", "undecided", "points"].map(str::to_owned);
    let row = |c: &Counts| {
        let counts = [c.motions, c.impact, c.none, c.stuck, c.undecided, c.points];
        core::iter::once(c.sweep.to_owned()).chain(counts.map(|n| n.to_string())).collect()
    };
    let rows: Vec<Vec<String>> = counts(found).iter().map(row).collect();
    let also = plan.also.map_or_else(String::new, |Stretch { parameter, from, to }| {
        let unit = units.of(parameter);
        format!(", {} from {} to {}", named(parameter, units), short(from * unit), short(to * unit))
    });
    format!(
        "{} of {name} from {} to {}{also}\n\n{}{}",
        counted(u64::from(plan.over.count()), "value"),
        short(from * unit),
        short(to * unit),
        table(&heads, &rows),
        unrepeated(found)
    )
}

/// How many of the motions did not repeat within what is shown of them.
fn unrepeated(found: &Diagram) -> String {
    let plan = &found.plan;
    let count = found.steps.iter().filter(|step| step.points.len() as u64 >= plan.keep).count() as u64;
    // of a single point nothing can repeat
    if plan.keep < 2 || count == 0 {
        return String::new();
    }
    let noun = if plan.show == Show::Velocity { "impact" } else { "forcing period" };
    format!(
        "\n  {} did not repeat within the {} shown, after {}: chaotic, of a longer period, or not settled by then\n",
        counted(count, "motion"),
        counted(plan.keep, noun),
        counted(plan.transient, noun)
    )
}

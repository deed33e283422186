//! The motions of an orbit diagram as text.

use crate::report::branch::named;
use crate::report::words::table;
use vibroimpact_report::Units;
use vibroimpact_report::json::diagram::{Counts, counts, machine_counts};
use vibroimpact_report::number::short;
use vibroimpact_study::diagram::Show;
use vibroimpact_study::{Diagram, MachineDiagram, Stretch, counted};

/// The parameters that vary, and one row for each sweep.
pub(crate) fn text(found: &Diagram, units: &Units) -> String {
    let plan = &found.plan;
    let ((from, to), unit) = (plan.over.ends(), units.of(plan.vary));
    let name = named(plan.vary, units);
    let also = plan.also.map_or_else(String::new, |Stretch { parameter, from, to }| {
        let unit = units.of(parameter);
        format!(", {} from {} to {}", named(parameter, units), short(from * unit), short(to * unit))
    });
    format!(
        "{} of {name} from {} to {}{also}\n\n{}{}",
        counted(plan.over.count() as u64, "value"),
        short(from * unit),
        short(to * unit),
        of_sweeps(&counts(found)),
        unrepeated(found)
    )
}

/// How many of the motions did not repeat within what is shown of them.
fn unrepeated(found: &Diagram) -> String {
    let plan = &found.plan;
    let noun = if plan.show == Show::Velocity { "impact" } else { "forcing period" };
    lasting(found.steps.iter().map(|step| step.points.len()), (plan.transient, plan.keep), noun)
}

fn lasting(points: impl Iterator<Item = usize>, (transient, keep): (u64, u64), noun: &str) -> String {
    let count = points.filter(|points| *points as u64 >= keep).count() as u64;
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

/// The same for a machine.
pub(crate) fn of_machine(found: &MachineDiagram) -> String {
    let plan = &found.plan;
    let (from, to) = plan.over.ends();
    let noun = if plan.shows_closings() { "closing" } else { "forcing period" };
    let also = plan.also.as_ref().map_or_else(String::new, |Stretch { parameter: path, from, to }| {
        format!(", {path} from {} to {}", short(*from), short(*to))
    });
    format!(
        "{} of {} from {} to {}{also}\n\n{}{}",
        counted(plan.over.count() as u64, "value"),
        plan.vary,
        short(from),
        short(to),
        of_sweeps(&machine_counts(found)),
        lasting(found.steps.iter().map(|step| step.points.len()), (plan.transient, plan.keep), noun)
    )
}

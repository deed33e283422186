//! Answers as text.

pub(crate) mod branch;
pub(crate) mod leading;
pub(crate) mod motion;
pub(crate) mod words;

use crate::task::{attractors, basin, curve, diagram, edge, lyapunov, map, margins, orbit, region, response, settle};
use crate::{AnswerOf, Varied};
use motion::Teller;
use vibroimpact_study::{Name, PlanError, Results, Task};

/// The text of an answer.
pub(crate) fn text_of<D: Teller>(of: &AnswerOf<D>) -> Result<String, PlanError> {
    let (units, machine) = (&of.units, D::machine(of));
    let text = match &of.results {
        Results::Simulate(found) => D::simulated(of, found),
        Results::Settle(found) => settle::text(of, found),
        Results::Attractors(found) => attractors::text(of, found),
        Results::Orbit(found) => orbit::text(of, found),
        Results::Basin(found) => basin::text(of, found),
        Results::Map(found) => {
            // points that are no grid have one start each
            let starts = if let Task::Map(task) = &of.plan.task { task.starts } else { 1 };
            let seen = if machine.is_some() { map::seen(found) } else { String::new() };
            map::text(found, starts, D::two_stops(of)) + &seen
        }
        Results::Diagram(found) => diagram::text(found, units),
        Results::Lyapunov(found, _) => lyapunov::text(of, found),
        Results::Branch(found) => branch::text(&of.branches_in_words(found)?, machine, (&of.cut()?, units)),
        Results::Curve(found) => curve::text(&of.curve(found)?, (&of.curve_plan()?, units)),
        Results::Region(found) => {
            let plan = of.region_plan()?;
            region::text(found, &plan, (plan.neutral(&of.written), D::in_closed_form(&plan)), units)
        }
        Results::Response(found) => {
            let vary = if let Task::Response(task) = &of.plan.task { task.vary.text() } else { "" };
            response::text(&D::response(of, found)?, &D::Name::of(vary)?.words(units))
        }
        Results::Margins(found) => margins::text(of, found),
        Results::Edge(found) => edge::text(of, found),
    };
    Ok(D::heading(of) + &text)
}

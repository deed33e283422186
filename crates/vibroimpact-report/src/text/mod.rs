//! Answers as text: what is the same of all systems.

pub(crate) mod branch;
pub(crate) mod machine;
pub(crate) mod oscillator;
pub(crate) mod words;

use crate::task::{attractors, basin, curve, diagram, edge, lyapunov, map, margins, orbit, region, response, settle};
use crate::{AnswerOf, Told, Varied};
use core::fmt::Write;
use vibroimpact::quantities::Quantity;
use vibroimpact::verdict::{Settled, Verdict};
use vibroimpact_study::{
    Basin, CycleOf, MotionMargins, Name, Orbit, PlanError, PointOf, RegionPlan, Results, Simulated, Task,
};

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

/// A system whose motions are told.
pub(crate) trait Teller: Told {
    /// What is told before the result: the system, and its start where there is one.
    fn heading(_: &AnswerOf<Self>) -> String {
        String::new()
    }

    /// The meaning, as a sentence without full stop.
    fn meaning(of: &AnswerOf<Self>, verdict: &Verdict<Self::System>) -> String;

    /// The impacts on each of several stops in brackets, after a blank; empty where the label says it.
    fn by_stop(of: &AnswerOf<Self>, verdict: &Verdict<Self::System>) -> String;

    /// A quantity with its unit; a dash where it is not defined.
    fn quantity_text(of: &AnswerOf<Self>, verdict: &Verdict<Self::System>, quantity: Quantity) -> String;

    /// The events of a cycle, one row each.
    fn events_text(of: &AnswerOf<Self>, verdict: &Verdict<Self::System>) -> String;

    /// The stability, where it is known, or known to be open.
    fn stability_words(of: &AnswerOf<Self>, verdict: &Verdict<Self::System>) -> Option<&'static str> {
        let stability = verdict.stability(&of.system);
        let known = stability.is_some() || !Self::multipliers(of, verdict).is_empty();
        let free = Self::machine(of).is_none() && matches!(verdict, Verdict::NoImpact(_));
        known.then(|| words::in_words(stability, free, matches!(verdict, Verdict::Chaotic(_))))
    }

    /// The quantities that matter most.
    fn quantities_text(of: &AnswerOf<Self>, verdict: &Verdict<Self::System>) -> String;

    /// The grounds of the verdict.
    fn grounds(of: &AnswerOf<Self>, verdict: &Verdict<Self::System>) -> String;

    /// The label with what it does not say, and the meaning.
    fn headline(of: &AnswerOf<Self>, verdict: &Verdict<Self::System>) -> String {
        format!("{}{}: {}", verdict.label(), Self::by_stop(of, verdict), Self::meaning(of, verdict))
    }

    /// The headline of a motion, its events and its stability.
    fn told_briefly(of: &AnswerOf<Self>, verdict: &Verdict<Self::System>) -> String {
        let mut text = Self::headline(of, verdict) + "\n" + &Self::events_text(of, verdict);
        if let Some(stability) = Self::stability_words(of, verdict) {
            let multipliers = words::multipliers(&Self::multipliers(of, verdict));
            let told = if multipliers.is_empty() { multipliers } else { format!("; multipliers {multipliers}") };
            let _ = writeln!(text, "  {stability}{told}");
        }
        text
    }

    /// The complete text of one motion.
    fn told(of: &AnswerOf<Self>, verdict: &Verdict<Self::System>) -> String {
        let text = Self::told_briefly(of, verdict) + &Self::quantities_text(of, verdict);
        text + &format!("  shown by: {}\n", Self::grounds(of, verdict))
    }

    /// The events of a motion, and the reason why the list ends.
    fn simulated(of: &AnswerOf<Self>, found: &Simulated<Self::Event>) -> String;

    /// The word for an event that is followed, and what is told of a settled motion beside it.
    fn followed(of: &AnswerOf<Self>, found: &Settled<Self::System>) -> (&'static str, String);

    /// Where scattered starts are.
    fn scattered(of: &AnswerOf<Self>, starts: u64) -> String;

    /// What is told of a basin beside its motions.
    fn of_basin(found: &Basin<Self::System, Self::Coordinate, Self::Quantity>) -> String;

    /// An orbit; without one why there is none.
    fn orbit_text(of: &AnswerOf<Self>, orbit: Option<&Orbit<CycleOf<Self>>>) -> String;

    /// Whether regions are known in closed form.
    fn in_closed_form(_: &RegionPlan<Self::Name>) -> bool {
        false
    }

    /// Whether motions are told with their impacts on each of two stops.
    fn two_stops(_: &AnswerOf<Self>) -> bool {
        false
    }

    /// What happens at the event at a point of a branch.
    fn because(of: &AnswerOf<Self>, point: &PointOf<Self>) -> String;

    /// What is told of margins beside the events.
    fn of_margins(_: &AnswerOf<Self>, _: &MotionMargins<Self::System, Self::Name, PointOf<Self>>) -> String {
        String::new()
    }
}

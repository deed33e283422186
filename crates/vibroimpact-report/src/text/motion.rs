//! Motions of any system as text: what is the same of all of them.

use crate::json::branch::EventOf;
use crate::json::motion::undecided;
use crate::number::short;
use crate::task::{basin, margins, orbit, region, settle, simulate};
use crate::text::branch::because;
use crate::text::words::{
    self, ROUNDING_DECIDES, ROUNDING_GROWS, aligned, by_stop, counted_word, meaning,
    quantities as quantities_of_oscillator,
};
use crate::{AnswerOf, Told};
use core::fmt::Write;
use vibroimpact::chaos::{Measured, Spectrum};
use vibroimpact::continuation::{SolutionPoint, machine};
use vibroimpact::events::{End, Event, EventKind};
use vibroimpact::machine::{Machine, StopLaw};
use vibroimpact::orbit::machine::Cycle;
use vibroimpact::quantities::machine::{Part, Quantities as PartQuantities};
use vibroimpact::quantities::{Quantity, machine_cycle_quantities, machine_quantities, of_verdict};
use vibroimpact::verdict::machine::longest_flight;
use vibroimpact::verdict::{Count, Settled, StartBox, Undecided, UndecidedCause, Verdict};
use vibroimpact_study::machine::MachineSource;
use vibroimpact_study::{
    Basin, CycleOf, MotionMargins, Orbit, PointOf, RegionPlan, Simulated, SystemPlan, Task, counted,
};

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

    /// The complete text of one motion.
    fn told(of: &AnswerOf<Self>, verdict: &Verdict<Self::System>) -> String {
        let mut text = format!("{}{}: {}\n", verdict.label(), Self::by_stop(of, verdict), Self::meaning(of, verdict));
        text.push_str(&Self::events_text(of, verdict));
        if let Some(stability) = Self::stability_words(of, verdict) {
            let multipliers = words::multipliers(&Self::multipliers(of, verdict));
            let told = if multipliers.is_empty() { multipliers } else { format!("; multipliers {multipliers}") };
            let _ = writeln!(text, "  {stability}{told}");
        }
        text.push_str(&Self::quantities_text(of, verdict));
        let _ = writeln!(text, "  shown by: {}", Self::grounds(of, verdict));
        text
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

impl Teller for SystemPlan {
    fn heading(of: &AnswerOf<Self>) -> String {
        let system = words::system(&of.asked(), &of.system);
        let start = || words::start(&of.start, &of.units);
        match &of.plan.task {
            Task::Map(_) | Task::Diagram(_) | Task::Region(_) | Task::Response(_) => String::new(),
            Task::Attractors { .. } => system,
            Task::Simulate(_) => system + &start(),
            Task::Settle { .. } | Task::Lyapunov(_) | Task::Edge(_) => system + &start() + "\n",
            Task::Margins(plan) if plan.label.is_none() => system + &start() + "\n",
            _ => system + "\n",
        }
    }

    fn meaning(_: &AnswerOf<Self>, verdict: &Verdict) -> String {
        meaning(verdict)
    }

    fn by_stop(of: &AnswerOf<Self>, verdict: &Verdict) -> String {
        by_stop(verdict, &of.system)
    }

    fn quantity_text(of: &AnswerOf<Self>, verdict: &Verdict, quantity: Quantity) -> String {
        of_verdict(&of.system, verdict).map_or_else(|| "-".into(), |all| of.units.text(&all, quantity))
    }

    fn events_text(of: &AnswerOf<Self>, verdict: &Verdict) -> String {
        let Verdict::Periodic(cycle) = verdict else { return String::new() };
        words::impacts(cycle, &of.system, &of.units)
    }

    fn quantities_text(of: &AnswerOf<Self>, verdict: &Verdict) -> String {
        of_verdict(&of.system, verdict).map_or_else(String::new, |all| quantities_of_oscillator(&all, &of.units))
    }

    fn grounds(of: &AnswerOf<Self>, verdict: &Verdict) -> String {
        words::grounds(verdict, &of.system, &of.units)
    }

    fn simulated(of: &AnswerOf<Self>, found: &Simulated) -> String {
        simulate::text(found, &of.plan.task, &of.asked())
    }

    fn followed(of: &AnswerOf<Self>, found: &Settled) -> (&'static str, String) {
        let before = found.transient.map_or_else(String::new, |chaos| {
            format!("  chaotic before: a transient that had ended at impact {}\n", chaos.impacts)
        });
        ("impact", before + &of.paper_rule.map_or_else(String::new, |(rule, verdict)| settle::of_paper(rule, verdict)))
    }

    fn scattered(of: &AnswerOf<Self>, starts: u64) -> String {
        let (StartBox { x, v, .. }, units) = (StartBox::natural(&of.system), &of.units);
        let [x, v] = [(x, units.length()), (v, units.velocity())]
            .map(|((low, high), unit)| format!("{} to {}", short(low * unit), short(high * unit)));
        format!("starts  {starts} in x {x}, v {v}, all phases\n\n")
    }

    fn of_basin(found: &Basin) -> String {
        found.measures().map_or_else(String::new, |measures| basin::sentences(&measures))
    }

    fn orbit_text(of: &AnswerOf<Self>, orbit: Option<&Orbit>) -> String {
        orbit::of_oscillator(of, orbit)
    }

    fn in_closed_form(plan: &RegionPlan) -> bool {
        region::in_closed_form(plan)
    }

    fn two_stops(of: &AnswerOf<Self>) -> bool {
        of.written.second_stop.is_some()
    }

    fn because(_: &AnswerOf<Self>, point: &SolutionPoint) -> String {
        point.event.map_or_else(String::new, |event| because(event, EventOf::Oscillator(point)))
    }

    fn of_margins(of: &AnswerOf<Self>, found: &MotionMargins) -> String {
        margins::of_box(found, &of.system, &of.units)
    }
}

impl Teller for MachineSource {
    fn meaning(of: &AnswerOf<Self>, verdict: &Verdict<Machine>) -> String {
        match verdict {
            Verdict::Periodic(cycle) => meaning_of_cycle(cycle),
            Verdict::NoImpact(last) if last.fades() => words::EVER_GENTLER.to_owned(),
            Verdict::NoImpact(_) => {
                let closed = closed(&of.system, verdict);
                let closed = if closed.is_empty() { closed } else { format!("; it stays on {closed}") };
                format!("no more impacts, ever{closed}")
            }
            Verdict::Chaotic(chaos) => format!("no repetition in {}", counted(chaos.impacts, "event")),
            Verdict::Stuck(_) => format!("at rest on {} for ever", closed(&of.system, verdict)),
            Verdict::Undecided(Undecided { why: UndecidedCause::Unconfirmed, .. }) => ROUNDING_DECIDES.to_owned(),
            Verdict::Undecided(_) => "nothing could be shown within the budget".to_owned(),
        }
    }

    fn by_stop(of: &AnswerOf<Self>, verdict: &Verdict<Machine>) -> String {
        let Verdict::Periodic(cycle) = verdict else { return String::new() };
        let counts: Vec<String> =
            of.system.stops().iter().zip(&cycle.counts).map(|(stop, count)| format!("{count} {}", stop.name)).collect();
        let said = counts.len() > 1 && cycle.counts.iter().any(|count| *count > 0);
        if said { format!(" ({})", counts.join(", ")) } else { String::new() }
    }

    fn quantity_text(of: &AnswerOf<Self>, verdict: &Verdict<Machine>, quantity: Quantity) -> String {
        let all = machine_quantities(&of.system, verdict);
        let value = all.map_or(f64::NAN, |all| largest(&all, &of.system, quantity));
        if value.is_finite() { short(value) } else { "-".to_owned() }
    }

    fn events_text(of: &AnswerOf<Self>, verdict: &Verdict<Machine>) -> String {
        let Verdict::Periodic(cycle) = verdict else { return String::new() };
        events_of_cycle(&of.system, cycle)
    }

    fn quantities_text(of: &AnswerOf<Self>, verdict: &Verdict<Machine>) -> String {
        let drift = if let Verdict::Periodic(cycle) = verdict { drift(&of.system, cycle) } else { String::new() };
        let found = match verdict {
            Verdict::Periodic(cycle) => machine_cycle_quantities(&of.system, cycle),
            _ => machine_quantities(&of.system, verdict),
        };
        drift + &found.map_or_else(String::new, |found| quantities(&of.system, &found))
    }

    fn grounds(of: &AnswerOf<Self>, verdict: &Verdict<Machine>) -> String {
        match verdict {
            Verdict::Periodic(cycle) => {
                format!("Newton's method on its events returns to itself within {:.0e}", cycle.residual.max(1e-16))
            }
            Verdict::NoImpact(last) if last.fades() => words::IMPACTS_FADE.to_owned(),
            Verdict::NoImpact(_) => "no stop and no joint changes its state any more".to_owned(),
            Verdict::Stuck(_) => "it rests, and no force ever pulls it off".to_owned(),
            Verdict::Chaotic(chaos) => largest_exponent(&chaos.spectrum),
            Verdict::Undecided(Undecided { why: UndecidedCause::Unconfirmed, impacts: events, .. }) => {
                format!("{}; {ROUNDING_GROWS}", counted(*events, "event"))
            }
            Verdict::Undecided(Undecided { why, impacts: events, spectrum }) => {
                let why = match why {
                    UndecidedCause::Budget => "the budget is used up".to_owned(),
                    UndecidedCause::Ended(End::NoEventWithin) => {
                        let time = short(longest_flight(&of.system));
                        format!("no event within a time of {time} after the last one, and none is excluded later")
                    }
                    why => undecided(*why).replace('_', " "),
                };
                let exponent = spectrum.as_ref().filter(|_| matches!(why.as_str(), "the budget is used up"));
                let exponent =
                    exponent.map_or_else(String::new, |spectrum| format!("; {}", largest_exponent(spectrum)));
                format!("{} without a cycle: {why}{exponent}", counted(*events, "event"))
            }
        }
    }

    fn simulated(of: &AnswerOf<Self>, found: &Simulated<Event>) -> String {
        simulate::of_machine(found, &of.plan.task, &of.system)
    }

    fn followed(_: &AnswerOf<Self>, found: &Settled<Machine>) -> (&'static str, String) {
        let before = if found.transient.is_some() { "  chaotic before: a transient that has ended\n" } else { "" };
        ("event", before.to_owned())
    }

    fn scattered(_: &AnswerOf<Self>, starts: u64) -> String {
        format!("starts  {starts}\n\n")
    }

    fn of_basin(found: &Basin<Machine, String, String>) -> String {
        match found.refused() {
            0 => String::new(),
            refused => format!("  {} beyond a rigid stop\n", counted(refused as u64, "start")),
        }
    }

    fn orbit_text(of: &AnswerOf<Self>, orbit: Option<&Orbit<Cycle>>) -> String {
        orbit.map_or_else(String::new, |orbit| Self::told(of, &Verdict::Periodic(orbit.cycle.clone())))
    }

    fn because(of: &AnswerOf<Self>, point: &machine::SolutionPoint) -> String {
        point.event.map_or_else(String::new, |event| because(event, EventOf::Machine(&of.system)))
    }
}

fn meaning_of_cycle(cycle: &Cycle) -> String {
    let label = cycle.label;
    let periods = match label.periods {
        // without forcing
        0 => format!("every {}", short(cycle.period)),
        1 => "every forcing period".to_owned(),
        n => format!("every {}", counted_word(n, "forcing period")),
    };
    match label.impacts {
        Count::Finite(0) => format!("a steady motion without impacts, {periods}"),
        Count::Finite(m) => format!("{} {periods}", counted_word(m, "impact")),
        Count::Infinite => format!("a complete chatter (infinitely many impacts) {periods}"),
    }
}

/// The name of an event of a machine and its speed. A joint slips forwards or backwards, without speed.
pub(crate) fn kind_and_speed(event: &Event) -> (String, String) {
    let name = event.kind.name();
    match event.kind {
        EventKind::Slip if event.speed < 0.0 => (format!("{name} backward"), "0".to_owned()),
        EventKind::Slip => (format!("{name} forward"), "0".to_owned()),
        _ => (name.to_owned(), short(event.speed)),
    }
}

/// Maximum number of events shown of a long cycle.
const MOST_EVENTS: usize = 40;

fn events_of_cycle(machine: &Machine, cycle: &Cycle) -> String {
    if cycle.events.is_empty() {
        return String::new();
    }
    let forced = machine.period().is_some();
    let heads = ["event", if forced { "phase" } else { "time" }, "speed", "<kind", "<stop"].map(str::to_owned);
    let row = |(k, event): (usize, &Event)| {
        let place = if forced { event.phase } else { event.time };
        let (kind, speed) = kind_and_speed(event);
        vec![(k + 1).to_string(), short(place), speed, kind, machine.name_of(event.place).to_owned()]
    };
    let rows: Vec<Vec<String>> = cycle.events.iter().take(MOST_EVENTS).enumerate().map(row).collect();
    let mut text = aligned(&heads, &rows);
    if cycle.events.len() > MOST_EVENTS {
        let _ = writeln!(text, "  ... and {} more", cycle.events.len() - MOST_EVENTS);
    }
    text
}

/// By how much a machine that can be translated moves on in one period.
fn drift(machine: &Machine, cycle: &Cycle) -> String {
    if cycle.translations() == 0 {
        return String::new();
    }
    if cycle.drift.iter().all(|drift| *drift == 0.0) {
        return "  drift: none\n".to_owned();
    }
    let by_name = |values: &[f64]| {
        let names = machine.parts().coordinates.iter().zip(values);
        names.map(|(name, value)| format!("{name} {}", short(*value))).collect::<Vec<_>>().join(", ")
    };
    format!("  drift: {}; mean velocity {}\n", by_name(&cycle.drift), by_name(&cycle.drift_velocity()))
}

/// The names of the stops that stay closed for ever.
fn closed(machine: &Machine, verdict: &Verdict<Machine>) -> String {
    let names = verdict.closed().into_iter().map(|stop| machine.name_of(stop));
    names.collect::<Vec<_>>().join(", ")
}

/// The largest exponent and the rate of closings of a motion without a cycle.
fn largest_exponent(spectrum: &Spectrum<Vec<Measured>>) -> String {
    let told = |of: Measured| format!("{} +- {}", short(of.value), short(of.error));
    let largest = spectrum.exponents.first().map_or_else(|| "none".to_owned(), |first| told(*first));
    format!(
        "largest Lyapunov exponent {largest} per unit of time, {} impacts per unit of time",
        told(spectrum.impact_rate)
    )
}

/// A quantity of all of a machine, or else the largest value at one of its stops.
fn largest(all: &PartQuantities, machine: &Machine, quantity: Quantity) -> f64 {
    let of = |part| all.get(part, quantity);
    let whole = of(Part::Whole);
    let stops = (0..machine.stops().len()).map(|j| of(Part::Stop(j)));
    if whole.is_finite() { whole } else { stops.fold(f64::NAN, f64::max) }
}

/// Power and where it goes, and for each stop that closes the largest speed and the largest impulse, or force of a compliant one.
fn quantities(machine: &Machine, found: &PartQuantities) -> String {
    let mut text = String::new();
    let whole = |quantity| found.get(Part::Whole, quantity);
    let lost = [
        (Quantity::ImpactPower, "impacts"),
        (Quantity::ContactPower, "dampers of stops"),
        (Quantity::FrictionPower, "friction"),
        (Quantity::DampingPower, "damping"),
    ];
    let power = whole(Quantity::Power);
    let lost = lost.map(|(quantity, name)| (whole(quantity), name)).into_iter().filter(|(lost, _)| *lost > 0.0);
    let lost: Vec<String> = lost.map(|(lost, name)| format!("{} in {name}", short(lost))).collect();
    if power.is_finite() && !lost.is_empty() {
        let _ = writeln!(text, "  power {}: lost {}", short(power), lost.join(", "));
    }
    for (j, stop) in machine.stops().iter().enumerate() {
        let of = |quantity| found.get(Part::Stop(j), quantity);
        let speed = of(Quantity::ImpactSpeedMax);
        if speed > 0.0 {
            let (what, most) = match stop.law {
                StopLaw::Rigid { .. } => ("impulse", Quantity::ImpulseMax),
                StopLaw::Compliant { .. } => ("force", Quantity::ForceMax),
            };
            let _ =
                writeln!(text, "  {}: speed at most {}, {what} at most {}", stop.name, short(speed), short(of(most)));
        }
    }
    text
}

//! The text of the motions of a machine.

use crate::AnswerOf;
use crate::json::branch::EventOf;
use crate::json::motion::undecided;
use crate::number::short;
use crate::task::simulate;
use crate::text::Teller;
use crate::text::branch::because;
use crate::text::words::{self, ROUNDING_DECIDES, ROUNDING_GROWS, aligned, counted_word};
use core::fmt::Write;
use vibroimpact::chaos::{Measured, Spectrum};
use vibroimpact::continuation::machine;
use vibroimpact::events::{End, Event, EventKind};
use vibroimpact::machine::{Machine, StopLaw};
use vibroimpact::orbit::machine::Cycle;
use vibroimpact::quantities::machine::{Part, Quantities as PartQuantities};
use vibroimpact::quantities::{Quantity, machine_cycle_quantities, machine_quantities};
use vibroimpact::verdict::machine::longest_flight;
use vibroimpact::verdict::{Count, Settled, Undecided, UndecidedCause, Verdict};
use vibroimpact_study::machine::MachineSource;
use vibroimpact_study::{Basin, Orbit, Simulated, counted};

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

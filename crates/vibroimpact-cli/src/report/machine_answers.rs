//! Answers about machines as text.

use crate::report::certainty::certainty;
use crate::report::diagram;
use crate::report::lyapunov::said;
use crate::report::machine_curve;
use crate::report::margins;
use crate::report::region;
use crate::report::response;
use crate::report::words::ROUNDING_DECIDES;
use core::fmt::Write;
use vibroimpact::chaos::{Grounds, Measured};
use vibroimpact::continuation::MachinePoint;
use vibroimpact::events::{MachineEnd, MachineLimits};
use vibroimpact::machine::{Machine, StopLaw};
use vibroimpact::orbit::MachineCycle;
use vibroimpact::quantities::machine::Part;
use vibroimpact::quantities::{Quantity, machine_quantities};
use vibroimpact::verdict::{Chaos, Stability, Undecided, UndecidedCause, Verdict};
use vibroimpact_report::MachineAnswer;
use vibroimpact_report::json::undecided;
use vibroimpact_report::number::short;
use vibroimpact_study::{MachineResults, counted};

/// The answer, with a line for each motion, event or exponent.
pub(crate) fn text(answer: &MachineAnswer) -> String {
    let machine = &answer.machine;
    let mut text = String::new();
    match &answer.results {
        // it has a table of its own
        MachineResults::Simulate(_) => {}
        MachineResults::Settle(found) => {
            text.push_str(&motion(machine, &found.verdict));
            text.push_str(&quantities(machine, &found.verdict));
            let _ =
                writeln!(text, "  followed for {}, until time {}", counted(found.impacts, "event"), short(found.time));
            if found.transient.is_some() {
                text.push_str("  chaotic before: a transient that has ended\n");
            }
        }
        MachineResults::Attractors(census) => {
            let _ = writeln!(text, "{}", counted(census.total(), "start"));
            for found in census.by_share() {
                let _ = write!(text, "{:>6.1} %  {}", 100.0 * census.share(found), motion(machine, &found.verdict));
            }
            text.push_str(&certainty(census.by_share().iter().map(|found| found.count), census.total()));
        }
        MachineResults::Orbit(found) => {
            if found.is_empty() {
                text.push_str("no such orbit found\n");
            }
            for (k, cycle) in found.iter().enumerate() {
                if found.len() > 1 {
                    let _ = writeln!(text, "orbit {} of {}", k + 1, found.len());
                }
                text.push_str(&described(machine, cycle));
            }
        }
        MachineResults::Lyapunov(found, _) => {
            match found.grounds {
                Grounds::Undecided { .. } => text.push_str("no exponents: the motion ended before\n"),
                _ => text.push_str(&exponents(&found.exponents)),
            }
            let dimensions = found.section_dimension.zip(found.flow_dimension);
            if let Some((section, flow)) = dimensions.filter(|(section, _)| section.value > 0.0) {
                let _ = writeln!(
                    text,
                    "  Kaplan-Yorke dimension {} of the section at one phase, {} of the flow",
                    said(section),
                    said(flow)
                );
            }
            let how = if found.exact() { "exact" } else { "measured" };
            let seen = found.motion.seen_events();
            let seen = seen.map_or_else(String::new, |events| format!(", seen over {}", counted(events, "event")));
            let _ = writeln!(text, "  {how}; the motion is {}{seen}", found.motion.label());
        }
        MachineResults::Branch(found) => {
            if let Some((number, count)) = found.among.filter(|(_, count)| *count > 1) {
                let _ = writeln!(text, "orbit {number} of {count}");
            }
            text.push_str(&branch(machine, &found.points));
            for followed in &found.followed {
                let _ = writeln!(text, "from the {} at {}:", followed.event.name(), short(followed.at));
                text.push_str(&branch(machine, &followed.points));
            }
        }
        MachineResults::Curve(found) => text.push_str(&machine_curve::text(machine, &answer.plan.task, found)),
        MachineResults::Margins(found) => {
            text.push_str(&margins::of_machine(found, machine, motion(machine, &found.motion)));
        }
        MachineResults::Region(found) => {
            text.push_str(&region::of_machine(found, &answer.plan.task, &answer.plan.machine));
        }
        MachineResults::Response(found) => {
            let view = answer.response(found);
            text.push_str(&view.map_or_else(String::new, |view| response::text(&view, view.vary)));
        }
        MachineResults::Basin(found) => {
            for (verdict, (_, share)) in found.motions.iter().zip(found.shares()) {
                let _ = write!(text, "{:>6.1} %  {}", 100.0 * share, motion(machine, verdict));
            }
            let beyond = found.refused();
            if beyond > 0 {
                let _ = writeln!(text, "{} beyond a rigid stop", counted(beyond as u64, "start"));
            }
        }
        MachineResults::Diagram(found) => text.push_str(&diagram::of_machine(found)),
        MachineResults::Map(found) => {
            for (label, count) in found.labels() {
                let seen = found.seen_events().filter(|_| label == "chaotic");
                let seen = seen
                    .map_or_else(String::new, |events| format!(", seen over at least {}", counted(events, "event")));
                let _ = writeln!(text, "{label:>10}  at {}{seen}", counted(count, "point"));
            }
        }
    }
    text
}

/// The events of a branch, and how many points it has.
fn branch(machine: &Machine, points: &[MachinePoint]) -> String {
    let mut text = String::new();
    for point in points.iter().filter(|point| point.event.is_some()) {
        let event = point.event.map_or("", |event| event.name());
        let place = point.event.and_then(|event| event.place());
        let at = place.map_or_else(String::new, |place| format!(" at {}", machine.name_of(place)));
        let cycle = &point.cycle;
        // with forcing the label says the period
        let period =
            if machine.period().is_some() { String::new() } else { format!(", period {}", short(cycle.period)) };
        let _ = writeln!(text, "{:>16}  {event}{at}, {}{period}", short(point.value), cycle.label);
    }
    let of = |stability| points.iter().filter(|point| point.cycle.stability() == stability).count();
    let (stable, neutral) = (of(Stability::Stable), of(Stability::Neutral));
    let neutral = if neutral > 0 { format!(", {neutral} neutral") } else { String::new() };
    let _ = writeln!(text, "{}, {stable} of them stable{neutral}", counted(points.len() as u64, "point"));
    text
}

/// The names of the stops that stay closed for ever.
fn closed(machine: &Machine, verdict: &Verdict<Machine>) -> String {
    let names = verdict.closed().into_iter().map(|stop| machine.name_of(stop));
    names.collect::<Vec<_>>().join(", ")
}

fn motion(machine: &Machine, verdict: &Verdict<Machine>) -> String {
    let stability = verdict.stability(machine).map_or_else(String::new, |stability| format!(", {stability}"));
    match verdict {
        Verdict::Periodic(cycle) => described(machine, cycle),
        Verdict::NoImpact(_) => {
            let closed = closed(machine, verdict);
            let closed = if closed.is_empty() { closed } else { format!(", in contact with {closed}") };
            format!("0{stability}: no further event, for ever{closed}\n")
        }
        Verdict::Stuck(_) => {
            format!("stuck{stability}: at rest on {}, for ever\n", closed(machine, verdict))
        }
        Verdict::Chaotic(Chaos { spectrum, impacts: events, .. }) => {
            format!("chaotic, seen over {}\n{}", counted(*events, "event"), exponents(&spectrum.exponents))
        }
        Verdict::Undecided(Undecided { why, impacts: events, .. }) => {
            let why = match why {
                UndecidedCause::Budget => "the budget is used up".to_owned(),
                UndecidedCause::Unconfirmed => ROUNDING_DECIDES.to_owned(),
                UndecidedCause::Ended(MachineEnd::NoEventWithin) => {
                    let time = short(MachineLimits::default().time);
                    format!("no event within a time of {time} after the last one, and none is excluded later")
                }
                why => undecided(*why).replace('_', " "),
            };
            format!("undecided after {}: {why}\n", counted(*events, "event"))
        }
    }
}

/// The quantities that matter: power and where it goes, and for each stop that closes the largest speed and the largest
/// impulse, or force of a compliant one.
fn quantities(machine: &Machine, verdict: &Verdict<Machine>) -> String {
    let Some(found) = machine_quantities(machine, verdict) else { return String::new() };
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

fn described(machine: &Machine, cycle: &MachineCycle) -> String {
    let mut text = format!("{}, {}, period {}\n", cycle.label, cycle.stability(), short(cycle.period));
    let counts = machine.stops().iter().zip(&cycle.counts).map(|(stop, count)| format!("{} {count}", stop.name));
    if !cycle.counts.is_empty() {
        let _ = writeln!(text, "  closings: {}", counts.collect::<Vec<_>>().join(", "));
    }
    let multipliers = cycle.multipliers.iter().map(|multiplier| {
        let size = short(multiplier.modulus());
        if multiplier.im == 0.0 { short(multiplier.re) } else { format!("|{size}| complex") }
    });
    let _ = writeln!(text, "  multipliers: {}", multipliers.collect::<Vec<_>>().join(", "));
    if cycle.translations() > 0 {
        let by_name = |values: &[f64]| {
            let names = machine.parts().coordinates.iter().zip(values);
            names.map(|(name, value)| format!("{name} {}", short(*value))).collect::<Vec<_>>().join(", ")
        };
        let _ = match cycle.drift.iter().any(|drift| *drift != 0.0) {
            true => {
                writeln!(text, "  drift: {}; mean velocity {}", by_name(&cycle.drift), by_name(&cycle.drift_velocity()))
            }
            false => writeln!(text, "  drift: none"),
        };
    }
    for event in &cycle.events {
        let (what, place) = if machine.period().is_some() { ("phase", event.phase) } else { ("time ", event.time) };
        let _ = writeln!(
            text,
            "  {what} {:<12} {:<8} {:<12} speed {}",
            short(place),
            event.kind.name(),
            machine.name_of(event.place),
            short(event.speed)
        );
    }
    text
}

fn exponents(all: &[Measured]) -> String {
    let mut text = String::new();
    for (k, exponent) in all.iter().enumerate() {
        let value = if exponent.value == f64::NEG_INFINITY {
            "minus infinity".to_owned()
        } else {
            format!("{} +- {}", short(exponent.value), short(exponent.error))
        };
        let _ = writeln!(text, "  exponent {}: {value}", k + 1);
    }
    text
}

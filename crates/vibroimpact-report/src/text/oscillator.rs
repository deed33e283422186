//! The text of the motions of an oscillator.

use crate::json::branch::EventOf;
use crate::json::event::side;
use crate::number::short;
use crate::task::{basin, margins, orbit, region, settle, simulate};
use crate::text::Teller;
use crate::text::branch::because;
use crate::text::words::{EVER_GENTLER, ROUNDING_DECIDES, ROUNDING_GROWS, aligned, counted_word, stop_name};
use crate::{AnswerOf, Asked, Units};
use std::fmt::Write;
use vibroimpact::chaos::Measured;
use vibroimpact::continuation::SolutionPoint;
use vibroimpact::flight::Horizon;
use vibroimpact::orbit::Cycle;
use vibroimpact::quantities::{Quantity, of_verdict};
use vibroimpact::verdict::{Count, NoImpact, Settled, StartBox, Undecided, UndecidedCause, Verdict};
use vibroimpact::{Oscillator, Side, Start};
use vibroimpact_study::{Basin, ImpactsByStop, MotionMargins, Orbit, RegionPlan, Simulated, SystemPlan, Task, counted};

impl Teller for SystemPlan {
    fn heading(of: &AnswerOf<Self>) -> String {
        let system = system(&of.asked(), &of.system);
        let start = || start(&of.start, &of.units);
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
        match verdict {
            Verdict::Periodic(cycle) => {
                let periods = match cycle.label.periods {
                    1 => "every forcing period".to_owned(),
                    n => format!("every {}", counted_word(n, "forcing period")),
                };
                let rests = u32::try_from(cycle.rests.len()).unwrap_or(u32::MAX);
                let rest = if rests == 0 {
                    String::new()
                } else {
                    format!(", and {} on the stop", counted_word(rests, "rest"))
                };
                match cycle.label.impacts {
                    Count::Finite(0) if rests > 0 => format!("it rests on the stop once {periods}, without impacts"),
                    Count::Finite(0) => "the steady motion, without impacts".to_owned(),
                    Count::Finite(m) => format!("{}{rest} {periods}", counted_word(m, "impact")),
                    Count::Infinite => format!("a complete chatter (infinitely many impacts){rest} {periods}"),
                }
            }
            Verdict::NoImpact(NoImpact::ForPeriods(n)) => {
                format!("no impact for at least {} forcing periods", short(*n))
            }
            Verdict::NoImpact(NoImpact::GrazeLimit { .. }) => EVER_GENTLER.into(),
            Verdict::NoImpact(NoImpact::Landing { periods, .. }) => {
                let periods =
                    if *periods == 1 { "forcing period".to_owned() } else { counted_word(*periods, "forcing period") };
                format!("it rests on the stop once every {periods}, without impacts")
            }
            Verdict::NoImpact(NoImpact::Grazing { .. }) => "it touches the stop without impact".into(),
            Verdict::NoImpact(_) => "no more impacts, ever".into(),
            Verdict::Chaotic(chaos) => format!("no repetition in {} impacts", chaos.impacts),
            Verdict::Stuck(at) => format!("at rest on the {} for ever", stop_name(*at)),
            Verdict::Undecided(Undecided { why: UndecidedCause::Unconfirmed, .. }) => ROUNDING_DECIDES.into(),
            Verdict::Undecided(_) => "nothing could be shown within the budget".into(),
        }
    }

    fn by_stop(of: &AnswerOf<Self>, verdict: &Verdict) -> String {
        let counts = ImpactsByStop::of(&of.system, verdict);
        let struck = counts.filter(|by| (by.upper, by.lower) != (Some(0), Some(0)));
        struck.map_or_else(String::new, |by| format!(" ({by})"))
    }

    fn quantity_text(of: &AnswerOf<Self>, verdict: &Verdict, quantity: Quantity) -> String {
        of_verdict(&of.system, verdict).map_or_else(|| "-".into(), |all| of.units.text(&all, quantity))
    }

    fn events_text(of: &AnswerOf<Self>, verdict: &Verdict) -> String {
        let Verdict::Periodic(cycle) = verdict else { return String::new() };
        impacts(of, cycle)
    }

    fn quantities_text(of: &AnswerOf<Self>, verdict: &Verdict) -> String {
        let units = &of.units;
        let Some(all) = &of_verdict(&of.system, verdict) else { return String::new() };
        let of = |quantity: Quantity| units.text(all, quantity);
        let defined = |quantity: Quantity| units.value_of(all, quantity).is_finite();
        let mut text = String::new();
        if all.get(Quantity::ImpactSpeedMax) > 0.0 {
            let _ = write!(text, "  impact speed largest {}", of(Quantity::ImpactSpeedMax));
            if defined(Quantity::ImpactSpeedMean) {
                let _ = write!(text, ", mean {}", of(Quantity::ImpactSpeedMean));
            }
            let _ = writeln!(text, "; impulse {} per forcing period", of(Quantity::ImpulsePerPeriod));
        }
        if units.value_of(all, Quantity::WorkPerPeriod) > 0.0 {
            let _ = writeln!(
                text,
                "  work of the force {} per forcing period: {} lost in impacts, {} in the damper; power {}",
                of(Quantity::WorkPerPeriod),
                of(Quantity::ImpactLossPerPeriod),
                of(Quantity::DampingLossPerPeriod),
                of(Quantity::Power)
            );
        } else if all.get(Quantity::ImpactLossPerPeriod) > 0.0 {
            let _ = writeln!(text, "  lost in impacts {} per forcing period", of(Quantity::ImpactLossPerPeriod));
        }
        if defined(Quantity::DisplacementRms) {
            let _ = writeln!(
                text,
                "  position {} to {}, rms {}; largest speed {}, acceleration {}",
                of(Quantity::DisplacementMin),
                of(Quantity::DisplacementMax),
                of(Quantity::DisplacementRms),
                of(Quantity::VelocityMax),
                of(Quantity::AccelerationMax)
            );
        }
        text
    }

    fn grounds(of: &AnswerOf<Self>, verdict: &Verdict) -> String {
        let (osc, units) = (&of.system, &of.units);
        match verdict {
            Verdict::Periodic(cycle) if cycle.points.is_empty() && cycle.rests.is_empty() => {
                "a closed form; it stays short of the stops".into()
            }
            Verdict::Periodic(cycle) if cycle.rests.is_empty() => format!(
                "Newton's method on the {}-fold impact map returns to itself within {:.0e}; no earlier contact",
                cycle.points.len(),
                cycle.residual.max(1e-16)
            ),
            Verdict::Periodic(_) => {
                "its release leads back to itself, and what follows a release is always the same".into()
            }
            Verdict::NoImpact(NoImpact::Flight(Horizon::Amplitude)) => {
                "the free and the forced amplitude together stay short of the stop".into()
            }
            Verdict::NoImpact(NoImpact::Flight(Horizon::CommonPeriod { p, q })) => {
                format!(
                    "beta = {p}/{q}: {} without contact, after which all repeats",
                    counted(u64::from(*q), "natural period")
                )
            }
            Verdict::NoImpact(NoImpact::GrazeLimit { velocity, phase }) => format!(
                "impact speeds shrink by the restitution each time (last {}), always at phase {}",
                short(velocity * units.velocity()),
                short(*phase)
            ),
            Verdict::NoImpact(NoImpact::Landing { side, .. }) => {
                format!(
                    "the gap is 0 and beta or 1/beta an odd number: it lands on the {} without speed",
                    stop_name(*side)
                )
            }
            Verdict::NoImpact(NoImpact::Grazing { phase }) => {
                format!("touches without speed again and again, at phase {}", short(*phase))
            }
            Verdict::NoImpact(NoImpact::ForPeriods(_)) => "searched that far; nothing is claimed beyond".into(),
            Verdict::Chaotic(chaos) => format!(
                "largest Lyapunov exponent {} per unit of time, {} impacts per forcing period; no cycle, no second rest, no fading",
                measured(chaos.spectrum.exponents[0], 1.0 / units.time()),
                measured(chaos.spectrum.impact_rate, osc.period())
            ),
            Verdict::Stuck(_) => "the force never pulls the mass off the stop".into(),
            Verdict::Undecided(Undecided {
                why: UndecidedCause::Budget | UndecidedCause::Ended(_),
                impacts,
                spectrum,
            }) => {
                format!(
                    "{impacts} impacts without a cycle{}",
                    spectrum.map_or_else(String::new, |s| format!(
                        ", and a largest Lyapunov exponent {} that does not exclude 0",
                        measured(s.exponents[0], 1.0 / units.time())
                    ))
                )
            }
            Verdict::Undecided(Undecided { why: UndecidedCause::Unconfirmed, impacts, .. }) => {
                format!("{impacts} impacts; {ROUNDING_GROWS}")
            }
            Verdict::Undecided(Undecided { why: UndecidedCause::Search { periods }, .. }) => format!(
                "a flight was followed for {} forcing periods without contact, too few to conclude",
                short(*periods)
            ),
        }
    }

    fn simulated(of: &AnswerOf<Self>, found: &Simulated) -> String {
        simulate::text(of, found)
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

/// The system on one line.
fn system(asked: &Asked, osc: &Oscillator) -> String {
    let inverse = asked.system.inverse_beta.unwrap_or(1.0 / osc.beta());
    let mut line = format!(
        "beta {} (1/beta {}), gap {}, restitution {}",
        short(osc.beta()),
        short(inverse),
        short(osc.gap()),
        short(osc.restitution())
    );
    if osc.damping() > 0.0 {
        let _ = write!(line, ", damping {}", short(osc.damping()));
    }
    if let Some(stop) = osc.stop(Side::Lower) {
        let _ = write!(line, ", second gap {}, second restitution {}", short(stop.gap), short(stop.restitution));
    }
    let mut text = format!("system  {line}\n");
    if let Some(scales) = asked.units.scales {
        let _ = writeln!(
            text,
            "scales  one unit of length {} m, of time {} s, of velocity {} m/s",
            short(scales.length),
            short(scales.time),
            short(scales.velocity())
        );
    }
    if let Some(frame) = asked.units.frame {
        let _ = writeln!(
            text,
            "frame   positions relative to the motion of the stop, from {} m; phases {} rad ahead of sin(omega t)",
            short(frame.offset_m),
            short(frame.phase)
        );
    }
    text
}

fn start(start: &Start, units: &Units) -> String {
    format!(
        "start   {} {}, {} {}, phase {}\n",
        units.named("x", "m"),
        short(start.x * units.length()),
        units.named("v", "m/s"),
        short(start.v * units.velocity()),
        short(start.phase)
    )
}

fn measured(m: Measured, factor: f64) -> String {
    format!("{} +- {}", short(m.value * factor), short(m.error * factor))
}

/// Maximum number of impacts shown of a long cycle.
const MOST_IMPACTS: usize = 40;

pub(crate) fn impacts(of: &AnswerOf<SystemPlan>, cycle: &Cycle) -> String {
    let (osc, units) = (&of.system, &of.units);
    if cycle.points.is_empty() {
        return String::new();
    }
    let both = osc.stop(Side::Lower).is_some();
    let mut heads =
        vec!["impact".to_owned(), "phase".into(), units.named("velocity", "m/s"), units.named("interval", "s")];
    if both {
        heads.push("<stop".into());
    }
    let rows: Vec<Vec<String>> = cycle
        .points
        .iter()
        .take(MOST_IMPACTS)
        .enumerate()
        .map(|(k, point)| {
            let mut row = vec![
                (k + 1).to_string(),
                short(point.state.phase),
                short(point.state.velocity * units.velocity()),
                short(point.interval * units.time()),
            ];
            if both {
                row.push(side(point.state.side).into());
            }
            row
        })
        .collect();
    let mut text = aligned(&heads, &rows);
    if cycle.points.len() > MOST_IMPACTS {
        let _ = writeln!(text, "  ... and {} more", cycle.points.len() - MOST_IMPACTS);
    }
    for rest in &cycle.rests {
        let how = if rest.chatter { "chatter ends" } else { "comes to rest" };
        let _ = writeln!(
            text,
            "  {how} on the {} at phase {}, released at phase {}",
            stop_name(rest.side),
            short(rest.begin),
            short(rest.release)
        );
    }
    text
}

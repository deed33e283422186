//! Text about motions: the label, its meaning, the numbers and the grounds of the verdict.

use crate::json::event::side;
use crate::number::short;
use crate::{Asked, Units};
use std::fmt::Write;
use vibroimpact::chaos::Measured;
use vibroimpact::flight::Horizon;
use vibroimpact::math::Multiplier;
use vibroimpact::orbit::Cycle;
use vibroimpact::quantities::{Quantities, Quantity};
use vibroimpact::verdict::{Count, NoImpact, Stability, Undecided, UndecidedCause, Verdict};
use vibroimpact::{Oscillator, Side, Start};
use vibroimpact_study::ImpactsByStop;

/// The system on one line.
pub(crate) fn system(asked: &Asked, osc: &Oscillator) -> String {
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

/// A time with its unit, if there is one.
pub(crate) fn seconds(time: f64, units: &Units) -> String {
    let number = short(time * units.time());
    if units.si { format!("{number} s") } else { number }
}

pub(crate) fn start(start: &Start, units: &Units) -> String {
    format!(
        "start   {} {}, {} {}, phase {}\n",
        units.named("x", "m"),
        short(start.x * units.length()),
        units.named("v", "m/s"),
        short(start.v * units.velocity()),
        short(start.phase)
    )
}

/// A table of columns. Numbers are right-aligned under their heads; texts, whose heads begin with `<`, are
/// left-aligned.
pub(crate) fn aligned(heads: &[String], rows: &[Vec<String>]) -> String {
    let wide = |text: &str| text.chars().count();
    let left: Vec<bool> = heads.iter().map(|head| head.starts_with('<')).collect();
    let heads: Vec<String> = heads.iter().map(|head| head.trim_start_matches('<').to_owned()).collect();
    let widths: Vec<usize> = heads
        .iter()
        .enumerate()
        .map(|(k, head)| rows.iter().filter_map(|row| row.get(k)).map(|cell| wide(cell)).fold(wide(head), usize::max))
        .collect();
    let mut text = String::new();
    for row in core::iter::once(heads.as_slice()).chain(rows.iter().map(Vec::as_slice)) {
        let cells: Vec<String> = row
            .iter()
            .zip(widths.iter().zip(&left))
            .map(|(cell, (width, left))| {
                let air = " ".repeat(width - wide(cell).min(*width));
                if *left { format!("{cell}{air}") } else { format!("{air}{cell}") }
            })
            .collect();
        let _ = writeln!(text, "  {}", cells.join("  ").trim_end());
    }
    text
}

/// A count as text, such as `two impacts`.
pub(crate) fn counted_word(n: u32, one: &str) -> String {
    const WORDS: [&str; 11] = ["no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten"];
    let number =
        usize::try_from(n).ok().and_then(|n| WORDS.get(n)).map_or_else(|| n.to_string(), |word| (*word).to_owned());
    format!("{number} {one}{}", if n == 1 { "" } else { "s" })
}

/// Why the period of a motion that returns to a release is not known.
pub(crate) const ROUNDING_DECIDES: &str =
    "it is periodic, as it returns to a release from rest, but rounding errors decide its period";

/// Why that is so.
pub(crate) const ROUNDING_GROWS: &str =
    "from the release to the next rest the rounding errors grow beyond what tells one motion from another";

/// What a motion is whose impacts fade away.
pub(crate) const EVER_GENTLER: &str = "ever gentler impacts: in the limit it only touches the stop";

/// Why impacts of a machine fade away.
pub(crate) const IMPACTS_FADE: &str = "impact speeds tend to zero, and rounding errors decide how many impacts follow";

/// The meaning of a verdict, as a sentence without full stop.
pub(crate) fn meaning(verdict: &Verdict) -> String {
    match verdict {
        Verdict::Periodic(cycle) => {
            let periods = match cycle.label.periods {
                1 => "every forcing period".to_owned(),
                n => format!("every {}", counted_word(n, "forcing period")),
            };
            let rests = u32::try_from(cycle.rests.len()).unwrap_or(u32::MAX);
            let rest =
                if rests == 0 { String::new() } else { format!(", and {} on the stop", counted_word(rests, "rest")) };
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

/// The impacts of a motion on each of two stops: ` (2 upper, 1 lower)`. Empty with one stop or without impacts.
pub(crate) fn by_stop(verdict: &Verdict, osc: &Oscillator) -> String {
    let counts = ImpactsByStop::of(osc, verdict);
    let struck = counts.filter(|by| (by.upper, by.lower) != (Some(0), Some(0)));
    struck.map_or_else(String::new, |by| format!(" ({by})"))
}

pub(crate) const fn stop_name(side: Side) -> &'static str {
    match side {
        Side::Upper => "stop",
        Side::Lower => "second stop",
    }
}

/// A stability in words; of motions without impacts and without damping, and of chaotic ones.
pub(crate) const fn in_words(stability: Option<Stability>, undamped: bool, chaotic: bool) -> &'static str {
    match stability {
        Some(Stability::Neutral) if undamped => "neutral (no damping)",
        Some(_) if chaotic => "every single motion in it is unstable",
        Some(stability) => stability.name(),
        None => "open",
    }
}

/// The grounds of a verdict.
pub(crate) fn grounds(verdict: &Verdict, osc: &Oscillator, units: &Units) -> String {
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
                vibroimpact_study::counted(u64::from(*q), "natural period")
            )
        }
        Verdict::NoImpact(NoImpact::GrazeLimit { velocity, phase }) => format!(
            "impact speeds shrink by the restitution each time (last {}), always at phase {}",
            short(velocity * units.velocity()),
            short(*phase)
        ),
        Verdict::NoImpact(NoImpact::Landing { side, .. }) => {
            format!("the gap is 0 and beta or 1/beta an odd number: it lands on the {} without speed", stop_name(*side))
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
        Verdict::Undecided(Undecided { why: UndecidedCause::Budget | UndecidedCause::Ended(_), impacts, spectrum }) => {
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

fn measured(m: Measured, factor: f64) -> String {
    format!("{} +- {}", short(m.value * factor), short(m.error * factor))
}

/// The text of multipliers: `0.44, 0.14`, or `0.3 +- 0.4i (modulus 0.5)` for a pair.
pub(crate) fn multipliers(all: &[Multiplier]) -> String {
    let paired =
        |k: usize| all.get(k).zip(all.get(k + 1)).is_some_and(|(a, b)| a.im != 0.0 && a.re == b.re && a.im == -b.im);
    let mut told = Vec::new();
    let mut k = 0;
    while let Some(a) = all.get(k) {
        told.push(match (paired(k), a.im) {
            (true, im) => format!("{} +- {}i (modulus {})", short(a.re), short(im.abs()), short(a.modulus())),
            (false, 0.0) => short(a.re),
            (false, im) => format!("{} + {}i (modulus {})", short(a.re), short(im), short(a.modulus())),
        });
        k += if paired(k) { 2 } else { 1 };
    }
    told.join(", ")
}

/// The quantities of a motion that matter most; all of them are in the JSON.
pub(crate) fn quantities(all: &Quantities, units: &Units) -> String {
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

/// Maximum number of impacts shown of a long cycle.
const MOST_IMPACTS: usize = 40;

pub(crate) fn impacts(cycle: &Cycle, osc: &Oscillator, units: &Units) -> String {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_in_words() {
        assert_eq!(counted_word(1, "impact"), "one impact");
        assert_eq!(counted_word(12, "impact"), "12 impacts");
    }
}

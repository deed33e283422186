//! Lyapunov exponents with error bars, dimensions, how they were obtained, and both sections of an attractor.

use crate::json::event::{Stops, side};
use crate::json::motion::{Estimate, HorizonObject, MotionObject};
use crate::number::{Number, short};
use crate::text::Teller;
use crate::text::words::{aligned, seconds, stop_name};
use crate::{AnswerOf, Table, Told, Units};
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt::Write;
use vibroimpact::QuantityKind;
use vibroimpact::chaos::{Exponents, Grounds, Measured};
use vibroimpact::events::Start;
use vibroimpact::verdict::{NoImpact, System};
use vibroimpact_study::{SectionPoints, SystemPlan};

/// The answer to `vibro lyapunov`.
#[derive(JsonSchema, Serialize)]
pub struct LyapunovAnswer<'a> {
    /// The motion after the transient.
    motion: MotionObject<'a>,
    /// Per unit of time, the largest first; null if the motion ends in a way for which there are none.
    exponents: Option<Vec<Estimate>>,
    /// Per forcing period; null without forcing.
    exponents_per_period: Option<Vec<Estimate>>,
    /// Number of closings of stops in a forcing period.
    impacts_per_period: Option<Estimate>,
    /// Whether they are those of a cycle or of a motion without impacts, and not measured.
    exact: bool,
    /// The measured sum of both exponents of an oscillator.
    #[serde(skip_serializing_if = "Option::is_none")]
    sum: Option<Estimate>,
    /// The exact value of this sum: 2 ln(eps) times the rate of impacts, minus 2 zeta.
    #[serde(skip_serializing_if = "Option::is_none")]
    identity: Option<f64>,
    /// Kaplan-Yorke dimensions; null where the largest exponent is not known to differ from 0.
    dimension: Dimensions,
    /// How the exponents of an oscillator were obtained: `measured`, `no_impact`, `sticks`, `stuck`, `touches` or
    /// `undecided`.
    #[serde(skip_serializing_if = "Option::is_none")]
    grounds: Option<GroundsObject>,
}

/// Kaplan-Yorke dimensions; `null` if the larger exponent is not known to differ from 0.
#[derive(JsonSchema, Serialize)]
struct Dimensions {
    /// Dimension of the stroboscopic section.
    section: Option<Estimate>,
    /// Dimension of the flow in the space of coordinates, velocities and phase.
    flow: Option<Estimate>,
}

#[derive(JsonSchema, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
enum GroundsObject {
    Measured { impacts: u64, transient: u64, time: f64, blocks: u32 },
    NoImpact { horizon: HorizonObject },
    Sticks { stop: &'static str },
    Stuck { stop: &'static str },
    Touches { horizon: HorizonObject },
    Undecided { impacts: u64 },
}

impl<'a> LyapunovAnswer<'a> {
    /// Those of any system. A machine whose motion ended before has none.
    pub(crate) fn new<D: Told>(of: &'a AnswerOf<D>, found: &'a Exponents<D::System>) -> Self {
        let known = D::machine(of).is_none() || !matches!(found.grounds, Grounds::Undecided { .. });
        let period = D::period(of).filter(|_| known);
        let all = |factor: f64| found.exponents.iter().map(|of| Estimate::from(of.scaled(factor))).collect();
        Self {
            motion: D::motion(of, &found.motion),
            exponents: known.then(|| all(1.0 / of.units.time())),
            exponents_per_period: period.map(all),
            impacts_per_period: period.map(|period| Estimate::from(found.impact_rate.scaled(period))),
            exact: found.exact(),
            sum: None,
            identity: None,
            dimension: Dimensions {
                section: found.section_dimension.map(Estimate::from),
                flow: found.flow_dimension.map(Estimate::from),
            },
            grounds: None,
        }
    }

    /// With what is known of an oscillator only. Its motion is without the less precise exponent of the verdict.
    pub(crate) fn of_oscillator(of: &'a AnswerOf<SystemPlan>, found: &'a Exponents) -> Self {
        let (any, time) = (Self::new(of, found), of.units.time());
        let identity = found.identity / time;
        let grounds = match found.grounds {
            Grounds::Measured { impacts, transient, time: measured, blocks } => {
                Some(GroundsObject::Measured { impacts, transient, time: measured * time, blocks })
            }
            Grounds::Flight(why) => Some(GroundsObject::NoImpact { horizon: HorizonObject::new(&why) }),
            Grounds::Sticks(at) => Some(GroundsObject::Sticks { stop: side(at) }),
            Grounds::Stuck(at) => Some(GroundsObject::Stuck { stop: side(at) }),
            Grounds::Touches(why) => Some(GroundsObject::Touches { horizon: HorizonObject::new(&why) }),
            Grounds::Undecided { impacts } => Some(GroundsObject::Undecided { impacts }),
            Grounds::Exact => None,
        };
        Self {
            motion: any.motion.without_lyapunov(),
            sum: Some(Estimate::from(found.sum.scaled(1.0 / time))),
            identity: identity.is_finite().then_some(identity),
            grounds,
            ..any
        }
    }
}

/// The table of `vibro lyapunov`, with these names of the coordinates and velocities: the closings first, with the state after
/// each, then the states at phase 0. The section is `closing` or `strobe`.
pub(crate) fn table<'a>(
    points: &'a SectionPoints,
    system: &'a impl Stops,
    (q, qdot): &(Vec<String>, Vec<String>),
    units: Units,
) -> Table<'a> {
    let row = move |begin: String, at: &Start| {
        let (q, qdot) = (at.q.iter().map(|x| x * units.length()), at.qdot.iter().map(|v| v * units.velocity()));
        begin + &q.chain(qdot).map(|x| format!(",{}", Number(x))).collect::<String>()
    };
    let closings = points.closings.iter().map(move |at| {
        let (stop, speed) = (system.name_of_stop(at.stop), Number(at.speed * units.velocity()));
        row(format!("closing,{stop},{},{speed}", Number(at.state.phase)), &at.state)
    });
    let strobes = points.strobes.iter().map(move |at| row(format!("strobe,,{},", Number(at.phase)), at));
    let header = [&["section,stop,phase".to_owned(), units.column("speed", QuantityKind::Velocity)][..], q, qdot];
    Table::new(header.concat().join(","), closings.chain(strobes))
}

/// The text of a measured number: `0.01862 +- 0.00023`, rounded according to its error; `minus infinity`, `none`, or
/// the number alone if it is exact.
fn said(of: Measured) -> String {
    if of.value == f64::NEG_INFINITY {
        "minus infinity".into()
    } else if of.error == 0.0 || !of.value.is_finite() {
        short(of.value)
    } else if of.error < 1e-6 * of.value.abs() {
        // very small errors are printed with an exponent, because they would need too many digits
        format!("{} +- {:.0e}", short(of.value), of.error)
    } else {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // between 0 and 9
        let places = (1.0 - of.error.log10().floor()).clamp(0.0, 9.0) as usize;
        format!("{:.places$} +- {:.places$}", of.value, of.error)
    }
}

/// The motion, its exponents, and how they were obtained. A machine whose motion ended before has none.
pub(crate) fn text<D: Teller>(of: &AnswerOf<D>, found: &Exponents<D::System>) -> String {
    let (units, machine) = (&of.units, D::machine(of));
    let ended = machine.is_some() && matches!(found.grounds, Grounds::Undecided { .. });
    let named: Vec<(String, Measured)> = match machine {
        None => {
            let names = ["larger exponent", "smaller exponent", "their sum"].map(str::to_owned);
            names.into_iter().zip(found.exponents.iter().copied().chain([found.sum])).collect()
        }
        Some(_) => {
            let all = found.exponents.iter().filter(|_| !ended).enumerate();
            all.map(|(k, of)| (format!("exponent {}", k + 1), *of)).collect()
        }
    };
    let mut heads = vec!["<".to_owned(), format!("<per {}", if units.si { "second" } else { "unit of time" })];
    heads.extend(D::period(of).map(|_| "<per forcing period".to_owned()));
    let row = |(name, measured): (String, Measured)| {
        let per_time = measured.scaled(1.0 / units.time());
        let per_period = D::period(of).map(|period| said(per_time.scaled(period * units.time())));
        [name, said(per_time)].into_iter().chain(per_period).collect()
    };
    let rows: Vec<Vec<String>> = named.into_iter().map(row).collect();
    let mut text = format!("{}: {}\n", found.motion.label(), D::meaning(of, &found.motion));
    text.push_str(&if rows.is_empty() { "  no exponents\n".to_owned() } else { aligned(&heads, &rows) });
    if let Some(period) = D::period(of).filter(|_| !ended) {
        let _ = writeln!(text, "  impacts per forcing period {}", said(found.impact_rate.scaled(period)));
    }
    let space = machine.map_or("x, v and phase", |_| "coordinates, velocities and phase");
    let _ = match found.section_dimension.zip(found.flow_dimension) {
        Some((section, flow)) => writeln!(
            text,
            "  Kaplan-Yorke dimension {} of the stroboscopic section, {} of the flow in {space}",
            said(section),
            said(flow)
        ),
        _ => writeln!(text, "  no Kaplan-Yorke dimension: the larger exponent is not known to differ from 0"),
    };
    let grounds = machine.map_or_else(|| grounds(found, units), |_| grounds_of_machine(&found.grounds));
    let _ = writeln!(text, "  {grounds}");
    text
}

fn grounds_of_machine(of: &Grounds) -> String {
    match of {
        Grounds::Undecided { .. } => "the motion ended before".to_owned(),
        Grounds::Measured { time, .. } => format!("measured over a time of {}", short(*time)),
        _ => "exact: those of a cycle, or of a motion without further events".to_owned(),
    }
}

fn grounds<S: System>(found: &Exponents<S>, units: &Units) -> String {
    match found.grounds {
        Grounds::Measured { impacts, transient, time, blocks } => {
            let mut text = format!(
                "measured over {impacts} impacts and a time of {}, after {transient} impacts; +- is three standard errors, from {blocks} blocks",
                seconds(time, units)
            );
            if found.identity.is_finite() {
                let _ = write!(
                    text,
                    "\n  the sum is 2 ln(eps) times the rate of impacts less 2 zeta, to within {:.0e}",
                    (found.sum.value - found.identity).abs().max(1e-16)
                );
            }
            text
        }
        Grounds::Flight(NoImpact::ForPeriods(n)) => {
            format!("those of the flight; no impact for at least {} forcing periods", short(n))
        }
        Grounds::Flight(_) => "those of the flight, exact: there are no more impacts".into(),
        Grounds::Sticks(at) => {
            format!("it comes to rest on the {} in every turn, and a release forgets all before it", stop_name(at))
        }
        Grounds::Exact => "exact".into(),
        Grounds::Stuck(at) => format!("it rests on the {} for ever, whatever came before", stop_name(at)),
        Grounds::Touches(_) => "it only touches the stop, and a touch has no derivative".into(),
        Grounds::Undecided { impacts } => format!("the search ran out after {impacts} impacts"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_many_digits_as_the_error_leaves() {
        for (value, error, text) in [
            (0.018_622_8, 0.000_226, "0.01862 +- 0.00023"),
            (-123.456, 4.2, "-123.5 +- 4.2"),
            (12_345.6, 420.0, "12346 +- 420"),
            (0.5, 5e-14, "0.5 +- 5e-14"),
            (0.25, 0.0, "0.25"),
            (f64::NEG_INFINITY, 0.0, "minus infinity"),
            (f64::INFINITY, 0.0, "infinite"),
            (f64::NAN, 0.0, "none"),
        ] {
            assert_eq!(said(Measured { value, error }), text);
        }
    }
}

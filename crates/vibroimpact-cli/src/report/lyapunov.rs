//! Lyapunov exponents as text and JSON, sections as a table.

use crate::args::Units;
use crate::report::csv::Number;
use crate::report::json::{HorizonObject, Motion, side};
use crate::report::text::{meaning, short, table};
use serde::Serialize;
use std::fmt::Write;
use vibroimpact::chaos::{Exponents, Grounds, Measured, Section};
use vibroimpact::verdict::{NoImpact, Verdict};
use vibroimpact::{Oscillator, Side};

/// The columns of the table of both sections.
pub(crate) const COLUMNS: &str = "section,side,phase,x,v";

/// One row a point, the impacts first.
pub(crate) fn rows<'a>(points: &'a Section, osc: &'a Oscillator, units: Units) -> impl Iterator<Item = String> + 'a {
    let state = move |phase, x: f64, v: f64| {
        format!("{},{},{}", Number(phase), Number(x * units.length()), Number(v * units.velocity()))
    };
    let impacts = points.impacts.iter().map(move |at| {
        let (sign, gap) = (at.side.sign(), osc.stop(at.side).map_or(0.0, |stop| stop.gap));
        format!("impact,{},{}", side(at.side), state(at.phase, sign * gap, sign * at.velocity))
    });
    impacts.chain(points.strobes.iter().map(move |at| format!("strobe,,{}", state(at.phase, at.x, at.v))))
}

/// The command's part of the object.
#[derive(Serialize)]
pub(crate) struct Answer {
    motion: Motion,
    /// Per unit of time.
    exponents: [Quantity; 2],
    exponents_per_period: [Quantity; 2],
    sum: Quantity,
    /// What the sum must be.
    identity: Option<f64>,
    impacts_per_period: Quantity,
    dimension: Dimension,
    grounds: GroundsObject,
}

/// A number with its error; where it is none, why.
#[derive(Serialize)]
struct Quantity {
    value: Option<f64>,
    error: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    why: Option<&'static str>,
}

/// Kaplan-Yorke dimensions; `null` where the larger exponent is not known to differ from 0.
#[derive(Serialize)]
struct Dimension {
    /// Of the stroboscopic section.
    section: Option<Quantity>,
    /// Of the flow in the space of position, velocity and phase.
    flow: Option<Quantity>,
}

#[derive(Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
enum GroundsObject {
    Measured { impacts: u64, transient: u64, time: f64, blocks: u32 },
    NoImpact { horizon: HorizonObject },
    Sticks { side: &'static str },
    Stuck { side: &'static str },
    Touches { horizon: HorizonObject },
    Undecided { impacts: u64 },
}

impl Quantity {
    fn new(of: Measured) -> Self {
        let why = if of.value.is_nan() {
            Some("undefined")
        } else if of.value == f64::NEG_INFINITY {
            Some("minus_infinity")
        } else {
            of.value.is_infinite().then_some("infinity")
        };
        let known = |x: f64| x.is_finite().then_some(x);
        Self { value: known(of.value), error: known(of.error).filter(|_| why.is_none()), why }
    }
}

impl Answer {
    pub(crate) fn new(verdict: &Verdict, found: &Exponents, osc: &Oscillator, units: &Units) -> Self {
        let per_time = |of: Measured| Quantity::new(scaled(of, 1.0 / units.time()));
        let identity = found.identity / units.time();
        Self {
            motion: Motion::new(verdict, osc, units).without_lyapunov(),
            exponents: found.exponents.map(per_time),
            exponents_per_period: found.per_period().map(Quantity::new),
            sum: per_time(found.sum),
            identity: identity.is_finite().then_some(identity),
            impacts_per_period: Quantity::new(found.impacts_per_period),
            dimension: Dimension {
                section: found.section_dimension.map(Quantity::new),
                flow: found.flow_dimension().map(Quantity::new),
            },
            grounds: match found.grounds {
                Grounds::Measured { impacts, transient, time, blocks } => {
                    GroundsObject::Measured { impacts, transient, time: time * units.time(), blocks }
                }
                Grounds::Flight(why) => GroundsObject::NoImpact { horizon: HorizonObject::new(&why) },
                Grounds::Sticks(at) => GroundsObject::Sticks { side: side(at) },
                Grounds::Stuck(at) => GroundsObject::Stuck { side: side(at) },
                Grounds::Touches(why) => GroundsObject::Touches { horizon: HorizonObject::new(&why) },
                Grounds::Undecided { impacts } => GroundsObject::Undecided { impacts },
            },
        }
    }
}

fn scaled(of: Measured, factor: f64) -> Measured {
    Measured { value: of.value * factor, error: of.error * factor }
}

/// A number in words: `0.01862 +- 0.00023`, with the digits that its error leaves; `minus infinity`, `none`, or as it is where
/// it is exact.
fn said(of: Measured) -> String {
    if of.value == f64::NEG_INFINITY {
        "minus infinity".into()
    } else if of.error == 0.0 || !of.value.is_finite() {
        short(of.value)
    } else if of.error < 1e-6 * of.value.abs() {
        // more digits than anyone reads
        format!("{} +- {:.0e}", short(of.value), of.error)
    } else {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // between 0 and 9
        let places = (1.0 - of.error.log10().floor()).clamp(0.0, 9.0) as usize;
        format!("{:.places$} +- {:.places$}", of.value, of.error)
    }
}

/// What the motion is, its exponents, and on what grounds.
pub(crate) fn text(verdict: &Verdict, found: &Exponents, units: &Units) -> String {
    let mut text = format!("{}: {}\n", verdict.label(), meaning(verdict));
    let per_time = |of: Measured| said(scaled(of, 1.0 / units.time()));
    let heads = [
        "<".into(),
        format!("<per {}", if units.si { "second" } else { "unit of time" }),
        "<per forcing period".into(),
    ];
    let row = |name: &str, of: Measured| vec![name.into(), per_time(of), said(scaled(of, found.period))];
    let [one, two] = found.exponents;
    let rows = [row("larger exponent", one), row("smaller exponent", two), row("their sum", found.sum)];
    text.push_str(&table(&heads, &rows));
    let _ = writeln!(text, "  impacts per forcing period {}", said(found.impacts_per_period));
    let _ = match (found.section_dimension, found.flow_dimension()) {
        (Some(section), Some(flow)) => writeln!(
            text,
            "  Kaplan-Yorke dimension {} of the stroboscopic section, {} of the flow in x, v and phase",
            said(section),
            said(flow)
        ),
        _ => writeln!(text, "  no Kaplan-Yorke dimension: the larger exponent is not known to differ from 0"),
    };
    let _ = writeln!(text, "  {}", grounds(found, units));
    text
}

const fn stop(side: Side) -> &'static str {
    match side {
        Side::Upper => "stop",
        Side::Lower => "second stop",
    }
}

fn grounds(found: &Exponents, units: &Units) -> String {
    match found.grounds {
        Grounds::Measured { impacts, transient, time, blocks } => {
            let mut text = format!(
                "measured over {impacts} impacts and a time of {}, after {transient} impacts; +- is three standard errors, from {blocks} blocks",
                short(time * units.time())
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
            format!("it comes to rest on the {} in every turn, and a release forgets all before it", stop(at))
        }
        Grounds::Stuck(at) => format!("it rests on the {} for ever, whatever came before", stop(at)),
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

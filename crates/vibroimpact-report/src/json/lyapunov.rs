//! Lyapunov exponents with error bars, dimensions, and how they were obtained.

use super::Document;
use super::motion::{HorizonObject, MotionFields, side};
use crate::{Asked, Units};
use serde::Serialize;
use vibroimpact::chaos::{Exponents, Grounds, Measured};
use vibroimpact::{Oscillator, Start};
use vibroimpact_study::Plan;

/// The fields of `vibro lyapunov`.
#[derive(Serialize)]
struct LyapunovFields {
    motion: MotionFields,
    /// Per unit of time.
    exponents: [Quantity; 2],
    exponents_per_period: [Quantity; 2],
    sum: Quantity,
    /// The exact value of the sum.
    identity: Option<f64>,
    impacts_per_period: Quantity,
    dimension: QuantityKind,
    grounds: GroundsObject,
}

/// The object of `vibro lyapunov`.
#[must_use]
pub fn document<'a>(
    asked: &Asked,
    plan: &'a Plan,
    (osc, start): (&Oscillator, &Start),
    found: &Exponents,
) -> impl Serialize + use<'a> {
    Document::new(asked, osc, plan, LyapunovFields::new(found, osc, &asked.units)).start(start, &asked.units)
}

/// A number with its error; if it is not finite, the reason.
#[derive(Serialize)]
struct Quantity {
    value: Option<f64>,
    error: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    why: Option<&'static str>,
}

/// Kaplan-Yorke dimensions; `null` if the larger exponent is not known to differ from 0.
#[derive(Serialize)]
struct QuantityKind {
    /// QuantityKind of the stroboscopic section.
    section: Option<Quantity>,
    /// QuantityKind of the flow in the space of position, velocity and phase.
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

impl LyapunovFields {
    fn new(found: &Exponents, osc: &Oscillator, units: &Units) -> Self {
        let per_time = |of: Measured| Quantity::new(scaled(of, 1.0 / units.time()));
        let identity = found.identity / units.time();
        Self {
            motion: MotionFields::new(&found.motion, osc, units).without_lyapunov(),
            exponents: found.exponents.map(per_time),
            exponents_per_period: found.per_period().map(Quantity::new),
            sum: per_time(found.sum),
            identity: identity.is_finite().then_some(identity),
            impacts_per_period: Quantity::new(found.impacts_per_period),
            dimension: QuantityKind {
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

/// A measured number and its error, multiplied by a factor.
#[must_use]
pub fn scaled(of: Measured, factor: f64) -> Measured {
    Measured { value: of.value * factor, error: of.error * factor }
}

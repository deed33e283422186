//! Lyapunov exponents with error bars, dimensions, and how they were obtained.

use super::Document;
use super::event::side;
use super::motion::{Estimate, HorizonObject, MotionObject};
use crate::{Asked, Units};
use serde::Serialize;
use vibroimpact::chaos::{Exponents, Grounds, Measured};
use vibroimpact::{Oscillator, Start};
use vibroimpact_study::Plan;

/// The fields of `vibro lyapunov`.
#[derive(Serialize)]
struct LyapunovFields<'a> {
    motion: MotionObject<'a>,
    /// Per unit of time.
    exponents: [Estimate; 2],
    exponents_per_period: [Estimate; 2],
    sum: Estimate,
    /// The exact value of the sum.
    identity: Option<f64>,
    impacts_per_period: Estimate,
    dimension: Dimensions,
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

/// Kaplan-Yorke dimensions; `null` if the larger exponent is not known to differ from 0.
#[derive(Serialize)]
struct Dimensions {
    /// Dimension of the stroboscopic section.
    section: Option<Estimate>,
    /// Dimension of the flow in the space of position, velocity and phase.
    flow: Option<Estimate>,
}

#[derive(Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
enum GroundsObject {
    Measured { impacts: u64, transient: u64, time: f64, blocks: u32 },
    NoImpact { horizon: HorizonObject },
    Sticks { stop: &'static str },
    Stuck { stop: &'static str },
    Touches { horizon: HorizonObject },
    Undecided { impacts: u64 },
}

impl LyapunovFields<'_> {
    fn new(found: &Exponents, osc: &Oscillator, units: &Units) -> Self {
        let per_time = |of: Measured| Estimate::from(scaled(of, 1.0 / units.time()));
        let identity = found.identity / units.time();
        Self {
            motion: MotionObject::of_oscillator(&found.motion, osc, units).without_lyapunov(),
            exponents: found.exponents.map(per_time),
            exponents_per_period: found.per_period().map(Estimate::from),
            sum: per_time(found.sum),
            identity: identity.is_finite().then_some(identity),
            impacts_per_period: Estimate::from(found.impacts_per_period),
            dimension: Dimensions {
                section: found.section_dimension.map(Estimate::from),
                flow: found.flow_dimension().map(Estimate::from),
            },
            grounds: match found.grounds {
                Grounds::Measured { impacts, transient, time, blocks } => {
                    GroundsObject::Measured { impacts, transient, time: time * units.time(), blocks }
                }
                Grounds::Flight(why) => GroundsObject::NoImpact { horizon: HorizonObject::new(&why) },
                Grounds::Sticks(at) => GroundsObject::Sticks { stop: side(at) },
                Grounds::Stuck(at) => GroundsObject::Stuck { stop: side(at) },
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

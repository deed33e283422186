//! Lyapunov exponents with error bars, dimensions, and how they were obtained.

use super::event::side;
use super::motion::{Estimate, HorizonObject, MotionObject};
use crate::Units;
use schemars::JsonSchema;
use serde::Serialize;
use vibroimpact::Oscillator;
use vibroimpact::chaos::{Exponents, Grounds, Measured};
use vibroimpact::machine::Machine;

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
    pub(crate) fn of_oscillator(found: &'a Exponents, osc: &Oscillator, units: &Units) -> Self {
        let per_time = |of: Measured| Estimate::from(of.scaled(1.0 / units.time()));
        let identity = found.identity / units.time();
        Self {
            motion: MotionObject::of_oscillator(&found.motion, osc, units).without_lyapunov(),
            exponents: Some(found.exponents.iter().map(|of| per_time(*of)).collect()),
            exponents_per_period: Some(
                found.exponents.iter().map(|of| Estimate::from(of.scaled(osc.period()))).collect(),
            ),
            exact: found.exact(),
            sum: Some(per_time(found.sum)),
            identity: identity.is_finite().then_some(identity),
            impacts_per_period: Some(Estimate::from(found.impact_rate.scaled(osc.period()))),
            dimension: Dimensions {
                section: found.section_dimension.map(Estimate::from),
                flow: found.flow_dimension.map(Estimate::from),
            },
            grounds: match found.grounds {
                Grounds::Measured { impacts, transient, time, blocks } => {
                    Some(GroundsObject::Measured { impacts, transient, time: time * units.time(), blocks })
                }
                Grounds::Flight(why) => Some(GroundsObject::NoImpact { horizon: HorizonObject::new(&why) }),
                Grounds::Sticks(at) => Some(GroundsObject::Sticks { stop: side(at) }),
                Grounds::Stuck(at) => Some(GroundsObject::Stuck { stop: side(at) }),
                Grounds::Touches(why) => Some(GroundsObject::Touches { horizon: HorizonObject::new(&why) }),
                Grounds::Undecided { impacts } => Some(GroundsObject::Undecided { impacts }),
                Grounds::Exact => None,
            },
        }
    }

    pub(crate) fn of_machine(machine: &'a Machine, found: &'a Exponents<Machine>) -> Self {
        let known = !matches!(found.grounds, Grounds::Undecided { .. });
        let period = machine.period().filter(|_| known);
        let all = |factor: f64| found.exponents.iter().map(|of| Estimate::from(of.scaled(factor))).collect();
        Self {
            motion: MotionObject::of_machine(machine, &found.motion),
            exponents: known.then(|| all(1.0)),
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
}

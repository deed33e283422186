//! Lyapunov exponents with error bars, dimensions, and how they were obtained.

use super::event::side;
use super::motion::{Estimate, HorizonObject, MotionObject};
use crate::answer::{AnswerOf, Told};
use schemars::JsonSchema;
use serde::Serialize;
use vibroimpact::chaos::{Exponents, Grounds};
use vibroimpact_study::SystemPlan;

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

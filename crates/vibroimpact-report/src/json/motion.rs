//! A motion: its label, its impacts and phases of sticking, its stability, and the grounds of the verdict.

use super::quantities::{QuantityErrors, QuantityFields};
use crate::Units;
use serde::Serialize;
use vibroimpact::chaos::Measured;
use vibroimpact::flight::Horizon;
use vibroimpact::math::Multiplier;
use vibroimpact::orbit::Cycle;
use vibroimpact::quantities::{errors_of_verdict, of_verdict};
use vibroimpact::verdict::{Chaos, Count, NoImpact, Stability, Undecided, Verdict};
use vibroimpact::{Oscillator, Side};
use vibroimpact_study::ImpactsByStop;

/// The name of a stop.
#[must_use]
pub const fn side(side: Side) -> &'static str {
    match side {
        Side::Upper => "upper",
        Side::Lower => "lower",
    }
}

/// The JSON object of a motion.
#[derive(Serialize)]
pub struct MotionFields {
    kind: &'static str,
    label: String,
    impacts: Option<u32>,
    /// Impacts on each stop, if there are two; the inner number is none for infinitely many.
    #[serde(skip_serializing_if = "Option::is_none")]
    impacts_upper: Option<Option<u32>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    impacts_lower: Option<Option<u32>>,
    periods: Option<u32>,
    sticks: Option<usize>,
    stable: Option<bool>,
    stability: Option<&'static str>,
    multipliers: Option<[[f64; 2]; 2]>,
    cycle: Vec<CyclePoint>,
    #[serde(skip_serializing_if = "Option::is_none")]
    chatter_end: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    release: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    rests: Option<Vec<Rest>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    lyapunov: Option<Estimate>,
    /// Number of impacts over which chaos was measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    seen_impacts: Option<u64>,
    /// Chaos before the motion settled.
    #[serde(skip_serializing_if = "Option::is_none")]
    chaotic_transient: Option<Transient>,
    #[serde(skip_serializing_if = "Option::is_none")]
    horizon: Option<HorizonObject>,
    #[serde(skip_serializing_if = "Option::is_none")]
    residual: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    side: Option<&'static str>,
    /// The stop on which a stuck motion rests; also as a list, as that of a machine that rests on several.
    #[serde(skip_serializing_if = "Option::is_none")]
    stop: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    stops: Option<[&'static str; 1]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tried: Option<Tried>,
    quantities: Option<QuantityFields>,
    /// Three standard errors of the means among the quantities of a chaotic motion.
    #[serde(skip_serializing_if = "Option::is_none")]
    quantities_error: Option<QuantityErrors>,
}

/// An impact of a cycle.
#[derive(Serialize)]
pub(super) struct CyclePoint {
    phase: f64,
    velocity_before: f64,
    interval: f64,
    side: &'static str,
}

/// A phase of sticking of a cycle.
#[derive(Serialize)]
pub(super) struct Rest {
    side: &'static str,
    chatter: bool,
    begin: f64,
    release: f64,
}

#[derive(Serialize)]
struct Estimate {
    value: f64,
    error: f64,
}

impl Estimate {
    fn per_time(of: Measured, units: &Units) -> Self {
        Self { value: of.value / units.time(), error: of.error / units.time() }
    }
}

#[derive(Serialize)]
struct Transient {
    /// The number of the impact by which it had ended.
    impacts: u64,
    lyapunov: Estimate,
}

#[derive(Serialize)]
struct Tried {
    #[serde(skip_serializing_if = "Option::is_none")]
    impacts: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    periods: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    lyapunov: Option<Estimate>,
}

/// Why there are no more impacts, and for how many periods.
#[derive(Serialize)]
pub(super) struct HorizonObject {
    kind: &'static str,
    periods: Option<f64>,
    why: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    common_period: Option<CommonPeriod>,
}

#[derive(Serialize)]
struct CommonPeriod {
    forcing_periods: u32,
    natural_periods: u32,
}

impl HorizonObject {
    pub(super) fn new(no_impact: &NoImpact) -> Self {
        let forever = |why| Self { kind: "forever", periods: None, why, common_period: None };
        match no_impact {
            NoImpact::Flight(Horizon::Amplitude) => forever("amplitude"),
            NoImpact::Flight(Horizon::CommonPeriod { p, q }) => Self {
                common_period: Some(CommonPeriod { forcing_periods: *p, natural_periods: *q }),
                ..forever("common_period")
            },
            NoImpact::GrazeLimit { .. } => forever("graze_limit"),
            NoImpact::Landing { .. } => forever("landing"),
            NoImpact::Grazing { .. } => forever("grazing"),
            NoImpact::ForPeriods(n) => Self { kind: "periods", periods: Some(*n), why: "search", common_period: None },
        }
    }
}

impl MotionFields {
    /// The object of a verdict, in these units.
    #[must_use]
    pub fn new(verdict: &Verdict, osc: &Oscillator, units: &Units) -> Self {
        let by_stop = ImpactsByStop::of(osc, verdict);
        let stability = verdict.stability(osc);
        let bare = Self {
            kind: "undecided",
            label: verdict.label().into_owned(),
            impacts: None,
            impacts_upper: by_stop.map(|by| by.upper),
            impacts_lower: by_stop.map(|by| by.lower),
            periods: None,
            sticks: None,
            stable: stability.map(Stability::is_stable),
            stability: stability.map(Stability::name),
            multipliers: verdict.multipliers(osc).map(pairs),
            cycle: Vec::new(),
            chatter_end: None,
            release: None,
            rests: None,
            lyapunov: None,
            seen_impacts: None,
            chaotic_transient: None,
            horizon: None,
            residual: None,
            side: None,
            stop: None,
            stops: None,
            tried: None,
            quantities: of_verdict(osc, verdict).map(|values| QuantityFields::new(values, units)),
            quantities_error: errors_of_verdict(osc, verdict).map(|errors| QuantityErrors::new(errors, units)),
        };
        match verdict {
            Verdict::Periodic(cycle) => Self::periodic(cycle, bare, units),
            Verdict::NoImpact(no_impact) => Self {
                kind: "no_impact",
                impacts: Some(0),
                periods: Some(if let NoImpact::Landing { periods, .. } = no_impact { *periods } else { 1 }),
                sticks: Some(usize::from(matches!(no_impact, NoImpact::Landing { .. }))),
                horizon: Some(HorizonObject::new(no_impact)),
                ..bare
            },
            Verdict::Chaotic(chaos) => Self {
                kind: "chaotic",
                lyapunov: Some(Estimate::per_time(chaos.spectrum.exponents[0], units)),
                seen_impacts: Some(chaos.impacts),
                ..bare
            },
            Verdict::Stuck(at) => Self {
                kind: "stuck",
                impacts: Some(0),
                periods: Some(1),
                sticks: Some(1),
                side: Some(side(*at)),
                stop: Some(side(*at)),
                stops: Some([side(*at)]),
                ..bare
            },
            Verdict::Undecided(Undecided::Impacts { impacts, spectrum }) => Self {
                tried: Some(Tried {
                    impacts: Some(*impacts),
                    periods: None,
                    lyapunov: spectrum.map(|s| Estimate::per_time(s.exponents[0], units)),
                }),
                ..bare
            },
            Verdict::Undecided(Undecided::Search { periods }) => {
                Self { tried: Some(Tried { impacts: None, periods: Some(*periods), lyapunov: None }), ..bare }
            }
        }
    }

    /// Adds the chaos that preceded the motion.
    pub(super) fn after(self, transient: Option<Chaos>, units: &Units) -> Self {
        let told = |chaos: Chaos| Transient {
            impacts: chaos.impacts,
            lyapunov: Estimate::per_time(chaos.spectrum.exponents[0], units),
        };
        Self { chaotic_transient: transient.map(told), ..self }
    }

    /// Removes the exponent of the verdict, for a report with a more precise one.
    pub(super) fn without_lyapunov(self) -> Self {
        Self { lyapunov: None, tried: self.tried.map(|tried| Tried { lyapunov: None, ..tried }), ..self }
    }

    fn periodic(cycle: &Cycle, bare: Self, units: &Units) -> Self {
        let rests = rests(cycle);
        // the list of impacts begins at the release that ends the last phase of sticking
        let last = cycle.rests.last();
        Self {
            kind: "periodic",
            impacts: match cycle.label.impacts {
                Count::Finite(m) => Some(m),
                Count::Infinite => None,
            },
            periods: Some(cycle.label.periods),
            sticks: Some(rests.len()),
            cycle: impacts(cycle, units),
            chatter_end: last.filter(|rest| rest.chatter).map(|rest| rest.begin),
            release: last.map(|rest| rest.release),
            rests: (!rests.is_empty()).then_some(rests),
            residual: Some(cycle.residual),
            ..bare
        }
    }
}

/// The impacts of a cycle.
pub(super) fn impacts(cycle: &Cycle, units: &Units) -> Vec<CyclePoint> {
    cycle
        .points
        .iter()
        .map(|point| CyclePoint {
            phase: point.state.phase,
            velocity_before: point.state.velocity * units.velocity(),
            interval: point.interval * units.time(),
            side: side(point.state.side),
        })
        .collect()
}

/// The phases of sticking of a cycle.
pub(super) fn rests(cycle: &Cycle) -> Vec<Rest> {
    let rests = cycle.rests.iter();
    rests
        .map(|rest| Rest { side: side(rest.side), chatter: rest.chatter, begin: rest.begin, release: rest.release })
        .collect()
}

/// Real and imaginary part of each multiplier.
pub(crate) fn pairs(multipliers: [Multiplier; 2]) -> [[f64; 2]; 2] {
    multipliers.map(|m| [m.re, m.im])
}

/// A motion, with the number of starts that lead to it.
#[derive(Serialize)]
pub(super) struct SharedMotion {
    #[serde(flatten)]
    pub(super) motion: MotionFields,
    pub(super) share: f64,
    pub(super) count: u64,
}

//! A steady motion of any system: its label, the events of its cycle, its stability, and the grounds of the verdict.

use super::event::{self, EventObject, StateObject, side};
use super::quantities;
use crate::Units;
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::{Map, Value};
use vibroimpact::chaos::{Measured, Spectrum};
use vibroimpact::events::End;
use vibroimpact::flight::Horizon;
use vibroimpact::machine::Machine;
use vibroimpact::math::Multiplier;
use vibroimpact::orbit::machine;
use vibroimpact::quantities::{errors_of_verdict, machine_cycle_quantities, machine_quantities, of_verdict};
use vibroimpact::verdict::{Chaos, Count, NoImpact, Stability, System, Undecided, UndecidedCause, Verdict};
use vibroimpact::{Oscillator, Side};
use vibroimpact_study::ImpactsByStop;

/// The JSON object of a motion.
#[derive(Default, JsonSchema, Serialize)]
pub struct MotionObject<'a> {
    /// `periodic`, `no_impact`, `chaotic`, `stuck` or `undecided`. All of these are results; none is an error.
    kind: &'static str,
    /// m/n for m closings of stops in n forcing periods, `inf/n` with a complete chatter, m/T without forcing; `0`
    /// without impacts, `chaotic`, `stuck`, `undecided`.
    pub(crate) label: String,
    /// m of m/n.
    impacts: Option<u32>,
    /// n of m/n.
    periods: Option<u32>,
    /// The time of one period of a cycle.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) period: Option<f64>,
    /// Rests on stops, and holds of joints, in one period.
    sticks: Option<usize>,
    /// Whether it is stable; null if this is not decided.
    pub(crate) stable: Option<bool>,
    /// `stable`, `neutral` (a multiplier on the unit circle to rounding and none outside, as of every elastic motion)
    /// or `unstable`; null if this is not decided.
    pub(crate) stability: Option<&'static str>,
    /// Closings of each stop in one period; null for infinitely many.
    #[serde(skip_serializing_if = "Option::is_none")]
    counts: Option<Map<String, Value>>,
    /// Floquet multipliers, two for each coordinate, the largest first. In a machine that can be translated as a whole,
    /// the 1 that belongs to this is left out.
    pub(crate) multipliers: Option<Vec<[f64; 2]>>,
    /// By how much each coordinate moves on in one period, in machines that can be translated.
    #[serde(skip_serializing_if = "Option::is_none")]
    drift: Option<Map<String, Value>>,
    /// The mean velocity of this.
    #[serde(skip_serializing_if = "Option::is_none")]
    drift_velocity: Option<Map<String, Value>>,
    /// The events of one period of a cycle, the fastest closing first. Impacts of a complete chatter that are summed
    /// are not listed.
    pub(crate) cycle: Vec<EventObject<'a>>,
    /// The first stop that stays closed for ever, where the structure rests.
    #[serde(skip_serializing_if = "Option::is_none")]
    stop: Option<&'a str>,
    /// The stops that stay closed for ever, of a motion without a further event. Compliant ones can be without a rest.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    stops: Vec<&'a str>,
    /// A state between two events from which the motion can be started.
    #[serde(skip_serializing_if = "Option::is_none")]
    state: Option<StateObject<'a>>,
    /// The distance between the states before and after one period of a cycle.
    #[serde(skip_serializing_if = "Option::is_none")]
    residual: Option<f64>,
    /// Why an oscillator has no more impacts, and for how many periods.
    #[serde(skip_serializing_if = "Option::is_none")]
    horizon: Option<HorizonObject>,
    /// The largest exponent of a chaotic motion, or of an undecided one if it was measured, per unit of time.
    #[serde(skip_serializing_if = "Option::is_none")]
    lyapunov: Option<Estimate>,
    /// All of them, the largest first.
    #[serde(skip_serializing_if = "Option::is_none")]
    exponents: Option<Vec<Estimate>>,
    /// The events (of an oscillator: impacts) over which chaos was seen, or that were followed without a verdict.
    #[serde(skip_serializing_if = "Option::is_none")]
    seen_events: Option<u64>,
    /// Why the motion is undecided.
    #[serde(skip_serializing_if = "Option::is_none")]
    why: Option<&'static str>,
    /// Quantities of the motion in the units of the system; of a machine its parts have theirs. Null where one is not
    /// defined.
    quantities: Option<Map<String, Value>>,
    /// Three standard errors of the means among the quantities of a chaotic motion.
    #[serde(skip_serializing_if = "Option::is_none")]
    quantities_error: Option<Map<String, Value>>,
}

/// A measured number; null where it is not finite, with the reason.
#[derive(JsonSchema, Serialize)]
pub(crate) struct Estimate {
    value: f64,
    error: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    why: Option<&'static str>,
}

impl From<Measured> for Estimate {
    fn from(of: Measured) -> Self {
        let why = match of.value {
            value if value.is_nan() => Some("undefined"),
            f64::NEG_INFINITY => Some("minus_infinity"),
            value => value.is_infinite().then_some("infinity"),
        };
        Self { value: of.value, error: if why.is_none() { of.error } else { f64::NAN }, why }
    }
}

impl Estimate {
    pub(crate) fn per_time(of: Measured, units: &Units) -> Self {
        Self::from(Measured { value: of.value / units.time(), error: of.error / units.time() })
    }
}

/// All exponents, in these units.
fn estimates(spectrum: &Spectrum<impl AsRef<[Measured]>>, units: &Units) -> Vec<Estimate> {
    spectrum.exponents.as_ref().iter().map(|exponent| Estimate::per_time(*exponent, units)).collect()
}

/// Chaos before the motion settled.
#[derive(JsonSchema, Serialize)]
pub(crate) struct ChaosObject {
    /// The number of the impact by which it had ended, of an oscillator.
    #[serde(skip_serializing_if = "Option::is_none")]
    events: Option<u64>,
    exponents: Vec<Estimate>,
}

impl ChaosObject {
    /// Of an oscillator, of which there is no `machine`, with the number of the impact.
    pub(crate) fn new<S: System>(chaos: &Chaos<S>, machine: Option<&Machine>, units: &Units) -> Self {
        Self { events: machine.is_none().then_some(chaos.impacts), exponents: estimates(&chaos.spectrum, units) }
    }
}

/// Why there are no more impacts, and for how many periods.
#[derive(JsonSchema, Serialize)]
pub(crate) struct HorizonObject {
    kind: &'static str,
    periods: Option<f64>,
    why: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    common_period: Option<CommonPeriod>,
}

#[derive(JsonSchema, Serialize)]
struct CommonPeriod {
    forcing_periods: u32,
    natural_periods: u32,
}

impl HorizonObject {
    fn forever(why: &'static str) -> Self {
        Self { kind: "forever", periods: None, why, common_period: None }
    }

    pub(crate) fn new(no_impact: &NoImpact) -> Self {
        let forever = Self::forever;
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

impl MotionObject<'static> {
    /// The motion of an oscillator, in these units.
    pub(crate) fn of_oscillator(verdict: &Verdict, osc: &Oscillator, units: &Units) -> Self {
        let stability = verdict.stability(osc);
        let bare = Self {
            kind: "undecided",
            label: verdict.label().into_owned(),
            stable: stability.map(Stability::is_stable),
            stability: stability.map(Stability::name),
            counts: counts(osc, verdict),
            multipliers: verdict.multipliers(osc).map(|both| multipliers(&both)),
            quantities: of_verdict(osc, verdict).map(|found| quantities::of_oscillator(&found, units)),
            quantities_error: errors_of_verdict(osc, verdict)
                .map(|errors| quantities::errors_of_oscillator(&errors, units)),
            ..Self::default()
        };
        let largest = |of: &[Measured; 2]| Estimate::per_time(of[0], units);
        match verdict {
            Verdict::Periodic(cycle) => Self {
                kind: "periodic",
                impacts: finite(cycle.label.impacts),
                periods: Some(cycle.label.periods),
                period: Some(f64::from(cycle.label.periods) * osc.period() * units.time()),
                sticks: Some(cycle.rests.len()),
                cycle: event::of_cycle(osc, cycle, units),
                state: StateObject::within(osc, cycle, units),
                residual: Some(cycle.residual),
                ..bare
            },
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
                lyapunov: Some(largest(&chaos.spectrum.exponents)),
                seen_events: Some(chaos.impacts),
                ..bare
            },
            Verdict::Stuck(at) => Self {
                kind: "stuck",
                impacts: Some(0),
                periods: Some(1),
                sticks: Some(1),
                stop: Some(side(*at)),
                stops: vec![side(*at)],
                ..bare
            },
            Verdict::Undecided(Undecided { why: why @ UndecidedCause::Search { periods }, .. }) => Self {
                why: Some(undecided(*why)),
                horizon: Some(HorizonObject::new(&NoImpact::ForPeriods(*periods))),
                ..bare
            },
            Verdict::Undecided(Undecided { why, impacts, spectrum }) => Self {
                why: Some(undecided(*why)),
                seen_events: Some(*impacts),
                lyapunov: spectrum.as_ref().map(|spectrum| largest(&spectrum.exponents)),
                ..bare
            },
        }
    }
}

impl<'a> MotionObject<'a> {
    /// The same without the exponent of the verdict, for a report with a more precise one.
    pub(crate) fn without_lyapunov(self) -> Self {
        Self { lyapunov: None, ..self }
    }

    /// A cycle of a machine.
    pub(crate) fn of_cycle(machine: &'a Machine, cycle: &'a machine::Cycle) -> Self {
        let counts = machine.stops().iter().zip(&cycle.counts);
        let sticks = cycle.events.iter().filter(|event| matches!(event.kind.name(), "stick" | "hold")).count();
        Self {
            kind: "periodic",
            label: cycle.label.to_string(),
            impacts: finite(cycle.label.impacts),
            // 0 stands for no forcing
            periods: Some(cycle.label.periods).filter(|periods| *periods > 0),
            period: Some(cycle.period),
            sticks: Some(sticks),
            stable: Some(cycle.stable()),
            stability: Some(cycle.stability().name()),
            counts: Some(counts.map(|(stop, count)| (stop.name.clone(), Value::from(*count))).collect()),
            multipliers: Some(multipliers(&cycle.multipliers)),
            drift: drift(machine, cycle),
            drift_velocity: (cycle.translations() > 0).then(|| by_coordinate(machine, &cycle.drift_velocity())),
            cycle: cycle.events.iter().map(|event| event::of_machine(machine, event)).collect(),
            state: Some(StateObject::of(machine, &cycle.state)),
            residual: Some(cycle.residual),
            quantities: machine_cycle_quantities(machine, cycle).map(|found| quantities::of_machine(machine, &found)),
            ..Self::default()
        }
    }

    /// The motion of a machine.
    pub(crate) fn of_machine(machine: &'a Machine, verdict: &'a Verdict<Machine>) -> Self {
        if let Verdict::Periodic(cycle) = verdict {
            return Self::of_cycle(machine, cycle);
        }
        let found = machine_quantities(machine, verdict);
        let stability = verdict.stability(machine);
        let stops: Vec<&str> = verdict.closed().into_iter().map(|stop| machine.name_of(stop)).collect();
        let plain = |kind| Self {
            kind,
            label: verdict.label().into_owned(),
            stable: stability.map(Stability::is_stable),
            stability: stability.map(Stability::name),
            quantities: found.as_ref().map(|found| quantities::of_machine(machine, found)),
            ..Self::default()
        };
        match verdict {
            Verdict::Periodic(cycle) => Self::of_cycle(machine, cycle),
            Verdict::NoImpact(last) => Self {
                impacts: Some(0),
                stops,
                horizon: last.fades().then(|| HorizonObject::forever("graze_limit")),
                ..plain("no_impact")
            },
            Verdict::Stuck(_) => Self { impacts: Some(0), stop: stops.first().copied(), stops, ..plain("stuck") },
            Verdict::Chaotic(Chaos { spectrum, impacts: events, .. }) => Self {
                quantities_error: found.as_ref().map(|found| quantities::errors_of_machine(machine, found)),
                lyapunov: spectrum.exponents.first().map(|first| Estimate::from(*first)),
                exponents: Some(estimates(spectrum, &Units::default())),
                seen_events: Some(*events),
                ..plain("chaotic")
            },
            Verdict::Undecided(Undecided { why, spectrum, impacts: events }) => Self {
                exponents: spectrum.as_ref().map(|spectrum| estimates(spectrum, &Units::default())),
                seen_events: Some(*events),
                why: Some(undecided(*why)),
                quantities: None,
                ..plain("undecided")
            },
        }
    }
}

const fn finite(impacts: Count) -> Option<u32> {
    match impacts {
        Count::Finite(impacts) => Some(impacts),
        Count::Infinite => None,
    }
}

/// Impacts on each stop of an oscillator in one period; `None` if the motion does not repeat.
fn counts(osc: &Oscillator, verdict: &Verdict) -> Option<Map<String, Value>> {
    let by = ImpactsByStop::of_motion(verdict)?;
    let count = |at: Side| if at == Side::Upper { by.upper } else { by.lower };
    Some(osc.stops().map(|(at, _)| (side(at).to_owned(), count(at).into())).collect())
}

/// The drift of a cycle by coordinate; `None` in a machine without free translations.
pub(crate) fn drift(machine: &Machine, cycle: &machine::Cycle) -> Option<Map<String, Value>> {
    (cycle.translations() > 0).then(|| by_coordinate(machine, &cycle.drift))
}

fn by_coordinate(machine: &Machine, values: &[f64]) -> Map<String, Value> {
    let names = machine.parts().coordinates.iter().cloned();
    names.zip(values.iter().map(|value| Value::from(*value))).collect()
}

/// The real and the imaginary part of each.
pub(crate) fn multipliers(of: &[Multiplier]) -> Vec<[f64; 2]> {
    of.iter().map(|multiplier| [multiplier.re, multiplier.im]).collect()
}

/// Why a motion is undecided.
pub(crate) const fn undecided(why: UndecidedCause) -> &'static str {
    match why {
        UndecidedCause::Budget => "events",
        UndecidedCause::Unconfirmed => "unconfirmed",
        UndecidedCause::Ended(End::NoEventWithin) => "time_limit",
        UndecidedCause::Search { .. } | UndecidedCause::Ended(End::SearchLimit) => "search_limit",
        UndecidedCause::Ended(End::Inconsistent) => "inconsistent",
        UndecidedCause::Ended(End::Collapse) => "collapse",
        UndecidedCause::Ended(End::Never | End::Stuck) => "no_more_impacts",
    }
}

/// A motion, with the share and the number of the starts that lead to it.
#[derive(JsonSchema, Serialize)]
pub(crate) struct SharedMotion<'a> {
    #[serde(flatten)]
    pub(crate) motion: MotionObject<'a>,
    /// The share of the starts that lead to it, 0 to 1.
    pub(crate) share: f64,
    /// The number of these starts.
    pub(crate) starts: u64,
}

/// The object of a motion of an oscillator as text, nondimensional.
#[must_use]
pub fn text(verdict: &Verdict, osc: &Oscillator) -> String {
    // texts and numbers can always be written as JSON
    serde_json::to_string(&MotionObject::of_oscillator(verdict, osc, &Units::default())).unwrap_or_default()
}

/// Why there are no more impacts, and for how many periods, as text.
#[must_use]
pub fn horizon(no_impact: &NoImpact) -> String {
    // texts and numbers can always be written as JSON
    serde_json::to_string(&HorizonObject::new(no_impact)).unwrap_or_default()
}

//! A steady motion of a machine in JSON: label, counts of each stop, multipliers, events.

use super::machine_event::{EventObject, StateObject, event_object};
use super::machine_quantities::{errors, values};
use serde::Serialize;
use serde_json::{Map, Value};
use vibroimpact::chaos::{MachineSpectrum, Measured};
use vibroimpact::events::MachineEnd;
use vibroimpact::machine::Machine;
use vibroimpact::math::Multiplier;
use vibroimpact::orbit::MachineCycle;
use vibroimpact::quantities::{machine_cycle_quantities, machine_quantities};
use vibroimpact::verdict::{Count, MachineUndecided, MachineVerdict, Stability};

/// The JSON object of a motion.
#[derive(Serialize)]
pub(super) struct MotionObject<'a> {
    kind: &'static str,
    label: String,
    impacts: Option<u32>,
    periods: Option<u32>,
    /// The time of one period.
    #[serde(skip_serializing_if = "Option::is_none")]
    period: Option<f64>,
    /// Rests on stops, and holds of joints, in one period.
    sticks: Option<usize>,
    stable: Option<bool>,
    stability: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    counts: Option<Map<String, Value>>,
    multipliers: Option<Vec<[f64; 2]>>,
    /// By how much each coordinate moves on in one period, and the mean velocity of this, in machines that can be translated.
    #[serde(skip_serializing_if = "Option::is_none")]
    drift: Option<Map<String, Value>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    drift_velocity: Option<Map<String, Value>>,
    cycle: Vec<EventObject<'a>>,
    /// The first stop that stays closed for ever, where the structure rests, and all of them, which compliant ones can be
    /// without a rest.
    #[serde(skip_serializing_if = "Option::is_none")]
    stop: Option<&'a str>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    stops: Vec<&'a str>,
    /// A state between two events from which the motion can be started.
    #[serde(skip_serializing_if = "Option::is_none")]
    state: Option<StateObject<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    residual: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    lyapunov: Option<Estimate>,
    #[serde(skip_serializing_if = "Option::is_none")]
    exponents: Option<Vec<Estimate>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    seen_events: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    why: Option<&'static str>,
    quantities: Option<Map<String, Value>>,
    /// Three standard errors of the means among the quantities of a chaotic motion.
    #[serde(skip_serializing_if = "Option::is_none")]
    quantities_error: Option<Map<String, Value>>,
}

/// A measured number; null where it is minus infinity.
#[derive(Serialize)]
pub(super) struct Estimate {
    value: f64,
    error: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    why: Option<&'static str>,
}

impl From<Measured> for Estimate {
    fn from(measured: Measured) -> Self {
        let why = if measured.value == f64::NEG_INFINITY { Some("minus_infinity") } else { None };
        Self { value: measured.value, error: measured.error, why }
    }
}

/// All exponents.
pub(super) fn estimates(spectrum: &MachineSpectrum) -> Vec<Estimate> {
    spectrum.exponents.iter().map(|exponent| Estimate::from(*exponent)).collect()
}

fn empty<'a>(kind: &'static str, label: String) -> MotionObject<'a> {
    MotionObject {
        kind,
        label,
        impacts: None,
        periods: None,
        period: None,
        sticks: None,
        stable: None,
        stability: None,
        counts: None,
        multipliers: None,
        drift: None,
        drift_velocity: None,
        cycle: Vec::new(),
        stop: None,
        stops: Vec::new(),
        state: None,
        residual: None,
        lyapunov: None,
        exponents: None,
        seen_events: None,
        why: None,
        quantities: None,
        quantities_error: None,
    }
}

/// The motion of a cycle.
pub(super) fn cycle<'a>(machine: &'a Machine, cycle: &'a MachineCycle) -> MotionObject<'a> {
    let impacts = match cycle.label.impacts {
        Count::Finite(impacts) => Some(impacts),
        Count::Infinite => None,
    };
    let counts = machine.stops().iter().zip(&cycle.counts);
    let sticks = cycle.events.iter().filter(|event| matches!(event.kind.name(), "stick" | "hold")).count();
    MotionObject {
        impacts,
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
        cycle: cycle.events.iter().map(|event| event_object(machine, event)).collect(),
        state: Some(StateObject::of(machine, &cycle.state)),
        residual: Some(cycle.residual),
        quantities: machine_cycle_quantities(machine, cycle).map(|found| values(machine, &found)),
        ..empty("periodic", cycle.label.to_string())
    }
}

/// The drift of a cycle by coordinate; `None` in a machine without free translations.
pub(super) fn drift(machine: &Machine, cycle: &MachineCycle) -> Option<Map<String, Value>> {
    (cycle.translations() > 0).then(|| by_coordinate(machine, &cycle.drift))
}

fn by_coordinate(machine: &Machine, values: &[f64]) -> Map<String, Value> {
    let names = machine.parts().coordinates.iter().cloned();
    names.zip(values.iter().map(|value| Value::from(*value))).collect()
}

/// The real and the imaginary part of each.
pub(super) fn multipliers(of: &[Multiplier]) -> Vec<[f64; 2]> {
    of.iter().map(|multiplier| [multiplier.re, multiplier.im]).collect()
}

/// The motion of a verdict.
pub(super) fn motion<'a>(machine: &'a Machine, verdict: &'a MachineVerdict) -> MotionObject<'a> {
    let found =
        if matches!(verdict, MachineVerdict::Periodic(_)) { None } else { machine_quantities(machine, verdict) };
    let quantities = found.as_ref().map(|found| values(machine, found));
    let stops = verdict.closed().into_iter().map(|stop| machine.name_of(stop)).collect();
    let stability = verdict.stability(machine);
    let plain = |kind| MotionObject {
        stable: stability.map(Stability::is_stable),
        stability: stability.map(Stability::name),
        ..empty(kind, verdict.label())
    };
    match verdict {
        MachineVerdict::Periodic(found) => cycle(machine, found),
        MachineVerdict::NoImpact(_) => MotionObject { stops, quantities, ..plain("no_impact") },
        MachineVerdict::Stuck(_) => MotionObject { stop: stops.first().copied(), stops, quantities, ..plain("stuck") },
        MachineVerdict::Chaotic { spectrum, events, .. } => MotionObject {
            quantities,
            quantities_error: found.map(|found| errors(machine, &found)),
            lyapunov: spectrum.exponents.first().map(|first| Estimate::from(*first)),
            exponents: Some(estimates(spectrum)),
            seen_events: Some(*events),
            ..plain("chaotic")
        },
        MachineVerdict::Undecided { why, spectrum, events } => MotionObject {
            exponents: spectrum.as_ref().map(estimates),
            seen_events: Some(*events),
            why: Some(undecided(*why)),
            ..plain("undecided")
        },
    }
}

/// Why a motion is undecided.
#[must_use]
pub const fn undecided(why: MachineUndecided) -> &'static str {
    match why {
        MachineUndecided::Events => "events",
        MachineUndecided::Unconfirmed => "unconfirmed",
        MachineUndecided::Ended(MachineEnd::NoEventWithin) => "time_limit",
        MachineUndecided::Ended(MachineEnd::SearchLimit) => "search_limit",
        MachineUndecided::Ended(MachineEnd::Inconsistent) => "inconsistent",
        MachineUndecided::Ended(MachineEnd::Collapse) => "collapse",
        MachineUndecided::Ended(MachineEnd::Never | MachineEnd::Stuck) => "no_more_impacts",
    }
}

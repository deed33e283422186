//! The JSON objects, one type per shape. Numbers that are not finite become `null`.

use crate::args::{Asked, Units};
use serde::{Serialize, Serializer};
use vibroimpact::chaos::Measured;
use vibroimpact::flight::Horizon;
use vibroimpact::math::Multiplier;
use vibroimpact::motion::{Event, EventKind};
use vibroimpact::orbit::Cycle;
use vibroimpact::verdict::{Count, NoImpact, Undecided, Verdict};
use vibroimpact::{Oscillator, Side, Start};
use vibroimpact_study::{Plan, Span};

/// The object a command prints: system, start, the command's own fields, and the plan that led to them.
#[derive(Serialize)]
pub(crate) struct Document<'a, T> {
    system: System,
    #[serde(skip_serializing_if = "Option::is_none")]
    start: Option<StartPoint>,
    #[serde(flatten)]
    result: T,
    units: &'static str,
    plan: &'a Plan,
    program: &'static str,
}

impl<'a, T: Serialize> Document<'a, T> {
    pub(crate) fn new(asked: &Asked, osc: &Oscillator, plan: &'a Plan, result: T) -> Self {
        Self {
            system: System::new(asked, osc),
            start: None,
            result,
            units: units(&asked.units),
            plan,
            program: PROGRAM,
        }
    }

    pub(crate) fn start(self, start: &Start, units: &Units) -> Self {
        Self {
            start: Some(StartPoint { x: start.x * units.length(), v: start.v * units.velocity(), phase: start.phase }),
            ..self
        }
    }
}

/// Which program made it.
pub(crate) const PROGRAM: &str = concat!("vibro ", env!("CARGO_PKG_VERSION"));

pub(crate) fn units(units: &Units) -> &'static str {
    if units.si { "si" } else { "nondimensional" }
}

#[derive(Serialize)]
struct System {
    beta: f64,
    inverse_beta: f64,
    gap: f64,
    restitution: f64,
    damping: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    second_stop: Option<SecondStop>,
    #[serde(skip_serializing_if = "Option::is_none")]
    scales: Option<Scales>,
}

#[derive(Serialize)]
pub(crate) struct SecondStop {
    pub(crate) gap: f64,
    pub(crate) restitution: f64,
}

#[derive(Serialize)]
pub(crate) struct Scales {
    length_m: f64,
    time_s: f64,
    velocity_m_per_s: f64,
}

#[derive(Serialize)]
struct StartPoint {
    x: f64,
    v: f64,
    phase: f64,
}

impl System {
    fn new(asked: &Asked, osc: &Oscillator) -> Self {
        Self {
            beta: osc.beta(),
            // as it was given, where it was
            inverse_beta: asked.system.inverse_beta.unwrap_or(1.0 / osc.beta()),
            gap: osc.gap(),
            restitution: osc.restitution(),
            damping: osc.damping(),
            second_stop: osc.stop(Side::Lower).map(|stop| SecondStop { gap: stop.gap, restitution: stop.restitution }),
            scales: Scales::new(&asked.units),
        }
    }
}

impl Scales {
    /// Of the machine, where one was given.
    pub(crate) fn new(units: &Units) -> Option<Self> {
        let scales = units.scales?;
        Some(Self { length_m: scales.length_m, time_s: scales.time_s, velocity_m_per_s: scales.velocity_m_per_s() })
    }
}

/// The name of a side of the oscillator.
pub(crate) const fn side(side: Side) -> &'static str {
    match side {
        Side::Upper => "upper",
        Side::Lower => "lower",
    }
}

/// `"events"` and `"end"` of a simulation; events are converted while they are written.
#[derive(Serialize)]
pub(crate) struct Simulation<'a> {
    #[serde(serialize_with = "each_event")]
    events: (&'a [Event], Units),
    end: EndPoint,
}

#[derive(Serialize)]
struct EndPoint {
    reason: &'static str,
    time: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    horizon: Option<HorizonObject>,
}

impl<'a> Simulation<'a> {
    pub(crate) fn new(
        events: &'a [Event],
        (reason, time, horizon): (&'static str, f64, Option<NoImpact>),
        units: Units,
    ) -> Self {
        Self {
            events: (events, units),
            end: EndPoint { reason, time: time * units.time(), horizon: horizon.as_ref().map(HorizonObject::new) },
        }
    }
}

fn each_event<S: Serializer>((events, units): &(&[Event], Units), serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(events.iter().map(|event| EventObject::new(event, units)))
}

#[derive(Serialize)]
struct EventObject {
    kind: &'static str,
    time: f64,
    phase: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    velocity_before: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    velocity_after: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    depth: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    chatter: Option<bool>,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<f64>,
    side: &'static str,
}

impl EventObject {
    fn new(event: &Event, units: &Units) -> Self {
        let bare = Self {
            kind: "release",
            time: event.time * units.time(),
            phase: event.phase,
            velocity_before: None,
            velocity_after: None,
            depth: None,
            chatter: None,
            error: None,
            side: side(event.side),
        };
        match event.kind {
            EventKind::Impact { velocity_before, velocity_after } => Self {
                kind: "impact",
                velocity_before: Some(velocity_before * units.velocity()),
                velocity_after: Some(velocity_after * units.velocity()),
                ..bare
            },
            EventKind::Graze { depth } => Self { kind: "graze", depth: Some(depth * units.length()), ..bare },
            EventKind::Stick { chatter, error } => {
                Self { kind: "stick", chatter: Some(chatter), error: Some(error * units.time()), ..bare }
            }
            EventKind::Release => bare,
        }
    }
}

/// `"motion"`.
#[derive(Serialize)]
pub(crate) struct Motion {
    kind: &'static str,
    label: String,
    impacts: Option<u32>,
    periods: Option<u32>,
    sticks: Option<usize>,
    stable: Option<bool>,
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
    #[serde(skip_serializing_if = "Option::is_none")]
    horizon: Option<HorizonObject>,
    #[serde(skip_serializing_if = "Option::is_none")]
    residual: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    side: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tried: Option<Tried>,
}

/// An impact of a cycle.
#[derive(Serialize)]
pub(crate) struct CyclePoint {
    phase: f64,
    velocity_before: f64,
    interval: f64,
    side: &'static str,
}

/// A rest of a cycle.
#[derive(Serialize)]
pub(crate) struct Rest {
    side: &'static str,
    chatter: bool,
    begin: f64,
    release: f64,
}

#[derive(Serialize)]
pub(crate) struct Estimate {
    value: f64,
    error: f64,
}

impl Estimate {
    fn per_time(of: Measured, units: &Units) -> Self {
        Self { value: of.value / units.time(), error: of.error / units.time() }
    }
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

/// How far "no more impacts" reaches and why.
#[derive(Serialize)]
pub(crate) struct HorizonObject {
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
    pub(crate) fn new(no_impact: &NoImpact) -> Self {
        let forever = |why| Self { kind: "forever", periods: None, why, common_period: None };
        match no_impact {
            NoImpact::Flight(Horizon::Amplitude) => forever("amplitude"),
            NoImpact::Flight(Horizon::CommonPeriod { p, q }) => Self {
                common_period: Some(CommonPeriod { forcing_periods: *p, natural_periods: *q }),
                ..forever("common_period")
            },
            NoImpact::GrazeLimit { .. } => forever("graze_limit"),
            NoImpact::Grazing { .. } => forever("grazing"),
            NoImpact::ForPeriods(n) => Self { kind: "periods", periods: Some(*n), why: "search", common_period: None },
        }
    }
}

impl Motion {
    pub(crate) fn new(verdict: &Verdict, osc: &Oscillator, units: &Units) -> Self {
        let bare = Self {
            kind: "undecided",
            label: verdict.label().into_owned(),
            impacts: None,
            periods: None,
            sticks: None,
            stable: verdict.stable(osc),
            multipliers: verdict.multipliers(osc).map(pairs),
            cycle: Vec::new(),
            chatter_end: None,
            release: None,
            rests: None,
            lyapunov: None,
            horizon: None,
            residual: None,
            side: None,
            tried: None,
        };
        match verdict {
            Verdict::Periodic(cycle) => Self::periodic(cycle, bare, units),
            Verdict::NoImpact(no_impact) => Self {
                kind: "no_impact",
                impacts: Some(0),
                periods: Some(1),
                sticks: Some(0),
                horizon: Some(HorizonObject::new(no_impact)),
                ..bare
            },
            Verdict::Chaotic(spectrum) => {
                Self { kind: "chaotic", lyapunov: Some(Estimate::per_time(spectrum.exponents[0], units)), ..bare }
            }
            Verdict::Stuck(at) => Self {
                kind: "stuck",
                impacts: Some(0),
                periods: Some(1),
                sticks: Some(1),
                side: Some(side(*at)),
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

    /// Without the exponent of the verdict, beside a better one.
    pub(crate) fn without_lyapunov(self) -> Self {
        Self { lyapunov: None, tried: self.tried.map(|tried| Tried { lyapunov: None, ..tried }), ..self }
    }

    fn periodic(cycle: &Cycle, bare: Self, units: &Units) -> Self {
        let rests = rests(cycle);
        // the list of impacts begins at the release that ends the last rest
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
pub(crate) fn impacts(cycle: &Cycle, units: &Units) -> Vec<CyclePoint> {
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

/// The rests of a cycle.
pub(crate) fn rests(cycle: &Cycle) -> Vec<Rest> {
    let rests = cycle.rests.iter();
    rests
        .map(|rest| Rest { side: side(rest.side), chatter: rest.chatter, begin: rest.begin, release: rest.release })
        .collect()
}

/// Real and imaginary part of each multiplier.
pub(crate) fn pairs(multipliers: [Multiplier; 2]) -> [[f64; 2]; 2] {
    multipliers.map(|m| [m.re, m.im])
}

/// A motion and how many starts led to it.
#[derive(Serialize)]
pub(crate) struct SharedMotion {
    #[serde(flatten)]
    pub(crate) motion: Motion,
    pub(crate) share: f64,
    pub(crate) count: u64,
}

/// `A:B:N` as an object, in the units of the results.
#[derive(Clone, Copy, Serialize)]
pub(crate) struct Range {
    from: f64,
    to: f64,
    count: u32,
}

impl Range {
    pub(crate) fn new(span: &Span) -> Self {
        let (from, to) = span.ends();
        Self { from, to, count: span.count() }
    }
}

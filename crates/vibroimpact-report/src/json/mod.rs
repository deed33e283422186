//! The JSON objects, one file for each command. Numbers that are not finite are `null`.
//!
//! Each `document` function returns the whole object that the command of the same name prints with `--json`.

pub mod attractors;
pub mod basin;
pub mod branch;
mod certainty;
pub mod curve;
pub mod diagram;
pub mod lyapunov;
mod machine;
mod machine_curve;
mod machine_event;
mod machine_motion;
mod machine_quantities;
pub mod map;
pub mod margins;
pub mod motion;
pub mod orbit;
mod quantities;
pub mod region;
pub mod response;
pub mod settle;
pub mod simulate;

use crate::units::given;
use crate::{Asked, PROGRAM, Units};
use serde::Serialize;
use vibroimpact::{Oscillator, Side, Start};
use vibroimpact_study::{Cut, FramePlan, Plan, Span, Stretch, Values};

/// The object that a command prints: the system, the start, the fields of the command, and the plan.
#[derive(Serialize)]
pub struct Document<'a, T> {
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
    /// An object with the fields of the command.
    #[must_use]
    pub fn new(asked: &Asked, osc: &Oscillator, plan: &'a Plan, result: T) -> Self {
        Self { system: System::new(asked, osc), start: None, result, units: asked.units.name(), plan, program: PROGRAM }
    }

    /// Adds the start of the motion.
    #[must_use]
    pub fn start(self, start: &Start, units: &Units) -> Self {
        Self {
            start: Some(StartPoint { x: start.x * units.length(), v: start.v * units.velocity(), phase: start.phase }),
            ..self
        }
    }
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
struct SecondStop {
    gap: f64,
    restitution: f64,
}

#[derive(Serialize)]
struct Scales {
    length_m: f64,
    time_s: f64,
    mass_kg: f64,
    velocity_m_per_s: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    frame: Option<FramePlan>,
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
            // exactly as given, if it was given
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
    /// The physical units, if there are any.
    fn new(units: &Units) -> Option<Self> {
        let scales = units.scales?;
        Some(Self {
            length_m: scales.length_m,
            time_s: scales.time_s,
            mass_kg: scales.mass_kg,
            velocity_m_per_s: scales.velocity_m_per_s(),
            frame: units.frame,
        })
    }
}

/// `A:B:N` as an object, in the units of the results.
#[derive(Clone, Copy, Serialize)]
struct Range {
    from: f64,
    to: f64,
    count: u32,
}

impl Range {
    fn new(span: &Span, unit: f64) -> Self {
        let (from, to) = span.ends();
        Self { from: given(from, unit), to: given(to, unit), count: span.count() }
    }
}

/// The second parameter of a line, with its values at both ends.
#[derive(Serialize)]
struct Pair {
    parameter: &'static str,
    from: f64,
    to: f64,
}

impl Pair {
    fn of(cut: &Cut, units: &Units) -> Option<Self> {
        let Stretch { parameter, from, to } = cut.also?;
        let unit = units.of(parameter);
        Some(Self { parameter: units.name_of(parameter), from: given(from, unit), to: given(to, unit) })
    }
}

/// One value, or the values of an axis.
#[derive(Serialize)]
#[serde(untagged)]
enum Place {
    At(f64),
    Over(Range),
    Listed(Vec<f64>),
}

impl Place {
    fn over(values: &Values, unit: f64) -> Self {
        match values {
            Values::Span(span) => Self::Over(Range::new(span, unit)),
            Values::Listed(list) => Self::Listed(list.iter().map(|value| given(*value, unit)).collect()),
        }
    }
}

pub use machine_motion::undecided;

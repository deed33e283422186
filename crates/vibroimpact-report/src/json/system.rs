//! The system of a question: its kind and name, its coordinates and stops, and its numbers by path.

use super::event::side;
use crate::{Asked, Units};
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::{Map, Value, json};
use vibroimpact::machine::Machine;
use vibroimpact::{Oscillator, Side};
use vibroimpact_study::{FramePlan, Parameter};

/// A system.
#[derive(JsonSchema, Serialize)]
pub struct SystemObject<'a> {
    kind: &'static str,
    name: &'a str,
    coordinates: Vec<&'a str>,
    stops: Vec<&'a str>,
    /// The numbers by path.
    #[serde(flatten)]
    numbers: Map<String, Value>,
    /// The units of an oscillator with physical units.
    #[serde(skip_serializing_if = "Option::is_none")]
    scales: Option<Scales>,
}

#[derive(JsonSchema, Serialize)]
struct Scales {
    length_m: f64,
    time_s: f64,
    mass_kg: f64,
    velocity_m_per_s: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    frame: Option<FramePlan>,
}

impl Scales {
    /// The physical units, if there are any.
    fn new(units: &Units) -> Option<Self> {
        let scales = units.scales?;
        Some(Self {
            length_m: scales.length,
            time_s: scales.time,
            mass_kg: scales.mass,
            velocity_m_per_s: scales.velocity(),
            frame: units.frame,
        })
    }
}

impl<'a> SystemObject<'a> {
    /// An oscillator. Numbers that vary have no value: they are left out.
    pub(crate) fn of_oscillator(asked: &Asked, osc: &Oscillator, varied: &[Parameter]) -> Self {
        let stops = osc.stops().map(|(at, _)| side(at)).collect();
        let numbers = of_body(asked, varied).unwrap_or_else(|| of_parameters(asked, osc, varied));
        let scales = Scales::new(&asked.units);
        Self { kind: "oscillator", name: "oscillator", coordinates: vec!["x"], stops, numbers, scales }
    }

    /// A machine with the name under which it was asked for.
    pub(crate) fn of_machine(name: &'a str, machine: &'a Machine) -> Self {
        Self {
            kind: "machine",
            name,
            coordinates: machine.parts().coordinates.iter().map(String::as_str).collect(),
            stops: machine.stops().iter().map(|stop| stop.name.as_str()).collect(),
            numbers: machine.numbers().into_iter().map(|(path, value)| (path, value.into())).collect(),
            scales: None,
        }
    }
}

fn of_parameters(asked: &Asked, osc: &Oscillator, varied: &[Parameter]) -> Map<String, Value> {
    let second = osc.stop(Side::Lower);
    // the frequency is exactly as given, if it was given
    let frequency = |parameter: Parameter| matches!(parameter, Parameter::Beta | Parameter::InverseBeta);
    let numbers = [
        (Parameter::Beta, Some(osc.beta())),
        (Parameter::InverseBeta, Some(asked.system.inverse_beta.unwrap_or(1.0 / osc.beta()))),
        (Parameter::Gap, Some(osc.gap())),
        (Parameter::Restitution, Some(osc.restitution())),
        (Parameter::Damping, Some(osc.damping())),
        (Parameter::SecondGap, second.map(|stop| stop.gap)),
        (Parameter::SecondRestitution, second.map(|stop| stop.restitution)),
    ];
    let known = |(parameter, value): (Parameter, Option<f64>)| {
        let varies = varied.iter().any(|other| *other == parameter || frequency(*other) && frequency(parameter));
        Some((parameter.name().to_owned(), value.filter(|_| !varies)?.into()))
    };
    numbers.into_iter().filter_map(known).collect()
}

/// The numbers of a body in physical units that do not vary; `None` if none of them varies. One that varies may determine several
/// parameters of the oscillator, so these are not listed then.
fn of_body(asked: &Asked, varied: &[Parameter]) -> Option<Map<String, Value>> {
    let numbers = varied.iter().filter_map(|parameter| parameter.of_body());
    let mut body = asked.system.body?;
    let mut any = false;
    for number in numbers {
        body.set(number, None);
        any = true;
    }
    let object = json!(body);
    let mut numbers = object.as_object().filter(|_| any)?.clone();
    numbers.retain(|name, _| varied.iter().all(|parameter| parameter.name() != name));
    Some(numbers)
}

//! Curves of events in a plane of two parameters: their points, and their points of codimension two.

use super::branch::ChosenObject;
use super::event::{self, EventObject};
use super::motion::multipliers;
use crate::answer::{AnswerOf, CurveOf, Told};
use crate::{Asked, Varied as _};
use schemars::JsonSchema;
use serde::Serialize;
use vibroimpact::continuation::{CurvePoint, machine};
use vibroimpact::machine::Machine;
use vibroimpact::verdict::{Stability, System as _};
use vibroimpact_study::{CurvePlan, Solution as _};

/// The answer to `vibro curve`. Pairs of values are in the order of `parameters`.
#[derive(JsonSchema, Serialize)]
pub struct CurveAnswer<'a> {
    /// The label of the orbit on whose branch the event is.
    pub label: String,
    /// `fold`, `flip` or `grazing`; of a machine also `torus`, `corner`, `sticking` or `holding`.
    kind: &'static str,
    /// The stop or joint of a curve of grazing, sticking or holding of a machine, or the stops and joints of a corner.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    of: Vec<&'a str>,
    /// The two numbers that vary.
    parameters: [String; 2],
    /// Absent for the motion from the start of a machine.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub orbit: Option<ChosenObject>,
    /// Values of the first parameter at the events of this kind on the branch.
    pub found_at: Vec<f64>,
    /// The number, counted from 1, of the event through which the curve passes, and its index among the points.
    pub through: Through,
    /// The points from one end to the other.
    pub points: Vec<PointObject<'a>>,
    /// The events among them.
    pub events: Vec<CurveEventObject<'a>>,
    /// The stability of the orbit; none of a solution that is not admissible.
    #[serde(skip)]
    pub stability: Option<Stability>,
}

/// An event of a branch on a curve.
#[derive(JsonSchema, Serialize)]
pub struct Through {
    /// Its number among those of this kind on the branch.
    pub event: usize,
    /// Its index among the points of the curve.
    pub point: usize,
}

/// A point of a curve.
#[derive(JsonSchema, Serialize)]
pub struct PointObject<'a> {
    /// Values of both parameters.
    pub(crate) values: [f64; 2],
    /// The label of the cycle.
    pub label: String,
    /// Whether it is a motion.
    pub admissible: bool,
    /// The time of one period.
    pub(crate) period: f64,
    /// The events; on a grazing curve of an oscillator including the impact of speed zero, on one of a machine without the touch.
    pub(crate) cycle: Vec<EventObject<'a>>,
    /// Floquet multipliers; on a curve of grazing of a machine those of the cycle without the contact.
    pub(crate) multipliers: Vec<[f64; 2]>,
    /// By how much the condition of the curve of a machine fails.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) residual: Option<f64>,
    /// The phase of the touch.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) touch: Option<f64>,
}

/// An event of a curve.
#[derive(Clone, Copy, Debug, JsonSchema, Serialize)]
pub struct CurveEventObject<'a> {
    /// `cusp`, `resonant grazing`, `double grazing`, `1:1`, `1:2`, `fold-flip`, `end of box` and others.
    pub kind: &'static str,
    /// The values of both parameters.
    pub values: [f64; 2],
    /// Index among the points.
    pub point: usize,
    /// The stop or joint of a machine.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stop: Option<&'a str>,
    /// The other stop or joint of a corner, if it is another one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub also: Option<&'a str>,
}

impl<'a> CurveAnswer<'a> {
    pub(crate) fn new<D: Told>(of: &'a AnswerOf<D>, found: &'a CurveOf<D>, plan: &CurvePlan<D::Name>) -> Self {
        let name = |place: usize| Some(D::machine(of)?.name_of(place));
        let points: Vec<PointObject<'_>> = found.points.iter().map(|point| D::curve_point(of, point, plan)).collect();
        let event = |(k, point): (usize, &D::CurvePoint)| {
            let event = D::curve_event(point)?;
            let (stop, also) = (event.place().and_then(name), event.also().and_then(name));
            Some(CurveEventObject { kind: event.name(), values: points[k].values, point: k, stop, also })
        };
        Self {
            label: D::System::label(&found.chosen.cycle).to_string(),
            kind: plan.kind.name(),
            of: found.places.iter().filter_map(|place| name(*place)).collect(),
            parameters: [&plan.vary, &plan.and].map(|stretch| stretch.parameter.field(&of.units).to_owned()),
            orbit: ChosenObject::new(&found.chosen),
            found_at: found.events.iter().map(|event| event.value() * plan.vary.parameter.unit(&of.units)).collect(),
            through: Through { event: found.through + 1, point: found.begin },
            events: found.points.iter().enumerate().filter_map(event).collect(),
            points,
            stability: found.chosen.stability,
        }
    }

    /// The event at a point.
    pub(crate) fn event_at(&self, point: usize) -> Option<&CurveEventObject<'a>> {
        let place = self.events.binary_search_by_key(&point, |event| event.point).ok()?;
        Some(&self.events[place])
    }
}

impl<'a> PointObject<'a> {
    pub(crate) fn of_oscillator(point: &CurvePoint, plan: &CurvePlan, Asked { system, units }: &Asked) -> Self {
        let (of, (p, q)) = ([plan.vary.parameter, plan.and.parameter], point.values);
        let there = units.at(of[0], p).at(of[1], q);
        let osc = system.with_all(of.into_iter().zip([p, q]));
        let osc = osc.and_then(|system| system.oscillator()).ok();
        let periods = f64::from(point.cycle.label.periods);
        PointObject {
            values: [p * units.of(of[0]), q * units.of(of[1])],
            label: point.cycle.label.to_string(),
            admissible: point.physical,
            period: osc.map_or(f64::NAN, |osc| periods * osc.period() * there.time()),
            cycle: osc.map_or_else(Vec::new, |osc| event::of_cycle(&osc, &point.cycle, &there)),
            multipliers: multipliers(&point.cycle.multipliers),
            residual: None,
            touch: None,
        }
    }

    pub(crate) fn of_machine(machine: &'a Machine, point: &'a machine::CurvePoint) -> Self {
        PointObject {
            values: point.values.into(),
            label: point.cycle.label.to_string(),
            admissible: true,
            period: point.cycle.period,
            cycle: point.cycle.events.iter().map(|event| event::of_machine(machine, event)).collect(),
            multipliers: multipliers(&point.cycle.multipliers),
            residual: Some(point.residual),
            touch: point.touch,
        }
    }
}

//! Curves of events in a plane of two parameters: their points, and their points of codimension two.

use super::branch::ChosenObject;
use super::event::{self, EventObject};
use super::motion::multipliers;
use crate::{Asked, Units, Varied};
use schemars::JsonSchema;
use serde::Serialize;
use vibroimpact::Label;
use vibroimpact::continuation::machine;
use vibroimpact::continuation::{CurvePoint, machine::SolutionPoint};
use vibroimpact::machine::Machine;
use vibroimpact::orbit::machine::Cycle;
use vibroimpact::verdict::Stability;
use vibroimpact_study::{CurvePlan, EventCurve};

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

/// Values of both parameters at a point, in the units of the results.
fn values<V: Varied>((p, q): (f64, f64), plan: &CurvePlan<V>, units: &Units) -> [f64; 2] {
    [p * plan.vary.parameter.unit(units), q * plan.and.parameter.unit(units)]
}

/// What the points of a curve are in the answer.
struct Parts<'a> {
    found_at: Vec<f64>,
    points: Vec<PointObject<'a>>,
    events: Vec<CurveEventObject<'a>>,
}

impl<'a> CurveAnswer<'a> {
    fn new<C, E, P, V: Varied>(
        (found, label): (&EventCurve<C, E, P>, Label),
        (plan, units): (&CurvePlan<V>, &Units),
        of: Vec<&'a str>,
        Parts { found_at, points, events }: Parts<'a>,
    ) -> Self {
        Self {
            label: label.to_string(),
            kind: plan.kind.name(),
            of,
            parameters: [&plan.vary, &plan.and].map(|stretch| stretch.parameter.field(units).to_owned()),
            orbit: ChosenObject::new(&found.chosen),
            found_at,
            through: Through { event: found.through + 1, point: found.begin },
            points,
            events,
            stability: found.chosen.stability,
        }
    }

    /// The event at a point.
    pub(crate) fn event_at(&self, point: usize) -> Option<&CurveEventObject<'a>> {
        let place = self.events.binary_search_by_key(&point, |event| event.point).ok()?;
        Some(&self.events[place])
    }

    pub(crate) fn of_oscillator(found: &EventCurve, plan: &CurvePlan, Asked { system, units }: &Asked) -> Self {
        let of = [plan.vary.parameter, plan.and.parameter];
        let event = |(k, point): (usize, &CurvePoint)| {
            let kind = point.event?.name();
            Some(CurveEventObject { kind, values: values(point.values, plan, units), point: k, stop: None, also: None })
        };
        let point = |point: &CurvePoint| {
            let there = units.at_both((of[0], of[1]), point.values);
            let osc = system.with_all(of.into_iter().zip(<[f64; 2]>::from(point.values)));
            let osc = osc.and_then(|system| system.oscillator()).ok();
            let periods = f64::from(point.cycle.label.periods);
            PointObject {
                values: values(point.values, plan, units),
                label: point.cycle.label.to_string(),
                admissible: point.physical,
                period: osc.map_or(f64::NAN, |osc| periods * osc.period() * there.time()),
                cycle: osc.map_or_else(Vec::new, |osc| event::of_cycle(&osc, &point.cycle, &there)),
                multipliers: multipliers(&point.cycle.multipliers),
                residual: None,
                touch: None,
            }
        };
        let parts = Parts {
            found_at: found.events.iter().map(|event| event.value * units.of(plan.vary.parameter)).collect(),
            points: found.points.iter().map(point).collect(),
            events: found.points.iter().enumerate().filter_map(event).collect(),
        };
        Self::new((found, found.chosen.cycle.label), (plan, units), Vec::new(), parts)
    }

    pub(crate) fn of_machine(
        machine: &'a Machine,
        plan: &CurvePlan<String>,
        found: &'a EventCurve<Cycle, SolutionPoint, machine::CurvePoint>,
    ) -> Self {
        let event = |(k, point): (usize, &machine::CurvePoint)| {
            let event = point.event?;
            let [stop, also] = [event.place(), event.also()].map(|place| place.map(|place| machine.name_of(place)));
            Some(CurveEventObject { kind: event.name(), values: point.values.into(), point: k, stop, also })
        };
        let point = |point: &'a machine::CurvePoint| PointObject {
            values: point.values.into(),
            label: point.cycle.label.to_string(),
            admissible: true,
            period: point.cycle.period,
            cycle: point.cycle.events.iter().map(|event| event::of_machine(machine, event)).collect(),
            multipliers: multipliers(&point.cycle.multipliers),
            residual: Some(point.residual),
            touch: point.touch,
        };
        let parts = Parts {
            found_at: found.events.iter().map(|event| event.value).collect(),
            points: found.points.iter().map(point).collect(),
            events: found.points.iter().enumerate().filter_map(event).collect(),
        };
        let of = found.places.iter().map(|place| machine.name_of(*place)).collect();
        Self::new((found, found.chosen.cycle.label), (plan, &Units::default()), of, parts)
    }
}

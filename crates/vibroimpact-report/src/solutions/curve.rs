//! The points of a curve of events of any system in a plane of two numbers.

use super::CycleView;
use crate::{Asked, Units, Varied};
use vibroimpact::Label;
use vibroimpact::continuation::machine::{self, SolutionPoint};
use vibroimpact::continuation::{CurveEvent, CurvePoint};
use vibroimpact::machine::Machine;
use vibroimpact::orbit::machine::Cycle;
use vibroimpact::verdict::Stability;
use vibroimpact_study::{Chosen, CurvePlan, EventCurve, OrbitNumber, Parameter, Stretch};

/// A curve of events.
#[derive(Clone, Debug)]
pub struct CurveView<'a, V> {
    /// The plan, and the units of the results.
    pub plan: CurvePlan<V>,
    /// See above.
    pub units: Units,
    /// The label of the orbit on whose branch the event is.
    pub label: Label,
    /// Which of those with its label it is; `None` for the motion from the start of a machine.
    pub number: Option<OrbitNumber>,
    /// Its stability; `None` for a solution that is not admissible.
    pub stability: Option<Stability>,
    /// The machine; `None` for an oscillator.
    pub machine: Option<&'a Machine>,
    /// The names of the stops and joints of the curve of a machine.
    pub of: Vec<&'a str>,
    /// Values of the first number at the events of this kind on the branch.
    pub found_at: Vec<f64>,
    /// Index of the event through which the curve passes.
    pub through: usize,
    /// The index of this event among the points.
    pub begin: usize,
    /// The points from one end to the other.
    pub points: Vec<CurvePointView<'a>>,
}

/// A point of a curve of events.
#[derive(Clone, Debug)]
pub struct CurvePointView<'a> {
    /// The values of both numbers.
    pub values: [f64; 2],
    /// The cycle there; on a grazing curve of an oscillator with the impact of speed zero, on one of a machine without it.
    pub cycle: CycleView<'a>,
    /// Whether it is a motion.
    pub admissible: bool,
    /// The name of an event, and its stop or joint if a machine has it there.
    pub event: Option<(&'static str, Option<&'a str>)>,
    /// By how much the condition of the curve of a machine fails.
    pub residual: Option<f64>,
    /// The phase of the contact without speed on a grazing curve of a machine.
    pub touch: Option<f64>,
}

impl<'a> CurveView<'a, Parameter> {
    /// The curve of an oscillator.
    #[must_use]
    pub fn of_oscillator(found: &'a EventCurve, plan: CurvePlan, Asked { system, units }: &Asked) -> Self {
        let of = [plan.vary.parameter, plan.and.parameter];
        let point = |point: &'a CurvePoint| {
            let values = <[f64; 2]>::from(point.values);
            let there = units.at_both((of[0], of[1]), point.values);
            let osc = system.with_all(of.into_iter().zip(values)).and_then(|system| system.oscillator());
            CurvePointView {
                values: scaled(values, &plan, units),
                cycle: CycleView::of_oscillator(&point.cycle, osc.ok(), there),
                admissible: point.physical,
                event: point.event.map(|event| (event.name(), None)),
                residual: None,
                touch: None,
            }
        };
        let points = found.points.iter().map(point).collect();
        let at = found.events.iter().map(|event| event.value).collect();
        Self::new(found, (&found.chosen, found.chosen.cycle.label), (plan, *units), (at, points))
    }
}

impl<'a> CurveView<'a, String> {
    /// The curve of a machine.
    #[must_use]
    pub fn of_machine(
        found: &'a EventCurve<Cycle, SolutionPoint, machine::CurvePoint>,
        plan: CurvePlan<String>,
        machine: &'a Machine,
    ) -> Self {
        let event = |event: CurveEvent| (event.name(), event.place().map(|place| machine.name_of(place)));
        let point = |point: &'a machine::CurvePoint| CurvePointView {
            values: point.values.into(),
            cycle: CycleView::of_machine(&point.cycle, machine),
            admissible: true,
            event: point.event.map(event),
            residual: Some(point.residual),
            touch: point.touch,
        };
        let points = found.points.iter().map(point).collect();
        let at = found.events.iter().map(|event| event.value).collect();
        Self {
            machine: Some(machine),
            of: found.places.iter().map(|place| machine.name_of(*place)).collect(),
            ..Self::new(found, (&found.chosen, found.chosen.cycle.label), (plan, Units::default()), (at, points))
        }
    }
}

impl<'a, V: Varied> CurveView<'a, V> {
    fn new<C, E, P>(
        found: &EventCurve<C, E, P>,
        (chosen, label): (&Chosen<C>, Label),
        (plan, units): (CurvePlan<V>, Units),
        (at, points): (Vec<f64>, Vec<CurvePointView<'a>>),
    ) -> Self {
        let unit = plan.vary.parameter.unit(&units);
        Self {
            plan,
            units,
            label,
            number: chosen.among,
            stability: chosen.stability,
            machine: None,
            of: Vec::new(),
            found_at: at.into_iter().map(|value| value * unit).collect(),
            through: found.through,
            begin: found.begin,
            points,
        }
    }

    /// What varies, with its range.
    pub fn sides(&self) -> [&Stretch<V>; 2] {
        [&self.plan.vary, &self.plan.and]
    }
}

/// Values of both numbers at a point, in the units of the results.
fn scaled<V: Varied>([p, q]: [f64; 2], plan: &CurvePlan<V>, units: &Units) -> [f64; 2] {
    [p * plan.vary.parameter.unit(units), q * plan.and.parameter.unit(units)]
}

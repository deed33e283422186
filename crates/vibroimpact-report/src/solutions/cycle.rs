//! A cycle of any system, and the orbits with a label.

use crate::Units;
use crate::json::event::{self, EventObject, StateObject, side};
use crate::json::quantities;
use serde_json::{Map, Value};
use vibroimpact::Oscillator;
use vibroimpact::events::{self, EventKind};
use vibroimpact::machine::Machine;
use vibroimpact::math::Multiplier;
use vibroimpact::motion::Strobes;
use vibroimpact::orbit::{self, EarlierContact, Orbit, RestSpan, machine};
use vibroimpact::quantities::{machine_cycle_quantities, of_cycle};
use vibroimpact::system::phase;
use vibroimpact::verdict::Stability;
use vibroimpact::{Label, Side};
use vibroimpact_study::ImpactsByStop;

/// A cycle of a system.
#[derive(Clone, Debug)]
pub struct CycleView<'a>(Kind<'a>);

#[derive(Clone, Debug)]
enum Kind<'a> {
    /// The oscillator is there if the parameters give one.
    Oscillator(&'a orbit::Cycle, Option<Box<Oscillator>>, Box<Units>),
    Machine(&'a machine::Cycle, &'a Machine),
}

/// An impact on a stop, or the beginning of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closing<'a> {
    /// The phase of the force.
    pub phase: f64,
    /// The speed, in the units of the results.
    pub speed: f64,
    /// The name of the stop.
    pub stop: &'a str,
    /// The number of times that the motion sticks before it in the list, and of closings since then. This identifies a closing
    /// from point to point of a branch, where the number of listed impacts of a chatter varies.
    pub place: (usize, usize),
}

impl<'a> CycleView<'a> {
    /// The cycle of an oscillator, whose results are in these units.
    #[must_use]
    pub fn of_oscillator(cycle: &'a orbit::Cycle, osc: Option<Oscillator>, units: Units) -> Self {
        Self(Kind::Oscillator(cycle, osc.map(Box::new), Box::new(units)))
    }

    /// The cycle of a machine.
    #[must_use]
    pub const fn of_machine(cycle: &'a machine::Cycle, machine: &'a Machine) -> Self {
        Self(Kind::Machine(cycle, machine))
    }

    /// The cycle of a machine itself.
    pub(crate) const fn machine_cycle(&self) -> Option<&'a machine::Cycle> {
        if let Kind::Machine(cycle, _) = self.0 { Some(cycle) } else { None }
    }

    /// Its label.
    #[must_use]
    pub const fn label(&self) -> Label {
        match &self.0 {
            Kind::Oscillator(cycle, ..) => cycle.label,
            Kind::Machine(cycle, _) => cycle.label,
        }
    }

    /// Whether neighbours approach it.
    #[must_use]
    pub fn stability(&self) -> Stability {
        match &self.0 {
            Kind::Oscillator(cycle, ..) => cycle.stability(),
            Kind::Machine(cycle, _) => cycle.stability(),
        }
    }

    /// Its Floquet multipliers.
    #[must_use]
    pub fn multipliers(&self) -> &'a [Multiplier] {
        match &self.0 {
            Kind::Oscillator(cycle, ..) => &cycle.multipliers,
            Kind::Machine(cycle, _) => &cycle.multipliers,
        }
    }

    /// The time of one period; not-a-number where the parameters give no system.
    #[must_use]
    pub fn period(&self) -> f64 {
        match &self.0 {
            Kind::Oscillator(cycle, osc, units) => {
                let one = osc.as_ref().map_or(f64::NAN, |osc| osc.period());
                f64::from(cycle.label.periods) * one * units.time()
            }
            Kind::Machine(cycle, _) => cycle.period,
        }
    }

    /// The speed of its fastest closing.
    #[must_use]
    pub fn fastest(&self) -> f64 {
        match &self.0 {
            Kind::Oscillator(cycle, _, units) => cycle.fastest() * units.velocity(),
            Kind::Machine(cycle, _) => cycle.fastest(),
        }
    }

    /// By how much each coordinate of a machine that can be translated moves on in one period.
    #[must_use]
    pub fn drift(&self) -> Option<&'a [f64]> {
        match &self.0 {
            Kind::Machine(cycle, _) if cycle.translations() > 0 => Some(&cycle.drift),
            _ => None,
        }
    }

    /// Whether it sticks on a stop.
    #[must_use]
    pub fn sticks(&self) -> bool {
        match &self.0 {
            Kind::Oscillator(cycle, ..) => !cycle.rests.is_empty(),
            Kind::Machine(cycle, _) => cycle.events.iter().any(|event| event.kind == EventKind::Stick),
        }
    }

    /// Its closings, in order.
    #[must_use]
    pub fn closings(&self) -> Vec<Closing<'a>> {
        match &self.0 {
            Kind::Oscillator(cycle, _, units) => of_oscillator(cycle, units),
            Kind::Machine(cycle, machine) => of_machine(cycle, machine),
        }
    }

    /// Its events, in order, as JSON objects.
    pub(crate) fn events(&self) -> Vec<EventObject<'a>> {
        match &self.0 {
            Kind::Oscillator(cycle, osc, units) => {
                osc.as_ref().map_or_else(Vec::new, |osc| event::of_cycle(osc, cycle, units))
            }
            Kind::Machine(cycle, machine) => {
                cycle.events.iter().map(|event| event::of_machine(machine, event)).collect()
            }
        }
    }

    /// Closings of each stop in one period, by name.
    pub(crate) fn counts(&self) -> Map<String, Value> {
        match &self.0 {
            Kind::Oscillator(cycle, osc, _) => {
                let by = ImpactsByStop::of_cycle(cycle);
                let count = |at: Side| if at == Side::Upper { by.upper } else { by.lower };
                let stops = osc.iter().flat_map(|osc| osc.stops());
                stops.map(|(at, _)| (side(at).to_owned(), count(at).into())).collect()
            }
            Kind::Machine(cycle, machine) => {
                let counts = machine.stops().iter().zip(&cycle.counts);
                counts.map(|(stop, count)| (stop.name.clone(), Value::from(*count))).collect()
            }
        }
    }

    /// Rests on stops, and holds of joints, in one period.
    pub(crate) fn rests(&self) -> usize {
        let rests = |event: &&events::Event| matches!(event.kind.name(), "stick" | "hold");
        match &self.0 {
            Kind::Oscillator(cycle, ..) => cycle.rests.len(),
            Kind::Machine(cycle, _) => cycle.events.iter().filter(rests).count(),
        }
    }

    /// A number of each coordinate of a machine that can be translated, by name.
    pub(crate) fn drift_by_name(&self, of: impl Fn(&machine::Cycle) -> Vec<f64>) -> Option<Map<String, Value>> {
        let Kind::Machine(cycle, machine) = &self.0 else { return None };
        let names = machine.parts().coordinates.iter().cloned();
        (cycle.translations() > 0).then(|| names.zip(of(cycle).into_iter().map(Value::from)).collect())
    }

    /// A state between two events from which it can be started.
    pub(crate) fn state(&self) -> Option<StateObject<'a>> {
        match &self.0 {
            Kind::Oscillator(cycle, osc, units) => StateObject::within(osc.as_ref()?, cycle, units),
            Kind::Machine(cycle, machine) => Some(StateObject::of(machine, &cycle.state)),
        }
    }

    /// By how much its equations fail.
    pub(crate) const fn residual(&self) -> f64 {
        match &self.0 {
            Kind::Oscillator(cycle, ..) => cycle.residual,
            Kind::Machine(cycle, _) => cycle.residual,
        }
    }

    /// Its quantities.
    pub(crate) fn quantities(&self) -> Option<Map<String, Value>> {
        Some(match &self.0 {
            Kind::Oscillator(cycle, osc, units) => quantities::of_oscillator(&of_cycle(osc.as_ref()?, cycle)?, units),
            Kind::Machine(cycle, machine) => {
                quantities::of_machine(machine, &machine_cycle_quantities(machine, cycle)?)
            }
        })
    }

    /// Velocity and position of an oscillator at phase 0 of the force in each of its periods. A solution that is not admissible has
    /// none.
    pub(crate) fn strobes(&self) -> Vec<(f64, f64)> {
        let Kind::Oscillator(cycle, Some(osc), units) = &self.0 else { return Vec::new() };
        let Some(first) = cycle.points.first() else { return Vec::new() };
        let states = Strobes::new(osc, first.state.rebound(osc), 0.0).take(cycle.label.periods as usize);
        states.map(|state| (state.v * units.velocity(), state.x * units.length())).collect()
    }
}

fn of_oscillator(cycle: &orbit::Cycle, units: &Units) -> Vec<Closing<'static>> {
    let closing = |(point, place): (&orbit::CyclePoint, (usize, usize))| Closing {
        phase: point.state.phase,
        speed: point.state.velocity * units.velocity(),
        stop: side(point.state.side),
        place,
    };
    cycle.points.iter().zip(places(cycle)).map(closing).collect()
}

fn of_machine<'a>(cycle: &'a machine::Cycle, machine: &'a Machine) -> Vec<Closing<'a>> {
    let mut place = (0, 0);
    let mut closings = Vec::new();
    for event in &cycle.events {
        if event.closes() {
            let stop = machine.name_of(event.place);
            closings.push(Closing { phase: event.phase, speed: event.speed, stop, place });
            place.1 += 1;
        } else if event.kind == EventKind::Stick {
            place = (place.0 + 1, 0);
        }
    }
    closings
}

/// The [place](Closing::place) of each impact of a cycle of an oscillator.
fn places(cycle: &orbit::Cycle) -> Vec<(usize, usize)> {
    let last = |rest: &RestSpan| {
        let all = cycle.points.iter().enumerate().filter(|(_, point)| point.state.side == rest.side);
        let ago = |at: f64| phase::wrap(rest.begin - at + NOTHING);
        all.min_by(|a, b| ago(a.1.state.phase).total_cmp(&ago(b.1.state.phase))).map(|(k, _)| k)
    };
    let ends: Vec<usize> = cycle.rests.iter().filter_map(last).collect();
    let mut place = (0, 0);
    let step = |k| {
        let here = place;
        place = if ends.contains(&k) { (place.0 + 1, 0) } else { (place.0, place.1 + 1) };
        here
    };
    (0..cycle.points.len()).map(step).collect()
}

/// Phases closer than this are equal.
const NOTHING: f64 = 1e-9;

/// An orbit with a label.
#[derive(Clone, Debug)]
pub struct OrbitView<'a> {
    /// Its cycle.
    pub cycle: CycleView<'a>,
    /// Whether it is a motion, or an inadmissible solution.
    pub admissible: bool,
    /// Where a solution of an oscillator passes through a stop.
    pub earlier: Option<EarlierContact>,
}

impl OrbitView<'_> {
    /// Whether it has impacts.
    pub(crate) fn has_impacts(&self) -> bool {
        !self.cycle.closings().is_empty()
    }
}

/// The orbits of an oscillator.
#[must_use]
pub fn orbits<'a>(found: &'a [Orbit], osc: &Oscillator, units: &Units) -> Vec<OrbitView<'a>> {
    let view = |orbit: &'a Orbit| OrbitView {
        cycle: CycleView::of_oscillator(&orbit.cycle, Some(*osc), *units),
        admissible: orbit.physical,
        earlier: orbit.earlier,
    };
    found.iter().map(view).collect()
}

/// The orbits of a machine. Solutions that are not admissible are not found.
#[must_use]
pub fn machine_orbits<'a>(found: &'a [machine::Cycle], machine: &'a Machine) -> Vec<OrbitView<'a>> {
    let view = |cycle| OrbitView { cycle: CycleView::of_machine(cycle, machine), admissible: true, earlier: None };
    found.iter().map(view).collect()
}

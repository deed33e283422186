//! Cycles of the oscillator that a machine is, in the numbers of the machine, and back.
//!
//! Nothing is computed anew: impacts are converted, and multipliers belong to the motion, whatever its units are.

use super::cycle::Cycle;
use super::frame::MachineFrame;
use crate::events::{Event, EventKind, Limits, Motion, Place, Start};
use crate::flight::Flight;
use crate::machine::Reduction;
use crate::math::{ln, sort_by};
use crate::motion::ImpactState;
use crate::orbit;
use crate::orbit::{Count, CyclePoint, FindOptions, Label, find_while};
use crate::regime::{ContactState, Translations};
use crate::system;
use crate::system::{Oscillator, phase};

impl Cycle {
    /// The cycle of the oscillator that a machine with this number of stops is; `None` if it sticks, or has no flight.
    pub(crate) fn of_oscillator(reduction: &Reduction, stops: usize, cycle: &orbit::Cycle) -> Option<Self> {
        if !cycle.rests.is_empty() {
            return None;
        }
        let osc = &reduction.oscillator;
        let mut events = Vec::with_capacity(cycle.points.len());
        let (mut time, mut counts) = (0.0, vec![0; stops]);
        for point in &cycle.points {
            let ImpactState { side, velocity, .. } = point.state;
            let (q, qdot, phase) = reduction.state(point.state.rebound(osc));
            let place = reduction.stop(side)?;
            counts[place] += 1;
            events.push(Event {
                kind: EventKind::Impact,
                place,
                time: time * reduction.time(),
                phase,
                speed: reduction.speed(side, velocity),
                q: vec![q],
                qdot: vec![qdot],
                with: Vec::new(),
                tie: false,
                state: None,
            });
            time += point.interval;
        }
        let period = f64::from(cycle.label.periods) * reduction.period();
        rotate_to_fastest(&mut events, period);
        let strobes = strobes(reduction, stops, cycle)?;
        // to mass-normalised coordinates, which places have
        let root = reduction.mass().sqrt();
        let largest = |of: fn(&Event) -> f64, strobe: f64| {
            events.iter().map(|event| root * of(event).abs()).fold(strobe.abs(), f64::max)
        };
        let sizes = (
            largest(|event| event.q[0], strobes[0].x[0]),
            largest(|event| event.qdot[0].abs().max(event.speed), strobes[0].v[0]),
        );
        // no stop is closed in the middle of a flight
        let contacts = Vec::new();
        let state = Start {
            q: vec![strobes[0].x[0] / root],
            qdot: vec![strobes[0].v[0] / root],
            phase: strobes[0].phase,
            contacts,
            exact: Vec::new(),
        };
        Some(Self {
            label: cycle.label,
            counts,
            events,
            period,
            multipliers: cycle.multipliers.to_vec(),
            residual: cycle.residual,
            drift: vec![0.0],
            state,
            strobes,
            logs: cycle.multipliers.iter().map(|multiplier| ln(multiplier.modulus())).collect(),
            sizes,
            rounding: cycle.rounding(),
            free: Translations::default(),
        })
    }

    /// The cycle of the oscillator that the machine is; `None` if it rests.
    pub(crate) fn to_oscillator(&self, reduction: &Reduction) -> Option<orbit::Cycle> {
        let impacts: Vec<&Event> = self.events.iter().filter(|event| event.kind != EventKind::Graze).collect();
        let [one, two] = *self.multipliers.as_slice() else { return None };
        let point = |(k, event): (usize, &&Event)| {
            let next = impacts.get(k + 1).map_or(self.period + impacts[0].time, |next| next.time);
            // an event that is no impact, as the release of a stop, means that it rests
            let side = reduction.side(event.place).filter(|_| event.kind == EventKind::Impact)?;
            let state = ImpactState {
                phase: phase::wrap(event.phase + reduction.phase()),
                velocity: reduction.arrival(side, event.speed),
                side,
            };
            Some(CyclePoint { state, interval: (next - event.time) / reduction.time() })
        };
        Some(orbit::Cycle {
            label: self.label,
            points: impacts.iter().enumerate().map(point).collect::<Option<_>>()?,
            rests: Vec::new(),
            multipliers: [one, two],
            residual: self.residual,
        })
    }
}

/// Makes the fastest event the first one, at time 0.
fn rotate_to_fastest(events: &mut [Event], period: f64) {
    // of equal speeds the first one
    let faster = |a: &usize, b: &usize| events[*a].speed.total_cmp(&events[*b].speed).then(b.cmp(a));
    let Some(first) = (0..events.len()).max_by(faster).filter(|first| *first > 0) else { return };
    let zero = events[first].time;
    for (k, event) in events.iter_mut().enumerate() {
        event.time += if k < first { period - zero } else { -zero };
    }
    events.rotate_left(first);
}

/// The states of a cycle at one phase, in each forcing period, the first in the middle of its longest flight.
fn strobes(reduction: &Reduction, stops: usize, cycle: &orbit::Cycle) -> Option<Vec<Place>> {
    let (osc, points, root) = (&reduction.oscillator, &cycle.points, reduction.mass().sqrt());
    let longest = (0..points.len()).max_by(|a, b| points[*a].interval.total_cmp(&points[*b].interval));
    // without impacts it is the steady motion
    let Some(longest) = longest else { return Some(vec![place(reduction, stops, root, system::Start::steady(osc))]) };
    let (mut k, mut time) = (longest, 0.5 * points[longest].interval);
    let first = phase::wrap(points[longest].state.phase + osc.beta() * time);
    let mut all = Vec::with_capacity(cycle.label.periods as usize);
    for _ in 0..cycle.label.periods {
        while time >= points[k].interval {
            time -= points[k].interval;
            k = (k + 1) % points.len();
        }
        let (x, v) = Flight::new(osc, points[k].state.rebound(osc)).state(time);
        // one phase for all of them, without the rounding of the time
        all.push(place(reduction, stops, root, system::Start { x, v, phase: first }));
        time += osc.period();
    }
    Some(all)
}

/// The state of a machine at one of the oscillator at which no stop is closed; `root` is the square root of its mass.
fn place(reduction: &Reduction, stops: usize, root: f64, at: system::Start) -> Place {
    let (q, qdot, phase) = reduction.state(at);
    Place {
        x: vec![root * q],
        v: vec![root * qdot],
        phase,
        states: vec![ContactState::Open; stops],
        surfaces: vec![None; stops],
        known: Vec::new(),
        gaps: Vec::new(),
    }
}

/// A state of a cycle between two contacts; `None` for a cycle without impacts.
pub(crate) fn flying(osc: &Oscillator, cycle: &orbit::Cycle) -> Option<system::Start> {
    let (flight, time) = match cycle.rests.last() {
        // its impacts begin after this release
        Some(rest) => {
            let turn = phase::wrap(cycle.points.first()?.state.phase - rest.release);
            (Flight::release(osc, rest.side, rest.release), turn / osc.beta())
        }
        None => {
            let longest = cycle.points.iter().max_by(|a, b| a.interval.total_cmp(&b.interval))?;
            (Flight::new(osc, longest.state.rebound(osc)), longest.interval)
        }
    };
    let (x, v) = flight.state(0.5 * time);
    Some(system::Start { x, v, phase: flight.phase_at(0.5 * time) })
}

/// The orbits of a machine with a label that are those of the oscillator that it is, the fastest last; `None` inside if the machine
/// is none, or has orbits that the oscillator does not list. `None` once `go_on` has returned false.
pub(super) fn orbits(frame: &MachineFrame<'_>, label: Label, go_on: &dyn Fn() -> bool) -> Option<Option<Vec<Cycle>>> {
    let Some(reduction) = frame.machine.reduced() else { return Some(None) };
    let found = find_while(&reduction.oscillator, label, FindOptions::default(), go_on)?;
    let of = |cycle: &orbit::Cycle| match cycle.rests.as_slice() {
        [] => Cycle::of_oscillator(&reduction, frame.machine.stops().len(), cycle),
        _ => closed(frame, &reduction, cycle),
    };
    // the oscillator lists orbits that would pass through a stop, too
    let admissible = found.iter().filter(|orbit| orbit.physical);
    let mut cycles: Vec<Cycle> = match admissible.map(|orbit| of(&orbit.cycle)).collect() {
        // without damping the motion without impacts is one of a continuum, which the oscillator does not list
        Some(cycles) if label.impacts != Count::Finite(0) || !found.is_empty() => cycles,
        _ => return Some(None),
    };
    sort_by(&mut cycles, |a, b| a.fastest().total_cmp(&b.fastest()));
    Some(Some(cycles))
}

/// A cycle that sticks, closed by the machine; `None` if the machine gives it another label.
fn closed(frame: &MachineFrame<'_>, reduction: &Reduction, cycle: &orbit::Cycle) -> Option<Cycle> {
    let (q, qdot, phase) = reduction.state(flying(&reduction.oscillator, cycle)?);
    let start = Start { q: vec![q], qdot: vec![qdot], phase, ..Start::default() };
    let motion = Motion::new(frame.machine, &start, Limits::default()).ok()?;
    Cycle::near(frame, motion.place(), cycle.label.periods).filter(|found| found.label == cycle.label)
}

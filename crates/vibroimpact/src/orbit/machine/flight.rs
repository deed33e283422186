//! The flights of a ring and the events at their ends: residuals, and their derivatives by the unknowns and by a number of the
//! machine.

use super::frame::MachineFrame;
use super::ring::{MachineBlock, MachineRing, Push, RingEvent};
use crate::arc::{MachineFlight, Recovery};
use crate::events::{ByNumber, EventLaw, LinearEvent, LinearGuard, Place, standing_back};
use crate::machine::{MachineParts, StopLaw};
use crate::math::{Matrix, add_scaled, dot};
use crate::regime::{ContactState, GuardKind, Orthonormal, Structure};

/// A contact that vanishes may last for a negative time, as a phase up to this: its solutions are not admissible then.
const BRIEF: f64 = 0.05;

/// Another rigid stop that is struck at the same time as the one whose gap times the event, and a direction along which the gaps before
/// it do not change. The structure is moved onto it: its gap has no equation of its own, and of bodies that nothing but their impacts
/// ties to each other the place of one beside another would be undetermined.
struct Beside {
    guard: usize,
    stop: usize,
    along: Vec<f64>,
}

impl Beside {
    /// Those among the guards of an event.
    fn all(
        frame: &MachineFrame<'_>,
        structure: &Structure,
        (guards, pushed): (&[usize], &[(usize, f64)]),
    ) -> Vec<Self> {
        let directions = &frame.normal.directions;
        let struck = |guard: &usize| match structure.guards[*guard].kind {
            GuardKind::Gap(stop) if pushed.iter().any(|(j, _)| *j == stop) => Some((*guard, stop)),
            _ => None,
        };
        let mut before: Vec<&Vec<f64>> = Vec::new();
        let mut all = Vec::new();
        for (k, guard) in guards.iter().enumerate() {
            let Some((guard, stop)) = struck(guard) else { continue };
            let direction = &directions[stop];
            if k > 0
                && let Some(along) = Orthonormal::spanning(before.iter().copied()).beside(direction)
            {
                all.push(Self { guard, stop, along });
            }
            before.push(direction);
        }
        // the first one must time the event
        if guards.first().and_then(struck).is_none() { Vec::new() } else { all }
    }
}

/// By how much the coordinates move where these gaps, or changes of them, become zero.
fn moved_onto(beside: &[Beside], frame: &MachineFrame<'_>, gaps: &[f64]) -> Vec<f64> {
    let mut moved = vec![0.0; frame.shape.n];
    for (Beside { stop, along, .. }, gap) in beside.iter().zip(gaps) {
        let direction = &frame.normal.directions[*stop];
        let left = gap - dot(direction, &moved);
        add_scaled(&mut moved, left / dot(direction, along), along);
    }
    moved
}

/// A flight of a ring, and the event at its end.
struct RingFlight<'a> {
    event: &'a RingEvent,
    time: f64,
    from: Place,
    flight: MachineFlight,
    /// The guards of the structure that are zero at the end, and the rigid stops that push there with their restitution.
    guards: Vec<usize>,
    pushed: Vec<(usize, f64)>,
    beside: Vec<Beside>,
    /// The states before and after the event.
    before: Place,
    after: Place,
    /// The state that the ring has after the event.
    to: Place,
    /// What the value of the guard is divided by.
    divisor: f64,
    /// Whether the cycle is closed but for translations.
    drifts: bool,
}

impl RingFlight<'_> {
    /// The law of the event if another guard timed it.
    fn timed_by<'b>(&'b self, guard: &'b [usize; 1]) -> EventLaw<'b> {
        EventLaw { guards: guard, ..self.law() }
    }

    fn law(&self) -> EventLaw<'_> {
        EventLaw {
            structure: &self.flight.structure,
            guards: &self.guards,
            pushed: &self.pushed,
            rounds: &self.event.rounds,
        }
    }

    fn miss(&self, frame: &MachineFrame<'_>) -> Vec<f64> {
        let (reached, wanted) = (frame.shape.values(&self.after), frame.shape.values(&self.to));
        let mut miss = vec![self.law().value(&frame.normal, &self.before) / self.divisor];
        miss.extend(reached.iter().zip(&wanted).map(|(reached, wanted)| reached - wanted));
        if self.drifts {
            let free = &frame.normal.translations;
            free.remove(&mut miss[1..]);
            let part = free.part(&self.to.x);
            add_scaled(&mut miss[1..=part.len()], -1.0, &part);
        }
        miss
    }
}

impl MachineRing {
    /// The flight after event `k`; `None` if it is not defined.
    fn flight(&self, frame: &MachineFrame<'_>, k: usize) -> Option<RingFlight<'_>> {
        let (mut from, next) = (self.place(k), (k + 1) % self.len());
        frame.constrain(&mut from)?;
        let event = &self.events[next];
        let time = self.time(k, frame.machine);
        // a contact that vanishes along a branch is followed a little beyond
        let brief = self.contact(k).is_some() && time * self.frequency(frame.machine) > -BRIEF;
        if !((time > 0.0 || self.together == Some(k) || self.rests(k) || brief) && time.is_finite()) {
            return None;
        }
        // the depth is zero at once, where the contact begins: this zero is divided out
        let divisor = if self.is_between_zeros(k) { time } else { 1.0 };
        if divisor == 0.0 {
            return None;
        }
        let structure = frame.structure(&from.states)?;
        let flown = from.unguarded_flight(&frame.normal, structure.clone());
        let mut before = frame.moved_in(&flown, &from, time);
        for (now, begun) in before.surfaces.iter_mut().zip(&from.surfaces) {
            // one that comes back in the limit only stands back by nothing
            *now =
                now.or(begun.filter(|surface| surface.offset == 0.0).map(|surface| Recovery { size: 0.0, ..surface }));
        }
        let of = |kind: GuardKind| structure.guards.iter().position(|guard| guard.kind == kind);
        let guards: Vec<usize> = event.guards().map(of).collect::<Option<_>>()?;
        let restitution = |j: usize| match frame.machine.stops()[j].law {
            StopLaw::Rigid { restitution } => restitution,
            StopLaw::Compliant { .. } => 0.0,
        };
        let pushed: Vec<(usize, f64)> = event
            .pushed
            .iter()
            .map(|(j, push)| (*j, if *push == Push::Rebounds { restitution(*j) } else { 0.0 }))
            .collect();
        let beside = Beside::all(frame, &structure, (&guards, &pushed));
        // the cycle closes here
        let drifts = next == 0 && !frame.normal.translations.is_empty();
        let (to, after) = (self.place(next), before.clone());
        let mut flight =
            RingFlight { event, time, from, flight: flown, guards, pushed, beside, before, after, to, divisor, drifts };
        flight.after.v = flight.law().rebound(&frame.normal, &flight.before)?;
        let gap = |own: &Beside| flight.timed_by(&[own.guard]).value(&frame.normal, &flight.before);
        let gaps: Vec<f64> = flight.beside.iter().map(gap).collect();
        add_scaled(&mut flight.after.x, 1.0, &moved_onto(&flight.beside, frame, &gaps));
        flight.after.states.clone_from(&event.after);
        let turns = flight.before.turns(&frame.normal);
        for (j, back) in event.back.iter().enumerate() {
            match (flight.before.surfaces[j], back) {
                (None, true) => {
                    let depth = -flight.before.gap(&frame.normal, &turns, j).0;
                    flight.after.surfaces[j] = Some(standing_back(&frame.machine.stops()[j].law, depth)?);
                }
                (_, false) => flight.after.surfaces[j] = None,
                _ => {}
            }
        }
        Some(flight)
    }

    /// The flight after event `k` and the event at its end to first order.
    pub(crate) fn block(&self, frame: &MachineFrame<'_>, k: usize) -> Option<MachineBlock> {
        self.block_of(frame, k, &self.flight(frame, k)?)
    }

    fn block_of(&self, frame: &MachineFrame<'_>, k: usize, flight: &RingFlight<'_>) -> Option<MachineBlock> {
        let miss = flight.miss(frame);
        let RingFlight { event, time, from, before, after, .. } = flight;
        let structure = &flight.flight.structure;
        let frequency = self.frequency(frame.machine);
        let size = frame.shape.size();
        let next = frame.structure(&event.after)?;
        let mut other = |states: &[ContactState]| frame.structure(states);
        let linear = LinearEvent::at(&frame.shape, &frame.normal, &flight.law(), before, (after, &next), &mut other)?;
        let first = linear.guards.first()?;
        let transition = frame.shape.transition(structure, &frame.normal, from, *time);
        let start = frame.shape.flow_in(&flight.flight, from);
        let mut through = linear.reset.times(&transition);
        // nothing jumps at a touch
        let touched = event.touches(&from.states).then(|| through.clone());
        let beside: Vec<&LinearGuard> = flight
            .beside
            .iter()
            .filter_map(|own| linear.guards.get(flight.guards.iter().position(|g| *g == own.guard)?))
            .collect();
        let changes: Vec<Vec<f64>> = beside.iter().map(|own| transition.apply_transposed(&own.gradient)).collect();
        for j in (0..size).filter(|_| !beside.is_empty()) {
            let gaps: Vec<f64> = changes.iter().map(|change| change[j]).collect();
            for (i, moved) in moved_onto(&flight.beside, frame, &gaps).into_iter().enumerate() {
                through[(i, j)] += moved;
            }
        }
        let guarded = transition.apply_transposed(&first.gradient);
        let mut left = Matrix::zeros(size + 1, size + 1);
        // an earlier beginning at the same state: the flow at the beginning, carried to the end
        left[(0, 0)] = -dot(&guarded, &start) / frequency;
        left.row_mut(0)[1..].copy_from_slice(&guarded);
        let carried = through.apply(&start);
        // a later end at the same beginning: the flow there through the event, and the rate of the reset
        let mut ended = linear.reset.apply(&linear.flow_before);
        let rates: Vec<f64> = beside.iter().map(|own| own.rate).collect();
        add_scaled(&mut ended[..frame.shape.n], 1.0, &moved_onto(&flight.beside, frame, &rates));
        let mut late = vec![first.rate / frequency];
        for i in 0..size {
            left[(i + 1, 0)] = -carried[i] / frequency;
            left.row_mut(i + 1)[1..].copy_from_slice(through.row(i));
            late.push((ended[i] + linear.reset_rate[i]) / frequency);
        }
        // the quotient rule, for a divisor that is the time between both phases
        if self.is_between_zeros(k) {
            left.row_mut(0).iter_mut().chain(&mut late[..1]).for_each(|value| *value /= time);
            left[(0, 0)] += miss[0] / (time * frequency);
            late[0] -= miss[0] / (time * frequency);
        }
        if flight.drifts {
            frame.normal.translations.remove_from_columns(&mut left, 1);
            frame.normal.translations.remove(&mut late[1..]);
        }
        let step = touched.or_else(|| Some(linear.saltation()?.times(&transition)));
        Some(MachineBlock { miss, left, late, step })
    }

    /// All flights to first order; `None` if one is not defined.
    pub(crate) fn blocks(&self, frame: &MachineFrame<'_>) -> Option<Vec<MachineBlock>> {
        Some(self.with_numbers(frame, &[])?.0)
    }

    /// The same, and the derivatives of all residuals by numbers of the machine, for the derivatives of its numbers by each one.
    pub(crate) fn with_numbers(
        &self,
        frame: &MachineFrame<'_>,
        numbers: &[MachineParts],
    ) -> Option<(Vec<MachineBlock>, Vec<Vec<f64>>)> {
        let flights: Vec<RingFlight<'_>> = (0..self.len()).map(|k| self.flight(frame, k)).collect::<Option<_>>()?;
        let blocks =
            flights.iter().enumerate().map(|(k, flight)| self.block_of(frame, k, flight)).collect::<Option<_>>()?;
        let by_number = |parts: &MachineParts| {
            let by = ByNumber::new(frame.machine, &frame.normal, parts);
            let slopes: Option<Vec<Vec<f64>>> = flights.iter().map(|flight| flight.by_number(frame, &by)).collect();
            Some(slopes?.concat())
        };
        Some((blocks, numbers.iter().map(by_number).collect::<Option<_>>()?))
    }

    /// The residuals of the flight after event `k`.
    pub(crate) fn miss(&self, frame: &MachineFrame<'_>, k: usize) -> Option<Vec<f64>> {
        Some(self.flight(frame, k)?.miss(frame))
    }
}

impl RingFlight<'_> {
    /// The derivatives of the residuals by a number.
    fn by_number(&self, frame: &MachineFrame<'_>, by: &ByNumber<'_>) -> Option<Vec<f64>> {
        let law = self.law();
        let flown = by.flown(&frame.shape, &self.flight, (&self.from, &self.before), self.time)?;
        let mut guard = by.guard(&law, &self.before, &flown)? / self.divisor;
        // the time depends on the number too, if this is the frequency
        if self.divisor == self.time {
            guard -= law.value(&frame.normal, &self.before) * by.duration(self.time) / (self.time * self.time);
        }
        let gap = |own: &Beside| by.guard(&self.timed_by(&[own.guard]), &self.before, &flown);
        let gaps: Vec<f64> = self.beside.iter().map(gap).collect::<Option<_>>()?;
        let moved = moved_onto(&self.beside, frame, &gaps);
        let summed = |j: usize| self.event.pushed.iter().any(|(of, push)| *of == j && *push != Push::Rebounds);
        let mut after = by.after(&law, &summed, (&self.before, &self.after), flown)?;
        add_scaled(&mut after.x, 1.0, &moved);
        let surfaces = frame.shape.surfaces.iter().map(|j| after.surfaces[*j]);
        let mut slopes: Vec<f64> = core::iter::once(guard).chain(after.x).chain(after.v).chain(surfaces).collect();
        if self.drifts {
            let misses = self.after.x.iter().zip(&self.to.x);
            let apart: Vec<f64> = misses.map(|(after, to)| after - to).collect();
            frame.normal.translations.remove(&mut slopes[1..]);
            by.turned(&apart, &self.to.x, &mut slopes[1..]);
        }
        Some(slopes)
    }
}

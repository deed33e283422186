//! The events of a cycle of a machine as unknowns, and the equations that they obey.
//!
//! The unknowns are the phase $`\theta_k`$ of each event and the state $`z_k`$ after it. The *signature* prescribes which
//! guard is zero at each event, the states of all stops and joints after it, and the number n of forcing periods. The
//! flight after event k takes $`T_k = (\theta_{k+1} - \theta_k)/\omega`$ in one regime and ends at $`z_-`$; there
//!
//! $$`h_{k+1}(z_-, \theta_{k+1}) = 0, \qquad R_{k+1}(z_-, \theta_{k+1}) = z_{k+1}`$$
//!
//! with the guard $`h`$ and the reset $`R`$. No first zero is searched for, so the equations are smooth through grazing.
//! Where a compliant stop is grazed, a contact lasts for no time. The depth is zero at its beginning and at its end, so the
//! equation of its end is divided by its duration: it is smooth there too, and goes on to contacts of negative duration, which
//! are not admissible.
//!
//! In a machine with free translations the last flight closes the cycle but for one: the drift is what remains. The place
//! of the first event along them is 0 instead, so that the solution is one.
//!
//! Without forcing the phases are times, in units in which the cycle that the ring was made of has the period $`2\pi`$. The
//! cycle can begin at any time. Here it ends at the phase 0, so the phase of the first event is an unknown like the others:
//! its negative is the period.

use super::frame::MachineFrame;
use crate::arc::Recovery;
use crate::events::{Passage, Place, StateShape, standing_back};
use crate::machine::Machine;
use crate::math::{Matrix, add_scaled};
use crate::regime::{ContactState, GuardKind, Structure, Translations};
use crate::system::{decay, phase};
use core::f64::consts::TAU;
use std::sync::Arc;

/// Two parts of a cycle that differ by less are the same.
const ALIKE: f64 = 3e-4;

/// The least depth at an opening by force, for contacts that vanish.
const LEAST: f64 = 1e-12;

/// An event of a signature.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct RingEvent {
    /// The guard that is zero.
    pub(crate) guard: GuardKind,
    /// Other guards that are zero at the same time.
    pub(crate) with: Vec<GuardKind>,
    /// The states of all stops and joints after it.
    pub(crate) after: Vec<ContactState>,
    /// The rigid stops that push, and how.
    pub(crate) pushed: Vec<(usize, Push)>,
    /// The number of these in each round of impacts in turn; empty if all push together.
    pub(crate) rounds: Vec<usize>,
    /// The stops whose surfaces stand back after it.
    pub(crate) back: Vec<bool>,
}

/// How a rigid stop pushes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Push {
    /// With its restitution.
    Rebounds,
    /// Without: impacts in turn follow each other without end at this time.
    Still,
    /// Without: a chatter is summed.
    Summed,
}

impl RingEvent {
    /// An event at a guard without an impulse; a touch, at which the motion goes on as if the guard were not there, if `after` are
    /// the states before it too.
    pub(crate) fn touch(guard: GuardKind, after: &[ContactState], back: Vec<bool>) -> Self {
        Self { guard, with: Vec::new(), after: after.to_vec(), pushed: Vec::new(), rounds: Vec::new(), back }
    }

    /// All guards that are zero.
    pub(crate) fn guards(&self) -> impl Iterator<Item = GuardKind> {
        core::iter::once(self.guard).chain(self.with.iter().copied())
    }

    /// Whether this guard is zero.
    pub(crate) fn has(&self, guard: GuardKind) -> bool {
        self.guards().any(|own| own == guard)
    }

    /// Whether it has an impulse on this stop.
    pub(crate) fn pushes(&self, stop: usize) -> bool {
        self.pushed.iter().any(|(pushed, _)| *pushed == stop)
    }

    /// Whether nothing happens at it, where `before` are the states before.
    pub(crate) fn touches(&self, before: &[ContactState]) -> bool {
        self.pushed.is_empty() && self.after == before
    }

    /// The event at the end of a step; `None` if there is none.
    pub(crate) fn of(passage: &Passage) -> Option<Self> {
        let after = passage.after.as_ref()?;
        let kind = |guard: &usize| passage.structure.guards.get(*guard).map(|guard| guard.kind);
        let (first, others) = passage.guards.split_first()?;
        let last = passage.pushed.len() - passage.rounds.last().copied().unwrap_or(passage.pushed.len());
        let push = |k: usize| match (passage.rest.is_some(), passage.ends_still && k >= last) {
            (true, _) => Push::Summed,
            (false, true) => Push::Still,
            (false, false) => Push::Rebounds,
        };
        Some(Self {
            guard: kind(first)?,
            with: others.iter().filter_map(kind).collect(),
            after: after.states.clone(),
            pushed: passage.pushed.iter().enumerate().map(|(k, (j, _))| (*j, push(k))).collect(),
            rounds: passage.rounds.clone(),
            back: after.surfaces.iter().map(Option::is_some).collect(),
        })
    }
}

/// The events of a cycle: signature and unknowns.
#[derive(Clone, Debug)]
pub(crate) struct MachineRing {
    pub(crate) events: Vec<RingEvent>,
    /// The states after the events. Their phases increase along the cycle beyond 2 pi.
    pub(crate) places: Vec<Place>,
    /// The number of forcing periods; 0 without forcing.
    pub(crate) periods: u32,
    /// The angle in a unit of time by which phases are times without forcing.
    pub(crate) pace: f64,
    /// An event that may come at the same time as the next one, or by rounding after it.
    pub(crate) together: Option<usize>,
}

/// One flight of a cycle and the event at its end, to first order.
pub(crate) struct MachineBlock {
    /// The residuals: of the guard, and of the state after the event.
    pub(crate) miss: Vec<f64>,
    /// Their derivatives by phase and state at the beginning,
    pub(crate) left: Matrix,
    /// and by the phase at the end. Those by the state after the event are -1 on the diagonal.
    pub(crate) late: Vec<f64>,
    /// The derivative of the state after the event by that after the one before; `None` where the guard is touched.
    pub(crate) step: Option<Matrix>,
}

impl MachineRing {
    /// The same motion where the first event has no part along a free translation.
    pub(crate) fn centred(mut self, free: &Translations) -> Self {
        if !free.is_empty() {
            let part = self.places.first().map_or_else(Vec::new, |first| free.part(&first.x));
            for place in &mut self.places {
                add_scaled(&mut place.x, -1.0, &part);
            }
        }
        self
    }

    /// The number of events.
    pub(crate) fn len(&self) -> usize {
        self.events.len()
    }

    /// The phase of event `k`, not reduced to one forcing period; `k` may lie in the next period.
    pub(crate) fn theta(&self, k: usize) -> f64 {
        let m = self.len();
        if k < m { self.places[k].phase } else { self.places[k - m].phase + self.angle() }
    }

    /// Whether the machine has no forcing.
    const fn unforced(&self) -> bool {
        self.periods == 0
    }

    /// The phase of one period of the cycle.
    // without forcing the phases are counted so that the cycle ends at 0
    pub(crate) fn angle(&self) -> f64 {
        if self.unforced() { -self.places[0].phase } else { TAU * f64::from(self.periods) }
    }

    /// The rate of phases in time.
    pub(crate) fn frequency(&self, machine: &Machine) -> f64 {
        machine.parts().frequency.unwrap_or(self.pace)
    }

    /// The period of the cycle.
    pub(crate) fn period(&self, frame: &MachineFrame<'_>) -> f64 {
        frame.time(self.periods, self.angle() / self.pace)
    }

    /// Adds an event before event `k`, with the state after it.
    pub(crate) fn insert(&mut self, k: usize, event: RingEvent, place: Place) {
        self.events.insert(k, event);
        self.places.insert(k, place);
    }

    /// Leaves out event `k`.
    pub(crate) fn remove(&mut self, k: usize) {
        let angle = self.angle();
        self.events.remove(k);
        self.places.remove(k);
        if let Some(first) = self.places.first().filter(|_| k == 0) {
            // the cycle ends at the event that is the first one now
            self.end_at(first.phase + angle);
        }
    }

    /// All unknowns: for each event its phase and the state after it.
    pub(crate) fn unknowns(&self, shape: &StateShape) -> Vec<f64> {
        let of = |place: &Place| core::iter::once(place.phase).chain(shape.values(place)).collect::<Vec<f64>>();
        self.places.iter().flat_map(of).collect()
    }

    /// The ring of the same signature with these unknowns, for a machine with other numbers.
    pub(crate) fn with(&self, machine: &Machine, unknowns: &[f64]) -> Self {
        let shape = StateShape::of(machine);
        let mut ring = self.clone();
        for (place, own) in ring.places.iter_mut().zip(unknowns.chunks_exact(shape.size() + 1)) {
            // the rates of surfaces are numbers of the machine
            for (surface, stop) in place.surfaces.iter_mut().zip(machine.stops()) {
                if let Some(surface) = surface {
                    *surface = standing_back(&stop.law, 0.0).unwrap_or(*surface);
                }
            }
            *place = shape.with_values(place, &own[1..]);
            place.phase = own[0];
        }
        ring
    }

    /// The state after event `k` with a phase in $`[0, 2\pi)`$; without forcing the phase is 0.
    pub(crate) fn place(&self, k: usize) -> Place {
        let place = &self.places[k % self.len()];
        Place { phase: if self.unforced() { 0.0 } else { phase::wrap(place.phase) }, ..place.clone() }
    }

    /// The time from event `k` to the next.
    pub(crate) fn time(&self, k: usize, machine: &Machine) -> f64 {
        (self.theta(k + 1) - self.theta(k)) / self.frequency(machine)
    }

    /// Whether a contact rests or holds from event `k` to the next one and not before and after. Such a flight may end before
    /// it begins: the solution is not admissible then, but with it the one at which the rest takes no time is located as a
    /// zero like others.
    pub(super) fn rests(&self, k: usize) -> bool {
        let m = self.len();
        let (before, own) = (&self.events[(k + m - 1) % m].after, &self.events[k].after);
        let RingEvent { guard, after: next, back, .. } = &self.events[(k + 1) % m];
        let j = guard.place(back.len());
        matches!(guard, GuardKind::Reaction(_) | GuardKind::LimitForward(_) | GuardKind::LimitBackward(_))
            && own[j].constrains()
            && !before[j].constrains()
            && !next[j].constrains()
    }

    /// With a contact of this stop that ends at event `k` by position instead of by force, or the other way round, where its force and
    /// its depth are zero at once.
    pub(crate) fn ending_otherwise(mut self, frame: &MachineFrame<'_>, k: usize, stop: usize) -> Option<Self> {
        let guard = &mut self.events[k].guard;
        *guard = match *guard {
            GuardKind::Force(_) => GuardKind::Depth(stop),
            _ => GuardKind::Force(stop),
        };
        self.set_surface(frame, stop)?;
        Some(self)
    }

    /// The compliant stop that closes at event `k` and opens at the next one.
    pub(crate) fn contact(&self, k: usize) -> Option<usize> {
        match (self.events[k].guard, self.events[(k + 1) % self.len()].guard) {
            (GuardKind::Gap(stop), GuardKind::Depth(same) | GuardKind::Force(same)) if stop == same => Some(stop),
            _ => None,
        }
    }

    /// Whether the contact after event `k` begins and ends at the depth zero.
    pub(super) fn is_between_zeros(&self, k: usize) -> bool {
        let m = self.len();
        let ends = matches!(self.events[(k + 1) % m].guard, GuardKind::Depth(_));
        self.contact(k).is_some_and(|stop| ends && !self.events[(k + m - 1) % m].back[stop])
    }

    /// Whether a contact of a compliant stop ends at event `k` by its force, or by an impact elsewhere: its surface stands back then.
    fn ends_by_force(&self, k: usize, stop: usize) -> bool {
        let (before, event) = (&self.events[(k + self.len() - 1) % self.len()], &self.events[k]);
        before.after[stop] == ContactState::Closed
            && event.after[stop] != ContactState::Closed
            && !event.has(GuardKind::Depth(stop))
    }

    /// Lets the surface of a damped stop stand back from each opening by force until it closes next, if the surface has not come
    /// back to its holder by then.
    pub(crate) fn set_surface(&mut self, frame: &MachineFrame<'_>, stop: usize) -> Option<()> {
        if !frame.shape.surfaces.contains(&stop) {
            return Some(());
        }
        for (event, place) in self.events.iter_mut().zip(&mut self.places) {
            event.back[stop] = false;
            place.surfaces[stop] = None;
        }
        let m = self.len();
        for k in (0..m).filter(|k| self.ends_by_force(*k, stop)).collect::<Vec<_>>() {
            let place = self.place(k);
            let depth = (-frame.gap(&place, stop).0).max(LEAST);
            // the surface is taken along through the events after it, until its stop closes again
            let surface = standing_back(&frame.machine.stops()[stop].law, depth)?;
            let later = |time: f64| Recovery { size: surface.size * decay(surface.rate * time).0, ..surface };
            let mut stands = vec![(k, surface)];
            let mut time = self.time(k, frame.machine);
            for i in (1..m).map(|i| (k + i) % m).take_while(|i| !self.events[*i].has(GuardKind::Gap(stop))) {
                stands.push((i, later(time)));
                time += self.time(i, frame.machine);
            }
            // it stands back as long as its size is above the offset; otherwise it has come back before the stop closes
            if surface.offset == 0.0 || later(time).size > surface.offset {
                for (i, surface) in stands {
                    self.events[i].back[stop] = true;
                    self.places[i].surfaces[stop] = Some(surface);
                }
            }
        }
        Some(())
    }

    /// Writes the derivatives of all residuals into the first columns of a matrix of rows of this length. After one period
    /// the changes of the first event are multiplied by `turn`: 1 for cycles. Without forcing these end at a given phase;
    /// other changes are those of neighbours, whose phases differ at the end too.
    pub(crate) fn fill(&self, rows: &mut [f64], length: usize, blocks: &[MachineBlock], turn: f64) {
        let m = self.len();
        for (k, block) in blocks.iter().enumerate() {
            let width = block.late.len();
            let closes = k + 1 == m;
            let ends = closes && self.unforced() && (turn - 1.0).abs() < f64::EPSILON;
            let turn = if closes { turn } else { 1.0 };
            let (own, next) = (k * width, ((k + 1) % m) * width);
            for i in 0..width {
                let row = &mut rows[(k * width + i) * length..(k * width + i + 1) * length];
                for (j, value) in block.left.row(i).iter().enumerate() {
                    row[own + j] += value;
                }
                if !ends {
                    row[next] += turn * block.late[i];
                }
                // the first residual is the guard's, which does not see the state after the event
                if i > 0 {
                    row[next + i] -= turn;
                }
            }
        }
    }

    /// The derivative of the state after the first event over one period, for differences across cycles; `None` where it is
    /// infinite.
    pub(crate) fn monodromy(&self, frame: &MachineFrame<'_>, blocks: &[MachineBlock]) -> Option<Matrix> {
        let mut product: Option<Matrix> = None;
        for block in blocks {
            let step = block.step.clone()?;
            product = Some(match product {
                None => step,
                // the later flight acts on the derivative of all before it
                Some(so_far) => step.times(&so_far),
            });
        }
        product.map(|product| frame.across_cycles(product, &self.place(0)))
    }

    /// The rounding error of the monodromy matrix, in units of the largest coordinates and velocities at the events and in the middles
    /// of the flights: at its events a machine with friction alone has no velocity but for rounding.
    pub(crate) fn rounding(&self, frame: &MachineFrame<'_>, monodromy: &Matrix) -> f64 {
        let between = (0..self.len()).filter_map(|k| self.middle_of(frame, k));
        let sizes = (0..self.len()).map(|k| self.place(k)).chain(between).map(|place| frame.sizes(&place));
        let largest = |(x, v): (f64, f64), (size, speed): (f64, f64)| (x.max(size), v.max(speed));
        frame.rounding(monodromy, self.len(), sizes.fold((0.0, 0.0), largest))
    }

    /// Whether the second half of the events repeats the first, to within 3e-4 of the sizes of the motion.
    pub(crate) fn is_twice(&self, frame: &MachineFrame<'_>, sizes: (f64, f64)) -> bool {
        self.repeats(frame, 2, sizes)
    }

    /// Whether the events repeat those of the first of so many equal parts, to within 3e-4 of the sizes of the motion.
    fn repeats(&self, frame: &MachineFrame<'_>, parts: u32, sizes: (f64, f64)) -> bool {
        let (count, periods) = (parts as usize, self.periods);
        let part = self.len() / count;
        self.len().is_multiple_of(count)
            && periods.is_multiple_of(parts)
            && (0..self.len() - part).all(|k| {
                let (one, mut two) = (self.place(k), self.place(k + part));
                // each part must take the same share of the period, and be the same in events and states
                let ahead = self.theta(k + part) - self.theta(k) - self.angle() / f64::from(parts);
                two.phase = one.phase;
                self.events[k] == self.events[k + part]
                    && ahead.abs() < ALIKE
                    && frame.distance(&one, &two, sizes) < ALIKE
            })
    }

    /// The cycle over its smallest period, if it repeats itself after a part of its period.
    pub(crate) fn shortest(mut self, frame: &MachineFrame<'_>, sizes: (f64, f64)) -> Self {
        let most = u32::try_from(self.len()).unwrap_or(1);
        // the largest number of parts that repeat leaves the smallest period
        if let Some(parts) = (2..=most).rev().find(|parts| self.repeats(frame, *parts, sizes)) {
            self.keep_one_of(parts);
        }
        self
    }

    /// The first half of the events as a cycle.
    pub(crate) fn half(mut self) -> Self {
        self.keep_one_of(2);
        self
    }

    /// Keeps the first of so many equal parts as a cycle.
    fn keep_one_of(&mut self, parts: u32) {
        let part = self.len() / parts as usize;
        let end = self.theta(part);
        self.events.truncate(part);
        self.places.truncate(part);
        self.periods /= parts;
        // it was the number of an event of the longer cycle
        self.together = None;
        self.end_at(end);
    }

    /// Without forcing: counts the phases so that the cycle, which ends at this phase, ends at 0.
    pub(super) fn end_at(&mut self, phase: f64) {
        if self.unforced() {
            self.places.iter_mut().for_each(|place| place.phase -= phase);
        }
    }

    /// The same cycle with event `k` as the first one.
    pub(crate) fn beginning_at(mut self, k: usize) -> Self {
        let (angle, end) = (self.angle(), self.theta(k) + self.angle());
        self.places[..k].iter_mut().for_each(|place| place.phase += angle);
        self.events.rotate_left(k);
        self.places.rotate_left(k);
        self.together = self.together.map(|event| (event + self.len() - k) % self.len());
        self.end_at(end);
        self
    }

    /// A state between two events: the middle of the longest flight, with the event before it.
    pub(crate) fn middle(&self, frame: &MachineFrame<'_>) -> Option<(usize, Place)> {
        // in the middle of the longest flight a state is as far from events as it can be
        let time = |k: usize| self.time(k, frame.machine);
        let longest = (0..self.len()).max_by(|a, b| time(*a).total_cmp(&time(*b)))?;
        Some((longest, self.middle_of(frame, longest)?))
    }

    /// The state in the middle of the flight after event `k`.
    fn middle_of(&self, frame: &MachineFrame<'_>, k: usize) -> Option<Place> {
        let mut from = self.place(k);
        frame.constrain(&mut from)?;
        let structure: Arc<Structure> = frame.structure(&from.states)?;
        Some(frame.moved(&from, &structure, 0.5 * self.time(k, frame.machine)))
    }
}

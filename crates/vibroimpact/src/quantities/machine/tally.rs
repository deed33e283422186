//! Sums and extremes along a motion of a machine: its flights, its impacts, its summed chatters. An oscillator has its own, in closed form
//! and side by side in lanes.

use super::super::sums::Sum;
use super::sums::{Extremes, PartSums};
use crate::arc::{MachineFlight, Modes};
use crate::events::{Event, Passage, Place, contact_forces};
use crate::math::{Gauss, POINTS, add_scaled, change_along, dot};
use crate::orbit::MachineFrame;
use crate::regime::{ContactState, POLYNOMIALS, Signal, Structure, compliant, rates};
use crate::system::decay;
use std::sync::Arc;

/// The largest number of panels of a motion. Beyond, integrals and extremes are not known.
const PANELS: usize = 200_000;

/// Sums and extremes along a motion.
#[derive(Clone, Debug)]
pub(super) struct Tally<'a> {
    frame: &'a MachineFrame<'a>,
    pub(super) sums: PartSums,
    pub(super) extremes: Extremes,
    /// The number of panels that are left.
    left: usize,
    /// Whether a flight was left out of the integrals and extremes.
    pub(super) skipped: bool,
    gauss: Gauss,
    /// The velocity of each wall.
    walls: Vec<Signal>,
    contacts: Vec<Contact>,
    point: Point,
    /// The values at the points of a panel: of positions, velocities and accelerations, and of forces.
    values: Vec<[f64; POINTS]>,
    /// The same at both ends of it.
    ends: Vec<[f64; 2]>,
}

/// The impulse of a compliant stop since it closed.
#[derive(Clone, Copy, Debug, Default)]
struct Contact {
    /// `None` while it is open.
    now: Option<f64>,
    /// That of a contact that had begun before the motion.
    before: Option<f64>,
    /// Whether it has been open.
    opened: bool,
}

/// The state at one time of a flight.
#[derive(Clone, Debug, Default)]
struct Point {
    modes: Modes,
    own: Vec<f64>,
    x: Vec<f64>,
    v: Vec<f64>,
    a: Vec<f64>,
    q: Vec<f64>,
    drag: Vec<f64>,
    turns: Vec<(f64, f64)>,
    forces: Vec<f64>,
}

/// A flight in one regime.
struct Leg<'b> {
    states: &'b [ContactState],
    flight: &'b MachineFlight,
    /// The stops of the chatter that is summed over it.
    chatter: &'b [usize],
}

impl<'a> Tally<'a> {
    pub(super) fn new(frame: &'a MachineFrame<'a>) -> Self {
        let (machine, normal) = (frame.machine, &frame.normal);
        let contacts = machine.stops().len() + machine.joints().len();
        Self {
            frame,
            sums: PartSums::new(machine),
            extremes: Extremes::new(machine),
            left: PANELS,
            skipped: false,
            gauss: Gauss::new(),
            walls: normal.walls.iter().map(|wall| wall.derivative(&normal.rates)).collect(),
            contacts: vec![Contact::default(); machine.stops().len()],
            point: Point::default(),
            values: vec![[0.0; POINTS]; 3 * machine.n() + contacts],
            ends: vec![[0.0; 2]; 3 * machine.n() + contacts],
        }
    }

    /// Whether a free translation moves a coordinate.
    pub(super) fn moves_freely(&self, coordinate: usize) -> bool {
        self.frame.normal.translations.moves(coordinate)
    }

    /// The sums since this was last called.
    pub(super) fn take(&mut self) -> PartSums {
        core::mem::replace(&mut self.sums, PartSums::new(self.frame.machine))
    }

    /// Adds a flight from a state over a time. A chatter on the stops `chatter` is summed over it: then the reaction at rest
    /// there is that of its impacts.
    pub(super) fn flight(&mut self, from: &Place, structure: &Arc<Structure>, duration: f64, chatter: &[usize]) {
        if duration <= 0.0 {
            return;
        }
        self.sums.time += duration;
        self.stand_still(from, duration, chatter);
        // once a flight is left out the integrals are not known, and no panels are spent on others
        let all = if self.skipped { None } else { POLYNOMIALS.of(&rates(structure), duration, self.left) };
        let Some(all) = all else {
            self.skipped = true;
            return;
        };
        self.left -= all.len();
        let flight = from.flight(&self.frame.normal, structure.clone());
        let leg = Leg { states: &from.states, flight: &flight, chatter };
        // the first panel begins where the one before it would have ended
        self.go(&leg, 0.0);
        self.told(|(_, ends), value| ends[1] = value);
        for panel in all {
            self.panel(&leg, panel);
        }
        self.constant_work(from);
        self.extremes.symmetric();
    }

    /// Adds the work of the constant forces along the free translations over a flight from `from` to the point where it is.
    /// Along all other directions a motion returns, and they do none.
    fn constant_work(&mut self, from: &Place) {
        let normal = &self.frame.normal;
        if normal.translations.is_empty() {
            return;
        }
        let moved: Vec<f64> = self.point.x.iter().zip(&from.x).map(|(to, from)| to - from).collect();
        let part = normal.translations.part(&moved);
        self.sums.structure[Sum::Work] +=
            normal.force.iter().zip(part).map(|(force, moved)| force.constant * moved).sum::<f64>();
    }

    /// What a flight adds that needs no integral: times in contact, and the energy that surfaces lose which stand back. At
    /// the depth $`s = ae^{-\kappa t} - b`$ the spring of a stop holds $`\tfrac k2 s^2 + ps`$, which is $`\tfrac k2 a^2
    /// e^{-2\kappa t}`$ and a constant, and its own damper takes what it loses.
    fn stand_still(&mut self, from: &Place, duration: f64, chatter: &[usize]) {
        let (machine, stops) = (self.frame.machine, self.sums.stops.len());
        for (j, sums) in self.sums.stops.iter_mut().enumerate() {
            match from.states[j] {
                ContactState::Closed => sums[Sum::Closed] += duration,
                ContactState::Resting if !chatter.contains(&j) => sums[Sum::Resting] += duration,
                _ => {}
            }
            if let (Some(surface), Some((k, ..))) = (from.surfaces[j], compliant(&machine.stops()[j].law)) {
                // 1 - e^{-2 kappa t} as a product, in which no digits cancel
                let (kept, lost) = decay(surface.rate * duration);
                sums[Sum::ContactLoss] += 0.5 * k * surface.size * surface.size * lost * (1.0 + kept);
            }
            let contact = &mut self.contacts[j];
            let closed = compliant(&machine.stops()[j].law).is_some()
                && matches!(from.states[j], ContactState::Closed | ContactState::Resting);
            match (contact.now, closed) {
                (None, true) => contact.now = Some(0.0),
                // a contact that began before the motion is not complete: `close` joins it to the one at the end
                (Some(impulse), false) => {
                    if contact.opened {
                        self.extremes.impulses[j] = self.extremes.impulses[j].max(impulse);
                    } else {
                        contact.before = Some(impulse);
                    }
                    contact.now = None;
                }
                _ => {}
            }
            contact.opened |= !closed;
        }
        for (j, sums) in self.sums.joints.iter_mut().enumerate() {
            if from.states[stops + j] == ContactState::Holding {
                sums[Sum::Holding] += duration;
            }
        }
    }

    /// Adds the integrals over a panel, and widens the ranges.
    fn panel(&mut self, leg: &Leg<'_>, (begin, length): (f64, f64)) {
        let (middle, half) = (begin + 0.5 * length, 0.5 * length);
        for k in 0..POINTS {
            let (place, weight) = self.gauss.points[k];
            self.go(leg, middle + half * place);
            self.add(leg, half * weight);
            self.told(|(values, _), value| values[k] = value);
        }
        // after the loop over the points: the values stand point by point for each coordinate
        for (sums, all) in self.sums.coordinates.iter_mut().zip(self.values.chunks_exact(3)) {
            for (k, (_, weight)) in self.gauss.points.iter().enumerate() {
                let (q, qdot) = (all[0][k], all[1][k]);
                sums[Sum::X] += half * weight * q;
                sums[Sum::XSquared] += half * weight * q * q;
                sums[Sum::V] += half * weight * qdot;
                sums[Sum::VSquared] += half * weight * qdot * qdot;
            }
        }
        self.go(leg, begin + length);
        self.told(|(_, ends), value| *ends = [ends[1], value]);
        let n = self.sums.coordinates.len();
        let ranges = self.extremes.coordinates.iter_mut().flatten();
        for ((values, ends), range) in self.values[..3 * n].iter().zip(&self.ends).zip(ranges) {
            self.gauss.widen(values, *ends, range);
        }
        for (at, range) in self.extremes.forces.iter_mut().enumerate() {
            let acts = matches!(leg.states[at], ContactState::Closed | ContactState::Resting | ContactState::Holding);
            if acts && !leg.chatter.contains(&at) {
                self.gauss.widen(&self.values[3 * n + at], self.ends[3 * n + at], range);
            // a force that does not act or is friction that slides is constant over the panel
            } else if !acts {
                range.1 = range.1.max(self.point.forces[at].abs());
            }
        }
    }

    /// Goes to a time of a flight.
    fn go(&mut self, leg: &Leg<'_>, s: f64) {
        let Point { modes, own, x, v, a, turns, forces, .. } = &mut self.point;
        leg.flight.at(s, modes);
        leg.flight.state(modes, x, v);
        leg.flight.accelerations(modes, own, a);
        leg.flight.turns_at(modes, turns);
        contact_forces(self.frame.machine, leg.states, (leg.flight, modes), forces);
    }

    /// Adds the integrands with this weight.
    fn add(&mut self, leg: &Leg<'_>, weight: f64) {
        let (machine, normal) = (self.frame.machine, &self.frame.normal);
        let Point { v, drag, turns, forces, .. } = &mut self.point;
        normal.damping.apply_into(v, drag);
        self.sums.structure[Sum::Damping] += weight * dot(v, drag);
        for (order, sums) in &mut self.sums.forces {
            let Some(h) = normal.orders.iter().position(|own| *own == f64::from(*order)) else { continue };
            let (sin, cos) = turns[h];
            let power = normal.force.iter().zip(v.iter()).map(|(force, v)| {
                let (a, b) = force.harmonics[h];
                (a * cos + b * sin) * v
            });
            sums[Sum::Work] += weight * power.sum::<f64>();
        }
        let stops = machine.stops().len();
        for (j, sums) in self.sums.stops.iter_mut().enumerate() {
            let force = weight * forces[j];
            let moves = self.walls[j].swing(turns);
            match leg.states[j] {
                ContactState::Closed => {
                    sums[Sum::Impulse] += force;
                    if let Some((_, c, _)) = compliant(&machine.stops()[j].law) {
                        // the rate at which the gap opens, with which the damper works
                        let rate = moves - dot(&normal.directions[j], v);
                        sums[Sum::ContactLoss] += weight * c * rate * rate;
                    }
                }
                ContactState::Resting if leg.chatter.contains(&j) => sums[Sum::Impulse] += force,
                ContactState::Resting => sums[Sum::RestImpulse] += force,
                _ => continue,
            }
            // a wall whose position falls pushes
            sums[Sum::Work] -= force * moves;
            if let Some(impulse) = &mut self.contacts[j].now {
                *impulse += force;
            }
        }
        for (j, sums) in self.sums.joints.iter_mut().enumerate() {
            let (joint, force) = (&machine.joints()[j], forces[stops + j]);
            sums[Sum::Impulse] += weight * force;
            // the belt moves against the force of the joint on it
            sums[Sum::Work] -= weight * force * joint.belt;
            if leg.states[stops + j] != ContactState::Holding {
                sums[Sum::FrictionLoss] += weight * force * (dot(&normal.directions[stops + j], v) - joint.belt);
            }
        }
    }

    /// Tells everything of which ranges are searched for, at the point where the flight is, with its place in a panel:
    /// position, velocity and acceleration of each coordinate, and the forces.
    fn told(&mut self, mut keep: impl FnMut((&mut [f64; POINTS], &mut [f64; 2]), f64)) {
        let normal = &self.frame.normal;
        let Point { q, x, v, a, forces, .. } = &mut self.point;
        let n = x.len();
        for (d, of) in [&*x, v, a].into_iter().enumerate() {
            normal.to_machine_into(of, q);
            let places = self.values.iter_mut().zip(&mut self.ends).skip(d).step_by(3);
            places.zip(q.iter()).for_each(|(place, value)| keep(place, *value));
        }
        let places = self.values.iter_mut().zip(&mut self.ends).skip(3 * n);
        places.zip(forces.iter()).for_each(|(place, value)| keep(place, *value));
    }

    /// Adds what happens at the end of a step: closings, and the impulses of impacts.
    pub(super) fn event(&mut self, passage: &Passage, events: &[Event]) {
        for event in events.iter().filter(|event| event.closes()) {
            let sums = &mut self.sums.stops[event.place];
            sums[Sum::Impacts] += 1.0;
            sums[Sum::Speeds] += event.speed;
            let most = &mut self.extremes.speeds[event.place];
            *most = most.max(event.speed);
        }
        let Some(before) = &passage.before else { return };
        let turns = before.turns(&self.frame.normal);
        for blow in &passage.blows {
            let sums = &mut self.sums.stops[blow.stop];
            // at once, so it is not part of the integral of the force
            sums[Sum::Impulse] += blow.impulse;
            sums[Sum::ImpactLoss] += blow.loss;
            sums[Sum::Work] -= blow.impulse * self.walls[blow.stop].swing(&turns);
            let most = &mut self.extremes.impulses[blow.stop];
            *most = most.max(blow.impulse);
        }
    }

    /// Adds what follows the event at the end of a step if a chatter is summed: the jump to rest, and the motion at rest on
    /// its stops for its time, or for the part of it up to `most`.
    pub(super) fn chatter(&mut self, passage: &Passage, most: f64) {
        let (Some((rest, duration)), Some(after)) = (&passage.rest, &passage.after) else {
            return;
        };
        let stops: Vec<usize> = passage.pushed.iter().map(|(j, _)| *j).collect();
        let duration = duration.min(most);
        self.jump(passage, rest, after, &stops);
        self.flight(after, rest, duration, &stops);
        // between its impacts the machine moves as it does when the stops are open
        self.accelerate(after, &stops);
        self.accelerate(&self.frame.moved(after, rest, duration), &stops);
    }

    /// Includes the accelerations at a state with these stops open.
    fn accelerate(&mut self, at: &Place, stops: &[usize]) {
        let mut free = at.clone();
        stops.iter().for_each(|j| free.states[*j] = ContactState::Open);
        let Some(structure) = self.frame.structure(&free.states) else { return };
        let flight = free.flight(&self.frame.normal, structure);
        let Point { modes, own, a, .. } = &mut self.point;
        flight.at(0.0, modes);
        flight.accelerations(modes, own, a);
        for (range, a) in self.extremes.coordinates.iter_mut().zip(self.frame.normal.to_machine(a)) {
            range[2] = (range[2].0.min(a), range[2].1.max(a));
        }
    }

    /// A chatter on stops that is summed: from the velocities after the impact to those at rest, at once. The impulses
    /// along the stops and along what holds beside them do this. They are those of all impacts less the integral of the
    /// reaction at rest over the time of the chatter, which the flight over this time adds: to leading order the mass is
    /// above the stop for as long as the rebounds take, and what is left out is smaller by $`10^{-10}`$.
    fn jump(&mut self, passage: &Passage, rest: &Structure, after: &Place, chatter: &[usize]) {
        let (machine, normal) = (self.frame.machine, &self.frame.normal);
        let (stops, turns) = (machine.stops().len(), after.turns(normal));
        let mut before = passage.before.as_ref().map_or_else(|| after.v.clone(), |before| before.v.clone());
        // less the impulses, which push against the directions: the velocities after the impact
        for blow in &passage.blows {
            add_scaled(&mut before, -blow.impulse, &normal.directions[blow.stop]);
        }
        for (range, v) in self.extremes.coordinates.iter_mut().zip(normal.to_machine(&before)) {
            range[1] = (range[1].0.min(v), range[1].1.max(v));
        }
        let change: Vec<f64> = after.v.iter().zip(&before).map(|(after, before)| after - before).collect();
        // the impulses along what holds at rest that make this change
        let impulses: Vec<(usize, f64)> = if chatter.iter().all(|stop| rest.held.contains(stop)) {
            rest.held.iter().zip(&rest.across).map(|(held, across)| (*held, -dot(across, &change))).collect()
        } else {
            // and along stops that have opened at the end
            let beside = chatter.iter().filter(|stop| !rest.held.contains(stop));
            let all: Vec<usize> = rest.held.iter().chain(beside).copied().collect();
            // the smallest impulses that make this change, in each coordinate
            let rows: Vec<Vec<f64>> =
                (0..normal.n).map(|i| all.iter().map(|at| normal.directions[*at][i]).collect()).collect();
            let rows: Vec<(&[f64], f64)> = rows.iter().map(Vec::as_slice).zip(change.iter().copied()).collect();
            let mut least = vec![0.0; all.len()];
            change_along(&rows, &mut least);
            all.into_iter().zip(least.into_iter().map(|along| -along)).collect()
        };
        for (held, impulse) in impulses {
            if held >= stops {
                let joint = &mut self.sums.joints[held - stops];
                joint[Sum::Impulse] += impulse;
                joint[Sum::Work] -= impulse * machine.joints()[held - stops].belt;
                continue;
            }
            let sums = &mut self.sums.stops[held];
            let moves = self.walls[held].swing(&turns);
            sums[Sum::Work] -= impulse * moves;
            if chatter.contains(&held) {
                // infinitely many, in a finite time
                sums[Sum::Impacts] = f64::INFINITY;
                sums[Sum::Impulse] += impulse;
                // as in `event`: the gap moves with the rebound before and not at all after, so the mean is half of it
                let rebound = moves - dot(&normal.directions[held], &before);
                sums[Sum::ImpactLoss] -= 0.5 * rebound * impulse;
            } else {
                sums[Sum::RestImpulse] += impulse;
            }
        }
    }

    /// Ends a motion: a contact that has not ended belongs to that with which a closed motion began.
    pub(super) fn close(&mut self) {
        for (contact, most) in self.contacts.iter().zip(&mut self.extremes.impulses) {
            match (contact.now, contact.before) {
                (Some(now), before) if contact.opened => *most = most.max(now + before.unwrap_or(0.0)),
                (None, Some(before)) => *most = most.max(before),
                // it never opens
                (Some(_), _) => *most = f64::NAN,
                (None, None) => {}
            }
        }
    }
}

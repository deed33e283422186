//! The derivative of a flight and of the event at its end by a number of the machine, at a fixed state at the beginning.
//!
//! Let $`e(t)`$ be the derivative of the acceleration by the number, at the state of the flight. Then the state after the time T
//! changes by
//!
//! $$`\delta z(T) = \int_0^T \Phi(T - t)\,\begin{pmatrix}0\\ e(t)\end{pmatrix}dt,`$$
//!
//! with the transition $`\Phi`$ of the regime. The panels of the integral resolve every mode, so it is right to rounding. Where
//! stops rest and joints hold, a number that moves them carries the structure along: $`W^Tx = c(t)`$, so
//! $`\delta x = WG^{-1}(\delta c - \delta W^Tx) + N\eta`$, and the integral gives the part in the free directions N.
//!
//! Phases are fixed at both ends of a flight. So a change of the frequency changes its duration, and shifts the forcing within
//! it by $`t\,\delta\omega`$.

use super::place::Place;
use super::saltation::{EventLaw, StateShape};
use crate::arc::{MachineFlight, Modes};
use crate::machine::{Machine, MachineParts, StopLaw};
use crate::math::{Lu, RULE, add_scaled, dot};
use crate::regime::{
    ContactState, GuardKind, ModalChange, Normal, NormalRate, Signal, Structure, compliant, panels, rates,
};
use std::sync::Arc;

/// The largest number of panels of half a flight.
const MOST_PANELS: usize = 100_000;

/// A number of a machine, to first order.
pub(crate) struct ByNumber<'a> {
    machine: &'a Machine,
    normal: &'a Normal,
    /// The derivatives of all numbers of the machine.
    parts: &'a MachineParts,
    rate: NormalRate,
}

/// A state between events with what acts there.
struct Instant<'a> {
    x: &'a [f64],
    v: &'a [f64],
    acceleration: &'a [f64],
    /// Sine and cosine of the harmonics, and the change of the phase.
    turns: &'a [(f64, f64)],
    shift: f64,
    /// The gaps of closed stops.
    gaps: &'a [(usize, f64)],
    /// The time since the beginning, and the coordinates there.
    time: f64,
    begin: &'a [f64],
}

/// Stiffness, damping and preload of a compliant stop.
type Law = (f64, f64, f64);

/// A change of the state: of coordinates, velocities, and surfaces that stand back.
#[derive(Clone, Debug, Default)]
pub(crate) struct StateChange {
    pub(crate) x: Vec<f64>,
    pub(crate) v: Vec<f64>,
    pub(crate) surfaces: Vec<f64>,
}

impl StateChange {
    fn zero(n: usize) -> Self {
        Self { x: vec![0.0; n], v: vec![0.0; n], surfaces: Vec::new() }
    }
}

impl<'a> ByNumber<'a> {
    /// `parts` has the derivatives of the numbers of the machine.
    pub(crate) fn new(machine: &'a Machine, normal: &'a Normal, parts: &'a MachineParts) -> Self {
        Self { machine, normal, parts, rate: NormalRate::new(normal, parts) }
    }

    /// The change of the duration of a flight between fixed phases.
    pub(crate) fn duration(&self, time: f64) -> f64 {
        match (self.machine.parts().frequency, self.parts.frequency) {
            (Some(frequency), Some(change)) => -time * change / frequency,
            _ => 0.0,
        }
    }

    /// The change of a signal, differentiated by time so many times.
    fn signal(&self, (own, change): (&Signal, &Signal), times: usize, (turns, shift): (&[(f64, f64)], f64)) -> f64 {
        let (mut own, mut change) = (own.clone(), change.clone());
        for _ in 0..times {
            change = change.derivative(&self.normal.rates);
            change.add(1.0, &own.derivative(&self.rate.rates));
            own = own.derivative(&self.normal.rates);
        }
        change.constant + change.swing(turns) + shift * own.derivative(&self.normal.orders).swing(turns)
    }

    fn wall(&self, stop: usize, times: usize, at: (&[(f64, f64)], f64)) -> f64 {
        self.signal((&self.normal.walls[stop], &self.rate.walls[stop]), times, at)
    }

    /// The gap of a stop and its rate.
    fn gap(&self, stop: usize, at: &Instant<'_>) -> (f64, f64) {
        let (w, wall) = (&self.normal.directions[stop], &self.normal.walls[stop]);
        let known = at.gaps.iter().find(|(of, _)| *of == stop);
        let gap = known.map_or_else(|| wall.constant + wall.swing(at.turns) - dot(w, at.x), |(_, gap)| *gap);
        (gap, wall.derivative(&self.normal.rates).swing(at.turns) - dot(w, at.v))
    }

    /// The change of both, where the state changes.
    fn gap_change(&self, stop: usize, at: &Instant<'_>, (x, v): (&[f64], &[f64])) -> (f64, f64) {
        let (w, change) = (&self.normal.directions[stop], &self.rate.directions[stop]);
        let wall = |times| self.wall(stop, times, (at.turns, at.shift));
        (wall(0) - dot(change, at.x) - dot(w, x), wall(1) - dot(change, at.v) - dot(w, v))
    }

    /// The numbers of a compliant stop, and their changes.
    fn law(&self, stop: usize) -> Option<(Law, Law)> {
        Some((compliant(&self.machine.stops()[stop].law)?, compliant(&self.parts.stops[stop].law)?))
    }

    /// The force with which a closed stop pulls along its direction, and its change.
    fn pull(&self, stop: usize, at: &Instant<'_>, change: (&[f64], &[f64])) -> Option<(f64, f64)> {
        let ((k, c, p), (dk, dc, dp)) = self.law(stop)?;
        let ((gap, rate), (by_gap, by_rate)) = (self.gap(stop, at), self.gap_change(stop, at, change));
        Some((k * gap + c * rate - p, dk * gap + k * by_gap + dc * rate + c * by_rate - dp))
    }

    /// The joints that slide: place, force along the direction, and its change.
    fn sliding<'b>(&'b self, structure: &'b Structure) -> impl Iterator<Item = (usize, f64, f64)> + 'b {
        let stops = self.machine.stops().len();
        let joints = self.machine.joints().iter().zip(&self.parts.joints).enumerate();
        joints.filter_map(move |(j, (joint, change))| match structure.states()[stops + j] {
            ContactState::Forward => Some((stops + j, -joint.sliding, -change.sliding)),
            ContactState::Backward => Some((stops + j, joint.sliding, change.sliding)),
            _ => None,
        })
    }

    /// The reactions of the constraints.
    fn reactions(&self, structure: &Structure, at: &Instant<'_>) -> Vec<f64> {
        // what is missing from the applied force to the acceleration
        let (by_x, by_v) = (self.normal.stiffness.apply(at.x), self.normal.damping.apply(at.v));
        let applied = self.normal.force.iter().map(|force| force.constant + force.swing(at.turns));
        let mut missing: Vec<f64> = applied.collect();
        for i in 0..self.normal.n {
            missing[i] -= by_x[i] + by_v[i] + at.acceleration[i];
        }
        let still = vec![0.0; self.normal.n];
        for closed in &structure.closed {
            let pull = self.pull(closed.place, at, (&still, &still)).map_or(0.0, |(pull, _)| pull);
            add_scaled(&mut missing, pull, &self.normal.directions[closed.place]);
        }
        for (place, force, _) in self.sliding(structure) {
            add_scaled(&mut missing, force, &self.normal.directions[place]);
        }
        structure.across.iter().map(|across| dot(across, &missing)).collect()
    }

    /// The change of the force on the structure where its state changes, with these reactions.
    fn force(
        &self,
        structure: &Structure,
        at: &Instant<'_>,
        reactions: &[f64],
        (x, v): (&[f64], &[f64]),
    ) -> Option<Vec<f64>> {
        let turned = (at.turns, at.shift);
        let applied = self.normal.force.iter().zip(&self.rate.force);
        let mut force: Vec<f64> = applied.map(|(own, change)| self.signal((own, change), 0, turned)).collect();
        let by_state = [
            self.rate.stiffness.apply(at.x),
            self.rate.damping.apply(at.v),
            self.normal.stiffness.apply(x),
            self.normal.damping.apply(v),
        ];
        by_state.iter().for_each(|term| add_scaled(&mut force, -1.0, term));
        for closed in &structure.closed {
            let (pull, change) = self.pull(closed.place, at, (x, v))?;
            add_scaled(&mut force, pull, &self.rate.directions[closed.place]);
            add_scaled(&mut force, change, &self.normal.directions[closed.place]);
        }
        for (place, own, change) in self.sliding(structure) {
            add_scaled(&mut force, own, &self.rate.directions[place]);
            add_scaled(&mut force, change, &self.normal.directions[place]);
        }
        for (place, reaction) in structure.held.iter().zip(reactions) {
            add_scaled(&mut force, -reaction, &self.rate.directions[*place]);
        }
        Some(force)
    }

    /// The change of the state that the constraints carry along.
    fn carried(&self, structure: &Structure, at: &Instant<'_>) -> StateChange {
        let stops = self.machine.stops().len();
        let still = vec![0.0; self.normal.n];
        let mut carried = StateChange::zero(self.normal.n);
        for (place, across) in structure.held.iter().zip(&structure.across) {
            let (way, rate) = if *place < stops {
                self.gap_change(*place, at, (&still, &still))
            } else {
                let (change, belt) = (&self.rate.directions[*place], self.parts.joints[*place - stops].belt);
                (belt * at.time + dot(change, at.begin) - dot(change, at.x), belt - dot(change, at.v))
            };
            add_scaled(&mut carried.x, way, across);
            add_scaled(&mut carried.v, rate, across);
        }
        carried
    }

    /// The change of the state `before` at the end of a flight from `from` over a time.
    pub(crate) fn flown(
        &self,
        shape: &StateShape,
        structure: &Arc<Structure>,
        (from, before): (&Place, &Place),
        time: f64,
    ) -> Option<StateChange> {
        let n = self.normal.n;
        let flight = from.flight(self.normal, structure.clone());
        let pace = self.parts.frequency.unwrap_or(0.0);
        let modes = structure.modes.len();
        let zeros = || vec![0.0; modes];
        let mut sum =
            ModalChange { y: zeros(), v: zeros(), push: zeros(), set: vec![0.0; self.machine.joints().len()] };
        let mut seen = Seen::default();
        let still = vec![0.0; n];
        let halves = panels(&rates(structure), 0.5 * time.abs(), MOST_PANELS)?;
        // decays are steep at the beginning, and those of the transition at the end
        let mirrored = halves.iter().map(|(begin, length)| (time.abs() - begin - length, *length));
        let all = if modes == 0 { Vec::new() } else { halves.iter().copied().chain(mirrored).collect() };
        for (begin, length) in all {
            for (point, weight) in RULE.iter().flat_map(|(point, weight)| [(*point, *weight), (-point, *weight)]) {
                let t = (begin + 0.5 * length * (1.0 + point)) * time.signum();
                let at = seen.at(&flight, t, pace * t, &from.x);
                let reactions = self.reactions(structure, &at);
                let carried = self.carried(structure, &at);
                let force = self.force(structure, &at, &reactions, (&carried.x, &carried.v))?;
                let mut change = structure.modal_change(self.normal, &still, &force);
                structure.carry(&mut change, &structure.free_modes(time - t), time - t);
                let weight = 0.5 * length * weight * time.signum();
                add_scaled(&mut sum.y, weight, &change.y);
                add_scaled(&mut sum.v, weight, &change.v);
            }
        }
        let mut end = self.carried(structure, &seen.at(&flight, time, pace * time, &from.x));
        for i in 0..n {
            end.x[i] += structure.changed(&structure.x[i], &sum);
            end.v[i] += structure.changed(&structure.v[i], &sum);
        }
        let later = self.duration(time);
        if later != 0.0 {
            let flow = shape.flow(structure, self.normal, before);
            add_scaled(&mut end.x, later, &flow[..n]);
            add_scaled(&mut end.v, later, &flow[n..2 * n]);
        }
        end.surfaces = (0..before.surfaces.len())
            .map(|j| match (before.surfaces[j], self.law(j)) {
                (Some(surface), Some(((_, c, _), (dk, dc, _)))) => {
                    let rate = (dk - surface.rate * dc) / c;
                    -(rate * time + surface.rate * later) * surface.size
                }
                _ => 0.0,
            })
            .collect();
        Some(end)
    }

    /// Adds the change of what is left of the difference of two states when translations are removed, less the translation in
    /// the state `to`. The directions of translations turn with the masses: with the projection Q onto them,
    /// $`Q' = (1 - Q)\Phi^TQ + Q\Phi(1 - Q)`$.
    pub(crate) fn turned(&self, apart: &[f64], to: &[f64], slopes: &mut [f64]) {
        let Some(turning) = &self.rate.turning else { return };
        let free = &self.normal.translations;
        // of the state itself the part along translations is missed, and of the difference the other one
        let sum: Vec<f64> = apart.iter().zip(to).map(|(apart, to)| apart + to).collect();
        let along = free.part(&sum);
        let across: Vec<f64> = sum.iter().zip(&along).map(|(all, along)| all - along).collect();
        let mut turned = turning.apply_transposed(&along);
        free.remove(&mut turned);
        add_scaled(&mut turned, 1.0, &free.part(&turning.apply(&across)));
        add_scaled(&mut slopes[..turned.len()], -1.0, &turned);
    }

    /// The change of the first guard of an event, where the state before it changes.
    pub(crate) fn guard(&self, law: &EventLaw<'_>, before: &Place, change: &StateChange) -> Option<f64> {
        let (structure, stops) = (law.structure, self.machine.stops().len());
        let mut seen = Seen::default();
        let flight = before.flight(self.normal, structure.clone());
        let at = seen.at(&flight, 0.0, 0.0, &before.x);
        let moved = (&change.x[..], &change.v[..]);
        // the reaction of a constraint, and of the limits of joints that share its load
        let reaction = |place: usize| {
            let held = structure.held.iter().position(|held| *held == place)?;
            let reactions = self.reactions(structure, &at);
            let force = self.force(structure, &at, &reactions, moved)?;
            let across = &structure.across[held];
            let mut sum = dot(across, &force);
            for (other, own) in structure.held.iter().zip(&structure.across) {
                let mut wanted = dot(&self.rate.directions[*other], at.acceleration);
                if *other < stops {
                    wanted -= self.wall(*other, 2, (at.turns, at.shift));
                }
                sum += dot(across, own) * wanted;
            }
            let shared = structure.sharing.iter().filter(|sharing| sharing.held == held).map(|sharing| {
                let (one, other) = (&self.normal.directions[place], &self.normal.directions[sharing.place]);
                (dot(one, other) / dot(one, one)).abs() * self.parts.joints[sharing.place - stops].limit
            });
            Some((sum, shared.sum::<f64>()))
        };
        let guard = structure.guards.get(*law.guards.first()?)?;
        Some(match guard.kind {
            GuardKind::Gap(j) => {
                let surface = before.surfaces[j].map_or(0.0, |_| change.surfaces[j] - self.offset(j));
                self.gap_change(j, &at, moved).0 + surface
            }
            GuardKind::Depth(j) => -self.gap_change(j, &at, moved).0,
            GuardKind::Force(j) => -self.pull(j, &at, moved)?.1,
            GuardKind::Reaction(j) => reaction(j).map(|(reaction, shared)| reaction + shared)?,
            GuardKind::Preload(j) => {
                let (reaction, shared) = reaction(j)?;
                self.law(j).map_or(0.0, |(_, (_, _, preload))| preload) + shared - reaction
            }
            GuardKind::Sliding(joint) => {
                let place = stops + joint;
                let (w, by_w) = (&self.normal.directions[place], &self.rate.directions[place]);
                let sliding = dot(by_w, at.v) + dot(w, moved.1) - self.parts.joints[joint].belt;
                if structure.states()[place] == ContactState::Forward { sliding } else { -sliding }
            }
            GuardKind::LimitForward(joint) | GuardKind::LimitBackward(joint) => {
                let (reaction, shared) = reaction(stops + joint)?;
                let sign = if matches!(guard.kind, GuardKind::LimitForward(_)) { -1.0 } else { 1.0 };
                self.parts.joints[joint].limit + shared + sign * reaction
            }
        })
    }

    /// The change of the offset p/k of the surface of a stop.
    fn offset(&self, stop: usize) -> f64 {
        self.law(stop).map_or(0.0, |((k, _, p), (dk, _, dp))| (dp - dk * p / k) / k)
    }

    /// The change of the state after an event, where that before it changes. `summed` tells of a stop whether its rebound
    /// is taken away.
    pub(crate) fn after(
        &self,
        law: &EventLaw<'_>,
        summed: &dyn Fn(usize) -> bool,
        (before, after): (&Place, &Place),
        change: StateChange,
    ) -> Option<StateChange> {
        let turns = before.turns(self.normal);
        let restitution = |j: usize| match self.parts.stops[j].law {
            StopLaw::Rigid { restitution } if !summed(j) => restitution,
            _ => 0.0,
        };
        let (mut v, mut by_v) = (before.v.clone(), change.v.clone());
        for round in law.in_rounds() {
            let by_e: Vec<f64> = round.iter().map(|(j, _)| restitution(*j)).collect();
            self.push_all((round, &by_e), &turns, (&mut v, &mut by_v))?;
        }
        let surfaces = (0..before.surfaces.len()).map(|j| match (before.surfaces[j], after.surfaces[j]) {
            // it stands back by the depth at which the stop opened
            (None, Some(_)) => {
                let (w, by_w) = (&self.normal.directions[j], &self.rate.directions[j]);
                let gap = self.wall(j, 0, (&turns, 0.0)) - dot(by_w, &before.x) - dot(w, &change.x);
                self.offset(j) - gap
            }
            (Some(_), Some(_)) => change.surfaces[j],
            (_, None) => 0.0,
        });
        let surfaces = surfaces.collect();
        Some(StateChange { x: change.x, v: by_v, surfaces })
    }

    /// One round of impacts: $`v_+ = v + W\alpha`$ with $`G\alpha = (1 + e)(r' - W^Tv)`$.
    fn push_all(
        &self,
        (round, by_e): (&[(usize, f64)], &[f64]),
        turns: &[(f64, f64)],
        (v, by_v): (&mut [f64], &mut [f64]),
    ) -> Option<()> {
        let (w, by_w) = (along(&self.normal.directions, round), along(&self.rate.directions, round));
        let lu = Lu::new(w.iter().flat_map(|a| w.iter().map(|b| dot(a, b))).collect(), round.len())?;
        let wall = |j: usize| self.normal.walls[j].derivative(&self.normal.rates).swing(turns);
        let rates: Vec<f64> = round.iter().zip(&w).map(|((j, _), w)| wall(*j) - dot(w, v)).collect();
        let mut push: Vec<f64> = round.iter().zip(&rates).map(|((_, e), rate)| (1.0 + e) * rate).collect();
        lu.solve(&mut push);
        let by_push = |i: usize| {
            let (j, e) = round[i];
            let by_rate = self.wall(j, 1, (turns, 0.0)) - dot(by_w[i], v) - dot(w[i], by_v);
            let by_gram = |l: usize| (dot(by_w[i], w[l]) + dot(w[i], by_w[l])) * push[l];
            by_e[i] * rates[i] + (1.0 + e) * by_rate - (0..w.len()).map(by_gram).sum::<f64>()
        };
        let mut change: Vec<f64> = (0..w.len()).map(by_push).collect();
        lu.solve(&mut change);
        for i in 0..w.len() {
            add_scaled(by_v, push[i], by_w[i]);
            add_scaled(by_v, change[i], w[i]);
            add_scaled(v, push[i], w[i]);
        }
        Some(())
    }
}

/// The directions of stops that push.
fn along<'b>(all: &'b [Vec<f64>], round: &[(usize, f64)]) -> Vec<&'b [f64]> {
    round.iter().map(|(j, _)| all[*j].as_slice()).collect()
}

/// Memory for the states of a flight.
#[derive(Default)]
struct Seen {
    modes: Modes,
    x: Vec<f64>,
    v: Vec<f64>,
    own: Vec<f64>,
    acceleration: Vec<f64>,
    turns: Vec<(f64, f64)>,
    gaps: Vec<(usize, f64)>,
}

impl Seen {
    /// A flight at a time, at which the phase changes by `shift`; it began at the coordinates `begin`.
    fn at<'b>(&'b mut self, flight: &MachineFlight, time: f64, shift: f64, begin: &'b [f64]) -> Instant<'b> {
        flight.at(time, &mut self.modes);
        flight.state(&self.modes, &mut self.x, &mut self.v);
        flight.accelerations(&self.modes, &mut self.own, &mut self.acceleration);
        flight.turns_at(&self.modes, &mut self.turns);
        self.gaps.clear();
        self.gaps.extend(flight.closed_gaps(&self.modes));
        let Self { x, v, acceleration, turns, gaps, .. } = self;
        Instant { x, v, acceleration, turns, shift, gaps, time, begin }
    }
}

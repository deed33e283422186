//! The derivative of an event by a number of the machine, where the state before it changes.

use super::by_number::{ByNumber, Seen, StateChange};
use super::place::Place;
use super::saltation::EventLaw;
use crate::machine::StopLaw;
use crate::math::{Lu, add_scaled, dot};
use crate::regime::{ContactState, GuardKind};

impl ByNumber<'_> {
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
        let flight = before.unguarded_flight(self.normal, structure.clone());
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
                // a constraint keeps w x'' at the acceleration of its wall, also where the number turns w or moves the
                // wall
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
        // the derivative of p/k
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
        // the rest that stands for a summed chatter has no rebound, whatever the restitution
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
        let rates: Vec<f64> =
            round.iter().zip(&w).map(|((j, _), w)| self.wall_rates[*j].swing(turns) - dot(w, v)).collect();
        let mut push: Vec<f64> = round.iter().zip(&rates).map(|((_, e), rate)| (1.0 + e) * rate).collect();
        lu.solve(&mut push);
        // G push = (1 + e) rate, differentiated: G push' = e' rate + (1 + e) rate' - G' push
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

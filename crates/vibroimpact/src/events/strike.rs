//! Impacts on rigid stops, and what they do to all contacts.

use super::advance::FAINT;
use super::collision::{Collision, collide, depends_on_order};
use super::motion::Motion;
use super::passage::Blow;
use super::place::Place;
use crate::machine::StopLaw;
use crate::math::dot;
use crate::regime::{ContactState, GuardKind, compliant, independent};

impl Motion<'_> {
    /// The impacts on the rigid stops `struck`, together with the rigid ones at rest: new velocities, the states of
    /// contacts that open or close by them, and the rest as candidates. The speeds and the [sizes](Self::rate_sizes) are those
    /// before. Returns the stops that push; `None` if the law of impact has no solution.
    pub(super) fn strike(
        &mut self,
        struck: &[usize],
        (speeds, sizes): (&[f64], &[f64]),
        candidates: &mut Vec<usize>,
    ) -> Option<Vec<usize>> {
        let stops = self.machine.stops();
        let turns = self.place.turns(&self.normal);
        // closed without velocity: at rest, or at the start not yet known to be
        let closed = candidates.clone();
        let resting = |place: &Place, j: usize| place.states[j].constrains() || closed.contains(&j);
        let restitution = |j: usize| match stops[j].law {
            StopLaw::Rigid { restitution } => Some(restitution),
            StopLaw::Compliant { .. } => None,
        };
        // place, velocity of the gap, restitution
        let at_rest = (0..stops.len()).filter(|j| resting(&self.place, *j)).map(|j| (j, 0.0));
        let set: Vec<(usize, f64, f64)> = struck
            .iter()
            .map(|j| (*j, -speeds[*j]))
            .chain(at_rest)
            .filter_map(|(j, rate)| restitution(j).map(|e| (j, rate, e)))
            .collect();
        let directions: Vec<&[f64]> = set.iter().map(|(j, ..)| self.normal.directions[*j].as_slice()).collect();
        let (rates, restitutions): (Vec<f64>, Vec<f64>) = set.iter().map(|(_, rate, e)| (*rate, *e)).unzip();
        let law = self.machine.parts().impacts;
        let outcome = collide(law, &directions, &self.place.v, &rates, &restitutions)?;
        self.tie = depends_on_order(&outcome, &directions, &self.place.v, &rates, &restitutions, struck.len());
        let Collision { v: mut after, impulses: found, losses, rounds, ends_still } = outcome;
        let still = |k: usize| ends_still && rounds.last().is_some_and(|last| last.contains(&k));
        self.place.jolt();
        let size = rates.iter().fold(0.0_f64, |most, rate| most.max(rate.abs()));
        // with the velocities of the law; in rounds a stop may be struck again and open more slowly than after its own impact
        let alone = rounds.len() == 1;
        let mut stays = Vec::new();
        for (k, ((j, before, e), (w, impulse))) in set.iter().zip(directions.iter().zip(&found)).enumerate() {
            let rate = before - (dot(w, &after) - dot(w, &self.place.v));
            candidates.retain(|candidate| candidate != j);
            // a stop that was pushed opens with the velocity of the law, exactly 0 without restitution
            let opens = if still(k) {
                false
            } else if *impulse > 0.0 && alone {
                e * before < 0.0
            } else {
                let terms = w.iter().zip(&after).map(|(w, v)| (w * v).abs()).sum::<f64>();
                rate > 16.0 * f64::EPSILON * (size + terms)
            };
            if opens {
                self.place.states[*j] = ContactState::Open;
                self.place.note(GuardKind::Gap(*j), 1);
            } else {
                stays.push((*j, rate));
                candidates.push(*j);
            }
        }
        // exactly no velocity, so that no stop opens by rounding
        self.normal.move_by(&stays, &mut after);
        if !alone {
            self.silenced |= self.instants.silence(&mut self.place.x, &mut after, rounds.len());
        }
        self.place.v = after;
        if let Some(passage) = &mut self.passage {
            let pushing = set.iter().zip(&found).zip(losses).filter(|((_, impulse), _)| **impulse > 0.0);
            let of_round = |(r, round): (usize, &Vec<usize>)| {
                let without = ends_still && r + 1 == rounds.len();
                let push = |k: &usize| (set[*k].0, if without { 0.0 } else { set[*k].2 });
                round.iter().map(push).collect::<Vec<_>>()
            };
            passage.pushed = rounds.iter().enumerate().flat_map(of_round).collect();
            passage.ends_still = ends_still;
            passage.rounds = if alone { Vec::new() } else { rounds.iter().map(Vec::len).collect() };
            passage.blows = pushing
                .map(|(((j, rate, e), impulse), loss)| {
                    let speed = (-rate).max(0.0);
                    // each gap opens with the restitution times the speed of its closing, but for impacts in turn
                    let loss = if alone && !ends_still { 0.5 * (1.0 - e) * speed * impulse } else { loss };
                    Blow { stop: *j, speed, impulse: *impulse, loss }
                })
                .collect();
        }
        // an impulse takes a compliant stop at rest off its surface, or into it
        for j in (0..stops.len()).filter(|j| compliant(&stops[*j].law).is_some()) {
            if !resting(&self.place, j) {
                continue;
            }
            let (_, rate, _, size) = self.place.gap(&self.normal, &turns, j);
            candidates.retain(|candidate| *candidate != j);
            if rate.abs() <= 64.0 * f64::EPSILON * size.max(sizes[j]) {
                candidates.push(j);
            } else if rate > 0.0 {
                self.place.states[j] = ContactState::Open;
                self.place.note(GuardKind::Gap(j), 1);
            } else {
                self.place.states[j] = ContactState::Closed;
                self.place.note(GuardKind::Depth(j), 1);
            }
        }
        // and changes the velocities of the joints
        for joint in 0..self.machine.joints().len() {
            let at = stops.len() + joint;
            candidates.retain(|candidate| *candidate != at);
            match self.place.slides(self.machine, &self.normal, joint, (FAINT, sizes[at])) {
                Some(direction) => self.place.states[at] = direction,
                None => candidates.push(at),
            }
        }
        Some(set.iter().zip(&found).filter(|(_, impulse)| **impulse > 0.0).map(|((j, ..), _)| *j).collect())
    }

    /// The size to which the rounding error of the rate of each gap is relative, and of the velocity of each joint, which are counted
    /// after the stops. That of the velocities before an impact holds after it too: an impact that takes a velocity away leaves the
    /// rounding error of it.
    pub(super) fn rate_sizes(&self) -> Vec<f64> {
        let turns = self.place.turns(&self.normal);
        let stops = (0..self.machine.stops().len()).map(|j| self.place.gap(&self.normal, &turns, j).3);
        stops
            .chain((0..self.machine.joints().len()).map(|k| self.place.sliding(self.machine, &self.normal, k).1))
            .collect()
    }

    /// The stops among `struck` that have an impact of their own: of stops at one place, only the one that pushes.
    pub(super) fn distinct(&self, struck: &[usize], pushed: &[usize]) -> Vec<usize> {
        let (push, other): (Vec<usize>, Vec<usize>) = struck.iter().partition(|j| pushed.contains(j));
        let mut own = push;
        for j in other {
            let w = &self.normal.directions[j];
            let at_one_place = |i: &usize| {
                let pair = [self.normal.directions[*i].as_slice(), w.as_slice()];
                independent(pair.into_iter()).len() == 1 && dot(pair[0], pair[1]) > 0.0
            };
            if !own.iter().any(at_one_place) {
                own.push(j);
            }
        }
        own.sort_unstable();
        own
    }

    /// Closes the compliant stops that the structure has reached. After impacts at the same time it may move away from them,
    /// or back to those that have just opened; `sizes` are then those of the rates before the impacts.
    pub(super) fn meet(
        &mut self,
        reached: &[usize],
        before: &[ContactState],
        sizes: Option<&[f64]>,
        turns: &[(f64, f64)],
        candidates: &mut Vec<usize>,
    ) {
        let Some(sizes) = sizes else {
            for j in reached {
                self.place.close(*j);
            }
            return;
        };
        for (j, was) in before.iter().enumerate().take(self.machine.stops().len()) {
            let opened = *was == ContactState::Closed && self.place.states[j] == ContactState::Open;
            if !(opened || reached.contains(&j)) {
                continue;
            }
            let (_, mut rate, _, size) = self.place.gap(&self.normal, turns, j);
            let size = size.max(sizes[j]);
            // the surface moves too, towards its holder
            if let Some(surface) = self.place.surfaces[j] {
                rate -= surface.rate * surface.size;
            }
            if rate < -64.0 * f64::EPSILON * size {
                self.place.close(j);
            } else if rate > 64.0 * f64::EPSILON * size || self.place.surfaces[j].is_some() {
                self.place.note(GuardKind::Gap(j), 1);
            } else {
                candidates.push(j);
            }
        }
    }
}

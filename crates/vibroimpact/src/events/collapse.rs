//! The end of impacts that accumulate, as rounds of several stops or of stops and joints, or without any order.
//!
//! The time of rounds that repeat themselves is a geometric sum. Without such a round it is that of `free_gaps`.
//!
//! The velocities of the gaps that are left when a sum is taken are taken away as by impacts without rebound, those of the
//! joints that change within the round with them: they go to zero with the round. What rests, holds or slides then is
//! resolved as at any instant, with the forces at rest: over a round that is short the impulses act as their mean force,
//! so a joint that slips at each impact and holds in between holds at the end if the force at rest is within its limit.

use super::advance::FAINT;
use super::event::{End, EventKind};
use super::instants::Round;
use super::motion::Motion;
use super::place::Place;
use super::resolve::{Resolution, Resolved};
use crate::machine::StopLaw;
use crate::math::{change_along, dot};
use crate::regime::{ContactState, GuardKind, Orthonormal};

/// A sum is taken when its error is no more than so many rounding errors of the time.
const ROUNDINGS: f64 = 32.0;
/// A sum whose impacts are at one time without a joint is left to the closed form as long as this can be taken: while the
/// fastest mode turns by more than this angle; of free bodies while impacts are faster than this part of the largest one.
pub(super) const SOON: f64 = 1e-7;
const SLOW: f64 = 1e-8;
/// A gap below so many rounding errors of the motion is closed; where impacts have no order, below so many, long before rounding
/// errors of the gaps could change what happens.
const CLOSED: f64 = 512.0;
const CROWDED: f64 = 65_536.0;
/// A sum with joints is taken when a body beside it goes no more than so many rounding errors of the motion in the time that is left.
const STILL: f64 = 4096.0;
/// Other forces can slow a joint too, so its friction alone need not bring it to rest, but for this part.
const BY_FRICTION: f64 = 4.0;
/// Stops on which a structure cannot come to rest at once keep rates above this part of their terms.
const KEPT_APART: f64 = 1e-6;
/// What goes by no more than so many rounding errors of a gap in many impacts does not move.
const IN_PLACE: f64 = 64.0;
/// After so many events at one time gaps are closed, whatever they are.
const MANY: u32 = 256;

impl Motion<'_> {
    /// Sums the impacts of which the last one has just happened, if they accumulate and the sum is exact to rounding.
    pub(super) fn accumulate(&mut self) {
        if let Some(round) = self.instants.round()
            && self.is_exact(&round)
            && let places = self.that_stop(&round)
            && self.come_to_rest(&places, round.in_turn, round.left).is_some()
        {
            return;
        }
        if let Some(mut stops) = self.instants.crowd() {
            stops.retain(|j| self.place.states[*j] == ContactState::Open);
            let left = if self.crowd > MANY { Some(0.0) } else { self.collapse_time(&stops) };
            if let Some(left) = left.filter(|_| self.crowd > MANY || self.are_close(&stops, CROWDED)) {
                self.come_to_rest(&stops, true, left);
                return;
            }
        }
        self.rest_within_rounding();
    }

    /// Brings stops to rest that are struck again and again while nothing moves by more than rounding errors of the coordinates.
    /// Below them rebounds are made of rounding errors, and need not become slower.
    fn rest_within_rounding(&mut self) {
        let Some((mut stops, way)) = self.instants.crowd_in_place() else { return };
        stops.retain(|j| self.place.states[*j] == ContactState::Open);
        let loses =
            |j: &usize| matches!(self.machine.stops()[*j].law, StopLaw::Rigid { restitution } if restitution < 1.0);
        if stops.iter().all(loses) && self.are_close(&stops, CLOSED) && self.is_rounding(&stops, way) {
            self.come_to_rest(&stops, true, 0.0);
        }
    }

    /// Whether a way is a rounding error of the gaps of these stops.
    fn is_rounding(&self, stops: &[usize], way: f64) -> bool {
        let turns = self.place.turns(&self.normal);
        stops.iter().all(|j| way <= IN_PLACE * f64::EPSILON * self.place.gap(&self.normal, &turns, *j).2)
    }

    /// Whether the error of a sum is a rounding error: of the flights, of the place of a stop at the speed of the impacts, and of
    /// these speeds.
    fn is_exact(&mut self, round: &Round) -> bool {
        let stops = self.machine.stops().len();
        let turns = self.place.turns(&self.normal);
        let (mut size, mut rate_size) = (0.0_f64, 0.0_f64);
        for j in round.places.iter().filter(|at| **at < stops) {
            let (_, _, of_gap, of_rate) = self.place.gap(&self.normal, &turns, *j);
            let of_gap = if round.exact { 0.0 } else { of_gap };
            (size, rate_size) = (size.max(of_gap), rate_size.max(of_rate));
        }
        // how long a rounding error of a gap is, at the speed of the round
        let rounding = self.time_scale() + (size + round.left * rate_size) / round.speed;
        if round.error > ROUNDINGS * f64::EPSILON * rounding {
            return false;
        }
        let struck: Vec<usize> = round.places.iter().copied().filter(|at| *at < stops).collect();
        if !self.are_close(&struck, CLOSED) {
            return false;
        }
        // how far a body beside the round can go in the time that is left
        if struck.len() < round.places.len() && round.left * round.speed > STILL * f64::EPSILON * self.way(&struck) {
            return false;
        }
        if round.in_turn || struck.len() < round.places.len() {
            return true;
        }
        let free = self.structures.get(self.machine, &self.normal, &self.place.states);
        free.is_some_and(|free| {
            let fastest = free.fastest();
            if fastest > 0.0 { round.left * fastest < SOON } else { round.speed < SLOW * self.largest_impact }
        })
    }

    /// The time to which rounding errors of times are relative: the longest flight of late, or that in which the fastest mode turns
    /// by a radian.
    fn time_scale(&mut self) -> f64 {
        let free = self.structures.get(self.machine, &self.normal, &self.place.states);
        let fastest = free.map_or(0.0, |free| free.fastest());
        self.instants.longest().max(if fastest > 0.0 { 1.0 / fastest } else { 0.0 })
    }

    /// The size of these gaps and of the motion.
    fn way(&mut self, stops: &[usize]) -> f64 {
        let turns = self.place.turns(&self.normal);
        let way = self.time_scale() * self.largest_impact;
        stops.iter().map(|j| self.place.gap(&self.normal, &turns, *j).2).fold(way, f64::max)
    }

    /// Whether these gaps are so small that closing them moves nothing.
    fn are_close(&mut self, stops: &[usize], roundings: f64) -> bool {
        let turns = self.place.turns(&self.normal);
        let way = self.time_scale() * self.largest_impact;
        stops.iter().all(|j| {
            let (gap, _, size, _) = self.place.gap(&self.normal, &turns, *j);
            gap.abs() <= roundings * f64::EPSILON * size.max(way)
        })
    }

    /// A gap without the rounding errors of the coordinates: of a stop that has just been struck, which is exactly closed, or one that
    /// has been kept.
    pub(super) fn exact_gap(&self, j: usize) -> Option<f64> {
        let struck = self.place.known.iter().any(|(kind, _)| *kind == GuardKind::Gap(j));
        if struck { Some(0.0) } else { self.place.sharp_gap(j) }
    }

    /// Brings the structure to rest on these stops, and these joints to rest, after a time; `None` if it stays on none of the
    /// stops, or leaves one before that time, or if something else happens before.
    pub(super) fn come_to_rest(&mut self, places: &[usize], in_turn: bool, left: f64) -> Option<()> {
        let mut places = places.to_vec();
        let there = loop {
            let there = self.at_rest(&places)?;
            let pressed = self.pressed(&there, &places);
            if pressed.is_empty() {
                break there;
            }
            places.extend(pressed);
        };
        let stops: Vec<usize> = places.iter().copied().filter(|at| *at < self.machine.stops().len()).collect();
        let turns = there.turns(&self.normal);
        let moves = |j: &usize| {
            let (_, rate, _, size) = there.gap(&self.normal, &turns, *j);
            rate.abs() > KEPT_APART * size
        };
        if stops.iter().any(moves) {
            // stops that move towards each other leave no room between them
            self.end = Some(End::Inconsistent);
            return Some(());
        }
        let opened: Vec<usize> = stops.iter().copied().filter(|j| there.states[*j] == ContactState::Open).collect();
        // the forces at rest open a stop at the end of the sum: not before
        if opened.len() == stops.len() || !opened.is_empty() && left > f64::EPSILON * self.time_scale() {
            return None;
        }
        let structure = self.structures.get(self.machine, &self.normal, &there.states)?;
        let flight = there.flight(&self.normal, structure);
        let kind = if in_turn && stops.len() > 1 { EventKind::Collapse } else { EventKind::Stick };
        self.rest_after(there, &flight, left, (kind, &stops))?;
        opened.into_iter().for_each(|j| self.announce(EventKind::Release, j, 0.0, Vec::new()));
        Some(())
    }

    /// The stops of a round, and those of its joints that their friction brings to rest in the time that is left. A joint that only turns
    /// back with the body at its one side slides on with the other: at one instant friction has no impulse.
    fn that_stop(&mut self, round: &Round) -> Vec<usize> {
        let stops = self.machine.stops().len();
        let mut places = round.places.clone();
        let struck: Vec<usize> = places.iter().copied().filter(|at| *at < stops).collect();
        if struck.len() == places.len() {
            return places;
        }
        let Some(there) = self.at_rest(&struck) else { return places };
        let slow = |at: usize| {
            let (speed, size) = there.sliding(self.machine, &self.normal, at - stops);
            let w = &self.normal.directions[at];
            let slows = self.machine.joints()[at - stops].sliding * dot(w, w) * round.left;
            speed.abs() <= BY_FRICTION * slows + FAINT * size
        };
        places.retain(|at| *at < stops || slow(*at));
        places
    }

    /// Stops that are open and closed exactly, and would be closed further without the velocities that are taken away: a body beside a
    /// sum that is slowed down by each of its impacts is struck in each round too, or once more at the end.
    fn pressed(&mut self, there: &Place, places: &[usize]) -> Vec<usize> {
        let turns = there.turns(&self.normal);
        let closes = |j: &usize| {
            let (_, rate, _, size) = there.gap(&self.normal, &turns, *j);
            there.states[*j] == ContactState::Open
                && matches!(self.machine.stops()[*j].law, StopLaw::Rigid { .. })
                && !places.contains(j)
                && rate < -FAINT * size
        };
        let closing: Vec<usize> = (0..self.machine.stops().len()).filter(closes).collect();
        closing.into_iter().filter(|j| self.exact_gap(*j) == Some(0.0) || self.are_close(&[*j], CLOSED)).collect()
    }

    /// The state without the velocities of the gaps of these stops and of these joints, and with what rests and holds then. Stops
    /// that the forces open are open.
    pub(super) fn at_rest(&mut self, places: &[usize]) -> Option<Place> {
        let stops = self.machine.stops().len();
        let mut there = self.place.clone();
        let turns = there.turns(&self.normal);
        let mut candidates: Vec<usize> = (0..there.states.len()).filter(|at| there.states[*at].constrains()).collect();
        let own = |there: &Place, at: usize| match at.checked_sub(stops) {
            None => there.gap_and_rate(&self.normal, &turns, at),
            Some(joint) => (0.0, -there.sliding(self.machine, &self.normal, joint).0),
        };
        // along each direction only what leaves the velocities along those that are kept
        let directions = &self.normal.directions;
        let kept = candidates.iter().filter(|at| !places.contains(at));
        let kept = Orthonormal::spanning(kept.map(|at| &directions[*at]));
        let free = places.iter().filter_map(|at| Some((*at, kept.beside(&directions[*at])?)));
        let free: Vec<(usize, Vec<f64>)> = free.collect();
        // twice, so that directions that nearly depend on each other are followed to rounding as well
        for _ in 0..2 {
            let amounts: Vec<(f64, f64)> = free.iter().map(|(at, _)| own(&there, *at)).collect();
            let along = |amount: fn(&(f64, f64)) -> f64| -> Vec<(&[f64], f64)> {
                free.iter().zip(&amounts).map(|((_, w), amounts)| (&w[..], amount(amounts))).collect()
            };
            change_along(&along(|of| of.0), &mut there.x);
            change_along(&along(|of| of.1), &mut there.v);
        }
        let silenced = self.instants.silence(&mut there.x, &mut there.v, 1);
        there.known.retain(|(kind, _)| !places.contains(&kind.place(stops)));
        // without these velocities a joint can slide in the other direction
        for joint in 0..self.machine.joints().len() {
            let at = stops + joint;
            if there.states[at].constrains() || places.contains(&at) {
                continue;
            }
            let size = self.place.sliding(self.machine, &self.normal, joint).1;
            match there.slides(self.machine, &self.normal, joint, (FAINT, size)) {
                Some(direction) => there.states[at] = direction,
                None => candidates.push(at),
            }
        }
        // they were those before the coordinates have moved
        there.gaps.retain(|of| there.states[of.stop] == ContactState::Closed);
        candidates.extend(places);
        candidates.sort_unstable();
        candidates.dedup();
        let (machine, normal, structures) = (self.machine, &self.normal, &mut self.structures);
        let Resolved { states, known } =
            Resolution { machine, normal, structures, place: &there, candidates: &candidates, ended: &[] }.resolve()?;
        there.states = states;
        for (kind, count) in known {
            there.note(kind, count);
        }
        if silenced {
            there.close_rests(machine, normal);
        }
        Some(there)
    }
}

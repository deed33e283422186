//! The end of a chatter on a rigid stop, or on several that are struck at the same times.

use super::event::EventKind;
use super::motion::Motion;
use super::place::Place;
use crate::arc::{Found, MachineFlight, first_event};
use crate::machine::StopLaw;
use crate::math::{add_scaled, dot};
use crate::regime::{ContactState, GuardKind, Normal, Orthonormal, Structure, independent};

/// A chatter is summed if its first correction is below this part of the sum.
const SMALL: f64 = 1e-6;
/// Stops are struck at the same times if their sums, and the factors by which their impacts become slower, differ by no more
/// than this part of them.
const EQUAL: f64 = 1e-7;

/// How the gap of a stop closes again after a rebound: its speed, the acceleration, the rate by which this increases at rest,
/// and that of the damping along the stop.
#[derive(Clone, Copy, Debug)]
struct Return {
    rebound: f64,
    a: f64,
    jerk: f64,
    drag: f64,
}

impl Return {
    /// The time of all rebounds, by the first two terms of its sum, if they are exact to rounding. `fastest` is the rate of the
    /// free motion: the terms that are left out are of its square.
    fn time(&self, restitution: f64, fastest: f64) -> Option<f64> {
        let Self { rebound, a, jerk, drag } = *self;
        if a <= 0.0 {
            return None;
        }
        let k = rebound / a;
        let r = 1.0 - restitution;
        // each rebound takes 2w/a, and its speed is the restitution times that before: a geometric sum
        let first = 2.0 * k / r;
        let second = -2.0 * (jerk / a * k + 0.5 * drag * k) / (3.0 * r);
        let small = second.abs() <= SMALL && first * fastest.max(drag) <= 10.0 * SMALL;
        small.then_some(first * (1.0 + second))
    }
}

impl Motion<'_> {
    /// Sums the chatter on rigid stops that have just been struck with these speeds and are open, if it is soon over; or else
    /// other impacts that accumulate.
    pub(super) fn end_chatter(&mut self, struck: &[(usize, f64)], turns: &[(f64, f64)]) {
        let restitution = match struck {
            [] => None,
            [(j, _)] => self.restitution(*j),
            _ => self.common_restitution(struck, turns),
        };
        let stops: Vec<usize> = struck.iter().map(|(j, _)| *j).collect();
        let summed = restitution.is_some_and(|restitution| self.complete(&stops, restitution, turns).is_some());
        if !summed && self.instants.are_close() {
            self.accumulate();
        }
    }

    fn restitution(&self, j: usize) -> Option<f64> {
        match self.machine.stops()[j].law {
            StopLaw::Rigid { restitution } => Some(restitution),
            StopLaw::Compliant { .. } => None,
        }
    }

    /// The factor by which the impacts on these stops become slower, if it is the same for all. It is not the restitution of
    /// each where several stops are at one place.
    fn common_restitution(&self, struck: &[(usize, f64)], turns: &[(f64, f64)]) -> Option<f64> {
        let factor = |(j, speed): &(usize, f64)| self.place.gap_and_rate(&self.normal, turns, *j).1 / speed;
        let first = factor(struck.first()?);
        struck.iter().all(|own| (factor(own) - first).abs() <= EQUAL * first).then_some(first)
    }

    /// Sums a chatter on these stops, if its impacts accumulate so soon that the first two terms of the sum are exact to
    /// rounding (A. B. Nordmark and P. T. Piiroinen, doi:10.1007/s11071-008-9463-y).
    fn complete(&mut self, stops: &[usize], restitution: f64, turns: &[(f64, f64)]) -> Option<()> {
        let rebounds: Vec<f64> = stops.iter().map(|j| self.place.gap_and_rate(&self.normal, turns, *j).1).collect();
        if restitution >= 1.0 || rebounds.iter().any(|rebound| *rebound <= 0.0) {
            return None;
        }
        let free = self.structures.get(self.machine, &self.normal, &self.place.states)?;
        // the sum over bounces of free bodies under constant forces is exact at any speed: small is what is small beside
        // the bounces before
        if free.fastest() == 0.0
            && rebounds[0] > SMALL * self.largest_impact
            && !self.instants.is_low(rebounds[0], self.normal.squares[stops[0]])
        {
            return None;
        }
        let (there, flight, returns) = match stops {
            [j] => self.alone_at_rest(*j, (rebounds[0], restitution), free.fastest(), turns)?,
            _ => self.together_at_rest(stops, &rebounds)?,
        };
        let times: Option<Vec<f64>> = returns.iter().map(|own| own.time(restitution, free.fastest())).collect();
        let times = times?;
        let duration = times[0];
        if times.iter().any(|time| (time - duration).abs() > EQUAL * duration) {
            return None;
        }
        let mut touches = Vec::new();
        // the rebound ends on these stops again, so all later ones, which are smaller, do
        let bounce = self.place.flight(&self.normal, free.clone());
        let next = first_event(&bounce, duration, self.limits.steps, &mut self.buffers, &mut touches);
        let own = |g: &usize| matches!(free.guards[*g].kind, GuardKind::Gap(j) if stops.contains(&j));
        let ends = matches!(&next, Found::Zero { guards, .. } if guards.iter().all(own));
        // the time of a rebound whose height is a rounding error of the gap is one too
        let Return { rebound, a, .. } = returns[0];
        let height = 0.5 * rebound * rebound / a;
        let flat = height < f64::EPSILON * self.place.gap(&self.normal, turns, stops[0]).2;
        match next {
            _ if ends => {}
            Found::NoneBefore(_) if flat => {}
            Found::Zero { guards, .. } if flat => return self.rest_with_joints(stops, &guards, (&free, duration)),
            _ => return None,
        }
        self.rest_after(there, &flight, duration, (EventKind::Stick, stops))
    }

    /// Brings the structure to rest on stops on which its rebound is lower than rounding, and joints whose events end the
    /// rebound with it.
    fn rest_with_joints(
        &mut self,
        stops: &[usize],
        guards: &[usize],
        (free, duration): (&Structure, f64),
    ) -> Option<()> {
        let joint = |g: &usize| match free.guards[*g].kind {
            GuardKind::Sliding(joint) => Some(self.machine.stops().len() + joint),
            _ => None,
        };
        let joints: Option<Vec<usize>> = guards.iter().map(joint).collect();
        let places = [stops, &joints?].concat();
        let left = self.instants.round().map_or(duration, |round| round.left);
        self.come_to_rest(&places, false, left)
    }

    /// The state at rest on one stop that is struck alone, the flight there, and how the gap closes. `None` if the chatter is
    /// far from its end.
    fn alone_at_rest(
        &mut self,
        j: usize,
        (rebound, restitution): (f64, f64),
        fastest: f64,
        turns: &[(f64, f64)],
    ) -> Option<(Place, MachineFlight, Vec<Return>)> {
        self.place.states[j] = ContactState::Resting;
        let resting = self.structures.get(self.machine, &self.normal, &self.place.states);
        self.place.states[j] = ContactState::Open;
        let structure = resting?;
        let held = structure.held.iter().position(|place| *place == j)?;
        if self.is_far_from_rest(&structure, held, (rebound, restitution), fastest, turns) {
            return None;
        }
        // the state at rest: the velocity of the gap taken away, the other constraints unchanged
        let mut there = self.place.clone();
        add_scaled(&mut there.v, rebound, &structure.across[held]);
        there.states[j] = ContactState::Resting;
        there.known.retain(|(kind, _)| *kind != GuardKind::Gap(j));
        let (mobility, drag) = structure.mobility[held];
        let flight = there.flight(&self.normal, structure.clone());
        let (force, force_rate) = flight.first(&structure.reactions[held]);
        Some((there, flight, vec![Return { rebound, a: force * mobility, jerk: force_rate * mobility, drag }]))
    }

    /// The state at rest on several stops that are struck at the same times, the flight there, and how each gap closes: all
    /// together, along the direction in which the reactions at rest push.
    fn together_at_rest(&mut self, stops: &[usize], rebounds: &[f64]) -> Option<(Place, MachineFlight, Vec<Return>)> {
        let there = self.at_rest(stops)?;
        if stops.iter().any(|j| there.states[*j] == ContactState::Open) {
            return None;
        }
        let structure = self.structures.get(self.machine, &self.normal, &there.states)?;
        let flight = there.flight(&self.normal, structure.clone());
        // what stays held while these stops are open moves none of their gaps
        let directions = &self.normal.directions;
        let kept = structure.held.iter().filter(|at| !stops.contains(at));
        let kept = Orthonormal::spanning(kept.map(|at| &directions[*at]));
        let (mut push, mut push_rate) = (vec![0.0; self.normal.n], vec![0.0; self.normal.n]);
        for (at, reaction) in structure.held.iter().zip(&structure.reactions).filter(|(at, _)| stops.contains(at)) {
            let along = kept.beside(&directions[*at])?;
            let (force, rate) = flight.first(reaction);
            add_scaled(&mut push, force, &along);
            add_scaled(&mut push_rate, rate, &along);
        }
        let damped = structure.damped(&self.normal, &push);
        let of = |(j, rebound): (&usize, &f64)| {
            let along = kept.beside(&directions[*j])?;
            let a = dot(&along, &push);
            Some(Return { rebound: *rebound, a, jerk: dot(&along, &push_rate), drag: dot(&along, &damped) / a })
        };
        let returns = stops.iter().zip(rebounds).map(of).collect::<Option<_>>()?;
        Some((there, flight, returns))
    }

    /// Brings the structure to rest on stops: to the state `there`, and from it along its flight for the time that the
    /// impacts take that were summed. `None` if an event ends this flight before.
    pub(super) fn rest_after(
        &mut self,
        there: Place,
        flight: &MachineFlight,
        duration: f64,
        (kind, stops): (EventKind, &[usize]),
    ) -> Option<()> {
        let mut touches = Vec::new();
        let found = first_event(flight, duration, self.limits.steps, &mut self.buffers, &mut touches);
        if !matches!(found, Found::NoneBefore(_)) {
            return None;
        }
        let before = core::mem::replace(&mut self.place, there).states;
        // the state at rest is that after impacts without rebound; of stops at one place only the first one pushes
        let directions = stops.iter().map(|stop| self.normal.directions[*stop].as_slice());
        let pushed: Vec<(usize, f64)> = independent(directions).into_iter().map(|k| (stops[k], 0.0)).collect();
        self.record(&pushed);
        if let Some(passage) = &mut self.passage {
            passage.rest = Some((flight.structure.clone(), duration));
        }
        self.move_to(flight, duration);
        self.largest_impact = 0.0;
        if flight.structure.is_still() {
            self.instants.clear();
        } else {
            // other bodies go on, and may end this rest again and again
            self.instants.pass(duration);
        }
        stops.iter().for_each(|j| self.instants.keep(EventKind::Stick, *j, 0.0));
        self.struck.clear();
        if kind == EventKind::Collapse {
            self.announce(kind, stops[0], 0.0, stops[1..].to_vec());
        } else {
            stops.iter().for_each(|j| self.announce(kind, *j, 0.0, Vec::new()));
        }
        self.announce_others(&before, stops);
        Some(())
    }

    /// Announces what other contacts do when the structure comes to rest on these stops.
    fn announce_others(&mut self, before: &[ContactState], stops: &[usize]) {
        for (at, was) in before.iter().enumerate().filter(|(at, _)| !stops.contains(at)) {
            let now = self.place.states[at];
            let (kind, speed) = match now {
                _ if now == *was => continue,
                ContactState::Resting | ContactState::Touching if was.constrains() => continue,
                ContactState::Resting | ContactState::Touching => (EventKind::Stick, 0.0),
                ContactState::Holding => (EventKind::Hold, 0.0),
                ContactState::Forward => (EventKind::Slip, 1.0),
                ContactState::Backward => (EventKind::Slip, -1.0),
                ContactState::Closed => (EventKind::Close, 0.0),
                ContactState::Open if *was == ContactState::Closed => (EventKind::Open, 0.0),
                ContactState::Open => (EventKind::Release, 0.0),
            };
            self.instants.keep(kind, at, speed);
            self.announce(kind, at, speed, Vec::new());
        }
    }

    /// Whether a chatter is far from its end, by the reaction at rest here: a first test without a flight.
    fn is_far_from_rest(
        &mut self,
        structure: &Structure,
        held: usize,
        (rebound, restitution): (f64, f64),
        fastest: f64,
        turns: &[(f64, f64)],
    ) -> bool {
        if !self.machine.joints().is_empty() {
            return false;
        }
        let v = &mut self.scratch.v;
        v.clone_from(&self.place.v);
        add_scaled(v, rebound, &structure.across[held]);
        let (mobility, drag) = structure.mobility[held];
        let a = mobility * structure.reaction_at(held, &self.place.x, v, turns);
        let first = 2.0 * rebound / (a * (1.0 - restitution));
        a <= 0.0 || first * fastest.max(drag) > 11.0 * SMALL
    }
}

/// Whether a chatter on a stop that is struck alone, while all others are open, is far from its end: a test without the
/// structure at rest. `fastest` is the rate of the structure.
pub(super) fn is_far_from_an_end(
    place: &Place,
    normal: &Normal,
    (j, restitution, rebound): (usize, f64, f64),
    fastest: f64,
    turns: &[(f64, f64)],
) -> bool {
    let approach = &normal.approaches[j];
    // the velocity of the gap taken away changes the acceleration by its drag
    let a = approach.at(&place.x, &place.v, turns) - approach.drag * rebound;
    let first = 2.0 * rebound / (a * (1.0 - restitution));
    a <= 0.0 || first * fastest.max(approach.drag) > 11.0 * SMALL
}

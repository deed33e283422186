//! Chatters among the events of a cycle.
//!
//! A complete chatter has infinitely many impacts. A ring has the first of them; at the next one, the rest begins, and those that
//! would follow it are left out. How many are followed is no property of the motion: as many as matter.
//!
//! What is left out moves the stop's gap by at most about $`v^2/2a`$ for the time $`2v/a`$, where v is the speed of a rebound
//! and a the acceleration by which the gap closes again. Only this gap is pushed, so other coordinates differ by the product of
//! both. With still more impacts the times between them would only be less exact.

use super::frame::MachineFrame;
use super::ring::{MachineRing, Push, RingEvent};
use crate::events::Place;
use crate::machine::StopLaw;
use crate::regime::{ContactState, GuardKind};

/// What is left out, in the size of the motion and the time of a radian: less than the first when a ring is made, and at most
/// the second while it is followed; another impact is left out where this is less than the third.
const TAIL: f64 = 1e-13;
const LONGEST: f64 = 1e-11;
const SHORTEST: f64 = 1e-18;

impl RingEvent {
    /// The stop of an impact on this stop, alone or with others that rebound as it does.
    pub(crate) fn struck(&self) -> Option<usize> {
        let (GuardKind::Gap(stop), [(first, rests), others @ ..]) = (self.guard, &self.pushed[..]) else { return None };
        (*first == stop && others.iter().all(|(_, other)| other == rests)).then_some(stop)
    }

    /// The stop on which a rest begins here instead of the impacts of a chatter that follow.
    pub(crate) fn rests_on(&self) -> Option<usize> {
        self.struck().filter(|_| self.pushed[0].1 == Push::Summed)
    }

    /// The stop of an impact with a rebound.
    fn rebounds_from(&self) -> Option<usize> {
        self.struck().filter(|_| self.pushed[0].1 == Push::Rebounds)
    }
}

/// A rebound from a stop: its speed, and the acceleration by which the gap closes again, with what it loses in a unit of time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rebound {
    pub(crate) speed: f64,
    pub(crate) a: f64,
    pub(crate) jerk: f64,
}

impl Rebound {
    /// The time to the next impact where the acceleration changes evenly: the first zero of $`v - at/2 + jt^2/6`$, with j for the
    /// jerk. `None` if there is none.
    fn duration(&self) -> Option<f64> {
        // the first zero in the form in which nothing cancels, also without a jerk
        let root = (1.0 - 8.0 * self.speed * self.jerk / (3.0 * self.a * self.a)).sqrt();
        let time = 4.0 * self.speed / (self.a * (1.0 + root));
        (time > 0.0 && time.is_finite()).then_some(time)
    }
}

/// A chatter of a ring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Chatter {
    /// The stop.
    pub(crate) stop: usize,
    /// The event at which the rest begins.
    pub(crate) rest: usize,
}

impl Chatter {
    /// All chatters of a ring.
    pub(crate) fn all(ring: &MachineRing) -> Vec<Self> {
        let rests = ring.events.iter().enumerate();
        rests.filter_map(|(rest, event)| Some(Self { stop: event.rests_on()?, rest })).collect()
    }

    /// The number of chatters on a stop.
    pub(crate) fn count(ring: &MachineRing, stop: usize) -> usize {
        Self::all(ring).iter().filter(|own| own.stop == stop).count()
    }

    /// Its impacts with a rebound.
    pub(crate) fn impacts(&self, ring: &MachineRing) -> Vec<usize> {
        let m = ring.len();
        let before = (1..m).map(|i| (self.rest + m - i) % m);
        let mut impacts: Vec<usize> =
            before.take_while(|k| ring.events[*k].rebounds_from() == Some(self.stop)).collect();
        impacts.reverse();
        impacts
    }

    /// The rebound at impact `k`. `None` if the stop cannot hold the structure there.
    pub(crate) fn rebound(&self, frame: &MachineFrame<'_>, ring: &MachineRing, k: usize) -> Option<Rebound> {
        let mut place = Place { known: Vec::new(), ..ring.place(k) };
        let speed = frame.gap(&place, self.stop).1;
        // at rest the reaction is the force that would close the gap: over the mobility, the acceleration
        for (stop, _) in &ring.events[self.rest].pushed {
            place.states[*stop] = ContactState::Resting;
        }
        frame.constrain(&mut place)?;
        let structure = frame.structure(&place.states)?;
        let held = structure.held.iter().position(|held| *held == self.stop)?;
        let (force, rate) = place.unguarded_flight(&frame.normal, structure.clone()).first(&structure.reactions[held]);
        let mobility = structure.mobility[held].0;
        Some(Rebound { speed, a: force * mobility, jerk: -rate * mobility })
    }

    /// The rebound at the event at which the rest begins, which is left out.
    fn rebound_at_rest(&self, frame: &MachineFrame<'_>, ring: &MachineRing) -> Option<Rebound> {
        let StopLaw::Rigid { restitution } = frame.machine.stops()[self.stop].law else { return None };
        let before = (self.rest + ring.len() - 1) % ring.len();
        let mut from = ring.place(before);
        frame.constrain(&mut from)?;
        let arrival = frame.moved(&from, &frame.structure(&from.states)?, ring.time(before, frame.machine));
        let closing = frame.gap(&arrival, self.stop).1;
        Some(Rebound { speed: -restitution * closing, ..self.rebound(frame, ring, self.rest)? })
    }

    /// What is left out if the rest begins at event `k`.
    fn left_out(&self, frame: &MachineFrame<'_>, ring: &MachineRing, k: usize) -> f64 {
        let rebound = if k == self.rest { self.rebound_at_rest(frame, ring) } else { self.rebound(frame, ring, k) };
        let Some(Rebound { speed, a, .. }) = rebound.filter(|rebound| rebound.a > 0.0) else {
            return f64::INFINITY;
        };
        let (size, fastest) = frame.normal.along(self.stop, frame.sizes(&ring.place(k)));
        let frequency = ring.frequency(frame.machine);
        // v^2/2a for the time 2v/a
        speed * speed * speed / (a * a) * frequency / size.max(fastest / frequency)
    }

    /// Leaves out the impacts of all chatters that do not matter.
    pub(crate) fn shorten(frame: &MachineFrame<'_>, ring: &mut MachineRing) -> Option<()> {
        let last = |ring: &MachineRing, chatter: Self| {
            let small = |k: &usize| chatter.left_out(frame, ring, *k) < TAIL;
            Some((chatter, chatter.impacts(ring).into_iter().find(small)?))
        };
        // a cut changes the numbers of the events, so the search begins anew
        while let Some((chatter, k)) = Self::all(ring).into_iter().find_map(|chatter| last(ring, chatter)) {
            chatter.cut(frame, ring, k)?;
        }
        Some(())
    }

    /// Changes the number of impacts of a chatter by one where what is left out has become too much or too little. `None` if there
    /// is no such chatter.
    pub(crate) fn adapt(frame: &MachineFrame<'_>, ring: &mut MachineRing) -> Option<Self> {
        Self::all(ring).into_iter().find_map(|chatter| {
            let left_out = |k: usize| chatter.left_out(frame, ring, k);
            let last = chatter.impacts(ring).last().copied();
            if left_out(chatter.rest) > LONGEST {
                chatter.longer(frame, ring)
            } else {
                let last = last.filter(|last| left_out(*last) < SHORTEST)?;
                chatter.cut(frame, ring, last)
            }
        })
    }

    /// Lets the rest begin at impact `k`.
    pub(crate) fn cut(self, frame: &MachineFrame<'_>, ring: &mut MachineRing, k: usize) -> Option<Self> {
        let m = ring.len();
        let mut place = ring.places[k].clone();
        place.states.clone_from(&ring.events[self.rest].after);
        frame.constrain(&mut place)?;
        ring.places[k] = place;
        ring.events[k] = ring.events[self.rest].clone();
        // the last ones first, so that the numbers of the others stay
        let mut gone: Vec<usize> = (1..=(self.rest + m - k) % m).map(|i| (k + i) % m).collect();
        gone.sort_unstable();
        gone.iter().rev().for_each(|k| ring.remove(*k));
        Some(Self { rest: k - gone.iter().filter(|gone| **gone < k).count(), ..self })
    }

    /// Lets the impact at which the rest begins rebound, and the rest begin at the next one. `None` if there is no time for it.
    pub(crate) fn longer(self, frame: &MachineFrame<'_>, ring: &mut MachineRing) -> Option<Self> {
        let m = ring.len();
        let before = (self.rest + m - 1) % m;
        let rest = ring.events[self.rest].clone();
        let open = ring.events[before].after.clone();
        // the impact rebounds: the contacts after it are those before it
        ring.places[self.rest].states.clone_from(&open);
        let event = &mut ring.events[self.rest];
        event.after = open;
        event.pushed.iter_mut().for_each(|(_, push)| *push = Push::Rebounds);
        let miss = ring.miss(frame, before)?;
        // the residual is the difference between the rebound and the rest that the state was at
        let wanted = frame.shape.values(&ring.places[self.rest]);
        let values: Vec<f64> = wanted.iter().zip(&miss[1..]).map(|(wanted, miss)| wanted + miss).collect();
        ring.places[self.rest] = frame.shape.with_values(&ring.places[self.rest], &values);
        let time = self.rebound(frame, ring, self.rest)?.duration()?;
        let place = ring.place(self.rest);
        let mut next = frame.moved(&place, &frame.structure(&place.states)?, time);
        next.states.clone_from(&rest.after);
        frame.constrain(&mut next)?;
        next.phase = ring.theta(self.rest) + ring.frequency(frame.machine) * time;
        ring.insert(self.rest + 1, rest, next);
        Some(Self { rest: self.rest + 1, ..self })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_time_to_the_next_impact() {
        for (speed, a, jerk) in [(0.1, 2.0, 0.0), (0.1, 2.0, 3.0), (0.1, 2.0, -30.0), (1e-9, 1e-3, 1.0)] {
            let t = Rebound { speed, a, jerk }.duration().unwrap();
            let gap = speed - 0.5 * a * t + jerk * t * t / 6.0;
            assert!(gap.abs() < 1e-15 * speed, "{speed} {a} {jerk}: {t} {gap}");
        }
        // the acceleration is gone before
        assert!(Rebound { speed: 1.0, a: 1.0, jerk: 1.0 }.duration().is_none());
    }
}

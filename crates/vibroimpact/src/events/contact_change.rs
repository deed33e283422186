//! The change of contacts at one time: impacts, and what stops and joints do after them.

use super::advance::FAINT;
use super::event::{End, EventKind};
use super::motion::Motion;
use super::resolve::{Resolution, Resolved};
use crate::machine::{Opening, StopLaw};
use crate::regime::{ContactState, GuardKind, compliant, compliant_force};

/// An event to announce: its kind, its place, its speed, and the other stops of an impact.
type Happening = (EventKind, usize, f64, Vec<usize>);

/// A gap or a rate below this part of its terms is zero within rounding.
const ROUNDED: f64 = 64.0 * f64::EPSILON;

impl Motion<'_> {
    /// Changes the contacts at this time, all at once: impacts on the stops `closing`, then the states of the candidates,
    /// which are closed without velocity; the forces of those in `ended` have reached their limits. The motion ends if no
    /// state of the contacts is consistent.
    pub(super) fn change(
        &mut self,
        before: &[ContactState],
        closing: &[usize],
        candidates: Vec<usize>,
        ended: &[usize],
    ) {
        if self.changed(before, closing, candidates, ended).is_none() {
            self.end = Some(End::Inconsistent);
        }
    }

    fn changed(
        &mut self,
        before: &[ContactState],
        closing: &[usize],
        mut candidates: Vec<usize>,
        ended: &[usize],
    ) -> Option<()> {
        let turns = self.place.turns(&self.normal);
        // before the impacts change them
        let speeds: Vec<f64> = (0..self.machine.stops().len()).map(|j| self.closing_speed(j, &turns)).collect();
        let (rigid, soft): (Vec<usize>, Vec<usize>) =
            closing.iter().partition(|j| compliant(&self.machine.stops()[**j].law).is_none());
        let sizes = (!rigid.is_empty()).then(|| self.rate_sizes());
        let mut happenings = Vec::new();
        if let Some(sizes) = &sizes {
            happenings = self.impacts(&rigid, (&speeds, sizes), &mut candidates)?;
        }
        self.meet(&soft, before, sizes.as_deref(), &turns, &mut candidates);
        self.silenced |= self.instants.silence(&mut self.place.x, &mut self.place.v, 1);
        self.touch_faintly(&soft, &turns, &mut candidates);
        if sizes.is_some() {
            self.let_go(&turns);
        }
        self.add_candidates(before, &turns, &mut candidates);
        if !candidates.is_empty() {
            self.resolve(&candidates, ended)?;
        }
        if core::mem::take(&mut self.silenced) {
            self.place.close_rests(self.machine, &self.normal);
        }
        happenings.extend(self.state_changes(before, (closing, &rigid), &speeds, &turns));
        let open = |j: &usize| self.place.states[*j] == ContactState::Open;
        self.struck = rigid.into_iter().filter(open).map(|j| (j, speeds[j])).collect();
        for (kind, at, speed, _) in &happenings {
            self.instants.keep(*kind, *at, *speed);
        }
        for (kind, at, speed, with) in happenings {
            self.announce(kind, at, speed, with);
        }
        self.tie = false;
        if let Some(passage) = &mut self.passage {
            passage.after = Some(self.place.clone());
        }
        if !self.struck.is_empty() {
            self.after_impacts(&turns);
        }
        Some(())
    }

    /// Opens the compliant stops whose dampers would pull after an impact elsewhere has changed their velocity. They open with the
    /// impact, so neighbours of the motion open them earlier or later by what the stop that was struck says, not by their force.
    fn let_go(&mut self, turns: &[(f64, f64)]) {
        for (j, stop) in self.machine.stops().iter().enumerate() {
            let by_force = matches!(stop.law, StopLaw::Compliant { opening: Opening::Force, .. });
            if !by_force || self.place.states[j] != ContactState::Closed {
                continue;
            }
            let (gap, rate) = self.place.gap_and_rate(&self.normal, turns, j);
            let gap = self.place.sharp_gap(j).unwrap_or(gap);
            if compliant_force(&stop.law, gap, rate).is_some_and(|force| force < 0.0) {
                self.place.open(&stop.law, GuardKind::Force(j), j, (gap, rate));
            }
        }
    }

    fn closing_speed(&self, stop: usize, turns: &[(f64, f64)]) -> f64 {
        (-self.place.gap(&self.normal, turns, stop).1).max(0.0)
    }

    /// The impacts on rigid stops, and those on others that they push; stops that are left without speed become candidates.
    fn impacts(
        &mut self,
        rigid: &[usize],
        (speeds, sizes): (&[f64], &[f64]),
        candidates: &mut Vec<usize>,
    ) -> Option<Vec<Happening>> {
        self.largest_impact = rigid.iter().fold(self.largest_impact, |most, j| most.max(speeds[*j]));
        let pushed = self.strike(rigid, (speeds, sizes), candidates)?;
        let happening = |j: usize| {
            let others = rigid.iter().chain(pushed.iter().filter(|other| !rigid.contains(other)));
            let with = others.copied().filter(|other| *other != j).collect();
            (EventKind::Impact, j, speeds[j], with)
        };
        Some(self.distinct(rigid, &pushed).into_iter().map(happening).collect())
    }

    /// Adds the contacts whose state can end or begin by a force that jumps.
    fn add_candidates(&self, before: &[ContactState], turns: &[(f64, f64)], candidates: &mut Vec<usize>) {
        // any rest can end
        for (at, state) in self.place.states.iter().enumerate() {
            if state.constrains() && !candidates.contains(&at) {
                candidates.push(at);
            }
        }
        // a preload that presses at depth zero is no constraint, and ends like one
        for (j, stop) in self.machine.stops().iter().enumerate() {
            let closed = self.place.states[j] == ContactState::Closed && before[j] == ContactState::Closed;
            let preloaded = compliant(&stop.law).is_some_and(|(_, _, preload)| preload > 0.0);
            if closed && preloaded && !candidates.contains(&j) {
                let (gap, rate, size, rate_size) = self.place.gap(&self.normal, turns, j);
                if gap.abs() <= ROUNDED * size && rate.abs() <= ROUNDED * rate_size {
                    candidates.push(j);
                }
            }
        }
        // a joint that others hold although its force is that of sliding can hold as well
        for joint in 0..self.machine.joints().len() {
            let at = self.machine.stops().len() + joint;
            if !self.place.states[at].constrains() && !candidates.contains(&at) {
                let (speed, size) = self.place.sliding(self.machine, &self.normal, joint);
                if speed.abs() <= ROUNDED * size {
                    candidates.push(at);
                }
            }
        }
        candidates.sort_unstable();
    }

    /// Gives the candidates states that are consistent with each other.
    fn resolve(&mut self, candidates: &[usize], ended: &[usize]) -> Option<()> {
        let (machine, normal, place) = (self.machine, &self.normal, &self.place);
        let all = Resolution { machine, normal, structures: &mut self.structures, place, candidates, ended };
        let Resolved { states, known } = all.resolve()?;
        self.place.states = states;
        for (kind, count) in known {
            self.place.note(kind, count);
        }
        Some(())
    }

    /// The changes of states, as events.
    fn state_changes(
        &self,
        before: &[ContactState],
        (closing, rigid): (&[usize], &[usize]),
        speeds: &[f64],
        turns: &[(f64, f64)],
    ) -> Vec<Happening> {
        let happening = |(at, was): (usize, &ContactState)| {
            let now = self.place.states[at];
            // an impact is announced already
            if now == *was || rigid.contains(&at) && now == ContactState::Open {
                return None;
            }
            let kind = kind(*was, now, closing.contains(&at))?;
            let speed = match now {
                ContactState::Closed if closing.contains(&at) => speeds[at],
                // a stop that was not about to close is pushed shut by an impact elsewhere
                ContactState::Closed => self.closing_speed(at, turns),
                ContactState::Open if kind == EventKind::Open => self.place.gap(&self.normal, turns, at).1.max(0.0),
                ContactState::Forward => 1.0,
                ContactState::Backward => -1.0,
                _ => 0.0,
            };
            Some((kind, at, speed, Vec::new()))
        };
        before.iter().enumerate().filter_map(happening).collect()
    }

    /// Makes touches of the closures of compliant stops that are rounding errors: of a motion that has ended, or of one in which both
    /// sides of a stop without a preload go on together.
    fn touch_faintly(&mut self, soft: &[usize], turns: &[(f64, f64)], candidates: &mut Vec<usize>) {
        let mut rates = Vec::new();
        for j in soft.iter().copied().filter(|j| !candidates.contains(j)) {
            let (_, rate, _, size) = self.place.gap(&self.normal, turns, j);
            let along = (&self.normal.directions[j][..], self.normal.squares[j]);
            let loaded = compliant(&self.machine.stops()[j].law).is_some_and(|(_, _, preload)| preload > 0.0);
            let faint = size == 0.0 || !loaded && self.instants.is_faint(rate, along, FAINT);
            if faint && self.place.known.contains(&(GuardKind::Depth(j), 1)) {
                rates.push((j, rate));
            }
        }
        self.normal.move_beside(&self.place.states, &rates, &mut self.place.v);
        for (j, _) in rates {
            self.place.known.retain(|(kind, _)| *kind != GuardKind::Depth(j));
            self.place.states[j] = ContactState::Open;
            candidates.push(j);
        }
    }
}

/// The event at which the state of a contact changes; none if there is nothing to announce.
const fn kind(was: ContactState, now: ContactState, closes: bool) -> Option<EventKind> {
    Some(match (was, now) {
        // a contact without force at the start has nothing to announce
        (ContactState::Open, ContactState::Touching) if !closes => return None,
        (ContactState::Open | ContactState::Touching, ContactState::Resting)
        | (ContactState::Closed, ContactState::Resting | ContactState::Touching)
        | (ContactState::Open, ContactState::Touching) => EventKind::Stick,
        (ContactState::Resting | ContactState::Touching, ContactState::Open)
        | (ContactState::Resting, ContactState::Touching) => EventKind::Release,
        (_, ContactState::Closed) => EventKind::Close,
        (ContactState::Closed, ContactState::Open) => EventKind::Open,
        (_, ContactState::Holding) => EventKind::Hold,
        // joints that slide at the start are not announced
        (ContactState::Open, _) => return None,
        _ => EventKind::Slip,
    })
}

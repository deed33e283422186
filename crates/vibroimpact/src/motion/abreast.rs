//! Many motions followed side by side, with the impacts that each has alone.
//!
//! The flights are computed by a [`Batch`]. A motion that the lanes cannot continue is continued by a scalar [`Motion`],
//! from the middle of its flight, until it flies from impact to impact again; so are the last few motions, for which most
//! lanes would be empty.

use super::{End, Motion};
use crate::contact::{ImpactState, chatter};
use crate::flight::{Contact, SearchLimits};
use crate::lanes::{Batch, PropagatorCache};
use crate::system::{Oscillator, Start};

/// A motion that is to be followed.
pub(crate) struct Launched {
    /// The number of its oscillator.
    pub(crate) system: u32,
    pub(crate) start: Start,
}

/// Where motions come from, and what records them.
pub(crate) trait Recorder {
    /// The record of one motion.
    type Track;
    /// An empty record.
    fn track(&self) -> Self::Track;
    /// The next motion, for which this record is used from now on; `None` if there is no more.
    fn next(&mut self, track: &mut Self::Track) -> Option<Launched>;
    /// The oscillator with this number.
    fn osc(&self, system: u32) -> &Oscillator;
    /// Records an impact a time `interval` after the last event, found in so many search steps. Returns whether the motion
    /// is done.
    fn impact(&mut self, track: &mut Self::Track, osc: &Oscillator, state: ImpactState, found: (f64, u64)) -> bool;
    /// Records that no event follows. The motion is done.
    fn end(&mut self, track: &mut Self::Track, osc: &Oscillator, end: End);
    /// Records the events of a single motion until it is done, or until an impact at which `leave` returns true, which is
    /// returned. There is a cache of the propagators if the motion may be long.
    fn alone(
        &mut self,
        track: &mut Self::Track,
        osc: &Oscillator,
        motion: (Motion<'_>, Option<&PropagatorCache>),
        leave: &dyn Fn(&ImpactState) -> bool,
    ) -> Option<ImpactState>;
    /// Called after each motion; whether to stop.
    fn stopping(&mut self) -> bool;
}

/// The motion in a slot of the batch.
#[derive(Debug)]
struct Slot<T> {
    track: T,
    done: bool,
}

/// A batch with the motions that it works on.
pub(crate) struct Abreast<R: Recorder> {
    batch: Batch,
    limits: SearchLimits,
    slots: Vec<Slot<R::Track>>,
    /// The slots whose motions are done.
    free: Vec<u32>,
    recorder: R,
}

/// So few motions are faster one after another.
const SPARSE: usize = 8;

impl<R: Recorder> Abreast<R> {
    /// For an empty batch. Flights that the lanes cannot decide are searched within `limits`.
    pub(crate) const fn new(batch: Batch, limits: SearchLimits, recorder: R) -> Self {
        Self { batch, limits, slots: Vec::new(), free: Vec::new(), recorder }
    }

    /// Follows all motions: a slot whose motion is done is launched again with the next one. Returns the recorder.
    pub(crate) fn run(mut self) -> R {
        let mut more = true;
        while more && self.batch.len() < self.batch.capacity() {
            let mut track = self.recorder.track();
            let next = self.recorder.next(&mut track);
            more = next.is_some();
            if let Some(Launched { system, start }) = next {
                self.batch.push_of(self.recorder.osc(system), start);
                self.slots.push(Slot { track, done: false });
            }
        }
        let mut list = Vec::new();
        while !self.batch.is_empty() {
            if !more && self.batch.len() <= SPARSE {
                return self.one_by_one();
            }
            self.batch.round();
            // copied, because what follows changes the lists of the batch
            list.clear();
            list.extend_from_slice(self.batch.struck());
            for &slot in &list {
                self.struck(slot, 1);
            }
            list.clear();
            list.extend_from_slice(self.batch.settling());
            for &slot in &list {
                self.settling(slot);
            }
            list.clear();
            list.extend_from_slice(self.batch.rare());
            for &slot in &list {
                self.rare(slot);
            }
            // the last slots first, because a slot that is removed is filled by the last one
            self.free.sort_unstable();
            while let Some(slot) = self.free.pop() {
                if self.recorder.stopping() {
                    return self.recorder;
                }
                let next = if more { self.recorder.next(&mut self.slots[slot as usize].track) } else { None };
                more = next.is_some();
                if let Some(Launched { system, start }) = next {
                    self.batch.launch_of(slot, self.recorder.osc(system), start);
                    self.slots[slot as usize].done = false;
                } else {
                    self.batch.remove(slot);
                    self.slots.swap_remove(slot as usize);
                }
            }
        }
        self.recorder
    }

    /// Follows the motions that are left one after another.
    fn one_by_one(mut self) -> R {
        while let Some(Slot { track, .. }) = &mut self.slots.last_mut() {
            #[allow(clippy::cast_possible_truncation)] // a few
            let slot = self.batch.len() as u32 - 1;
            let osc = self.batch.osc(slot);
            let motion = Motion::with_limits(osc, self.batch.launched(slot), self.limits);
            let cache = PropagatorCache::new();
            self.recorder.alone(track, osc, (motion, Some(&cache)), &|_| false);
            if self.recorder.stopping() {
                break;
            }
            self.batch.remove(slot);
            self.slots.pop();
        }
        self.recorder
    }

    /// Notes whether the motion in a slot is done.
    fn note(&mut self, slot: u32, done: bool) {
        if done {
            self.slots[slot as usize].done = true;
            self.free.push(slot);
        }
    }

    /// Records the impact of a slot, found in so many search steps.
    fn struck(&mut self, slot: u32, steps: u64) {
        let (state, interval) = self.batch.arrival(slot);
        let track = &mut self.slots[slot as usize].track;
        let done = self.recorder.impact(track, self.batch.osc(slot), state, (interval, steps));
        self.note(slot, done);
    }

    /// Continues a slot whose impact is not followed by a flight.
    fn settling(&mut self, slot: u32) {
        // its impact has ended it in this round
        if self.slots[slot as usize].done {
            return;
        }
        let (state, _) = self.batch.arrival(slot);
        let osc = *self.batch.osc(slot);
        if chatter::settles_after(&osc, &state) {
            self.hand_over(slot, &osc, Motion::after(&osc, &state, self.limits));
        }
    }

    /// Continues a slot whose flight needs the careful search.
    fn rare(&mut self, slot: u32) {
        let launched = self.batch.launched(slot);
        let (contact, steps) = self.batch.carefully(slot, self.limits);
        let osc = *self.batch.osc(slot);
        let end = match contact {
            Contact::Impact { .. } => {
                self.struck(slot, u64::from(steps));
                // the impact that has just been found may be one of a chatter
                return self.settling(slot);
            }
            Contact::Grazing { .. } | Contact::Contact { .. } => {
                // it repeats this flight, and goes on as a single motion does
                return self.hand_over(slot, &osc, Motion::with_limits(&osc, launched, self.limits));
            }
            Contact::Never(why) => End::Never(why),
            Contact::NoneUntil(s) => End::NoneFor(s),
        };
        self.recorder.end(&mut self.slots[slot as usize].track, &osc, end);
        self.note(slot, true);
    }

    /// Follows a single motion until it flies from impact to impact again, or until it is done.
    fn hand_over(&mut self, slot: u32, osc: &Oscillator, motion: Motion<'_>) {
        let track = &mut self.slots[slot as usize].track;
        match self.recorder.alone(track, osc, (motion, None), &|state| !chatter::settles_after(osc, state)) {
            Some(state) => self.batch.launch(slot, state.rebound(osc)),
            None => self.note(slot, true),
        }
    }
}

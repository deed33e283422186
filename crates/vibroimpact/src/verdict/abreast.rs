//! Many motions followed side by side to their verdicts.
//!
//! The flights are computed by a [`Batch`]. Each motion is [followed](super::follow) as a single one would be, with the
//! same impacts. A motion that the lanes cannot continue is continued by a scalar [`Motion`], from the middle of its
//! flight; so are the last few motions, for which most lanes would be empty.

use super::follow::{Follow, Releases, ended};
use super::options::SettleOptions;
use super::outcome::Verdict;
use super::settle::Drive;
use crate::flight::Contact;
use crate::lanes::Batch;
use crate::motion::{End, ImpactState, Motion};
use crate::system::{Oscillator, Start};

/// A motion that is to be followed.
pub(super) struct Launched {
    /// Its number.
    pub(super) place: usize,
    /// The number of its oscillator in the batch.
    pub(super) system: u32,
    pub(super) start: Start,
}

/// Where motions come from, and where their verdicts go.
pub(super) trait Source {
    /// The next motion; `None` if there is no more.
    fn next(&mut self) -> Option<Launched>;
    /// An empty record.
    fn follow(&self) -> Follow;
    /// The verdicts on releases of the oscillator of a motion.
    fn releases(&mut self, place: usize) -> &mut Releases;
    /// Whether the verdict on a motion that arrives in this state is known; then it is taken down.
    fn caught(&mut self, place: usize, follow: &Follow, state: &ImpactState, options: &SettleOptions) -> bool;
    /// Takes down the verdict on a motion.
    fn decided(&mut self, place: usize, verdict: Verdict, follow: &Follow, options: &SettleOptions);
    /// Called after each motion; whether to stop.
    fn stopping(&mut self) -> bool;
}

/// The motion in a slot of the batch.
#[derive(Debug)]
struct Track {
    place: usize,
    follow: Follow,
    done: bool,
}

/// A batch with the motions that it works on.
pub(super) struct Abreast<'a, S> {
    batch: Batch,
    options: &'a SettleOptions,
    tracks: Vec<Track>,
    /// The slots whose motions are decided.
    free: Vec<u32>,
    source: S,
}

/// So few motions are faster one after another.
const SPARSE: usize = 8;

impl<'a, S: Source> Abreast<'a, S> {
    /// For an empty batch.
    pub(super) const fn new(batch: Batch, options: &'a SettleOptions, source: S) -> Self {
        Self { batch, options, tracks: Vec::new(), free: Vec::new(), source }
    }

    /// Follows all motions: a slot whose motion is decided is launched again with the next one. Returns the source.
    pub(super) fn run(mut self) -> S {
        let mut more = true;
        while more && self.batch.len() < self.batch.capacity() {
            let next = self.source.next();
            more = next.is_some();
            if let Some(Launched { place, system, start }) = next {
                self.batch.push_of(system, start);
                self.tracks.push(Track { place, follow: self.source.follow(), done: false });
            }
        }
        let mut list = Vec::new();
        while !self.batch.is_empty() {
            if !more && self.batch.len() <= SPARSE {
                return self.one_by_one();
            }
            self.batch.round();
            list.clear();
            list.extend_from_slice(self.batch.struck());
            for &slot in &list {
                self.struck(slot);
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
                if self.source.stopping() {
                    return self.source;
                }
                let next = if more { self.source.next() } else { None };
                more = next.is_some();
                if let Some(Launched { place, system, start }) = next {
                    self.batch.launch_of(slot, system, start);
                    let track = &mut self.tracks[slot as usize];
                    track.follow.reset();
                    (track.place, track.done) = (place, false);
                } else {
                    self.batch.remove(slot);
                    self.tracks.swap_remove(slot as usize);
                }
            }
        }
        self.source
    }

    /// Follows the motions that are left one after another.
    fn one_by_one(mut self) -> S {
        while let Some(slot) = self.batch.len().checked_sub(1) {
            #[allow(clippy::cast_possible_truncation)] // a few
            let slot = slot as u32;
            let osc = *self.batch.osc(slot);
            let motion = Motion::with_limits(&osc, self.batch.launched(slot), self.options.limits);
            self.continued(slot, &osc, motion, |_| false);
            if self.source.stopping() {
                break;
            }
            self.batch.remove(slot);
            self.tracks.pop();
        }
        self.source
    }

    /// Records the full verdict on the motion in a slot.
    fn decided(&mut self, slot: u32, verdict: Verdict) {
        let track = &mut self.tracks[slot as usize];
        track.done = true;
        self.free.push(slot);
        self.source.decided(track.place, verdict, &track.follow, self.options);
    }

    /// Records the impact of a slot whose motion continues with a flight.
    fn struck(&mut self, slot: u32) {
        let (state, interval) = self.batch.arrival(slot);
        let track = &mut self.tracks[slot as usize];
        track.follow.steps += 1;
        if self.source.caught(track.place, &track.follow, &state, self.options) {
            track.done = true;
            self.free.push(slot);
            return;
        }
        let osc = self.batch.osc(slot);
        if let Some(verdict) = track.follow.impact(osc, self.options, state, interval) {
            self.decided(slot, verdict);
        } else if !track.follow.within(self.options) {
            let verdict = track.follow.last_look(osc, self.options);
            self.decided(slot, verdict);
        }
    }

    /// Continues a slot whose impact is not followed by a flight.
    fn settling(&mut self, slot: u32) {
        let track = &self.tracks[slot as usize];
        if track.done {
            return;
        }
        let (state, _) = self.batch.arrival(slot);
        if self.batch.settles_after(slot, &state) {
            let osc = *self.batch.osc(slot);
            self.hand_over(slot, &osc, Motion::after(&osc, &state, self.options.limits));
        }
    }

    /// Continues a slot whose flight needs the careful search.
    fn rare(&mut self, slot: u32) {
        let limits = self.options.limits;
        let launched = self.batch.launched(slot);
        let (contact, steps) = self.batch.carefully(slot, limits);
        let osc = *self.batch.osc(slot);
        match contact {
            Contact::Impact { .. } => {
                self.tracks[slot as usize].follow.steps += u64::from(steps) - 1;
                self.struck(slot);
                self.settling(slot);
            }
            Contact::Never(why) => self.decided(slot, ended(&osc, Some(End::Never(why)), limits)),
            Contact::NoneUntil(s) => self.decided(slot, ended(&osc, Some(End::NoneFor(s)), limits)),
            Contact::Grazing { .. } | Contact::Contact { .. } => {
                self.hand_over(slot, &osc, Motion::with_limits(&osc, launched, limits));
            }
        }
    }

    /// Follows a single motion until it flies from impact to impact again, or to its end.
    fn hand_over(&mut self, slot: u32, osc: &Oscillator, motion: Motion<'_>) {
        if !self.continued(slot, osc, motion, |batch| !batch.0.settles_after(slot, batch.1)) {
            let state = self.tracks[slot as usize].follow.last();
            self.batch.launch(slot, state.rebound(osc));
        }
    }

    /// Follows a single motion to its verdict, or until it may leave; returns whether there is a verdict.
    fn continued(
        &mut self,
        slot: u32,
        osc: &Oscillator,
        mut motion: Motion<'_>,
        leave: impl Fn((&Batch, &ImpactState)) -> bool,
    ) -> bool {
        let (batch, options, track) = (&self.batch, self.options, &mut self.tracks[slot as usize]);
        let releases = self.source.releases(track.place);
        let mut drive = Drive { osc, options, follow: &mut track.follow, releases, time: 0.0 };
        let verdict = drive.on(&mut motion, |state| leave((batch, state)));
        let decided = verdict.is_some();
        if let Some(verdict) = verdict {
            self.decided(slot, verdict);
        }
        decided
    }
}

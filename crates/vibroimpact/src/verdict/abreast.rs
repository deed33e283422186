//! Many motions followed side by side to their verdicts: each is [followed](super::follow) as a single one would be, with
//! the same impacts.

use super::follow::{Follow, Releases, ended};
use super::options::SettleOptions;
use super::outcome::Verdict;
use super::settle::{Drive, Followed};
use crate::lanes::{Batch, PropagatorCache};
use crate::motion::{Abreast, End, ImpactState, Launched, Motion, Recorder};
use crate::system::Oscillator;

/// Where motions come from, and where their verdicts go.
pub(super) trait Source {
    /// The next motion with its number, of which `follow` is the record from now on; `None` if there is no more.
    fn next(&mut self, follow: &mut Follow) -> Option<(usize, Launched)>;
    /// The oscillator with this number.
    fn osc(&self, system: u32) -> &Oscillator;
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

/// Follows all motions of a source in an empty batch. Returns the source.
pub(super) fn settle_abreast<S: Source>(batch: Batch, options: &SettleOptions, source: S) -> S {
    Abreast::new(batch, options.limits, Settling { options, source }).run().source
}

struct Settling<'a, S> {
    options: &'a SettleOptions,
    source: S,
}

/// A motion with its number.
struct Track {
    place: usize,
    follow: Follow,
}

impl<S: Source> Recorder for Settling<'_, S> {
    type Track = Track;

    fn track(&self) -> Track {
        Track { place: 0, follow: self.source.follow() }
    }

    fn next(&mut self, track: &mut Track) -> Option<Launched> {
        let (place, launched) = self.source.next(&mut track.follow)?;
        track.place = place;
        Some(launched)
    }

    fn osc(&self, system: u32) -> &Oscillator {
        self.source.osc(system)
    }

    #[inline]
    fn impact(
        &mut self,
        track: &mut Track,
        osc: &Oscillator,
        state: ImpactState,
        (interval, steps): (f64, u64),
    ) -> bool {
        let (Track { place, follow }, options) = (track, self.options);
        follow.record.steps += steps;
        if self.source.caught(*place, follow, &state, options) {
            return true;
        }
        let verdict = match follow.impact(osc, options, state, interval) {
            None if !follow.record.within(options) => Some(follow.record.last_look(osc, options)),
            verdict => verdict,
        };
        let decided = verdict.is_some();
        if let Some(verdict) = verdict {
            self.source.decided(*place, verdict, follow, options);
        }
        decided
    }

    fn end(&mut self, track: &mut Track, osc: &Oscillator, end: End) {
        let verdict = ended(osc, Some(end), self.options.limits, track.follow.count() as u64);
        self.source.decided(track.place, verdict, &track.follow, self.options);
    }

    fn alone(
        &mut self,
        track: &mut Track,
        osc: &Oscillator,
        (mut motion, cache): (Motion<'_>, Option<&PropagatorCache>),
        leave: &dyn Fn(&ImpactState) -> bool,
    ) -> Option<ImpactState> {
        let (Track { place, follow }, options) = (track, self.options);
        let releases = self.source.releases(*place);
        let mut drive = Drive { osc, follow, releases, motion: &mut motion, cache, time: 0.0, returned: false };
        match drive.verdict(options, &|drive| leave(&drive.follow.last())) {
            None => Some(follow.last()),
            Some(verdict) => {
                self.source.decided(*place, verdict, follow, options);
                None
            }
        }
    }

    fn stopping(&mut self) -> bool {
        self.source.stopping()
    }
}

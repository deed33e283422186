//! The events of many motions of one oscillator, followed side by side, with the same bits as one after another.

use super::abreast::{Abreast, Launched, Recorder};
use super::{End, Event, EventKind, Motion};
use crate::contact::ImpactState;
use crate::flight::SearchLimits;
use crate::lanes::{Batch, PropagatorCache, Width};
use crate::math::Wide;
use crate::system::{Oscillator, Start};

/// Takes the events of many motions. Those of one motion come in their order; those of different motions are mixed.
pub trait EventRecorder {
    /// Takes the next event of a motion, given by its number. Returns whether the motion is followed further.
    fn event(&mut self, motion: usize, event: &Event) -> bool;
    /// Takes the end of a motion that has no further event, as [`Motion::end`] gives it.
    fn end(&mut self, motion: usize, end: Option<End>);
    /// Called after each motion; if it returns true, the computation stops.
    fn stopping(&mut self) -> bool;
}

/// The number of motions side by side. With more, the rows that a recorder writes leave the nearer caches.
const MOST: usize = 256;

/// Fewer motions than this are followed one after another, because most lanes would be empty.
const FEW: usize = 16;

/// Follows the motions of `osc` from these starts until the recorder needs no further event. Each flight is searched
/// within `limits`. The events are those of [`Motion::with_limits`], to the last bit.
///
/// ```
/// use vibroimpact::{Oscillator, Start, flight::SearchLimits, lanes::Width, motion::{End, Event, EventRecorder, record_events}};
/// /// Counts the first ten events of each motion.
/// struct Counts(Vec<u32>);
/// impl EventRecorder for Counts {
///     fn event(&mut self, motion: usize, _: &Event) -> bool {
///         self.0[motion] += 1;
///         self.0[motion] < 10
///     }
///     fn end(&mut self, _: usize, _: Option<End>) {}
///     fn stopping(&mut self) -> bool {
///         false
///     }
/// }
/// let osc = Oscillator::from_inverse_beta(1.3, 0.75, 0.5)?;
/// let starts: Vec<Start> = (0..100).map(|k| Start { x: 0.0, v: 0.1 * f64::from(k), phase: 0.0 }).collect();
/// let mut counts = Counts(vec![0; 100]);
/// record_events(&osc, &starts, SearchLimits::default(), Width::best(), &mut counts);
/// assert!(counts.0.iter().all(|count| *count == 10));
/// # Ok::<(), vibroimpact::SystemError>(())
/// ```
pub fn record_events(
    osc: &Oscillator,
    starts: &[Start],
    limits: SearchLimits,
    width: Width,
    recorder: &mut dyn EventRecorder,
) {
    let batch = if starts.len() < FEW { None } else { Batch::new(osc, MOST.min(starts.len()), width) };
    let mut events = Events { osc, starts, next: 0, recorder };
    // the lanes search each flight to their own end, and a shorter limit would end a motion earlier
    match batch.filter(|batch| batch.longest() < limits.horizon(osc)) {
        Some(batch) => {
            Abreast::new(batch, limits, events).run();
        }
        None => {
            // one oscillator, so one cache for all motions
            let cache = PropagatorCache::new();
            for (number, start) in starts.iter().enumerate() {
                let mut track = Track { number, time: Wide::default() };
                let motion = Motion::with_limits(osc, *start, limits);
                events.alone(&mut track, osc, (motion, Some(&cache)), &|_| false);
                if events.stopping() {
                    return;
                }
            }
        }
    }
}

struct Events<'a> {
    osc: &'a Oscillator,
    starts: &'a [Start],
    next: usize,
    recorder: &'a mut dyn EventRecorder,
}

/// The number of a motion, and the time of its last event.
struct Track {
    number: usize,
    time: Wide,
}

impl Recorder for Events<'_> {
    type Track = Track;

    fn track(&self) -> Track {
        Track { number: 0, time: Wide::default() }
    }

    fn next(&mut self, track: &mut Track) -> Option<Launched> {
        let start = *self.starts.get(self.next)?;
        *track = Track { number: self.next, time: Wide::default() };
        self.next += 1;
        Some(Launched { system: 0, start })
    }

    fn osc(&self, _: u32) -> &Oscillator {
        self.osc
    }

    fn impact(&mut self, track: &mut Track, osc: &Oscillator, state: ImpactState, (interval, _): (f64, u64)) -> bool {
        // with the digits of a single motion
        track.time += interval;
        let ImpactState { phase, velocity, side } = state;
        let rebound = osc.stop(side).map_or(0.0, |stop| stop.rebound(velocity));
        let kind = EventKind::Impact { velocity_before: velocity, velocity_after: -rebound };
        !self.recorder.event(track.number, &Event { time: track.time.value(), phase, side, kind })
    }

    fn end(&mut self, track: &mut Track, _: &Oscillator, end: End) {
        self.recorder.end(track.number, Some(end));
    }

    fn alone(
        &mut self,
        track: &mut Track,
        _: &Oscillator,
        (motion, cache): (Motion<'_>, Option<&PropagatorCache>),
        leave: &dyn Fn(&ImpactState) -> bool,
    ) -> Option<ImpactState> {
        let mut motion = motion.begun(track.time);
        while let Some(event) = motion.advance(cache) {
            if !self.recorder.event(track.number, &event) {
                return None;
            }
            if let Some(state) = event.arrival() {
                // the lanes take it back
                if leave(&state) {
                    track.time = motion.time();
                    return Some(state);
                }
            }
        }
        self.recorder.end(track.number, motion.end());
        None
    }

    fn stopping(&mut self) -> bool {
        self.recorder.stopping()
    }
}

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario;
    use crate::verdict::{StartBox, scattered_starts};

    const EVENTS: usize = 150;

    /// The first events of each motion, and the end of those that have fewer.
    #[derive(Debug, Default, PartialEq)]
    struct Kept {
        events: Vec<Vec<Event>>,
        ends: Vec<Option<Option<End>>>,
    }

    impl Kept {
        fn new(count: usize) -> Self {
            Self { events: vec![Vec::new(); count], ends: vec![None; count] }
        }
    }

    impl EventRecorder for Kept {
        fn event(&mut self, motion: usize, event: &Event) -> bool {
            self.events[motion].push(*event);
            self.events[motion].len() < EVENTS
        }
        fn end(&mut self, motion: usize, end: Option<End>) {
            self.ends[motion] = Some(end);
        }
        fn stopping(&mut self) -> bool {
            false
        }
    }

    /// With chatter, sticking, grazing contacts, motions that never reach a stop again, preload, both extremes of the
    /// restitution, and systems that the lanes do not follow.
    fn systems() -> Vec<Oscillator> {
        let mut all: Vec<Oscillator> = scenario::PAPER.iter().map(scenario::Scenario::oscillator).collect();
        for (inverse, gap, eps, damping, lower) in [
            (1.11, -0.5, 0.5, 0.0, None),
            (0.4, -0.95, 0.9, 0.05, None),
            (1.3, 0.75, 0.0, 0.0, None),
            (1.3, -0.2, 0.0, 0.1, None),
            (2.0, 0.4, 1.0, 0.0, None),
            (2.0, 0.4, 1.0, 0.01, Some(0.3)),
            (1.0, 0.0, 0.7, 0.3, None),
            (0.9, 0.4, 0.6, 0.02, Some(0.5)),
            (0.002, 0.4, 0.6, 0.0, None),
            (1.7, -2.0, 0.5, 0.1, None),
            (0.5, 3.0, 0.5, 0.0, None),
            (1.9, 2.5, 0.8, 0.02, None),
            (1.913_7, 6.0, 0.8, 0.0, None),
            (1.7, 0.1, 0.3, 0.0, Some(0.05)),
        ] {
            let mut osc = Oscillator::from_inverse_beta(inverse, gap, eps).unwrap().with_damping(damping).unwrap();
            if let Some(gap) = lower {
                osc = osc.with_second_stop(gap, 0.8).unwrap();
            }
            all.push(osc);
        }
        all
    }

    /// Scattered starts, and some at rest on a stop, whose flights begin with a grazing contact or sticking.
    fn starts(osc: &Oscillator) -> Vec<Start> {
        let area = StartBox::natural(osc);
        let resting = |k: usize| Start { x: osc.gap(), v: 0.0, phase: 0.37 * k as f64 };
        (0..70).map(|k| if k % 7 == 3 { resting(k) } else { scattered_starts(osc, area, 3, k as u64) }).collect()
    }

    #[test]
    fn the_same_as_one_after_another() {
        let (mut kinds, mut ends) = ([0; 4], [0; 4]);
        for (limits, count) in
            [(SearchLimits::default(), 70), (SearchLimits { periods: 20.0, ..SearchLimits::default() }, 33)]
        {
            for osc in systems() {
                let starts = &starts(&osc)[..count];
                let mut expected = Kept::new(count);
                for (number, start) in starts.iter().enumerate() {
                    let mut motion = Motion::with_limits(&osc, *start, limits);
                    expected.events[number] = motion.by_ref().take(EVENTS).collect();
                    if expected.events[number].len() < EVENTS {
                        expected.ends[number] = Some(motion.end());
                    }
                }
                for event in expected.events.iter().flatten() {
                    kinds[match event.kind {
                        EventKind::Impact { .. } => 0,
                        EventKind::Graze { .. } => 1,
                        EventKind::Stick { .. } => 2,
                        EventKind::Release => 3,
                    }] += 1;
                }
                for end in &expected.ends {
                    ends[match end {
                        None => 0,
                        Some(Some(End::Never(_))) => 1,
                        Some(Some(End::NoneFor(_))) => 2,
                        Some(Some(End::Stuck(_)) | None) => 3,
                    }] += 1;
                }
                for width in Width::ALL.into_iter().filter(|width| width.available()) {
                    let mut got = Kept::new(count);
                    record_events(&osc, starts, limits, width, &mut got);
                    assert_eq!(got, expected, "{osc:?} {width:?}");
                }
            }
        }
        assert!(kinds.iter().chain(&ends).all(|count| *count >= 5), "{kinds:?} {ends:?}");
    }
}

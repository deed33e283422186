//! A periodic motion of a machine.

use super::frame::{MachineFrame, distance};
use super::lap::MachineLap;
use super::multipliers::multipliers;
use crate::events::{Event, EventKind, Place, Start};
use crate::math::{Multiplier, ln};
use crate::orbit::{Count, Label, Stability};
use crate::regime::Translations;
use crate::system::phase;
use core::f64::consts::TAU;

/// A periodic motion of a machine over its smallest period.
///
/// A machine on which no spring and no stop acts from the ground can move on as a whole. After each period its velocities and
/// the positions of its parts to each other are the same again, and all of it is moved by the [drift](Self::drift). Such
/// cycles are the same motion wherever the machine is. Their states are given where the parts along the free translations
/// are 0 at [`state`](Self::state), which for one translation in all coordinates is the centre of mass.
#[derive(Clone, Debug, PartialEq)]
pub struct Cycle {
    /// The label m/n: m closings of stops (impacts, and beginnings of compliant contact) in n forcing periods; `inf/n` with
    /// a complete chatter. `m/T` without forcing: m closings in one period of the motion.
    pub label: Label,
    /// The closings of each stop.
    pub counts: Vec<u32>,
    /// Its events in order, beginning with the fastest closing. Times are counted from the first event.
    pub events: Vec<Event>,
    /// The time of one period.
    pub period: f64,
    /// Floquet multipliers, the largest first: two for each coordinate, less one for each free translation, whose own is
    /// always 1. Without forcing there is one less, because that along the motion is always 1.
    pub multipliers: Vec<Multiplier>,
    /// The largest difference of a coordinate or velocity after one period, but for a translation, relative to the largest
    /// ones.
    pub residual: f64,
    /// By how much each coordinate moves on in one period: 0 in machines without free translations, and below 1e-12 of the
    /// size of the motion.
    pub drift: Vec<f64>,
    /// A state of the cycle between two events.
    pub state: Start,
    /// The states at the phase of `state`, one for each forcing period; without forcing `state` alone.
    pub(crate) strobes: Vec<Place>,
    /// The logarithms of the moduli of the multipliers; minus infinity for those that are 0.
    pub(crate) logs: Vec<f64>,
    /// The largest sizes of coordinates and velocities.
    pub(crate) sizes: (f64, f64),
    /// The rounding error of the derivative over one period, from which the multipliers come.
    pub(crate) rounding: f64,
    /// The free translations of the machine.
    pub(crate) free: Translations,
}

/// What is known of the neighbours of a cycle.
#[derive(Clone, Debug)]
pub(crate) struct Neighbours {
    pub(crate) multipliers: Vec<Multiplier>,
    /// The logarithms of their moduli.
    logs: Vec<f64>,
    /// The rounding error of the derivative over one period.
    rounding: f64,
}

impl Neighbours {
    /// Those of which the multipliers are known, of a derivative over one period with this rounding error.
    pub(crate) fn new(multipliers: Vec<Multiplier>, rounding: f64) -> Self {
        Self { logs: multipliers.iter().map(|of| ln(of.modulus())).collect(), multipliers, rounding }
    }

    /// Those of the motion over one period from `begin`.
    fn of(frame: &MachineFrame<'_>, begin: &Place, lap: &MachineLap) -> Self {
        let rounding = lap.rounding(frame);
        let Some(all) = multipliers(frame, begin, lap) else {
            let infinite = Multiplier { re: f64::INFINITY, im: 0.0 };
            return Self::new(vec![infinite; frame.multipliers()], rounding);
        };
        let logs = all.iter().map(|of| of.log).collect();
        Self { multipliers: all.into_iter().map(|of| of.multiplier).collect(), logs, rounding }
    }
}

/// What rounding leaves of no drift, relative to the motion.
const ROUNDED: f64 = 1e-12;

/// The events without the impacts of complete chatters that follow an impact on the same stop: the first ones tell them.
fn without_chatters(events: Vec<Event>) -> Vec<Event> {
    let m = events.len();
    let impact = |k: usize, stop: usize| events[k].closes() && events[k].place == stop;
    let follows = |k: usize| {
        let stop = events[k].place;
        let end = (k..k + m).map(|i| i % m).find(|i| !impact(*i, stop));
        let stuck = end.is_some_and(|end| events[end].kind == EventKind::Stick && events[end].place == stop);
        stuck && impact(k, stop) && impact((k + m - 1) % m, stop)
    };
    let kept: Vec<bool> = (0..m).map(|k| !follows(k)).collect();
    events.into_iter().zip(kept).filter_map(|(event, kept)| kept.then_some(event)).collect()
}

impl Cycle {
    /// Whether neighbours approach the cycle.
    #[must_use]
    pub fn stability(&self) -> Stability {
        Stability::of(&self.multipliers, self.rounding)
    }

    /// The same for the direction of each multiplier.
    #[must_use]
    pub fn stabilities(&self) -> Vec<Stability> {
        Stability::each(&self.multipliers, self.rounding).collect()
    }

    /// Whether the cycle attracts its neighbourhood: all multipliers lie inside the unit circle.
    #[must_use]
    pub fn stable(&self) -> bool {
        self.stability().is_stable()
    }

    /// The mean velocity of each coordinate: the drift divided by the period.
    #[must_use]
    pub fn drift_velocity(&self) -> Vec<f64> {
        self.drift.iter().map(|drift| drift / self.period).collect()
    }

    /// The number of free translations of the machine.
    #[must_use]
    pub const fn translations(&self) -> usize {
        self.free.count()
    }

    /// Whether `other` is the same motion, but for a translation: the same events in the same cyclic order, with phases and
    /// states equal to within `tolerance` of the size of the motion.
    #[must_use]
    pub fn same_as(&self, other: &Self, tolerance: f64) -> bool {
        // a touch within rounding may be told or not, and a chatter may be followed for more or fewer impacts
        let told = |cycle: &Self| -> Vec<Event> {
            let told = cycle.events.iter().filter(|event| event.kind != EventKind::Graze);
            without_chatters(told.cloned().collect())
        };
        let (a, b) = (told(self), told(other));
        if self.label != other.label || self.label.impacts != Count::Infinite && self.counts != other.counts {
            return false;
        }
        if a.len() != b.len() || a.is_empty() {
            let apart = |one: &Place, two: &Place| distance(&self.free, (one, two), self.sizes);
            let nearest = |one: &Place| other.strobes.iter().any(|two| apart(one, two) <= tolerance);
            return a.len() == b.len() && self.strobes.iter().any(nearest);
        }
        let near = |x: f64, y: f64, size: f64| (x - y).abs() <= tolerance * size.max(f64::MIN_POSITIVE);
        let (_, speed) = self.sizes;
        let rate = self.events.iter().flat_map(|event| &event.qdot).fold(speed, |most, v| most.max(v.abs()));
        let untranslated = |mut q: Vec<f64>| {
            self.free.remove_in_machine(&mut q);
            q
        };
        // at all its events a motion can be at 0, as one that rests on a stop there
        let places = self.events.iter().map(|event| &event.q).chain([&self.state.q]);
        let own = places.flat_map(|q| untranslated(q.clone()));
        // a coordinate that can be translated has the size of its way in a radian of the forcing, or of the period
        let radian =
            if self.free.is_empty() { 0.0 } else { self.period / (TAU * f64::from(self.label.periods.max(1))) };
        let size = own.fold(radian * rate, |most, q| most.max(q.abs()));
        let close = |p: &Event, q: &Event| {
            let apart = untranslated(p.q.iter().zip(&q.q).map(|(x, y)| x - y).collect());
            p.kind == q.kind
                && p.place == q.place
                && phase::difference(p.phase, q.phase).abs() <= tolerance
                && apart.into_iter().all(|apart| near(apart, 0.0, size))
                && p.qdot.iter().zip(&q.qdot).all(|(x, y)| near(*x, *y, rate))
        };
        // the same events may be counted from any of them
        (0..a.len()).any(|shift| (0..a.len()).all(|k| close(&a[k], &b[(k + shift) % b.len()])))
    }

    /// The largest speed of a closing.
    #[must_use]
    pub fn fastest(&self) -> f64 {
        self.events.iter().filter(|event| event.closes()).map(|event| event.speed).fold(0.0, f64::max)
    }

    /// The cycle that begins at a state between two events, whose motion over `n` forcing periods is `lap`; without forcing
    /// `n` is 0.
    pub(crate) fn of(
        frame: &MachineFrame<'_>,
        (begin, n): (&Place, u32),
        lap: &MachineLap,
        residual: f64,
        strobes: Vec<Place>,
    ) -> Self {
        Self::beside(frame, (begin, n), lap, (residual, strobes), Neighbours::of(frame, begin, lap))
    }

    /// The same where its neighbours are known.
    pub(crate) fn beside(
        frame: &MachineFrame<'_>,
        (begin, n): (&Place, u32),
        lap: &MachineLap,
        (residual, strobes): (f64, Vec<Place>),
        Neighbours { multipliers, logs, rounding }: Neighbours,
    ) -> Self {
        let period = lap.time;
        let mut events = lap.events.clone();
        let fastest = (0..events.len())
            .filter(|k| events[*k].closes())
            // of equally fast ones the first
            .max_by(|a, b| events[*a].speed.total_cmp(&events[*b].speed).then(b.cmp(a)));
        let first = fastest.unwrap_or(0);
        if let Some(zero) = events.get(first).map(|event| event.time) {
            for (k, event) in events.iter_mut().enumerate() {
                // those before it come again a period later
                event.time += if k < first { period - zero } else { -zero };
            }
            events.rotate_left(first);
        }
        let counts: Vec<u32> = (0..frame.machine.stops().len())
            .map(|j| {
                // stops that are struck at the same time have an event each; one on which the structure rests is pushed, and
                // does not close
                let own = lap.events.iter().filter(|event| event.closes() && event.place == j);
                u32::try_from(own.count()).unwrap_or(u32::MAX)
            })
            .collect();
        let chatter = lap.completes_chatter(frame);
        let impacts = if chatter { Count::Infinite } else { Count::Finite(counts.iter().sum()) };
        let free = frame.normal.translations.clone();
        let moved: Vec<f64> = lap.end.x.iter().zip(&begin.x).map(|(end, begin)| end - begin).collect();
        let mut drift = frame.normal.to_machine(&free.part(&moved));
        if drift.iter().all(|drift| drift.abs() <= ROUNDED * lap.sizes.0) {
            drift.fill(0.0);
        }
        Self {
            label: Label { impacts, periods: n },
            counts,
            events,
            period,
            multipliers,
            logs,
            residual,
            drift,
            state: begin.start(frame.machine, &frame.normal),
            strobes,
            sizes: lap.sizes,
            rounding,
            free,
        }
    }
}

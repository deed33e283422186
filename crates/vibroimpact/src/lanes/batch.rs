//! A batch: many motions of one oscillator, or of several, from impact to impact, without waiting for each other.
//!
//! Every flight has a slot. A round takes one step of every flight. When a contact is found, the slot is launched again
//! from the stop at once, so all lanes are used in every step, whatever the lengths of the flights. The contacts are
//! proven to be the first ([`hull`](super)). The slots whose contact the lanes cannot prove are listed as rare: grazing
//! contacts, flights that may never end, starts at rest on a stop. They are left to [`Batch::carefully`], the search of
//! [`flight`](crate::flight) from the launch, which a scalar [`Motion`](crate::motion::Motion) uses in the same cases.
//! So the impacts of a slot are those of a motion bit for bit, whatever the width of the lanes.

use super::flight::{Hit, Progress};
use super::slots::{ARRIVAL, COS, INTERVAL, Lists, PHASE, SIDE, SIN, Slots, V, X, rebound, row};
use super::stride::Stride;
use super::strike::Launch;
use super::systems::{Each, Kind, One, Oscillators};
use super::width::{Width, round_of_each};
use crate::contact::ImpactState;
use crate::contact::chatter;
use crate::flight::{Contact, Flight, SearchLimits, counted};
use crate::system::{Oscillator, Side, Start};

/// A number of motions for which the lanes are full and the data fit the nearer caches. It is the best capacity for
/// [`Batch::new`] if there are that many motions.
pub const ABREAST: usize = 1024;

/// Motions of one oscillator, followed side by side.
///
/// ```
/// use vibroimpact::{Oscillator, Start, lanes::{Batch, Width}};
/// let osc = Oscillator::from_inverse_beta(1.3, 0.75, 0.5)?;
/// let mut batch = Batch::new(&osc, 64, Width::best()).expect("its flights fit the lanes");
/// for k in 0..64 {
///     batch.push(Start { x: 0.75, v: -1.0 - 0.1 * f64::from(k), phase: 0.0 });
/// }
/// let mut impacts = 0;
/// for _ in 0..100 {
///     batch.round();
///     impacts += batch.struck().len();
///     assert!(batch.struck().iter().all(|&slot| batch.arrival(slot).0.velocity > 0.0));
/// }
/// assert!(impacts > 1000);
/// # Ok::<(), vibroimpact::SystemError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Batch {
    systems: Oscillators,
    slots: Slots,
    lists: Lists,
    rare: Vec<u32>,
    settling: Vec<u32>,
    capacity: usize,
    width: Width,
}

impl Batch {
    /// A batch for at most `capacity` motions of `osc`. `None` for oscillators whose flights the lanes cannot follow:
    /// restitution 0, forcing or damping some hundred times faster than the oscillator, stops a million static
    /// deflections away.
    #[must_use]
    pub fn new(osc: &Oscillator, capacity: usize, width: Width) -> Option<Self> {
        Some(Self::of(Oscillators::One(Box::new(One::new(osc)?)), capacity, width))
    }

    /// A batch for at most `capacity` motions, each of an oscillator of its own, which is of this kind.
    pub(crate) fn of_many(kind: Kind, capacity: usize, width: Width) -> Self {
        Self::of(Oscillators::Each(Each::new(kind, capacity)), capacity, width)
    }

    fn of(systems: Oscillators, capacity: usize, width: Width) -> Self {
        let (slots, lists) = (Slots::new(capacity), Lists::new());
        Self { systems, slots, lists, rare: Vec::new(), settling: Vec::new(), capacity, width }
    }

    /// The number of motions.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.slots.count
    }

    /// Whether the batch has no motions.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.slots.count == 0
    }

    /// The longest flight whose end the lanes can find.
    #[must_use]
    pub fn longest(&self) -> f64 {
        // one system has one longest flight
        let slots = if let Oscillators::One(_) = &self.systems { 1 } else { self.len() };
        (0..slots).map(|slot| self.stride(slot).longest()).fold(0.0, f64::max)
    }

    /// The oscillator of a slot.
    pub(crate) fn osc(&self, slot: u32) -> &Oscillator {
        &self.systems.of(slot as usize).osc
    }

    fn stride(&self, slot: usize) -> &Stride {
        &self.systems.of(slot).stride
    }

    /// Adds a motion, in the next slot.
    ///
    /// # Panics
    /// If the batch has `capacity` motions already.
    pub fn push(&mut self, start: Start) {
        self.slots.count += 1;
        self.slots.launch(self.slots.count - 1, row(start));
    }

    /// Replaces the motion in a slot.
    pub fn launch(&mut self, slot: u32, start: Start) {
        self.slots.launch(slot as usize, row(start));
    }

    /// The largest number of motions.
    pub(crate) const fn capacity(&self) -> usize {
        self.capacity
    }

    /// Adds a motion in the next slot: of this oscillator, if each has its own.
    ///
    /// # Panics
    /// If the batch has `capacity` motions already.
    pub(crate) fn push_of(&mut self, osc: &Oscillator, start: Start) {
        self.set(self.slots.count, osc);
        self.push(start);
    }

    /// Replaces the motion in a slot by one of this oscillator, if each has its own.
    pub(crate) fn launch_of(&mut self, slot: u32, osc: &Oscillator, start: Start) {
        self.set(slot as usize, osc);
        self.launch(slot, start);
    }

    fn set(&mut self, slot: usize, osc: &Oscillator) {
        if let Oscillators::Each(each) = &mut self.systems {
            each.set(slot, osc);
        }
    }

    /// Removes a motion; the one in the last slot moves to this slot.
    pub fn remove(&mut self, slot: u32) {
        self.slots.remove(slot as usize);
        if let Oscillators::Each(each) = &mut self.systems {
            each.remove(slot as usize);
        }
    }

    /// Takes one step of every flight.
    pub fn round(&mut self) {
        self.lists.clear();
        self.rare.clear();
        self.settling.clear();
        match &self.systems {
            Oscillators::One(one) => self.width.round(&mut self.slots, one, &mut self.lists),
            Oscillators::Each(each) => round_of_each(&mut self.slots, each, &mut self.lists),
        }
        // by index, because `refine` adds to other lists of `self`
        for k in 0..self.lists.left.len() {
            self.refine(self.lists.left[k]);
        }
        // after `refine`, which may have found more of them
        self.rare.extend_from_slice(&self.lists.late);
        for k in 0..self.lists.gentle.len() {
            self.sum_chatter(self.lists.gentle[k]);
        }
    }

    /// The slots with an impact in the last round, each once.
    #[must_use]
    pub fn struck(&self) -> &[u32] {
        &self.lists.struck
    }

    /// Those of them whose next leg is not a flight, because the chatter is complete or the rebound speed is zero. They
    /// must be removed or launched again.
    #[must_use]
    pub fn settling(&self) -> &[u32] {
        &self.settling
    }

    /// The slots whose flight needs [`Batch::carefully`]. They must be passed to it, removed or launched again.
    #[must_use]
    pub fn rare(&self) -> &[u32] {
        &self.rare
    }

    /// The last arrival of a slot that had an impact, and the time since the launch before it.
    #[must_use]
    pub fn arrival(&self, slot: u32) -> (ImpactState, f64) {
        let row = &self.slots.launches[slot as usize];
        let side = Side::of_sign(row[SIDE]);
        (ImpactState { phase: row[PHASE], velocity: row[ARRIVAL], side }, row[INTERVAL])
    }

    /// The state from which a slot was last launched.
    #[must_use]
    pub fn launched(&self, slot: u32) -> Start {
        let row = &self.slots.launches[slot as usize];
        Start { x: row[X], v: row[V], phase: row[PHASE] }
    }

    /// The contact of a rare flight by the careful search, which decides every case, and the number of its steps. After
    /// an impact the slot is launched again, as after an impact in a round; after any other contact it is left as it
    /// is.
    pub fn carefully(&mut self, slot: u32, limits: SearchLimits) -> (Contact, u32) {
        let flight = Flight::new(self.osc(slot), self.launched(slot));
        // the rounds have proven the flight clear up to here
        let clear = f64::from(self.slots.state(slot as usize).s);
        let (contact, steps) = counted(self.osc(slot), &flight, limits, clear);
        if let Contact::Impact { time, side, velocity } = contact {
            self.struck_at(slot, Hit { time, velocity, side: side.sign() });
        }
        (contact, steps)
    }

    /// Whether the leg after an impact of the motion in a slot is not a flight.
    #[must_use]
    pub fn settles_after(&self, slot: u32, state: &ImpactState) -> bool {
        chatter::settles_after(self.osc(slot), state)
    }

    /// Examines a step that the lanes could not decide, in halved steps.
    fn refine(&mut self, slot: u32) {
        let row = &self.slots.launches[slot as usize];
        let launch = Launch { x: row[X], v: row[V], sin: row[SIN], cos: row[COS] };
        let state = self.slots.state(slot as usize);
        let cached = self.systems.of(slot as usize).cached();
        match cached.0.refine(&launch, state, &cached, &cached) {
            Progress::Clear(on) => {
                self.slots.put(slot as usize, on);
                if self.stride(slot as usize).roughly.late(on.s) {
                    self.lists.late.push(slot);
                }
            }
            Progress::Rare => self.rare.push(slot),
            Progress::Hit(hit) => {
                self.struck_at(slot, hit);
                self.lists.struck.push(slot);
                // the round lists slow impacts as gentle itself, but this one it has not found
                self.sum_chatter(slot);
            }
        }
    }

    /// Launches a slot again after its contact.
    fn struck_at(&mut self, slot: u32, Hit { time, velocity, side }: Hit) {
        let phase = self.slots.launches[slot as usize][PHASE];
        let next = rebound(&self.stride(slot as usize).constants, phase, (time, velocity, side));
        self.slots.launch(slot as usize, next);
    }

    /// Lists a slot as settling if the leg after its impact is not a flight.
    fn sum_chatter(&mut self, slot: u32) {
        if self.settles_after(slot, &self.arrival(slot).0) {
            self.settling.push(slot);
        }
    }
}

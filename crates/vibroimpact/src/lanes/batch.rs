//! A batch: many motions of one oscillator, impact after impact, none waiting for another.
//!
//! Every flight has a slot. A round takes one step of every flight; where a contact is found the slot is launched
//! again from the stop at once, so that all lanes are at work in every step, whatever the lengths of the flights. The
//! contacts are guaranteed to be the first ([`hull`](super)). What the lanes do not claim - grazes, flights that may never
//! end, starts at rest on a stop - is listed as rare and left to [`Batch::carefully`], the search of
//! [`flight`](crate::flight) from the launch, which is what a scalar [`Motion`](crate::motion::Motion) does in the same cases. So the
//! impacts of a slot are those of a motion bit for bit, whatever the width of the lanes.

use super::flight::{Hit, Progress};
use super::slots::{ARRIVAL, COS, INTERVAL, Lists, PHASE, SIDE, SIN, Slots, V, X, rebound, row};
use super::stride::{NODES, Stride, Table};
use super::strike::Launch;
use super::width::Width;
use crate::contact::ImpactState;
use crate::contact::chatter;
use crate::flight::{Contact, Flight, SearchLimits, counted};
use crate::system::{Oscillator, Side, Start};

/// Motions under way at once that keep the lanes full and stay in the nearer caches: what [`Batch::new`] is best given where there
/// are so many.
pub const ABREAST: usize = 1024;

/// Motions of one oscillator under way.
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
    osc: Oscillator,
    stride: Stride,
    table: Table,
    slots: Slots,
    lists: Lists,
    rare: Vec<u32>,
    settling: Vec<u32>,
    width: Width,
}

impl Batch {
    /// For at most `capacity` motions of `osc`. `None` for oscillators whose flights the lanes do not fly: restitution
    /// 0, forcing or damping some hundred times faster than the oscillator, stops a million static deflections away.
    #[must_use]
    pub fn new(osc: &Oscillator, capacity: usize, width: Width) -> Option<Self> {
        let stride = Stride::new(osc)?;
        let table = Table::new(&stride);
        Some(Self {
            osc: *osc,
            stride,
            table,
            slots: Slots::new(capacity),
            lists: Lists::new(),
            rare: Vec::new(),
            settling: Vec::new(),
            width,
        })
    }

    /// How many motions are under way.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.slots.count
    }

    /// Whether there are none.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.slots.count == 0
    }

    /// The longest flight that lanes find the end of.
    #[must_use]
    pub fn longest(&self) -> f64 {
        f64::from(NODES + 3) * self.stride.pace.h
    }

    /// Adds a motion, in the next slot.
    ///
    /// # Panics
    /// Beyond the capacity.
    pub fn push(&mut self, start: Start) {
        self.slots.count += 1;
        self.slots.launch(self.slots.count - 1, row(start));
    }

    /// Puts another motion in a slot.
    pub fn launch(&mut self, slot: u32, start: Start) {
        self.slots.launch(slot as usize, row(start));
    }

    /// Takes a motion out; the one in the last slot moves into its place.
    pub fn remove(&mut self, slot: u32) {
        self.slots.remove(slot as usize);
    }

    /// One step of every flight.
    pub fn round(&mut self) {
        self.lists.clear();
        self.rare.clear();
        self.settling.clear();
        self.width.round(&mut self.slots, &self.stride, &self.table, &mut self.lists);
        for k in 0..self.lists.left.len() {
            self.refine(self.lists.left[k]);
        }
        self.rare.extend_from_slice(&self.lists.late);
        for k in 0..self.lists.gentle.len() {
            self.sum_chatter(self.lists.gentle[k]);
        }
    }

    /// The slots that struck in the last round, each once.
    #[must_use]
    pub fn struck(&self) -> &[u32] {
        &self.lists.struck
    }

    /// Those of them whose next leg is not a flight: the chatter completes, or the rebound is nothing. They have to be removed or
    /// launched anew.
    #[must_use]
    pub fn settling(&self) -> &[u32] {
        &self.settling
    }

    /// The slots whose flight was left to [`Batch::carefully`]. They have to be treated so, removed or launched anew.
    #[must_use]
    pub fn rare(&self) -> &[u32] {
        &self.rare
    }

    /// The last arrival of a slot that struck, and the time since the launch before it.
    #[must_use]
    pub fn arrival(&self, slot: u32) -> (ImpactState, f64) {
        let row = &self.slots.launches[slot as usize];
        let side = Side::of_sign(row[SIDE]);
        (ImpactState { phase: row[PHASE], velocity: row[ARRIVAL], side }, row[INTERVAL])
    }

    /// The state a slot was last launched from.
    #[must_use]
    pub fn launched(&self, slot: u32) -> Start {
        let row = &self.slots.launches[slot as usize];
        Start { x: row[X], v: row[V], phase: row[PHASE] }
    }

    /// The contact of a rare flight, by the search that decides every case, and its steps. An impact launches the slot
    /// again, as if it had struck; anything else is left as it is.
    pub fn carefully(&mut self, slot: u32, limits: SearchLimits) -> (Contact, u32) {
        let flight = Flight::new(&self.osc, self.launched(slot));
        let clear = f64::from(self.slots.state(slot as usize).s);
        let (contact, steps) = counted(&self.osc, &flight, limits, clear);
        if let Contact::Impact { time, side, velocity } = contact {
            self.struck_at(slot, Hit { time, velocity, side: side.sign() });
        }
        (contact, steps)
    }

    /// Whether the leg that follows an impact is not a flight.
    #[must_use]
    pub fn settles_after(&self, state: &ImpactState) -> bool {
        let rebound = state.rebound(&self.osc).v.abs();
        rebound == 0.0
            || chatter::completion(&self.osc, state.side, state.phase, rebound, chatter::DEFAULT_SMALLNESS).is_some()
    }

    fn refine(&mut self, slot: u32) {
        let row = &self.slots.launches[slot as usize];
        let launch = Launch { x: row[X], v: row[V], sin: row[SIN], cos: row[COS] };
        match self.stride.refine(&launch, self.slots.state(slot as usize), &self.table) {
            Progress::Clear(on) => {
                self.slots.put(slot as usize, on);
                if self.stride.late(on.s) {
                    self.lists.late.push(slot);
                }
            }
            Progress::Rare => self.rare.push(slot),
            Progress::Hit(hit) => {
                self.struck_at(slot, hit);
                self.lists.struck.push(slot);
                self.sum_chatter(slot);
            }
        }
    }

    fn struck_at(&mut self, slot: u32, Hit { time, velocity, side }: Hit) {
        let phase = self.slots.launches[slot as usize][PHASE];
        let next = rebound(&self.stride, phase, (time, velocity, side));
        self.slots.launch(slot as usize, next);
    }

    fn sum_chatter(&mut self, slot: u32) {
        if self.settles_after(&self.arrival(slot).0) {
            self.settling.push(slot);
        }
    }
}

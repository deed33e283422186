//! The systems of the flights of a batch: one for all slots, or another one in each.
//!
//! A round is compiled for one system in all lane types, with constants that stay in registers. With another system in each
//! slot it is compiled for AVX-512 only: with fewer numbers in a register it takes longer than one motion after another.

use super::constants::Constants;
use super::propagator_cache::{Cached, LAST, PropagatorCache};
use super::stride::{
    Pace, Propagators, Row, Stride, TERMS, Table, Terms, WIDEST, closed_at_node, indices, longest, series_of_each,
    whole_step,
};
use crate::math::{Lane, Numbers, Single};
use crate::system::{FormKind, Oscillator, Side, UndampedForm};

/// Where the stages of a round find the constants of the flights in their lanes.
pub(super) trait Systems {
    /// What is kept of the systems of a group of slots between the stages.
    type Group<L: Lane>: Copy;
    /// The propagators of a group.
    type Propagators<'a, L: Lane>: Propagators<L>
    where
        Self: 'a;

    /// The constants for a step of the slots from this one on.
    fn step<N: Single>(&self, first: usize) -> (Constants<N>, Pace<N>);
    /// A group of slots.
    fn group<L: Lane>(&self, slots: &[u32; WIDEST]) -> Self::Group<L>;
    /// A placeholder.
    fn nowhere<L: Lane>() -> Self::Group<L>;
    /// The constants of a group.
    fn constants<L: Lane>(&self, group: &Self::Group<L>) -> Constants<L>;
    /// The same in single precision.
    fn roughly<L: Lane>(&self, group: &Self::Group<L>) -> Constants<L::Rough>;
    /// The propagators of a group.
    fn propagators<L: Lane>(&self, group: &Self::Group<L>) -> Self::Propagators<'_, L>;
    /// The pace of a whole step of a group.
    fn pace<L: Lane>(&self, group: &Self::Group<L>) -> Pace<L>;
}

/// The oscillators of the motions of a batch.
#[derive(Clone, Debug)]
pub(super) enum Oscillators {
    One(Box<One>),
    Each(Each),
}

impl Oscillators {
    /// The system of a slot.
    #[inline]
    pub(super) fn of(&self, slot: usize) -> &OfSlot {
        match self {
            Self::One(one) => &one.system,
            Self::Each(each) => each.of(slot),
        }
    }
}

/// A system with its propagators.
#[derive(Clone, Debug)]
pub(super) struct OfSlot {
    pub(super) osc: Oscillator,
    pub(super) stride: Stride,
    cache: PropagatorCache,
}

impl OfSlot {
    fn new(osc: &Oscillator) -> Option<Self> {
        Some(Self { osc: *osc, stride: Stride::new(osc)?, cache: PropagatorCache::new() })
    }

    pub(super) const fn cached(&self) -> Cached<'_> {
        Cached(&self.stride, &self.cache)
    }
}

/// One system for all slots.
#[derive(Clone, Debug)]
pub(super) struct One {
    system: OfSlot,
    table: Table,
}

impl One {
    /// `None` if the lanes cannot follow its flights.
    pub(super) fn new(osc: &Oscillator) -> Option<Self> {
        let system = OfSlot::new(osc)?;
        Some(Self { table: Table::new(&system.stride), system })
    }
}

impl Systems for One {
    type Group<L: Lane> = ();
    type Propagators<'a, L: Lane> = &'a Self;

    #[inline(always)]
    fn step<N: Single>(&self, _: usize) -> (Constants<N>, Pace<N>) {
        (self.system.stride.constants.each(|x| N::splat(*x)), self.system.stride.pace.each(|x| N::splat(*x)))
    }
    #[inline(always)]
    fn group<L: Lane>(&self, _: &[u32; WIDEST]) {}
    #[inline(always)]
    fn nowhere<L: Lane>() {}
    #[inline(always)]
    fn constants<L: Lane>(&self, (): &()) -> Constants<L> {
        self.system.stride.constants.each(|x| L::splat(*x))
    }
    #[inline(always)]
    fn roughly<L: Lane>(&self, (): &()) -> Constants<L::Rough> {
        self.system.stride.constants.each(|x| L::Rough::splat(*x))
    }
    #[inline(always)]
    fn propagators<L: Lane>(&self, (): &()) -> &Self {
        self
    }
    #[inline(always)]
    fn pace<L: Lane>(&self, (): &()) -> Pace<L> {
        self.system.stride.pace.each(|x| L::splat(*x))
    }
}

impl<L: Lane> Propagators<L> for &One {
    #[inline(always)]
    fn node(&self, k: L) -> Row<L> {
        self.table.node(k)
    }
    #[inline(always)]
    fn rest(&self, t: L) -> Row<L> {
        self.system.stride.by_series(t)
    }
    #[inline(always)]
    fn form(&self) -> (UndampedForm<L>, L) {
        let Stride { form, constants, .. } = &self.system.stride;
        (form.splat(), L::splat(constants.h))
    }
}

/// What the systems of one batch have in common, so that the same operations serve all lanes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Kind {
    two_stops: bool,
    damped: bool,
    /// The closed form, which is used without damping.
    form: FormKind,
}

impl Kind {
    /// The kind of an oscillator, and the longest flight whose end the lanes can find; `None` if they cannot follow its
    /// flights.
    pub(crate) fn of(osc: &Oscillator) -> Option<(Self, f64)> {
        let h = whole_step(osc)?;
        let damped = osc.damping() != 0.0;
        // with damping the closed form is not used: all such systems are of one kind
        let form = if damped { FormKind::Plain } else { osc.response().undamped_form().kind };
        Some((Self { two_stops: osc.stop(Side::Lower).is_some(), damped, form }, longest(damped, h)))
    }
}

/// The numbers of rows that are in the order of the lanes.
const IN_ORDER: [u32; WIDEST] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];

/// The constants of a slot, by column: beta, 2 zeta, both gaps, both restitutions, h, margin rate, shortest time, B6, the
/// sixth derivative, the closed form.
type Columns<L> = [L; 16];

/// The constants and the pace of sixteen slots, side by side.
type Block = (Constants<[f32; WIDEST]>, [[f32; WIDEST]; 16]);

/// Another system in each slot; all are of one [`Kind`].
#[derive(Clone, Debug)]
pub(super) struct Each {
    kind: Kind,
    /// The systems of the slots.
    systems: Vec<OfSlot>,
    /// The coefficients of the series of the slots.
    series: Vec<[Terms; TERMS]>,
    rows: Vec<Columns<f64>>,
    /// The paces of the slots.
    paces: Vec<[f64; 16]>,
    /// The constants of sixteen slots side by side.
    blocks: Vec<Block>,
}

impl Each {
    /// For at most this number of slots.
    pub(super) fn new(kind: Kind, capacity: usize) -> Self {
        let blocks = capacity.div_ceil(WIDEST) + 1;
        let padded = blocks * WIDEST;
        Self {
            kind,
            systems: Vec::with_capacity(capacity),
            series: vec![[[0.0; 8]; TERMS]; padded],
            rows: vec![[0.0; 16]; padded],
            paces: vec![[0.0; 16]; padded],
            blocks: vec![Default::default(); blocks],
        }
    }

    /// Gives a slot, which may be the next one, a system of this kind.
    pub(super) fn set(&mut self, slot: usize, osc: &Oscillator) {
        // `Kind::of` has found that the lanes can follow it
        let Some(system) = OfSlot::new(osc) else { return };
        if slot == self.systems.len() {
            self.systems.push(system);
        } else {
            self.systems[slot] = system;
        }
        self.write(slot);
    }

    /// Removes a slot; the last one moves to its place.
    pub(super) fn remove(&mut self, slot: usize) {
        self.systems.swap_remove(slot);
        // the last slot is in another place now, where the lanes read its numbers
        if slot < self.systems.len() {
            self.write(slot);
        }
    }

    /// Writes the numbers of the system of a slot to where the lanes read them.
    fn write(&mut self, slot: usize) {
        let stride = &self.systems[slot].stride;
        self.series[slot] = stride.terms();
        let Stride { constants, roughly, pace, rough, form, .. } = stride;
        let Constants { beta, drag, gap, restitution, h, margin_rate, shortest, bound, sixth, .. } = *constants;
        let [a, b, c] = form.numbers;
        self.rows[slot] = [
            beta,
            drag,
            gap[0],
            gap[1],
            restitution[0],
            restitution[1],
            h,
            margin_rate,
            shortest,
            bound[0],
            bound[1],
            sixth[0],
            sixth[1],
            a,
            b,
            c,
        ];
        // a step takes neighbouring slots, so its numbers lie side by side; other stages gather theirs by rows
        let (block, lane) = (&mut self.blocks[slot / WIDEST], slot % WIDEST);
        (block.0.two_stops, block.0.damped) = (self.kind.two_stops, self.kind.damped);
        block.0.put(roughly, |numbers, number| numbers[lane] = *number);
        block.1.iter_mut().zip(rough.row()).for_each(|(numbers, number)| numbers[lane] = number);
        self.paces[slot] = pace.row();
    }

    /// The system of a slot; that of the last one for a slot beyond, which is in a lane that is not used.
    #[inline]
    fn of(&self, slot: usize) -> &OfSlot {
        &self.systems[slot.min(self.systems.len() - 1)]
    }
}

impl Systems for Each {
    type Group<L: Lane> = Group<L>;
    type Propagators<'a, L: Lane> = OfGroup<'a, L>;

    #[inline(always)]
    fn step<N: Single>(&self, first: usize) -> (Constants<N>, Pace<N>) {
        let ((constants, pace), lane) = (&self.blocks[first / WIDEST], first % WIDEST);
        let mut row = [N::splat(0.0); 16];
        let mut k = 0;
        // a loop, because a closure is not always compiled for the processor's instructions
        while k < row.len() {
            row[k] = N::load(&pace[k][lane..]);
            k += 1;
        }
        (constants.each(|numbers| N::load(&numbers[lane..])), Pace::of_row(row))
    }
    #[inline(always)]
    fn group<L: Lane>(&self, slots: &[u32; WIDEST]) -> Group<L> {
        let columns: Columns<L> = L::rows(&self.rows, slots);
        let [beta, drag, up, low, up_rest, low_rest, h, margin_rate, shortest, b0, b1, s0, s1, form @ ..] = columns;
        let one = L::splat(1.0);
        let constants = Constants {
            two_stops: self.kind.two_stops,
            damped: self.kind.damped,
            beta,
            drag,
            gap: [up, low],
            // what follows from other columns is not one of the sixteen
            bulk: [one + up.abs(), one + low.abs()],
            restitution: [up_rest, low_rest],
            h,
            margin_rate,
            shortest,
            bound: [b0, b1],
            sixth: [s0, s1],
        };
        Group { slots: *slots, constants, form: UndampedForm { kind: self.kind.form, numbers: form } }
    }
    #[inline(always)]
    fn nowhere<L: Lane>() -> Group<L> {
        let form = UndampedForm { kind: FormKind::Plain, numbers: [L::splat(0.0); 3] };
        Group { slots: [0; WIDEST], constants: Constants::<()>::default().each(|()| L::splat(0.0)), form }
    }
    #[inline(always)]
    fn constants<L: Lane>(&self, group: &Group<L>) -> Constants<L> {
        group.constants
    }
    #[inline(always)]
    fn roughly<L: Lane>(&self, group: &Group<L>) -> Constants<L::Rough> {
        group.constants.each(|x| x.rounded())
    }
    #[inline(always)]
    fn propagators<L: Lane>(&self, group: &Group<L>) -> OfGroup<'_, L> {
        OfGroup { each: self, group: *group }
    }
    #[inline(always)]
    fn pace<L: Lane>(&self, group: &Group<L>) -> Pace<L> {
        Pace::of_row(L::rows(&self.paces, &group.slots))
    }
}

/// A group of slots with systems of their own.
#[derive(Clone, Copy)]
pub(super) struct Group<L> {
    slots: [u32; WIDEST],
    constants: Constants<L>,
    form: UndampedForm<L>,
}

/// The propagators of such a group.
pub(super) struct OfGroup<'a, L> {
    each: &'a Each,
    group: Group<L>,
}

impl<L: Lane> Propagators<L> for OfGroup<'_, L> {
    #[inline(always)]
    fn node(&self, k: L) -> Row<L> {
        let constants = &self.group.constants;
        // without damping one formula serves all lanes; with it each lane reads the table of its own system
        if !constants.damped {
            return closed_at_node(&self.group.form, k * constants.h);
        }
        let which = indices(k, LAST);
        let mut rows = [[0.0; 8]; WIDEST];
        let mut lane = 0;
        while lane < L::WIDTH {
            let Cached(stride, cache) = self.each.of(self.group.slots[lane] as usize).cached();
            rows[lane] = *cache.node(stride, which[lane]);
            lane += 1;
        }
        L::rows(&rows, &IN_ORDER)
    }
    #[inline(always)]
    fn rest(&self, t: L) -> Row<L> {
        let Group { slots, constants, .. } = &self.group;
        series_of_each(self.each.series.as_flattened(), slots, constants, t)
    }
    #[inline(always)]
    fn form(&self) -> (UndampedForm<L>, L) {
        (self.group.form, self.group.constants.h)
    }
}

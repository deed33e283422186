//! Steps that are not proven clear, side by side: the slot of the flight, the time at the beginning, and the motion at
//! both ends.

use super::compaction::list;
use super::hull::End;
use super::stride::WIDEST;
use crate::math::Single;

/// The number of slots whose steps are taken before contacts are looked for.
pub(super) const SEGMENT: usize = 1024;
/// Room for all of them, and for a whole register past the last.
const ROOM: usize = SEGMENT + WIDEST;

/// Steps of flights that are not proven clear.
#[derive(Clone, Debug)]
pub(super) struct UncertainSteps {
    count: usize,
    slots: [u32; ROOM],
    /// s; x, v, a at the beginning; x, v, a at the end.
    columns: [[f32; ROOM]; 7],
}

impl UncertainSteps {
    pub(super) fn new() -> Box<Self> {
        Box::new(Self { count: 0, slots: [0; ROOM], columns: [[0.0; ROOM]; 7] })
    }

    /// Removes all steps.
    #[inline(always)]
    pub(super) fn clear(&mut self) {
        self.count = 0;
    }

    /// Adds the steps whose bits are set; the first lane has the slot `first`.
    #[inline(always)]
    pub(super) fn add<N: Single>(&mut self, bits: u32, first: usize, s: N, from: &End<N>, to: &End<N>) {
        // the count is never larger; this only removes bounds checks
        let at = self.count.min(SEGMENT);
        let values = [s, from.x, from.v, from.a, to.x, to.v, to.a];
        for (column, value) in self.columns.iter_mut().zip(values) {
            value.store_some(bits, &mut column[at..at + WIDEST]);
        }
        self.count = at + list(bits, first, &mut self.slots[at..at + WIDEST]);
    }

    /// The number of steps.
    #[inline(always)]
    pub(super) const fn len(&self) -> usize {
        self.count
    }

    /// Sixteen slots from index `first` on; those past the last step are meaningless.
    #[inline(always)]
    pub(super) fn slots(&self, first: usize) -> &[u32; WIDEST] {
        self.slots[first.min(SEGMENT)..].first_chunk().unwrap_or(&[0; WIDEST])
    }

    /// The steps from index `first` on, one for each lane: the times at the beginning, and the ends.
    #[inline(always)]
    pub(super) fn steps<N: Single>(&self, first: usize) -> (N, End<N>, End<N>) {
        let first = first.min(SEGMENT);
        // closures of the standard library are not always compiled for the processor's instructions, loops are
        let mut loaded = [N::splat(0.0); 7];
        for (loaded, column) in loaded.iter_mut().zip(&self.columns) {
            *loaded = N::load(&column[first..first + WIDEST]);
        }
        let [s, x, v, a, to_x, to_v, to_a] = loaded;
        (s, End { x, v, a }, End { x: to_x, v: to_v, a: to_a })
    }
}

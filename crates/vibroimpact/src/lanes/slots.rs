//! The flights of a batch: each has a slot in arrays that are read by lanes.

use super::compaction::list;
use super::constants::Constants;
use super::hull::MARGIN;
use super::stride::{State, WIDEST};
use super::strike::{Approach, Guess, Launch, Strike};
use super::systems::Systems;
use super::uncertain::{SEGMENT, UncertainSteps};
use crate::contact::chatter;
use crate::math::{Lane, Mask, Single, sin_cos, sin_cos_lanes};
use crate::system::{Start, phase};

/// Columns of a launch: the state, and the arrival before it (speed, time since the launch before, side).
pub(super) const X: usize = 0;
pub(super) const V: usize = 1;
pub(super) const SIN: usize = 2;
pub(super) const COS: usize = 3;
pub(super) const PHASE: usize = 4;
pub(super) const ARRIVAL: usize = 5;
pub(super) const INTERVAL: usize = 6;
pub(super) const SIDE: usize = 7;

/// The number of groups of lanes whose contacts are found stage by stage.
const GROUPS: usize = 4;

/// The slots of a round by the result of their step.
#[derive(Clone, Debug)]
pub(super) struct Lists {
    /// The step was not proven clear.
    pub(super) doubts: Box<UncertainSteps>,
    /// The flight is longer than the lanes can follow.
    pub(super) late: Vec<u32>,
    /// There was an impact, and the slot was launched again.
    pub(super) struck: Vec<u32>,
    /// Those of `struck` whose impact is so gentle that the rest of a chatter may have to be summed.
    pub(super) gentle: Vec<u32>,
    /// The step was not proven clear, and no contact was proven.
    pub(super) open: Vec<u32>,
    /// Not decided in full precision either.
    pub(super) left: Vec<u32>,
}

impl Lists {
    pub(super) fn new() -> Self {
        let (late, struck, gentle, open, left) = Default::default();
        Self { doubts: UncertainSteps::new(), late, struck, gentle, open, left }
    }

    pub(super) fn clear(&mut self) {
        for list in [&mut self.late, &mut self.struck, &mut self.gentle, &mut self.open, &mut self.left] {
            list.clear();
        }
    }
}

/// The states of sixteen flights in single precision: s, x, v, sin, cos, side by side.
type Block = [[f32; WIDEST]; 5];

/// The flights of a batch.
#[derive(Clone, Debug)]
pub(super) struct Slots {
    pub(super) count: usize,
    states: Vec<Block>,
    pub(super) launches: Vec<[f64; 8]>,
}

impl Slots {
    pub(super) fn new(capacity: usize) -> Self {
        let blocks = capacity.div_ceil(WIDEST);
        Self { count: 0, states: vec![[[0.0_f32; WIDEST]; 5]; blocks], launches: vec![[0.0; 8]; (blocks + 1) * WIDEST] }
    }

    #[inline(always)]
    pub(super) fn put(&mut self, slot: usize, State { s, x, v, sin, cos }: State<f32>) {
        let (block, lane) = (&mut self.states[slot / WIDEST], slot % WIDEST);
        for (numbers, value) in block.iter_mut().zip([s, x, v, sin, cos]) {
            numbers[lane] = value;
        }
    }

    pub(super) fn state(&self, slot: usize) -> State<f32> {
        let (block, lane) = (&self.states[slot / WIDEST], slot % WIDEST);
        let [s, x, v, sin, cos] = [0, 1, 2, 3, 4].map(|k: usize| block[k][lane]);
        State { s, x, v, sin, cos }
    }

    /// Launches `slot` with this row.
    #[inline(always)]
    pub(super) fn launch(&mut self, slot: usize, row: [f64; 8]) {
        self.launches[slot] = row;
        self.put(slot, State { s: 0.0, x: row[X], v: row[V], sin: row[SIN], cos: row[COS] }.rough());
    }

    /// Removes this slot; the last slot moves to its place.
    pub(super) fn remove(&mut self, slot: usize) {
        self.count -= 1;
        let last = self.count;
        self.put(slot, self.state(last));
        self.launches[slot] = self.launches[last];
        // the lane is computed in each round all the same: from zeros nothing grows but the time
        self.put(last, State { s: 0.0, x: 0.0, v: 0.0, sin: 0.0, cos: 0.0 });
    }

    /// Takes one step of every flight in a segment of slots. Flights whose step is not proven clear keep their state
    /// and are added to `doubts`.
    #[inline(always)]
    pub(super) fn march<N: Single>(&mut self, segment: usize, systems: &impl Systems, lists: &mut Lists) {
        let Lists { doubts, late, .. } = lists;
        doubts.clear();
        let mut first = segment * SEGMENT;
        let last = self.count.min(first + SEGMENT);
        for block in &mut self.states[first / WIDEST..last.div_ceil(WIDEST)] {
            let mut lane = 0;
            while lane < WIDEST {
                let [s, x, v, sin, cos] = block;
                let state = State {
                    s: N::load(&s[lane..]),
                    x: N::load(&x[lane..]),
                    v: N::load(&v[lane..]),
                    sin: N::load(&sin[lane..]),
                    cos: N::load(&cos[lane..]),
                };
                let (constants, pace) = systems.step::<N>(first + lane);
                let next = pace.step(state);
                // the hull of a step follows from the states at both of its ends
                let (from, to) = (constants.end(&state), constants.end(&next));
                let clear = constants.clear(&pace.scale, &from, &to, constants.margin(state.s), false);
                N::choose(clear, next.s, state.s).store(&mut s[lane..]);
                N::choose(clear, next.x, state.x).store(&mut x[lane..]);
                N::choose(clear, next.v, state.v).store(&mut v[lane..]);
                N::choose(clear, next.sin, state.sin).store(&mut sin[lane..]);
                N::choose(clear, next.cos, state.cos).store(&mut cos[lane..]);
                // lanes beyond the last slot are computed too, without effect
                let rest = last.saturating_sub(first + lane);
                let valid = if rest < N::WIDTH { (1 << rest) - 1 } else { (1 << N::WIDTH) - 1 };
                let doubtful = !clear.bits() & valid;
                if doubtful != 0 {
                    doubts.add(doubtful, first + lane, state.s, &from, &to);
                }
                // a flight that is late is only listed once its step is clear: the other lists have it otherwise
                let gone = clear.and(constants.late(next.s)).bits() & valid;
                if gone != 0 {
                    let mut more = [0; WIDEST];
                    let count = list(gone, first + lane, &mut more);
                    late.extend_from_slice(&more[..count]);
                }
                lane += N::WIDTH;
            }
            first += WIDEST;
        }
    }

    /// Proves contacts for the steps in `doubts`, and launches those slots again from the stop. Every other slot in
    /// `doubts` is added to `open`.
    #[inline(always)]
    pub(super) fn strike<L: Lane, S: Systems>(&mut self, systems: &S, lists: &mut Lists) {
        let zero = L::splat(0.0);
        let mut guess = [Guess::nowhere(); GROUPS];
        let (mut approach, mut hits) = ([Approach::nowhere(); GROUPS], [Strike::nowhere(); GROUPS]);
        let mut phases = [zero; GROUPS];
        let mut of = [S::nowhere::<L>(); GROUPS];
        let count = lists.doubts.len();
        let mut block = 0;
        while block < count {
            let groups = (count - block).div_ceil(L::WIDTH).min(GROUPS);
            // stage by stage, so that the operations of one group fill the time in which another one waits for its results
            for k in 0..groups {
                let (s, from, to) = lists.doubts.steps::<L::Rough>(block + k * L::WIDTH);
                of[k] = systems.group::<L>(lists.doubts.slots(block + k * L::WIDTH));
                let roughly = systems.roughly(&of[k]);
                guess[k] = Guess::<L>::of(&roughly.guess(roughly.h, s, &from, &to));
            }
            for k in 0..groups {
                let row = L::rows(&self.launches, lists.doubts.slots(block + k * L::WIDTH));
                phases[k] = row[PHASE];
                let launch = Launch { x: row[X], v: row[V], sin: row[SIN], cos: row[COS] };
                approach[k] = systems.constants(&of[k]).approach(&launch, &guess[k], &systems.propagators(&of[k]));
            }
            for k in 0..groups {
                hits[k] = systems.constants(&of[k]).polish(&guess[k], &approach[k]);
            }
            for k in 0..groups {
                let first = block + k * L::WIDTH;
                let (s, from, _) = lists.doubts.steps::<L::Rough>(first);
                let proven = Constants::first_roughly(&systems.roughly(&of[k]), &hits[k], s, &from);
                let slots = *lists.doubts.slots(first);
                // the last group may have lanes that are not used
                let there = (1_u32 << (count - first).min(L::WIDTH)) - 1;
                self.relaunch(&systems.constants(&of[k]), &slots, phases[k], &hits[k], proven & there, lists);
                each(!proven & there, |lane| lists.open.push(slots[lane]));
            }
            block += groups * L::WIDTH;
        }
    }

    /// Examines the steps in `open` in full precision. Those that come close to a stop and turn back continue. Those
    /// with a contact that was not guessed before are launched again. All others are added to `left`.
    #[inline(always)]
    pub(super) fn look_closer<L: Lane>(&mut self, systems: &impl Systems, lists: &mut Lists) {
        let mut open = core::mem::take(&mut lists.open);
        for few in open.chunks(L::WIDTH) {
            let at = padded(few);
            let group = systems.group::<L>(&at);
            let (constants, propagators, pace) =
                (systems.constants(&group), systems.propagators(&group), systems.pace(&group));
            let row = L::rows(&self.launches, &at);
            let launch = Launch { x: row[X], v: row[V], sin: row[SIN], cos: row[COS] };
            let s = L::load(&at.map(|slot| f64::from(self.states[slot as usize / WIDEST][0][slot as usize % WIDEST])));
            let state = constants.after_steps(&launch, s, &propagators);
            let next = pace.step(state);
            let ends = (s, constants.end(&state), constants.end(&next));
            let swing = constants.swing(&pace.scale, &ends.1, &ends.2, L::splat(MARGIN));
            let guess = constants.guess_near(pace.h, &ends, &swing);
            let strike = constants.polish(&guess, &constants.approach(&launch, &guess, &propagators));
            let clear = swing.clear.bits();
            // a step that is clear has no contact, whatever the guess has found
            let proven = swing.above.and(constants.first(&strike, s, &ends.1)).bits() & !clear;
            let there = (1_u32 << few.len()) - 1;
            let mut on = [[0.0; WIDEST]; 5];
            // the next rounds go on in single precision
            for (on, number) in on.iter_mut().zip([next.s, next.x, next.v, next.sin, next.cos]) {
                number.rounded().store(on);
            }
            let gone = constants.late(next.s).bits();
            each(clear & there, |lane| {
                let state =
                    State { s: on[0][lane], x: on[1][lane], v: on[2][lane], sin: on[3][lane], cos: on[4][lane] };
                self.put(at[lane] as usize, state);
                if gone >> lane & 1 == 1 {
                    lists.late.push(at[lane]);
                }
            });
            self.relaunch(&constants, &at, row[PHASE], &strike, proven & there, lists);
            each(!(clear | proven) & there, |lane| lists.left.push(at[lane]));
        }
        open.clear();
        lists.open = open;
    }

    /// Launches those of these slots again from the stop whose bits are set in `proven`, and adds them to `struck`.
    #[inline(always)]
    fn relaunch<L: Lane>(
        &mut self,
        constants: &Constants<L>,
        slots: &[u32; WIDEST],
        phases: L,
        hits: &Strike<L>,
        proven: u32,
        lists: &mut Lists,
    ) {
        // for all lanes; only what is proven is stored
        let next = rebound(constants, phases, (hits.time, hits.velocity, hits.side));
        let mut rows = [[0.0; 8]; WIDEST];
        L::store_rows(next, &mut rows);
        let mut rough = [[0.0; WIDEST]; 4];
        for (rough, number) in rough.iter_mut().zip([next[X], next[V], next[SIN], next[COS]]) {
            number.rounded().store(rough);
        }
        each(proven, |lane| {
            let (x, v, sin, cos) = (rough[0][lane], rough[1][lane], rough[2][lane], rough[3][lane]);
            let slot = slots[lane];
            self.launches[slot as usize] = rows[lane];
            self.put(slot as usize, State { s: 0.0, x, v, sin, cos });
            lists.struck.push(slot);
        });
        // how hard the force presses the mass against the stop where it rebounds
        let pressed = next[SIN] - next[X];
        let pressed = if constants.two_stops { hits.side * pressed } else { pressed }.max(L::splat(0.0));
        // twice the bound of a chatter that is summed: the exact test is left to the few slots that pass this one
        let soft = next[V].abs().less(L::splat(2.0 * chatter::SLOW) * pressed).bits();
        each(soft & proven, |lane| lists.gentle.push(slots[lane]));
    }
}

/// Calls `f` with the position of each set bit.
#[inline(always)]
fn each(mut bits: u32, mut f: impl FnMut(usize)) {
    while bits != 0 {
        f(bits.trailing_zeros() as usize % WIDEST);
        // clears the lowest bit that is set
        bits &= bits - 1;
    }
}

/// A few slots; the first one is repeated to fill all lanes.
#[inline(always)]
fn padded(few: &[u32]) -> [u32; WIDEST] {
    core::array::from_fn(|k| few[if k < few.len() { k } else { 0 }])
}

/// The launch after a contact, from the phase of the last launch.
#[inline(always)]
pub(super) fn rebound<L: Lane>(constants: &Constants<L>, phase: L, (time, velocity, side): (L, L, L)) -> [L; 8] {
    let phase = phase::advance_lanes(phase, constants.beta, time);
    let (sin, cos) = sin_cos_lanes(phase);
    let ([upper, lower], [high, deep]) = (constants.restitution, constants.gap);
    let (x, v) = if constants.two_stops {
        let low = side.less(L::splat(0.0));
        let speed = L::choose(low, lower, upper) * velocity;
        (L::choose(low, -deep, high), -(side * speed))
    } else {
        (high, -(upper * velocity))
    };
    [x, v, sin, cos, phase, velocity, time, side]
}

/// The row of a launch from a start.
pub(super) fn row(start: Start) -> [f64; 8] {
    let (sin, cos) = sin_cos(start.phase);
    [start.x, start.v, sin, cos, start.phase, 0.0, 0.0, 0.0]
}

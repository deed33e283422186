//! Computation of missing tiles by several threads.

use crate::clock::thread_time;
use crate::shards::LOOSE;
use crate::{Store, StoreError, order};
use core::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use rayon::prelude::*;
use std::sync::{Mutex, PoisonError};
use std::time::Instant;
use vibroimpact_study::{Control, Meter};

/// Part `index` of `of` of the tiles, counted from 1. It has every `of`-th tile, so that slow and fast tiles are
/// distributed over the parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    index: u64,
    of: u64,
}

impl Part {
    /// All tiles.
    pub const ALL: Self = Self { index: 1, of: 1 };

    /// Part `index` of `of`.
    ///
    /// # Errors
    /// [`StoreError::Part`] unless 1 <= index <= of.
    pub const fn new(index: u64, of: u64) -> Result<Self, StoreError> {
        if index >= 1 && index <= of { Ok(Self { index, of }) } else { Err(StoreError::Part { index, of }) }
    }

    const fn has(self, number: u64) -> bool {
        number % self.of == self.index - 1
    }
}

/// A part has whole shards if there are at least so many for each part; otherwise tiles.
const SHARDS_OF_A_PART: u64 = 4;

/// The result of a run, as numbers of tiles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ran {
    /// Tiles that this run computed.
    pub computed: u64,
    /// Tiles of this part that were complete before, or were completed by another process meanwhile.
    pub found: u64,
    /// Complete tiles that were damaged and have been computed again.
    pub mended: u64,
    /// Tiles that are not complete yet: those of other parts, and those for which there was no time.
    pub left: u64,
    /// Whether the time was spent before all tiles of this part were complete.
    pub spent: bool,
}

impl Store {
    /// Computes the missing tiles of a part, and concludes the store when all tiles are complete.
    ///
    /// `control.progress` is called with the number of points of this part that are done, including those done before.
    ///
    /// # Errors
    /// [`StoreError`] when stopped, or if an object cannot be read or written. Complete tiles are kept.
    pub fn run(&self, part: Part, control: &Control<'_>) -> Result<Ran, StoreError> {
        self.run_until(part, None, control)
    }

    /// The same, but no tile is begun after `until`, except the first one, so that every run gets on. Tiles that are being
    /// computed then are finished, or what is there of them is written, if they can be continued.
    ///
    /// # Errors
    /// As for [`Store::run`].
    pub fn run_until(&self, part: Part, until: Option<Instant>, control: &Control<'_>) -> Result<Ran, StoreError> {
        self.mend_descriptions()?;
        let (tiles, mine) = (self.study.grid().tiles(), self.tiles_of(part));
        let ran = self.compute(&mine, until, control);
        if let Some(costs) = &self.costs {
            costs.flush();
        }
        let ran = ran?;
        let left = if part == Part::ALL && !ran.spent { 0 } else { tiles - self.count_done()? };
        if left == 0 {
            self.conclude()?;
        }
        Ok(Ran { left, ..ran })
    }

    /// The tiles of a part.
    fn tiles_of(&self, part: Part) -> Vec<u64> {
        let shards = self.layout.shards.as_ref();
        let shards = shards.filter(|shards| shards.count() >= part.of.saturating_mul(SHARDS_OF_A_PART));
        let mine = |tile: &u64| part.has(shards.map_or(*tile, |shards| shards.of_tile(*tile)));
        (0..self.study.grid().tiles()).filter(mine).collect()
    }

    /// Number of points of a part.
    #[must_use]
    pub fn points_of(&self, part: Part) -> u64 {
        let grid = self.study.grid();
        self.tiles_of(part).into_iter().map(|tile| grid.tile(tile).points() as u64).sum()
    }

    /// Concludes the store if all tiles are complete. Returns whether they are. For callers that distribute tiles
    /// themselves.
    ///
    /// # Errors
    /// [`StoreError`] if an object cannot be read or written, or a tile is damaged.
    pub fn conclude_if_done(&self) -> Result<bool, StoreError> {
        let done = self.count_done()? == self.study.grid().tiles();
        if done {
            self.conclude()?;
        }
        Ok(done)
    }

    /// Computes those of the given tiles (in rising order) that are missing or damaged. Does not conclude the store.
    ///
    /// # Errors
    /// As for [`Store::run`].
    pub fn run_tiles(&self, mine: &[u64], control: &Control<'_>) -> Result<Ran, StoreError> {
        self.compute(mine, None, control)
    }

    /// Computes those of the given tiles (in rising order) that are missing or damaged, until the time is spent.
    fn compute(&self, mine: &[u64], until: Option<Instant>, control: &Control<'_>) -> Result<Ran, StoreError> {
        let grid = self.study.grid();
        let points = |tile: u64| grid.tile(tile).points() as u64;
        let total: u64 = mine.iter().map(|tile| points(*tile)).sum();
        let pool = control.pool()?;
        let states = pool.install(|| self.states(mine, &|| control.stopping()))?;
        let states = states.unwrap_or_else(|| vec![State::Open; mine.len()]);
        let mut open: Vec<u64> =
            mine.iter().zip(&states).filter(|(_, state)| **state != State::Whole).map(|(tile, _)| *tile).collect();
        let damaged = |tile: u64| mine.binary_search(&tile).is_ok_and(|at| states[at] == State::Damaged);
        if !open.is_empty() {
            self.same_version()?;
            open = order::tiles(grid, self.layout.shards.as_ref(), &open, std::process::id() as usize * 7919);
        }
        let before = total - open.iter().map(|tile| points(*tile)).sum::<u64>();
        let meter = Meter::new(control, before, total);
        (control.progress)(before);

        // a process that was killed may have left complete shards that were not written
        let unfinished = self.unfinished_shards(mine, &open);
        if !control.stopping() {
            unfinished.closed.iter().try_for_each(|shard| self.complete_shard(*shard).map(drop))?;
        }
        let failure: Mutex<Option<StoreError>> = Mutex::new(None);
        let failed = AtomicBool::new(false);
        let [computed, mended, elsewhere] = [const { AtomicU64::new(0) }; 3];
        let begun = AtomicUsize::new(0);
        let one = |tile: u64| -> Result<(), StoreError> {
            let part = meter.tile(points(tile));
            if !damaged(tile) && self.done(tile)? {
                elsewhere.fetch_add(1, Ordering::Relaxed);
                part.finish();
                return self.complete_if_last(&unfinished, tile);
            }
            let before = thread_time();
            // a tile that can be continued is not finished if there is no time
            let late = || self.study.continues() && until.is_some_and(|until| Instant::now() >= until);
            let tick = || part.tick() || failed.load(Ordering::Relaxed) || late();
            if let Some(columns) = self.continued(tile, &tick)? {
                let cost = thread_time().saturating_sub(before);
                self.hold(&unfinished.held, tile, &columns, cost)?;
                self.forget_begun(tile)?;
                if let Some(costs) = &self.costs {
                    costs.add(tile, cost);
                }
                computed.fetch_add(1, Ordering::Relaxed);
                mended.fetch_add(u64::from(damaged(tile)), Ordering::Relaxed);
                part.finish();
                self.complete_if_last(&unfinished, tile)?;
            }
            Ok(())
        };
        // one at a time and in order, so that a stopped run leaves gaps of at most one tile for each thread
        pool.broadcast(|_| {
            while !control.stopping() && !failed.load(Ordering::Relaxed) {
                let at = begun.fetch_add(1, Ordering::Relaxed);
                let late = at > 0 && until.is_some_and(|until| Instant::now() >= until);
                let Some(tile) = open.get(at).filter(|_| !late) else { return };
                if let Err(error) = one(*tile) {
                    failed.store(true, Ordering::Relaxed);
                    failure.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
                }
            }
        });
        let written = self.write_held(&unfinished.held);
        if let Some(error) = failure.into_inner().unwrap_or_else(PoisonError::into_inner) {
            return Err(error);
        }
        written?;
        let [computed, mended, elsewhere] = [computed, mended, elsewhere].map(AtomicU64::into_inner);
        let rest = open.len() as u64 - computed - elsewhere;
        if rest > 0 && control.stopping() {
            return Err(StoreError::Stopped(meter.kept()));
        }
        (control.progress)(if rest > 0 { meter.kept().done } else { total });
        let found = mine.len() as u64 - open.len() as u64 + elsewhere;
        let left = grid.tiles() - mine.len() as u64 + rest;
        Ok(Ran { computed, found, mended, left, spent: rest > 0 })
    }

    /// The states of the given tiles; `None` if stopped.
    pub(crate) fn states(
        &self,
        tiles: &[u64],
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Vec<State>>, StoreError> {
        if let Some(shards) = &self.layout.shards {
            return self.states_in_shards(shards, tiles, stop);
        }
        let state = |tile: &u64| if stop() { Ok(None) } else { self.state(*tile).map(Some) };
        tiles.par_iter().map(state).collect()
    }

    /// Whether a tile exists and is undamaged.
    fn state(&self, tile: u64) -> Result<State, StoreError> {
        if !self.stated(tile)? {
            // an existing but damaged status is damage too
            return Ok(if self.claimed(tile)? { State::Damaged } else { State::Open });
        }
        for field in 0..self.layout.fields.len() {
            if self.read(tile, field)?.is_none() {
                return Ok(State::Damaged);
            }
        }
        Ok(State::Whole)
    }

    /// Number of complete tiles.
    pub(crate) fn count_done(&self) -> Result<u64, StoreError> {
        let stated = || self.list(&self.layout.status.chunk_prefix());
        match &self.layout.shards {
            None => Ok(stated()?.len() as u64),
            Some(shards) => {
                // first those that wait: the status of their shard is written before they are removed
                let waiting = self.list(LOOSE)?;
                Ok(self.count_in_shards(shards, &stated()?, &waiting))
            }
        }
    }
}

/// The state of a tile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum State {
    /// Not complete.
    Open,
    /// Complete, but a chunk is missing or damaged.
    Damaged,
    /// Complete and undamaged.
    Whole,
}

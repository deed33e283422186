//! Tiles over threads. Results come back in tile order, whatever the threads did.

use core::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use rayon::prelude::*;

/// How a long run is watched and stopped.
pub struct Control<'a> {
    /// Set from outside (Ctrl-C) to stop; checked between points.
    pub stop: &'a AtomicBool,
    /// Called now and then, from any thread, with the points done so far.
    pub progress: &'a (dyn Fn(u64) + Sync),
    /// Threads to use; 0 for one per core.
    pub threads: usize,
}

impl Control<'_> {
    /// The threads asked for, up to eight per processor: more would only take memory, as each holds a tile.
    ///
    /// # Errors
    /// When the operating system refuses to start them.
    pub fn pool(&self) -> Result<rayon::ThreadPool, rayon::ThreadPoolBuildError> {
        let most = std::thread::available_parallelism().map_or(MOST_THREADS, |count| MOST_THREADS * count.get());
        rayon::ThreadPoolBuilder::new().num_threads(self.threads.min(most)).build()
    }

    /// Whether someone asked to stop.
    #[must_use]
    pub fn stopping(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

/// Threads per processor at most.
const MOST_THREADS: usize = 8;

/// Counts the points done and reports them now and then.
pub struct Meter<'a> {
    control: &'a Control<'a>,
    done: AtomicU64,
    /// Of those, the points of tiles that are finished.
    finished: AtomicU64,
    total: u64,
}

/// The points of one tile. With refinement not every point is computed; those that are not count when the tile is finished.
pub struct TileMeter<'a> {
    meter: &'a Meter<'a>,
    points: u64,
    told: AtomicU64,
}

impl TileMeter<'_> {
    /// Counts one more point; returns whether to stop.
    pub fn tick(&self) -> bool {
        if self.told.fetch_add(1, Ordering::Relaxed) < self.points {
            self.meter.tick()
        } else {
            self.meter.control.stopping()
        }
    }

    /// All of them are known.
    pub fn finish(self) {
        let told = self.told.into_inner().min(self.points);
        self.meter.add(self.points - told);
        self.meter.finished.fetch_add(self.points, Ordering::Relaxed);
    }
}

/// Points between two tellings, where there are many.
const TELL: u64 = 64;
/// Up to this number each point is reported, because each takes long.
const FEW: u64 = 512;

impl<'a> Meter<'a> {
    /// `done` of `total` points are done already, and finished.
    #[must_use]
    pub const fn new(control: &'a Control<'a>, done: u64, total: u64) -> Self {
        Self { control, done: AtomicU64::new(done), finished: AtomicU64::new(done), total }
    }

    /// For a tile of this number of points.
    pub const fn tile(&'a self, points: u64) -> TileMeter<'a> {
        TileMeter { meter: self, points, told: AtomicU64::new(0) }
    }

    /// One more; says whether to stop.
    pub fn tick(&self) -> bool {
        let now = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        if self.total <= FEW || now.is_multiple_of(TELL) || now == self.total {
            (self.control.progress)(now);
        }
        self.control.stopping()
    }

    /// So many more at once.
    fn add(&self, points: u64) {
        if points > 0 {
            let now = self.done.fetch_add(points, Ordering::Relaxed) + points;
            (self.control.progress)(now);
        }
    }

    /// How far it is in finished tiles, which are kept, as the answer to a wish to stop.
    pub fn kept(&self) -> Stopped {
        Stopped { done: self.finished.load(Ordering::Relaxed).min(self.total), total: self.total }
    }

    /// How far it is, as the answer to a wish to stop.
    pub fn stopped(&self) -> Stopped {
        Stopped { done: self.done.load(Ordering::Relaxed).min(self.total), total: self.total }
    }
}

static NEVER: AtomicBool = AtomicBool::new(false);

impl Default for Control<'_> {
    /// Never stopped, not watched, one thread per core.
    fn default() -> Self {
        Self { stop: &NEVER, progress: &|_| {}, threads: 0 }
    }
}

/// The run was stopped from outside before it was done.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("stopped after {done} of {total} points")]
pub struct Stopped {
    /// Points done.
    pub done: u64,
    /// Points asked for.
    pub total: u64,
}

/// Runs `work` over `total` points in tiles of `tile` points and returns the tiles' results in order.
///
/// `work` gets a range of points and a function to call after each of them, which says whether to stop.
///
/// # Errors
/// [`Stopped`] when the stop flag was set before all tiles were done.
pub fn tiles<T: Send>(
    total: u64,
    tile: u64,
    control: &Control<'_>,
    work: impl Fn(core::ops::Range<u64>, &(dyn Fn() -> bool + Sync)) -> T + Sync,
) -> Result<Vec<T>, Stopped> {
    let meter = Meter::new(control, 0, total);
    let tick = || meter.tick();
    let count = total.div_ceil(tile.max(1));
    let one = |k: u64| {
        let range = k * tile..((k + 1) * tile).min(total);
        (!control.stopping()).then(|| work(range, &tick))
    };
    let results: Vec<Option<T>> = match control.pool() {
        Ok(pool) => pool.install(|| (0..count).into_par_iter().map(one).collect()),
        // a system without threads, such as a browser: one tile after another
        Err(_) => (0..count).map(one).collect(),
    };
    let stopped = meter.stopped();
    if stopped.done < total || control.stopping() {
        return Err(stopped);
    }
    results.into_iter().collect::<Option<Vec<T>>>().ok_or(stopped)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_come_in_order_for_any_threads_and_the_flag_stops() {
        for threads in [1, 2, 3, 8] {
            let control = Control { threads, ..Control::default() };
            let got = tiles(1000, 7, &control, |range, tick| {
                let mut sum = 0;
                for k in range {
                    sum += k;
                    tick();
                }
                sum
            });
            let got = got.unwrap();
            assert_eq!((got.len(), got.iter().sum::<u64>(), got[0]), (143, 499_500, 21));
        }
        let stop = AtomicBool::new(false);
        let control = Control { stop: &stop, threads: 2, ..Control::default() };
        let end = tiles(1000, 10, &control, |range, tick| {
            for k in range {
                stop.fetch_or(k == 500, Ordering::Relaxed);
                if tick() {
                    break;
                }
            }
        });
        assert!(matches!(end, Err(Stopped { total: 1000, done }) if done < 1000));
    }
}

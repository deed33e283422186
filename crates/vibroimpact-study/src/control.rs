//! Tiles computed by several threads. The results are returned in tile order, independent of the threads.

use core::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use rayon::prelude::*;

/// The stop flag, the progress callback and the number of threads of a long run.
pub struct Control<'a> {
    /// Set by the caller (for example after Ctrl-C) to stop the run; read between points.
    pub stop: &'a AtomicBool,
    /// Called at intervals, from any thread, with the number of points done so far.
    pub progress: &'a (dyn Fn(u64) + Sync),
    /// Number of threads; 0 for one per core.
    pub threads: usize,
}

impl Control<'_> {
    /// The thread pool with the requested number of threads, limited to eight per processor. More threads would only
    /// use memory, because each holds a tile.
    ///
    /// # Errors
    /// If the operating system cannot start the threads.
    pub fn pool(&self) -> Result<rayon::ThreadPool, rayon::ThreadPoolBuildError> {
        let most = std::thread::available_parallelism().map_or(MOST_THREADS, |count| MOST_THREADS * count.get());
        rayon::ThreadPoolBuilder::new().num_threads(self.threads.min(most)).build()
    }

    /// Whether the stop flag is set.
    #[must_use]
    pub fn stopping(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

/// Maximum number of threads per processor.
const MOST_THREADS: usize = 8;

/// Counts the points done and reports their number at intervals.
pub struct Meter<'a> {
    control: &'a Control<'a>,
    done: AtomicU64,
    /// Of the points done, those of finished tiles.
    finished: AtomicU64,
    total: u64,
}

/// Counts the points of one tile. With refinement not every point is computed; the others are counted when the tile is
/// finished.
pub struct TileMeter<'a> {
    meter: &'a Meter<'a>,
    points: u64,
    told: AtomicU64,
}

impl TileMeter<'_> {
    /// Counts one more point. Returns whether to stop.
    pub fn tick(&self) -> bool {
        if self.told.fetch_add(1, Ordering::Relaxed) < self.points {
            self.meter.tick()
        } else {
            self.meter.control.stopping()
        }
    }

    /// Counts the tile as finished, with all points that were not counted yet.
    pub fn finish(self) {
        let told = self.told.into_inner().min(self.points);
        self.meter.add(self.points - told);
        self.meter.finished.fetch_add(self.points, Ordering::Relaxed);
    }
}

/// Number of points between two reports, for more than [`FEW`] points.
const TELL: u64 = 64;
/// Up to this number of points, each point is reported, because each may take long.
const FEW: u64 = 512;

impl<'a> Meter<'a> {
    /// A meter at which `done` of `total` points are already done and belong to finished tiles.
    #[must_use]
    pub const fn new(control: &'a Control<'a>, done: u64, total: u64) -> Self {
        Self { control, done: AtomicU64::new(done), finished: AtomicU64::new(done), total }
    }

    /// A meter for a tile of `points` points.
    pub const fn tile(&'a self, points: u64) -> TileMeter<'a> {
        TileMeter { meter: self, points, told: AtomicU64::new(0) }
    }

    /// Counts one more point. Returns whether to stop.
    pub(crate) fn tick(&self) -> bool {
        let now = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        if self.total <= FEW || now.is_multiple_of(TELL) || now == self.total {
            (self.control.progress)(now);
        }
        self.control.stopping()
    }

    /// Counts several points at once.
    fn add(&self, points: u64) {
        if points > 0 {
            let now = self.done.fetch_add(points, Ordering::Relaxed) + points;
            (self.control.progress)(now);
        }
    }

    /// The error for a stopped run whose finished tiles are kept: counts only the points of finished tiles.
    pub fn kept(&self) -> Stopped {
        Stopped { done: self.finished.load(Ordering::Relaxed).min(self.total), total: self.total }
    }

    /// The error for a stopped run: counts all points done.
    pub fn stopped(&self) -> Stopped {
        Stopped { done: self.done.load(Ordering::Relaxed).min(self.total), total: self.total }
    }
}

static NEVER: AtomicBool = AtomicBool::new(false);

impl Default for Control<'_> {
    /// Never stopped, no progress reports, one thread per core.
    fn default() -> Self {
        Self { stop: &NEVER, progress: &|_| {}, threads: 0 }
    }
}

/// The run was stopped by its caller before it was complete.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("stopped after {done} of {total} points")]
pub struct Stopped {
    /// Points done.
    pub done: u64,
    /// Total number of points.
    pub total: u64,
}

/// Runs `work` over `total` points in tiles of `tile` points and returns the tiles' results in order.
///
/// `work` is called with a range of points and a function that it must call after each point. That function returns
/// whether to stop.
///
/// # Errors
/// [`Stopped`] if the stop flag was set before all tiles were done.
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
        // on a system without threads, such as a browser, the tiles are computed one after another
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

//! The computations of the server: limits of their number and time, and their end when a request is cancelled.
//!
//! There are three kinds of places (benches) for work, so that a click is answered while tiles are computed, and a slider is followed. If a client
//! closes its connection, its work is stopped, and its place becomes free when the work has ended. So the number of
//! simultaneous computations never exceeds the number of places.

use crate::refusal::Refusal;
use axum::http::StatusCode;
use core::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use core::time::Duration;
use std::sync::Arc;
use tokio::sync::Semaphore;
use vibroimpact_study::Control;

/// The kinds of places for work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Bench {
    /// For tiles of planes; as many at a time as there are processors.
    Tiles,
    /// For answers about a point or a line.
    Answers,
    /// For coarse pictures, which have a time limit and do not wait for tiles that are being stopped.
    Pictures,
}

/// Maximum number of requests that wait for a place, for each kind.
const MOST_WAITING: usize = 64;
/// Number of simultaneous answers.
const ANSWERS: usize = 4;
/// Time limit for the work on one request: an export with every point takes minutes on a slow machine. The work of a request that is
/// dropped stops at once.
const LIMIT: Duration = Duration::from_secs(600);

/// All places for work.
pub(crate) struct Workshop {
    benches: [Arc<Semaphore>; 3],
    waiting: [AtomicUsize; 3],
    limit: Duration,
}

/// Number of processors of this machine.
pub(crate) fn processors() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// Stops the work when its request is dropped.
struct StopOnDrop(Arc<AtomicBool>);

impl Drop for StopOnDrop {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// Counts a waiting request.
struct Waiting<'a>(&'a AtomicUsize);

impl<'a> Waiting<'a> {
    fn enter(count: &'a AtomicUsize) -> Result<Self, Refusal> {
        let waiting = Self(count);
        if count.fetch_add(1, Ordering::Relaxed) < MOST_WAITING {
            Ok(waiting)
        } else {
            Err(Refusal::new(
                StatusCode::TOO_MANY_REQUESTS,
                format!("{MOST_WAITING} requests wait already\nhint: ask again when some are answered"),
            ))
        }
    }
}

impl Drop for Waiting<'_> {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}

impl Workshop {
    /// Places for this number of simultaneous tiles (0: one for each processor).
    pub(crate) fn with_threads(threads: usize) -> Self {
        Self::new(if threads == 0 { processors() } else { threads }, ANSWERS, LIMIT)
    }

    fn new(tiles: usize, answers: usize, limit: Duration) -> Self {
        let benches = [tiles, answers, 1].map(|places| Arc::new(Semaphore::new(places)));
        Self { benches, waiting: [const { AtomicUsize::new(0) }; 3], limit }
    }

    /// Runs work on `threads` threads (0 for one per processor), and reports the number of points done in `progress`.
    /// The work stops when the future is dropped.
    pub(crate) async fn run<T: Send + 'static>(
        &self,
        bench: Bench,
        threads: usize,
        progress: impl Fn(u64) + Send + Sync + 'static,
        work: impl FnOnce(&Control<'_>) -> Result<T, Refusal> + Send + 'static,
    ) -> Result<T, Refusal> {
        let place = bench as usize;
        let permit = {
            let _waiting = Waiting::enter(&self.waiting[place])?;
            // the semaphores are never closed
            self.benches[place].clone().acquire_owned().await.map_err(|_| Refusal::fault("no bench"))?
        };
        let stop = StopOnDrop(Arc::new(AtomicBool::new(false)));
        let flag = stop.0.clone();
        let worker = tokio::task::spawn_blocking(move || {
            // held until the work has really ended
            let _permit = permit;
            work(&Control { stop: &flag, progress: &progress, threads })
        });
        match tokio::time::timeout(self.limit, worker).await {
            Ok(Ok(result)) => result,
            Ok(Err(_)) => Err(Refusal::fault("the work broke off")),
            Err(_) => Err(Refusal::too_much(format!(
                "not done within {} seconds\nhint: fewer points or impacts, or `vibro run`, which resumes",
                self.limit.as_secs()
            ))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Runs until it is stopped.
    fn endless(control: &Control<'_>, ended: &AtomicBool) -> Result<(), Refusal> {
        while !control.stopping() {
            std::thread::sleep(Duration::from_millis(1));
        }
        ended.store(true, Ordering::Relaxed);
        Ok(())
    }

    #[tokio::test]
    async fn work_that_nobody_waits_for_stops_and_frees_its_bench() {
        let workshop = Workshop::new(1, 1, LIMIT);
        let ended = Arc::new(AtomicBool::new(false));
        let seen = ended.clone();
        let work = workshop.run(Bench::Tiles, 1, |_| {}, move |control| endless(control, &seen));
        assert!(tokio::time::timeout(Duration::from_millis(30), work).await.is_err(), "it does not end by itself");
        let next = workshop.run(Bench::Tiles, 1, |_| {}, |_| Ok(7));
        assert_eq!(tokio::time::timeout(Duration::from_secs(5), next).await.unwrap(), Ok(7));
        assert!(ended.load(Ordering::Relaxed));
    }

    #[tokio::test]
    async fn too_long_and_broken_off_are_said() {
        let workshop = Workshop::new(1, 1, Duration::from_millis(20));
        let ended = Arc::new(AtomicBool::new(false));
        let seen = ended.clone();
        let late = workshop.run(Bench::Answers, 1, |_| {}, move |control| endless(control, &seen)).await;
        assert_eq!(late.unwrap_err().status, StatusCode::UNPROCESSABLE_ENTITY);
        let workshop = Workshop::new(1, 1, LIMIT);
        let broken = workshop.run(Bench::Answers, 1, |_| {}, |_| -> Result<(), _> { panic!("on purpose") }).await;
        assert_eq!(broken.unwrap_err().status, StatusCode::INTERNAL_SERVER_ERROR);
        assert_eq!(workshop.run(Bench::Answers, 1, |_| {}, |_| Ok(1)).await, Ok(1), "the bench is free again");
    }

    #[tokio::test]
    async fn the_queue_has_an_end() {
        let workshop = Arc::new(Workshop::new(1, 1, LIMIT));
        let begin = || {
            let workshop = workshop.clone();
            let ended = Arc::new(AtomicBool::new(false));
            tokio::spawn(
                async move { workshop.run(Bench::Tiles, 1, |_| {}, move |control| endless(control, &ended)).await },
            )
        };
        let tasks: Vec<_> = (0..=MOST_WAITING).map(|_| begin()).collect();
        while workshop.waiting[0].load(Ordering::Relaxed) < MOST_WAITING {
            tokio::time::sleep(Duration::from_millis(1)).await;
        }
        let refused = workshop.run(Bench::Tiles, 1, |_| {}, |_| Ok(())).await;
        assert_eq!(refused.unwrap_err().status, StatusCode::TOO_MANY_REQUESTS);
        for task in tasks {
            task.abort();
        }
    }
}

//! Runs work that takes time: without the lock of the interpreter, on another thread, with a stop flag.
//!
//! Every 50 ms the calling thread checks whether Ctrl-C was pressed and calls the progress callback. Work that reads
//! the stop flag has ended when the exception is raised. Other work is abandoned after half a second.

use crate::error::Trouble;
use pyo3::prelude::*;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SendError, Sender, channel};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::Duration;
use vibroimpact_study::{Control, Stopped};

/// Time to wait for stopped work before it is abandoned.
const PATIENCE: Duration = Duration::from_millis(500);
/// Time between two checks.
const BEAT: Duration = Duration::from_millis(50);

/// How work is watched: its name, its size, its progress callback, and its number of threads.
pub(crate) struct Watch {
    pub(crate) what: &'static str,
    pub(crate) total: u64,
    /// Called with the amounts done and in total. The work stops if it returns `False`.
    pub(crate) progress: Option<Py<PyAny>>,
    pub(crate) threads: usize,
}

impl Watch {
    /// For work without progress reports.
    pub(crate) const fn alone(what: &'static str) -> Self {
        Self { what, total: 1, progress: None, threads: 1 }
    }
}

/// The data shared by the working thread and the calling thread.
#[derive(Default)]
struct Shared {
    stop: AtomicBool,
    done: AtomicU64,
}

impl Shared {
    fn working<T>(&self, threads: usize, work: impl FnOnce(&Control<'_>) -> T) -> T {
        let tell = |done| {
            self.done.fetch_max(done, Ordering::Relaxed);
        };
        work(&Control { stop: &self.stop, progress: &tell, threads })
    }
}

/// Runs work that owns all its data. If it is stopped and does not end in time, it is abandoned.
pub(crate) fn run<T: Send + 'static>(
    py: Python<'_>,
    watch: Watch,
    work: impl FnOnce(&Control<'_>) -> Result<T, Trouble> + Send + 'static,
) -> Result<T, Trouble> {
    py.detach(move || {
        let shared = Arc::new(Shared::default());
        let (sender, receiver) = channel();
        let (theirs, threads) = (Arc::clone(&shared), watch.threads);
        // sending fails if the receiver is gone; then nobody needs the result
        on_a_thread(Box::new(move || drop(sender.send(theirs.working(threads, work)))))?;
        wait(&receiver, &shared, &watch)
    })
}

/// Work for a thread.
type Job = Box<dyn FnOnce() + Send>;

/// The threads that wait for work, each of the process with this number: a process that was forked has none of its parent's.
static WAITING: Mutex<Vec<(u32, Sender<Job>)>> = Mutex::new(Vec::new());

/// Lets a thread that waits do a job, or a new one: starting a thread takes longer than many a question.
fn on_a_thread(mut job: Job) -> Result<(), Trouble> {
    let process = std::process::id();
    let next = || WAITING.lock().ok().and_then(|mut waiting| waiting.pop());
    while let Some((of, worker)) = next() {
        if of == process {
            match worker.send(job) {
                Ok(()) => return Ok(()),
                // it has ended; the job comes back
                Err(SendError(back)) => job = back,
            }
        }
    }
    let (to, jobs) = channel::<Job>();
    let own = to.clone();
    let serve = move || {
        for job in jobs {
            job();
            if let Ok(mut waiting) = WAITING.lock() {
                waiting.push((process, own.clone()));
            }
        }
    };
    thread::Builder::new().spawn(serve).map_err(|_| Trouble::Defect("starting a thread"))?;
    to.send(job).map_err(|_| Trouble::Defect("starting a thread"))
}

/// Runs work on this thread that ends at once, or that handles Ctrl-C itself.
pub(crate) fn here<T: Send>(py: Python<'_>, run: impl FnOnce() -> T + Send) -> T {
    py.detach(run)
}

/// Runs work on borrowed arrays. The work must read the stop flag, because this function waits for its end.
pub(crate) fn run_borrowing<T: Send>(
    py: Python<'_>,
    watch: Watch,
    work: impl FnOnce(&Control<'_>) -> Result<T, Trouble> + Send,
) -> Result<T, Trouble> {
    py.detach(move || {
        let shared = Shared::default();
        let (sender, receiver) = channel();
        thread::scope(|scope| {
            let (theirs, threads) = (&shared, watch.threads);
            scope.spawn(move || drop(sender.send(theirs.working(threads, work))));
            wait(&receiver, &shared, &watch)
        })
    })
}

/// Waits for the result, detached from the interpreter except during the checks.
fn wait<T>(receiver: &Receiver<Result<T, Trouble>>, shared: &Shared, watch: &Watch) -> Result<T, Trouble> {
    loop {
        match receiver.recv_timeout(BEAT) {
            Ok(Ok(result)) => {
                look(watch, watch.total)?;
                return Ok(result);
            }
            Ok(Err(trouble)) => return Err(trouble),
            Err(RecvTimeoutError::Disconnected) => return Err(Trouble::Defect(watch.what)),
            Err(RecvTimeoutError::Timeout) => {
                if let Err(trouble) = look(watch, shared.done.load(Ordering::Relaxed)) {
                    shared.stop.store(true, Ordering::Relaxed);
                    // wait so that work that reads the stop flag can end; its result is not needed any more
                    let _ = receiver.recv_timeout(PATIENCE);
                    return Err(trouble);
                }
            }
        }
    }
}

/// Checks for Ctrl-C and reports progress.
fn look(watch: &Watch, done: u64) -> Result<(), Trouble> {
    Python::attach(|py| {
        py.check_signals()?;
        let Some(progress) = &watch.progress else { return Ok(()) };
        let answer = progress.bind(py).call1((done.min(watch.total), watch.total))?;
        let stop = done < watch.total && answer.is_instance_of::<pyo3::types::PyBool>() && !answer.is_truthy()?;
        if stop { Err(Stopped { done, total: watch.total }.into()) } else { Ok(()) }
    })
}

//! The driver: divides the time among the families, watches their workers, and reports the faults.

use crate::case::kind;
use crate::limits::{self, Limits};
use crate::worker::{self, Job};
use crate::{Family, FuzzOptions};
use clap::ValueEnum;
use serde_json::Value;
use std::collections::BTreeMap;
use std::io::{self, BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Stdio};
use std::sync::Mutex;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::time::{Duration, Instant, SystemTime};

/// The result of a family.
#[derive(Clone, Debug, Default)]
pub struct FaultReport {
    /// Number of cases.
    pub cases: u64,
    /// The faults, one for each kind: the message, the number of the case, and the case.
    pub faults: BTreeMap<String, (String, u64, String)>,
}

/// Limits of a case in a worker: processor time, and wall time for one that waits.
const CASE: (f64, Duration) = (120.0, Duration::from_secs(900));
/// Memory limit of a worker.
const MEMORY: u64 = 6 << 30;
/// Number of kinds of faults after which a family is ended.
const ENOUGH: usize = 30;

/// Runs all families. `say` is called with the lines to print. Returns true if no fault was found.
///
/// # Errors
/// If no worker can be started.
pub fn run(options: &FuzzOptions, program: &Path, say: &(dyn Fn(&str) + Sync)) -> io::Result<bool> {
    let seed = options.seed.unwrap_or_else(drawn);
    let vibro = options.vibro.clone().unwrap_or_else(|| worker::beside(program));
    let families = options.only.map_or_else(|| Family::value_variants().to_vec(), |family| vec![family]);
    say(&format!("seed {seed}, about {} s, {}", options.seconds, vibro.display()));
    let jobs =
        if options.jobs == 0 { std::thread::available_parallelism().map_or(1, usize::from) } else { options.jobs };
    let jobs = jobs.clamp(1, families.len());
    let total: u32 = families.iter().map(|family| family.weight()).sum();
    #[allow(clippy::cast_precision_loss)] // a handful
    let share = |family: Family| options.seconds * jobs as f64 * f64::from(family.weight()) / f64::from(total);
    let task = |family: Family| Job {
        family,
        seed,
        from: options.case.unwrap_or(0),
        until: options.case.map_or_else(|| options.cases.unwrap_or(u64::MAX), |k| k + 1),
        seconds: share(family).min(options.seconds),
        vibro: vibro.clone(),
    };
    let waiting = Mutex::new(families.iter().rev().map(|family| task(*family)).collect::<Vec<_>>());
    let found = Mutex::new(Vec::new());
    let next = || waiting.lock().ok()?.pop();
    std::thread::scope(|scope| {
        let workers: Vec<_> = (0..jobs)
            .map(|_| {
                scope.spawn(|| {
                    while let Some(task) = next() {
                        let result = family(&task, program, say)?;
                        found.lock().map_err(|_| io::Error::other("a worker broke off"))?.push((task.family, result));
                    }
                    Ok::<(), io::Error>(())
                })
            })
            .collect();
        workers.into_iter().try_for_each(|worker| worker.join().map_err(|_| io::Error::other("a worker broke off"))?)
    })?;
    let found = found.into_inner().map_err(|_| io::Error::other("a worker broke off"))?;
    let failed = found.iter().filter(|(_, found)| !found.faults.is_empty()).count();
    for (family, found) in &found {
        say(&format!("{family}: {} cases, {} kinds of faults", found.cases, found.faults.len()));
    }
    let outcome = if failed == 0 { "ok" } else { "FAILED" };
    say(&format!("test result: {outcome}. {} passed; {failed} failed", found.len() - failed));
    Ok(failed == 0)
}

fn drawn() -> u64 {
    let since = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default();
    since.as_secs() ^ u64::from(since.subsec_nanos())
}

/// Runs a family until its time is over, in one worker after another.
fn family(task: &Job, program: &Path, say: &(dyn Fn(&str) + Sync)) -> io::Result<FaultReport> {
    let end = Instant::now() + Duration::from_secs_f64(task.seconds);
    let mut found = FaultReport::default();
    let mut from = task.from;
    loop {
        let left = end.saturating_duration_since(Instant::now()).as_secs_f64();
        if left <= 0.0 || from >= task.until || found.faults.len() >= ENOUGH {
            return Ok(found);
        }
        let part = Job { from, seconds: left, ..task.clone() };
        let mut fault = |k: u64, why: &str, case: &str| {
            found.faults.entry(kind(why)).or_insert_with(|| {
                let (family, seed) = (task.family, task.seed);
                say(&format!("\n{family}, case {k}: {why}\n{case}\nagain: cargo xtask fuzz --seed {seed} --only {family} --case {k}\n"));
                (why.to_owned(), k, case.to_owned())
            });
        };
        let ended = watch(&part, program, &mut fault)?;
        found.cases += ended.cases;
        match ended.died_at {
            None => return Ok(found),
            Some(k) => from = k + 1,
        }
    }
}

/// The end of a worker.
struct Ended {
    cases: u64,
    /// The case during which it died.
    died_at: Option<u64>,
}

fn watch(task: &Job, program: &Path, fault: &mut dyn FnMut(u64, &str, &str)) -> io::Result<Ended> {
    let limits = Limits { cpu: 1_000_000, memory: MEMORY, ..Limits::default() };
    let mut command = limits::limited(program, &limits);
    let mut child = command.arg("worker").args(task.words()).stdin(Stdio::null()).stdout(Stdio::piped()).spawn()?;
    let lines = child.stdout.take().ok_or_else(|| io::Error::other("a worker says nothing"))?;
    let (sender, received) = mpsc::channel();
    std::thread::spawn(move || {
        for line in BufReader::new(lines).lines().map_while(Result::ok) {
            if sender.send(line).is_err() {
                break;
            }
        }
    });
    let mut now: Option<(u64, String)> = None;
    let mut cases = 0;
    while let Some(line) = next(&received, &mut child, now.is_some())? {
        let Ok(line) = serde_json::from_str::<Value>(&line) else { continue };
        let text = |name: &str| line[name].as_str().unwrap_or_default();
        if let Some(k) = line["begin"].as_u64() {
            cases += 1;
            now = Some((k, text("case").to_owned()));
        } else {
            if let Some(k) = line["fault"].as_u64() {
                fault(k, text("why"), text("case"));
            }
            now = None;
        }
    }
    let killed = child.try_wait()?.is_none();
    if killed {
        child.kill()?;
    }
    let status = child.wait()?;
    if let Some((k, case)) = &now {
        let why = if killed { "it does not end".to_owned() } else { format!("the worker ended with {status}") };
        fault(*k, &why, case);
    } else if !status.success() {
        return Err(io::Error::other(format!("the worker of {} ended with {status}", task.family)));
    }
    Ok(Ended { cases, died_at: now.map(|(k, _)| k) })
}

/// The next line of a worker; `None` if it has ended, or takes too long for a case.
fn next(lines: &Receiver<String>, child: &mut Child, within: bool) -> io::Result<Option<String>> {
    let begun = Instant::now();
    let taken = limits::processor_time(child.id());
    loop {
        match lines.recv_timeout(Duration::from_millis(500)) {
            Ok(line) => return Ok(Some(line)),
            Err(RecvTimeoutError::Disconnected) => {
                child.wait()?;
                return Ok(None);
            }
            Err(RecvTimeoutError::Timeout) => {
                let now = limits::processor_time(child.id());
                let busy = now.zip(taken).is_some_and(|(now, before)| now - before > CASE.0);
                if within && (busy || begun.elapsed() > CASE.1) {
                    return Ok(None);
                }
            }
        }
    }
}

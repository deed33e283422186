//! A worker: runs the cases of one family one after another, and reports each to the driver on a line.

use crate::case::{self, Fault, Property};
use crate::{Family, command, machines, page, plan, store, verdicts};
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// The task of a worker, in the order of its words on the command line.
#[derive(Clone, Debug, PartialEq, clap::Args)]
pub struct Job {
    /// The family of the cases.
    pub family: Family,
    /// The seed of the cases.
    pub seed: u64,
    /// Number of the first case.
    pub from: u64,
    /// Number after the last case.
    pub until: u64,
    /// Time limit in seconds.
    pub seconds: f64,
    /// The command to test.
    pub vibro: PathBuf,
}

impl Job {
    /// The words from which the task is read again.
    pub(crate) fn words(&self) -> Vec<String> {
        let Self { family, seed, from, until, seconds, vibro } = self;
        let numbers = [seed.to_string(), from.to_string(), until.to_string(), seconds.to_string()];
        [family.to_string()].into_iter().chain(numbers).chain([vibro.display().to_string()]).collect()
    }
}

/// Runs the task. Each line of output is `{"begin": K, "case": ...}`, `{"end": K}` or `{"fault": K, "why": ..., "case":
/// ...}`.
///
/// # Errors
/// If temporary files cannot be created, or the output is closed.
pub fn work(task: &Job, out: &mut impl Write) -> io::Result<()> {
    case::keep_panics();
    let vibro = task.vibro.as_path();
    match task.family {
        Family::Commands => all(&mut command::Commands::new(vibro)?, task, out),
        Family::Plans => all(&mut plan::Plans, task, out),
        Family::Stores => all(&mut store::Stores::new(vibro)?, task, out),
        Family::Page => all(&mut page::Page::new()?, task, out),
        Family::Verdicts => all(&mut verdicts::Verdicts, task, out),
        Family::Machines => all(&mut machines::Machines, task, out),
    }
}

fn all<P: Property>(property: &mut P, task: &Job, out: &mut impl Write) -> io::Result<()> {
    let end = Instant::now() + Duration::from_secs_f64(task.seconds);
    let mut known = BTreeSet::new();
    // once, because to name all that can be drawn takes longer than to draw a case
    let strategy = property.strategy();
    for k in task.from..task.until {
        if Instant::now() >= end {
            break;
        }
        let mut told = Ok(());
        let from = (&strategy, case::runner(task.seed, &task.family.to_string(), k));
        let found =
            case::run(property, from, &mut known, |case| told = tell(out, &json!({ "begin": k, "case": case })));
        told?;
        match found {
            Ok(()) => tell(out, &json!({ "end": k }))?,
            Err(Fault { why, case }) => tell(out, &json!({ "fault": k, "why": why, "case": case }))?,
        }
    }
    Ok(())
}

fn tell(out: &mut impl Write, line: &Value) -> io::Result<()> {
    writeln!(out, "{line}")?;
    out.flush()
}

/// The path of `vibro` in the folder of a program.
pub(crate) fn beside(program: &Path) -> PathBuf {
    program.with_file_name(format!("vibro{}", std::env::consts::EXE_SUFFIX))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FuzzOptions;
    use crate::options::Worker;
    use clap::Parser;

    #[test]
    fn a_task_survives_its_words() {
        let task =
            Job { family: Family::Page, seed: 7, from: 3, until: u64::MAX, seconds: 1.5, vibro: "a b/vibro".into() };
        let words = ["fuzz", "worker"].map(str::to_owned).into_iter().chain(task.words());
        let Some(Worker::Worker(read)) = FuzzOptions::parse_from(words).worker else { panic!("no worker") };
        assert_eq!(read, task);
        assert_eq!(beside(Path::new("target/debug/fuzz")).parent(), Some(Path::new("target/debug")));
    }
}

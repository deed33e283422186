//! `vibro estimate`: what a study will cost, before it is begun.

use super::run::read;
use crate::args::{Budget, within};
use crate::failure::Failure;
use crate::report::status::{clock, size};
use crate::report::stored::title;
use crate::session::Session;
use clap::Args;
use serde::Serialize;
use std::path::PathBuf;
use std::time::Duration;
use vibroimpact_store::{Estimate as Found, Sampling, estimate};
use vibroimpact_study::{StudyPlan, counted};

/// What a study will cost: processor time, time on this machine, files, bytes and memory
///
/// A sample of points, spread evenly over the grid and always the same, is computed and timed. The processor time has an
/// interval of 90 %, because some points take a thousand times as long as others. Nothing is written.
#[derive(Clone, Debug, Args)]
#[command(after_help = "Example:\n  vibro estimate map.toml --threads 64")]
pub(crate) struct Estimate {
    /// The plan, TOML or JSON
    #[arg(value_name = "PLAN")]
    plan: PathBuf,

    /// Blocks of points to compute: single points, tiles of a refined study, 256 starts of a basin of one system
    #[arg(long, value_name = "N", default_value_t = 64, value_parser = within::<u32, 1, 100_000>)]
    sample: u32,

    /// End the sample after this time
    #[arg(long, value_name = "TIME", default_value = "30s", allow_hyphen_values = true)]
    budget: Budget,

    /// Print one JSON object instead of text
    #[arg(long, help_heading = "Output")]
    json: bool,
}

#[derive(Serialize)]
struct EstimateFields<'a> {
    points: u64,
    tiles: u64,
    points_sampled: u64,
    /// Processor time of the sample.
    seconds_sampled: f64,
    /// Expected processor time.
    processor_seconds: f64,
    /// Interval of 90 % of the expected processor time.
    processor_seconds_interval: [f64; 2],
    threads: usize,
    /// Expected time with these threads.
    seconds: f64,
    files: u64,
    bytes: u64,
    /// Bytes of all numbers without compression.
    bytes_raw: u64,
    memory_bytes: u64,
    plan: &'a StudyPlan,
    plan_hash: String,
}

pub(super) fn run(args: &Estimate, session: &Session) -> Result<(), Failure> {
    let plan = read(&args.plan)?;
    let sampling = Sampling { blocks: args.sample, time: args.budget.time() };
    let found = session.watched(None, |control| estimate(&plan, sampling, control))?;
    if found.sampled == 0 {
        return Err(Failure::Failed("no point of the sample was finished\nhint: a longer --budget".to_owned()));
    }
    if !args.json {
        return session.print(&text(&plan, &found));
    }
    session.print_json(&EstimateFields {
        points: found.points,
        tiles: found.tiles,
        points_sampled: found.sampled,
        seconds_sampled: found.sampled_seconds,
        processor_seconds: found.seconds,
        processor_seconds_interval: [found.interval.0, found.interval.1],
        threads: found.threads,
        seconds: found.time,
        files: found.files,
        bytes: found.bytes,
        bytes_raw: found.bytes_raw,
        memory_bytes: found.memory,
        plan: &plan,
        plan_hash: plan.canonical()?.hash(),
    })
}

fn text(plan: &StudyPlan, found: &Found) -> String {
    let time = |seconds: f64| clock(Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX));
    format!(
        "{}\n{} in {}\n\
         processor time: about {} ({} to {}), from {} that took {}\n\
         time with {}: about {}\n\
         store: {} files, about {}; without compression {}\n\
         memory: about {}\n",
        title(plan),
        counted(found.points, "point"),
        counted(found.tiles, "tile"),
        time(found.seconds),
        time(found.interval.0),
        time(found.interval.1),
        counted(found.sampled, "point"),
        time(found.sampled_seconds),
        counted(found.threads as u64, "thread"),
        time(found.time),
        found.files,
        size(found.bytes),
        size(found.bytes_raw),
        size(found.memory)
    )
}

//! `vibro estimate`: what a study will cost, before it is begun.

use super::run::read;
use crate::args::within;
use crate::failure::Failure;
use crate::report::status::{clock, size};
use crate::report::stored::title;
use crate::session::Session;
use clap::Args;
use serde::Serialize;
use std::path::PathBuf;
use std::time::Duration;
use vibroimpact_store::{Estimate as Found, Sampling, estimate};
use vibroimpact_study::typed::duration;
use vibroimpact_study::{Plan, counted};

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
    #[arg(long, value_parser = duration, value_name = "TIME", default_value = "30s", allow_hyphen_values = true)]
    budget: Duration,

    /// Print one JSON object instead of text
    #[arg(long, help_heading = "Output")]
    json: bool,
}

#[derive(Serialize)]
struct EstimateFields<'a> {
    #[serde(flatten)]
    found: Found,
    plan: &'a Plan,
    plan_hash: String,
}

pub(super) fn run(args: &Estimate, session: &Session) -> Result<(), Failure> {
    let plan = read(&args.plan)?;
    let sampling = Sampling { blocks: args.sample, time: args.budget };
    let found = session.watched(None, |control| estimate(&plan, sampling, control))?;
    if !args.json {
        return session.print(&text(&plan, &found));
    }
    let plan_hash = plan.canonical()?.hash();
    session.print_json(&EstimateFields { found, plan: &plan, plan_hash })
}

fn text(plan: &Plan, found: &Found) -> String {
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
        time(found.processor_seconds),
        time(found.processor_seconds_interval[0]),
        time(found.processor_seconds_interval[1]),
        counted(found.points_sampled, "point"),
        time(found.seconds_sampled),
        counted(found.threads as u64, "thread"),
        time(found.seconds),
        found.files,
        size(found.bytes),
        size(found.bytes_raw),
        size(found.memory_bytes)
    )
}

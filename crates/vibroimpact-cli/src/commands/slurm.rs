//! `vibro slurm`: a complete job script for a cluster with Slurm.

use super::run::{default_store, read};
use crate::args::within;
use crate::failure::Failure;
use crate::session::Session;
use clap::Args;
use std::path::{Path, PathBuf};
use vibroimpact_report::question::quoted;
use vibroimpact_study::{Study, counted};

/// Print a Slurm script that runs a study as an array of jobs
///
/// Each job fills its part of the tiles of one store; the last one completes the store. A job that was killed can be
/// submitted again.
#[derive(Clone, Debug, Args)]
#[command(
    after_help = "Example:\n  vibro slurm map.toml --store /scratch/map.zarr --jobs 32 > map.sh && sbatch map.sh"
)]
pub(crate) struct Slurm {
    /// The plan, TOML or JSON
    #[arg(value_name = "PLAN")]
    plan: PathBuf,

    /// Where the store is, on a file system all nodes see [default: the name of the plan, with .zarr]
    #[arg(long, value_name = "DIR")]
    store: Option<String>,

    /// Jobs of the array
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = within::<u64, 1, 100_000>)]
    jobs: u64,

    /// Processors of each job
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = within::<u64, 1, 1024>)]
    cpus: u64,

    /// Time limit of each job, as Slurm writes it
    #[arg(long, value_name = "TIME", default_value = "04:00:00")]
    time: String,

    /// Partition to submit to
    #[arg(long, value_name = "NAME")]
    partition: Option<String>,
}

pub(super) fn run(args: &Slurm, session: &Session) -> Result<(), Failure> {
    let plan = read(&args.plan)?;
    let tiles = Study::new(&plan)?.grid().tiles();
    if args.time.is_empty() || !args.time.bytes().all(|b| b.is_ascii_digit() || b":-".contains(&b)) {
        return Err(Failure::bad(format!(
            "time `{}` is not as Slurm writes it, for example 04:00:00 or 2-12:00:00",
            args.time
        )));
    }
    let jobs = args.jobs.min(tiles);
    if jobs < args.jobs {
        session.note(&format!("the study has {}, so the array has {}", counted(tiles, "tile"), counted(jobs, "job")));
    }
    let program = crate::program::path()?;
    let place = args.store.clone().unwrap_or_else(|| default_store(&args.plan));
    // a bucket needs no path; a folder is given by its absolute path
    let place = if place.contains("://") { place } else { whole(Path::new(&place))? };
    let partition = args.partition.as_ref().map_or_else(String::new, |name| format!("#SBATCH --partition={name}\n"));
    session.print(&format!(
        "#!/bin/bash\n\
         #SBATCH --job-name=vibro-{hash}\n\
         #SBATCH --array=1-{jobs}\n\
         #SBATCH --ntasks=1\n\
         #SBATCH --cpus-per-task={cpus}\n\
         #SBATCH --time={time}\n\
         {partition}\
         #SBATCH --output=vibro-%A_%a.log\n\
         # {title}: {tiles} in {jobs_in_words}. What is done is not done again.\n\
         set -eu\n\
         exec {program} run {plan} --store {place} \\\n  \
         --tiles \"$SLURM_ARRAY_TASK_ID/{jobs}\" --threads \"${{SLURM_CPUS_PER_TASK:-{cpus}}}\" --quiet\n",
        hash = plan.canonical()?.hash(),
        tiles = counted(tiles, "tile"),
        jobs_in_words = counted(jobs, "job"),
        cpus = args.cpus,
        time = args.time,
        title = plan.title(),
        program = quoted(&program.display().to_string()),
        plan = quoted(&whole(&args.plan)?),
        place = quoted(&place),
    ))
}

fn whole(path: &Path) -> Result<String, Failure> {
    let whole = std::path::absolute(path);
    whole.map(|path| path.display().to_string()).map_err(|error| Failure::bad(format!("`{}`: {error}", path.display())))
}

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
/// submitted again. With --requeue a job stops some time before its limit (a tenth of it, from 30 s to 30 min) and puts itself
/// into the queue again.
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
    #[arg(long, value_name = "NAME", value_parser = word)]
    partition: Option<String>,

    /// Account to charge
    #[arg(long, value_name = "NAME", value_parser = word)]
    account: Option<String>,

    /// Memory of each job, as Slurm writes it: 2000M, 8G
    #[arg(long, value_name = "SIZE", value_parser = memory)]
    memory: Option<String>,

    /// Jobs of the array that run at the same time [default: all]
    #[arg(long, value_name = "N", value_parser = within::<u64, 1, 100_000>)]
    throttle: Option<u64>,

    /// A line before the run, such as `module load gcc`; may be repeated
    #[arg(long, value_name = "LINE", value_parser = line)]
    setup: Vec<String>,

    /// Stop each job before its time limit, and put it into the queue again until its part is complete
    #[arg(long)]
    requeue: bool,
}

/// A name as Slurm accepts it.
fn word(text: &str) -> Result<String, String> {
    let plain = |c: char| c.is_alphanumeric() || "_-.,+@".contains(c);
    if !text.is_empty() && text.chars().all(plain) {
        return Ok(text.to_owned());
    }
    Err("a name has letters, digits and _ - . , + @".to_owned())
}

/// A size of memory as Slurm accepts it.
fn memory(text: &str) -> Result<String, String> {
    let (number, unit) = text.split_at(text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len()));
    match (number.parse::<u64>(), unit) {
        (Ok(1..), "" | "K" | "M" | "G" | "T") => Ok(text.to_owned()),
        _ => Err("a size is a whole number and K, M, G or T, as Slurm writes it\nhint: 8G".to_owned()),
    }
}

/// One line of a script.
fn line(text: &str) -> Result<String, String> {
    if text.contains(['\n', '\r', '\0']) {
        return Err("it is more than one line\nhint: --setup may be repeated".to_owned());
    }
    Ok(text.to_owned())
}

/// Part of its time limit that a job keeps for the tiles that it has begun and for the end, at least and at most in seconds.
const MARGIN: (u64, u64, u64) = (10, 30, 1800);

/// The seconds of a time as Slurm writes it: M, M:S, H:M:S, D-H, D-H:M or D-H:M:S.
fn seconds(text: &str) -> Option<u64> {
    let (days, rest) = match text.split_once('-') {
        Some((days, rest)) => (Some(days.parse::<u64>().ok()?), rest),
        None => (None, text),
    };
    let parts = rest.split(':').map(|part| part.parse().ok()).collect::<Option<Vec<u64>>>()?;
    let time = |h: u64, m: u64, s: u64| h.checked_mul(3600)?.checked_add(m.checked_mul(60)?)?.checked_add(s);
    let within = match (days, parts.as_slice()) {
        (None, [m]) => time(0, *m, 0),
        (None, [m, s]) => time(0, *m, *s),
        (_, [h, m, s]) => time(*h, *m, *s),
        (Some(_), [h]) => time(*h, 0, 0),
        (Some(_), [h, m]) => time(*h, *m, 0),
        _ => None,
    }?;
    days.unwrap_or(0).checked_mul(86_400)?.checked_add(within).filter(|seconds| *seconds > 0)
}

pub(super) fn run(args: &Slurm, session: &Session) -> Result<(), Failure> {
    let plan = read(&args.plan)?;
    let tiles = Study::new(&plan)?.grid().tiles();
    let Some(limit) = seconds(&args.time) else {
        return Err(Failure::bad(format!(
            "time `{}` is not as Slurm writes it, for example 04:00:00 or 2-12:00:00",
            args.time
        )));
    };
    let jobs = args.jobs.min(tiles);
    if jobs < args.jobs {
        session.note(&format!("the study has {}, so the array has {}", counted(tiles, "tile"), counted(jobs, "job")));
    }
    let program = crate::program::path()?;
    let place = args.store.clone().unwrap_or_else(|| default_store(&args.plan));
    // a bucket needs no path; a folder is given by its absolute path
    let place = if place.contains("://") { place } else { whole(Path::new(&place))? };
    let given = |flag: &str, value: Option<&String>| {
        value.map_or_else(String::new, |value| format!("#SBATCH --{flag}={value}\n"))
    };
    let mut more = given("partition", args.partition.as_ref())
        + &given("account", args.account.as_ref())
        + &given("mem", args.memory.as_ref());
    if args.requeue {
        more.push_str("#SBATCH --requeue\n#SBATCH --open-mode=append\n");
    }
    let setup: String = args.setup.iter().map(|line| format!("{line}\n")).collect();
    let throttle = args.throttle.map_or_else(String::new, |most| format!("%{most}"));
    // a job that is put into the queue again has to end before its time limit
    let (part, least, most) = MARGIN;
    let budget = limit.saturating_sub((limit / part).clamp(least, most)).max(1);
    let (exec, budget, again) =
        if args.requeue { ("", format!(" --budget {budget}s"), AGAIN) } else { ("exec ", String::new(), "") };
    session.print(&format!(
        "#!/bin/bash\n\
         #SBATCH --job-name=vibro-{hash}\n\
         #SBATCH --array=1-{jobs}{throttle}\n\
         #SBATCH --ntasks=1\n\
         #SBATCH --cpus-per-task={cpus}\n\
         #SBATCH --time={time}\n\
         {more}\
         #SBATCH --output=vibro-%A_%a.log\n\
         # {title}: {tiles} in {jobs_in_words}. What is done is not done again.\n\
         {setup}\
         set -eu\n\
         {exec}{program} run {plan} --store {place} \\\n  \
         --tiles \"$SLURM_ARRAY_TASK_ID/{jobs}\" --threads \"${{SLURM_CPUS_PER_TASK:-{cpus}}}\" --quiet{budget}{again}\n",
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

/// What a job does when the time of its run is spent, which is exit code 130.
const AGAIN: &str = " && code=0 || code=$?\n\
    if [ \"$code\" = 130 ]; then\n  \
    exec scontrol requeue \"${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID\"\n\
    fi\n\
    exit \"$code\"";

fn whole(path: &Path) -> Result<String, Failure> {
    let whole = std::path::absolute(path);
    whole.map(|path| path.display().to_string()).map_err(|error| Failure::bad(format!("`{}`: {error}", path.display())))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_slurm_accepts() {
        for (text, wanted) in [
            ("90", 5400),
            ("90:30", 5430),
            ("04:00:00", 14_400),
            ("2-12", 216_000),
            ("2-12:30", 217_800),
            ("1-00:00:01", 86_401),
        ] {
            assert_eq!(seconds(text), Some(wanted), "{text}");
        }
        for text in ["", "soon", "1;rm", "0", "1:2:3:4", "-1", "1-2-3", "99999999999999999999", "18446744073709551615"]
        {
            assert_eq!(seconds(text), None, "{text}");
        }
        assert!(["8G", "2000", "1500M"].iter().all(|text| memory(text).is_ok()));
        assert!(["", "G", "0", "-1G", "8 GB", "8g;rm", "1.5G"].iter().all(|text| memory(text).is_err()));
        assert!(word("long-jobs").is_ok() && word("").is_err() && word("a b").is_err() && word("a\n#SBATCH").is_err());
        assert!(line("module load gcc").is_ok() && line("a\nb").is_err());
    }
}

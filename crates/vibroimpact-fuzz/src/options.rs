//! The families of cases, and the options of the driver: `--seconds N --seed S`, and how to run one case again.

use crate::worker::Job;
use clap::{Parser, Subcommand, ValueEnum};
use core::fmt;
use std::path::PathBuf;

/// A family of cases: the kind of its questions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Family {
    /// Command lines.
    Commands,
    /// Plans in memory.
    Plans,
    /// Damaged stores.
    Stores,
    /// Requests to the explorer.
    Page,
    /// Starts, settled alone and in batches.
    Verdicts,
    /// Degenerate machines.
    Machines,
}

impl Family {
    /// Its share of the time, relative to those of the others.
    pub(crate) const fn weight(self) -> u32 {
        match self {
            Self::Commands => 4,
            Self::Plans | Self::Verdicts | Self::Machines => 2,
            Self::Stores | Self::Page => 1,
        }
    }
}

/// Its name on the command line.
impl fmt::Display for Family {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.to_possible_value().unwrap_or_default().get_name())
    }
}

/// Random and adversarial questions to the command, plans, stores and the explorer.
#[derive(Clone, Debug, Parser)]
#[command(name = "fuzz", bin_name = "cargo xtask fuzz")]
pub struct FuzzOptions {
    /// About how long, 1 to 86400 seconds of wall time
    #[arg(long, value_name = "N", default_value_t = 60.0, value_parser = seconds)]
    pub seconds: f64,
    /// Which cases; drawn from the clock and printed by default
    #[arg(long, value_name = "S")]
    pub seed: Option<u64>,
    /// One family; all by default
    #[arg(long, value_name = "FAMILY")]
    pub only: Option<Family>,
    /// At most N cases of each family
    #[arg(long, value_name = "N")]
    pub cases: Option<u64>,
    /// Case K alone, with --seed and --only as a fault was printed
    #[arg(long, value_name = "K", requires_all = ["seed", "only"])]
    pub case: Option<u64>,
    /// Workers at a time; one per processor by default
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    pub jobs: usize,
    /// The command to test; the one built beside this program by default
    #[arg(long, value_name = "FILE")]
    pub vibro: Option<PathBuf>,
    /// The task of a worker, which the driver starts.
    #[command(subcommand)]
    pub worker: Option<Worker>,
}

/// What the driver asks of this program.
#[derive(Clone, Debug, Subcommand)]
pub enum Worker {
    /// Runs the cases of one family
    #[command(hide = true)]
    Worker(Job),
}

/// A time in seconds.
fn seconds(text: &str) -> Result<f64, String> {
    let seconds = text.parse().ok().filter(|seconds| (1.0..=86_400.0).contains(seconds));
    seconds.ok_or_else(|| format!("seconds = {text} lies outside 1 to 86400"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_read_and_nonsense_is_named() {
        let parse = |line: &str| FuzzOptions::try_parse_from(format!("fuzz {line}").split_whitespace());
        let one = parse("--seed 7 --only plans --case 12").unwrap();
        assert_eq!((one.seed, one.only, one.case, one.seconds), (Some(7), Some(Family::Plans), Some(12), 60.0));
        for (line, sentence) in [
            ("--seconds 0", "lies outside"),
            ("--seconds nan", "lies outside"),
            ("--only everything", "commands, plans, stores, page, verdicts, machines"),
            ("--case 3", "--seed <S>"),
        ] {
            let refused = parse(line).unwrap_err().to_string();
            assert!(refused.contains(sentence), "{line}: {refused}");
        }
    }
}

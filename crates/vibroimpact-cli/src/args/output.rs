//! Options of all commands.

use super::within;
use clap::Args;

#[derive(Clone, Copy, Debug, Args)]
#[command(next_help_heading = "General")]
pub(crate) struct Globals {
    /// Threads to use, 0 for one per core; results never depend on it
    #[arg(long, global = true, value_name = "N", default_value_t = 0,
          value_parser = within::<u16, 0, 1024>)]
    pub(crate) threads: u16,

    /// No progress bar and no remarks on stderr
    #[arg(long, global = true)]
    pub(crate) quiet: bool,

    /// Replace output files that exist
    #[arg(long, global = true)]
    pub(crate) force: bool,
}

//! OUTPUT: the table, the figure and the JSON object of an answer; and the options of all commands.

use super::{FigureArgs, within};
use clap::Args;
use std::path::{Path, PathBuf};

/// The outputs of a command. A command says in its help what its table has.
#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "Output")]
pub(crate) struct OutputArgs {
    /// Write the answer as a table to this file; - for stdout
    #[arg(long, value_name = "FILE")]
    pub(crate) csv: Option<PathBuf>,

    /// Print one JSON object instead of text
    #[arg(long)]
    pub(crate) json: bool,

    /// Draw the answer into this file, .svg, .png or .pdf
    #[arg(long, value_name = "FILE")]
    pub(crate) plot: Option<PathBuf>,

    #[command(flatten)]
    pub(crate) figure: FigureArgs,
}

/// The files that a command writes, the look of its figure, and whether it prints JSON.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Files<'a> {
    pub(crate) csv: Option<&'a Path>,
    pub(crate) plot: Option<&'a Path>,
    pub(crate) look: Option<&'a FigureArgs>,
    pub(crate) json: bool,
}

impl OutputArgs {
    pub(crate) fn files(&self) -> Files<'_> {
        let (csv, plot) = (self.csv.as_deref(), self.plot.as_deref());
        Files { csv, plot, look: Some(&self.figure), json: self.json }
    }

    /// Whether a table or a figure is asked for.
    pub(crate) const fn any_file(&self) -> bool {
        self.csv.is_some() || self.plot.is_some()
    }
}

/// The options of all commands.
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

//! OUTPUT: the table, the figure and the JSON object of an answer.

use super::FigureArgs;
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

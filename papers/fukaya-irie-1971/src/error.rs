//! What can go wrong on the way to a report.

use std::path::PathBuf;
use thiserror::Error;
use vibroimpact::SystemError;
use vibroimpact_plot::PlotError;
use vibroimpact_study::{PlanError, RunError, Stopped};

/// Why there is no report.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// The folder holds files that no earlier reproduction wrote.
    #[error(
        "folder `{}` is not empty and holds no earlier reproduction\nhint: give another folder, or --force to write into this one", .0.display()
    )]
    Foreign(PathBuf),
    /// The path names a file.
    #[error("`{}` is not a folder\nhint: give the folder to write the figures into", .0.display())]
    NotAFolder(PathBuf),
    /// The folder cannot be made or read.
    #[error("folder `{}` cannot be used: {source}", path.display())]
    Unusable {
        /// The folder.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// A file could not be written.
    #[error("`{}` could not be written: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The run was stopped from outside; figures done before that are there.
    #[error("stopped before the report was complete\nhint: run it again; it starts from the beginning")]
    Stopped,
    /// A figure could not be drawn: a defect of this program.
    #[error("a figure could not be drawn: {0}")]
    Plot(#[from] PlotError),
    /// A point of the paper was refused as a system: a defect of this program.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// A motion of the paper did not do what the figure needs: a defect of this program.
    #[error("{0}")]
    Unexpected(&'static str),
}

impl Error {
    /// Whether the run was stopped through its control.
    #[must_use]
    pub const fn is_stopped(&self) -> bool {
        matches!(self, Self::Stopped)
    }

    /// Whether another folder (or force) would help.
    #[must_use]
    pub const fn is_bad_question(&self) -> bool {
        matches!(self, Self::Foreign(_) | Self::NotAFolder(_) | Self::Unusable { .. })
    }
}

impl From<Stopped> for Error {
    fn from(_: Stopped) -> Self {
        Self::Stopped
    }
}

impl From<SystemError> for Error {
    fn from(error: SystemError) -> Self {
        Self::Plan(error.into())
    }
}

impl From<RunError> for Error {
    fn from(error: RunError) -> Self {
        match error {
            RunError::Plan(plan) => Self::Plan(plan),
            RunError::Stopped(_) => Self::Stopped,
        }
    }
}

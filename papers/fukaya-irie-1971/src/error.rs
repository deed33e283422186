//! The errors of a reproduction.

use std::path::PathBuf;
use thiserror::Error;
use vibroimpact::SystemError;
use vibroimpact_plot::PlotError;
use vibroimpact_study::{PlanError, RunError, Stopped};

/// The reason why there is no report.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// The folder contains files that are not from an earlier reproduction.
    #[error(
        "folder `{}` is not empty and holds no earlier reproduction\nhint: give another folder, or --force to write into this one", .0.display()
    )]
    Foreign(PathBuf),
    /// The path is that of a file.
    #[error("`{}` is not a folder\nhint: give the folder to write the figures into", .0.display())]
    NotAFolder(PathBuf),
    /// The folder cannot be created or read.
    #[error("folder `{}` cannot be used: {source}", path.display())]
    Unusable {
        /// The folder.
        path: PathBuf,
        /// The error of the operating system.
        source: std::io::Error,
    },
    /// A file could not be written.
    #[error("`{}` could not be written: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: std::io::Error,
    },
    /// The run was stopped by its caller; complete figures are kept.
    #[error("stopped before the report was complete\nhint: run it again; it starts from the beginning")]
    Stopped,
    /// A figure could not be drawn: a defect of this program.
    #[error("a figure could not be drawn: {0}")]
    Plot(#[from] PlotError),
    /// A point of the paper was refused as a system: a defect of this program.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// A motion of the paper lacks a property that the figure needs: a defect of this program.
    #[error("{0}")]
    Unexpected(&'static str),
}

impl Error {
    /// Whether the run was stopped through its control.
    #[must_use]
    pub const fn is_stopped(&self) -> bool {
        matches!(self, Self::Stopped)
    }

    /// Whether another folder, or force, would help.
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

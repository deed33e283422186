//! The errors of commands.

use crate::hints;
use std::fmt::Display;
use std::io;
use vibroimpact_plot::PlotError;
use vibroimpact_report::{AnswerError, ReportError};
use vibroimpact_store::StoreError;
use vibroimpact_study::machine::MachineFileError;
use vibroimpact_study::{PlanError, RunError, Stopped};

/// The reason why a command did not finish. The text may have a second line, `hint: ...`.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    /// The question is invalid, or its output cannot be written to the requested place.
    #[error("{0}")]
    BadQuestion(String),
    /// The question is valid, but something outside the program failed.
    #[error("{0}")]
    Failed(String),
    /// Stopped by Ctrl-C.
    #[error("{0}")]
    Stopped(String),
    /// The reader of the output has closed the pipe. This counts as success.
    #[error("the reader of the output is gone")]
    PipeClosed,
}

impl Failure {
    pub(crate) fn bad(sentence: impl Display) -> Self {
        Self::BadQuestion(sentence.to_string())
    }

    /// The error for a failed write to `to`.
    pub(crate) fn writing(to: impl Display, error: &io::Error) -> Self {
        if error.kind() == io::ErrorKind::BrokenPipe {
            Self::PipeClosed
        } else {
            Self::Failed(format!("cannot write {to}: {error}"))
        }
    }
}

impl From<PlanError> for Failure {
    fn from(error: PlanError) -> Self {
        Self::bad(hints::worded(&error, hints::plan(&error)))
    }
}

impl From<MachineFileError> for Failure {
    fn from(error: MachineFileError) -> Self {
        Self::bad(error)
    }
}

impl From<vibroimpact::SystemError> for Failure {
    fn from(error: vibroimpact::SystemError) -> Self {
        Self::bad(hints::worded(&error, hints::system(&error)))
    }
}

impl From<Stopped> for Failure {
    fn from(error: Stopped) -> Self {
        Self::Stopped(format!("{error}; nothing was written"))
    }
}

impl From<RunError> for Failure {
    fn from(error: RunError) -> Self {
        match error {
            RunError::Plan(error) => error.into(),
            RunError::Stopped(error) => error.into(),
        }
    }
}

impl From<StoreError> for Failure {
    fn from(error: StoreError) -> Self {
        let text = hints::worded(&error, hints::store(&error));
        match error {
            StoreError::Plan(error) => error.into(),
            StoreError::Stopped(_) => Self::Stopped(format!("{error}; `vibro resume` goes on")),
            StoreError::Read { .. }
            | StoreError::Write { .. }
            | StoreError::Begin { .. }
            | StoreError::Damaged { .. }
            | StoreError::DamagedTile { .. }
            | StoreError::Threads(_) => Self::Failed(text),
            _ => Self::bad(text),
        }
    }
}

impl From<AnswerError> for Failure {
    fn from(error: AnswerError) -> Self {
        match error {
            AnswerError::Plan(error) => error.into(),
            AnswerError::Stopped(error) => error.into(),
            AnswerError::Report(error) => error.into(),
        }
    }
}

impl From<PlotError> for Failure {
    fn from(error: PlotError) -> Self {
        Self::Failed(format!("the figure failed: {error}"))
    }
}

impl From<ReportError> for Failure {
    fn from(error: ReportError) -> Self {
        match error {
            ReportError::Plot(error) => error.into(),
            _ => Self::bad(hints::worded(&error, hints::report(&error))),
        }
    }
}

//! Errors of machine files: a path or a position in the text, and what is wrong there.

use super::expression::ExpressionError;
use crate::TextError;
use thiserror::Error;
use vibroimpact::machine;
use vibroimpact::machine::MachineError;

/// A machine file that describes no machine, or a path that leads to no number.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{path}: {problem}")]
pub struct MachineFileError {
    /// The path of the number or of the part, as `stop.wall.gap`; `line 3, column 7` where the text cannot be read.
    pub path: String,
    /// What is wrong.
    pub problem: MachineProblem,
}

/// What is wrong in a machine file.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum MachineProblem {
    /// The machine is not allowed, or has no such number.
    #[error(transparent)]
    Fault(#[from] machine::Fault),
    /// An expression without a value.
    #[error(transparent)]
    Expression(#[from] ExpressionError),
    /// A part of the text that cannot be read.
    #[error("{}", .0.body())]
    Read(TextError),
    /// A number or another part that has no meaning.
    #[error("{0}")]
    Text(String),
    /// A field that is needed.
    #[error("{0} is needed")]
    Missing(&'static str),
    /// Fields of which only one may be given.
    #[error("only one of {0} may be given")]
    Several(&'static str),
    /// A field that has no meaning beside another.
    #[error("has no meaning here: {0}")]
    Foreign(&'static str),
    /// A name that stands for nothing.
    #[error("`{name}` is the name of nothing in this machine\nhint: known names are {known}")]
    Unknown {
        /// The name.
        name: String,
        /// The known names, as a list.
        known: String,
    },
    /// A name that cannot be a part of a path, or that has a meaning of its own.
    #[error(
        "`{0}` cannot be used as a name\nhint: letters, digits, _ and -, at least one; `ground` stands for the ground"
    )]
    Name(String),
    /// A name of a parameter that an expression cannot use.
    #[error(
        "`{0}` cannot be the name of a parameter\nhint: a letter, then letters, digits and _; pi, frequency and functions have a meaning of their own"
    )]
    ParameterName(String),
    /// Two parts of one kind with one name.
    #[error("the name is used twice")]
    Twice,
    /// A vector or matrix of another size.
    #[error("has {given}, and {wanted} are needed, one for each of {of}")]
    Size {
        /// The size given, as text.
        given: String,
        /// The number wanted.
        wanted: usize,
        /// What there is one for.
        of: String,
    },
    /// A file that cannot be read.
    #[error("the file `{name}` {why}")]
    File {
        /// Its name.
        name: String,
        /// Why.
        why: String,
    },
    /// A changed number that the expansion does not have.
    #[error(transparent)]
    Set(MachineError),
    /// No machine of this name.
    #[error("no such machine in the catalogue\nhint: {0}")]
    NoMachine(String),
}

impl MachineFileError {
    pub(super) fn new(path: impl Into<String>, problem: impl Into<MachineProblem>) -> Self {
        Self { path: path.into(), problem: problem.into() }
    }

    /// A number or another part that has no meaning.
    pub(super) fn text(path: impl Into<String>, what: impl Into<String>) -> Self {
        Self::new(path, MachineProblem::Text(what.into()))
    }
}

impl From<TextError> for MachineFileError {
    fn from(error: TextError) -> Self {
        Self::new(error.head().unwrap_or_else(|| "machine".to_owned()), MachineProblem::Read(error))
    }
}

impl From<MachineError> for MachineFileError {
    fn from(error: MachineError) -> Self {
        Self::new(error.path, error.fault)
    }
}

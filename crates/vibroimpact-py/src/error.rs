//! The conversion of Rust errors to Python exceptions, in one table.
//!
//! | cause | exception |
//! |---|---|
//! | the question is invalid | `QuestionError`, a `ValueError`, with the message of the command |
//! | the progress callback stopped the work | `StoppedError` |
//! | a store cannot be read, written or used | `StoreError`, an `OSError` |
//! | Ctrl-C, or an exception in the progress callback | that exception |
//! | a defect of this program | `RuntimeError` |

use pyo3::exceptions::{PyOSError, PyRuntimeError, PyValueError};
use pyo3::types::PyAnyMethods;
use pyo3::{PyErr, Python, create_exception};
use vibroimpact::SystemError;
use vibroimpact::verdict::LabelError;
use vibroimpact_report::AnswerError;
use vibroimpact_study::{PlanError, RunError, Stopped};

create_exception!(
    vibroimpact,
    QuestionError,
    PyValueError,
    "The question makes no sense; the text names the value, the allowed range and often a hint.\n\nAttributes\n----------\nname, given, least, most\n    The number that lies outside its range, and the range; None for other questions.\nhint : str or None\n    What helps."
);
create_exception!(vibroimpact, StoppedError, pyo3::exceptions::PyException, "The progress callback asked to stop.");

create_exception!(
    vibroimpact,
    StoreError,
    PyOSError,
    "A store cannot be used; the text names the place and what to do."
);

/// The reason why there is no result.
#[derive(Debug)]
pub(crate) enum Trouble {
    /// The question is invalid.
    Question(String),
    /// The question is invalid, because a number lies outside its range.
    Outside(String, Outside),
    /// The work was stopped.
    Stopped(Stopped),
    /// A store cannot be used.
    Store(String),
    /// An exception of Python.
    Raised(PyErr),
    /// A defect of this program.
    Defect(&'static str),
}

/// The ends of a range such as `1 <= starts <= 100`.
fn ends(range: &str) -> Option<(f64, f64)> {
    let number = |text: Option<&str>| text?.trim_matches([' ', '=']).parse().ok();
    let parts: Vec<&str> = range.split('<').collect();
    Some((number(parts.first().copied())?, number(parts.last().copied())?))
}

/// A number outside its range, both ends of which are given.
#[derive(Debug)]
pub(crate) struct Outside {
    name: &'static str,
    given: f64,
    range: (f64, f64),
}

impl Outside {
    fn of_system(error: &SystemError) -> Option<Self> {
        use SystemError as Of;
        let (name, given, range) = match *error {
            Of::Beta(given) => ("beta", given, (1e-15, 1e15)),
            Of::InverseBeta(given) => ("inverse_beta", given, (1e-15, 1e15)),
            Of::Gap(given) => ("gap", given, (-1e100, 1e100)),
            Of::Restitution(given) => ("restitution", given, (0.0, 1.0)),
            Of::Damping(given) => ("damping", given, (0.0, 1e15)),
            Of::BeyondStop { x, lowest, highest } => ("x", x, (lowest, highest)),
            Of::LargeStart { name, value } => (name, value, (-1e100, 1e100)),
            Of::LargePhase(given) => ("phase", given, (-1e15, 1e15)),
            Of::Quantity { name, value, range, .. } => (name, value, ends(range)?),
            _ => return None,
        };
        Some(Self { name, given, range })
    }

    fn of_plan(error: &PlanError) -> Option<Self> {
        match error {
            PlanError::System(error) => Self::of_system(error),
            PlanError::OutOfRange { name, given, range, .. } => {
                Some(Self { name, given: given.parse().ok()?, range: ends(range)? })
            }
            _ => None,
        }
    }

    /// An exception with these attributes.
    fn on(&self, py: Python<'_>, sentence: String) -> PyErr {
        let error = QuestionError::new_err(sentence);
        let value = error.value(py);
        let (least, most) = self.range;
        // a new exception takes attributes
        let _ = value.setattr("name", self.name);
        for (name, number) in [("given", self.given), ("least", least), ("most", most)] {
            let _ = value.setattr(name, number);
        }
        error
    }
}

impl Trouble {
    pub(crate) fn question(sentence: impl Into<String>) -> Self {
        Self::Question(sentence.into())
    }
}

impl From<Trouble> for PyErr {
    fn from(trouble: Trouble) -> Self {
        match trouble {
            Trouble::Question(sentence) => QuestionError::new_err(sentence),
            Trouble::Outside(sentence, outside) => Python::attach(|py| outside.on(py, sentence)),
            Trouble::Stopped(stopped) => StoppedError::new_err(stopped.to_string()),
            Trouble::Store(sentence) => StoreError::new_err(sentence),
            Trouble::Raised(error) => error,
            Trouble::Defect(what) => PyRuntimeError::new_err(format!(
                "{what} ended without a result: this is a defect of vibroimpact, not of your question\nhint: please report it with the call"
            )),
        }
    }
}

/// Hints of the command, and what they are in Python.
const HINTS: [(&str, &str); 6] = [
    ("`vibro attractors --machine` lists the stable ones", "machine.attractors() finds the stable ones"),
    ("a map over one parameter with --fields has one", "a map over one parameter with fields=[...] has one"),
    ("`vibro attractors` answers for one point", "`attractors` answers for one point"),
    (
        "--mass-kg with --stiffness-n-per-m, --frequency-hz or --contact-time-s",
        "mass with stiffness, frequency or contact_time",
    ),
    ("--restitution, --damping-ns-per-m or --damping-ratio", "restitution, damping or damping_ratio"),
    (
        "--contact-time-s and --damping-ns-per-m do not determine a stiffness\nhint: --restitution or --damping-ratio",
        "contact_time and damping do not determine a stiffness\nhint: restitution or damping_ratio",
    ),
];

/// A message in the words of Python: hints name arguments and functions, not flags.
fn in_python(text: &str) -> String {
    HINTS.iter().fold(text.to_owned(), |text, (command, python)| text.replace(command, python))
}

impl From<PlanError> for Trouble {
    fn from(error: PlanError) -> Self {
        // messages of the library name parameters only; a hint adds the argument of this package where it helps
        let hint = match &error {
            PlanError::Frequency(_) => "\nhint: beta=B or inverse_beta=X, with X = 1/B",
            PlanError::NoEvent { .. } => "\nhint: `branch` lists the events",
            PlanError::Axes { .. } => "\nhint: a mapping of names to ranges, {\"gap\": \"0:1:11\"}",
            _ => "",
        };
        let sentence = in_python(&format!("{error}{hint}"));
        match Outside::of_plan(&error) {
            Some(outside) => Self::Outside(sentence, outside),
            None => Self::Question(sentence),
        }
    }
}

impl From<SystemError> for Trouble {
    fn from(error: SystemError) -> Self {
        PlanError::System(error).into()
    }
}

impl From<LabelError> for Trouble {
    fn from(error: LabelError) -> Self {
        Self::Question(error.to_string())
    }
}

impl From<Stopped> for Trouble {
    fn from(stopped: Stopped) -> Self {
        Self::Stopped(stopped)
    }
}

impl From<RunError> for Trouble {
    fn from(error: RunError) -> Self {
        match error {
            RunError::Plan(error) => error.into(),
            RunError::Stopped(stopped) => stopped.into(),
        }
    }
}

impl From<AnswerError> for Trouble {
    fn from(error: AnswerError) -> Self {
        match error {
            AnswerError::Plan(error) => error.into(),
            AnswerError::Stopped(stopped) => stopped.into(),
            AnswerError::Report(error) => Self::Question(in_python(&error.to_string())),
        }
    }
}

impl From<vibroimpact_store::StoreError> for Trouble {
    fn from(error: vibroimpact_store::StoreError) -> Self {
        use vibroimpact_store::StoreError as Of;
        match error {
            Of::Plan(error) => error.into(),
            Of::Stopped(stopped) => stopped.into(),
            Of::Part { .. } => Self::Question(error.to_string()),
            Of::Absent(_) => Self::Store(format!("{error}\nhint: `run(plan, store)` begins one")),
            other => Self::Store(other.to_string()),
        }
    }
}

impl From<PyErr> for Trouble {
    fn from(error: PyErr) -> Self {
        Self::Raised(error)
    }
}

//! Reports of results: as JSON, as a table, as a figure and as text. The command and the local server use the same functions, so
//! their output is equal to the byte.
//!
//! All functions map values to values. They use no files, no terminal and no threads of their own.
//!
//! | idea | file |
//! |---|---|
//! | a plan, its result, and everything that is reported of it | [`answer()`], [`Answer`], [`Shown`] |
//! | what stands for a cycle on a branch of a machine without stops | [`BranchQuantity`] |
//! | the system of a question, and the units of results | [`Asked`], [`Units`] |
//! | the JSON object, the table and the text of each task, whatever the system | [`task`] |
//! | what the JSON objects have in common | [`json`] |
//! | what the tables have in common | [`Table`], [`table`] |
//! | what the texts have in common | `text` |
//! | the figures | [`figure`] |
//! | the views of a settled motion: waveform, phase portrait, multipliers, sections; a diagram with branches over it | [`scene`] |
//! | the same question as a command line and in Python | [`question`] |
//! | numbers as text | [`number`] |
//! | what varies, with its name and its unit | [`Varied`] |
//! | the errors of figures and tables | [`ReportError`] |

pub mod answer;
mod branch_quantity;
mod contact;
mod error;
pub mod figure;
pub mod json;
pub mod number;
pub mod question;
pub mod scene;
pub mod table;
pub mod task;
mod text;
mod units;
mod varied;

pub use answer::{Answer, AnswerOf, Shown, Told, answer};
pub use branch_quantity::BranchQuantity;
pub use contact::{ContactAnswer, ContactObject, ContactQuestion, Opens};
pub use error::{AnswerError, ReportError};
pub use table::Table;
pub use units::{Asked, Units};
pub use varied::{FieldName, ShownValue, Varied};

/// The name and version of the program that made a result.
pub const PROGRAM: &str = concat!("vibro ", env!("CARGO_PKG_VERSION"));

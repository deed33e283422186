//! What a result says: as JSON, as a table, as a figure. The command and the local server tell it with the same functions,
//! so that both say the same, to the byte.
//!
//! Values in, values out: no files, no terminal, no threads of its own.
//!
//! | idea | file |
//! |---|---|
//! | a plan, its result, and everything that is reported of it | [`answer()`], [`Answer`], [`Shown`] |
//! | the system asked about, and the units of results | [`Asked`], [`Units`] |
//! | the JSON objects of the commands, one file for each | [`json`] |
//! | the rows of their tables | [`Table`], [`table`] |
//! | their figures | [`figure`] |
//! | the views of a settled motion: waveform, phase portrait, multipliers, sections; a diagram with branches over it | [`scene`] |
//! | the same question as a command line and in Python | [`question`] |
//! | numbers as text | [`number`] |
//! | what cannot be drawn or tabulated | [`ReportError`] |

pub mod answer;
mod error;
pub mod figure;
pub mod json;
pub mod number;
pub mod question;
pub mod scene;
pub mod table;
mod units;

pub use answer::{Answer, AnswerError, Shown, answer};
pub use error::ReportError;
pub use table::Table;
pub use units::{Asked, Units};

/// Which program made a result.
pub const PROGRAM: &str = concat!("vibro ", env!("CARGO_PKG_VERSION"));

//! Machines as they are written: TOML files, short forms, a catalogue, and the numbers in them by path.
//!
//! A description expands to the matrices of [`vibroimpact::machine::Machine`]. All short forms are translated in one
//! place, `expand`; what follows knows matrices and directions only.
//!
//! | idea | file |
//! |---|---|
//! | a machine file: parameters, a machine, changed numbers | [`MachineSource`], `source` |
//! | from text to a source | `read` |
//! | the table `[machine]` | [`WrittenMachine`], `text` |
//! | a number or an expression of the parameters | [`NumberText`], `number`, `expression` |
//! | vectors, matrices, and tables that keep their order | [`VectorText`], [`MatrixText`], [`Named`] |
//! | what names stand for: coordinates, bodies, points, the ground | `places` |
//! | the matrices | `expand`, `structure` |
//! | from the matrices back to a table | `back` |
//! | the numbers of a table by path | `written` |
//! | modes from a table of numbers | `modes` |
//! | some of its numbers varied | `varied` |
//! | a body in SI units, which is a machine of one coordinate by other names; its numbers | [`Body`], [`BodyNumber`] |
//! | where a machine begins | [`StartText`], `start`, `start_axis`, `starting` |
//! | named machines of the literature | [`CATALOGUE`], `catalogue` |
//! | errors | [`MachineFileError`], [`MachineProblem`] |

mod back;
pub(crate) mod body;
mod body_number;
mod catalogue;
mod error;
mod expand;
mod expression;
mod modes;
mod named;
mod number;
mod places;
mod read;
mod shapes;
mod source;
mod start;
mod start_axis;
mod starting;
mod structure;
mod text;
mod varied;
mod write;
mod written;

pub use body::Body;
pub use body_number::BodyNumber;
pub use catalogue::{CATALOGUE, CatalogueEntry};
pub use error::{MachineFileError, MachineProblem};
pub use expression::ExpressionError;
pub use named::Named;
pub use number::NumberText;
pub use read::no_files;
pub use shapes::{MatrixText, VectorText};
pub use source::MachineSource;
pub use start::{ContactText, ContactWord, StartText, contact_word};
pub(crate) use start_axis::StartAxis;
pub use text::{
    ForceText, FrictionText, ImpactsText, LinkText, ModeText, MotionText, OpeningText, StopText, WrittenMachine,
};
pub(crate) use varied::VariedMachine;
pub(crate) use write::headed_toml;

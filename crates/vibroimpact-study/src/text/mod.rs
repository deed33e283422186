//! Plans and machine files as text: TOML or JSON, one value, and from it what is asked for.
//!
//! | idea | file |
//! |---|---|
//! | a text and its value; errors with a path and a position | [`Document`], `document` |
//! | what TOML and JSON have in common | [`Value`], `value` |
//! | from a value to a plan, with the path of what is wrong | `reader` |
//! | the position of a path in the text | [`TextPlace`], `place` |
//! | errors | [`TextError`], `error` |

mod document;
mod error;
mod place;
mod reader;
mod value;

pub(crate) use document::Document;
pub use error::TextError;
pub use place::TextPlace;
pub(crate) use value::{Table, Value};

#[cfg(test)]
mod tests;

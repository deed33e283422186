//! Numbers and ranges as people type them: what is understood, and what was probably meant by a text that is refused.

mod number;
mod range;

pub use number::{decimal, meant, numbers, shifted};
pub use range::range_hint;

//! Numbers, ranges and times as people type them: what is understood, and what was probably meant by a text that is refused.

mod duration;
mod number;
mod range;

pub use duration::duration;
pub use number::{decimal, meant, numbers, shifted};
pub use range::range_hint;

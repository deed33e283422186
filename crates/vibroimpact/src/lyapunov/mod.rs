//! Lyapunov exponents along impacts: how small differences grow.
//!
//! | idea | file |
//! |---|---|
//! | how neighbours move: flight and saltation | [`tangent`] |
//! | error bars of a correlated run | `blocks` |
//! | exponents along impacts, as verdicts measure them | [`lyapunov`] |

pub(crate) mod blocks;
mod measure;
pub mod tangent;

pub(crate) use measure::Measure;
pub use measure::{Measured, Spectrum, lyapunov};

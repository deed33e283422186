//! Lyapunov exponents along impacts: the growth of small differences.
//!
//! | idea | file |
//! |---|---|
//! | how neighbouring motions separate: flight and saltation | [`tangent`] |
//! | error bars of a correlated run | `blocks` |
//! | exponents along impacts, as measured for verdicts | [`lyapunov`] |

pub(crate) mod blocks;
mod measure;
pub mod tangent;

pub(crate) use measure::Measure;
pub use measure::{Measured, Spectrum, lyapunov};

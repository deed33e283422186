//! Lyapunov exponents along a motion: the growth of small differences.
//!
//! | idea | file |
//! |---|---|
//! | exponents and their error bars | [`Spectrum`], `blocks` |
//! | tangent vectors, of any system | `frame` |
//! | how neighbouring motions of an oscillator separate: flight and saltation | [`tangent`] |
//! | a measurement of exponents in progress, of any system | `run` |
//! | exponents along impacts, as measured for verdicts on an oscillator | [`lyapunov`] |
//! | the last impacts of a run, from which the quantities of chaos are measured | [`Tail`] |

pub(crate) mod blocks;
mod frame;
mod measure;
mod run;
mod spectrum;
mod tail;
pub mod tangent;

pub(crate) use frame::{Frame, Stretch};
pub(crate) use measure::Measure;
pub use measure::lyapunov;
pub(crate) use run::Run;
pub use spectrum::{Measured, Spectrum};
pub use tail::{Arrivals, MEASURED_IMPACTS, Tail};

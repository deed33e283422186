//! Lyapunov exponents along impacts: the growth of small differences.
//!
//! | idea | file |
//! |---|---|
//! | how neighbouring motions separate: flight and saltation | [`tangent`] |
//! | error bars of a correlated run | `blocks` |
//! | exponents along impacts, as measured for verdicts | [`lyapunov`] |
//! | exponents along the motion of a machine | `of_machine` |
//! | the last impacts of a run, from which the quantities of chaos are measured | [`Tail`] |

pub(crate) mod blocks;
mod measure;
mod of_machine;
mod tail;
pub mod tangent;

pub(crate) use measure::Measure;
use measure::TRANSIENT;
pub use measure::{Measured, Spectrum, lyapunov};
pub(crate) use of_machine::MachineMeasure;
pub use of_machine::MachineSpectrum;
pub use tail::{Arrivals, MEASURED_IMPACTS, Tail};

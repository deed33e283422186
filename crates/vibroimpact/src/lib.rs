//! Vibro-impact dynamics: oscillators that strike stops.
pub mod chaos;
pub mod contact;
pub mod flight;
pub mod math;
pub mod motion;
pub mod orbit;
pub mod scenario;
pub mod system;
pub mod verdict;

pub use system::{Frequency, Machine, Oscillator, Scales, Side, Start, Stop, SystemError};
pub use verdict::Label;

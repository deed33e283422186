//! Vibro-impact dynamics: oscillators that strike stops.
pub mod contact;
pub mod flight;
pub mod math;
pub mod motion;
pub mod system;

pub use system::{Frequency, Machine, Oscillator, Scales, Side, Start, Stop, SystemError};

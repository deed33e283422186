//! Machine files: what they expand to, that the expansion reads as the same machine, that wrong files are explained, and
//! the machines of the catalogue.
#![allow(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

mod broken;
mod cases;
mod catalogue;
mod numbers;
mod refusals;
mod round_trip;
mod short_forms;

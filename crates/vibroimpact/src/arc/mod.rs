//! Arcs: the flight of a machine in one regime, and the first event that ends it.
//!
//! | idea | file |
//! |---|---|
//! | the modes from a state, at any time | `flight` |
//! | what drives the modes | `drive` |
//! | the same where there are no modes | `dense`, `dense_series` |
//! | whether a flight ends at all | `never` |
//! | what becomes of it in the long run | `steady` |
//! | whether a sum of harmonics stays above a level | `harmonic_sum` |
//! | how small changes of the state move | `transition` |
//! | the same with the digits of those that decay | `graded_flight` |
//! | plain crossings, by samples of the guards | `crossing` |
//! | guards as polynomials over a window | `guard_polynomial` |
//! | guards over a window by the series of the structure | `expansion` |
//! | first zeros of polynomials | `polynomial` |
//! | what a search finds, and its memory | `found` |
//! | proof of a zero, and its time | `zero` |
//! | the first zero of any guard, which misses none | `search` |

mod crossing;
mod dense;
mod dense_series;
mod drive;
mod expansion;
mod flight;
mod found;
mod graded_flight;
mod guard_polynomial;
mod harmonic_sum;
mod never;
mod polynomial;
mod search;
mod steady;
mod transition;
mod zero;

pub(crate) use flight::{Begin, FIRST_ORDERS, GapStart, IDLE, MachineFlight, Modes, ORDERS, Recovery};
pub(crate) use found::{Buffers, Found, Touch};
pub(crate) use graded_flight::combined;
pub(crate) use search::first_event;

//! Arcs: the flight of a machine in one regime, and the first event that ends it.
//!
//! | idea | file |
//! |---|---|
//! | the modes from a state, at any time | `flight` |
//! | what drives the modes | `drive` |
//! | the same where there are no modes | `dense` |
//! | windows that are passed without the closed form | `track` |
//! | first zeros of polynomials | `polynomial` |
//! | the first zero of any guard, which misses none | `search` |

mod dense;
mod drive;
mod flight;
mod polynomial;
mod search;
mod track;

pub(crate) use flight::{Begin, MachineFlight, Recovery};
pub(crate) use search::{Buffers, Found, Touch, first_event};

//! Flight: the motion between impacts, and its end.
//!
//! | idea | file |
//! |---|---|
//! | free and forced response for every $`\beta`$ and $`\zeta`$ | [`Response`], in `system` |
//! | the arc from a state | [`Flight`] |
//! | the first contact | [`Contact`] |
//! | what is known before the search: no contact for ever, or how far to search | [`Horizon`] |
//! | the times at which it can reach a stop | `reach` |
//! | the search for the first contact, which misses none | [`first_contact`], `search` |
//! | integrals over a flight: work, loss in the damper, mean squares | [`FlightIntegrals`] |
//! | extremes over a flight: position, speed, acceleration | [`Extremes`] |

mod arc;
mod bounds;
mod contact;
mod extremes;
mod first_contact;
mod first_hit;
mod horizon;
mod integrals;
mod reach;
mod search;

pub use crate::system::{Propagator, Response};
pub use arc::{Flight, FlightPoint};
pub use contact::Contact;
pub(crate) use extremes::Ceiling;
pub use extremes::{Extreme, Extremes};
pub(crate) use first_contact::counted;
pub use first_contact::first_contact;
pub use horizon::{Horizon, SearchLimits};
pub(crate) use integrals::PANEL;
pub use integrals::{FlightIntegrals, integrate};

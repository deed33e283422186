//! Flight: the motion between impacts, and when it ends.
//!
//! | idea | file |
//! |---|---|
//! | free and forced response for every $`\beta`$ and $`\zeta`$ | [`Response`], in `system` |
//! | the arc from a state | [`Flight`] |
//! | what it meets first | [`Contact`] |
//! | what can be said before searching: never, or how far to look | [`Horizon`] |
//! | when it can reach a stop at all | `reach` |
//! | the first contact, never missed, and the search for it | [`first_contact`], `search` |

mod arc;
mod bounds;
mod contact;
mod first_contact;
mod horizon;
mod reach;
mod search;

pub use crate::system::{Propagator, Response};
pub use arc::{Flight, FlightPoint};
pub use contact::Contact;
pub(crate) use first_contact::counted;
pub use first_contact::first_contact;
pub use horizon::{Horizon, SearchLimits};

//! Motion: one event after another, and the maps that take one to the next.
//!
//! | idea | file |
//! |---|---|
//! | what can happen | [`Event`] |
//! | the events of a motion, one by one, and the legs between them | [`Motion`], [`Leg`] |
//! | from one impact to the next, with its derivative | [`impact_map`] |
//! | from one forcing period to the next | [`stroboscopic_map`] |
//! | the states at one phase, period after period | [`Strobes`] |
//! | points of the waveform, for eyes | [`sample`] |

mod event;
mod impact_map;
mod legs;
mod sample;
mod strobes;
mod stroboscopic;

pub use crate::contact::ImpactState;
pub use event::{End, Event, EventKind};
pub use impact_map::{MAX_TOUCHES, Mapped, derivative, impact_map};
pub use legs::{Leg, Motion, Path};
pub use sample::{Sample, sample};
pub use strobes::Strobes;
pub use stroboscopic::{Strobe, stroboscopic_map};

//! Motion: the events one after another, and the maps from one to the next.
//!
//! | idea | file |
//! |---|---|
//! | the events | [`Event`] |
//! | the events of a motion in order, and the legs between them | [`Motion`], [`Leg`] |
//! | many motions side by side; the events of each | `abreast`, [`record_events`] |
//! | from one impact to the next, with its derivative; at several impacts side by side | [`impact_map`], `derivatives` |
//! | from one forcing period to the next | [`stroboscopic_map`] |
//! | the states at one phase of the force, once in every period | [`Strobes`] |
//! | the states at given times | [`states_at`] |
//! | the crossings of a position | [`Level`] |
//! | points of the waveform, for display | [`sample`] |

mod abreast;
mod crossings;
mod derivatives;
mod event;
mod impact_map;
mod legs;
mod many;
mod sample;
mod states;
mod strobes;
mod stroboscopic;

pub use crate::contact::ImpactState;
pub(crate) use abreast::{Abreast, Launched, Recorder};
pub use crossings::{Crossing, Level};
pub(crate) use derivatives::{ABREAST, derivatives};
pub use event::{End, Event, EventKind};
pub(crate) use impact_map::ImpactMap;
pub use impact_map::{MAX_TOUCHES, Mapped, derivative, impact_map};
pub use legs::{Leg, Motion, Path};
pub use many::{EventRecorder, record_events};
pub use sample::{Sample, sample};
pub use states::states_at;
pub use strobes::Strobes;
pub use stroboscopic::{Strobe, stroboscopic_map};

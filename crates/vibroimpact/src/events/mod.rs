//! Events of machines: impacts and contacts, rest, friction, in order.
//!
//! | idea | file |
//! |---|---|
//! | an event, a start, the end of a motion | [`Event`], [`Start`], [`End`] |
//! | a start put onto the stops that it lies beyond | [`Start::within_stops`], `within` |
//! | the laws of impact at one stop and at several, impacts | `impulses`, `collision`, `strike` |
//! | the end of a chatter on stops that are struck at the same times | `chatter` |
//! | rounds of impacts on several stops in turn, or with joints; their end, also without a round | `instants`, `collapse`, `free_gaps` |
//! | from one event to the next, and what happens to the contacts there | `advance`, `contact_change` |
//! | events that change one stop alone | `alone` |
//! | the state at one time | `place` |
//! | a whole state as a start, and back | [`ContactStart`], `state` |
//! | which stops rest and which joints hold | `resolve` |
//! | one step of a motion, and its derivatives by the state and by a number | `passage`, `saltation`, `by_number`, `event_by_number` |
//! | which of the guards that are zero at an event time it | `timing` |
//! | differences of neighbouring motions, and how they are stretched | `tangents` |
//! | the motion as an iterator over its events | [`Motion`] |
//! | what it does between two events | [`Stretches`], `stretch` |
//! | the forces of stops and joints during a flight | `contact_force` |
//! | states, gaps and forces at one time, at equal steps | [`Sample`], [`Samples`] |
//! | states at given times, and at one position | [`states_at`], [`crossings`] |

mod advance;
mod alone;
mod by_number;
mod chatter;
mod collapse;
mod collision;
mod contact_change;
mod contact_force;
mod event;
mod event_by_number;
mod free_gaps;
mod given;
mod impulses;
mod instants;
mod motion;
mod passage;
mod place;
mod resolve;
mod saltation;
mod sample;
mod samples;
mod state;
mod states;
mod stretch;
mod stretches;
mod strike;
mod tangents;
mod timing;
mod within;

pub(crate) use by_number::ByNumber;
pub(crate) use contact_force::contact_forces;
pub use event::{ContactStart, End, Event, EventKind, Limits, Start};
pub use motion::Motion;
pub(crate) use passage::Passage;
pub(crate) use place::{Place, Structures, standing_back};
pub(crate) use saltation::{EventLaw, LinearEvent, LinearGuard, StateShape, step_derivative};
pub use sample::Sample;
pub use samples::Samples;
pub use states::{crossings, states_at};
pub use stretches::Stretches;
pub(crate) use tangents::{FrameChange, Metric, TangentStep, stretched, tangent_steps};

//! Curves of events of machines in a plane of two numbers, with the same tracer as those of the oscillator.
//!
//! | idea | file |
//! |---|---|
//! | a machine as a function of two numbers, and their ranges | [`Plane`] |
//! | singular equations of a cycle: a multiplier +1 or -1, smooth through grazing | `borders` |
//! | the condition that holds along a curve | `condition` |
//! | the equations of all events with two numbers and one condition | `equations` |
//! | a moment at which rounding decides which events the motion has | `moment` |
//! | whether a solution with a touch, a corner or a contact at its limit is admissible | `beside` |
//! | the problem that the tracer solves: points of codimension two | `problem` |
//! | the events and the condition of a curve, from an event of a branch | `origin` |
//! | the same where a rest begins or ends | `origin_at_rest` |
//! | why a curve ends | `end` |
//! | a point of a curve | [`CurvePoint`] |
//! | the curve | `curve` |

mod beside;
mod borders;
mod condition;
mod curve;
mod end;
mod equations;
mod moment;
mod origin;
mod origin_at_rest;
mod plane;
mod point;
mod problem;

pub(crate) use curve::UnreducedCurve;
pub use plane::Plane;
pub use point::CurvePoint;

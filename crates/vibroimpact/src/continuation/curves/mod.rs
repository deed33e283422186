//! Curves of folds, flips and grazing impacts in a plane of two parameters.
//!
//! | idea | file |
//! |---|---|
//! | the curve; a point of a curve | [`Curve`], [`CurvePoint`] |
//! | what holds along a curve, and the events on it, of any system | [`CurveKind`], [`CurveEvent`] |
//! | why a curve ends | `end` |
//! | the frame in which curves are followed | [`Frame`] |

mod curve;
mod end;
mod event;
mod frame;
mod point;

pub use curve::Curve;
pub use event::{CurveEvent, CurveKind};
pub use frame::Frame;
pub(crate) use frame::{Ranges, check, node, scales};
pub use point::{CurveOptions, CurvePoint};

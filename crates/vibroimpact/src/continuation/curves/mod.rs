//! Curves of folds, flips and grazing impacts in a plane of two parameters.
//!
//! | idea | file |
//! |---|---|
//! | the curve; a point of a curve, and its event | [`Curve`], [`CurvePoint`] |
//! | why a curve ends | `end` |
//! | the frame in which curves are followed | [`Frame`] |

mod curve;
mod end;
mod frame;
mod point;

pub use curve::Curve;
pub use frame::Frame;
pub(crate) use frame::{check, scales};
pub use point::{CurveEvent, CurveKind, CurveOptions, CurvePoint};

//! Curves of folds, flips and grazing impacts in a plane of two parameters.
//!
//! | idea | file |
//! |---|---|
//! | the curve; a point of one, and what happens there | [`Curve`], [`CurvePoint`] |
//! | why one ends | `end` |
//! | the box that is looked at | [`Frame`] |

mod curve;
mod end;
mod frame;
mod point;

pub use curve::Curve;
pub use frame::Frame;
pub use point::{CurveEvent, CurveKind, CurveOptions, CurvePoint};

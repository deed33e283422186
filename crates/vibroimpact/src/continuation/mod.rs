//! Continuation: how a cycle changes with a parameter, and what ends or changes it on the way.
//!
//! | idea | file |
//! |---|---|
//! | a curve through the solutions of equations, by its arclength | `arc` |
//! | the equations of a cycle with one parameter free | `varied` |
//! | a zero in a bracket; a cubic through four points | `root`, `interpolate` |
//! | what is watched for a change of sign along a branch | `watch` |
//! | a point of a branch, and what happens there | [`Point`], [`BranchEvent`] |
//! | the branch, step by step | [`Branch`], [`BranchOptions`] |
//! | the events on a step: where and what | `events` |
//! | a grazing impact, and the cycle on its other side | `touch`, `graze` |
//! | the motion without impacts: to it and from it | `free` |
//! | the equations with two parameters free and a condition, and walks along their curves | `plane`, `walk` |
//! | curves of folds, flips and grazing impacts | [`Curve`] |
//! | where a motion exists or is stable, as polygons along these curves | [`region`], [`Region`], `round` |
//! | branches that begin at a flip or a branch point | `switch` |

mod arc;
mod branch;
mod curve;
mod events;
mod free;
mod graze;
mod interpolate;
mod options;
mod plane;
mod point;
mod polygon;
mod region;
mod root;
mod round;
mod switch;
mod touch;
mod varied;
mod walk;
mod watch;

pub use branch::Branch;
pub use curve::{Curve, CurveEvent, CurveKind, CurveOptions, CurvePoint, Frame};
pub use options::{BranchError, BranchOptions, Direction};
pub use point::{BranchEvent, Change, Point};
pub use polygon::{Bound, Polygon, Region, Vertex};
pub use region::{RegionKind, RegionOptions, region};

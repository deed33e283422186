//! Continuation: how a cycle changes with a parameter, and what ends or changes it on the way.
//!
//! | idea | file |
//! |---|---|
//! | a curve through the solutions of equations, by its arclength | `arc` |
//! | the equations of a cycle with one parameter free | `varied` |
//! | a zero in a bracket; a cubic through four points | `root`, `interpolate` |
//! | what is watched for a change of sign along a branch | `watch` |
//! | a point of a branch, and what happens there | [`SolutionPoint`], [`BranchEvent`] |
//! | the branch | [`Branch`], [`BranchOptions`] |
//! | by the equations of its impacts; one step of it | `course`, `step` |
//! | by its release, where it rests on a stop; whether two motions are alike; what happens between | `resting`, `likeness`, `resting_event` |
//! | the events on a step: where and what | `events` |
//! | a grazing impact, and the cycle on its other side | `touch`, `graze` |
//! | impact after impact: the chatter at the end | `accumulation` |
//! | the motion without impacts: to it and from it | `free` |
//! | the equations with two parameters free and a condition, and walks along their curves | `plane`, `walk` |
//! | curves of folds, flips and grazing impacts; a point of one; why one ends | [`Curve`], [`CurvePoint`], `curve_end` |
//! | the box that is looked at | [`Frame`] |
//! | where a motion exists or is stable, as polygons along these curves | [`region`], [`Region`], `search`, `round`, `inside`, `singular` |
//! | the region of the motion without impacts, in closed form | `free_region` |
//! | branches that begin at a flip or a branch point | `switch` |

mod accumulation;
mod arc;
mod branch;
mod course;
mod curve;
mod curve_end;
mod curve_point;
mod events;
mod frame;
mod free;
mod free_region;
mod graze;
mod inside;
mod interpolate;
mod likeness;
mod options;
mod plane;
mod point;
mod polygon;
mod region;
mod region_options;
mod resting;
mod resting_event;
mod root;
mod round;
mod search;
mod seed;
mod singular;
mod step;
mod switch;
mod test_functions;
mod touch;
mod varied;
mod walk;

pub use branch::Branch;
pub use curve::Curve;
pub use curve_point::{CurveEvent, CurveKind, CurveOptions, CurvePoint};
pub use frame::Frame;
pub use options::{BranchError, BranchOptions, Direction};
pub use point::{BranchEvent, Change, SolutionPoint, Touch};
pub use polygon::{Bound, Polygon, Region, Vertex};
pub use region::{region, region_while};
pub use region_options::{RegionKind, RegionOptions};

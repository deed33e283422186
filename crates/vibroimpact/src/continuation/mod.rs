//! Continuation: how a cycle changes with a parameter, and at which events it changes its kind or ends.
//!
//! | idea | folder |
//! |---|---|
//! | tracing a curve of solutions step by step, the zeros of test functions on it, and the driver of every branch and curve | `trace` |
//! | the equations of cycles with one or two parameters among the unknowns | `equations` |
//! | the events of the branches of every system | [`BranchEvent`] |
//! | branches: how a cycle changes with one parameter | [`Branch`], [`SolutionPoint`] |
//! | curves of folds, flips and grazing impacts in a plane of two parameters | [`Curve`], [`CurvePoint`], [`Frame`] |
//! | branches of cycles of machines | [`machine::Branch`], [`machine::SolutionPoint`] |
//! | curves of events of machines in a plane of two numbers | [`machine::Curve`], [`machine::CurvePoint`], [`machine::Plane`] |
//! | where in such a plane an orbit exists or is stable, as polygons bounded by these curves | [`region`], [`Region`] |

mod branches;
mod curves;
mod equations;
mod event;
pub mod machine;
mod regions;
mod trace;

pub use branches::{Branch, BranchError, BranchOptions, Direction, SolutionPoint};
pub use curves::{Curve, CurveEvent, CurveKind, CurveOptions, CurvePoint, Frame};
pub use event::{BranchEvent, EventDetail};
pub use regions::{Bound, Polygon, Region, RegionKind, RegionOptions, Vertex, region, region_while};

//! Continuation: how a cycle changes with a parameter, and what ends or changes it on the way.
//!
//! | idea | folder |
//! |---|---|
//! | one step after another along a curve of solutions, and the zeros of test functions on it | `trace` |
//! | the equations of cycles with one parameter or two among the unknowns | `equations` |
//! | branches: how a cycle changes with one parameter | [`Branch`], [`BranchEvent`], [`SolutionPoint`] |
//! | curves of folds, flips and grazing impacts in a plane of two parameters | [`Curve`], [`CurvePoint`], [`Frame`] |
//! | where in such a plane a motion exists or is stable, as polygons along these curves | [`region`], [`Region`] |

mod branches;
mod curves;
mod equations;
mod regions;
mod trace;

pub use branches::{Branch, BranchError, BranchEvent, BranchOptions, Change, Direction, SolutionPoint, Touch};
pub use curves::{Curve, CurveEvent, CurveKind, CurveOptions, CurvePoint, Frame};
pub use regions::{Bound, Polygon, Region, RegionKind, RegionOptions, Vertex, region, region_while};

//! Branches and curves of machines. The tracer, the driver, the options, the errors and the events are those of
//! oscillators.
//!
//! | idea | folder |
//! |---|---|
//! | the branch of a cycle in one number of a machine | `branches` |
//! | the curve of an event in a plane of two numbers | `curves` |
//! | both, of a machine that is an oscillator those of the oscillator | [`Branch`], [`Curve`] |
//! | the plane of these oscillators, for curves and regions | [`Plane::reduced`] |
//! | the region of a plane of two numbers in which a motion exists or is stable | [`Plane::region_while`] |

mod branches;
mod curves;
mod reduced_branch;
mod reduced_curve;
mod reduced_plane;
mod region;

pub use branches::{Family, SolutionPoint};
pub use curves::{CurvePoint, Plane};
pub use reduced_branch::Branch;
pub use reduced_curve::Curve;
pub use region::Seeds;

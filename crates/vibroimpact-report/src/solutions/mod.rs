//! Cycles, branches and curves of any system, with the names and in the units of the results. The JSON objects, the tables, the
//! figures and the texts of a command are all written from these.

mod branch;
mod curve;
mod cycle;
mod margins;

pub use branch::{BranchRows, BranchesView, Event, OriginView, PointView, machine_points, points};
pub use curve::{CurvePointView, CurveView};
pub use cycle::{Closing, CycleView, OrbitView, machine_orbits, orbits};
pub use margins::{MarginEndView, MarginView, NearestView, machine_margins, margins, nearest};

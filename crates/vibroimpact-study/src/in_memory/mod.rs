//! The results of tasks over a grid, in memory. They are joined from the same tiles that fill a store.

mod attractors;
mod basin;
mod diagram;
mod map;

pub(crate) use attractors::{attractors, machine_attractors};
pub(crate) use basin::{basin, machine_basin};
pub(crate) use diagram::{DIAGRAM_TILE, diagram};
pub(crate) use map::{machine_map, machine_points, map};

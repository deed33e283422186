//! The results of tasks over a grid, in memory. They are joined from the same tiles that fill a store.

mod attractors;
mod basin;
mod diagram;
mod join;
mod machine_grid;
mod map;

pub(crate) use attractors::attractors;
pub(crate) use basin::basin;
pub(crate) use diagram::{diagram, machine_diagram};
pub(crate) use machine_grid::{machine_basin, machine_map, machine_points};
pub(crate) use map::map;

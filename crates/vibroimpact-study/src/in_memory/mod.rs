//! The results of tasks over a grid, in memory: the tiles that a store would be filled with, put together.

mod attractors;
mod basin;
mod diagram;
mod map;

pub(crate) use attractors::attractors;
pub(crate) use basin::basin;
pub(crate) use diagram::diagram;
pub(crate) use map::map;

//! The results of tasks over a grid, in memory. They are joined from the same tiles that fill a store.

mod attractors;
mod basin;
mod diagram;
mod map;

pub(crate) use attractors::attractors;
pub(crate) use basin::basin;
pub(crate) use diagram::diagram;
pub(crate) use map::map;

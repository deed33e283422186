//! What is told of the result of a task, one file for each: its JSON object, its table and its text, and small figures.

pub(crate) mod attractors;
pub mod basin;
pub(crate) mod certainty;
pub(crate) mod curve;
pub mod diagram;
pub(crate) mod edge;
pub(crate) mod lyapunov;
pub mod map;
pub(crate) mod margins;
pub(crate) mod orbit;
pub(crate) mod region;
pub(crate) mod response;
pub(crate) mod settle;
pub(crate) mod simulate;

//! The equations of cycles with one parameter or two among the unknowns, and their test functions.
//!
//! | idea | file |
//! |---|---|
//! | the equations of a cycle with one parameter free, or a line through two | `cycle_equations` |
//! | what changes sign at an event of a branch | `test_functions` |
//! | the equations with two parameters free and a condition | `plane_equations` |
//! | curves in a plane of parameters: these equations with the conditions that are watched on the way | `plane_tracer` |

pub(super) mod cycle_equations;
pub(super) mod plane_equations;
pub(super) mod plane_tracer;
pub(super) mod test_functions;

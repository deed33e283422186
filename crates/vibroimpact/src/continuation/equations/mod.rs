//! The equations of cycles with one or two parameters among the unknowns, and their test functions.
//!
//! | idea | file |
//! |---|---|
//! | the equations of a cycle with one free parameter, or a line through two | `cycle_equations` |
//! | the test functions of the events of a branch | `test_functions` |
//! | the equations of a cycle with two free parameters and one condition | `plane_equations` |
//! | tracing curves in a plane of parameters, with test functions | `plane_tracer` |

pub(super) mod cycle_equations;
pub(super) mod plane_equations;
pub(super) mod plane_tracer;
pub(super) mod test_functions;

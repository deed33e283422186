//! Tracing curves of solutions of equations step by step.
//!
//! | idea | file |
//! |---|---|
//! | equations with one equation fewer than unknowns; Newton's method perpendicular to the tangent | `equations` |
//! | the length of a step | `step_length` |
//! | prediction, correction and acceptance of a step, and the zeros of test functions on it | `tracer` |
//! | an iterator over the points of a branch or a curve | `driver` |
//! | the cubic through four points | `interpolate` |
//! | the zero of a test function over the number, near a solution | `secant` |

pub(super) mod driver;
pub(super) mod equations;
pub(super) mod interpolate;
pub(super) mod secant;
pub(super) mod step_length;
pub(super) mod tracer;

//! Curves of solutions of equations, traced step by step.
//!
//! | idea | file |
//! |---|---|
//! | equations with one unknown more, Newton's method across the tangent | `equations` |
//! | how long a step is | `step_length` |
//! | predictor, correction, acceptance of a step, and the zeros of test functions on it | `tracer` |
//! | a zero in a bracket; a cubic through four points | `root`, `interpolate` |

pub(super) mod equations;
pub(super) mod interpolate;
pub(super) mod root;
pub(super) mod step_length;
pub(super) mod tracer;

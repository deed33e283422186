//! The elementary functions of the core: fixed sequences of IEEE operations, with the same bits on every platform.
//!
//! The `sin` of one platform may differ in its last bit from that of another, and in a chaotic motion this difference
//! is visible after fifty impacts. So the core has its own sine and cosine ([`sin_cos`]) and uses `libm`, which is
//! plain Rust, for rarer functions. No fused multiply-add is used. On machines without it, it is a slow library call,
//! and if only some machines used it, the bits would differ.

mod complex;
mod dense;
mod exact;
mod gauss;
mod general;
mod graded;
mod lane;
mod least;
mod lu;
mod matrix;
pub(crate) mod root;
mod scalar;
mod sort;
mod symmetric;
mod trig;

pub(crate) use complex::Complex;
pub use dense::Matrix;
pub(crate) use dense::{add_scaled, dot, fit};
pub(crate) use exact::{Wide, two_prod, two_sum};
pub(crate) use gauss::{Gauss, POINTS, RULE};
pub(crate) use general::{eigenvector, general_eigenvalues};
pub(crate) use graded::{Graded, GradedFactors};
pub(crate) use lane::{Lane, Mask, Numbers, Single, turned};
pub(crate) use least::change_along;
pub(crate) use lu::Lu;
pub use matrix::{Matrix2, Multiplier, eigenvalues};
pub use sort::{sort_by, sort_by_key};
pub(crate) use symmetric::symmetric_eigen;
pub use trig::sin_cos;
pub(crate) use trig::sin_cos_lanes;

/// $`e^x`$.
pub(crate) fn exp(x: f64) -> f64 {
    libm::exp(x)
}

/// $`e^x - 1`$, accurate for small `x`.
pub(crate) fn exp_m1(x: f64) -> f64 {
    libm::expm1(x)
}

/// Natural logarithm.
pub(crate) fn ln(x: f64) -> f64 {
    libm::log(x)
}

/// $`\ln(1 + x)`$, accurate for small `x`.
pub(crate) fn ln_1p(x: f64) -> f64 {
    libm::log1p(x)
}

/// $`\arcsin x`$ for `x` in [-1, 1].
pub(crate) fn asin(x: f64) -> f64 {
    libm::asin(x)
}

/// The angle of the point `(x, y)`, in (-π, π].
pub(crate) fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// $`\sqrt{x^2 + y^2}`$ without overflow.
#[must_use]
pub fn hypot(x: f64, y: f64) -> f64 {
    libm::hypot(x, y)
}

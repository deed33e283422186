//! The elementary functions of the core: one sequence of IEEE operations, hence the same bits on every platform.
//!
//! A platform's own `sin` may differ in its last bit from the next platform's, and a chaotic motion makes that bit
//! visible after fifty impacts. So the core evaluates sine and cosine itself ([`sin_cos`]) and takes the rarer functions
//! from `libm`, which is plain Rust. No fused multiply-add is used anywhere: on machines without it a fused operation
//! would be a slow library call, and using it on some machines only would change the bits.

mod exact;
mod lane;
mod lu;
mod matrix;
mod scalar;
mod trig;

pub(crate) use exact::{Sum, two_prod, two_sum};
pub(crate) use lane::{Lane, Mask, Numbers, Single, turned};
pub(crate) use lu::Lu;
pub use matrix::{Matrix2, Multiplier, eigenvalues};
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

/// $`\arcsin x`$ for `x` in [-1, 1].
pub(crate) fn asin(x: f64) -> f64 {
    libm::asin(x)
}

/// The angle of the point `(x, y)`, in (-π, π].
pub(crate) fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// $`\sqrt{x^2 + y^2}`$ without overflow.
pub(crate) fn hypot(x: f64, y: f64) -> f64 {
    libm::hypot(x, y)
}

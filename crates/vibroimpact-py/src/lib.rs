//! The compiled part of the Python package `vibroimpact`: parse (Python to a plan), run (behind [`door`]), report (arrays).
//!
//! One function family in one file. What has methods, figures and documentation is Python, in `python/vibroimpact`; here
//! are the checked parameters, the plans and columns of numbers.

mod attractors;
mod axis;
mod branch;
mod columns;
mod curve;
mod diagram;
mod door;
mod error;
mod lyapunov;
mod motion;
mod orbits;
mod oscillator;
mod region;
mod settle;
mod simulate;

/// The module `vibroimpact._core`.
#[pyo3::pymodule]
mod _core {
    #[pymodule_export]
    use crate::attractors::attractors;
    #[pymodule_export]
    use crate::axis::span_values;
    #[pymodule_export]
    use crate::branch::branch;
    #[pymodule_export]
    use crate::curve::curve;
    #[pymodule_export]
    use crate::diagram::orbit_diagram;
    #[pymodule_export]
    use crate::error::{QuestionError, StoppedError};
    #[pymodule_export]
    use crate::lyapunov::lyapunov;
    #[pymodule_export]
    use crate::orbits::orbits;
    #[pymodule_export]
    use crate::oscillator::{Oscillator, Units};
    #[pymodule_export]
    use crate::region::{contains, region};
    #[pymodule_export]
    use crate::settle::{settle, settle_many};
    #[pymodule_export]
    use crate::simulate::{simulate, waveform};

    /// Version of the package.
    #[pymodule_export]
    #[expect(non_upper_case_globals, reason = "its name in Python")]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}

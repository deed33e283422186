//! The compiled module of the Python package `vibroimpact`: parse (Python to a plan), run (in `door`), report
//! (arrays).
//!
//! Each file has one family of functions. Checked parameters, plans and columns of numbers are here; results with
//! methods, figures and documentation are written in Python, in `python/vibroimpact`.
#![allow(clippy::needless_pass_by_value, reason = "arguments from Python are values")]

mod answer;
mod axis;
mod columns;
mod command;
mod door;
mod error;
mod events;
mod figure;
mod grid;
mod machine;
mod oscillator;
mod plan;
mod points;
mod region;
mod section;
mod settle;
mod simulate;
mod simulate_many;
mod store;

/// Many small vectors are allocated for each event of a machine.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// The module `vibroimpact._core`.
#[pyo3::pymodule]
mod _core {
    #[pymodule_export]
    use crate::{
        answer::{Answer, answer, contact, plan_of, shares_figure, title_of, varied_parameters},
        command::vibro,
        error::{QuestionError, StoppedError, StoreError},
        figure::{cells_figure, class_colour, diagram_figure, scattered_figure},
        grid::{basin_measures, fill, labels_of, span_values},
        machine::{MachineFile, machine_names, machine_state, machine_waveform, simulate_machines, states_of_machines},
        oscillator::OscillatorFile,
        plan::{
            body_parameters, checked_plan, coordinate_words, fixed_coordinates, point_coordinates, scales_of_points,
            schema,
        },
        points::{drawn_points, settle_points},
        region::contains,
        settle::{settle_many, share_interval},
        simulate::waveform,
        simulate_many::{end_reasons, simulate_points, states_of_points},
        store::{Store, estimate_plan, seconds_of},
    };

    /// Whether this build supports buckets.
    #[pymodule_export]
    #[expect(non_upper_case_globals, reason = "its name in Python")]
    const reaches_buckets: bool = crate::store::BUCKETS;

    /// Version of the package.
    #[pymodule_export]
    #[expect(non_upper_case_globals, reason = "its name in Python")]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}

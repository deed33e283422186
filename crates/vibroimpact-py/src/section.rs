//! States of motions of any system: at given times, at a phase of the forcing, and at a position.

use crate::columns::column;
use numpy::PyArray1;
use pyo3::prelude::*;
use vibroimpact_study::{PlanError, SimulatePlan};

/// What is asked of a motion besides its events: the states at these times, those at a phase of the forcing in so many periods, or
/// those where a coordinate crosses a position, up to so many periods.
#[derive(FromPyObject)]
pub(crate) enum Section {
    Phase(f64, f64),
    Position(String, f64, f64),
    // last, because a tuple is a sequence too
    At(Vec<f64>),
}

impl Section {
    /// Checks the number of periods.
    pub(crate) fn check(&self) -> Result<(), PlanError> {
        let periods = match self {
            Self::At(_) => None,
            Self::Phase(_, periods) | Self::Position(_, _, periods) => Some(*periods),
        };
        SimulatePlan { periods, ..SimulatePlan::default() }.check()
    }
}

/// The numbers of the whole periods in this number of them, from 0.
pub(crate) fn whole_periods(periods: f64) -> impl Iterator<Item = u32> {
    (0..).take_while(move |k| f64::from(*k) + 1.0 <= periods)
}

/// The largest number of states of a motion, and one column for times, phases, coordinates and velocities each: a row of so many states for
/// each motion, filled up with not-a-number.
pub(crate) type States<'py> = (usize, Vec<Bound<'py, PyArray1<f64>>>);

/// The states of motions as columns. `value` is number `k` of a state.
pub(crate) fn columns<'py, S>(
    py: Python<'py>,
    rows: &[Vec<S>],
    count: usize,
    value: impl Fn(&S, usize) -> f64,
) -> States<'py> {
    let width = rows.iter().map(Vec::len).max().unwrap_or(0);
    let of = |k: usize| {
        let cells =
            rows.iter().flat_map(|row| (0..width).map(|n| row.get(n).map_or(f64::NAN, |state| value(state, k))));
        column(py, cells)
    };
    (width, (0..count).map(of).collect())
}

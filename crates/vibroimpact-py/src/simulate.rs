//! The waveform of a motion of an oscillator.

use crate::columns::column;
use crate::door::{self, Watch};
use crate::error::Trouble;
use crate::oscillator::OscillatorFile;
use numpy::PyArray1;
use pyo3::prelude::*;
use vibroimpact::Start;
use vibroimpact::motion::{Sample, sample, states_at};
use vibroimpact_study::{SimulatePlan, StartPlan};

/// Position, velocity and phase.
pub(crate) type StartArgument = (Option<f64>, f64, f64);

pub(crate) const fn start_plan((x, v, phase): StartArgument) -> StartPlan {
    StartPlan { x, v, phase }
}

/// The plan of a simulation, which is JSON.
pub(crate) fn simulate_plan(plan: &str) -> Result<SimulatePlan, Trouble> {
    serde_json::from_str(plan).map_err(|error| Trouble::question(error.to_string()))
}

/// Maximum number of points of a waveform.
const MOST_POINTS: f64 = 1e7;

/// Checks the step of a waveform.
pub(crate) fn checked_step(step: f64, until: f64) -> Result<f64, Trouble> {
    if step > 0.0 && step.is_finite() && until / step <= MOST_POINTS {
        return Ok(step);
    }
    Err(Trouble::question(format!(
        "step = {step} gives {} points over a time of {until}; between 0 and {MOST_POINTS} are allowed",
        until / step
    )))
}

/// Times, positions and velocities.
type Waveform<'py> = (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>);

/// The waveform from a start up to a time: at equal steps, or at steps of at most this and on both sides of each event.
#[pyfunction]
pub(crate) fn waveform<'py>(
    py: Python<'py>,
    osc: OscillatorFile,
    start: StartArgument,
    until: f64,
    step: f64,
    events: bool,
) -> Result<Waveform<'py>, Trouble> {
    let (osc, step) = (osc.osc, checked_step(step, until)?);
    let start = start_plan(start).start(&osc)?;
    let wave = door::run(py, Watch::alone("drawing a waveform"), move |_| {
        if events {
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // 1e7
            return Ok(sample(&osc, start, until, step, 3 * MOST_POINTS as usize));
        }
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss)] // 1e7
        let times: Vec<f64> = (0..=(until / step) as u64).map(|k| k as f64 * step).collect();
        let at = |(time, state): (&f64, Option<Start>)| {
            state.map(|Start { x, v, phase }| Sample { time: *time, x, v, phase })
        };
        Ok(times.iter().zip(states_at(&osc, start, &times)).filter_map(at).collect())
    })?;
    Ok((
        column(py, wave.iter().map(|point| point.time)),
        column(py, wave.iter().map(|point| point.x)),
        column(py, wave.iter().map(|point| point.v)),
    ))
}

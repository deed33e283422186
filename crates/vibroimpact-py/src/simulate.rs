//! The events of a motion, and its waveform.

use crate::columns::{column, grid, sign};
use crate::door::{self, Watch};
use crate::error::Trouble;
use crate::oscillator::Oscillator;
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use serde::Serialize;
use vibroimpact::motion::{EventKind, Sample, sample, states_at};
use vibroimpact::{Side, Start};
use vibroimpact_report::json::motion::horizon;
use vibroimpact_study::{Plan, Results, StartPlan, Task};

/// The fields of `Simulation`.
#[derive(IntoPyObject)]
pub(crate) struct Fields<'py> {
    /// 0 impact, 1 graze, 2 stick, 3 release.
    code: Bound<'py, PyArray1<u8>>,
    time: Bound<'py, PyArray1<f64>>,
    phase: Bound<'py, PyArray1<f64>>,
    side: Bound<'py, PyArray1<i8>>,
    speed: Bound<'py, PyArray1<f64>>,
    /// Positions and velocities after the events, as rows.
    q: Bound<'py, PyArray2<f64>>,
    qdot: Bound<'py, PyArray2<f64>>,
    depth: Bound<'py, PyArray1<f64>>,
    chatter: Bound<'py, PyArray1<bool>>,
    error: Bound<'py, PyArray1<f64>>,
    reason: &'static str,
    end_time: f64,
    /// The JSON object that says why there are no more impacts.
    horizon: Option<String>,
    shown_until: f64,
    plan: String,
}

/// Position, velocity and phase.
pub(crate) type StartArgument = (Option<f64>, f64, f64);

pub(crate) const fn start_plan((x, v, phase): StartArgument) -> StartPlan {
    StartPlan { x, v, phase }
}

/// The plan as JSON.
pub(crate) fn text(plan: &impl Serialize) -> Result<String, Trouble> {
    serde_json::to_string(plan).map_err(|_| Trouble::Defect("writing the plan"))
}

/// Follows a motion event by event.
#[pyfunction]
pub(crate) fn simulate<'py>(
    py: Python<'py>,
    osc: Oscillator,
    start: StartArgument,
    impacts: Option<u64>,
    periods: Option<f64>,
    progress: Option<Py<PyAny>>,
) -> Result<Fields<'py>, Trouble> {
    let plan = Plan::new(osc.plan, Task::Simulate { start: Some(start_plan(start)), impacts, periods }).complete()?;
    let total = if let Task::Simulate { impacts: Some(impacts), .. } = plan.task { impacts } else { 1 };
    let watch = Watch::one("following a motion", total, progress);
    let found =
        door::result(py, watch, &plan, |of| if let Results::Simulate(_, found) = of { Some(found) } else { None })?;
    let osc = osc.osc;
    let events = || found.events.iter();
    let impact = |kind: EventKind| match kind {
        EventKind::Impact { velocity_before, velocity_after } => (velocity_before, velocity_after),
        _ => (0.0, 0.0),
    };
    let place = |side: Side| osc.stop(side).map_or(f64::NAN, |stop| side.sign() * stop.gap);
    Ok(Fields {
        code: column(
            py,
            events().map(|event| match event.kind {
                EventKind::Impact { .. } => 0,
                EventKind::Graze { .. } => 1,
                EventKind::Stick { .. } => 2,
                EventKind::Release => 3,
            }),
        ),
        time: column(py, events().map(|event| event.time)),
        phase: column(py, events().map(|event| event.phase)),
        side: column(py, events().map(|event| sign(event.side))),
        speed: column(py, events().map(|event| impact(event.kind).0)),
        q: grid(py, events().map(|event| vec![place(event.side)]), 1)?,
        // without a rebound 0, not -0
        qdot: grid(py, events().map(|event| vec![event.side.sign() * impact(event.kind).1 + 0.0]), 1)?,
        depth: column(
            py,
            events().map(|event| if let EventKind::Graze { depth } = event.kind { depth } else { f64::NAN }),
        ),
        chatter: column(py, events().map(|event| matches!(event.kind, EventKind::Stick { chatter: true, .. }))),
        error: column(
            py,
            events().map(|event| if let EventKind::Stick { error, .. } = event.kind { error } else { f64::NAN }),
        ),
        reason: found.reason,
        end_time: found.time,
        horizon: found.horizon.as_ref().map(horizon),
        shown_until: found.shown_until,
        plan: text(&plan)?,
    })
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
    osc: Oscillator,
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
        let at = |(time, state): (&f64, Option<Start>)| state.map(|Start { x, v, .. }| Sample { time: *time, x, v });
        Ok(times.iter().zip(states_at(&osc, start, &times)).filter_map(at).collect())
    })?;
    Ok((
        column(py, wave.iter().map(|point| point.time)),
        column(py, wave.iter().map(|point| point.x)),
        column(py, wave.iter().map(|point| point.v)),
    ))
}

//! Many motions event by event, and their states at given times, at one phase of the force and at one position.

use crate::door::{self, Watch};
use crate::error::Trouble;
use crate::oscillator::OscillatorFile;
use crate::points::column;
use crate::simulate::{StartArgument, start_plan};
use numpy::{IntoPyArray, PyArray1, PyArrayMethods, PyReadonlyArray1};
use pyo3::prelude::*;
use vibroimpact::motion::{Level, Strobes, states_at};
use vibroimpact_study::{
    Control, END_REASONS, EventColumns, PlanError, PointsPlan, StartPlan, SystemPlan, real_numbers,
};

/// The columns that vary, and the numbers of all other parameters and coordinates of starts.
type Over<'py> = Vec<(String, PyReadonlyArray1<'py, f64>)>;

/// The points, the system and the start of a question.
struct Asked {
    points: PointsPlan,
    system: SystemPlan,
    start: StartPlan,
}

impl Asked {
    fn new(osc: OscillatorFile, over: &Over<'_>, start: StartArgument) -> Result<Self, Trouble> {
        let columns = over.iter().map(|(name, values)| column(name, values.as_array().to_vec()));
        let points = PointsPlan::Listed(columns.collect::<Result<_, _>>()?);
        Ok(Self { points, system: osc.plan, start: start_plan(start) })
    }

    /// The results of `work` at all points.
    fn each<T: Send + 'static>(
        self,
        py: Python<'_>,
        (threads, progress): (usize, Option<Py<PyAny>>),
        work: impl Fn(&vibroimpact::Oscillator, vibroimpact::Start, &Control<'_>) -> Result<T, PlanError>
        + Send
        + Sync
        + 'static,
    ) -> Result<Vec<T>, Trouble> {
        let watch = Watch { what: "following motions", total: self.points.count(), progress, threads };
        door::run(py, watch, move |control| {
            let all = self.points.each((&self.system, &self.start), control, |osc, start| work(osc, start, control))?;
            Ok(all.into_iter().collect::<Result<Vec<T>, PlanError>>()?)
        })
    }
}

/// Rows of different lengths as one array, filled up with `nothing`.
fn padded<'py, T: numpy::Element + Copy>(
    py: Python<'py>,
    rows: usize,
    width: usize,
    nothing: T,
    row: impl Fn(usize, &mut dyn FnMut(T)),
) -> Bound<'py, PyArray1<T>> {
    let mut all = Vec::with_capacity(rows * width);
    for k in 0..rows {
        row(k, &mut |value| all.push(value));
        all.resize((k + 1) * width, nothing);
    }
    all.into_pyarray(py)
}

/// The events of many motions: rows of `room` cells each, as [`EventColumns`] describes them.
#[derive(IntoPyObject)]
pub(crate) struct ManyFields<'py> {
    room: usize,
    width: usize,
    kind: Bound<'py, PyArray1<i8>>,
    side: Bound<'py, PyArray1<i8>>,
    /// Times, phases, and velocities before and after, one after another.
    real: Bound<'py, PyArray1<f64>>,
    count: Bound<'py, PyArray1<i32>>,
    end: Bound<'py, PyArray1<i8>>,
    end_time: Bound<'py, PyArray1<f64>>,
}

/// The reasons for which lists of events end, in the order of their codes.
#[pyfunction]
pub(crate) const fn end_reasons() -> [&'static str; END_REASONS.len()] {
    END_REASONS
}

/// Follows the motion at each point event by event.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)] // called from Python
pub(crate) fn simulate_points<'py>(
    py: Python<'py>,
    osc: OscillatorFile,
    over: Over<'py>,
    start: StartArgument,
    limits: (Option<u64>, Option<f64>),
    threads: usize,
    progress: Option<Py<PyAny>>,
) -> Result<ManyFields<'py>, Trouble> {
    let Asked { points, system, start } = Asked::new(osc, &over, start)?;
    let watch = Watch { what: "following motions", total: points.count(), progress, threads };
    let real = PyArray1::zeros(py, real_numbers(&points, limits), false);
    let mut borrowed = real.readwrite();
    let memory = borrowed.as_slice_mut().map_err(|_| Trouble::Defect("borrowing new memory"))?;
    let found = door::run_borrowing(py, watch, move |control| {
        Ok(vibroimpact_study::simulate_points(&points, (&system, &start), limits, memory, control)?)
    })?;
    drop(borrowed);
    let EventColumns { room, width, kind, side, refitted, count, end, end_time } = found;
    Ok(ManyFields {
        room,
        width,
        kind: kind.into_pyarray(py),
        side: side.into_pyarray(py),
        real: refitted.map_or(real, |refitted| refitted.into_pyarray(py)),
        count: count.into_pyarray(py),
        end: end.into_pyarray(py),
        end_time: end_time.into_pyarray(py),
    })
}

/// Times, positions, velocities and phases: rows of `width` states each.
#[derive(IntoPyObject)]
pub(crate) struct StateFields<'py> {
    width: usize,
    time: Bound<'py, PyArray1<f64>>,
    x: Bound<'py, PyArray1<f64>>,
    v: Bound<'py, PyArray1<f64>>,
    phase: Bound<'py, PyArray1<f64>>,
}

/// A state: time, position, velocity and phase.
type State = [f64; 4];

impl<'py> StateFields<'py> {
    fn new(py: Python<'py>, rows: &[Vec<State>]) -> Self {
        let width = rows.iter().map(Vec::len).max().unwrap_or(0);
        let part = |k: usize| {
            padded(py, rows.len(), width, f64::NAN, |row, put| rows[row].iter().for_each(|state| put(state[k])))
        };
        Self { width, time: part(0), x: part(1), v: part(2), phase: part(3) }
    }
}

/// The states of the motion at each point at these times, which rise.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)] // called from Python
pub(crate) fn states_of_points<'py>(
    py: Python<'py>,
    osc: OscillatorFile,
    over: Over<'py>,
    start: StartArgument,
    times: Vec<f64>,
    threads: usize,
    progress: Option<Py<PyAny>>,
) -> Result<StateFields<'py>, Trouble> {
    let rows = Asked::new(osc, &over, start)?.each(py, (threads, progress), move |osc, start, _| {
        let none = [f64::NAN; 4];
        let states = states_at(osc, start, &times).into_iter().zip(&times);
        Ok(states.map(|(state, time)| state.map_or(none, |of| [*time, of.x, of.v, of.phase])).collect())
    })?;
    Ok(StateFields::new(py, &rows))
}

/// The first states of the motion at each point at one phase of the force.
#[pyfunction]
#[allow(clippy::needless_pass_by_value, clippy::too_many_arguments)] // called from Python
pub(crate) fn strobes_of_points<'py>(
    py: Python<'py>,
    osc: OscillatorFile,
    over: Over<'py>,
    start: StartArgument,
    phase: f64,
    count: usize,
    threads: usize,
    progress: Option<Py<PyAny>>,
) -> Result<StateFields<'py>, Trouble> {
    let rows = Asked::new(osc, &over, start)?.each(py, (threads, progress), move |osc, start, _| {
        let first = vibroimpact::system::phase::wrap(phase - start.phase) / osc.beta();
        #[allow(clippy::cast_precision_loss)] // counts below 2^53
        let state = |(k, of): (usize, vibroimpact::Start)| [first + k as f64 * osc.period(), of.x, of.v, of.phase];
        Ok(Strobes::new(osc, start, phase).take(count).enumerate().map(state).collect())
    })?;
    Ok(StateFields::new(py, &rows))
}

/// The crossings of a position by the motion at each point, up to a number of forcing periods.
#[pyfunction]
#[allow(clippy::needless_pass_by_value, clippy::too_many_arguments)] // called from Python
pub(crate) fn crossings_of_points<'py>(
    py: Python<'py>,
    osc: OscillatorFile,
    over: Over<'py>,
    start: StartArgument,
    position: f64,
    periods: f64,
    threads: usize,
    progress: Option<Py<PyAny>>,
) -> Result<StateFields<'py>, Trouble> {
    let rows = Asked::new(osc, &over, start)?.each(py, (threads, progress), move |osc, start, _| {
        let level = Level::new(osc, position)?;
        let state = |of: vibroimpact::motion::Crossing| [of.time, position, of.velocity, of.phase];
        Ok(level.crossings(start, periods * osc.period()).map(state).collect())
    })?;
    Ok(StateFields::new(py, &rows))
}

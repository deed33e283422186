//! Settling of motions from starts given as arrays.

use crate::door::{self, Watch};
use crate::error::Trouble;
use crate::oscillator::OscillatorFile;
use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use vibroimpact::Start;
use vibroimpact::lanes::Width;
use vibroimpact::system::phase;
use vibroimpact::verdict::{Census, KnownAttractors, SettleOptions, settle_many as settle_range};
use vibroimpact_report::json::motion;
use vibroimpact_study::{Control, basin, tiles};

/// The interval of a share at a confidence of 95 %.
#[pyfunction]
pub(crate) fn share_interval(count: u64, total: u64) -> (f64, f64) {
    basin::share_interval(count, total)
}

/// Number of starts of a tile.
const TILE: u64 = 4096;
/// Number of starts of the survey, which finds the cycles and their trapping regions.
const SURVEY: u64 = 24;

/// Starts as columns. A column of length 1 applies to all starts.
struct Starts<'a> {
    x: &'a [f64],
    v: &'a [f64],
    phase: &'a [f64],
}

impl Starts<'_> {
    /// Start number `k`, with its phase as given.
    fn given(&self, k: u64) -> Start {
        let of = |column: &[f64]| {
            let k = usize::try_from(k).unwrap_or(usize::MAX);
            column.get(k).or(column.first()).copied().unwrap_or(0.0)
        };
        Start { x: of(self.x), v: of(self.v), phase: of(self.phase) }
    }

    /// Start number `k`, with its phase reduced to one period.
    fn at(&self, k: u64) -> Start {
        let given = self.given(k);
        Start { phase: phase::wrap(given.phase), ..given }
    }

    /// Checks all starts. The error for the first invalid one is that of a single start.
    fn check(&self, osc: &vibroimpact::Oscillator, total: u64) -> Result<(), Trouble> {
        (0..total).try_for_each(|k| {
            let Start { x, v, phase } = self.given(k);
            Start::new(osc, x, v, phase).map(|_| ()).map_err(|error| Trouble::question(format!("{error} (start {k})")))
        })
    }
}

fn settle_all(
    osc: &vibroimpact::Oscillator,
    starts: &Starts<'_>,
    total: u64,
    control: &Control<'_>,
) -> Result<(Census, Vec<u32>), Trouble> {
    starts.check(osc, total)?;
    let options = SettleOptions::default();
    let surveyed = SURVEY.min(total);
    let survey = KnownAttractors::survey(osc, (0..surveyed).map(|k| starts.at(total / surveyed * k)), &options);
    let parts = tiles(total, TILE, control, |range, tick| {
        settle_range(osc, range, &|k| starts.at(k), &survey, &options, Width::best(), tick)
    })?;
    let mut merged = Census::default();
    let mut cells = Vec::with_capacity(usize::try_from(total).unwrap_or(0));
    for part in parts {
        let numbers: Vec<u32> =
            part.motions.iter().map(|found| u32::try_from(merged.add_found(found)).unwrap_or(u32::MAX)).collect();
        cells.extend(part.cells.into_iter().map(|local| numbers[local as usize]));
    }
    Ok((merged, cells))
}

/// The JSON objects of the motions in the order of their first start, each with its number of starts, and the motion of each start.
pub(crate) type Many<'py> = (Vec<(String, u64)>, Bound<'py, PyArray1<u32>>);

/// Settles starts given as columns. Each column has the length of the longest one or length 1.
#[pyfunction]
pub(crate) fn settle_many<'py>(
    py: Python<'py>,
    osc: OscillatorFile,
    x: PyReadonlyArray1<'py, f64>,
    v: PyReadonlyArray1<'py, f64>,
    phase: PyReadonlyArray1<'py, f64>,
    threads: usize,
    progress: Option<Py<PyAny>>,
) -> Result<Many<'py>, Trouble> {
    let osc = osc.osc;
    let (Ok(x), Ok(v), Ok(phase)) = (x.as_slice(), v.as_slice(), phase.as_slice()) else {
        return Err(Trouble::question("the starts are not contiguous arrays of doubles"));
    };
    let starts = Starts { x, v, phase };
    let lengths = [x.len(), v.len(), phase.len()];
    let longest = if lengths.contains(&0) { 0 } else { lengths.into_iter().max().unwrap_or(0) };
    if lengths.iter().any(|length| *length != longest && *length != 1) {
        return Err(Trouble::question(format!(
            "the starts have {} positions, {} velocities and {} phases\nhint: as many of each, or one for all",
            lengths[0], lengths[1], lengths[2]
        )));
    }
    let total = longest as u64;
    let watch = Watch { what: "settling motions", total, progress, threads };
    let (census, cells) = door::run_borrowing(py, watch, |control| settle_all(&osc, &starts, total, control))?;
    let motions = census.motions().iter().map(|found| (motion::text(&found.verdict, &osc), found.count)).collect();
    Ok((motions, cells.into_pyarray(py)))
}

//! A study in a store, filled tile by tile.

use crate::door::{self, Watch};
use crate::error::Trouble;
use crate::plan::{read, text};
use pyo3::prelude::*;
use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::{Duration, Instant};
use vibroimpact_store::{Part, Ran, Sampling, Shelf, costs_beside, estimate, shelf};
use vibroimpact_study::Dimension;
use vibroimpact_study::typed::duration;

/// Whether this build supports buckets.
pub(crate) const BUCKETS: bool = cfg!(feature = "s3");

/// The shelf at a place; a bucket is an error in a build without the feature `s3`.
fn place_of(name: &str) -> Result<Arc<dyn Shelf>, Trouble> {
    if !BUCKETS && name.starts_with("s3://") {
        return Err(Trouble::Store(format!(
            "{name}: this build of the package reaches folders only\nhint: `pip install . --config-settings build-args=\"--features s3\"` in the repository builds one that reaches buckets"
        )));
    }
    Ok(shelf(name)?)
}

/// An open store. It uses few resources, so a process opens each store only once.
#[pyclass(frozen, module = "vibroimpact._core")]
pub(crate) struct Store(Arc<vibroimpact_store::Store>);

/// Numbers of tiles: computed, already complete, computed again after damage, and left.
type Counts = (u64, u64, u64, u64);

const fn counts(ran: Ran) -> Counts {
    (ran.computed, ran.found, ran.mended, ran.left)
}

/// The fields of `Status`.
#[derive(IntoPyObject)]
pub(crate) struct Status {
    tiles: u64,
    done: u64,
    points: u64,
    points_done: u64,
    complete: bool,
    points_per_second: Option<f64>,
    seconds_left: Option<f64>,
    /// The points of a tile along each dimension, the slowest first.
    tile: Vec<(String, usize)>,
    /// The points of a shard along each dimension.
    shard: Option<Vec<(String, usize)>>,
    /// The processor time of each tile for which it was recorded.
    seconds_of_tiles: BTreeMap<u64, f64>,
    missing: Vec<u64>,
    missing_left_out: u64,
    bytes: u64,
}

/// The fields of `Verified`.
#[derive(IntoPyObject)]
pub(crate) struct Verified {
    checked: u64,
    recomputed: u64,
    open: u64,
    /// The tile (`None` for the whole store) and a description of the fault.
    damage: Vec<(Option<u64>, String)>,
}

#[pymethods]
impl Store {
    /// Opens the store of a plan, and creates it if absent; without a plan, opens an existing store.
    #[new]
    #[pyo3(signature = (place, plan=None))]
    fn new(py: Python<'_>, place: String, plan: Option<&str>) -> Result<Self, Trouble> {
        let plan = plan.map(read).transpose()?;
        let store = door::run(py, Watch::alone("opening a store"), move |_| {
            let shelf = place_of(&place)?;
            let store = match plan {
                Some(plan) => vibroimpact_store::Store::create(shelf, &plan)?,
                None => vibroimpact_store::Store::open(shelf)?,
            };
            Ok(store.with_costs(costs_beside(&place)?))
        })?;
        Ok(Self(Arc::new(store)))
    }

    /// The plan as JSON.
    #[getter]
    fn plan(&self) -> Result<String, Trouble> {
        text(self.0.plan())
    }

    /// Computes the missing tiles of part (i, n), and concludes the store when all tiles are complete. After a budget of
    /// seconds no tile is begun.
    #[pyo3(signature = (part, threads, progress, budget=None))]
    fn run(
        &self,
        py: Python<'_>,
        part: (u64, u64),
        threads: usize,
        progress: Option<Py<PyAny>>,
        budget: Option<f64>,
    ) -> Result<Counts, Trouble> {
        let (store, part) = (Arc::clone(&self.0), Part::new(part.0, part.1)?);
        let until = budget.and_then(|budget| Instant::now().checked_add(Duration::try_from_secs_f64(budget).ok()?));
        let watch = Watch { what: "filling a store", total: store.points_of(part), progress, threads };
        door::run(py, watch, move |control| Ok(counts(store.run_until(part, until, control)?)))
    }

    /// Computes those of the given tiles that are not complete; does not conclude the store.
    fn run_tiles(&self, py: Python<'_>, mut tiles: Vec<u64>, threads: usize) -> Result<Counts, Trouble> {
        let (store, all) = (Arc::clone(&self.0), self.0.study().grid().tiles());
        tiles.sort_unstable();
        tiles.dedup();
        if let Some(tile) = tiles.iter().find(|tile| **tile >= all) {
            return Err(Trouble::question(format!("tile {tile} is none of the {all} of this store")));
        }
        let watch = Watch { what: "filling tiles", total: 0, progress: None, threads };
        door::run(py, watch, move |control| Ok(counts(store.run_tiles(&tiles, control)?)))
    }

    /// The tiles that are missing or damaged, from coarse to fine, with their points; and how many are damaged.
    fn to_do(&self, py: Python<'_>) -> Result<(Vec<(u64, usize)>, u64), Trouble> {
        let store = Arc::clone(&self.0);
        let watch = Watch { what: "looking at a store", total: 1, progress: None, threads: 0 };
        let (tiles, damaged) = door::run(py, watch, move |control| Ok(store.to_do(control)?))?;
        let grid = self.0.study().grid();
        Ok((tiles.into_iter().map(|tile| (tile, grid.tile(tile).points())).collect(), damaged))
    }

    /// Concludes the store if all tiles are complete. Returns whether they are.
    fn conclude(&self, py: Python<'_>) -> Result<bool, Trouble> {
        let store = Arc::clone(&self.0);
        door::run(py, Watch::alone("concluding a store"), move |_| Ok(store.conclude_if_done()?))
    }

    /// The progress of the store.
    fn status(&self, py: Python<'_>) -> Result<Status, Trouble> {
        let store = Arc::clone(&self.0);
        let watch = Watch::alone("looking at a store");
        let (found, seconds_of_tiles) = door::run(py, watch, move |_| Ok((store.progress()?, store.costs()?.tiles)))?;
        let dimensions = &self.0.study().grid().dimensions;
        Ok(Status {
            tiles: found.tiles,
            done: found.done,
            points: found.points,
            points_done: found.points_done,
            complete: found.complete,
            points_per_second: found.rate,
            seconds_left: found.left.map(|time| time.as_secs_f64()),
            tile: dimensions.iter().map(|dimension| (dimension.name.clone(), dimension.tile)).collect(),
            shard: self.0.shard().map(|shard| {
                let side = |(dimension, tiles): (&Dimension, &usize)| (dimension.name.clone(), tiles * dimension.tile);
                dimensions.iter().zip(shard).map(side).collect()
            }),
            seconds_of_tiles,
            missing: found.missing,
            missing_left_out: found.missing_left_out,
            bytes: found.bytes,
        })
    }

    /// Verifies all checksums and computes some tiles again.
    fn verify(
        &self,
        py: Python<'_>,
        sample: u64,
        seed: u64,
        threads: usize,
        progress: Option<Py<PyAny>>,
    ) -> Result<Verified, Trouble> {
        let store = Arc::clone(&self.0);
        let watch = Watch { what: "verifying a store", total: store.sample_points(sample), progress, threads };
        let found = door::run(py, watch, move |control| Ok(store.verify(sample, seed, control)?))?;
        Ok(Verified {
            checked: found.checked,
            recomputed: found.recomputed,
            open: found.open,
            damage: found.damage.into_iter().map(|damage| (damage.tile, damage.what)).collect(),
        })
    }
}

/// The seconds of a time with units, such as `8h`.
#[pyfunction]
pub(crate) fn seconds_of(text: &str) -> Result<f64, Trouble> {
    Ok(duration(text).map_err(Trouble::question)?.as_secs_f64())
}

/// What a study will cost as JSON, from a sample of blocks that is ended after `budget` seconds.
#[pyfunction]
pub(crate) fn estimate_plan(
    py: Python<'_>,
    plan: &str,
    sample: u32,
    budget: f64,
    threads: usize,
) -> Result<String, Trouble> {
    let plan = read(plan)?;
    let sampling = Sampling { blocks: sample, time: Duration::try_from_secs_f64(budget).unwrap_or(Duration::MAX) };
    let watch = Watch { what: "estimating a study", total: 1, progress: None, threads };
    text(&door::run(py, watch, move |control| Ok(estimate(&plan, sampling, control)?))?)
}

//! The record of the costs of tiles: the processor time that each has taken. They depend on the machine, so they are not in the store but
//! in objects beside it, one for each process. Nothing depends on them but reports, which have their sums over regions.

use crate::shelf::Shelf;
use crate::{Store, StoreError};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant, SystemTime};
use vibroimpact_study::Grid;

/// Minimum time between two writes of one process.
const PAUSE: Duration = Duration::from_secs(10);
/// Maximum number of regions in which costs are reported.
const REGIONS: usize = 64;

/// The costs that this process records, and the shelf on which they are.
pub(crate) struct Costs {
    pub(crate) shelf: Arc<dyn Shelf>,
    key: String,
    kept: Mutex<Kept>,
}

#[derive(Default)]
struct Kept {
    seconds: BTreeMap<u64, f64>,
    /// Whether some costs are not written yet.
    new: bool,
    written: Option<Instant>,
}

impl Costs {
    pub(crate) fn new(shelf: Arc<dyn Shelf>, plan: &str) -> Self {
        let now = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default();
        let key = format!("{plan}-{}{}-{:x}.json", crate::shelf::host(), std::process::id(), now.as_nanos());
        Self { shelf, key, kept: Mutex::default() }
    }

    fn kept(&self) -> std::sync::MutexGuard<'_, Kept> {
        self.kept.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Records the cost of a tile.
    pub(crate) fn add(&self, tile: u64, time: Duration) {
        let mut kept = self.kept();
        kept.seconds.insert(tile, time.as_secs_f64());
        kept.new = true;
        self.write(&mut kept, PAUSE);
    }

    /// Writes what is not written yet.
    pub(crate) fn flush(&self) {
        self.write(&mut self.kept(), Duration::ZERO);
    }

    fn write(&self, kept: &mut Kept, pause: Duration) {
        if !kept.new || kept.written.is_some_and(|last| last.elapsed() < pause) {
            return;
        }
        let tiles: Vec<&u64> = kept.seconds.keys().collect();
        // microseconds are more than enough
        let seconds: Vec<f64> = kept.seconds.values().map(|seconds| (seconds * 1e6).round() / 1e6).collect();
        let text = json!({ "tiles": tiles, "seconds": seconds }).to_string();
        // a study does not fail because its costs cannot be recorded
        let _ = self.shelf.put(&self.key, text.as_bytes());
        kept.new = false;
        kept.written = Some(Instant::now());
    }
}

impl Drop for Costs {
    fn drop(&mut self) {
        self.flush();
    }
}

/// The recorded costs of a study, as processor time in seconds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TileCosts {
    /// The cost of each tile for which one was recorded; of a tile that was computed several times, the largest.
    pub tiles: BTreeMap<u64, f64>,
}

/// The costs of a region, which is a block of tiles.
#[derive(Clone, Debug, PartialEq)]
pub struct RegionCost {
    /// For each dimension, the slowest first, the indices of its first and last point.
    pub ranges: Vec<(usize, usize)>,
    /// Number of tiles in the region with a recorded cost.
    pub tiles: u64,
    /// Their points.
    pub points: u64,
    /// The sum of their costs.
    pub seconds: f64,
}

impl TileCosts {
    /// Sum of the costs.
    #[must_use]
    pub fn seconds(&self) -> f64 {
        self.tiles.values().sum()
    }

    /// The least, median and largest cost of a tile.
    #[must_use]
    pub fn spread(&self) -> Option<(f64, f64, f64)> {
        let mut all: Vec<f64> = self.tiles.values().copied().collect();
        all.sort_by(f64::total_cmp);
        Some((*all.first()?, all[all.len() / 2], *all.last()?))
    }

    /// The costs of at most 64 regions of a grid, in row-major order.
    #[must_use]
    pub fn regions(&self, grid: &Grid) -> Vec<RegionCost> {
        let along = grid.tiles_along();
        let mut sides = vec![1; along.len()];
        // the region is doubled along the dimension with most regions until there are few enough
        let count = |sides: &[usize]| along.iter().zip(sides).map(|(n, side)| n.div_ceil(*side)).collect::<Vec<_>>();
        while count(&sides).iter().product::<usize>() > REGIONS {
            let counts = count(&sides);
            let longest = (0..counts.len()).max_by_key(|k| counts[*k]).unwrap_or(0);
            sides[longest] *= 2;
        }
        let mut regions: BTreeMap<Vec<usize>, RegionCost> = BTreeMap::new();
        for (tile, seconds) in self.tiles.range(..grid.tiles()) {
            let at: Vec<usize> = grid.place(*tile).iter().zip(&sides).map(|(at, side)| at / side).collect();
            let range = |((at, side), d): ((&usize, &usize), &vibroimpact_study::Dimension)| {
                (at * side * d.tile, ((at + 1) * side * d.tile).min(d.count) - 1)
            };
            let empty = || RegionCost {
                ranges: at.iter().zip(&sides).zip(&grid.dimensions).map(range).collect(),
                tiles: 0,
                points: 0,
                seconds: 0.0,
            };
            let region = regions.entry(at.clone()).or_insert_with(empty);
            region.tiles += 1;
            region.points += grid.tile(*tile).points() as u64;
            region.seconds += seconds;
        }
        regions.into_values().collect()
    }
}

impl Store {
    /// This store, with costs recorded and read on the given shelf.
    #[must_use]
    pub fn with_costs(mut self, beside: Arc<dyn Shelf>) -> Self {
        self.costs = Some(Costs::new(beside, &self.plan.hash()));
        self
    }

    /// The recorded costs of this study; none if it has no shelf for them.
    ///
    /// # Errors
    /// [`StoreError::Read`] if the shelf cannot be read. Objects without costs in them are skipped.
    pub fn costs(&self) -> Result<TileCosts, StoreError> {
        let mut found = TileCosts::default();
        let Some(costs) = &self.costs else { return Ok(found) };
        let failed = |key: &str, error| StoreError::Read { place: costs.shelf.name(), key: key.to_owned(), error };
        let prefix = self.plan.hash();
        for item in costs.shelf.list(&prefix).map_err(|error| failed(&prefix, error))? {
            let bytes = costs.shelf.get(&item.key).map_err(|error| failed(&item.key, error))?;
            let read: Value = bytes.and_then(|bytes| serde_json::from_slice(&bytes).ok()).unwrap_or_default();
            let (Some(tiles), Some(seconds)) = (read["tiles"].as_array(), read["seconds"].as_array()) else { continue };
            for (tile, seconds) in tiles.iter().zip(seconds) {
                if let (Some(tile), Some(seconds)) = (tile.as_u64(), seconds.as_f64()) {
                    let entry = found.tiles.entry(tile).or_insert(seconds);
                    *entry = entry.max(seconds);
                }
            }
        }
        Ok(found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use vibroimpact_study::Dimension;

    #[test]
    fn regions_are_few_and_cover_the_grid() {
        let dimension = |name: &str, count| Dimension { name: name.into(), count, tile: 3 };
        let grid = Grid { dimensions: vec![dimension("gap", 100), dimension("x", 40)] };
        let costs = TileCosts { tiles: (0..grid.tiles()).map(|tile| (tile, 0.5)).collect() };
        let regions = costs.regions(&grid);
        assert!(regions.len() <= REGIONS && regions.len() > REGIONS / 4, "{}", regions.len());
        assert_eq!(regions.iter().map(|region| region.points).sum::<u64>(), 4000);
        assert_eq!(regions.iter().map(|region| region.tiles).sum::<u64>(), grid.tiles());
        assert!((regions.iter().map(|region| region.seconds).sum::<f64>() - costs.seconds()).abs() < 1e-9);
        assert_eq!(regions[0].ranges[0].0, 0);
        assert_eq!(regions[regions.len() - 1].ranges, [(96, 99), (36, 39)]);
        assert_eq!(costs.spread(), Some((0.5, 0.5, 0.5)));
        assert_eq!(TileCosts::default().spread(), None);
    }
}

//! What a study will cost: processor time from a sample of its points, files, bytes and memory.
//!
//! The sample is chosen by the plan alone: blocks at the points of a Kronecker sequence, which cover the grid evenly. The
//! processor time of a point varies much (chaos takes the whole budget of impacts), so the time has an interval, from
//! resampling.

use crate::clock::thread_time;
use crate::layout::Layout;
use crate::shards::Shards;
use crate::{Store, StoreError};
use rayon::prelude::*;
use serde::Serialize;
use std::collections::BTreeSet;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};
use vibroimpact_study::Plan;
use vibroimpact_study::study::{Cells, Study};
use vibroimpact_study::{Block, Column, Control, Field, Grid};

/// How a study is sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sampling {
    /// Number of blocks of points that are computed, at least 1.
    pub blocks: u32,
    /// Time after which no block is begun, and blocks that were begun are given up.
    pub time: Duration,
}

impl Default for Sampling {
    /// 64 blocks, 30 seconds.
    fn default() -> Self {
        Self { blocks: 64, time: Duration::from_secs(30) }
    }
}

/// What a study will cost, with the names that JSON has.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Estimate {
    /// Total number of points.
    pub points: u64,
    /// Total number of tiles.
    pub tiles: u64,
    /// Number of points that were computed for the estimate.
    pub points_sampled: u64,
    /// Processor time that they took, in seconds.
    pub seconds_sampled: f64,
    /// Expected processor time of the study in seconds.
    pub processor_seconds: f64,
    /// Interval of 90 % of the expected processor time, from resampling.
    pub processor_seconds_interval: [f64; 2],
    /// Number of threads of a run on this machine.
    pub threads: usize,
    /// Expected time of a run with these threads, in seconds.
    pub seconds: f64,
    /// Number of files or objects, without the tables of a basin.
    pub files: u64,
    /// Expected size of the store in bytes. Numbers of the sample are compressed, which compresses neighbours worse than a
    /// tile does.
    pub bytes: u64,
    /// Size of all numbers without compression.
    pub bytes_raw: u64,
    /// Approximate memory of a run in bytes.
    pub memory_bytes: u64,
}

/// Memory of a process without tiles.
const BARE: u64 = 32 << 20;
/// Number of copies of a tile that its thread has at the same time: results, columns, a padded chunk, bytes.
const COPIES: u64 = 4;
/// Number of resamplings for the interval.
const RESAMPLINGS: usize = 400;

/// A computed block.
struct Probe {
    points: u64,
    seconds: f64,
    columns: Option<Vec<Column>>,
}

/// Estimates what a plan will cost, from a sample of its points.
///
/// # Errors
/// [`StoreError`] for a plan that is invalid or has no grid, when stopped, or when no point was finished in time.
pub fn estimate(plan: &Plan, sampling: Sampling, control: &Control<'_>) -> Result<Estimate, StoreError> {
    let plan = plan.canonical()?;
    let study = Study::new(&plan)?;
    let unreachable = |why| StoreError::Unreachable { place: "the study".into(), why };
    let shards = Shards::of(study.grid(), plan.shard);
    let layout = Layout::new(&study, shards);
    let grid = study.grid();
    let probes = sample(&study, sampling, control)?;
    let pool = control.pool()?;
    let threads = pool.current_num_threads();
    let (sampled, spent) = probes.iter().fold((0, 0.0), |(n, s), probe| (n + probe.points, s + probe.seconds));
    if sampled == 0 {
        return Err(StoreError::NotSampled);
    }
    #[allow(clippy::cast_precision_loss)] // counts below 2^53
    let of_all = |(points, seconds): (u64, f64)| seconds / points as f64 * grid.points() as f64;
    let seconds = of_all((sampled, spent));
    let interval = if sampled >= grid.points() { [seconds, seconds] } else { interval(&probes, of_all) };
    let width = |field: &Field| (field.width() * field.kind.size()) as u64;
    let row: u64 = layout.fields.iter().map(width).sum();
    let bytes_raw = row.saturating_mul(grid.points());
    let share = compressed(&layout, &probes).map_err(unreachable)?;
    let files = layout.files(grid);
    #[allow(clippy::cast_precision_loss, clippy::cast_possible_truncation, clippy::cast_sign_loss)] // an estimate
    let bytes = (bytes_raw as f64 * share) as u64 + files * CHUNK;
    let along: u64 = study.coordinates().iter().map(|along| along.values.len() as u64 * 8).sum();
    let tile = grid.full_tile(0).points() as u64;
    #[allow(clippy::cast_precision_loss)] // a number of threads
    let time = seconds / (threads as f64).min(grid.tiles() as f64);
    Ok(Estimate {
        points: grid.points(),
        tiles: grid.tiles(),
        points_sampled: sampled,
        seconds_sampled: spent,
        processor_seconds: seconds,
        processor_seconds_interval: interval,
        threads,
        seconds: time,
        files,
        bytes: bytes.saturating_add(2 * along),
        bytes_raw,
        memory_bytes: BARE + COPIES * row * tile * threads as u64 + 3 * along,
    })
}

/// Bytes of an empty chunk: the frame of Zstandard and a checksum.
const CHUNK: u64 = 20;

/// Computes the blocks of the sample.
fn sample(study: &Study, sampling: Sampling, control: &Control<'_>) -> Result<Vec<Probe>, StoreError> {
    let blocks = chosen(study.grid(), study.together(), sampling.blocks.max(1));
    let begun = Instant::now();
    let late = || begun.elapsed() >= sampling.time;
    let one = |block: &Block| -> Option<Probe> {
        if control.stopping() || late() {
            return None;
        }
        let (ticks, before) = (AtomicU64::new(0), thread_time());
        let tick = || {
            ticks.fetch_add(1, Ordering::Relaxed);
            control.stopping() || late()
        };
        let columns = study.block(block, &tick);
        let seconds = thread_time().saturating_sub(before).as_secs_f64();
        // of a block that was given up, the points that were computed count
        let points = if columns.is_some() { block.points() as u64 } else { ticks.into_inner() };
        (control.progress)(points);
        (points > 0).then_some(Probe { points, seconds, columns })
    };
    // what all tiles share, such as a survey, is computed once by the first block, so the second time it is measured alone
    let Some((first, rest)) = blocks.split_first() else { return Ok(Vec::new()) };
    let mut probes: Vec<Probe> = one(first).into_iter().collect();
    if !late() && !rest.is_empty() {
        probes = control.pool()?.install(|| blocks.par_iter().filter_map(one).collect());
    }
    if control.stopping() {
        let done = probes.iter().map(|probe| probe.points).sum();
        return Err(StoreError::Stopped(vibroimpact_study::Stopped { done, total: study.grid().points() }));
    }
    Ok(probes)
}

/// The blocks of the sample: those of a lattice of blocks that contain the points of a Kronecker sequence.
fn chosen(grid: &Grid, together: u64, count: u32) -> Vec<Block> {
    let dimensions = grid.dimensions.len();
    // the generalised golden ratio gives the most even sequence known
    let mut golden = 2.0_f64;
    for _ in 0..64 {
        golden = (1.0 + golden).powf(1.0 / (dimensions as f64 + 1.0));
    }
    let mut side = 1_u64;
    while side < u64::from(u32::MAX) && side.saturating_pow(u32::try_from(dimensions).unwrap_or(1)) < together {
        side *= 2;
    }
    let side = usize::try_from(side).unwrap_or(usize::MAX);
    let mut blocks: Vec<Block> = Vec::new();
    let mut known = BTreeSet::new();
    // some points share a block, and a small grid has fewer blocks
    for k in 1..=2 * u64::from(count) {
        let range = |(d, dimension): (usize, &vibroimpact_study::Dimension)| {
            #[allow(clippy::cast_precision_loss)] // counts
            let at = (0.5 + k as f64 / golden.powi(i32::try_from(d + 1).unwrap_or(1))).fract() * dimension.count as f64;
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // 0 <= at < count
            let at = (at as usize).min(dimension.count - 1);
            let tile = at / dimension.tile * dimension.tile;
            let (side, end) = (side.min(dimension.tile), (tile + dimension.tile).min(dimension.count));
            let from = tile + (at - tile) / side * side;
            from..(from + side).min(end)
        };
        let block = Block { ranges: grid.dimensions.iter().enumerate().map(range).collect() };
        let starts: Vec<usize> = block.ranges.iter().map(|range| range.start).collect();
        if blocks.len() < count as usize && known.insert(starts) {
            blocks.push(block);
        }
    }
    blocks
}

/// The 5th and 95th percentile of the estimate over resamplings of the blocks.
fn interval(probes: &[Probe], of_all: impl Fn((u64, f64)) -> f64) -> [f64; 2] {
    let mut state = 1_u64;
    let mut next = || {
        // SplitMix64
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (state ^ (state >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        usize::try_from((z ^ (z >> 31)) % probes.len() as u64).unwrap_or(0)
    };
    let mut all: Vec<f64> = (0..RESAMPLINGS)
        .map(|_| {
            let again = (0..probes.len()).map(|_| &probes[next()]);
            of_all(again.fold((0, 0.0), |(n, s), probe| (n + probe.points, s + probe.seconds)))
        })
        .collect();
    all.sort_by(f64::total_cmp);
    [all[RESAMPLINGS / 20], all[RESAMPLINGS - 1 - RESAMPLINGS / 20]]
}

/// The share of its size to which the numbers of the sample are compressed.
fn compressed(layout: &Layout, probes: &[Probe]) -> Result<f64, String> {
    let (mut raw, mut small) = (0_u64, 0_u64);
    for (number, field) in layout.fields.iter().enumerate() {
        let parts = || probes.iter().filter_map(|probe| probe.columns.as_ref()?.get(number));
        // the numbers fill a chunk of a tile, if there are so many
        let array = &layout.arrays[number];
        let mut chunk = field.empty(layout.grid.full_tile(0).points());
        let mut filled = 0;
        for part in parts() {
            let fits = part.len().min(chunk.len() - filled);
            chunk.copy(filled, part, 0, fits);
            filled += fits;
        }
        if filled > 0 {
            raw += (filled * field.kind.size()) as u64;
            small += (array.encode(&Cells::Numbers(chunk))?.len() as u64).saturating_sub(CHUNK);
        }
    }
    #[allow(clippy::cast_precision_loss)] // sizes of a tile
    Ok(if raw == 0 { 1.0 } else { (small as f64 / raw as f64).min(1.0) })
}

impl Layout {
    /// Number of objects of a complete store, without final tables.
    fn files(&self, grid: &Grid) -> u64 {
        let each = self.fields.len() as u64 + 1;
        let shards = self.shards.as_ref().map_or_else(|| grid.tiles(), Shards::count);
        shards.saturating_mul(each).saturating_add(each + 2 * self.coordinates.len() as u64 + 1)
    }
}

impl Store {
    /// Number of objects of this store when it is complete, without final tables.
    #[must_use]
    pub fn files(&self) -> u64 {
        self.layout.files(self.study.grid())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use vibroimpact_study::Dimension;

    #[test]
    fn the_sample_covers_the_grid_evenly() {
        let dimension = |name: &str, count, tile| Dimension { name: name.into(), count, tile };
        let grid = Grid { dimensions: vec![dimension("gap", 100, 16), dimension("x", 70, 16)] };
        for (together, sides) in [(1, 1), (256, 16), (u64::MAX, 16)] {
            let blocks = chosen(&grid, together, 16);
            assert_eq!(blocks.len(), 16);
            for block in &blocks {
                assert!(block.ranges.iter().all(|range| range.len() <= sides && !range.is_empty()));
                assert!(block.ranges.iter().all(|range| range.start / 16 == (range.end - 1) / 16));
            }
            let corner = |i: usize, j: usize| {
                let inside = |block: &&Block| block.ranges[0].start / 50 == i && block.ranges[1].start / 35 == j;
                blocks.iter().filter(inside).count()
            };
            let corners = [corner(0, 0), corner(0, 1), corner(1, 0), corner(1, 1)];
            assert!(together > 1 || corners.iter().all(|count| (3..=5).contains(count)), "{corners:?}");
            assert_eq!(blocks, chosen(&grid, together, 16));
        }
        let small = Grid { dimensions: vec![dimension("x", 3, 3)] };
        let starts: BTreeSet<usize> = chosen(&small, 1, 64).iter().map(|block| block.ranges[0].start).collect();
        assert_eq!(starts, BTreeSet::from([0, 1, 2]));
    }
}

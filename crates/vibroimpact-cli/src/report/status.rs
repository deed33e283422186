//! The progress of a store: as a JSON object, as text, and as one line.

use crate::failure::Failure;
use crate::report::stored::title;
use crate::report::tallies::{damaged, undecided};
use crate::session::Session;
use serde::{Serialize, Serializer};
use std::time::{Duration, SystemTime};
use vibroimpact_store::{Progress, RegionCost, Store, TileCosts};
use vibroimpact_study::{Grid, Plan, counted};

/// The progress of a store.
pub(crate) struct Status<'a> {
    store: &'a Store,
    found: Progress,
    costs: TileCosts,
    undecided: Option<u64>,
    damaged: Option<u64>,
}

#[derive(Serialize)]
struct StatusFields<'a> {
    store: String,
    tiles: u64,
    tiles_done: u64,
    tiles_left: u64,
    /// Number of complete tiles with a damaged chunk; null for a large store, for which `vibro verify` finds it.
    tiles_damaged: Option<u64>,
    points: u64,
    points_done: u64,
    /// Number of points with an undecided motion among those done; null for a store without labels or with very many points.
    points_undecided: Option<u64>,
    /// Points done over points, 0 to 1.
    progress: f64,
    complete: bool,
    /// Points per second at the rate of the last tiles.
    points_per_second: Option<f64>,
    /// Estimated seconds for the remaining tiles, at the rate of the last ones.
    seconds_left: Option<f64>,
    /// Seconds since the last tile was completed.
    seconds_since: Option<f64>,
    /// Points of a tile along each dimension.
    tile: Sides<'a>,
    /// Points of a shard along each dimension; null for a store without shards.
    shard: Option<Sides<'a>>,
    /// Number of files of the complete store, without final tables.
    files: u64,
    /// Recorded processor time; null if none was recorded.
    cost: Option<CostFields<'a>>,
    /// Numbers of the missing tiles, at most a thousand.
    missing: &'a [u64],
    /// Number of further missing tiles.
    missing_left_out: u64,
    bytes: u64,
    begun_by: &'a str,
    plan: &'a Plan,
    plan_hash: String,
}

/// Processor time in seconds.
#[derive(Serialize)]
struct CostFields<'a> {
    /// Number of tiles with a recorded cost.
    tiles: u64,
    seconds: f64,
    seconds_per_tile: Spread,
    /// Processor time of the tiles that are left, if they cost as much as those done.
    seconds_left: f64,
    /// At most 64 blocks of tiles.
    regions: Vec<RegionFields<'a>>,
}

#[derive(Serialize)]
struct Spread {
    mean: f64,
    least: f64,
    median: f64,
    largest: f64,
}

#[derive(Serialize)]
struct RegionFields<'a> {
    /// For each dimension, the indices of the first and last point.
    over: Ranges<'a>,
    tiles: u64,
    points: u64,
    seconds: f64,
    seconds_per_point: f64,
}

/// An object with a value for each dimension.
struct Sides<'a>(&'a Grid, Option<&'a [usize]>);

impl Serialize for Sides<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let sides = self.0.dimensions.iter().enumerate();
        serializer.collect_map(sides.map(|(k, of)| (&of.name, self.1.map_or(1, |shard| shard[k]) * of.tile)))
    }
}

struct Ranges<'a>(&'a Grid, Vec<(usize, usize)>);

impl Serialize for Ranges<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.dimensions.iter().map(|of| &of.name).zip(&self.1))
    }
}

#[allow(clippy::cast_precision_loss)] // counts below 2^53
fn ratio(part: u64, whole: u64) -> f64 {
    if whole == 0 { 0.0 } else { part as f64 / whole as f64 }
}

impl<'a> Status<'a> {
    /// Everything, with what needs all chunks to be read if the store is not large.
    pub(crate) fn whole(store: &'a Store, session: &Session) -> Result<Self, Failure> {
        let undecided = undecided(store).unwrap_or(None);
        Ok(Self { undecided, damaged: damaged(store, session)?, ..Self::brief(store)? })
    }

    /// What is known without reading chunks.
    pub(crate) fn brief(store: &'a Store) -> Result<Self, Failure> {
        Ok(Self { store, found: store.progress()?, costs: store.costs()?, undecided: None, damaged: None })
    }

    pub(crate) const fn complete(&self) -> bool {
        self.found.complete
    }

    fn since(&self) -> Option<Duration> {
        self.found.last.and_then(|last| SystemTime::now().duration_since(last).ok())
    }

    fn progress(&self) -> f64 {
        ratio(self.found.points_done, self.found.points)
    }

    fn cost(&self) -> Option<CostFields<'_>> {
        let (least, median, largest) = self.costs.spread()?;
        let grid = self.store.study().grid();
        let (tiles, seconds) = (self.costs.tiles.len() as u64, self.costs.seconds());
        let regions = self.costs.regions(grid);
        let points: u64 = regions.iter().map(|region| region.points).sum();
        let region = |RegionCost { ranges, tiles, points, seconds }| RegionFields {
            over: Ranges(grid, ranges),
            tiles,
            points,
            seconds,
            seconds_per_point: seconds / ratio(points, 1),
        };
        Some(CostFields {
            tiles,
            seconds,
            seconds_per_tile: Spread { mean: seconds / ratio(tiles, 1), least, median, largest },
            seconds_left: seconds * ratio(self.found.points - self.found.points_done, points),
            regions: regions.into_iter().map(region).collect(),
        })
    }

    pub(crate) fn fields(&self) -> impl Serialize {
        let Self { store, found, .. } = self;
        StatusFields {
            store: store.place(),
            tiles: found.tiles,
            tiles_done: found.done,
            tiles_left: found.tiles - found.done,
            tiles_damaged: self.damaged,
            points: found.points,
            points_done: found.points_done,
            points_undecided: self.undecided,
            progress: self.progress(),
            complete: found.complete,
            points_per_second: found.rate,
            seconds_left: found.left.map(|left| left.as_secs_f64()),
            seconds_since: self.since().map(|since| since.as_secs_f64()),
            tile: Sides(store.study().grid(), None),
            shard: store.shard().map(|shard| Sides(store.study().grid(), Some(shard))),
            files: store.files(),
            cost: self.cost(),
            missing: &found.missing,
            missing_left_out: found.missing_left_out,
            bytes: found.bytes,
            begun_by: store.begun_by(),
            plan: store.plan(),
            plan_hash: store.plan().hash(),
        }
    }

    /// One line without the plan, for a watch.
    pub(crate) fn line(&self) -> String {
        let found = &self.found;
        let mut line = format!(
            "{:.1} %  {} of {}, {} of {}",
            100.0 * self.progress(),
            found.done,
            counted(found.tiles, "tile"),
            found.points_done,
            counted(found.points, "point")
        );
        if found.complete {
            line.push_str(", complete");
        } else if let Some(left) = found.left {
            line.push_str(&format!(", about {} left", clock(left)));
            line.push_str(&self.since().map_or_else(String::new, |since| format!(", the last {} ago", clock(since))));
        }
        line.push('\n');
        line
    }

    pub(crate) fn text(&self) -> String {
        let Self { store, found, .. } = self;
        let mut text = format!(
            "{}\n{} of {}, {} of {} ({:.1} %); {}\n",
            title(store.plan()),
            found.done,
            counted(found.tiles, "tile"),
            found.points_done,
            counted(found.points, "point"),
            100.0 * self.progress(),
            size(found.bytes)
        );
        text.push_str(&format!("tiles: {}", sides(store.study().grid(), None)));
        let shard = store.shard().map(|shard| sides(store.study().grid(), Some(shard)));
        text.push_str(&shard.map_or_else(String::new, |shard| format!("; shards: {shard}")));
        text.push_str(&format!("; {} files when complete\n", store.files()));
        text.push_str(&open(found.points - found.points_done, self.undecided));
        if let Some(damaged) = self.damaged.filter(|count| *count > 0) {
            text.push_str(&format!("{} damaged: `vibro resume` computes them anew\n", counted(damaged, "tile")));
        }
        if let Some(cost) = self.cost() {
            text.push_str(&spent(&cost));
        }
        if found.complete {
            text.push_str("complete\n");
        } else {
            if let (Some(left), Some(rate)) = (found.left, found.rate) {
                text.push_str(&format!("about {} left at {rate:.3} points/s, the rate of the last tiles", clock(left)));
                text.push_str(
                    &self.since().map_or_else(String::new, |since| format!(", the last {} ago", clock(since))),
                );
                text.push('\n');
            }
            text.push_str(&missing(&found.missing, found.tiles - found.done));
        }
        text.push_str(&format!(
            "\nplan {}, begun by vibroimpact {}\n\n{}",
            store.plan().hash(),
            store.begun_by(),
            store.plan().to_toml()
        ));
        text
    }
}

/// The text of the recorded costs.
fn spent(cost: &CostFields<'_>) -> String {
    let Spread { mean, largest, .. } = cost.seconds_per_tile;
    let mut text = format!(
        "processor time: {} for {}, {} a tile on average, {} at most",
        clock(Duration::from_secs_f64(cost.seconds)),
        counted(cost.tiles, "tile"),
        short(mean),
        short(largest)
    );
    if cost.seconds_left > 0.0 {
        text.push_str(&format!("; about {} to go", clock(Duration::from_secs_f64(cost.seconds_left))));
    }
    text.push('\n');
    text
}

fn short(seconds: f64) -> String {
    if seconds < 10.0 { format!("{seconds:.2} s") } else { clock(Duration::from_secs_f64(seconds)) }
}

/// The points of a tile, or of a shard with these tiles, along each axis, the abscissa first.
fn sides(grid: &Grid, shard: Option<&[usize]>) -> String {
    let side = |(k, d): (usize, &vibroimpact_study::Dimension)| {
        format!("{} {}", d.tile * shard.map_or(1, |shard| shard[k]), d.name)
    };
    grid.dimensions.iter().enumerate().rev().map(side).collect::<Vec<_>>().join(" by ")
}

/// The points that are not computed, and those with a motion that is undecided.
fn open(missing: u64, undecided: Option<u64>) -> String {
    let missing = (missing > 0).then(|| format!("{} not computed", counted(missing, "point")));
    let undecided = undecided.filter(|count| *count > 0);
    let undecided = undecided.map(|count| format!("{} with an undecided motion", counted(count, "point")));
    let all: Vec<String> = missing.into_iter().chain(undecided).collect();
    if all.is_empty() { String::new() } else { format!("{}\n", all.join(", ")) }
}

/// The text of the numbers of missing tiles, with consecutive numbers joined.
fn missing(tiles: &[u64], count: u64) -> String {
    const SHOWN: usize = 8;
    if count == 0 {
        return "all tiles are there, but the store was not concluded: `vibro resume` does that\n".into();
    }
    let runs: Vec<&[u64]> = tiles.chunk_by(|a, b| a + 1 == *b).collect();
    let name = |run: &&[u64]| match run {
        [one] => one.to_string(),
        run => format!("{} to {}", run[0], run[run.len() - 1]),
    };
    let named: Vec<String> = runs.iter().take(SHOWN).map(name).collect();
    let shown: u64 = runs.iter().take(SHOWN).map(|run| run.len() as u64).sum();
    let more = if shown < count { format!(" and {} more", count - shown) } else { String::new() };
    format!("missing tiles: {}{more}\n", named.join(", "))
}

/// A time for human readers.
pub(crate) fn clock(time: Duration) -> String {
    let s = time.as_secs();
    match s {
        0..=99 => format!("{s} s"),
        100..=5999 => format!("{} min", s / 60),
        6000..=359_999 => format!("{} h {} min", s / 3600, s / 60 % 60),
        _ => format!("{} days", s / 86_400),
    }
}

/// A number of bytes for human readers.
#[allow(clippy::cast_precision_loss)] // for human readers
pub(crate) fn size(bytes: u64) -> String {
    match bytes {
        0..=9_999 => format!("{bytes} bytes"),
        10_000..=9_999_999 => format!("{:.0} kB", bytes as f64 / 1e3),
        10_000_000..=9_999_999_999 => format!("{:.1} MB", bytes as f64 / 1e6),
        _ => format!("{:.1} GB", bytes as f64 / 1e9),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_for_people() {
        assert_eq!(missing(&[0, 1, 2, 7, 9, 10], 6), "missing tiles: 0 to 2, 7, 9 to 10\n");
        assert!(missing(&[], 0).contains("not concluded"));
        assert_eq!(open(0, Some(0)), "");
        assert_eq!(open(7, Some(1)), "7 points not computed, 1 point with an undecided motion\n");
        assert_eq!(open(0, None), "");
        let odd: Vec<u64> = (0..40).map(|k| 2 * k).collect();
        assert!(missing(&odd, 40).ends_with("14 and 32 more\n"));
        assert_eq!(missing(&[0, 1, 2], 5000), "missing tiles: 0 to 2 and 4997 more\n");
        assert_eq!([50, 4000, 40_000].map(|s| clock(Duration::from_secs(s))), ["50 s", "66 min", "11 h 6 min"]);
        assert_eq!(clock(Duration::from_secs(900_000)), "10 days");
        assert_eq!([12, 20_000, 20_000_000].map(size), ["12 bytes", "20 kB", "20.0 MB"]);
    }
}

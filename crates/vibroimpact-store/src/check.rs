//! The progress of a store, and the verification of its contents against its plan.

use crate::memory::Memory;
use crate::run::State;
use crate::{Store, StoreError, order};
use rayon::prelude::*;
use std::sync::Arc;
use std::time::{Duration, SystemTime};
use vibroimpact_study::study::Study;
use vibroimpact_study::{Column, Control, Meter};

/// The progress of a store.
#[derive(Clone, Debug, PartialEq)]
pub struct Progress {
    /// Total number of tiles.
    pub tiles: u64,
    /// Number of complete tiles.
    pub done: u64,
    /// Total number of points.
    pub points: u64,
    /// Number of points of complete tiles.
    pub points_done: u64,
    /// Whether the store was concluded.
    pub complete: bool,
    /// Time at which the first tile was completed, if the place records it.
    pub first: Option<SystemTime>,
    /// Time at which the last tile was completed.
    pub last: Option<SystemTime>,
    /// Points per second at the rate of the last tiles; `None` if unknown.
    pub rate: Option<f64>,
    /// Estimated time for the remaining tiles at the rate of the last ones; `None` if unknown.
    pub left: Option<Duration>,
    /// Numbers of the tiles that are not complete, at most a thousand.
    pub missing: Vec<u64>,
    /// Number of further tiles that are not complete.
    pub missing_left_out: u64,
    /// Size of the store in bytes.
    pub bytes: u64,
}

/// A fault of a tile or of the metadata of the store.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Damage {
    /// The tile; `None` for a fault of the whole store.
    pub tile: Option<u64>,
    /// Description of the fault.
    pub what: String,
}

/// What a verification found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Verified {
    /// Number of tiles whose checksums were verified.
    pub checked: u64,
    /// Number of tiles that were computed again and compared byte by byte.
    pub recomputed: u64,
    /// Number of tiles that are not complete.
    pub open: u64,
    /// All faults that were found.
    pub damage: Vec<Damage>,
}

/// Number of recent tiles from whose times the remaining time is estimated.
const RECENT: usize = 64;
/// Maximum number of missing tiles that are listed.
const NAMED: usize = 1000;

impl Store {
    /// The progress of the store.
    ///
    /// # Errors
    /// [`StoreError`] if the place cannot be read.
    pub fn progress(&self) -> Result<Progress, StoreError> {
        let items = self.list("")?;
        let grid = self.study.grid();
        let at = |key: &str| items.binary_search_by(|item| item.key.as_str().cmp(key)).ok();
        let waiting = |tile: u64| at(&self.layout.shards.as_ref()?.loose_key(tile));
        let find = |tile: &u64| at(&self.layout.status_key(*tile)).or_else(|| waiting(*tile));
        let (mut done, mut points_done, mut missing, mut times) = (0, 0, Vec::new(), Vec::new());
        for tile in 0..grid.tiles() {
            if let Some(at) = find(&tile) {
                done += 1;
                points_done += grid.tile(tile).points() as u64;
                times.push((items[at].modified, grid.tile(tile).points() as u64));
            } else if missing.len() < NAMED {
                missing.push(tile);
            }
        }
        times.sort_unstable();
        let recent = &times[times.len().saturating_sub(RECENT)..];
        #[allow(clippy::cast_precision_loss)] // numbers of points below 2^53
        let rate = match recent {
            [(first, _), rest @ .., (last, points)] => {
                last.duration_since(*first).ok().filter(|time| !time.is_zero()).map(|time| {
                    (rest.iter().map(|(_, points)| points).sum::<u64>() + points) as f64 / time.as_secs_f64()
                })
            }
            _ => None,
        };
        #[allow(clippy::cast_precision_loss)] // numbers of points below 2^53
        let left = rate
            .filter(|_| done < grid.tiles())
            .and_then(|rate| Duration::try_from_secs_f64((grid.points() - points_done) as f64 / rate).ok());
        Ok(Progress {
            tiles: grid.tiles(),
            done,
            points: grid.points(),
            points_done,
            complete: done == grid.tiles() && self.concluded()?,
            first: times.first().map(|(time, _)| *time),
            last: times.last().map(|(time, _)| *time),
            rate,
            left,
            missing_left_out: grid.tiles() - done - missing.len() as u64,
            missing,
            bytes: items.iter().map(|item| item.size).sum(),
        })
    }

    /// Number of complete tiles with a missing or damaged chunk. All checksums are verified.
    ///
    /// # Errors
    /// [`StoreError`] if the place cannot be read.
    pub fn damaged(&self, control: &Control<'_>) -> Result<u64, StoreError> {
        Ok(self.to_do(control)?.1)
    }

    /// The tiles that are missing or damaged, in the order in which they are computed, and the number of damaged ones. All
    /// checksums are verified.
    ///
    /// # Errors
    /// [`StoreError`] if the place cannot be read, or when stopped.
    pub fn to_do(&self, control: &Control<'_>) -> Result<(Vec<u64>, u64), StoreError> {
        let grid = self.study.grid();
        let all: Vec<u64> = (0..grid.tiles()).collect();
        let states = control.pool()?.install(|| self.states(&all, &|| control.stopping()))?;
        let stopped = || StoreError::Stopped(Meter::new(control, 0, grid.points()).stopped());
        let states = states.ok_or_else(stopped)?;
        let damaged = states.iter().filter(|state| **state == State::Damaged).count() as u64;
        let open: Vec<u64> =
            all.into_iter().zip(states).filter(|(_, state)| *state != State::Whole).map(|(tile, _)| tile).collect();
        Ok((order::tiles(grid, self.layout.shards.as_ref(), &open, 0), damaged))
    }

    /// Whether the root states that the store was concluded.
    pub(crate) fn concluded(&self) -> Result<bool, StoreError> {
        Ok(self.root()?.pointer("/attributes/complete").and_then(serde_json::Value::as_i64) == Some(1))
    }

    /// Compares the metadata of the store with its plan, verifies the checksums of all complete tiles, computes
    /// `sample` tiles (chosen by `seed`) again and compares their bytes. Changes nothing.
    ///
    /// # Errors
    /// [`StoreError`] if the place cannot be read.
    pub fn verify(&self, sample: u64, seed: u64, control: &Control<'_>) -> Result<Verified, StoreError> {
        let grid = self.study.grid();
        let tiles: Vec<u64> = (0..grid.tiles()).collect();
        let pool = control.pool()?;
        let stopping = || StoreError::Stopped(Meter::new(control, 0, grid.points()).kept());
        let states = pool.install(|| self.states(&tiles, &|| control.stopping()))?.ok_or_else(stopping)?;
        let mut damage = self.description_damage(states.iter().all(|state| *state == State::Whole))?;
        let torn = |tile: u64| Damage {
            tile: Some(tile),
            what: "a chunk is missing, cut short or has a wrong check sum".into(),
        };
        let with =
            |wanted| (tiles.iter().zip(&states)).filter(move |(_, state)| **state == wanted).map(|(tile, _)| *tile);
        damage.extend(with(State::Damaged).map(torn));
        damage.extend(self.shard_damage(&states)?);
        let whole: Vec<u64> = with(State::Whole).collect();
        let chosen = choose(&whole, sample, seed);
        let points = |tile: u64| grid.tile(tile).points() as u64;
        let meter = Meter::new(control, 0, chosen.iter().map(|tile| points(*tile)).sum());
        let shelf = Arc::new(Memory::default());
        let lengths: Vec<usize> = grid.dimensions.iter().map(|dimension| dimension.tile).collect();
        let study = Study::new(&self.plan)?.with_tiles(&lengths, |name| self.field(name).is_some());
        let twin = Self::of(shelf, self.plan.clone(), study, self.begun_by.clone(), self.format());
        let concluded = self.concluded()?;
        let compared = pool.install(|| {
            let compare = |tile: &u64| -> Result<Option<Damage>, StoreError> {
                let part = meter.tile(points(*tile));
                if !twin.fill(*tile, &|| part.tick())? {
                    return Err(StoreError::Stopped(meter.kept()));
                }
                part.finish();
                Ok(self.differs(&twin, *tile, concluded)?.map(|what| Damage { tile: Some(*tile), what }))
            };
            chosen.par_iter().map(compare).collect::<Result<Vec<_>, StoreError>>()
        })?;
        damage.extend(compared.into_iter().flatten());
        damage.sort_by_key(|damage| damage.tile);
        Ok(Verified {
            checked: grid.tiles() - with(State::Open).count() as u64,
            recomputed: chosen.len() as u64,
            open: with(State::Open).count() as u64,
            damage,
        })
    }

    /// Refuses a store with a damaged tile. All checksums are verified; nothing is changed.
    ///
    /// # Errors
    /// [`StoreError::DamagedTile`] for the first damaged tile; other errors if the place cannot be read.
    pub fn whole(&self, control: &Control<'_>) -> Result<(), StoreError> {
        let grid = self.study.grid();
        let meter = Meter::new(control, 0, grid.points());
        let read = |tile: u64| {
            if control.stopping() {
                return Err(StoreError::Stopped(meter.stopped()));
            }
            meter.tile(grid.tile(tile).points() as u64).finish();
            self.tile(tile).map(drop)
        };
        let tiles: Vec<_> = control.pool()?.install(|| (0..grid.tiles()).into_par_iter().map(read).collect());
        // the first error in the order of the tiles, independent of the threads
        tiles.into_iter().collect()
    }

    /// Maximum number of points that [`Store::verify`] computes again, for progress reports.
    #[must_use]
    pub fn sample_points(&self, sample: u64) -> u64 {
        let grid = self.study.grid();
        sample.min(grid.tiles()).saturating_mul(grid.tile(0).points() as u64).min(grid.points())
    }

    /// Describes how a tile of this store differs from the same tile of `twin`, if it does.
    fn differs(&self, twin: &Self, tile: u64, concluded: bool) -> Result<Option<String>, StoreError> {
        for field in 0..self.layout.fields.len() {
            let (here, there) = (self.sound(tile, field)?, twin.sound(tile, field)?);
            if here == there {
                continue;
            }
            // preliminary numbers of cycles become final ones when the store is concluded
            let renumbered = match (&here, &there) {
                (Some((_, Column::I32(here))), Some((_, Column::I32(there)))) => {
                    here.len() == there.len()
                        && here.iter().zip(there).all(|(a, b)| a == b || (concluded && *b < -1 && *a >= 0))
                }
                _ => false,
            };
            // with the final numbers, the bytes of the chunk must be equal, also beyond the edge of the grid
            let same = match (renumbered, &here) {
                (true, Some((chunk, column))) => self.encoded(tile, field, column)? == *chunk,
                _ => false,
            };
            if !same {
                let by = match (&here, &there) {
                    (Some((_, here)), Some((_, there))) => difference(here.real(), there.real()),
                    _ => String::new(),
                };
                return Ok(Some(format!("`{}` is not what the plan gives{by}", self.layout.key(tile, field))));
            }
        }
        Ok(None)
    }
}

/// By how much numbers differ, relative to their size, so that the rounding of another version is told from a wrong result; empty
/// where something else than finite numbers differs.
fn difference(here: &[f64], there: &[f64]) -> String {
    let differing: Vec<_> = here.iter().zip(there).filter(|(a, b)| a.to_bits() != b.to_bits()).collect();
    let relative = |(a, b): &(&f64, &f64)| (*a - *b).abs() / a.abs().max(b.abs());
    let most = differing.iter().map(relative).fold(0.0, |most: f64, by| if by.is_nan() { by } else { most.max(by) });
    if differing.is_empty() || !most.is_finite() {
        return String::new();
    }
    format!(": {} of {} numbers differ, by {most:.1e} of their size or less", differing.len(), here.len())
}

/// A random choice of tiles, determined by a seed.
fn choose(whole: &[u64], sample: u64, seed: u64) -> Vec<u64> {
    let key = |tile: u64| {
        // SplitMix64
        let z = (tile ^ seed.rotate_left(32)).wrapping_add(0x9E37_79B9_7F4A_7C15).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    };
    let mut order = whole.to_vec();
    order.sort_by_key(|tile| key(*tile));
    order.truncate(usize::try_from(sample).unwrap_or(usize::MAX));
    order.sort_unstable();
    order
}

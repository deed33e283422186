//! How far a store is, and whether what is in it is what its plan gives.

use crate::run::State;
use crate::shelf::Memory;
use crate::{Store, StoreError};
use rayon::prelude::*;
use std::sync::Arc;
use std::time::{Duration, SystemTime};
use vibroimpact_study::Column;
use vibroimpact_study::{Control, Meter};

/// How far a store is.
#[derive(Clone, Debug, PartialEq)]
pub struct Progress {
    /// Tiles in all.
    pub tiles: u64,
    /// Tiles that are done.
    pub done: u64,
    /// Points in all.
    pub points: u64,
    /// Points of the tiles that are done.
    pub points_done: u64,
    /// Whether it was concluded.
    pub complete: bool,
    /// When the first tile was done, if the place records it.
    pub first: Option<SystemTime>,
    /// When the last one was.
    pub last: Option<SystemTime>,
    /// How long the rest will take at the rate of the last tiles; `None` where that is unknown.
    pub left: Option<Duration>,
    /// Numbers of the tiles that are not done, up to a thousand of them.
    pub missing: Vec<u64>,
    /// Tiles that are not done and not among these.
    pub missing_left_out: u64,
    /// Bytes of the store.
    pub bytes: u64,
}

/// What is wrong with a tile, or with what describes the store.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Damage {
    /// The tile; `None` for what belongs to the whole store.
    pub tile: Option<u64>,
    /// What is wrong.
    pub what: String,
}

/// What a verification found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Verified {
    /// Tiles whose check sums were read.
    pub checked: u64,
    /// Tiles that were computed again and compared byte by byte.
    pub recomputed: u64,
    /// Tiles that are not done.
    pub open: u64,
    /// What is wrong.
    pub damage: Vec<Damage>,
}

/// Tiles whose times are looked at to tell how long the rest will take.
const RECENT: usize = 64;
/// Tiles that are named.
const NAMED: usize = 1000;

impl Store {
    /// How far it is.
    ///
    /// # Errors
    /// [`StoreError`] when the place cannot be read.
    pub fn progress(&self) -> Result<Progress, StoreError> {
        let items = self.shelf.list("").map_err(|error| self.unread("", error))?;
        let grid = self.study.grid();
        let key = |tile: u64| self.layout.status.key(&self.layout.status_place(tile));
        let find = |tile: &u64| items.binary_search_by(|item| item.key.cmp(&key(*tile))).ok();
        let (mut done, mut points_done, mut missing, mut times) = (0, 0, Vec::new(), Vec::new());
        for tile in 0..grid.tiles() {
            if let Some(at) = find(&tile) {
                done += 1;
                points_done += grid.tile(tile).points() as u64;
                times.push(items[at].modified);
            } else if missing.len() < NAMED {
                missing.push(tile);
            }
        }
        times.sort_unstable();
        let recent = &times[times.len().saturating_sub(RECENT)..];
        let left = match recent {
            [first, .., last] if done < grid.tiles() => last.duration_since(*first).ok().map(|time| {
                #[allow(clippy::cast_precision_loss)] // numbers of tiles
                let share = (grid.tiles() - done) as f64 / (recent.len() - 1) as f64;
                time.mul_f64(share)
            }),
            _ => None,
        };
        Ok(Progress {
            tiles: grid.tiles(),
            done,
            points: grid.points(),
            points_done,
            complete: done == grid.tiles() && self.concluded()?,
            first: times.first().copied(),
            last: times.last().copied(),
            left,
            missing_left_out: grid.tiles() - done - missing.len() as u64,
            missing,
            bytes: items.iter().map(|item| item.size).sum(),
        })
    }

    /// Whether its root says that it was concluded.
    pub(crate) fn concluded(&self) -> Result<bool, StoreError> {
        Ok(self.root()?.pointer("/attributes/complete").and_then(serde_json::Value::as_i64) == Some(1))
    }

    /// Compares all that describes the store with its plan, reads the check sums of all finished tiles, computes `sample` of them again, chosen by `seed`, and compares the
    /// bytes. Changes nothing.
    ///
    /// # Errors
    /// [`StoreError`] when the place cannot be read.
    pub fn verify(&self, sample: u64, seed: u64, control: &Control<'_>) -> Result<Verified, StoreError> {
        let grid = self.study.grid();
        let tiles: Vec<u64> = (0..grid.tiles()).collect();
        let pool = control.pool()?;
        let stopping = || StoreError::Stopped(Meter::new(control, 0, grid.points()).kept());
        let states = pool.install(|| {
            let state = |tile: &u64| if control.stopping() { Err(stopping()) } else { self.state(*tile) };
            tiles.par_iter().map(state).collect::<Result<Vec<State>, StoreError>>()
        })?;
        let mut damage = self.description_damage(states.iter().all(|state| *state == State::Whole))?;
        let torn = |tile: u64| Damage {
            tile: Some(tile),
            what: "a chunk is missing, cut short or has a wrong check sum".into(),
        };
        let with =
            |wanted| (tiles.iter().zip(&states)).filter(move |(_, state)| **state == wanted).map(|(tile, _)| *tile);
        damage.extend(with(State::Damaged).map(torn));
        let whole: Vec<u64> = with(State::Whole).collect();
        let chosen = choose(&whole, sample, seed);
        let points = |tile: u64| grid.tile(tile).points() as u64;
        let meter = Meter::new(control, 0, chosen.iter().map(|tile| points(*tile)).sum());
        let twin = Self::over(Arc::new(Memory::default()), &self.plan, self.begun_by.clone())?;
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

    /// Refuses a store with a tile that is done and damaged: all check sums are read, nothing is changed.
    ///
    /// # Errors
    /// [`StoreError::DamagedTile`] for the first such tile, and where the place cannot be read.
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
        // the first one, whatever the threads did
        tiles.into_iter().collect()
    }

    /// The points that [`Store::verify`] computes again at most, for a count of what it has done.
    #[must_use]
    pub fn sample_points(&self, sample: u64) -> u64 {
        let grid = self.study.grid();
        sample.min(grid.tiles()).saturating_mul(grid.tile(0).points() as u64).min(grid.points())
    }

    /// How a tile here differs from the same tile there.
    fn differs(&self, twin: &Self, tile: u64, concluded: bool) -> Result<Option<String>, StoreError> {
        for (field, array) in self.layout.arrays.iter().enumerate() {
            let key = array.key(&self.layout.place(tile, field));
            if self.get(&key)? == twin.get(&key)? {
                continue;
            }
            // cycles that only this tile has met are numbered when all are there
            let (here, there) = (self.read(tile, field)?, twin.read(tile, field)?);
            let renumbered = match (&here, &there) {
                (Some(Column::I32(here)), Some(Column::I32(there))) => {
                    here.len() == there.len()
                        && here.iter().zip(there).all(|(a, b)| a == b || (concluded && *b < -1 && *a >= 0))
                }
                _ => false,
            };
            // with these numbers the chunk has to be the same bytes too, beyond the edge of the grid as well
            let same = if let (true, Some(here)) = (renumbered, &here) {
                twin.write(tile, field, here)?;
                self.get(&key)? == twin.get(&key)?
            } else {
                false
            };
            if !same {
                return Ok(Some(format!("`{key}` is not what the plan gives")));
            }
        }
        Ok(None)
    }
}

/// Some of the tiles, spread at random by a seed.
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

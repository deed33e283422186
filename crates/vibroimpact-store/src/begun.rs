//! Tiles that are computed point after point, as the sweep of an orbit diagram that carries its state: what is there of
//! them is written from time to time, so that a run that was stopped or killed goes on from its last state.
//!
//! The part of a tile is one object below [`BEGUN`]: the number of its points and the numbers of its last state with a
//! checksum, and a chunk for each field. It is removed when the tile is complete. The bytes of the tile do not depend on it.

use crate::checksum;
use crate::clock::Pause;
use crate::shards::{bundle, unbundle};
use crate::{Store, StoreError};
use std::cell::RefCell;
use vibroimpact_study::Column;
use vibroimpact_study::study::BegunTile;

/// The folder of the parts of tiles.
pub(crate) const BEGUN: &str = ".begun/";

impl Store {
    fn begun_key(tile: u64) -> String {
        format!("{BEGUN}{tile}")
    }

    /// The part of a tile that was computed before, if there is one that is undamaged.
    fn begun(&self, tile: u64) -> Result<Option<BegunTile>, StoreError> {
        let chunks = self.get(&Self::begun_key(tile))?.and_then(|bytes| unbundle(&bytes));
        Ok(chunks.and_then(|chunks| {
            let mut chunks = chunks.into_iter();
            let (done, left) = read_state(&chunks.next()?)?;
            let columns: Option<Vec<Column>> =
                chunks.enumerate().map(|(field, chunk)| self.decoded(tile, field, &chunk)).collect();
            columns.filter(|columns| columns.len() == self.layout.fields.len()).map(|columns| BegunTile {
                done,
                left,
                columns,
            })
        }))
    }

    fn keep(&self, tile: u64, part: &BegunTile) -> Result<(), StoreError> {
        let mut all = vec![write_state(part.done, &part.left)];
        all.extend(self.chunks(tile, &part.columns)?);
        self.put(&Self::begun_key(tile), &bundle(&all))
    }

    /// The columns of a tile, from the part that is there; `None` if stopped.
    pub(crate) fn continued(
        &self,
        tile: u64,
        tick: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Vec<Column>>, StoreError> {
        if !self.study.continues() {
            return Ok(self.study.tile(tile, tick));
        }
        let (pause, failure) = (RefCell::new(Pause::default()), RefCell::new(None));
        let keep = |stops: bool, part: &dyn Fn() -> BegunTile| {
            let mut pause = pause.borrow_mut();
            if (stops || pause.is_over()) && failure.borrow().is_none() {
                pause.during(|| {
                    if let Err(error) = self.keep(tile, &part()) {
                        *failure.borrow_mut() = Some(error);
                    }
                });
            }
        };
        let columns = self.study.continued(tile, self.begun(tile)?, &keep, tick);
        // the tile is written to the same place, so it would fail too
        match failure.into_inner() {
            Some(error) => Err(error),
            None => Ok(columns),
        }
    }

    /// Removes the part of a tile that is complete.
    pub(crate) fn forget_begun(&self, tile: u64) -> Result<(), StoreError> {
        if !self.study.continues() {
            return Ok(());
        }
        let key = Self::begun_key(tile);
        self.shelf.remove(&key).map_err(|error| StoreError::Write { place: self.place(), key, error })
    }

    /// Removes all parts; for a store whose tiles are complete.
    pub(crate) fn sweep_begun(&self) -> Result<(), StoreError> {
        if !self.study.continues() {
            return Ok(());
        }
        let left = self.list(BEGUN)?;
        self.remove(&left)
    }
}

/// The number of points and the numbers of the last state, with a checksum.
fn write_state(done: u64, left: &[f64]) -> Vec<u8> {
    let mut bytes = done.to_le_bytes().to_vec();
    left.iter().for_each(|number| bytes.extend(number.to_le_bytes()));
    checksum::append(&mut bytes);
    bytes
}

/// The reverse; `None` for damaged bytes.
fn read_state(bytes: &[u8]) -> Option<(u64, Vec<f64>)> {
    let words = checksum::content(bytes).filter(|words| words.len() % 8 == 0)?;
    let mut words = words.chunks(8).filter_map(|word| word.try_into().ok());
    let done = u64::from_le_bytes(words.next()?);
    Some((done, words.map(f64::from_le_bytes).collect()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn states_and_their_damage() {
        for left in [vec![], vec![0.5, -0.0, 3.0]] {
            let bytes = write_state(7, &left);
            assert_eq!(read_state(&bytes), Some((7, left)));
            for k in 0..bytes.len() {
                assert_eq!(read_state(&bytes[..k]), None, "{k}");
                let mut bad = bytes.clone();
                bad[k] ^= 2;
                assert_eq!(read_state(&bad), None, "{k}");
            }
        }
    }
}

//! Numbers of points of a store that were not computed themselves, or whose motion is undecided.

use crate::failure::Failure;
use crate::session::Session;
use vibroimpact_store::Store;
use vibroimpact_study::study::UNDECIDED;

/// Number of points of a store up to which its labels are read for its status; each tile of a larger one takes time, above all in a
/// bucket.
const MOST_READ: u64 = 1_000_000;

/// Number of damaged tiles; `None` if the store has so many points that reading them would take long.
pub(crate) fn damaged(store: &Store, session: &Session) -> Result<Option<u64>, Failure> {
    if store.study().grid().points() > MOST_READ {
        return Ok(None);
    }
    Ok(Some(session.watched(None, |control| store.damaged(control))?))
}

/// Number of points of a refined store that were computed themselves; `None` for other stores.
pub(crate) fn computed(store: &Store) -> Result<Option<u64>, Failure> {
    let Some(field) = store.field("computed") else { return Ok(None) };
    let mut count = 0;
    store.count(field, &mut |_, counts| {
        count += counts.iter().filter(|(value, _)| *value == 1).map(|(_, count)| count).sum::<u64>();
    })?;
    Ok(Some(count))
}

/// Number of points with an undecided motion, in all complete tiles; `None` if the store has no labels, or so many points that
/// reading them would take long.
pub(crate) fn undecided(store: &Store) -> Result<Option<u64>, Failure> {
    let Some(label) = store.field("label") else { return Ok(None) };
    if store.study().grid().points() > MOST_READ {
        return Ok(None);
    }
    let width = store.study().fields()[label].width();
    let mut count = 0;
    for tile in 0..store.study().grid().tiles() {
        let codes = store.tile_field(tile, label)?;
        count += codes.whole().chunks(width).filter(|point| point.contains(&UNDECIDED)).count() as u64;
    }
    Ok(Some(count))
}

//! The record of the costs of tiles: the processor time that each has taken. They depend on the machine, so they are not in the store but
//! in objects beside it, one for each process. Nothing depends on them but reports.

use crate::shelf::Shelf;
use serde_json::json;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant, SystemTime};

/// Minimum time between two writes of one process.
const PAUSE: Duration = Duration::from_secs(10);

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

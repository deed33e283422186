//! What all requests share.

use crate::refusal::Refusal;
use crate::workshop::{Bench, Workshop};
use axum::body::Bytes;
use quick_cache::Weighter;
use quick_cache::sync::Cache;
use std::sync::Arc;
use vibroimpact_study::Control;

/// Bytes of finished answers that are kept.
const CACHE: u64 = 96 << 20;
/// What all requests share: finished answers, and the benches at which work is done.
#[derive(Clone)]
pub struct Explorer {
    port: u16,
    pub(crate) workshop: Arc<Workshop>,
    finished: Arc<Cache<String, Bytes, Weight>>,
}

#[derive(Clone)]
struct Weight;

impl Weighter<String, Bytes> for Weight {
    fn weight(&self, key: &String, value: &Bytes) -> u64 {
        (key.len() + value.len()) as u64
    }
}

impl Explorer {
    /// An explorer at this port of the local machine that makes `threads` tiles at a time, as many as there are processors for 0.
    #[must_use]
    pub fn new(port: u16, threads: usize) -> Self {
        // about this number of answers of the size of a tile fit
        let finished = Cache::with_weighter(2000, CACHE, Weight);
        Self { port, workshop: Arc::new(Workshop::with_threads(threads)), finished: Arc::new(finished) }
    }

    /// Its port.
    pub(crate) const fn port(&self) -> u16 {
        self.port
    }

    /// What is known under a name already, or else the work that makes it, as [`Workshop::run`] does it.
    pub(crate) async fn once(
        &self,
        name: String,
        (bench, threads): (Bench, usize),
        progress: impl Fn(u64) + Send + Sync + 'static,
        work: impl FnOnce(&Control<'_>) -> Result<Bytes, Refusal> + Send + 'static,
    ) -> Result<Bytes, Refusal> {
        if let Some(known) = self.finished.get(&name) {
            return Ok(known);
        }
        let body = self.workshop.run(bench, threads, progress, work).await?;
        self.finished.insert(name, body.clone());
        Ok(body)
    }
}

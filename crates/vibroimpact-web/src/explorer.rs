//! The data common to all requests.

use crate::refusal::Refusal;
use crate::workshop::{Bench, Workshop};
use axum::body::Bytes;
use quick_cache::Weighter;
use quick_cache::sync::Cache;
use std::sync::Arc;
use vibroimpact_study::Control;

/// Maximum size of the finished answers in the cache, in bytes.
const CACHE: u64 = 96 << 20;
/// The data common to all requests: the cache of finished answers, and the workshop that limits simultaneous work.
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
    /// An explorer at this port of the local machine that computes `threads` tiles at a time (0: one for each
    /// processor).
    #[must_use]
    pub fn new(port: u16, threads: usize) -> Self {
        // an estimate of the number of answers of the size of a tile that fit
        let finished = Cache::with_weighter(2000, CACHE, Weight);
        Self { port, workshop: Arc::new(Workshop::with_threads(threads)), finished: Arc::new(finished) }
    }

    /// The port of the explorer.
    pub(crate) const fn port(&self) -> u16 {
        self.port
    }

    /// The cached answer with this key, or else the result of the work that computes it, as by [`Workshop::run`].
    pub(crate) async fn once(
        &self,
        name: String,
        (bench, threads): (Bench, usize),
        progress: impl Fn(u64) + Send + Sync + 'static,
        work: impl FnOnce(&Control<'_>) -> Result<Bytes, Refusal> + Send + 'static,
    ) -> Result<Bytes, Refusal> {
        if let Some(known) = self.known(&name) {
            return Ok(known);
        }
        let body = self.workshop.run(bench, threads, progress, work).await?;
        self.keep(name, &body);
        Ok(body)
    }

    /// The cached answer with this key.
    pub(crate) fn known(&self, name: &str) -> Option<Bytes> {
        self.finished.get(name)
    }

    /// Puts an answer into the cache: a copy, because the memory of a body that grew is up to twice its length, which the
    /// limit of the cache does not see.
    pub(crate) fn keep(&self, name: String, body: &Bytes) {
        self.finished.insert(name, Bytes::copy_from_slice(body));
    }

    /// Removes an answer from the cache.
    pub(crate) fn forget(&self, name: &str) {
        self.finished.remove(name);
    }
}

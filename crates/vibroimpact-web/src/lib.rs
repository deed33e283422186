//! The explorer: a local page on which the plane of motions is seen, and each of its points understood.
//!
//! The page asks by plans, as the command and the Python package do, and draws what comes back; every number on it was
//! computed here, by the same code. The server holds no state but finished answers: what the page shows is in its address.
//!
//! | what | where |
//! |---|---|
//! | who may ask: this machine, from this page | `guard.rs` |
//! | what may be asked at once | `bounds.rs` |
//! | work beside the server: how much at a time, for how long, and not for a page that has moved on | `workshop.rs` |
//! | arrays as bytes | `packed.rs` |
//! | how far long work is, as server-sent events | `events.rs` |
//! | what is refused, and how that is said | `refusal.rs` |
//! | the requests, one kind a file | `routes/` |
//! | the address, connections and their end | `listen.rs` |
//!
//! ```
//! use vibroimpact_web::{Explorer, app};
//! let router = app(Explorer::new(8411, 0));
//! # let _ = router;
//! ```

mod bounds;
mod events;
mod guard;
mod listen;
mod packed;
mod refusal;
mod routes;
mod workshop;

pub use listen::{Bound, PORT};

use axum::body::Bytes;
use axum::extract::DefaultBodyLimit;
use axum::{Router, middleware};
use quick_cache::Weighter;
use quick_cache::sync::Cache;
use refusal::Refusal;
use std::sync::Arc;
use vibroimpact_study::Control;
use workshop::{Bench, Workshop};

/// Bytes of finished answers that are kept.
const CACHE: u64 = 96 << 20;
/// Bytes of a request, far more than any plan takes.
const MOST_BODY: usize = 64 << 10;

/// What all requests share: finished answers, and the benches at which work is done.
#[derive(Clone)]
pub struct Explorer {
    port: u16,
    workshop: Arc<Workshop>,
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
        // about so many answers fit, of the size of a tile
        let finished = Cache::with_weighter(2000, CACHE, Weight);
        Self { port, workshop: Arc::new(Workshop::with_threads(threads)), finished: Arc::new(finished) }
    }

    /// What is known under a name already, or else the work that makes it, as [`Workshop::run`] does it.
    async fn once(
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

/// The whole explorer as a service.
pub fn app(explorer: Explorer) -> Router {
    let port = explorer.port;
    routes::all()
        .layer(DefaultBodyLimit::max(MOST_BODY))
        .layer(middleware::from_fn(move |request, next| guard::guard(port, request, next)))
        .with_state(explorer)
}

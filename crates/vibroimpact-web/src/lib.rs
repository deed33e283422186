//! The explorer: a local page that shows the plane of motions and explains each of its points.
//!
//! The page sends plans, like the command and the Python package, and draws the answers. Every number on it is computed
//! by the same code. The server has no state except a cache of answers; the address of the page contains what it shows.
//!
//! | part | file |
//! |---|---|
//! | access control: requests only from the page on this machine | `guard.rs` |
//! | limits for a single request | `bounds.rs` |
//! | simultaneous work, its time limit, and its end when a request is cancelled | `workshop.rs` |
//! | arrays as bytes | `packed.rs` |
//! | the progress of long work as server-sent events | `events.rs` |
//! | refused requests and their messages | `refusal.rs` |
//! | the requests, one file for each kind | `routes/` |
//! | the address and the connections | `listen.rs` |
//!
//! ```
//! use vibroimpact_web::{Explorer, app};
//! let router = app(Explorer::new(8411, 0));
//! # let _ = router;
//! ```

mod bounds;
mod events;
mod explorer;
mod guard;
mod listen;
mod packed;
mod refusal;
mod routes;
mod workshop;

pub use explorer::Explorer;
pub use listen::{BoundServer, PORT};

use axum::extract::DefaultBodyLimit;
use axum::{Router, middleware};

/// Maximum number of bytes of a request, far more than any plan needs.
const MOST_BODY: usize = 64 << 10;

/// The whole explorer as a service.
pub fn app(explorer: Explorer) -> Router {
    let port = explorer.port();
    routes::all()
        .layer(DefaultBodyLimit::max(MOST_BODY))
        .layer(middleware::from_fn(move |request, next| guard::guard(port, request, next)))
        .with_state(explorer)
}

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

/// Bytes of a request, far more than any plan takes.
const MOST_BODY: usize = 64 << 10;

/// The whole explorer as a service.
pub fn app(explorer: Explorer) -> Router {
    let port = explorer.port();
    routes::all()
        .layer(DefaultBodyLimit::max(MOST_BODY))
        .layer(middleware::from_fn(move |request, next| guard::guard(port, request, next)))
        .with_state(explorer)
}

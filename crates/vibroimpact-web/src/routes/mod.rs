//! The requests. Each one is a plan; some have options for the form of the answer.

mod about;
mod answer;
mod asked;
mod bifurcation;
mod layer;
mod motion;
mod page;
mod picture;
mod tile;
mod units;
mod whole;

use crate::Explorer;
use crate::refusal::Refusal;
use axum::Router;
use axum::http::StatusCode;
use axum::routing::{get, post};

/// The routes of all requests.
pub(crate) fn all() -> Router<Explorer> {
    Router::new()
        .route("/", get(page::index))
        .route("/assets/{*path}", get(page::asset))
        .route("/api/about", get(about::about))
        .route("/api/units", get(units::units))
        .route("/api/tile", post(tile::tile))
        .route("/api/whole", post(whole::whole))
        .route("/api/picture", post(picture::picture))
        .route("/api/answer", post(answer::answer))
        .route("/api/motion", post(motion::motion))
        .route("/api/table", post(answer::table))
        .route("/api/command", post(answer::command))
        .route("/api/figure", post(answer::figure))
        .route("/api/bifurcation", post(bifurcation::diagram))
        .route("/api/layer", post(layer::layer))
        .fallback(nothing)
        .method_not_allowed_fallback(wrong_method)
}

async fn nothing() -> Refusal {
    Refusal::new(StatusCode::NOT_FOUND, "there is nothing under this address\nhint: the page is at /")
}

async fn wrong_method() -> Refusal {
    Refusal::new(StatusCode::METHOD_NOT_ALLOWED, "this address takes no request of this kind")
}

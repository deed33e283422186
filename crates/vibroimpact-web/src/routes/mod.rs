//! The requests. Each is a plan, and some say in what form its answer is wanted.

mod about;
mod answer;
mod bifurcation;
mod layer;
mod page;
mod tile;

use crate::Explorer;
use crate::bounds;
use crate::refusal::Refusal;
use axum::Router;
use axum::body::Bytes;
use axum::extract::{FromRequest, FromRequestParts, Request};
use axum::http::request::Parts;
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use axum::routing::{get, post};
use core::time::Duration;
use serde::de::DeserializeOwned;
use vibroimpact_report::answer::work;
use vibroimpact_study::{Plan, PlanError};

/// All of them.
pub(crate) fn all() -> Router<Explorer> {
    Router::new()
        .route("/", get(page::index))
        .route("/assets/{*path}", get(page::asset))
        .route("/api/about", get(about::about))
        .route("/api/tile", post(tile::tile))
        .route("/api/answer", post(answer::answer))
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

/// A plan that makes sense and is not too much.
pub(crate) struct Asked {
    pub(crate) plan: Plan,
    /// Its points, for progress.
    pub(crate) points: u64,
}

/// What a query asks for; one that does not read is refused as a plan that does not.
pub(crate) struct Query<T>(pub(crate) T);

impl<T: DeserializeOwned, S: Send + Sync> FromRequestParts<S> for Query<T> {
    type Rejection = Refusal;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Refusal> {
        let read = axum::extract::Query::<T>::from_request_parts(parts, state).await;
        read.map(|query| Self(query.0)).map_err(|refused| {
            let why = refused.body_text();
            // what the parser was at is in the first words of ours
            let why = why.strip_prefix("Failed to deserialize query string: ").unwrap_or(&why);
            Refusal::bad(format!("the query `{}` does not read: {why}", parts.uri.query().unwrap_or_default()))
        })
    }
}

/// How long a client may take to send a plan.
const SENDING: Duration = Duration::from_secs(10);

impl<S: Send + Sync> FromRequest<S> for Asked {
    type Rejection = Refusal;

    async fn from_request(request: Request, state: &S) -> Result<Self, Refusal> {
        let body = tokio::time::timeout(SENDING, Bytes::from_request(request, state)).await;
        let body = body
            .map_err(|_| Refusal::new(StatusCode::REQUEST_TIMEOUT, "the plan did not arrive within 10 seconds"))?
            .map_err(|why| Refusal::new(why.status(), format!("the plan cannot be read: {}", why.body_text())))?;
        let text = core::str::from_utf8(&body).map_err(|_| Refusal::bad("the plan is no text"))?;
        let plan = Plan::from_json(text).map_err(|error| match error {
            PlanError::Text(why) => Refusal::bad(format!("this is no plan: {why}")),
            other => other.into(),
        })?;
        plan.check()?;
        bounds::check(&plan)?;
        Ok(Self { points: work(&plan).map_or(1, |(points, _)| points), plan })
    }
}

/// Whether the page wants to be told how far it is.
fn wants_events(headers: &HeaderMap) -> bool {
    headers.get(header::ACCEPT).is_some_and(|kind| kind.as_bytes().starts_with(b"text/event-stream"))
}

/// Labels with commas between.
fn listed(labels: &str) -> Vec<String> {
    labels.split(',').map(|label| label.trim().to_owned()).collect()
}

/// Bytes of a kind; nothing is kept by the browser but what the page keeps.
fn bytes(kind: &'static str, body: Bytes) -> Response {
    ([(header::CONTENT_TYPE, kind), (header::CACHE_CONTROL, "no-store")], body).into_response()
}

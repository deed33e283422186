//! The parsing and checking of requests, and answers in bytes.

use crate::bounds;
use crate::refusal::Refusal;
use axum::body::Bytes;
use axum::extract::{FromRequest, FromRequestParts, Request};
use axum::http::request::Parts;
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use core::time::Duration;
use serde::de::DeserializeOwned;
use vibroimpact_study::{Plan, PlanError};

/// A plan that is valid and within the limits.
pub(crate) struct PlanRequest {
    pub(crate) plan: Plan,
    /// The number of its points, for progress reports.
    pub(crate) points: u64,
}

/// The parameters of a query. Invalid ones are refused like an invalid plan.
pub(crate) struct Query<T>(pub(crate) T);

impl<T: DeserializeOwned, S: Send + Sync> FromRequestParts<S> for Query<T> {
    type Rejection = Refusal;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Refusal> {
        let read = axum::extract::Query::<T>::from_request_parts(parts, state).await;
        read.map(|query| Self(query.0)).map_err(|refused| {
            let why = refused.body_text();
            // our own message already begins with what was parsed
            let why = why.strip_prefix("Failed to deserialize query string: ").unwrap_or(&why);
            Refusal::bad(format!("the query `{}` does not read: {why}", parts.uri.query().unwrap_or_default()))
        })
    }
}

/// Time limit for a client to send a plan.
const SENDING: Duration = Duration::from_secs(10);

impl<S: Send + Sync> FromRequest<S> for PlanRequest {
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
        Ok(Self { points: plan.work().map_or(1, |(points, _)| points), plan })
    }
}

/// Labels separated by commas.
pub(super) fn listed(labels: &str) -> Vec<String> {
    labels.split(',').map(|label| label.trim().to_owned()).collect()
}

/// An answer with bytes of a content type. The browser does not cache it; the page keeps what it needs.
pub(super) fn bytes(kind: &'static str, body: Bytes) -> Response {
    ([(header::CONTENT_TYPE, kind), (header::CACHE_CONTROL, "no-store")], body).into_response()
}

//! Refused requests: a status, and a message with an optional hint as JSON.

use axum::Json;
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};
use serde_json::json;
use vibroimpact_study::{PlanError, RunError};

/// The reason why a request has no answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Refusal {
    pub(crate) status: StatusCode,
    pub(crate) sentence: String,
}

impl Refusal {
    pub(crate) fn new(status: StatusCode, sentence: impl Into<String>) -> Self {
        Self { status, sentence: sentence.into() }
    }

    /// An invalid question.
    pub(crate) fn bad(sentence: impl Into<String>) -> Self {
        Self::new(StatusCode::BAD_REQUEST, sentence)
    }

    /// A question about a machine, which the page does not draw.
    pub(crate) fn machine() -> Self {
        Self::bad("the explorer shows oscillators only\nhint: `vibro run` computes plans of machines")
    }

    /// A valid question that exceeds the limits.
    pub(crate) fn too_much(sentence: impl Into<String>) -> Self {
        Self::new(StatusCode::UNPROCESSABLE_ENTITY, sentence)
    }

    /// An internal error of this program.
    pub(crate) fn fault(what: &str) -> Self {
        Self::new(StatusCode::INTERNAL_SERVER_ERROR, format!("a fault of this program: {what}; please report it"))
    }

    /// The JSON object of the answer.
    pub(crate) fn object(&self) -> serde_json::Value {
        json!({ "error": self.sentence })
    }
}

impl IntoResponse for Refusal {
    fn into_response(self) -> Response {
        (self.status, Json(self.object())).into_response()
    }
}

impl From<PlanError> for Refusal {
    fn from(error: PlanError) -> Self {
        Self::bad(error.to_string())
    }
}

impl From<RunError> for Refusal {
    fn from(error: RunError) -> Self {
        match error {
            // the client has closed the connection
            RunError::Stopped(stopped) => Self::new(StatusCode::REQUEST_TIMEOUT, stopped.to_string()),
            other => Self::bad(other.to_string()),
        }
    }
}

//! Lines over a plane: the boundaries of the regions of stability of motions, and the line where the motion without
//! impacts grazes a stop.

use super::asked::{PlanRequest, Query, listed};
use crate::Explorer;
use crate::events::answered;
use crate::packed::Named;
use crate::refusal::Refusal;
use crate::workshop::Bench;
use axum::Json;
use axum::extract::State;
use axum::http::HeaderMap;
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use serde_json::{Value, json};
use vibroimpact_report::figure::overlay::{LayerPlane, REGION_LABELS, Rings};
use vibroimpact_study::Control;

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Kind {
    Regions,
    Amplitude,
}

#[derive(Deserialize)]
pub(super) struct Wanted {
    kind: Kind,
    /// The labels, separated by commas, of the motions whose regions are requested.
    labels: Option<String>,
}

pub(super) async fn layer(
    State(explorer): State<Explorer>,
    Query(wanted): Query<Wanted>,
    headers: HeaderMap,
    asked: PlanRequest,
) -> Result<Response, Refusal> {
    let plane = LayerPlane::of(&asked.plan)?;
    let plane = plane.ok_or_else(|| Refusal::bad("a layer lies over a map of two parameters"))?;
    let labels = match wanted.labels {
        Some(list) => listed(&list),
        None => REGION_LABELS.map(str::to_owned).to_vec(),
    };
    let total = labels.len() as u64;
    let work = |progress| async move {
        let work = move |control: &Control<'_>| match wanted.kind {
            Kind::Regions => edges(&plane, &labels, control),
            Kind::Amplitude => Ok(json!({ "curves": plane.amplitude() })),
        };
        explorer.workshop.run(Bench::Answers, 0, progress, work).await
    };
    answered(&headers, total, work, Ok, |lines| Json(lines).into_response()).await
}

/// The polygons in which each motion is stable.
fn edges(plane: &LayerPlane, labels: &[String], control: &Control<'_>) -> Result<Value, Refusal> {
    let edge = |(label, rings): (String, Rings)| {
        let Named { name, colour } = Named::new(&label);
        json!({ "name": name, "colour": colour, "rings": rings })
    };
    let edges: Vec<Value> = plane.regions(labels, control)?.into_iter().map(edge).collect();
    Ok(json!({ "regions": edges }))
}

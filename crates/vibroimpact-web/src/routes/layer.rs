//! Lines over a plane: the boundaries of the regions of stability of motions, and the line where the motion without
//! impacts grazes a stop.

use super::asked::{PlanRequest, Query, listed, wants_events};
use crate::Explorer;
use crate::events::{Done, stream};
use crate::packed::Named;
use crate::refusal::Refusal;
use crate::workshop::Bench;
use axum::Json;
use axum::extract::State;
use axum::http::HeaderMap;
use axum::response::{IntoResponse, Response};
use core::sync::atomic::Ordering;
use serde::{Deserialize, Serialize};
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

#[derive(Serialize)]
struct Edge {
    #[serde(flatten)]
    motion: Named,
    rings: Rings,
}

pub(super) async fn layer(
    State(explorer): State<Explorer>,
    Query(wanted): Query<Wanted>,
    headers: HeaderMap,
    asked: PlanRequest,
) -> Result<Response, Refusal> {
    let plane = LayerPlane::of(&asked.plan)?;
    let plane = plane.ok_or_else(|| Refusal::bad("a layer lies over a map of two parameters"))?;
    let kind = wanted.kind;
    let labels = match wanted.labels {
        Some(list) => listed(&list),
        None => REGION_LABELS.map(str::to_owned).to_vec(),
    };
    let total = labels.len() as u64;
    let done = Done::default();
    let (told, workshop) = (done.clone(), explorer.workshop);
    let work = async move {
        let tell = move |now| told.store(now, Ordering::Relaxed);
        let work = move |control: &Control<'_>| match kind {
            Kind::Regions => edges(&plane, &labels, control),
            Kind::Amplitude => Ok(json!({ "curves": plane.amplitude() })),
        };
        workshop.run(Bench::Answers, 0, tell, work).await
    };
    if wants_events(&headers) {
        return Ok(stream(total, done, work));
    }
    Ok(Json(work.await?).into_response())
}

/// The polygons in which each motion is stable.
fn edges(plane: &LayerPlane, labels: &[String], control: &Control<'_>) -> Result<Value, Refusal> {
    let edge = |(label, rings): (String, Rings)| Edge { motion: Named::new(&label), rings };
    let edges: Vec<Edge> = plane.regions(labels, control)?.into_iter().map(edge).collect();
    Ok(json!({ "regions": edges }))
}

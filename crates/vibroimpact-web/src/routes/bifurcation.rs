//! The bifurcation diagram along a line: the orbit diagram, with the branches of its motions, as a figure or a table.

use super::answer::{Wanted, csv};
use super::asked::{PlanRequest, Query, bytes, listed};
use crate::Explorer;
use crate::events::answered;
use crate::refusal::Refusal;
use crate::workshop::Bench;
use axum::body::Bytes;
use axum::extract::State;
use axum::http::HeaderMap;
use axum::response::Response;
use serde::Deserialize;
use serde_json::json;
use vibroimpact_report::Units;
use vibroimpact_report::scene::{BifurcationEvent, bifurcation};
use vibroimpact_study::{Control, DiagramPlan, Task};

/// Labels of motions separated by commas. Default: those found on the line.
#[derive(Deserialize)]
pub(super) struct Which {
    labels: Option<String>,
    /// Whether the table is asked for, and not the figure.
    #[serde(default)]
    table: bool,
}

pub(super) async fn diagram(
    State(explorer): State<Explorer>,
    Query(which): Query<Which>,
    Query(wanted): Query<Wanted>,
    headers: HeaderMap,
    asked: PlanRequest,
) -> Result<Response, Refusal> {
    wanted.check()?;
    let Task::Diagram(diagram) = &asked.plan.task else {
        return Err(Refusal::bad("a bifurcation diagram is drawn along the line of a diagram"));
    };
    let diagram: DiagramPlan = diagram.typed()?;
    let points = asked.points;
    // parameters that vary have their first value
    let canonical = asked.plan.canonical()?;
    let system = *canonical.oscillator().ok_or_else(Refusal::machine)?;
    let asked = vibroimpact_report::Asked { system, units: Units::of_plan(&canonical) };
    let work = |progress| async move {
        let work = move |control: &Control<'_>| {
            let named = which.labels.as_deref().map(listed);
            let found = bifurcation(&asked, &diagram, named.as_deref(), control)?;
            let body = if which.table { csv(found.table()?)? } else { wanted.draw(found.figure()?)? };
            Ok((body, found.events()))
        };
        explorer.workshop.run(Bench::Answers, 0, progress, work).await
    };
    let value = |((_, body), events): ((&str, Bytes), Vec<BifurcationEvent>)| {
        let event = |event: BifurcationEvent| json!({ "label": event.label, "kind": event.kind, "value": event.value });
        let events: Vec<_> = events.into_iter().map(event).collect();
        Ok(json!({ "svg": String::from_utf8_lossy(&body), "events": events }))
    };
    answered(&headers, points, work, value, |((kind, body), _)| bytes(kind, body)).await
}

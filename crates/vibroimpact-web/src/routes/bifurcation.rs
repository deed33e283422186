//! The bifurcation diagram along a line: the orbit diagram, with the branches of its motions.

use super::answer::Wanted;
use super::asked::{PlanRequest, Query, bytes, listed, wants_events};
use crate::Explorer;
use crate::events::{Done, stream};
use crate::refusal::Refusal;
use crate::workshop::Bench;
use axum::extract::State;
use axum::http::HeaderMap;
use axum::response::Response;
use core::sync::atomic::Ordering;
use serde::Deserialize;
use serde_json::json;
use vibroimpact_report::Units;
use vibroimpact_report::scene::{BifurcationDiagram, BifurcationEvent, bifurcation, labels};
use vibroimpact_study::Task;

/// Number of values along the line at which motions are searched.
const LOOKS: u32 = 24;
/// Default number of motions whose branches are followed: those of most starts.
const MOST_LABELS: usize = 6;

/// Labels of motions separated by commas. Default: those found on the line.
#[derive(Deserialize)]
pub(super) struct Which {
    labels: Option<String>,
}

pub(super) async fn diagram(
    State(explorer): State<Explorer>,
    Query(which): Query<Which>,
    Query(wanted): Query<Wanted>,
    headers: HeaderMap,
    asked: PlanRequest,
) -> Result<Response, Refusal> {
    wanted.check()?;
    let Task::Diagram(diagram) = asked.plan.task.clone() else {
        return Err(Refusal::bad("a bifurcation diagram is drawn along the line of a diagram"));
    };
    let (done, points) = (Done::default(), asked.points);
    // parameters that vary have their first value
    let system = asked.plan.canonical()?.system;
    let asked = vibroimpact_report::Asked { system, units: Units::default() };
    let told = done.clone();
    let work = async move {
        let tell = move |now| told.store(now, Ordering::Relaxed);
        explorer
            .workshop
            .run(Bench::Answers, 0, tell, move |control| {
                let named = match which.labels {
                    Some(list) => listed(&list),
                    None => labels(&asked, &diagram, LOOKS, control)?.into_iter().take(MOST_LABELS).collect(),
                };
                let BifurcationDiagram { figure, events } = bifurcation(&asked, &diagram, &named, control)?;
                Ok((wanted.draw(figure)?, events))
            })
            .await
    };
    if wants_events(&headers) {
        let value = async {
            let ((_, body), events) = work.await?;
            let event =
                |event: BifurcationEvent| json!({ "label": event.label, "kind": event.kind, "value": event.value });
            let events: Vec<_> = events.into_iter().map(event).collect();
            Ok(json!({ "svg": String::from_utf8_lossy(&body), "events": events }))
        };
        return Ok(stream(points, done, value));
    }
    let ((kind, body), _) = work.await?;
    Ok(bytes(kind, body))
}

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
use vibroimpact::continuation::{Polygon, Region};
use vibroimpact_study::{Axis, Control, Coordinate, MapPlan, Parameter, Stretch, SystemPlan, Task, stability_regions};

/// Motions whose regions are drawn by default: those of the 1971 paper, and those that begin at their flips.
const LABELS: [&str; 9] = ["1/1", "2/1", "3/1", "4/1", "1/2", "1/3", "2/2", "3/2", "2/4"];
/// Number of grid points, in each direction, at which orbits are searched.
const GRID: u32 = 20;
/// Number of points of a line.
const POINTS: u32 = 600;

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

/// The outlines of a region.
pub(super) type Rings = Vec<Vec<(f64, f64)>>;

/// The two axes of a map.
pub(super) struct Plane {
    system: SystemPlan,
    across: Stretch,
    up: Stretch,
}

impl Plane {
    pub(super) fn new(system: SystemPlan, map: &MapPlan) -> Result<Self, Refusal> {
        let stretch = |axis: &Axis| match (axis.vary, axis.over.extent()) {
            (Coordinate::Parameter(parameter), (from, to)) => Some(Stretch { parameter, from, to }),
            _ => None,
        };
        match map.axes.iter().map(stretch).collect::<Option<Vec<_>>>().as_deref() {
            Some([across, up]) => Ok(Self { system, across: *across, up: *up }),
            _ => Err(Refusal::bad("a layer lies over a map of two parameters")),
        }
    }
}

pub(super) async fn layer(
    State(explorer): State<Explorer>,
    Query(wanted): Query<Wanted>,
    headers: HeaderMap,
    asked: PlanRequest,
) -> Result<Response, Refusal> {
    let Task::Map(map) = &asked.plan.task else { return Err(Refusal::bad("a layer lies over a map")) };
    let plane = Plane::new(asked.plan.system, map)?;
    let kind = wanted.kind;
    let labels = match wanted.labels {
        Some(list) => listed(&list),
        None => LABELS.map(str::to_owned).to_vec(),
    };
    let total = labels.len() as u64;
    let done = Done::default();
    let (told, workshop) = (done.clone(), explorer.workshop);
    let work = async move {
        let tell = move |now| told.store(now, Ordering::Relaxed);
        let work = move |control: &Control<'_>| match kind {
            Kind::Regions => edges(&plane, &labels, control),
            Kind::Amplitude => Ok(json!({ "curves": amplitude(&plane) })),
        };
        workshop.run(Bench::Answers, 0, tell, work).await
    };
    if wants_events(&headers) {
        return Ok(stream(total, done, work));
    }
    Ok(Json(work.await?).into_response())
}

/// The label and the outlines of each region of stability of some motions.
fn outlines(plane: &Plane, labels: &[String], control: &Control<'_>) -> Result<Vec<(String, Rings)>, Refusal> {
    let found = stability_regions(&plane.system, labels, (&plane.across, &plane.up), GRID, control)?;
    let ring = |polygon: &Polygon| polygon.vertices.iter().map(|vertex| vertex.values).collect();
    let rings = |region: Region| region.polygons.iter().map(ring).collect::<Vec<_>>();
    let named = labels.iter().cloned().zip(found.into_iter().map(rings));
    Ok(named.filter(|(_, rings)| !rings.is_empty()).collect())
}

/// The outlines of the regions that the page draws by default.
pub(super) fn regions(plane: &Plane, control: &Control<'_>) -> Result<Vec<(String, Rings)>, Refusal> {
    outlines(plane, &LABELS.map(str::to_owned), control)
}

/// The polygons in which each motion is stable.
fn edges(plane: &Plane, labels: &[String], control: &Control<'_>) -> Result<Value, Refusal> {
    let edge = |(label, rings): (String, Rings)| Edge { motion: Named::new(&label), rings };
    let edges: Vec<Edge> = outlines(plane, labels, control)?.into_iter().map(edge).collect();
    Ok(json!({ "regions": edges }))
}

/// The lines where the gap equals the amplitude of the motion without impacts, in a plane with a gap axis.
pub(super) fn amplitude(plane: &Plane) -> Vec<Vec<(f64, f64)>> {
    let (gap, other, upwards) = match (plane.across.parameter, plane.up.parameter) {
        (_, Parameter::Gap) => (&plane.up, &plane.across, true),
        (Parameter::Gap, _) => (&plane.across, &plane.up, false),
        _ => return Vec::new(),
    };
    let (low, high) = (gap.from.min(gap.to), gap.from.max(gap.to));
    let mut lines = vec![Vec::new()];
    for k in 0..=POINTS {
        let at = other.from + (other.to - other.from) * f64::from(k) / f64::from(POINTS);
        let osc = plane.system.with(other.parameter, at).and_then(|system| system.oscillator());
        let amplitude = osc.map_or(f64::INFINITY, |osc| osc.free_amplitude());
        // slightly beyond the frame, so that the line reaches it
        if amplitude >= low - (high - low) && amplitude <= high + (high - low) {
            let point = if upwards { (at, amplitude) } else { (amplitude, at) };
            lines.last_mut().into_iter().for_each(|line| line.push(point));
        } else if lines.last().is_some_and(|line| !line.is_empty()) {
            lines.push(Vec::new());
        }
    }
    lines.retain(|line| line.len() > 1);
    lines
}

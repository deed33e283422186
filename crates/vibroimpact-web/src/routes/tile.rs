//! A piece of a plane: of a map, or of a basin.

use super::asked::{PlanRequest, bytes};
use crate::refusal::Refusal;
use crate::workshop::Bench;
use crate::{Explorer, packed};
use axum::body::Bytes;
use axum::extract::State;
use axum::response::Response;
use vibroimpact_study::study::in_memory;
use vibroimpact_study::{Control, Study, Task};

/// Points from which a piece is worth more than one thread: several tiles of this size are made side by side anyway. With a budget
/// beyond the smaller ones any piece is, as it may take a minute of work.
const LARGE: u64 = 17_000;
/// Budgets of impacts up to this one are small.
const BRIEF: u32 = 1000;
/// Points of a tile that one thread makes, where several do.
const SIDE: u32 = 32;

pub(super) async fn tile(State(explorer): State<Explorer>, asked: PlanRequest) -> Result<Response, Refusal> {
    let PlanRequest { mut plan, points } = asked;
    let (refine, impacts) = match &plan.task {
        Task::Map(map) => (map.refine, map.impacts),
        Task::Basin(basin) => (basin.refine, basin.impacts),
        _ => return Err(Refusal::bad("a tile is a piece of a map or of a basin")),
    };
    let name = format!("tile {}", plan.hash());
    // points of one thread are refined together; those without refinement may be divided as one likes
    let brief = impacts.is_some_and(|impacts| impacts <= BRIEF);
    let alone = refine.is_some() && brief && points <= LARGE;
    plan.tile = plan.tile.or(Some(if alone { 4096 } else { SIDE }));
    let threads = usize::from(alone);
    let work = move |control: &Control<'_>| {
        let sheet = in_memory(Study::new(&plan)?, control)?;
        Ok(Bytes::from(packed::pack(&sheet)))
    };
    Ok(bytes(KIND, explorer.once(name, (Bench::Tiles, threads), |_| {}, work).await?))
}

const KIND: &str = "application/octet-stream";

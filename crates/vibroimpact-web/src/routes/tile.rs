//! A tile of a map or a basin.

use super::asked::{PlanRequest, bytes};
use crate::refusal::Refusal;
use crate::workshop::Bench;
use crate::{Explorer, packed};
use axum::body::Bytes;
use axum::extract::State;
use axum::response::Response;
use vibroimpact_study::study::in_memory;
use vibroimpact_study::{Control, Plan, Study, Task};

/// Number of points above which a tile is computed by more than one thread. Smaller tiles use one thread, because the
/// page requests several at a time. A tile whose budget is not small is always computed by several threads, because it
/// may take a minute.
const LARGE: u64 = 17_000;
/// Budgets of impacts up to this one are small.
const BRIEF: u32 = 1000;
/// Side of the part of a tile that one thread computes, if there are several threads.
const SIDE: u32 = 64;

pub(super) async fn tile(State(explorer): State<Explorer>, asked: PlanRequest) -> Result<Response, Refusal> {
    let PlanRequest { mut plan, points } = asked;
    let impacts = match &plan.task {
        Task::Map(map) => map.impacts,
        Task::Basin(basin) => basin.impacts,
        _ => return Err(Refusal::bad("a tile is a piece of a map or of a basin")),
    };
    let name = named(&plan);
    // the points of one thread are refined together; a tile without refinement may be divided in any way
    let alone = impacts.is_some_and(|impacts| impacts <= BRIEF) && points <= LARGE;
    plan.tile = plan.tile.or(Some(if alone { 4096 } else { SIDE }));
    let threads = usize::from(alone);
    let work = move |control: &Control<'_>| {
        let sheet = in_memory(Study::new(&plan)?, control)?;
        Ok(Bytes::from(packed::pack(&sheet)))
    };
    Ok(bytes(KIND, explorer.once(name, (Bench::Tiles, threads), |_| {}, work).await?))
}

/// The key of a finished tile in the cache.
pub(super) fn named(plan: &Plan) -> String {
    format!("tile {}", plan.hash())
}

pub(super) const KIND: &str = "application/octet-stream";

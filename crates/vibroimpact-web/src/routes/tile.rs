//! A piece of a plane: of a map, or of a basin.

use super::{Asked, bytes};
use crate::refusal::Refusal;
use crate::workshop::Bench;
use crate::{Explorer, packed};
use axum::body::Bytes;
use axum::extract::State;
use axum::response::Response;
use vibroimpact_study::study::in_memory;
use vibroimpact_study::{Control, MapPlan, Plan, Study, Task};

/// Points from which a piece is worth more than one thread: several tiles of this size are made side by side anyway. With a budget
/// beyond the smaller ones any piece is, as it may take a minute of work.
const LARGE: u64 = 17_000;
/// Points of a tile that one thread makes, where several do.
const SIDE: u32 = 32;

pub(super) async fn tile(State(explorer): State<Explorer>, asked: Asked) -> Result<Response, Refusal> {
    let Asked { mut plan, points } = asked;
    let (refine, impacts) = match &plan.task {
        Task::Map(map) => (map.refine, map.impacts),
        Task::Basin(basin) => (basin.refine, basin.impacts),
        _ => return Err(Refusal::bad("a tile is a piece of a map or of a basin")),
    };
    let name = name(&plan);
    let known = shallower(&explorer, &plan);
    // points of one thread are refined together; those without refinement may be divided as one likes
    let brief = impacts.is_some_and(|impacts| impacts <= SHALLOWER[0]);
    let alone = refine.is_some() && brief && points <= LARGE;
    plan.tile = plan.tile.or(Some(if alone { 4096 } else { SIDE }));
    let threads = usize::from(alone);
    let work = move |control: &Control<'_>| {
        let study = match known.as_deref().and_then(packed::unpack) {
            Some(earlier) => Study::deeper(&plan, earlier)?,
            None => Study::new(&plan)?,
        };
        let sheet = in_memory(study, control)?;
        Ok(Bytes::from(packed::pack(&sheet)))
    };
    Ok(bytes(KIND, explorer.once(name, (Bench::Tiles, threads), |_| {}, work).await?))
}

const KIND: &str = "application/octet-stream";

/// Budgets of impacts that the page offers below the largest, the deepest first.
const SHALLOWER: [u32; 2] = [1000, 200];

/// The name of a finished tile.
fn name(plan: &Plan) -> String {
    format!("tile {}", plan.hash())
}

/// The same piece of a map, finished with a smaller budget: what that settled need not be computed again.
fn shallower(explorer: &Explorer, plan: &Plan) -> Option<Bytes> {
    let Task::Map(map) = &plan.task else { return None };
    let smaller = SHALLOWER.into_iter().filter(|impacts| map.impacts.is_none_or(|budget| *impacts < budget));
    let with = |impacts| Task::Map(MapPlan { impacts: Some(impacts), ..map.clone() });
    smaller
        .map(|impacts| name(&Plan { task: with(impacts), ..plan.clone() }))
        .find_map(|name| explorer.finished.get(&name))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app;
    use axum::body::{Body, to_bytes};
    use axum::http::{Request, header};
    use tower::ServiceExt;
    use vibroimpact::verdict::SettleOptions;
    use vibroimpact_study::Column;
    use vibroimpact_study::study::{Earlier, NO_IMPACT, Sheet, UNDECIDED};

    /// Pieces with chaos, slow transients and coexisting motions: refined or not, of one thread or more, with starts beyond those kept.
    const PIECES: [&str; 6] = [
        r#"[{"vary":"inverse_beta","over":"1.0:1.2:60"},{"vary":"gap","over":"1.5:3.5:50"}],"starts":1,"refine":8"#,
        r#"[{"vary":"inverse_beta","over":"0.9:1.6:41"},{"vary":"gap","over":"0.5:2.5:33"}],"starts":3,"refine":8"#,
        r#"[{"vary":"inverse_beta","over":"1.05:1.15:17"},{"vary":"gap","over":"2.1:2.5:14"}],"starts":12,"refine":4"#,
        r#"[{"vary":"inverse_beta","over":"0.375:2.025:45"},{"vary":"gap","over":"0:5:39"}],"starts":1"#,
        r#"[{"vary":"inverse_beta","over":"1.1:1.5:37"},{"vary":"gap","over":"1.5:5:35"}],"starts":2"#,
        r#"[{"vary":"restitution","over":"0.5:1:24"},{"vary":"second_gap","over":"0.2:3:22"}],"starts":2,"refine":8"#,
    ];

    fn plan(piece: &str, impacts: u32) -> Plan {
        let second = if piece.contains("second_gap") { r#","second_stop":{"gap":0.2,"restitution":0.5}"# } else { "" };
        let system = format!(r#"{{"inverse_beta":1.11,"gap":1.5,"restitution":0.5{second}}}"#);
        let map = format!(r#"{{"axes":{piece},"seed":1,"impacts":{impacts}}}"#);
        Plan::from_text(&format!(r#"{{"version":1,"system":{system},"task":{{"map":{map}}}}}"#)).unwrap()
    }

    async fn ask(explorer: &Explorer, plan: &Plan) -> Bytes {
        let request = Request::post("/api/tile")
            .header(header::HOST, "127.0.0.1:8411")
            .header(header::CONTENT_TYPE, "application/json")
            .body(Body::from(serde_json::to_vec(plan).unwrap()));
        let response = app(explorer.clone()).oneshot(request.unwrap()).await.unwrap();
        assert_eq!(response.status(), 200);
        to_bytes(response.into_body(), usize::MAX).await.unwrap()
    }

    fn open(tile: &[u8]) -> usize {
        packed::unpack(tile).unwrap().label.iter().filter(|label| **label == UNDECIDED).count()
    }

    #[tokio::test]
    async fn what_a_smaller_budget_settled_is_taken_over_and_the_bytes_are_those_of_a_tile_computed_anew() {
        for piece in PIECES {
            let explorer = Explorer::new(8411, 2);
            let first = open(&ask(&explorer, &plan(piece, 200)).await);
            let deeper = ask(&explorer, &plan(piece, 1000)).await;
            assert!(deeper == ask(&Explorer::new(8411, 2), &plan(piece, 1000)).await, "{piece}");
            assert!(open(&deeper) < first, "{piece}: {first} open, then {}", open(&deeper));
        }
        let (piece, explorer) = (PIECES[2], Explorer::new(8411, 2));
        ask(&explorer, &plan(piece, 1000)).await;
        let deepest = ask(&explorer, &plan(piece, 20_000)).await;
        assert!(deepest == ask(&Explorer::new(8411, 2), &plan(piece, 20_000)).await);
    }

    /// A lie in the smaller tile is believed where it says that a point is settled, and nowhere else.
    #[tokio::test]
    async fn only_open_points_are_computed() {
        for piece in [PIECES[0], PIECES[3]] {
            let (small, large) = (plan(piece, 200), plan(piece, 1000));
            let sheet = in_memory(Study::new(&small).unwrap(), &Control::default()).unwrap();
            let before = packed::unpack(&packed::pack(&sheet)).unwrap();
            let lie = |label: i32| if label == 10_001 { NO_IMPACT } else { label };
            let columns = sheet.columns.iter().map(|column| match column {
                Column::I32(labels) => Column::I32(labels.iter().copied().map(lie).collect()),
                other => other.clone(),
            });
            let explorer = Explorer::new(8411, 2);
            let false_one = Sheet { columns: columns.collect(), ..sheet };
            explorer.finished.insert(name(&small), Bytes::from(packed::pack(&false_one)));
            let found = packed::unpack(&ask(&explorer, &large).await).unwrap();
            let right = packed::unpack(&ask(&Explorer::new(8411, 2), &large).await).unwrap();
            let mut believed = 0;
            for k in 0..before.label.len() {
                let own = |earlier: &Earlier| earlier.computed.as_ref().is_none_or(|how| how[k] == 1);
                if own(&before) && own(&found) && before.label[k] == 10_001 {
                    assert_eq!(found.label[k], NO_IMPACT);
                    believed += 1;
                } else if own(&found) && own(&right) {
                    assert_eq!(found.label[k], right.label[k], "{piece} at {k}");
                }
            }
            assert!(believed > 20, "{believed}");
        }
    }

    /// 20 000 impacts, the largest budget of the page, is what a plan that names none has.
    #[test]
    fn the_largest_budget_is_the_whole() {
        assert_eq!(SettleOptions::at_most(20_000), SettleOptions::default());
    }
}

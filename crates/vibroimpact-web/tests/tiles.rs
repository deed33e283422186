//! Tiles and coarse pictures of any window agree with the motion that is found at each of their points alone.
#![allow(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use axum::body::{Body, to_bytes};
use axum::http::{Request, StatusCode, header};
use serde_json::Value;
use tower::ServiceExt;
use vibroimpact::verdict::{SettleOptions, settle};
use vibroimpact_study::{Axis, BasinPlan, MapPlan, Plan, Task};
use vibroimpact_web::{Explorer, app};

const PORT: u16 = 8411;
/// Points of a tile along each axis.
const SIDE: u32 = 40;

/// The fields of an answer: its labels by name, and which points were computed themselves.
struct Tile {
    rows: usize,
    columns: usize,
    labels: Vec<String>,
    own: Vec<bool>,
}

/// The status and the bytes of an answer.
async fn send(explorer: &Explorer, path: &str, plan: &str) -> (StatusCode, Vec<u8>) {
    let request = Request::post(path)
        .header(header::HOST, format!("127.0.0.1:{PORT}"))
        .header(header::CONTENT_TYPE, "application/json")
        .body(Body::from(plan.to_owned()));
    let response = app(explorer.clone()).oneshot(request.unwrap()).await.unwrap();
    (response.status(), to_bytes(response.into_body(), usize::MAX).await.unwrap().to_vec())
}

async fn answer(explorer: &Explorer, path: &str, plan: &str) -> Vec<u8> {
    let (status, bytes) = send(explorer, path, plan).await;
    assert_eq!(status, 200, "{}", String::from_utf8_lossy(&bytes));
    bytes
}

async fn ask(path: &str, plan: &str) -> Tile {
    read(&answer(&Explorer::new(PORT, 2), path, plan).await)
}

fn read(bytes: &[u8]) -> Tile {
    let length = u32::from_le_bytes(bytes[..4].try_into().unwrap()) as usize;
    let header: Value = serde_json::from_slice(&bytes[4..4 + length]).unwrap();
    let body = &bytes[4 + length..];
    let number = |value: &Value| usize::try_from(value.as_u64().unwrap()).unwrap();
    let (rows, columns) = (number(&header["shape"][0]), number(&header["shape"][1]));
    let field = |name: &str, size: usize| {
        let all = header["fields"].as_array().unwrap();
        let field = all.iter().find(|field| field["name"] == name)?;
        let begin = number(&field["offset"]);
        Some(body[begin..begin + size * number(&field["length"])].chunks(size).collect::<Vec<_>>())
    };
    let name = |four: &&[u8]| {
        let code = i32::from_le_bytes((*four).try_into().unwrap());
        // places after the last motion have none
        header["labels"][code.to_string()]["name"].as_str().unwrap_or_default().to_owned()
    };
    let labels = field("label", 4).unwrap().iter().map(name).collect();
    let own =
        field("computed", 1).map_or(vec![true; rows * columns], |all| all.iter().map(|one| one[0] == 1).collect());
    Tile { rows, columns, labels, own }
}

/// The label of the motion at a point of a plan of a map or basin, found alone, with the budget of the plan.
fn alone(plan: &Plan, column: usize, row: usize) -> String {
    let index = |k: usize| [column, row][k];
    let system = plan.oscillator().unwrap();
    let (osc, start, impacts) = match &plan.task {
        Task::Map(map) => {
            let map: MapPlan = map.typed().unwrap();
            let osc = map.oscillator(system, index).unwrap();
            (osc, vibroimpact::Start { x: 0.0_f64.min(osc.gap()), v: 0.0, phase: 0.0 }, map.impacts)
        }
        Task::Basin(basin) => {
            let basin: BasinPlan = basin.typed().unwrap();
            let at = |axis: &Axis, k: usize| axis.over.at(index(k));
            let (x, v) = (at(&basin.axes[0], 0), at(&basin.axes[1], 1));
            (system.oscillator().unwrap(), vibroimpact::Start { x, v, phase: 0.0 }, basin.impacts)
        }
        _ => unreachable!(),
    };
    let options = impacts.map_or_else(SettleOptions::default, SettleOptions::at_most);
    settle(&osc, start, &options).verdict.label().into_owned()
}

/// Windows over five levels of zoom, at places that a linear congruential generator draws.
fn windows(whole: [f64; 4]) -> impl Iterator<Item = [f64; 4]> {
    let mut seed = 7_u64;
    let mut roll = move || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        #[allow(clippy::cast_precision_loss)]
        let number = (seed >> 11) as f64 / (1_u64 << 53) as f64;
        number
    };
    (0..5).map(move |level| {
        let part = 0.5_f64.powi(2 * level);
        let mut side = |from: f64, to: f64| {
            let wide = (to - from) * part;
            let begin = from + roll() * (to - from - wide);
            (begin, begin + wide)
        };
        let ((left, right), (bottom, top)) = (side(whole[0], whole[1]), side(whole[2], whole[3]));
        [left, right, bottom, top]
    })
}

fn plan_of(
    task: &str,
    names: [&str; 2],
    [left, right, bottom, top]: [f64; 4],
    (counts, more): ([usize; 2], &str),
) -> String {
    let axis =
        |name: &str, from: f64, to: f64, count: usize| format!(r#"{{"vary":"{name}","over":"{from}:{to}:{count}"}}"#);
    let axes = [axis(names[0], left, right, counts[0]), axis(names[1], bottom, top, counts[1])].join(",");
    format!(
        r#"{{"version":1,"system":{{"inverse_beta":1.3,"gap":0.75,"restitution":0.5}},"task":{{"{task}":{{"axes":[{axes}],"impacts":200{more}}}}}}}"#
    )
}

#[tokio::test]
async fn every_point_of_a_tile_is_that_of_the_command() {
    let side = SIDE as usize;
    let (mut seen, mut filled, mut other) = (0, 0, 0);
    for (task, names, whole, more) in [
        ("map", ["inverse_beta", "gap"], [0.375, 2.025, 0.005, 5.0], r#","starts":1,"seed":1,"refine":8"#),
        ("basin", ["x", "v"], [-8.0, 0.75, -8.0, 8.0], ""),
    ] {
        for window in windows(whole) {
            let text = plan_of(task, names, window, ([side, side], more));
            let tile = ask("/api/tile", &text).await;
            let plan = Plan::from_text(&text).unwrap();
            for (k, (label, own)) in tile.labels.iter().zip(&tile.own).enumerate() {
                let found = alone(&plan, k % side, k / side);
                seen += 1;
                filled += usize::from(!own);
                other += usize::from(!own && *label != found);
                assert!(!own || *label == found, "{label} is {found} at {k} of {text}");
            }
        }
    }
    // places that are filled, because the corners of an eight-point box agree, miss what touches no corner: here 60 of 6232
    println!("{seen} points, {filled} of them filled, {other} of these differ");
    assert!(seen == 10 * side * side && filled > seen / 8 && other * 50 < filled, "{seen} {filled} {other}");
}

/// After all its steps a tile of the page has no point with the motion of its neighbours: every point is that of the command
/// without refinement, and so are the bytes.
#[tokio::test]
async fn every_point_of_a_whole_tile_is_that_of_the_command_without_refinement() {
    let side = SIDE as usize;
    let names = ["inverse_beta", "gap"];
    for (more, budgets, within) in [
        (r#","starts":1,"seed":1"#, [200, 2000], 10_000),
        (r#","starts":1,"seed":1"#, [200, 1000], 20),
        (r#","starts":16,"seed":1,"fields":["power"]"#, [60, 200], 0),
    ] {
        let (mut parts, mut filled) = (0, 0);
        // two windows of different sizes, or with `VIBROIMPACT_LONG=1` all
        let long = std::env::var("VIBROIMPACT_LONG").is_ok_and(|value| value == "1");
        for window in windows([0.375, 2.025, 0.005, 5.0]).step_by(if long { 1 } else { 3 }) {
            let explorer = Explorer::new(PORT, 2);
            let text = |impacts: u32, refine: &str| {
                plan_of("map", names, window, ([side, side], &format!("{more}{refine}")))
                    .replace(r#""impacts":200"#, &format!(r#""impacts":{impacts}"#))
            };
            for impacts in budgets {
                answer(&explorer, "/api/tile", &text(impacts, r#","refine":8"#)).await;
            }
            let [first, last] = budgets;
            let whole = text(last, "");
            let path = format!("/api/whole?within={within}&after={last}:8,{first}:8");
            let bytes = loop {
                let bytes = answer(&explorer, &path, &whole).await;
                let own = read(&bytes).own;
                parts += 1;
                filled += own.iter().filter(|own| !**own).count();
                if own.iter().all(|own| *own) {
                    break bytes;
                }
            };
            // a request for what is finished has the same answer
            assert!(bytes == answer(&explorer, &path, &whole).await);
            assert!(bytes == answer(&Explorer::new(PORT, 2), "/api/tile", &whole).await, "{whole}");
            if more.contains("fields") {
                continue;
            }
            let plan = Plan::from_text(&whole).unwrap();
            for (k, label) in read(&bytes).labels.iter().enumerate() {
                assert_eq!(*label, alone(&plan, k % side, k / side), "{k} of {whole}");
            }
        }
        // without time each request computes one group
        println!("{parts} requests for 5 tiles, {filled} points not computed in their answers");
        assert!(within > 0 || (parts > 5 && filled > 0), "{parts} {filled}");
    }
}

/// What was computed before is taken from the cache and not computed again.
#[tokio::test]
async fn a_whole_tile_without_what_was_before_is_the_same() {
    let text = plan_of("map", ["inverse_beta", "gap"], [1.0, 1.5, 0.5, 2.5], ([40, 40], r#","starts":1,"seed":1"#));
    let explorer = Explorer::new(PORT, 2);
    let path = "/api/whole?within=100000";
    let alone = answer(&explorer, path, &text).await;
    let after = answer(&Explorer::new(PORT, 2), "/api/whole?within=100000&after=200:8,1000", &text).await;
    assert!(alone == after && alone == answer(&Explorer::new(PORT, 2), "/api/tile", &text).await);
    for (path, text, sentence) in [
        ("/api/whole?within=1&after=200:x", text.clone(), "is no BUDGET"),
        ("/api/whole?within=1", text.replace(r#""seed":1"#, r#""seed":1,"refine":8"#), "has no refine"),
        ("/api/whole?within=1", plan_of("basin", ["x", "v"], [-1.0, 0.5, -1.0, 1.0], ([4, 4], "")), "piece of a map"),
    ] {
        let (status, said) = send(&Explorer::new(PORT, 2), path, &text).await;
        let said = String::from_utf8_lossy(&said);
        assert!(status == 400 && said.contains(sentence), "{said}");
    }
}

/// The cells of a coarse picture divide its rectangle, and each has the motion of its centre.
#[tokio::test]
async fn every_cell_of_a_coarse_picture_is_that_of_its_centre() {
    let most = 60;
    for (task, names, whole, more) in [
        ("map", ["inverse_beta", "gap"], [0.375, 2.025, 0.05, 5.0], r#","starts":1,"seed":1"#),
        ("basin", ["x", "v"], [-8.0, 0.75, -8.0, 8.0], ""),
    ] {
        for (window, within) in windows(whole).zip([0, 5, 20, 100, 20_000]) {
            let text = plan_of(task, names, window, ([most, most], more));
            let picture = ask(&format!("/api/picture?within={within}"), &text).await;
            let (rows, columns) = (picture.rows, picture.columns);
            assert!(rows <= most && columns <= most && (within < 20_000 || rows == most), "{rows} {columns}");
            #[allow(clippy::cast_precision_loss)]
            let centres = |from: f64, to: f64, count: usize| {
                let cell = (to - from) / (most - 1) as f64;
                let larger = (to - from + cell) / count as f64;
                // rounded as in the answer, because the labels of some motions depend on the last digits
                let air = if count == most { 0.0 } else { (larger - cell) / 2.0 };
                (from + air, to - air)
            };
            let ((left, right), (bottom, top)) =
                (centres(window[0], window[1], columns), centres(window[2], window[3], rows));
            let same = plan_of(task, names, [left, right, bottom, top], ([columns, rows], more));
            let plan = Plan::from_text(&same).unwrap();
            for (k, label) in picture.labels.iter().enumerate() {
                assert_eq!(*label, alone(&plan, k % columns, k / columns), "cell {k} of {same}");
            }
        }
    }
}

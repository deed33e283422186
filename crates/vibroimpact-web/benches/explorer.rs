//! The waiting times of a user of the page: the first picture, the whole plane at 1000 x 700 in full resolution, and
//! the answer to a click.
//!
//! Run it with `cargo bench -p vibroimpact-web`. Each time is measured with a new server, and with as many simultaneous
//! requests for tiles as the page makes. Transfer over the network is not included.

#![allow(missing_docs, clippy::unwrap_used)]

use axum::body::Body;
use axum::http::{Request, header};
use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use tokio::runtime::Runtime;
use tower::ServiceExt;
use vibroimpact_web::{Explorer, app};

const PORT: u16 = 8411;
/// The first view of the page.
const VIEW: [(f64, f64); 2] = [(0.375, 2.025), (0.0, 5.0)];
/// Number of points of a tile along each side, and distance between the points of the coarse picture.
const SIDE: u32 = 128;
const COARSE: u32 = 8;
/// Number of simultaneous requests for tiles.
const ABREAST: usize = 3;

async fn ask(router: axum::Router, path: &str, plan: String) -> usize {
    let request = Request::post(path)
        .header(header::HOST, format!("127.0.0.1:{PORT}"))
        .header(header::CONTENT_TYPE, "application/json")
        .body(Body::from(plan));
    let answer = router.oneshot(request.unwrap()).await.unwrap();
    assert!(answer.status().is_success(), "{}", answer.status());
    axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap().len()
}

/// A map over a part of the plane: `count` points from `from` with the distance `step`.
fn map(from: (f64, f64), step: (f64, f64), count: (u32, u32), refine: &str) -> String {
    let over = |from: f64, step: f64, n: u32| format!("{from}:{}:{n}", from + step * f64::from(n - 1));
    let (x, y) = (over(from.0, step.0, count.0), over(from.1, step.1, count.1));
    format!(
        r#"{{"version":1,"system":{{"inverse_beta":1,"gap":1,"restitution":0.5}},"task":{{"map":{{"axes":[{{"vary":"inverse_beta","over":"{x}"}},{{"vary":"gap","over":"{y}"}}],"starts":1,"seed":1,"impacts":200{refine}}}}}}}"#
    )
}

/// The distance between two pixels.
fn pixel() -> (f64, f64) {
    ((VIEW[0].1 - VIEW[0].0) / 1000.0, (VIEW[1].1 - VIEW[1].0) / 700.0)
}

/// The distance between two points of a tile, as the page computes it: at most that of pixels; a multiple of an eighth
/// power of two in the abscissa, and of the same kind in the ratio of ordinate to abscissa.
fn fine() -> (f64, f64) {
    let eighth = |x: f64| (8.0 * x.log2()).floor() / 8.0;
    let (dx, dy) = pixel();
    let across = eighth(dx);
    (across.exp2(), (across + eighth(dy / dx)).exp2())
}

async fn first_picture() {
    let (dx, dy) = pixel();
    let step = (dx * f64::from(COARSE), dy * f64::from(COARSE));
    black_box(ask(app(Explorer::new(PORT, 0)), "/api/tile", map((VIEW[0].0, VIEW[1].0), step, (125, 88), "")).await);
}

async fn sharp() {
    let (dx, dy) = fine();
    let router = app(Explorer::new(PORT, 0));
    // whole tiles of a grid through zero that cover the view
    let seen = |(from, to): (f64, f64), step: f64| {
        let wide = step * f64::from(SIDE);
        let tiles = (from / wide).floor()..(to / wide).ceil();
        core::iter::successors(Some(tiles.start), |k| Some(k + 1.0))
            .take_while(move |k| *k < tiles.end)
            .map(move |k| k * wide)
    };
    // shifted by half a step, so that no point lies where there is no oscillator
    let place = |x: f64, y: f64| (x + 0.5 * dx, y + 0.5 * dy);
    let tiles: Vec<String> = seen(VIEW[1], dy)
        .flat_map(|y| seen(VIEW[0], dx).map(move |x| place(x, y)))
        .map(|from| map(from, (dx, dy), (SIDE, SIDE), r#","refine":8"#))
        .collect();
    let tiles = std::sync::Arc::new(std::sync::Mutex::new(tiles.into_iter()));
    let workers: Vec<_> = (0..ABREAST)
        .map(|_| {
            let (router, tiles) = (router.clone(), tiles.clone());
            tokio::spawn(async move {
                loop {
                    let Some(plan) = tiles.lock().unwrap().next() else { break };
                    ask(router.clone(), "/api/tile", plan).await;
                }
            })
        })
        .collect();
    for worker in workers {
        worker.await.unwrap();
    }
}

/// A click at S of the 1971 paper: the verdict and the waveform.
async fn click() {
    let router = app(Explorer::new(PORT, 0));
    let plan = |task: &str| {
        format!(r#"{{"version":1,"system":{{"inverse_beta":1.3,"gap":0.75,"restitution":0.5}},"task":{{{task}}}}}"#)
    };
    black_box(ask(router.clone(), "/api/answer", plan(r#""settle":{"start":{}}"#)).await);
    let simulate = plan(r#""simulate":{"start":{},"impacts":null,"periods":20}"#);
    black_box(ask(router, "/api/figure?kind=waveform&width=680&height=300", simulate).await);
}

fn waits(criterion: &mut Criterion) {
    let runtime = Runtime::new().unwrap();
    let mut group = criterion.benchmark_group("explorer");
    group.sample_size(10);
    group.bench_function("first picture", |b| {
        b.iter_batched(|| (), |()| runtime.block_on(first_picture()), BatchSize::PerIteration);
    });
    group.bench_function("sharp at 1000 x 700", |b| {
        b.iter_batched(|| (), |()| runtime.block_on(sharp()), BatchSize::PerIteration);
    });
    group.bench_function("click", |b| b.iter_batched(|| (), |()| runtime.block_on(click()), BatchSize::PerIteration));
    group.finish();
}

criterion_group!(benches, waits);
criterion_main!(benches);

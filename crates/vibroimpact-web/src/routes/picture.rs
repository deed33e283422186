//! A coarse picture of a map or a basin, as fine as can be computed in a given time: what a slider shows while it moves.
//!
//! The plan has the finest grid. The picture covers the same rectangle with fewer cells, and each of them has the motions
//! of the point in its centre. A few points are computed first. The time that they take says how many more fit; so
//! the time is kept on a machine that is busy, and where motions take long.

use super::asked::{PlanRequest, Query, bytes};
use super::tile::KIND;
use crate::refusal::Refusal;
use crate::workshop::Bench;
use crate::{Explorer, packed};
use axum::body::Bytes;
use axum::extract::State;
use axum::response::Response;
use core::sync::atomic::{AtomicBool, Ordering};
use core::time::Duration;
use serde::Deserialize;
use std::time::Instant;
use vibroimpact_study::study::{Sheet, in_memory};
use vibroimpact_study::{Control, Plan, RunError, Span, Study, Task, Values};

/// Number of points of the first attempt, which has no time limit.
const FIRST: f64 = 32.0;
/// Side of the part that one thread computes: small, so that the threads end at the same time.
const TILE: u32 = 4;
/// Parts of the time left that the further attempts may take, by the time that the attempt before them took. A quarter is
/// left for points that take longer than those before.
const PARTS: [f64; 2] = [0.2, 0.75];
/// If all points fit into this part of the time, there is no attempt between.
const EASY: f64 = 0.4;
/// An attempt with less than this number of times the points of the one before is not worth its time.
const GAIN: f64 = 1.5;

#[derive(Deserialize)]
pub(super) struct Limit {
    /// Milliseconds until the picture is there.
    within: u32,
}

pub(super) async fn picture(
    State(explorer): State<Explorer>,
    Query(limit): Query<Limit>,
    asked: PlanRequest,
) -> Result<Response, Refusal> {
    let end = Instant::now() + Duration::from_millis(limit.within.into());
    let plan = asked.plan;
    if !matches!(plan.task, Task::Map(_) | Task::Basin(_)) {
        return Err(Refusal::bad("a picture is one of a map or of a basin"));
    }
    let work = move |control: &Control<'_>| Ok(Bytes::from(packed::pack(&finest(&plan, end, control)?.1)));
    Ok(bytes(KIND, explorer.workshop.run(Bench::Pictures, 0, |_| {}, work).await?))
}

/// The finest picture that is there in time, and its plan.
fn finest(plan: &Plan, end: Instant, control: &Control<'_>) -> Result<(Plan, Sheet), Refusal> {
    let all = points(plan);
    let mut begin = Instant::now();
    let mut best = with_points(plan, FIRST)?;
    let mut sheet = in_memory(Study::new(&best)?, control)?;
    for part in PARTS {
        let (took, left) = (begin.elapsed().as_secs_f64(), end.saturating_duration_since(Instant::now()).as_secs_f64());
        let had = points(&best);
        let of = |part: f64| (had * part * left / took.max(1e-6)).min(all);
        let fits = if of(EASY) >= all { all } else { of(part) };
        if had >= all || fits < (GAIN * had).min(all) {
            continue;
        }
        begin = Instant::now();
        let finer = with_points(plan, fits)?;
        match before(end, &finer, control) {
            Ok(found) => (best, sheet) = (finer, found),
            Err(RunError::Stopped(_)) if !control.stopping() => break,
            Err(other) => return Err(other.into()),
        }
    }
    Ok((best, sheet))
}

/// The result of a plan, if it is there before `end`; else it is stopped.
fn before(end: Instant, plan: &Plan, control: &Control<'_>) -> Result<Sheet, RunError> {
    let stop = AtomicBool::new(false);
    let late = |_: u64| {
        if control.stopping() || Instant::now() > end {
            stop.store(true, Ordering::Relaxed);
        }
    };
    in_memory(Study::new(plan)?, &Control { stop: &stop, progress: &late, threads: control.threads })
}

/// Number of points of a plan.
fn points(plan: &Plan) -> f64 {
    #[allow(clippy::cast_precision_loss)] // fewer than the explorer computes at once
    plan.task.axes().iter().map(|axis| axis.over.count() as f64).product()
}

/// The plan with about this number of points, in cells of the same proportions over the same rectangle.
fn with_points(plan: &Plan, number: f64) -> Result<Plan, Refusal> {
    let part = (number / points(plan)).min(1.0).sqrt();
    let mut coarser = Plan { tile: Some(TILE), ..plan.clone() };
    let axes = match &mut coarser.task {
        Task::Map(map) => &mut map.axes,
        Task::Basin(basin) => &mut basin.axes,
        _ => return Ok(coarser),
    };
    for axis in axes {
        axis.over = cells(&axis.over, part)?;
    }
    Ok(coarser)
}

/// The centres of a part of the cells whose centres are these values. Lists and logarithmic ranges stay as they are.
fn cells(over: &Values, part: f64) -> Result<Values, Refusal> {
    let Values::Span(span) = over else { return Ok(over.clone()) };
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // at most the count
    let count = ((f64::from(span.count()) * part).round() as u32).clamp(1, span.count());
    if count == span.count() || span.is_logarithmic() {
        return Ok(over.clone());
    }
    let (first, last) = span.ends();
    let cell = (last - first) / f64::from(span.count() - 1);
    let larger = (last - first + cell) / f64::from(count);
    let air = (larger - cell) / 2.0;
    if count == 1 {
        return Ok(Values::Listed(vec![first + air]));
    }
    Ok(Span::new(first + air, last - air, count)?.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plan(count: u32) -> Plan {
        let axes = format!(
            r#"[{{"vary":"inverse_beta","over":"0.5:2:{count}"}},{{"vary":"gap","over":"0.02:4.98:{count}"}}]"#
        );
        let text = format!(
            r#"{{"version":1,"system":{{"inverse_beta":1,"gap":1,"restitution":0.5}},"task":{{"map":{{"axes":{axes},"starts":1,"impacts":200}}}}}}"#
        );
        Plan::from_text(&text).unwrap()
    }

    fn counts(plan: &Plan) -> Vec<usize> {
        plan.task.axes().iter().map(|axis| axis.over.count()).collect()
    }

    #[test]
    fn larger_cells_cover_the_same_rectangle() {
        for (number, count) in [(1e9, 90), (8100.0, 90), (900.0, 30), (100.0, 10), (1.0, 1)] {
            let coarser = with_points(&plan(90), number).unwrap();
            assert_eq!(counts(&coarser), [count, count]);
            for (axis, before) in coarser.task.axes().iter().zip(plan(90).task.axes()) {
                let edges = |values: &Values, cell: f64| {
                    (values.at(0) - cell / 2.0, values.at(values.count() - 1) + cell / 2.0)
                };
                let cell = before.over.at(1) - before.over.at(0);
                let (low, high) = edges(&before.over, cell);
                #[allow(clippy::cast_precision_loss)]
                let (l, h) = edges(&axis.over, (high - low) / count as f64);
                assert!((l - low).abs() < 1e-12 && (h - high).abs() < 1e-12, "{l} {h}");
            }
        }
    }

    /// In the time that is left after the first attempt a finer picture is made; without time the first one is the answer.
    /// All of its points are those of the plan of its grid.
    #[test]
    fn the_time_decides_how_fine_it_is() {
        let plan = plan(90);
        let sheet = |wait| finest(&plan, Instant::now() + Duration::from_secs(wait), &Control::default()).unwrap();
        let [none, all] = [0, 600].map(sheet);
        assert_eq!([counts(&none.0), counts(&all.0)], [[6, 6], [90, 90]]);
        for (of, found) in [none, all] {
            let again = in_memory(Study::new(&of).unwrap(), &Control::default()).unwrap();
            assert!(packed::pack(&again) == packed::pack(&found));
        }
    }

    #[test]
    fn it_stops_in_time_and_when_nobody_waits() {
        let late = before(Instant::now(), &plan(400), &Control::default());
        assert!(matches!(late, Err(RunError::Stopped(_))));
        let stop = AtomicBool::new(true);
        let control = Control { stop: &stop, ..Control::default() };
        assert!(finest(&plan(90), Instant::now() + Duration::from_secs(600), &control).is_err());
    }
}

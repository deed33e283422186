//! A motion as points and events, which the page draws and animates.

use super::asked::{PlanRequest, Query, bytes};
use crate::Explorer;
use crate::refusal::Refusal;
use crate::workshop::Bench;
use axum::body::Bytes;
use axum::extract::State;
use axum::response::Response;
use serde::Deserialize;
use vibroimpact_report::scene::SampledMotion;
use vibroimpact_report::{Answer, Units, answer as ask};
use vibroimpact_study::{Control, Results};

/// Number of forcing periods by default, and the allowed range.
const PERIODS: f64 = 20.0;
const RANGE: core::ops::RangeInclusive<f64> = 0.01..=1000.0;

#[derive(Deserialize)]
pub(super) struct Periods {
    /// Number of forcing periods.
    periods: Option<f64>,
}

/// The motion of a `simulate` plan from its start, or that of a `settle` plan after its transient.
pub(super) async fn motion(
    State(explorer): State<Explorer>,
    Query(asked_for): Query<Periods>,
    asked: PlanRequest,
) -> Result<Response, Refusal> {
    let periods = asked_for.periods.unwrap_or(PERIODS);
    if !RANGE.contains(&periods) {
        let (least, most) = (RANGE.start(), RANGE.end());
        return Err(Refusal::bad(format!("periods = {periods} lies outside {least} <= periods <= {most}")));
    }
    let plan = asked.plan;
    let name = format!("motion {} {periods}", plan.hash());
    let work = move |control: &Control<'_>| {
        let answer = ask(&plan, Units::default(), control)?;
        let Answer::Oscillator(answer) = &answer else { return Err(Refusal::machine()) };
        let (osc, start, units) = (&answer.system, answer.start, &answer.units);
        let motion = match &answer.results {
            Results::Simulate(_) => SampledMotion::new(osc, (start, 0.0), periods, units),
            Results::Settle(found) => SampledMotion::settled(osc, start, found, periods, units),
            _ => return Err(Refusal::bad("only simulate and settle have one motion\nhint: choose a start")),
        };
        // numbers and names can always be written as JSON
        Ok(Bytes::from(serde_json::to_vec(&motion).unwrap_or_default()))
    };
    Ok(bytes("application/json", explorer.once(name, (Bench::Answers, 0), |_| {}, work).await?))
}

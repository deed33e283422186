//! The output of the command for a plan (JSON, table and figure), and the command line itself.

use super::asked::{PlanRequest, Query, bytes, listed, wants_events};
use super::overlay::Overlay;
use crate::Explorer;
use crate::events::{Done, stream};
use crate::refusal::Refusal;
use crate::workshop::Bench;
use axum::Json;
use axum::body::Bytes;
use axum::extract::State;
use axum::http::{HeaderMap, StatusCode};
use axum::response::Response;
use core::sync::atomic::Ordering;
use serde::Deserialize;
use serde_json::{Value, json};
use vibroimpact_plot::Figure;
use vibroimpact_report::question::{python, python_showing, shell_line, shell_line_showing};
use vibroimpact_report::scene::View;
use vibroimpact_report::{AnswerError, Shown, Units, answer as ask};
use vibroimpact_study::Control;

/// The object that `--json` prints, with progress events if the page requests them.
pub(super) async fn answer(
    State(explorer): State<Explorer>,
    headers: HeaderMap,
    asked: PlanRequest,
) -> Result<Response, Refusal> {
    let name = format!("answer {}", asked.plan.hash());
    let done = Done::default();
    let told = done.clone();
    let (plan, points) = (asked.plan, asked.points);
    let work = async move {
        let told = move |now| told.store(now, Ordering::Relaxed);
        let work = move |control: &Control<'_>| Ok(Bytes::from(ask(&plan, Units::default(), control)?.json()));
        explorer.once(name, (Bench::Answers, 0), told, work).await
    };
    if wants_events(&headers) {
        let value =
            async { serde_json::from_slice(&work.await?).map_err(|_| Refusal::fault("an answer that is no JSON")) };
        return Ok(stream(points, done, value));
    }
    Ok(bytes("application/json", work.await?))
}

/// The table that `--csv` writes, or that of one view of a settled motion.
pub(super) async fn table(
    State(explorer): State<Explorer>,
    Query(wanted): Query<Wanted>,
    asked: PlanRequest,
) -> Result<Response, Refusal> {
    let plan = asked.plan;
    let work = move |control: &Control<'_>| {
        let answer = ask(&plan, Units::default(), control)?;
        let table = answer.table(&wanted.shown())?;
        let table = table.ok_or_else(|| nothing("table"))?;
        let mut text = Vec::new();
        table.write(&mut text).map_err(|_| Refusal::fault("a table that cannot be written"))?;
        Ok(Bytes::from(text))
    };
    let body = explorer.workshop.run(Bench::Answers, 0, |_| {}, work).await?;
    Ok(bytes("text/csv; charset=utf-8", body))
}

/// The command line and the call in Python for the same result; and for the figure of one view of a settled motion, if
/// one is named. `null` if there is none.
pub(super) async fn command(Query(wanted): Query<Wanted>, asked: PlanRequest) -> Json<Value> {
    let plan = &asked.plan;
    let (vibro, python) = match wanted.kind {
        Some(view) => (shell_line_showing(plan, view), python_showing(plan, view)),
        None => (shell_line(plan), python(plan)),
    };
    Json(json!({ "vibro": vibro, "python": python }))
}

/// The options of a figure. Sizes are in units in which text is 20 high.
#[derive(Deserialize)]
pub(super) struct Wanted {
    #[serde(default)]
    format: Format,
    width: Option<f64>,
    height: Option<f64>,
    /// The view of a settled motion; by default that of `--plot`.
    kind: Option<View>,
    /// The layers over a map, separated by commas.
    layers: Option<String>,
    /// The chosen point of a map: its abscissa and ordinate, separated by a comma.
    chosen: Option<String>,
    /// A line in a map: the coordinates of its ends, separated by commas.
    line: Option<String>,
}

#[derive(Clone, Copy, Default, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
enum Format {
    #[default]
    Svg,
    Png,
}

/// Allowed sizes of figures, in their units.
const SIZES: core::ops::RangeInclusive<f64> = 200.0..=4000.0;
/// Pixels of a PNG for each unit.
const SHARPNESS: f64 = 2.0;

impl Wanted {
    fn shown(&self) -> Shown {
        // a figure without a list of layers is that of the command
        let Some(layers) = &self.layers else { return Shown { view: self.kind, ..Shown::default() } };
        let has = |name: &str| listed(layers).iter().any(|layer| layer == name);
        Shown { view: self.kind, stripes: has("stripes"), boundaries: has("boundaries"), ..Shown::default() }
    }

    fn overlay(&self) -> Result<Overlay, Refusal> {
        let layers = self.layers.as_deref().map(listed).unwrap_or_default();
        Ok(Overlay {
            layers,
            chosen: numbers("chosen", self.chosen.as_deref())?,
            line: numbers("line", self.line.as_deref())?,
        })
    }

    pub(super) fn check(&self) -> Result<(), Refusal> {
        for (name, size) in [("width", self.width), ("height", self.height)] {
            if let Some(given) = size.filter(|size| !SIZES.contains(size)) {
                let (least, most) = (SIZES.start(), SIZES.end());
                return Err(Refusal::bad(format!("{name} = {given} lies outside {least} <= {name} <= {most}")));
            }
        }
        Ok(())
    }

    pub(super) fn draw(&self, figure: Figure) -> Result<(&'static str, Bytes), Refusal> {
        // a width alone keeps the proportions
        let width = self.width.unwrap_or(figure.width);
        let height = self.height.unwrap_or(figure.height * width / figure.width);
        let figure = figure.size(width, height);
        Ok(match self.format {
            Format::Svg => ("image/svg+xml", Bytes::from(figure.to_svg())),
            Format::Png => {
                let png = figure.to_png(SHARPNESS).map_err(|error| Refusal::bad(error.to_string()))?;
                ("image/png", Bytes::from(png))
            }
        })
    }
}

/// A number of a query is this many numbers, separated by commas.
fn numbers<const N: usize>(name: &str, text: Option<&str>) -> Result<Option<[f64; N]>, Refusal> {
    let Some(text) = text else { return Ok(None) };
    let numbers: Vec<f64> =
        text.split(',').filter_map(|number| number.trim().parse().ok()).filter(|n: &f64| n.is_finite()).collect();
    let found = <[f64; N]>::try_from(numbers);
    found.map(Some).map_err(|_| Refusal::bad(format!("{name} = {text} is not {N} numbers separated by commas")))
}

/// The figure that `--plot` draws, or another view; that of a map with what lies over it on the page.
pub(super) async fn figure(
    State(explorer): State<Explorer>,
    Query(wanted): Query<Wanted>,
    asked: PlanRequest,
) -> Result<Response, Refusal> {
    wanted.check()?;
    let plan = asked.plan;
    let work = move |control: &Control<'_>| {
        let answer = ask(&plan, Units::default(), control)?;
        let mut figure = answer.figure(&wanted.shown(), control)?.ok_or_else(|| nothing("figure"))?;
        wanted.overlay()?.add(&mut figure, &plan, control)?;
        wanted.draw(figure)
    };
    let (kind, body) = explorer.workshop.run(Bench::Answers, 0, |_| {}, work).await?;
    Ok(bytes(kind, body))
}

fn nothing(what: &str) -> Refusal {
    Refusal::new(StatusCode::NOT_FOUND, format!("this plan has no such {what}"))
}

impl From<AnswerError> for Refusal {
    fn from(error: AnswerError) -> Self {
        match error {
            AnswerError::Stopped(stopped) => Self::new(StatusCode::REQUEST_TIMEOUT, stopped.to_string()),
            other => Self::bad(other.to_string()),
        }
    }
}

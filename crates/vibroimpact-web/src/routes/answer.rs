//! The output of the command for a plan (JSON, table and figure), and the command line itself.

use super::asked::{PlanRequest, Query, bytes, listed};
use crate::Explorer;
use crate::events::answered;
use crate::refusal::Refusal;
use crate::workshop::Bench;
use axum::Json;
use axum::body::Bytes;
use axum::extract::State;
use axum::http::{HeaderMap, StatusCode};
use axum::response::Response;
use serde::Deserialize;
use serde_json::{Value, json};
use vibroimpact_plot::Figure;
use vibroimpact_report::figure::coloured::{Coloured, Of};
use vibroimpact_report::figure::overlay::{Layer, Overlay};
use vibroimpact_report::question::{python, python_showing, shell_line, shell_line_figure, shell_line_showing};
use vibroimpact_report::scene::View;
use vibroimpact_report::{AnswerError, Shown, Table, Units, answer as ask};
use vibroimpact_study::{Control, Task};

/// The object that `--json` prints, with progress events if the page requests them.
pub(super) async fn answer(
    State(explorer): State<Explorer>,
    headers: HeaderMap,
    asked: PlanRequest,
) -> Result<Response, Refusal> {
    let PlanRequest { plan, points } = asked;
    let work = |progress| async move {
        let name = format!("answer {}", plan.hash());
        let work = move |control: &Control<'_>| Ok(Bytes::from(ask(&plan, Units::default(), control)?.json()));
        explorer.once(name, (Bench::Answers, 0), progress, work).await
    };
    let value = |body: Bytes| serde_json::from_slice(&body).map_err(|_| Refusal::fault("an answer that is no JSON"));
    answered(&headers, points, work, value, |body| bytes("application/json", body)).await
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
        let table = answer.table(&wanted.shown()?)?;
        csv(table.ok_or_else(|| nothing("table"))?)
    };
    let (kind, body) = explorer.workshop.run(Bench::Answers, 0, |_| {}, work).await?;
    Ok(bytes(kind, body))
}

/// A table as a body, and its type.
pub(super) fn csv(table: Table<'_>) -> Result<(&'static str, Bytes), Refusal> {
    let mut text = Vec::new();
    table.write(&mut text).map_err(|_| Refusal::fault("a table that cannot be written"))?;
    Ok(("text/csv; charset=utf-8", Bytes::from(text)))
}

/// The command line and the call in Python for the same result; and for the figure of one view of a settled motion, if
/// one is named. Of a map, a basin and a diagram `figure` is the command line for its figure. `null` if there is none.
pub(super) async fn command(Query(wanted): Query<Wanted>, asked: PlanRequest) -> Result<Json<Value>, Refusal> {
    let plan = &asked.plan;
    let figure = match &plan.task {
        Task::Map(_) | Task::Basin(_) => shell_line_figure(plan, wanted.coloured()?.as_ref(), &wanted.overlay()?),
        Task::Diagram(_) => shell_line(plan).map(|line| format!("{line} --branches --plot diagram.svg")),
        _ => None,
    };
    let (vibro, python) = match wanted.kind {
        Some(view) => (shell_line_showing(plan, view), python_showing(plan, view)),
        None => (shell_line(plan), python(plan)),
    };
    Ok(Json(json!({ "vibro": vibro, "python": python, "figure": figure })))
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
    /// The layers of a map, separated by commas; without a list those of the command.
    layers: Option<String>,
    /// A point of a map: its abscissa and ordinate in the units of the axes, separated by a comma.
    mark: Option<String>,
    /// A line in a map: the coordinates of its ends in the units of the axes, separated by commas.
    line: Option<String>,
    /// The quantity in whose colours a map or basin is drawn.
    colour: Option<String>,
    /// Which of several motions at a point has the colour: `largest`, `smallest` or `likeliest`.
    of: Option<String>,
    /// The values at the ends of the colours, separated by a comma.
    range: Option<String>,
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
    fn shown(&self) -> Result<Shown, Refusal> {
        Ok(Shown { view: self.kind, colour: self.coloured()?, overlay: self.overlay()?, ..Shown::default() })
    }

    /// The colours of a quantity, if one is named.
    fn coloured(&self) -> Result<Option<Coloured>, Refusal> {
        let Some(field) = self.colour.clone() else { return Ok(None) };
        let of = match self.of.as_deref() {
            None => Of::default(),
            Some(name) => Of::from_name(name)
                .ok_or_else(|| Refusal::bad(format!("of = {name} is none of largest, smallest, likeliest")))?,
        };
        let range = numbers("range", self.range.as_deref())?.map(|[low, high]: [f64; 2]| (low, high));
        match range.filter(|(low, high)| low >= high) {
            Some((low, high)) => Err(Refusal::bad(format!("range = {low},{high} is not a low and a high value"))),
            None => Ok(Some(Coloured { field, of, range })),
        }
    }

    fn overlay(&self) -> Result<Overlay, Refusal> {
        let layer = |name: &String| {
            let known = Layer::from_name(name);
            known.ok_or_else(|| Refusal::bad(format!("layers = {name}: there is no such layer")))
        };
        let layers = match self.layers.as_deref() {
            None => Overlay::default().layers,
            Some("") => Vec::new(),
            Some(names) => listed(names).iter().map(layer).collect::<Result<_, _>>()?,
        };
        let (mark, line) = (numbers("mark", self.mark.as_deref())?, numbers("line", self.line.as_deref())?);
        Ok(Overlay { layers, mark, line })
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
        let shown = wanted.shown()?;
        let answer = ask(&plan, Units::default(), control)?;
        let figure = answer.figure(&shown, control)?.ok_or_else(|| nothing("figure"))?;
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

//! The border between the starts of two motions, and the motion on it.

use crate::figure::label;
use crate::json::motion::MotionObject;
use crate::number::{Number, precise, short};
use crate::text::Teller;
use crate::{AnswerOf, Table, Told};
use core::fmt::Write;
use schemars::JsonSchema;
use serde::Serialize;
use vibroimpact::edge::{Bordered as _, Edge};
use vibroimpact_plot::{Figure, FigureAxis, Legend, Panel, Points, SERIES, plain};
use vibroimpact_study::counted;

/// The answer to `vibro edge`.
#[derive(JsonSchema, Serialize)]
pub(crate) struct EdgeAnswer<'a> {
    /// The motion of the first start, and that beyond the border.
    sides: [MotionObject<'a>; 2],
    /// Where the border crosses the way from the first start to the second: 0 at the first, 1 at the second.
    part: f64,
    /// The motion on the border.
    track: Vec<TrackObject>,
    /// The motion to which it leads; null if it leads to no cycle that was found.
    saddle: Option<MotionObject<'a>>,
}

/// A state on the border.
#[derive(JsonSchema, Serialize)]
struct TrackObject {
    /// The time since the way between the two starts.
    time: f64,
    q: Vec<f64>,
    qdot: Vec<f64>,
    /// The phase of the force.
    phase: f64,
    /// The distance of the two states between which the border passes, relative to their size.
    apart: f64,
}

impl<'a> EdgeAnswer<'a> {
    pub(crate) fn new<D: Told>(of: &'a AnswerOf<D>, found: &'a Edge<D::System>) -> Self {
        let track = found.track.iter().map(|point| {
            let (q, qdot) = D::numbers(of, &point.state);
            TrackObject {
                time: point.time * of.units.time(),
                q,
                qdot,
                phase: of.system.phase(&point.state),
                apart: point.apart,
            }
        });
        Self {
            sides: found.sides.each_ref().map(|side| D::motion(of, side)),
            part: found.part,
            track: track.collect(),
            saddle: found.saddle.as_ref().map(|saddle| D::motion(of, saddle)),
        }
    }
}

/// The table of `vibro edge`.
pub(crate) fn table<'a, D: Told>(of: &'a AnswerOf<D>, found: &'a Edge<D::System>) -> Table<'a> {
    let (q, qdot) = D::names(of);
    let time = if of.units.si { "time_s" } else { "time" };
    let header = [&[time.to_owned()][..], &q, &qdot, &["phase".to_owned(), "apart".to_owned()]].concat().join(",");
    let rows = found.track.iter().map(|point| {
        let (q, qdot) = D::numbers(of, &point.state);
        let all =
            [&[point.time * of.units.time()][..], &q, &qdot, &[of.system.phase(&point.state), point.apart]].concat();
        all.into_iter().map(|value| Number(value).to_string()).collect::<Vec<_>>().join(",")
    });
    Table::new(header, rows)
}

/// Diameters of the states, and of the last one.
const STATE: f64 = 6.0;
const LAST: f64 = 9.0;

/// The figure of `vibro edge`.
pub(crate) fn figure<D: Told>(of: &AnswerOf<D>, found: &Edge<D::System>, title: &str) -> Figure {
    let states: Vec<(f64, f64)> = found
        .track
        .iter()
        .map(|point| {
            let (q, qdot) = D::numbers(of, &point.state);
            (q.first().copied().unwrap_or(0.0), qdot.first().copied().unwrap_or(0.0))
        })
        .collect();
    let (xs, ys): (Vec<f64>, Vec<f64>) = states.iter().copied().unzip();
    let all = Points::new(xs.clone(), ys.clone(), SERIES[0]).size(STATE);
    let last = Points::new(
        xs.last().copied().into_iter().collect::<Vec<_>>(),
        ys.last().copied().into_iter().collect::<Vec<_>>(),
        SERIES[1],
    )
    .size(LAST);
    let axes = if D::machine(of).is_some() {
        let (q, qdot) = D::names(of);
        [q, qdot].map(|names| names.first().map_or_else(String::new, |name| plain(name)))
    } else {
        [of.units.named("position *x*", "m"), of.units.named("velocity *v*", "m/s")]
    };
    let [x, y] = axes.map(FigureAxis::new);
    let sides = found.sides.each_ref().map(|side| label(&side.label()));
    let reached = match &found.saddle {
        Some(saddle) => format!("close to {}", label(&saddle.label())),
        None => "last state".to_owned(),
    };
    let legend = Legend::below().points(&all, "states on the border, one a lap").points(&last, reached);
    let border = format!("border of {} and {}", sides[0], sides[1]);
    let title = if title.is_empty() { border } else { format!("{title}: {border}") };
    Figure::new(Panel::new(x, y).with(all).with(last)).title(title).legend(legend)
}

/// Both motions, where the border lies, and to which motion that on it leads.
pub(crate) fn text<D: Teller>(of: &AnswerOf<D>, found: &Edge<D::System>) -> String {
    let sides = found.sides.each_ref().map(|side| side.label());
    let mut text = format!(
        "border between {} and {}, at {} of the way from the first start to the second\n",
        sides[0],
        sides[1],
        precise(found.part)
    );
    let laps = found.track.len().saturating_sub(1);
    match &found.saddle {
        Some(saddle) => {
            let _ = writeln!(
                text,
                "the motion on the border comes close to this one after {}:",
                counted(laps as u64, "lap")
            );
            text.push_str(&D::told_briefly(of, saddle));
        }
        None => text.push_str(&format!(
            "the motion on the border came back to none of its earlier states in {}\n",
            counted(laps as u64, "lap")
        )),
    }
    if let Some(last) = found.track.last() {
        let (q, qdot) = D::numbers(of, &last.state);
        let numbers = |all: &[f64]| all.iter().map(|value| precise(*value)).collect::<Vec<_>>().join(", ");
        let _ = writeln!(
            text,
            "  last state on it: q = {}, qdot = {}, phase {}, known to {}",
            numbers(&q),
            numbers(&qdot),
            short(of.system.phase(&last.state)),
            short(last.apart)
        );
    }
    text
}

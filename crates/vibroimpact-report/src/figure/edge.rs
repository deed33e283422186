//! The motion on a border: its states in the plane of the first coordinate, and how far apart the pair is that encloses it.

use crate::answer::{AnswerOf, Told};
use crate::figure::label;
use vibroimpact::edge::Edge;
use vibroimpact_plot::{Figure, FigureAxis, Legend, Panel, Points, SERIES, plain};

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

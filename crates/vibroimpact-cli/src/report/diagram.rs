//! An orbit diagram as a table of points and as a count of what there is.

use crate::args::Units;
use crate::report::csv::Number;
use crate::report::json::side;
use serde::Serialize;
use vibroimpact_study::Span;
use vibroimpact_study::diagram::{Diagram, Direction, Kind, Point, Show, Step, Sweep};

/// The columns of the table.
pub(crate) fn columns(found: &Diagram) -> Vec<&'static str> {
    let name = found.plan.vary.name();
    match found.plan.show {
        Show::Velocity => vec![name, "sweep", "kind", "side", "phase", "velocity"],
        Show::Strobe => vec![name, "sweep", "kind", "x", "v"],
    }
}

/// One row a point; one row with empty places for a motion that has none to show. Values of the parameter are the very
/// numbers of the question.
pub(crate) fn rows<'a>(found: &'a Diagram, over: &'a Span, units: Units) -> impl Iterator<Item = String> + 'a {
    let none = match found.plan.show {
        Show::Velocity => ",,",
        Show::Strobe => ",",
    };
    found.steps.iter().flat_map(move |step| {
        let head = format!("{},{}", Number(over.at(step.index)), sweep(step.sweep));
        let alone = step.points.is_empty().then(|| format!("{head},{},{none}", kind(step.kind)));
        let points = step.points.iter().map(move |point| format!("{head},{}", row(step, point, units)));
        alone.into_iter().chain(points)
    })
}

fn row(step: &Step, point: &Point, units: Units) -> String {
    match point {
        Point::Impact { phase, velocity, side: at } => {
            format!("impact,{},{},{}", side(*at), Number(*phase), Number(velocity * units.velocity()))
        }
        Point::Chatter { phase, side: at } => format!("chatter,{},{},0", side(*at), Number(*phase)),
        Point::State { x, v } => {
            format!("{},{},{}", kind(step.kind), Number(x * units.length()), Number(v * units.velocity()))
        }
    }
}

fn sweep(sweep: Sweep) -> String {
    match sweep {
        Sweep::Up => "up".into(),
        Sweep::Down => "down".into(),
        Sweep::Start(k) => format!("start {}", k + 1),
    }
}

const fn kind(kind: Kind) -> &'static str {
    match kind {
        Kind::Impacts => "impact",
        Kind::NoImpact => "none",
        Kind::Stuck => "stuck",
        Kind::Undecided => "undecided",
    }
}

/// What the motions of a sweep, or of all scattered starts, turned out to be.
#[derive(Clone, Debug, Default, Serialize)]
pub(crate) struct Counts {
    pub(crate) sweep: &'static str,
    /// Motions followed.
    pub(crate) motions: usize,
    /// Those with impacts.
    pub(crate) impact: usize,
    pub(crate) none: usize,
    pub(crate) stuck: usize,
    pub(crate) undecided: usize,
    /// Points to show.
    pub(crate) points: usize,
}

/// The counts, one for each sweep.
pub(crate) fn counts(found: &Diagram) -> Vec<Counts> {
    let names: &[&str] = match found.plan.direction {
        Direction::Up => &["up"],
        Direction::Down => &["down"],
        Direction::Both => &["up", "down"],
        Direction::Scatter { .. } => &["scatter"],
    };
    let mut counts: Vec<Counts> = names.iter().map(|sweep| Counts { sweep, ..Counts::default() }).collect();
    for step in &found.steps {
        let row = usize::from(step.sweep == Sweep::Down && counts.len() > 1);
        let count = &mut counts[row];
        count.motions += 1;
        count.points += step.points.len();
        *match step.kind {
            Kind::Impacts => &mut count.impact,
            Kind::NoImpact => &mut count.none,
            Kind::Stuck => &mut count.stuck,
            Kind::Undecided => &mut count.undecided,
        } += 1;
    }
    counts
}

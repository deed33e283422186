//! The figure of the branches over an orbit diagram.

use super::branches::{Kind, events};
use crate::{EPS, Error};
use vibroimpact::continuation::SolutionPoint;
use vibroimpact::math::sort_by;
use vibroimpact::scenario;
use vibroimpact_plot::{
    Colour, DOUBLE_COLUMN, Dash, Figure, FigureAxis, Legend, Line, Panel, Points, SERIES, Shape, Stroke, Text,
};
use vibroimpact_study::diagram::{self, DiagramPlan};
use vibroimpact_study::{Control, Parameter, Plan, PlanResults, Results, Span, SystemPlan, Task, run};

/// The range of the gap shown.
const SHOWN: (f64, f64) = (-0.45, 5.45);
/// Maximum number of impacts of an orbit that is drawn.
const MOST: usize = 6;

pub(super) fn figure(branches: &[Vec<SolutionPoint>]) -> Result<Figure, Error> {
    let mut panel = Panel::new(
        FigureAxis::new("gap *δ*").range(SHOWN.0, SHOWN.1),
        FigureAxis::new("impact speed *U*").range(0.0, 4.7),
    );
    let (xs, ys) = simulated()?;
    let dots = Points::new(xs, ys, Colour::hex(0xb8_b8b8)).size(1.6);
    panel.add(dots.clone());
    let [stable, unstable] = [Stroke::new(SERIES[0]).width(3.0), Stroke::new(SERIES[1]).width(2.0).dash(Dash::Dashed)];
    // an orbit may be found on several branches; dashes drawn twice would look like a solid line
    let mut runs: Vec<&[SolutionPoint]> = Vec::new();
    for run in branches.iter().flat_map(|branch| branch.chunk_by(|a, b| a.cycle.label == b.cycle.label)) {
        if run[0].cycle.points.len() <= MOST && !runs.iter().any(|known| covers(known, run)) {
            runs.push(run);
        }
    }
    // stable parts are drawn on top
    for wanted in [false, true] {
        for run in &runs {
            for (xs, ys) in pieces(run, wanted) {
                panel.add(Line { xs, ys, stroke: if wanted { stable } else { unstable } });
            }
        }
    }
    let mut legend = Legend::below()
        .points(&Points::new([0.0], [0.0], Colour::hex(0x90_9090)).size(6.0), "simulation, swept up and down")
        .line(stable, "stable orbit")
        .line(unstable, "unstable orbit");
    for (kind, shape, name) in [
        (Kind::Flip, Shape::Diamond, "flip"),
        (Kind::Fold, Shape::TriangleUp, "fold"),
        (Kind::Grazing, Shape::Circle, "grazing"),
        (Kind::LossOfContact, Shape::Square, "loss of contact"),
    ] {
        let mut at: Vec<(f64, f64)> = Vec::new();
        for event in events(branches).into_iter().filter(|e| e.kind == kind) {
            // an orbit with too many impacts is not drawn, so it has no mark
            let cycle = event.orbits[0].near(0.0);
            if cycle.points.len() <= MOST {
                at.push((event.gap, cycle.fastest()));
            }
        }
        let (xs, ys): (Vec<f64>, Vec<f64>) = at.into_iter().unzip();
        let marks = Points::new(xs, ys, Colour::BLACK).size(9.0).shape(shape).rim(Colour::WHITE);
        panel.add(marks.clone());
        legend = legend.points(&marks, name);
    }
    for (label, x, y) in
        [("2/1", -0.02, 2.62), ("1/1", 1.0, 2.55), ("1/2", 2.3, 3.55), ("1/3", 3.72, 3.95), ("1/4", 4.93, 3.55)]
    {
        panel.add(Text::new(x, y, format!("**{label}**")).size(22.0));
    }
    Ok(Figure::new(panel).size(DOUBLE_COLUMN, 620.0).legend(legend))
}

/// Impact speeds of simulated motions over the gap.
fn simulated() -> Result<(Vec<f64>, Vec<f64>), Error> {
    let system = SystemPlan::from_inverse_beta(scenario::T.inverse_beta, 0.0, EPS);
    let plan: DiagramPlan = DiagramPlan::new(Parameter::Gap, Span::new(SHOWN.0, SHOWN.1, 1181)?);
    let results = run(&Plan::new(system, Task::from(plan)), &Control::default())?;
    let PlanResults::Oscillator(Results::Diagram(found)) = results else {
        return Err(Error::Unexpected("a diagram came out as something else"));
    };
    let mut places = Vec::new();
    for step in &found.steps {
        places.extend(step.points.iter().filter_map(|point| match point {
            diagram::DiagramPoint::Impact { speed, .. } => Some((found.plan.over.at(step.index as usize), *speed)),
            _ => None,
        }));
    }
    Ok(places.into_iter().unzip())
}

/// Whether a run of one label contains the middle of another run.
fn covers(known: &[SolutionPoint], run: &[SolutionPoint]) -> bool {
    let middle = &run[run.len() / 2];
    let on = |a: &SolutionPoint, b: &SolutionPoint| {
        let share = (middle.value - a.value) / (b.value - a.value);
        let speed = a.cycle.fastest() + share * (b.cycle.fastest() - a.cycle.fastest());
        (0.0..=1.0).contains(&share) && (speed - middle.cycle.fastest()).abs() < 1e-2
    };
    known[0].cycle.label == middle.cycle.label && known.windows(2).any(|pair| on(&pair[0], &pair[1]))
}

/// The lines of the stable or the unstable parts of a run: one for each impact of the orbit, by its speed.
fn pieces(run: &[SolutionPoint], stable: bool) -> Vec<(Vec<f64>, Vec<f64>)> {
    let speeds: Vec<Vec<f64>> = run
        .iter()
        .map(|point| {
            let mut speeds: Vec<f64> = point.cycle.points.iter().map(|p| p.state.velocity).collect();
            sort_by(&mut speeds, |a, b| b.total_cmp(a));
            speeds
        })
        .collect();
    // an event belongs to both adjacent parts
    let wanted = |k: usize| {
        let around = [k.saturating_sub(1), (k + 1).min(run.len() - 1)];
        let plain = |j: usize| run[j].event.is_none() && run[j].stable() == stable;
        if run[k].event.is_some() { around.into_iter().any(plain) } else { plain(k) }
    };
    let line = |rank: usize| {
        let speed = |k: usize| if wanted(k) { speeds[k][rank] } else { f64::NAN };
        (run.iter().map(|p| p.value).collect(), (0..run.len()).map(speed).collect())
    };
    (0..speeds[0].len()).map(line).collect()
}

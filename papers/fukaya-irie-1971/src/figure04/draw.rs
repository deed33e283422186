//! The drawing of figure 4.

use super::{GAP, Plane, X, free_amplitude};
use crate::grid::Grid;
use crate::looks;
use crate::regions::outlines;
use vibroimpact::scenario;
use vibroimpact_plot::{Colour, Dash, Figure, FigureAxis, Key, Line, Panel, Points, Rects, Stroke, Text};

/// The regions drawn, and the positions of their names.
const DRAWN: [((u32, u32), (f64, f64)); 4] =
    [((1, 1), (1.0, 0.9)), ((2, 1), (1.55, 0.9)), ((3, 1), (1.9, 0.52)), ((1, 2), (1.17, 2.5))];

pub(super) fn figure(grid: &Grid, plane: &Plane) -> Figure {
    let mut panel =
        Panel::new(FigureAxis::new("1/*β*").range(X.0, X.1), FigureAxis::new("gap *δ*").range(GAP.0, GAP.1))
            .with(cells(grid));
    let exists = Stroke::new(Colour::BLACK).width(2.0).dash(Dash::Dotted);
    for ((m, n), _) in DRAWN {
        let Some(region) = plane.region(m, n) else {
            continue;
        };
        for line in region.exists.iter().flat_map(|found| found.polygons.iter().flat_map(outlines)) {
            let (xs, ys): (Vec<f64>, Vec<f64>) = line.into_iter().map(|(at, _)| at).unzip();
            panel.add(Line::new(xs.clone(), ys.clone(), Colour::WHITE).width(4.5));
            panel.add(Line { xs, ys, stroke: exists });
        }
    }
    // the region of stability is drawn over that of existence, because their lines often coincide
    for region in DRAWN.iter().filter_map(|((m, n), _)| plane.region(*m, *n)) {
        for line in region.stable.polygons.iter().flat_map(outlines) {
            let (xs, ys): (Vec<f64>, Vec<f64>) = line.into_iter().map(|(at, _)| at).unzip();
            panel.add(Line::new(xs.clone(), ys.clone(), Colour::WHITE).width(4.5));
            panel.add(Line::new(xs, ys, Colour::BLACK).width(2.0));
        }
    }
    let dashed = Stroke::new(AMPLITUDE).width(3.0).dash(Dash::Dashed);
    for part in amplitude() {
        let (xs, ys): (Vec<f64>, Vec<f64>) = part.into_iter().unzip();
        panel.add(Line::new(xs.clone(), ys.clone(), Colour::WHITE).width(6.0));
        panel.add(Line { xs, ys, stroke: dashed });
    }
    for ((m, n), (x, gap)) in DRAWN {
        panel.add(Text::new(x, gap, format!("**{m}/{n}**")).size(24.0));
    }
    let points = Points::new(scenario::PAPER.map(|p| p.inverse_beta), scenario::PAPER.map(|p| p.gap), Colour::BLACK)
        .size(11.0)
        .rim(Colour::WHITE);
    panel.add(points.clone());
    for point in scenario::PAPER {
        let text = Text::new(point.inverse_beta, point.gap, format!("***{}***", point.name));
        let side = if point.name == "N" { -15.0 } else { 16.0 };
        panel.add(text.size(24.0).shift(side, 14.0));
    }
    let labels = grid.labels();
    let legend = looks::legend(labels.iter().map(|(label, _)| label.as_str()))
        .entry(Key::Outline(Stroke::new(Colour::BLACK).width(2.0)), "stable by theory")
        .line(exists, "exists, unstable")
        .line(dashed, "amplitude |*f*|")
        .points(&points, "*N* to *U*");
    looks::column(panel, 760.0).legend(legend)
}

/// Vermilion, which differs from the colours of all classes that it crosses, also for colour-blind readers.
const AMPLITUDE: Colour = Colour::hex(0xd5_1e00);

/// The cells of a grid, in stripes where motions coexist.
pub(crate) fn cells(grid: &Grid) -> Rects {
    let mut rects = Rects::new(looks::styles());
    let half = |(a, b): (f64, f64), n: u32| (b - a) / f64::from(n - 1) / 2.0;
    let (dx, dy) = (half(grid.x.ends(), grid.x.count()), half(grid.gap.ends(), grid.gap.count()));
    for point in &grid.points {
        let mut classes: Vec<usize> = point.motions.iter().map(|found| looks::class(&found.verdict.label())).collect();
        classes.sort_unstable();
        classes.dedup();
        let (x, y) = (point.inverse_beta, point.gap);
        rects.cell((x - dx, x + dx), (y - dy, y + dy), &classes);
    }
    rects
}

/// |f| over 1/beta in its two parts, up to the top of the window.
pub(super) fn amplitude() -> [Vec<(f64, f64)>; 2] {
    // |f| = top at 1/beta^2 = 1 +- 1/top
    let top = GAP.1 + 0.1;
    let ends = [(X.0, (top / (top + 1.0)).sqrt()), ((top / (top - 1.0)).sqrt(), X.1)];
    ends.map(|(a, b)| (0..=200).map(|k| a + (b - a) * f64::from(k) / 200.0).map(|x| (x, free_amplitude(x))).collect())
}

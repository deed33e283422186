//! Figures 6 to 9: the motion to which each start (xi0, u0) leads, at P, Q, R and S, phase 0.

use crate::claims::{Agreement, Section};
use crate::folder::Csv;
use crate::{Error, Run, looks};
use std::collections::BTreeMap;
use vibroimpact::scenario::{self, Scenario};
use vibroimpact::verdict::{SettleOptions, settle};
use vibroimpact::{Oscillator, Start};
use vibroimpact_plot::{
    ClassStyle, Colour, FigureAxis, Legend, Panel, Points, Raster, Shape, class_style, legend_text,
};
use vibroimpact_study::{Basin, BasinPlan, Plan, PlanResults, Results, Span, SystemPlan, Task};

/// A basin and the values measured on it.
struct Picture {
    point: Scenario,
    osc: Oscillator,
    /// The positions of the starts.
    x: Span,
    /// Their velocities.
    v: Span,
    basin: Basin,
    /// Share of the starts by label.
    shares: BTreeMap<String, f64>,
    /// The motion to which the start at rest at the origin leads.
    origin: String,
    /// Area, in units of xi0 times u0, of the starts that lead to the motion without impacts; and of the part that
    /// contains the origin.
    quiet: f64,
    round_origin: f64,
}

/// The shares that the conclusions need.
#[derive(Clone, Debug)]
pub(crate) struct Shares {
    /// 1/1 and 2/1 at S.
    pub(crate) at_s: BTreeMap<String, f64>,
}

/// The windows. That of P is smaller, because only starts close to the motion without impacts lead to it.
const FIGURES: [(&str, &str, Scenario, f64, f64); 4] = [
    ("figure-06", "figure 6: starts at P", scenario::P, -2.0, 2.0),
    ("figure-07", "figure 7: starts at Q", scenario::Q, -8.0, 8.0),
    ("figure-08", "figure 8: starts at R", scenario::R, -8.0, 8.0),
    ("figure-09", "figure 9: starts at S", scenario::S, -8.0, 8.0),
];

pub(crate) fn run(run: &mut Run<'_>) -> Result<Shares, Error> {
    let n = run.size(400, 100);
    let mut pictures = Vec::new();
    let mut drawings = Vec::new();
    for (name, stage, point, lowest, fastest) in FIGURES {
        let (x, v) = (Span::new(lowest, point.gap, n)?, Span::new(-fastest, fastest, n)?);
        let plan = BasinPlan::plane(x, v, 0.0);
        run.stage(stage, u64::from(n) * u64::from(n))?;
        let system = SystemPlan::from_inverse_beta(point.inverse_beta, point.gap, 0.5);
        let plan = Plan::new(system, Task::from(plan));
        let PlanResults::Oscillator(Results::Basin(basin)) = vibroimpact_study::run(&plan, run.control)? else {
            return Err(Error::Unexpected("a basin came out as something else"));
        };
        let picture = measure(point, (x, v), basin);
        run.folder.write(&format!("{name}.csv"), table(&picture).bytes())?;
        drawings.push(run.folder.figure(name, draw(&picture)?)?);
        pictures.push(picture);
    }
    let quiet = [pictures[0].quiet, pictures[1].quiet];
    for (k, (picture, svg)) in pictures.iter().zip(drawings).enumerate() {
        let (name, ..) = FIGURES[k];
        let mut section = Section::new(TITLES[k], caption(picture)).svg(name, svg, &[]);
        match k {
            0 => at_p(&mut section, picture),
            1 => at_q(&mut section, picture, quiet),
            2 => at_r(&mut section, picture),
            _ => at_s(&mut section, picture),
        }
        run.report.sections.push(section);
    }
    Ok(Shares { at_s: pictures[3].shares.clone() })
}

const TITLES: [&str; 4] =
    ["Figure 6. Starts at P", "Figure 7. Starts at Q", "Figure 8. Starts at R", "Figure 9. Starts at S"];

fn caption(p: &Picture) -> String {
    format!(
        "Where starts (xi0, u0) at phase 0 lead at {}, 1/beta = {}, delta = {}: {} x {} starts, xi0 from {} to delta, u0 \
         within {}. The cross is the origin. The paper does not state the phase or, in its text, the ranges.",
        p.point.name,
        p.point.inverse_beta,
        p.point.gap,
        p.x.count(),
        p.v.count(),
        p.x.ends().0,
        p.v.ends().1,
    )
}

fn measure(point: Scenario, (x, v): (Span, Span), basin: Basin) -> Picture {
    let osc = point.oscillator();
    let mut shares: BTreeMap<String, f64> = BTreeMap::new();
    for (k, motion) in basin.motions.iter().enumerate() {
        *shares.entry(motion.verdict.label().into_owned()).or_default() += basin.share(k);
    }
    let origin = settle(&osc, Start::at_rest(&osc), &SettleOptions::default());
    let window = (x.ends().1 - x.ends().0) * (v.ends().1 - v.ends().0);
    Picture {
        quiet: window * shares.get("0").copied().unwrap_or(0.0),
        round_origin: window * piece(&basin, (x, v)),
        origin: origin.verdict.label().into_owned(),
        point,
        osc,
        x,
        v,
        basin,
        shares,
    }
}

/// The share of the starts that are connected to the one nearest the origin by starts that lead to the same motion.
#[allow(clippy::cast_precision_loss, clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a small grid
fn piece(basin: &Basin, (x, v): (Span, Span)) -> f64 {
    let (nx, ny) = (x.count() as usize, v.count() as usize);
    let index = |span: Span| {
        let (a, b) = span.ends();
        ((0.0 - a) / (b - a) * f64::from(span.count() - 1)).round() as usize
    };
    let first = index(v) * nx + index(x);
    let label = basin.label(first);
    let mut seen = vec![false; nx * ny];
    let (mut front, mut count) = (vec![first], 0_usize);
    while let Some(k) = front.pop() {
        if std::mem::replace(&mut seen[k], true) || basin.label(k) != label {
            continue;
        }
        count += 1;
        let (i, j) = (k % nx, k / nx);
        front.extend((i > 0).then(|| k - 1));
        front.extend((i + 1 < nx).then(|| k + 1));
        front.extend((j > 0).then(|| k - nx));
        front.extend((j + 1 < ny).then(|| k + nx));
    }
    count as f64 / (nx * ny) as f64
}

fn table(p: &Picture) -> Csv {
    let columns: Vec<String> = std::iter::once("u0".to_owned()).chain(p.x.values().map(|x| x.to_string())).collect();
    let mut csv = Csv::new(
        &format!(
            "Starts at {}, 1/beta = {}, delta = {}, restitution 0.5, phase 0: the motion each leads to; a row for each u0, a column \
             for each xi0",
            p.point.name, p.point.inverse_beta, p.point.gap
        ),
        &columns.join(","),
    );
    let labels: Vec<_> = p.basin.motions.iter().map(|motion| motion.verdict.label()).collect();
    for (row, v) in p.basin.cells.chunks(columns.len() - 1).zip(p.v.values()) {
        let mut cells: Vec<&dyn std::fmt::Display> = vec![&v];
        cells.extend(row.iter().map(|k| &labels[usize::from(*k)] as &dyn std::fmt::Display));
        csv.row(&cells);
    }
    csv
}

fn draw(p: &Picture) -> Result<vibroimpact_plot::Figure, Error> {
    let (x, v) = (p.x, p.v);
    // one class for each motion; all cycles with one label have one colour
    let palette: Vec<Colour> =
        p.basin.motions.iter().map(|motion| class_style(&motion.verdict.label()).colour).collect();
    let raster =
        Raster::centred(x.ends(), v.ends(), (x.count() as usize, v.count() as usize), p.basin.cells.clone(), palette)?;
    let origin = Points::new([0.0], [0.0], Colour::BLACK).shape(Shape::Plus).size(22.0);
    let mut legend = Legend::below();
    for (label, share) in &p.shares {
        // a raster shows fills without hatches, so its legend has none either
        let style = ClassStyle { hatch: None, ..class_style(label) };
        legend = legend.patch(style, format!("{}, {}", legend_text(label), looks::percent(*share)));
    }
    legend = legend.points(&origin, "origin");
    let panel = Panel::new(
        FigureAxis::new("initial displacement *ξ*_0").range(x.ends().0, x.ends().1),
        FigureAxis::new("initial velocity *u*_0").range(v.ends().0, v.ends().1),
    )
    .with(raster)
    .with(origin);
    Ok(looks::column(panel, 620.0).legend(legend))
}

fn told(p: &Picture) -> String {
    let parts: Vec<String> = p
        .shares
        .iter()
        .map(|(label, share)| {
            let label = if label == "0" { "none" } else { label };
            format!("{label} from {}", looks::percent(*share))
        })
        .collect();
    format!("{} of the starts shown", looks::list(&parts, 9))
}

fn only(p: &Picture, labels: &[&str]) -> bool {
    p.shares.keys().all(|label| labels.contains(&label.as_str()))
        && labels.iter().all(|label| p.shares.contains_key(*label))
}

fn disc(p: &Picture) -> f64 {
    p.point.gap - p.osc.free_amplitude()
}

fn at_p(section: &mut Section, p: &Picture) {
    section.claim(
        "6",
        "at P (0.6, 0.75) the starts of one area end in 1/1, the others end without impacts, by the force alone",
        format!(
            "{}; the quiet starts cover an area of {:.3}, of which the disc of radius delta - |f| = {:.4} that never \
             strikes is {:.3}",
            told(p),
            p.quiet,
            disc(p),
            std::f64::consts::PI * disc(p) * disc(p)
        ),
        Agreement::of(only(p, &["0", "1/1"]), p.shares.contains_key("1/1")),
    );
}

fn at_q(section: &mut Section, p: &Picture, quiet: [f64; 2]) {
    section.claim(
        "7",
        "at Q (0.7, 2.5) starts end in 1/1 or without impacts",
        told(p),
        Agreement::of(only(p, &["0", "1/1"]), p.shares.contains_key("1/1")),
    );
    let inside = p.origin == "0";
    section.claim(
        "7",
        "a wide area round the origin ends without impacts, unlike at P, since the gap is larger",
        format!(
            "the origin {}; the area joined to it covers {:.1} in xi0 times u0 of the {:.1} that end so at Q, against {:.2} at \
             P; delta - |f| is {:.2} at Q",
            if inside { "ends without impacts" } else { "ends with impacts" },
            if inside { p.round_origin } else { 0.0 },
            quiet[1],
            quiet[0],
            disc(p)
        ),
        Agreement::of(inside && quiet[1] > 3.0 * quiet[0], quiet[1] > quiet[0]),
    );
}

fn at_r(section: &mut Section, p: &Picture) {
    section.claim(
        "8",
        "at R (1.7, 2.25) starts end in 2/1 or without impacts",
        told(p),
        Agreement::of(only(p, &["0", "2/1"]), p.shares.contains_key("2/1")),
    );
    section.claim(
        "8",
        "the origin xi0 = u0 = 0 is not among the starts that end in 2/1",
        format!(
            "the origin ends in {}; delta - |f| = {:.3}",
            if p.origin == "0" { "no impacts" } else { &p.origin },
            disc(p)
        ),
        Agreement::of(p.origin != "2/1", false),
    );
}

#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // counts of starts
fn at_s(section: &mut Section, p: &Picture) {
    let count = p.basin.cells.len() as f64;
    let others: f64 = p
        .shares
        .iter()
        .filter(|(label, _)| !["1/1", "2/1"].contains(&label.as_str()))
        .map(|(_, share)| share * count)
        .sum();
    let others = others.round() as usize;
    section.claim(
        "9",
        "at S (1.3, 0.75) every start ends in 1/1 or in 2/1, and which of the two is up to the start",
        format!("{}; exceptions among {count}: {others}", told(p)),
        Agreement::of(others == 0 && only(p, &["1/1", "2/1"]), others < 10),
    );
}

//! Figure 4: the plane of 1/beta and delta, the motions found at each point, and the regions of the simple orbits.

mod claims;
mod draw;

pub(crate) use draw::cells;

use crate::claims::Section;
use crate::folder::Csv;
use crate::grid::Grid;
use crate::regions::{Region, Window, outlines, regions};
use crate::search::{self, Part};
use crate::{Error, Run};
use vibroimpact::{Label, scenario};

/// The results of figure 4 in addition to its grid.
#[derive(Clone, Debug)]
pub(crate) struct Plane {
    /// The regions of 1/1 to 3/1, 1/2, and 4/1 to 6/1; for the first four also the regions of existence.
    pub(crate) regions: Vec<Region>,
    pub(crate) lower_left: Part,
    pub(crate) right: Part,
}

impl Plane {
    /// The region of m/n.
    pub(crate) fn region(&self, m: u32, n: u32) -> Option<&Region> {
        self.regions.iter().find(|region| region.label == Label::new(m, n))
    }
}

/// Number of orders followed by theory.
const ORDERS: u32 = 6;
/// Number of labels whose region of existence is followed too.
const DRAWN: usize = 4;
/// The window of the figure: the cells of the grid from edge to edge.
const X: (f64, f64) = (0.375, 2.025);
/// The regions end at the edge of the grid of the paper. 1/beta = 2 itself is excluded: there the free motion has twice
/// the frequency of the force, and without damping the equations of an orbit are singular.
const X_REGIONS: (f64, f64) = (0.375, 1.999);
const GAP: (f64, f64) = (-0.0625, 5.0625);

pub(crate) fn run(run: &mut Run<'_>, grid: &Grid) -> Result<Plane, Error> {
    let orders = (1..=ORDERS).map(|m| Label::new(m, 1));
    // the labels that are drawn come first
    let labels: Vec<Label> = orders.clone().take(3).chain([Label::new(1, 2)]).chain(orders.skip(3)).collect();
    let regions = regions(run, Window { x: X_REGIONS, gap: GAP }, &labels, DRAWN)?;
    let lower_left = search::lower_left(run)?;
    let right = search::right(run)?;
    let plane = Plane { regions, lower_left, right };

    let about = "Figure 4: motions found at each point and the share of starts that lead to them, restitution 0.5";
    run.folder.write("figure-04.csv", search::table(about, &[grid]).bytes())?;
    run.folder.write("figure-04-curves.csv", curves(&plane).bytes())?;
    run.folder.write("figure-04-points.csv", points().bytes())?;
    let about = "Figure 4: motions found with finer steps in two parts of the plane";
    let searched = search::table(about, &[&plane.lower_left.grid, &plane.right.grid]);
    run.folder.write("figure-04-search.csv", searched.bytes())?;
    let svg = run.folder.figure("figure-04", draw::figure(grid, &plane))?;

    let mut section = Section::new(
        "Figure 4. Which motions there are",
        format!(
            "The plane of 1/beta and delta in the paper's steps{}, {} starts at each point, the first at rest, the second \
             on the free motion where it clears the wall, the others spread over positions, velocities and phases. Each cell has the colours of the motions found there. Lines: \
             where theory has a stable, possible motion 1/1, 2/1, 3/1 and 1/2; dotted where it exists but is unstable. These are \
             curves of folds, of period doublings, and of impacts that lose their speed or come to be by a touch. Dashed: |f|, the \
             amplitude without a wall.",
            if run.quick { " doubled (quick run)" } else { " 0.05 and 0.125" },
            grid.starts
        ),
    )
    .svg(
        "figure-04",
        svg,
        &["figure-04-curves.csv", "figure-04-points.csv", "figure-04-search.csv"],
    );
    claims::add(&mut section, grid, &plane);
    run.report.sections.push(section);
    Ok(plane)
}

/// |f| at 1/beta.
fn free_amplitude(inverse_beta: f64) -> f64 {
    let beta = 1.0 / inverse_beta;
    1.0 / ((1.0 - beta) * (1.0 + beta)).abs()
}

fn curves(plane: &Plane) -> Csv {
    let mut csv = Csv::new(
        "Figure 4: what bounds the regions in which an orbit is stable and in which it exists, one line per part, the bound \
         being that of the piece before a point; and the amplitude |f| without a wall",
        "curve,region,part,bound,inverse_beta,delta",
    );
    for region in &plane.regions {
        for (kind, found) in [("stable", Some(&region.stable)), ("exists", region.exists.as_ref())] {
            let lines = found.iter().flat_map(|found| found.polygons.iter().flat_map(outlines));
            for (part, line) in lines.enumerate() {
                for ((x, gap), bound) in line {
                    csv.row(&[&region.label, &kind, &part, &bound.name(), &x, &gap]);
                }
            }
        }
    }
    for (part, line) in draw::amplitude().iter().enumerate() {
        for (x, gap) in line {
            csv.row(&[&"amplitude", &"", &part, &"", x, gap]);
        }
    }
    csv
}

fn points() -> Csv {
    let mut csv = Csv::new("Figure 4: the points the paper discusses", "point,inverse_beta,delta,amplitude,motions");
    for point in scenario::PAPER {
        csv.row(&[
            &point.name,
            &point.inverse_beta,
            &point.gap,
            &free_amplitude(point.inverse_beta),
            &point.motions.join(" "),
        ]);
    }
    csv
}

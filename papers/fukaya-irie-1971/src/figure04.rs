//! Figure 4: the plane of 1/beta and delta, the motions found at each point, and the regions of the simple orbits.

mod claims;
mod draw;

pub(crate) use draw::cells;

use crate::claims::Section;
use crate::contour::Nodes;
use crate::folder::Csv;
use crate::grid::Grid;
use crate::regions::{Region, Seed, regions};
use crate::search::{self, Part};
use crate::{Error, Run};
use vibroimpact::verdict::Verdict;
use vibroimpact::{Label, scenario};

/// What figure 4 found besides its grid.
#[derive(Clone, Debug)]
pub(crate) struct Plane {
    /// 1/1 to 6/1, then 1/2.
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

/// Orders followed by theory.
const ORDERS: u32 = 6;
/// The window of the regions: the cells of the grid from end to end. Its nodes avoid 1/beta = 1/2, 1, 3/2, 2, where one
/// or another closed form is singular on a line without width.
const X: (f64, f64) = (0.375, 2.025);
/// The regions end where the paper's grid does; 1/beta = 2 itself is singular, see above.
const X_REGIONS: (f64, f64) = (0.375, 1.999);
const GAP: (f64, f64) = (-0.0625, 5.0625);

pub(crate) fn run(run: &mut Run<'_>, grid: &Grid) -> Result<Plane, Error> {
    let nodes = Nodes { x: X_REGIONS, y: GAP, nx: run.size(652, 112), ny: run.size(821, 138) };
    let labels: Vec<Label> = (1..=ORDERS).map(|m| Label::new(m, 1)).chain([Label::new(1, 2)]).collect();
    let regions = regions(run, &nodes, &labels, &seeds(grid))?;
    let lower_left = search::lower_left(run)?;
    let right = search::right(run)?;
    let plane = Plane { regions, lower_left, right };

    let mut csv = Csv::new(
        "Figure 4: motions found at each point and the share of starts that lead to them, restitution 0.5",
        "inverse_beta,delta,motion,share_of_starts",
    );
    search::rows(grid, &mut csv);
    run.folder.write("figure-04.csv", csv.bytes())?;
    run.folder.write("figure-04-curves.csv", curves(&plane).bytes())?;
    run.folder.write("figure-04-points.csv", points().bytes())?;
    let searched = search::csv(&[&plane.lower_left, &plane.right]);
    run.folder.write("figure-04-search.csv", searched.bytes())?;
    let svg = run.folder.figure("figure-04", draw::figure(grid, &plane))?;

    let mut section = Section::new(
        "Figure 4. Which motions there are",
        format!(
            "The plane of 1/beta and delta in the paper's steps{}, {} starts at each point, the first at rest, the second \
             on the free motion where it clears the wall, the others spread over positions, velocities and phases. Each cell has the colours of the motions found there. Lines: \
             where theory has a stable, possible motion 1/1, 2/1, 3/1 and 1/2. Dashed: |f|, the amplitude without a wall.",
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

/// The cycles of the grid, to follow over the plane.
fn seeds(grid: &Grid) -> Vec<Seed> {
    let mut seeds = Vec::new();
    for point in &grid.points {
        for found in &point.motions {
            if let Verdict::Periodic(cycle) = &found.verdict
                && let Some(first) = cycle.points.first()
            {
                seeds.push(Seed { label: cycle.label, at: (point.inverse_beta, point.gap), state: first.state });
            }
        }
    }
    seeds
}

/// |f| at 1/beta.
fn free_amplitude(inverse_beta: f64) -> f64 {
    let beta = 1.0 / inverse_beta;
    1.0 / ((1.0 - beta) * (1.0 + beta)).abs()
}

fn curves(plane: &Plane) -> Csv {
    let mut csv = Csv::new(
        "Figure 4: outlines of the regions with a stable orbit, and the amplitude |f| without a wall; one line per part",
        "curve,part,inverse_beta,delta",
    );
    for region in &plane.regions {
        for (part, line) in region.outlines.iter().enumerate() {
            for (x, gap) in line {
                csv.row(&[&region.label, &part, x, gap]);
            }
        }
    }
    for (part, line) in draw::amplitude().iter().enumerate() {
        for (x, gap) in line {
            csv.row(&[&"amplitude", &part, x, gap]);
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

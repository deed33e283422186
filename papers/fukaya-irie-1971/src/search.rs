//! Two parts of figure 4 on finer grids, to search for the super-sub motions that the paper names there.

use crate::folder::Csv;
use crate::grid::{Grid, settle_grid};
use crate::{Error, Run, looks};
use vibroimpact::math::sort_by;
use vibroimpact_study::Span;

/// A part of the plane on a finer grid.
#[derive(Clone, Debug)]
pub(crate) struct Part {
    pub(crate) grid: Grid,
    /// The text of its window.
    pub(crate) window: String,
}

/// Where a label was found on a grid, beginning with the point with the largest share: `5/8 at 7 points, from 100 % of the starts
/// at (0.4, 0.375)`.
pub(crate) fn told(grid: &Grid, label: &str) -> Option<String> {
    let mut at: Vec<_> = grid.with(label).collect();
    sort_by(&mut at, |a, b| b.1.total_cmp(&a.1));
    let (point, share) = at.first()?;
    Some(format!(
        "{label} at {}, from {} of the starts at {}",
        looks::count(at.len(), "point"),
        looks::percent(*share),
        looks::place(point.inverse_beta, point.gap)
    ))
}

/// Small 1/beta and small delta, between the areas of 1/1 and 1/2.
pub(crate) fn lower_left(run: &Run<'_>) -> Result<Part, Error> {
    let x = Span::new(0.4, 0.5, run.size(9, 5))?;
    let gap = Span::new(0.25, 0.8125, run.size(19, 7))?;
    part(run, "figure 4: small 1/beta, small delta", (x, gap, run.size(12, 6)))
}

/// Large 1/beta, above the areas of 2/1 and 3/1.
pub(crate) fn right(run: &Run<'_>) -> Result<Part, Error> {
    let x = Span::new(1.6, 1.85, run.size(11, 6))?;
    let gap = Span::new(1.0, 2.0, run.size(51, 11))?;
    part(run, "figure 4: large 1/beta", (x, gap, run.size(4, 2)))
}

fn part(run: &Run<'_>, stage: &str, (x, gap, starts): (Span, Span, u64)) -> Result<Part, Error> {
    let window = format!(
        "1/beta {} to {}, delta {} to {}, {} x {} points, {starts} starts each",
        x.ends().0,
        x.ends().1,
        gap.ends().0,
        gap.ends().1,
        x.count(),
        gap.count(),
    );
    let grid = settle_grid(run, stage, (x, gap, starts))?;
    Ok(Part { grid, window })
}

/// A table with a row for each point and motion of these grids.
pub(crate) fn table(about: &str, grids: &[&Grid]) -> Csv {
    let mut csv = Csv::new(about, "inverse_beta,delta,motion,share_of_starts");
    for point in grids.iter().flat_map(|grid| &grid.points) {
        for found in &point.motions {
            csv.row(&[&point.inverse_beta, &point.gap, &found.verdict.label(), &point.share(found)]);
        }
    }
    csv
}

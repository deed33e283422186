//! The regions where simple orbits are stable and where they exist, from theory: the polygons of [`region`] along the
//! curves where an orbit folds, flips, loses an impact or gains one.

use crate::{EPS, Error, Run};
use vibroimpact::continuation::{self, Bound, Frame, Polygon, RegionKind, RegionOptions, region};
use vibroimpact::orbit::{FindOptions, find};
use vibroimpact::verdict::Count;
use vibroimpact::{Label, Oscillator, Parameter};
use vibroimpact_study::tiles;

/// The window of the search: ranges of 1/beta and the gap.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Window {
    pub(crate) x: (f64, f64),
    pub(crate) gap: (f64, f64),
}

/// The region of a label.
#[derive(Clone, Debug)]
pub(crate) struct Region {
    pub(crate) label: Label,
    /// The region where it is stable.
    pub(crate) stable: continuation::Region,
    /// The region where it exists, stable or not, if requested.
    pub(crate) exists: Option<continuation::Region>,
    /// Area of the region of stability above gap 0.
    pub(crate) area: f64,
    /// The mean gap over this area, and the lowest and highest gap.
    pub(crate) mean_gap: f64,
    pub(crate) gaps: (f64, f64),
    window: Window,
}

impl Region {
    /// Whether an admissible stable orbit of this label exists at a point. Outside the window it is searched at the
    /// point itself.
    pub(crate) fn holds(&self, inverse_beta: f64, gap: f64) -> bool {
        if inverse_beta <= self.window.x.1 {
            return self.stable.contains((inverse_beta, gap));
        }
        Oscillator::from_inverse_beta(inverse_beta, gap, EPS).is_ok_and(|osc| {
            find(&osc, self.label, FindOptions::default()).iter().any(|orbit| orbit.physical && orbit.cycle.stable())
        })
    }
}

/// The regions of these labels, in the given order; for the first `both` labels also the regions of existence.
pub(crate) fn regions(run: &Run<'_>, window: Window, labels: &[Label], both: usize) -> Result<Vec<Region>, Error> {
    let stable = labels.iter().map(|label| (*label, RegionKind::Stability));
    let jobs: Vec<_> = stable.chain(labels[..both].iter().map(|label| (*label, RegionKind::Existence))).collect();
    run.stage("figure 4: regions from theory", jobs.len() as u64)?;
    let options = RegionOptions { longest: run.size(0.02, 0.05), ..RegionOptions::default() };
    // regions of high orders are narrow in the gap, so they need more rows and fewer seeds
    let (plain, fine) = run.size(((24, 24), (24, 48)), ((12, 12), (12, 24)));
    let of = |label: Label| {
        if label.impacts > Count::Finite(3) {
            RegionOptions { grid: fine, seeds: (16, 8), ..options }
        } else {
            RegionOptions { grid: plain, ..options }
        }
    };
    // 1/beta and the gap vary, so their values here are ignored
    let osc = Oscillator::from_inverse_beta(window.x.0, 0.0, EPS)?;
    let frame = Frame {
        plane: (Parameter::InverseBeta, Parameter::Gap).into(),
        ranges: (window.x.0..=window.x.1, window.gap.0..=window.gap.1),
    };
    let parts = tiles(jobs.len() as u64, 1, run.control, |range, tick| {
        let mut found = Vec::new();
        for k in range {
            #[allow(clippy::cast_possible_truncation)] // a handful
            let (label, kind) = jobs[k as usize];
            found.push(region(&osc, label, kind, &frame, of(label)));
            if tick() {
                break;
            }
        }
        found
    })?;
    let mut found: Vec<_> = parts.into_iter().flatten().collect();
    let mut exists = found.split_off(labels.len()).into_iter();
    Ok(labels.iter().zip(found).map(|(label, stable)| measured(*label, stable, exists.next(), window)).collect())
}

/// The measures of a region: area and mean gap of its part above gap 0, by Green's theorem. Gaps below 0 are replaced
/// by 0, which contributes no area.
fn measured(
    label: Label,
    stable: continuation::Region,
    exists: Option<continuation::Region>,
    window: Window,
) -> Region {
    let (mut area, mut moment) = (0.0, 0.0);
    let mut gaps = (f64::INFINITY, f64::NEG_INFINITY);
    for polygon in &stable.polygons {
        let raised: Vec<(f64, f64)> = polygon.vertices.iter().map(|v| (v.values.0, v.values.1.max(0.0))).collect();
        for (k, (x, gap)) in raised.iter().enumerate() {
            let (u, next) = raised[(k + 1) % raised.len()];
            area += 0.5 * (x * next - u * gap);
            moment += (x * next - u * gap) * (gap + next) / 6.0;
            gaps = (gaps.0.min(*gap), gaps.1.max(*gap));
        }
    }
    let whole = (window.x.1 - window.x.0) * window.gap.1;
    Region { label, stable, exists, area: area / whole, mean_gap: moment / area, gaps, window }
}

/// The parts of the boundary of a polygon that are not on the frame, each with its kinds of boundary.
pub(crate) fn outlines(polygon: &Polygon) -> Vec<Vec<((f64, f64), Bound)>> {
    let vertices = &polygon.vertices;
    let m = vertices.len();
    // begin where the boundary leaves the frame, so that no line is divided
    let begin = (0..m).find(|&k| vertices[k].bound != Bound::Frame && vertices[(k + m - 1) % m].bound == Bound::Frame);
    let mut lines: Vec<Vec<((f64, f64), Bound)>> = Vec::new();
    let mut open = false;
    for k in 0..m {
        let (here, next) = (vertices[(begin.unwrap_or(0) + k) % m], vertices[(begin.unwrap_or(0) + k + 1) % m]);
        if here.bound == Bound::Frame {
            open = false;
            continue;
        }
        if !open {
            lines.push(vec![(here.values, here.bound)]);
            open = true;
        }
        if let Some(line) = lines.last_mut() {
            line.push((next.values, here.bound));
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use vibroimpact::continuation::Vertex;

    fn square(bounds: [Bound; 4]) -> Polygon {
        let corners = [(0.5, -1.0), (1.5, -1.0), (1.5, 1.0), (0.5, 1.0)];
        let vertices = corners.into_iter().zip(bounds).map(|(values, bound)| Vertex { values, bound }).collect();
        Polygon { vertices, hole: false, below: true }
    }

    #[test]
    fn what_lies_below_zero_does_not_count() {
        let polygon = square([Bound::Fold; 4]);
        let stable = continuation::Region { polygons: vec![polygon], unresolved: Vec::new() };
        let window = Window { x: (0.0, 2.0), gap: (-1.0, 5.0) };
        let region = measured(Label::new(1, 1), stable, None, window);
        assert!((region.area - 0.1).abs() < 1e-15 && (region.mean_gap - 0.5).abs() < 1e-15, "{region:?}");
        assert_eq!(region.gaps, (0.0, 1.0));
        assert!(region.holds(1.0, -0.5) && !region.holds(0.4, 0.5));
    }

    #[test]
    fn the_frame_is_no_outline() {
        let lines = outlines(&square([Bound::Fold, Bound::Frame, Bound::Flip, Bound::Touch]));
        assert_eq!(lines.len(), 1);
        let corners: Vec<(f64, f64)> = lines[0].iter().map(|(at, _)| *at).collect();
        assert_eq!(corners, [(1.5, 1.0), (0.5, 1.0), (0.5, -1.0), (1.5, -1.0)]);
        let closed = outlines(&square([Bound::Fold; 4]));
        assert_eq!((closed.len(), closed[0].len()), (1, 5));
        assert_eq!(outlines(&square([Bound::Frame; 4])).len(), 0);
    }
}

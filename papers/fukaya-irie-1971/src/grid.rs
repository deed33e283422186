//! The plane of 1/beta and delta on the grid of the paper, with several starts at each point: our verdict on each
//! start, and that of the rule of the paper.

use crate::{EPS, Error, Run};
use vibroimpact::Oscillator;
use vibroimpact::verdict::{
    Census, CountedMotion, PaperRule, PaperVerdict, SettleOptions, StartBox, Verdict, paper_rule, scattered_starts,
    settle,
};
use vibroimpact_study::{Span, tiles};

/// Seed of the scattered starts; its value is arbitrary.
const SEED: u64 = 1971;

/// A point of the plane.
#[derive(Clone, Debug)]
pub(crate) struct Point {
    pub(crate) inverse_beta: f64,
    pub(crate) gap: f64,
    /// Amplitude |f| of the motion without impacts.
    pub(crate) free: f64,
    /// The distinct motions, the most frequent first.
    pub(crate) motions: Vec<CountedMotion>,
    /// For each start, our label and the verdict of the rule of the paper.
    pub(crate) starts: Vec<(String, PaperVerdict)>,
}

impl Point {
    /// Whether there are motions with impacts, and motions without, as (with, without).
    pub(crate) fn kinds(&self) -> (bool, bool) {
        let none = |found: &CountedMotion| matches!(found.verdict, Verdict::NoImpact(_));
        (self.motions.iter().any(|found| !none(found)), self.motions.iter().any(none))
    }

    /// The share of starts that lead to this motion.
    #[allow(clippy::cast_precision_loss)] // a few dozen
    pub(crate) fn share(&self, found: &CountedMotion) -> f64 {
        found.count as f64 / self.starts.len() as f64
    }
}

/// The points, in rows of rising gap.
#[derive(Clone, Debug)]
pub(crate) struct Grid {
    pub(crate) x: Span,
    pub(crate) gap: Span,
    pub(crate) starts: u64,
    pub(crate) points: Vec<Point>,
}

impl Grid {
    /// The points that have a motion with this label, each with the share of starts that lead to it.
    pub(crate) fn with<'a>(&'a self, label: &'a str) -> impl Iterator<Item = (&'a Point, f64)> {
        self.points.iter().filter_map(move |point| {
            let share: f64 = point
                .motions
                .iter()
                .filter(|found| found.verdict.label() == label)
                .map(|found| point.share(found))
                .sum();
            (share > 0.0).then_some((point, share))
        })
    }

    /// All labels with their numbers of points, in order of first appearance.
    pub(crate) fn labels(&self) -> Vec<(String, usize)> {
        let mut list: Vec<(String, usize)> = Vec::new();
        for point in &self.points {
            let mut here: Vec<_> = point.motions.iter().map(|found| found.verdict.label()).collect();
            here.sort();
            here.dedup();
            for label in here {
                match list.iter_mut().find(|(known, _)| *known == label) {
                    Some((_, count)) => *count += 1,
                    None => list.push((label.into_owned(), 1)),
                }
            }
        }
        list
    }
}

/// Settles `starts` starts at each point of a grid. The first is at rest; the second is on the motion without impacts,
/// if that clears the stop.
pub(crate) fn settle_grid(run: &Run<'_>, stage: &str, (x, gap, starts): (Span, Span, u64)) -> Result<Grid, Error> {
    let columns = u64::from(x.count());
    let total = columns * u64::from(gap.count());
    run.stage(stage, total)?;
    let parts = tiles(total, 2, run.control, |range, tick| {
        let mut points = Vec::new();
        for k in range {
            #[allow(clippy::cast_possible_truncation)] // indices of a small grid
            let at = (x.at((k % columns) as u32), gap.at((k / columns) as u32));
            points.push(point(at, starts));
            if tick() {
                break;
            }
        }
        points
    })?;
    let points = parts.into_iter().flatten().collect::<Result<Vec<_>, _>>()?;
    Ok(Grid { x, gap, starts, points })
}

/// The grid of figure 4, with steps 0.05 and 0.125.
pub(crate) fn settle_all(run: &Run<'_>) -> Result<Grid, Error> {
    let x = Span::new(0.4, 2.0, run.size(33, 17))?;
    let gap = Span::new(0.0, 5.0, run.size(41, 21))?;
    settle_grid(run, "figure 4: the plane", (x, gap, run.size(12, 4)))
}

fn point((x, gap): (f64, f64), starts: u64) -> Result<Point, Error> {
    // 0.4 + 0.05 k as a decimal number, without rounding errors: 1/beta = 1.2 is a fraction, 1.2000000000000002 is none
    let x = (x * 1e6).round() / 1e6;
    let osc = Oscillator::from_inverse_beta(x, gap, EPS)?;
    let area = StartBox::natural(&osc);
    let options = SettleOptions::default();
    let (mut census, mut list) = (Census::default(), Vec::new());
    for index in 0..starts {
        let start = scattered_starts(&osc, area, SEED, index);
        let verdict = settle(&osc, start, &options).verdict;
        census.add(&verdict);
        list.push((verdict.label().into_owned(), paper_rule(&osc, start, PaperRule::default())));
    }
    Ok(Point {
        inverse_beta: x,
        gap,
        free: osc.free_amplitude(),
        motions: census.by_share().into_iter().cloned().collect(),
        starts: list,
    })
}

//! The impacts of a branch as curves: each impact is followed from point to point, and a curve changes its look where its
//! stability does.

use std::collections::BTreeMap;
use vibroimpact::continuation::Point;
use vibroimpact::system::phase;

/// How a piece of a branch is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Look {
    Stable,
    Unstable,
    /// A solution that is no motion.
    Virtual,
}

/// Curves of one label and look: abscissae and ordinates, broken by `NaN`.
pub(crate) type Curves = BTreeMap<(String, Look), (Vec<f64>, Vec<f64>)>;

/// The arrival velocities of all impacts over the parameter, in nondimensional units.
pub(crate) fn velocities(points: &[Point]) -> Curves {
    let mut curves = Curves::new();
    let mut rest = points;
    while let Some(first) = rest.first() {
        let label = first.cycle.label;
        let end = rest.iter().position(|point| point.cycle.label != label).unwrap_or(rest.len());
        let (run, others) = rest.split_at(end);
        for track in tracks(run) {
            add(&mut curves, &label.to_string(), run, &track);
        }
        rest = others;
    }
    curves
}

/// The velocity of each impact at all points of a run with one label.
fn tracks(run: &[Point]) -> Vec<Vec<f64>> {
    let m = run.first().map_or(0, |point| point.cycle.points.len());
    let mut tracks = vec![Vec::with_capacity(run.len()); m];
    let mut before: Option<Vec<(f64, f64)>> = None;
    for point in run {
        let mut here: Vec<(f64, f64)> = point.cycle.points.iter().map(|p| (p.state.phase, p.state.velocity)).collect();
        // the list begins with the fastest impact, which may have become another one
        let off = |shift: &usize| -> f64 {
            let before = before.iter().flatten();
            before
                .zip(here.iter().cycle().skip(*shift))
                .map(|(a, b)| phase::difference(a.0, b.0).powi(2) + (a.1 - b.1).powi(2))
                .sum()
        };
        let shift = (0..here.len()).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(0);
        here.rotate_left(shift);
        for (track, impact) in tracks.iter_mut().zip(&here) {
            track.push(impact.1);
        }
        before = Some(here);
    }
    tracks
}

/// Cuts a track where its look changes; neighbours share the point between them.
fn add(curves: &mut Curves, label: &str, run: &[Point], track: &[f64]) {
    let mut last = None;
    for (k, pair) in run.windows(2).enumerate() {
        let look = between(&pair[0], &pair[1]);
        let (xs, ys) = curves.entry((label.to_owned(), look)).or_default();
        if last != Some(look) {
            xs.extend([f64::NAN, pair[0].value]);
            ys.extend([f64::NAN, track[k]]);
        }
        xs.push(pair[1].value);
        ys.push(track[k + 1]);
        last = Some(look);
    }
}

/// How the piece between two points looks. An event lies on the edge of two looks and counts for neither.
fn between(a: &Point, b: &Point) -> Look {
    let point = if b.event.is_some() && a.event.is_none() { a } else { b };
    match (point.physical, point.cycle.stable()) {
        (false, _) => Look::Virtual,
        (true, true) => Look::Stable,
        (true, false) => Look::Unstable,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use vibroimpact::continuation::{Branch, BranchOptions, Direction};
    use vibroimpact::orbit::{FindOptions, find};
    use vibroimpact::{Label, Oscillator, Parameter};

    /// Of 2/1 the faster impact is another one after a while: the curves cross and do not jump.
    #[test]
    fn curves_are_continuous_and_change_their_look_at_a_flip() {
        for (inverse, gap, to, label) in [(1.11, 1.5, 2.5, (1, 1)), (1.3, 0.75, 1.2, (2, 1))] {
            let osc = Oscillator::from_inverse_beta(inverse, gap, 0.5).unwrap();
            let orbits = find(&osc, Label::new(label.0, label.1), FindOptions::default());
            let orbit = orbits.into_iter().rev().find(|o| o.physical).unwrap();
            let (range, options) = (gap..=to, BranchOptions::default());
            let branch = Branch::new(&osc, &orbit.cycle, Parameter::Gap, range, Direction::Up, options).unwrap();
            let points: Vec<Point> = branch.collect();
            let curves = velocities(&points);
            for (xs, ys) in curves.values() {
                for pair in xs.iter().zip(ys).collect::<Vec<_>>().windows(2) {
                    let step = (pair[1].1 - pair[0].1).abs();
                    assert!(step.is_nan() || step < 0.1, "{step} at {}", pair[0].0);
                }
            }
            if label == (1, 1) {
                let looks: Vec<Look> = curves.keys().map(|(_, look)| *look).collect();
                assert_eq!(looks, [Look::Stable, Look::Unstable]);
                let end = curves[&("1/1".to_owned(), Look::Stable)].0.last().copied().unwrap();
                assert!((end - 1.829_006).abs() < 1e-5);
            }
        }
    }
}

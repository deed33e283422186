//! The events of 2/1, 1/3 and 1/4 on the line 1/beta = 1.11, eps = 1/2, without damping: on either side of each, what
//! should be there is flown from its first impact and comes back, and what should not does not.

use vibroimpact::continuation::{Branch, BranchEvent, BranchOptions, Direction, SolutionPoint};
use vibroimpact::motion::{Mapped, derivative, impact_map};
use vibroimpact::orbit::{Cycle, FindOptions, find, refine};
use vibroimpact::{Label, Oscillator, Parameter};

fn at(gap: f64) -> Oscillator {
    Oscillator::from_inverse_beta(1.11, gap, 0.5).unwrap()
}

/// The impacts flown from the first one of the cycle at this gap: whether they come back as the equations say, and the
/// trace of the derivatives of the flights flown.
fn flown(near: &Cycle, gap: f64) -> Option<f64> {
    let osc = at(gap);
    let cycle = refine(&osc, near)?.cycle;
    let first = cycle.points[0].state;
    let (mut state, mut time) = (first, 0.0);
    let mut turn = vibroimpact::math::Matrix2::IDENTITY;
    for _ in 0..cycle.points.len() {
        let Mapped::Impact { state: next, interval } = impact_map(&osc, &state, Default::default()) else {
            return None;
        };
        turn = derivative(&osc, &state, &next, interval).times(turn);
        (state, time) = (next, time + interval);
    }
    let off = (time / osc.period() - f64::from(cycle.label.periods)).abs().max((state.velocity - first.velocity).abs());
    (off < 1e-7).then(|| turn.trace())
}

/// Ordinary points on either side of point `k` of a branch: nearest ones of a few steps' distance.
fn beside(points: &[SolutionPoint], k: usize) -> Option<(&SolutionPoint, &SolutionPoint)> {
    let before = points[..k].iter().rev().find(|p| p.event.is_none() && (p.value - points[k].value).abs() > 1e-9)?;
    let after = points[k..].iter().find(|p| p.event.is_none() && (p.value - points[k].value).abs() > 1e-9)?;
    Some((before, after))
}

/// Checks every event of a branch of cycles that do not stick; counts of grazing events, folds and flips.
fn check(points: &[SolutionPoint]) -> [u32; 3] {
    let sticks = |point: &SolutionPoint| matches!(point.event, Some(BranchEvent::Sticking { .. }));
    let points = &points[..points.iter().position(sticks).unwrap_or(points.len())];
    let mut counts = [0; 3];
    let h = 1e-6;
    for (k, point) in points.iter().enumerate() {
        let Some(event) = point.event else { continue };
        let Some((before, after)) = beside(points, k) else { continue };
        let gap = point.value;
        let side = |p: &SolutionPoint| (p.value - gap).signum();
        let what = format!("{event:?} of {} at {gap}", point.cycle.label);
        match event {
            BranchEvent::Grazing { turns, .. } => {
                assert_eq!(turns, side(before) == side(after), "{what}");
                for p in [before, after] {
                    assert!(flown(&p.cycle, gap + side(p) * h).is_some(), "{what}: {} is missing", p.cycle.label);
                    let beyond = flown(&p.cycle, gap - side(p) * h);
                    assert!(beyond.is_none(), "{what}: {} is there still", p.cycle.label);
                }
                counts[0] += 1;
            }
            BranchEvent::Fold => {
                assert_eq!(side(before), side(after), "{what}");
                let traces = [before, after].map(|p| flown(&p.cycle, gap + side(p) * h).unwrap());
                let det = 0.25_f64.powi(i32::try_from(point.cycle.points.len()).unwrap());
                // a multiplier above +1 on one of them
                assert!((traces[0] - 1.0 - det) * (traces[1] - 1.0 - det) < 0.0, "{what}: {traces:?}");
                for p in [before, after] {
                    assert!(refine(&at(gap - side(p) * h), &point.cycle).is_none_or(|o| !o.physical), "{what}");
                }
                counts[1] += 1;
            }
            BranchEvent::Flip => {
                let traces = [before, after].map(|p| flown(&p.cycle, gap + side(p) * h).unwrap());
                let det = 0.25_f64.powi(i32::try_from(point.cycle.points.len()).unwrap());
                assert!((traces[0] + 1.0 + det) * (traces[1] + 1.0 + det) < 0.0, "{what}: {traces:?}");
                counts[2] += 1;
            }
            _ => {}
        }
    }
    counts
}

/// The branches both ways of the motions called `label` at this gap.
fn total(label: Label, gap: f64, range: std::ops::RangeInclusive<f64>) -> [u32; 3] {
    let osc = at(gap);
    let mut sum = [0; 3];
    for orbit in find(&osc, label, FindOptions::default()).iter().filter(|o| o.physical) {
        for direction in [Direction::Up, Direction::Down] {
            let options = BranchOptions { impacts: 4, ..Default::default() };
            let branch = Branch::new(&osc, &orbit.cycle, Parameter::Gap, range.clone(), direction, options).unwrap();
            let counts = check(&branch.collect::<Vec<SolutionPoint>>());
            (0..3).for_each(|i| sum[i] += counts[i]);
        }
    }
    sum
}

#[test]
fn two_impacts_a_period_at_negative_gaps() {
    let [grazing, folds, flips] = total(Label::new(2, 1), -0.05, -0.6..=1.0);
    assert!(grazing >= 2 && folds + flips >= 1, "{grazing} {folds} {flips}");
}

#[test]
fn one_impact_in_three_and_in_four_periods() {
    let [grazing, folds, flips] = total(Label::new(1, 3), 4.0, 2.0..=6.0);
    assert!(grazing >= 1 && folds + flips >= 1, "{grazing} {folds} {flips}");
    let [grazing, folds, flips] = total(Label::new(1, 4), 4.8, 3.0..=6.0);
    assert!(grazing >= 1 && folds + flips >= 1, "{grazing} {folds} {flips}");
}

/// Item 11: a fold and a flip 3e-6 apart lie on one step, and nothing between them said whether the cycle is stable.
#[test]
fn f11_between_two_events_of_one_step_there_is_a_point() {
    let osc = Oscillator::new(2.55, 0.0, 0.8).unwrap();
    let one = find(&osc, Label::new(1, 1), FindOptions::default()).pop().unwrap();
    let over = |branch: Branch| branch.collect::<Vec<SolutionPoint>>();
    let flip = |points: &[SolutionPoint]| points.iter().find(|p| p.event == Some(BranchEvent::Flip)).cloned().unwrap();
    let options = BranchOptions::default();
    let first = Branch::new(&osc, &one.cycle, Parameter::Beta, 2.55..=3.0, Direction::Up, options).unwrap();
    let mut points = over(first);
    for _ in 0..2 {
        points = over(Branch::from_flip(&osc, &flip(&points), Parameter::Beta, 2.55..=3.0, options).unwrap());
    }
    let events: Vec<usize> = (0..points.len()).filter(|&k| points[k].event.is_some()).collect();
    let fold = *events.iter().find(|&&k| points[k].event == Some(BranchEvent::Fold)).unwrap();
    let next = *events.iter().find(|&&k| k > fold).unwrap();
    assert_eq!(points[next].event, Some(BranchEvent::Flip));
    assert!((points[next].value - points[fold].value).abs() < 4e-6);
    assert!(next > fold + 1 && (fold + 1..next).all(|k| points[k].stable() && points[k].event.is_none()));
    assert!(!points[fold - 1].stable() && !points[next + 1].stable());
}

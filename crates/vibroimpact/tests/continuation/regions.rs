//! Regions against simulation: from a start on the orbit, at points inside and outside and close to the edges.

use crate::Random;
use core::ops::RangeInclusive;
use vibroimpact::continuation::{Bound, Frame, Region, RegionKind, RegionOptions, region};
use vibroimpact::math::Matrix2;
use vibroimpact::motion::{ImpactState, Mapped, derivative, impact_map};
use vibroimpact::orbit::{FindOptions, find};
use vibroimpact::{Label, Oscillator, Parameter};

type Range = RangeInclusive<f64>;

fn is_long() -> bool {
    std::env::var("VIBROIMPACT_LONG").is_ok_and(|value| value == "1")
}

/// What simulation says about the orbits of that label here: whether one exists, and whether one is stable. Each solution
/// is flown for a period from its first impact; it has to come back, and the derivative of the flights flown says
/// whether a neighbour comes nearer.
fn simulated(osc: &Oscillator, label: Label, seeds: (u32, u32)) -> (bool, bool) {
    let (mut exists, mut stable) = (false, false);
    for orbit in find(osc, label, FindOptions { seeds, ..Default::default() }) {
        let first = orbit.cycle.points[0].state;
        let (mut state, mut turn, mut time): (ImpactState, _, _) = (first, Matrix2::IDENTITY, 0.0);
        for _ in 0..orbit.cycle.points.len() {
            let Mapped::Impact { state: next, interval } = impact_map(osc, &state, Default::default()) else { break };
            turn = derivative(osc, &state, &next, interval).times(turn);
            (state, time) = (next, time + interval);
        }
        // a gentle impact is unstable and misses by what it amplifies
        let off = (time / osc.period() - f64::from(label.periods)).abs().max((state.velocity - first.velocity).abs());
        let flown = off < 1e-6 && state.side == first.side;
        assert_eq!(flown, orbit.physical, "{osc:?} {orbit:?} {off:e}");
        exists |= flown;
        stable |= flown && turn.trace().abs() < 1.0 + turn.determinant();
    }
    (exists, stable)
}

struct Case {
    osc: Oscillator,
    label: Label,
    frame: Frame,
}

impl Case {
    fn at(&self, (p, q): (f64, f64)) -> Oscillator {
        let (first, second) = self.frame.plane.parameters().unwrap();
        second.set(&first.set(&self.osc, p).unwrap(), q).unwrap()
    }

    fn assert(&self, region: &Region, kind: RegionKind, at: (f64, f64)) -> bool {
        let look = |seeds: (u32, u32)| {
            let (exists, stable) = simulated(&self.at(at), self.label, seeds);
            if kind == RegionKind::Existence { exists } else { stable }
        };
        // where one is said to be that was not found, it is looked for harder
        let expected = look((32, 16)) || (region.contains(at) && look((256, 128)));
        assert_eq!(region.contains(at), expected, "{} {kind:?} at {at:?}", self.label);
        expected
    }

    /// Random points of the frame, and points beside the middle of random edges; a quarter of them, or with
    /// `VIBROIMPACT_LONG=1` all.
    fn check(&self, kind: RegionKind, count: u32) {
        let count = if is_long() { count } else { count / 4 };
        self.check_beside(&self.check_at(kind, count), kind, count);
    }

    /// Random points of the frame.
    fn check_at(&self, kind: RegionKind, count: u32) -> Region {
        let region = region(&self.osc, self.label, kind, &self.frame, RegionOptions::default());
        assert!(region.unresolved.is_empty(), "{:?}", region.unresolved);
        self.check_in(&region, kind, &self.frame.ranges, count);
        region
    }

    /// Random points of a part of the frame.
    fn check_in(&self, region: &Region, kind: RegionKind, (p, q): &(Range, Range), count: u32) {
        let mut numbers = Random(7);
        let mut inside = 0;
        for _ in 0..count {
            let at = (numbers.between(*p.start(), *p.end()), numbers.between(*q.start(), *q.end()));
            inside += u32::from(self.assert(region, kind, at));
        }
        assert!(inside > count / 50 && inside < count, "{inside}");
    }

    fn check_beside(&self, region: &Region, kind: RegionKind, count: u32) {
        let mut numbers = Random(11);
        let (p, q) = (self.frame.ranges.0.clone(), self.frame.ranges.1.clone());
        let (width, height) = (p.end() - p.start(), q.end() - q.start());
        let mut beside = 0;
        for polygon in &region.polygons {
            for _ in 0..count {
                let k = numbers.below(polygon.vertices.len());
                let (a, b) = (&polygon.vertices[k], &polygon.vertices[(k + 1) % polygon.vertices.len()]);
                let ((x, y), (u, v)) = (a.values, b.values);
                // a thousandth of the frame to either side
                let (dx, dy) = ((u - x) / width, (v - y) / height);
                let length = dx.hypot(dy);
                let off = 1e-3 * numbers.between(-1.0, 1.0).signum();
                let at = (0.5 * (x + u) - off * width * dy / length, 0.5 * (y + v) + off * height * dx / length);
                if p.contains(&at.0) && q.contains(&at.1) && length > 0.0 && a.bound != Bound::Frame {
                    self.assert(region, kind, at);
                    beside += 1;
                }
            }
        }
        assert!(beside > count / 2, "{beside}");
    }
}

/// The plane of the 1971 paper's figure 4.
fn paper(label: Label) -> Case {
    let osc = Oscillator::from_inverse_beta(1.11, 1.0, 0.5).unwrap();
    let frame = Frame { plane: (Parameter::InverseBeta, Parameter::Gap).into(), ranges: (0.4..=2.0, -1.0..=5.0) };
    Case { osc, label, frame }
}

#[test]
fn one_impact_a_period_in_the_papers_plane() {
    paper(Label::new(1, 1)).check(RegionKind::Existence, 200);
    paper(Label::new(1, 1)).check(RegionKind::Stability, 200);
}

#[test]
fn two_impacts_a_period_in_the_papers_plane() {
    paper(Label::new(2, 1)).check(RegionKind::Existence, 60);
    paper(Label::new(2, 1)).check(RegionKind::Stability, 60);
}

#[test]
fn one_impact_in_two_periods() {
    let osc = Oscillator::from_inverse_beta(1.11, 1.0, 0.5).unwrap();
    let frame = Frame { plane: (Parameter::InverseBeta, Parameter::Gap).into(), ranges: (0.9..=1.3, 1.0..=5.0) };
    Case { osc, label: Label::new(1, 2), frame: frame.clone() }.check(RegionKind::Existence, 60);
    Case { osc, label: Label::new(1, 2), frame }.check(RegionKind::Stability, 60);
}

#[test]
fn two_impacts_with_damping_and_on_two_stops() {
    let osc = Oscillator::from_inverse_beta(1.3, 0.3, 0.6).unwrap().with_damping(0.04).unwrap();
    let frame = Frame { plane: (Parameter::InverseBeta, Parameter::Gap).into(), ranges: (0.8..=1.6, -0.5..=0.8) };
    Case { osc, label: Label::new(2, 1), frame }.check(RegionKind::Existence, 60);
    let two = Oscillator::new(0.7, 0.6, 0.7).unwrap().with_damping(0.1).unwrap().with_second_stop(0.8, 0.6).unwrap();
    let frame = Frame { plane: (Parameter::Beta, Parameter::Gap).into(), ranges: (0.5..=1.2, 0.1..=2.0) };
    Case { osc: two, label: Label::new(2, 1), frame }.check(RegionKind::Existence, 60);
}

#[test]
fn with_damping_and_in_other_planes() {
    let osc = Oscillator::from_inverse_beta(1.3, 0.75, 0.5).unwrap().with_damping(0.03).unwrap();
    let label = Label::new(1, 1);
    let frame = Frame { plane: (Parameter::InverseBeta, Parameter::Gap).into(), ranges: (0.4..=2.0, -1.0..=5.0) };
    Case { osc, label, frame }.check(RegionKind::Stability, 60);
    let frame = Frame { plane: (Parameter::InverseBeta, Parameter::Damping).into(), ranges: (0.4..=2.0, 0.0..=0.3) };
    Case { osc, label, frame }.check(RegionKind::Existence, 60);
    let frame = Frame { plane: (Parameter::Gap, Parameter::Restitution).into(), ranges: (-0.8..=3.0, 0.05..=0.95) };
    Case { osc, label: Label::new(2, 1), frame }.check(RegionKind::Stability, 60);
}

/// Near resonance speeds go up to some 300, and a walk has to get along there; with restitution 1 and no damping nothing is stable.
#[test]
fn nearly_elastic() {
    let of = |restitution, label| Case {
        osc: Oscillator::from_inverse_beta(1.11, 1.0, restitution).unwrap(),
        ..paper(label)
    };
    for n in [1, 2] {
        of(0.99, Label::new(1, n)).check_at(RegionKind::Stability, 300);
    }
    let case = of(1.0, Label::new(1, 1));
    let none = region(&case.osc, case.label, RegionKind::Stability, &case.frame, RegionOptions::default());
    assert_eq!(none, Region { polygons: Vec::new(), unresolved: Vec::new() });
}

/// Where an orbit merges with one of half its period, or loses its symmetry between two stops alike, its equations are
/// singular.
#[test]
fn orbits_that_merge_with_others() {
    let osc = Oscillator::from_inverse_beta(1.11, 1.0, 0.5).unwrap();
    let frame = Frame { plane: (Parameter::InverseBeta, Parameter::Gap).into(), ranges: (0.9..=1.3, 1.0..=4.0) };
    Case { osc, label: Label::new(2, 2), frame: frame.clone() }.check(RegionKind::Existence, 60);
    Case { osc, label: Label::new(2, 2), frame }.check(RegionKind::Stability, 60);
    let two = Oscillator::new(1.3, 0.4, 0.8).unwrap().with_damping(0.05).unwrap().with_second_stop(0.4, 0.8).unwrap();
    let frame = Frame { plane: (Parameter::Beta, Parameter::Gap).into(), ranges: (0.5..=2.0, 0.1..=2.0) };
    Case { osc: two, label: Label::new(2, 1), frame }.check(RegionKind::Existence, 60);
}

/// At 1/beta = 2 two natural periods go into one of the force: above some gap 2/1 loses its speed there on either side, and
/// where its folds meet that line the equations are singular.
#[test]
fn across_a_frequency_of_whole_natural_periods() {
    let osc = Oscillator::from_inverse_beta(1.11, 1.0, 0.5).unwrap();
    let over = |p, q| Frame { plane: (Parameter::InverseBeta, Parameter::Gap).into(), ranges: (p, q) };
    let label = Label::new(2, 1);
    Case { osc, label, frame: over(0.4..=2.4, -1.0..=5.0) }.check(RegionKind::Stability, 60);
    // the region of existence has fewer edges, so the other one says more
    for kind in [RegionKind::Stability, RegionKind::Existence].into_iter().take(if is_long() { 2 } else { 1 }) {
        Case { osc, label, frame: over(1.8..=2.3, 0.5..=1.2) }.check(kind, 60);
    }
}

/// Corners at which more vanishes than two bounds, and orbits that few seeds lead to: no point of the grid is left over. 2/4
/// with `VIBROIMPACT_LONG=1`.
#[test]
fn two_and_three_impacts_in_several_periods_in_the_papers_plane() {
    for (m, n) in [(3, 2), (2, 2), (2, 4)].into_iter().take(if is_long() { 3 } else { 2 }) {
        let case = paper(Label::new(m, n));
        let [existence, _] = [RegionKind::Existence, RegionKind::Stability].map(|kind| {
            let region = region(&case.osc, case.label, kind, &case.frame, RegionOptions::default());
            assert!(region.unresolved.is_empty() && !region.polygons.is_empty(), "{m}/{n}: {:?}", region.unresolved);
            region
        });
        // towards 1/beta = 1/2 and 2 speeds vanish, and the search that is compared with finds few of the orbits
        case.check_in(&existence, RegionKind::Existence, &(0.55..=1.9, -1.0..=5.0), 100);
    }
}

/// A little inside a fold there are two orbits, on a sheet each, however thin the other one is.
#[test]
fn both_sheets_at_a_fold() {
    let mut thin = 0;
    for label in [Label::new(3, 1), Label::new(2, 1), Label::new(4, 1)] {
        let case = paper(label);
        let found = region(&case.osc, label, RegionKind::Existence, &case.frame, RegionOptions::default());
        let sheets = |at: (f64, f64)| {
            let one = |below: bool| Region {
                polygons: found.polygons.iter().filter(|p| p.below == below).cloned().collect(),
                unresolved: Vec::new(),
            };
            u32::from(one(true).contains(at)) + u32::from(one(false).contains(at))
        };
        for polygon in found.polygons.iter().filter(|p| p.below) {
            let count = polygon.vertices.len();
            for k in (0..count).step_by(40).filter(|&k| polygon.vertices[k].bound == Bound::Fold) {
                let ((x, y), (u, v)) = (polygon.vertices[k].values, polygon.vertices[(k + 1) % count].values);
                let (dx, dy) = ((u - x) / 1.6, (v - y) / 6.0);
                let length = dx.hypot(dy);
                // inside is to the left
                let off = 3e-4;
                let at = (0.5 * (x + u) - off * 1.6 * dy / length, 0.5 * (y + v) + off * 6.0 * dx / length);
                let orbits = find(&case.at(at), label, FindOptions { seeds: (128, 64), ..Default::default() });
                let orbits = orbits.iter().filter(|o| o.physical).count();
                assert_eq!(sheets(at) as usize, orbits, "{label} at {at:?}");
                thin += u32::from(orbits == 2);
            }
        }
    }
    assert!(thin > 10, "{thin}");
}

/// Item 12: a frame of restitutions up to 1e-12. No walk ever met its edges, which were closer than what counts as zero: 46 s, and
/// nothing found.
#[test]
fn f12_a_frame_smaller_than_what_counts_as_zero() {
    let osc = Oscillator::from_inverse_beta(0.836_654_282_595_934_9, 1e-9, 0.0).unwrap();
    let frame = Frame { plane: (Parameter::Gap, Parameter::Restitution).into(), ranges: (1e-9..=1.0, 0.0..=1e-12) };
    let case = Case { osc, label: Label::new(1, 1), frame };
    for kind in [RegionKind::Existence, RegionKind::Stability] {
        let options = RegionOptions { grid: (8, 8), ..RegionOptions::default() };
        let region = region(&case.osc, case.label, kind, &case.frame, options);
        assert_eq!((region.polygons.len(), region.unresolved.len()), (1, 0));
        let mut numbers = Random(12);
        let (mut inside, mut outside) = (0, 0);
        for _ in 0..60 {
            let at = (numbers.between(1e-9, 1.0), numbers.between(0.0, 1e-12));
            *(if case.assert(&region, kind, at) { &mut inside } else { &mut outside }) += 1;
        }
        assert!(inside > 5 && outside > 5, "{inside} {outside}");
    }
}

/// The family of item 6: with restitution 0 an orbit 1/1 may rest on the stop, which has no polygon. "None found" was said of it.
#[test]
fn f06d_orbits_that_rest_are_not_passed_over() {
    let osc = Oscillator::from_inverse_beta(1.3, 0.0, 0.0).unwrap();
    let frame = Frame { plane: (Parameter::InverseBeta, Parameter::Gap).into(), ranges: (1.1..=1.5, -0.6..=0.6) };
    for kind in [RegionKind::Existence, RegionKind::Stability] {
        let options = RegionOptions { grid: (6, 6), ..RegionOptions::default() };
        let found = region(&osc, Label::new(1, 1), kind, &frame, options);
        assert!(!found.unresolved.is_empty());
        for (p, q) in found.unresolved {
            let osc = Oscillator::from_inverse_beta(p, q, 0.0).unwrap();
            let orbits = find(&osc, Label::new(1, 1), FindOptions::default());
            assert!(orbits.iter().any(|orbit| orbit.physical && !orbit.cycle.rests.is_empty()), "{p} {q}");
        }
    }
}

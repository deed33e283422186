//! The region of the motion without impacts, against its amplitude, in every plane of two parameters.

use crate::Random;
use vibroimpact::continuation::{Bound, Frame, Region, RegionKind, RegionOptions, region};
use vibroimpact::orbit::{earlier_contact, without_impacts};
use vibroimpact::{Label, Oscillator, Parameter};

const ZERO: Label = Label::new(0, 1);

fn found(osc: &Oscillator, frame: &Frame, kind: RegionKind) -> Region {
    region(osc, ZERO, kind, frame, RegionOptions::default())
}

/// The vertices from which an edge goes along a touch.
fn polygon_touches(found: &Region) -> impl Iterator<Item = (f64, f64)> {
    let vertices = found.polygons.iter().flat_map(|polygon| &polygon.vertices);
    vertices.filter(|vertex| vertex.bound == Bound::Touch).map(|vertex| vertex.values)
}

/// Parameters with ranges that hold touches, drawn at random.
fn ranges(numbers: &mut Random) -> [(Parameter, core::ops::RangeInclusive<f64>); 7] {
    let mut over = |low: f64, high: f64| {
        let (a, b) = (numbers.between(low, high), numbers.between(low, high));
        a.min(b)..=a.max(b) + 1e-3 * (high - low)
    };
    [
        (Parameter::Beta, over(0.2, 3.0)),
        (Parameter::InverseBeta, over(0.4, 3.0)),
        (Parameter::Gap, over(-0.2, 4.0)),
        (Parameter::SecondGap, over(0.25, 4.0)),
        (Parameter::Damping, over(0.0, 0.9)),
        (Parameter::Restitution, over(0.0, 0.9)),
        (Parameter::SecondRestitution, over(0.0, 0.9)),
    ]
}

/// Item 6: "existence: none found" where `orbit --label 0` finds it stable.
#[test]
fn f06_the_motion_without_impacts_has_a_region() {
    let osc = Oscillator::new(1.5, 0.5, 0.5).unwrap().with_damping(0.05).unwrap();
    let frame = Frame { plane: (Parameter::Beta, Parameter::Gap).into(), ranges: (1.5..=3.0, 0.5..=2.0) };
    for kind in [RegionKind::Existence, RegionKind::Stability] {
        let found = found(&osc, &frame, kind);
        assert_eq!((found.polygons.len(), found.unresolved.len()), (1, 0));
        assert!(found.contains((2.0, 1.0)) && !found.contains((1.51, 0.6)));
        let mut touches = polygon_touches(&found);
        assert!(
            touches.all(|(beta, gap)| (Parameter::Beta.set(&osc, beta).unwrap().free_amplitude() - gap).abs() < 1e-12)
        );
        let polygon = &found.polygons[0];
        assert!(!polygon.hole && polygon.below);
        assert!(polygon.vertices.iter().any(|vertex| vertex.bound == Bound::Frame));
    }
    // without damping it is neutrally stable
    let undamped = Oscillator::new(1.5, 0.5, 0.5).unwrap();
    assert!(found(&undamped, &frame, RegionKind::Existence).contains((2.0, 1.0)));
    assert!(found(&undamped, &frame, RegionKind::Stability).polygons.is_empty());
}

#[test]
fn f06b_every_plane_against_the_amplitude() {
    let mut numbers = Random(6);
    let (mut inside, mut outside) = (0, 0);
    for case in 0..600 {
        let damping = if case % 3 == 0 { 0.0 } else { numbers.between(1e-3, 0.8) };
        let (beta, gap) = (numbers.between(0.2, 3.0), numbers.between(0.3, 4.0));
        let two = case % 2 == 0;
        let mut osc = Oscillator::new(beta, gap, 0.5).unwrap().with_damping(damping).unwrap();
        if two {
            osc = osc.with_second_stop(numbers.between(0.3, 4.0), 0.5).unwrap();
        }
        let all = ranges(&mut numbers);
        let ((p, over_p), (q, over_q)) = (all[numbers.below(7)].clone(), all[numbers.below(7)].clone());
        let lower = |p| matches!(p, Parameter::SecondGap | Parameter::SecondRestitution);
        if p == q || (p.is_frequency() && q.is_frequency()) || (!two && (lower(p) || lower(q))) {
            continue;
        }
        let frame = Frame { plane: (p, q).into(), ranges: (over_p.clone(), over_q.clone()) };
        let exists = found(&osc, &frame, RegionKind::Existence);
        let stable = found(&osc, &frame, RegionKind::Stability);
        assert!(exists.polygons.iter().all(|polygon| polygon.vertices.len() > 2 && !polygon.hole));
        for _ in 0..60 {
            let at = (numbers.between(*over_p.start(), *over_p.end()), numbers.between(*over_q.start(), *over_q.end()));
            let Ok(there) = p.set(&osc, at.0).and_then(|osc| q.set(&osc, at.1)) else { continue };
            let room = there.stops().map(|(_, stop)| stop.gap - there.free_amplitude()).fold(f64::INFINITY, f64::min);
            // edges lie on the curve to 2e-5 of a quarter of the frame, which a steep one turns into a larger room
            let near = [(-1.0, 0.0), (1.0, 0.0), (0.0, -1.0), (0.0, 1.0)].iter().any(|(x, y)| {
                let (dx, dy) = (over_p.end() - over_p.start(), over_q.end() - over_q.start());
                let moved = p.set(&osc, at.0 + x * 2e-5 * dx).and_then(|osc| q.set(&osc, at.1 + y * 2e-5 * dy));
                moved.is_ok_and(|moved| {
                    let gap = |osc: &Oscillator| osc.stops().map(|(_, stop)| stop.gap).fold(f64::INFINITY, f64::min);
                    (gap(&moved) - moved.free_amplitude()) * room <= 0.0
                })
            });
            if near {
                continue;
            }
            assert_eq!(exists.contains(at), room > 0.0, "{osc:?} {frame:?} at {at:?}: room {room}");
            let damped = damping > 0.0 || [p, q].contains(&Parameter::Damping);
            assert_eq!(stable.contains(at), room > 0.0 && damped);
            if let Some(cycle) = without_impacts(&there) {
                assert_eq!(exists.contains(at), earlier_contact(&there, &cycle).is_none());
            }
            *(if room > 0.0 { &mut inside } else { &mut outside }) += 1;
        }
    }
    assert!(inside > 3000 && outside > 3000, "{inside} {outside}");
}

/// A resonance far narrower than any grid: nothing of it may be missed.
#[test]
fn f06c_a_narrow_resonance_divides_the_region() {
    let osc = Oscillator::new(0.5, 1.0, 0.5).unwrap().with_damping(1e-9).unwrap();
    let frame = Frame { plane: (Parameter::Gap, Parameter::Beta).into(), ranges: (9e6..=1e7, 0.5..=1.5) };
    let found = found(&osc, &frame, RegionKind::Existence);
    assert_eq!(found.polygons.len(), 2);
    assert!(!found.contains((1e7 - 1.0, 1.0)) && found.contains((9.5e6, 1.0 + 1e-7)) && found.contains((9.5e6, 0.9)));
}

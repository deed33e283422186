//! Curves in the plane of frequency and gap: those of one impact in n periods against their closed forms, and points of
//! codimension two where theory puts them.

use crate::closed_forms::Form;
use vibroimpact::continuation::{
    Branch, BranchEvent, BranchOptions, Curve, CurveEvent, CurveKind, CurveOptions, CurvePoint, Direction, Frame,
    SolutionPoint,
};
use vibroimpact::orbit::{FindOptions, find, refine};
use vibroimpact::{Label, Oscillator, Parameter};

fn at(inverse: f64, gap: f64, eps: f64, zeta: f64) -> Oscillator {
    Oscillator::from_inverse_beta(inverse, gap, eps).unwrap().with_damping(zeta).unwrap()
}

fn frame(p: std::ops::RangeInclusive<f64>, q: std::ops::RangeInclusive<f64>) -> Frame {
    Frame { plane: (Parameter::InverseBeta, Parameter::Gap).into(), ranges: (p, q) }
}

/// The first event of that name on the branch of 1/n in the gap, inadmissible solutions included.
fn event(osc: &Oscillator, n: u32, direction: Direction, name: &str) -> SolutionPoint {
    let orbits = find(osc, Label::new(1, n), FindOptions::default());
    let options = BranchOptions { keep_signature: true, ..Default::default() };
    let begin = &orbits.last().unwrap().cycle;
    let mut branch = Branch::new(osc, begin, Parameter::Gap, -20.0..=20.0, direction, options).unwrap();
    branch.find(|p| p.event.is_some_and(|e| e.name() == name)).unwrap()
}

/// Both ways along the curve through a point, in one list.
fn curve(osc: &Oscillator, point: &SolutionPoint, frame: &Frame) -> Vec<CurvePoint> {
    let ways = Curve::through(osc, point, Parameter::Gap, frame, CurveOptions::default()).unwrap();
    ways.into_iter().flatten().collect()
}

#[test]
fn fold_and_doubling_curves_of_one_impact() {
    for (inverse, eps, zeta, n) in [(1.2, 0.5, 0.05, 1), (0.8, 0.7, 0.0, 1), (1.11, 0.5, 0.02, 2), (1.3, 0.5, 0.0, 1)] {
        let osc = at(inverse, 0.5, eps, zeta);
        for (name, kind) in [("fold", CurveKind::Fold), ("flip", CurveKind::Flip)] {
            let point = event(&osc, n, Direction::Up, name);
            let frame = frame(inverse - 0.15..=inverse + 0.15, -20.0..=20.0);
            let points = curve(&osc, &point, &frame);
            assert!(points.len() > 20, "{}", points.len());
            for p in &points {
                let form = Form::new(1.0 / p.values.0, eps, zeta, n);
                let (gap, u) = if kind == CurveKind::Fold { form.fold() } else { form.doubling() };
                let speed = p.cycle.points[0].state.velocity;
                // the ellipse of solutions is symmetric
                let sign = (speed * u).signum();
                let tolerance = 1e-10 * (1.0 + gap.abs());
                assert!((p.values.1 - sign * gap).abs() < tolerance, "{name} {:?} {gap} {speed} {u}", p.values);
            }
            let ends = points.iter().filter(|p| p.event == Some(CurveEvent::EndOfBox)).count();
            let resonant = points.iter().filter(|p| p.event == Some(CurveEvent::ResonantGrazing { stop: 0 })).count();
            assert_eq!(ends + resonant, 2, "{name} at {osc:?}");
        }
    }
}

/// On delta = |f| 1/n has no speed; where sin(2 pi n / beta) = 0 the grazing is resonant. With damping: where
/// sin(2 pi n sqrt(1 - zeta^2) / beta) = 0.
#[test]
fn resonant_grazing_of_one_impact() {
    // (1.5 is no good for n = 2 without damping: whole natural periods in the two of the force)
    for (zeta, n, high) in [(0.0, 1, 1.9), (0.0, 2, 1.4), (0.03, 1, 1.9), (0.03, 2, 1.9)] {
        let osc = at(1.2, 0.5, 0.5, zeta);
        let orbits = find(&osc, Label::new(1, n), FindOptions::default());
        let begin = &orbits.last().unwrap().cycle;
        let options = BranchOptions { keep_signature: true, ..Default::default() };
        let f = osc.free_amplitude();
        // the point without speed
        let branch = Branch::new(&osc, begin, Parameter::Gap, 0.0..=f, Direction::Up, options).unwrap();
        let last = branch.last().unwrap();
        let orbit = refine(&at(1.2, f, 0.5, zeta), &last.cycle).unwrap();
        assert!(orbit.cycle.points[0].state.velocity.abs() < 1e-9);
        let event = Some(BranchEvent::LossOfContact { stop: 0, detail: None });
        let point = SolutionPoint { value: f, cycle: orbit.cycle, physical: true, event };
        let points = curve(&osc, &point, &frame(1.05..=high, 0.0..=12.0));
        for p in &points {
            let f = at(p.values.0, 0.0, 0.5, zeta).free_amplitude();
            assert!((p.values.1 - f).abs() < 1e-10 * f, "{:?} {f}", p.values);
            assert!(p.cycle.points[0].state.velocity.abs() < 1e-12);
        }
        let resonant: Vec<f64> = points
            .iter()
            .filter(|p| p.event == Some(CurveEvent::ResonantGrazing { stop: 0 }))
            .map(|p| p.values.0)
            .collect();
        let wd = (1.0 - zeta * zeta).sqrt();
        let expected: Vec<f64> =
            (1..20).map(|k| f64::from(k) / (2.0 * f64::from(n) * wd)).filter(|x| (1.05..high).contains(x)).collect();
        assert_eq!(resonant.len(), expected.len(), "{resonant:?} {expected:?}");
        for e in expected {
            assert!(resonant.iter().any(|r| (r - e).abs() < 1e-10), "{resonant:?} {e}");
        }
    }
}

/// The curve on which 2/2 loses its gentle impact and 1/2 begins: beside it 1/2 is a motion on one side only.
#[test]
fn a_grazing_curve_bounds_a_motion() {
    let osc = at(1.11, 2.0, 0.5, 0.0);
    let orbits = find(&osc, Label::new(1, 2), FindOptions::default());
    let begin = &orbits.iter().find(|o| o.physical).unwrap().cycle;
    let options = BranchOptions::default();
    let mut branch = Branch::new(&osc, begin, Parameter::Gap, 0.0..=6.0, Direction::Down, options).unwrap();
    let point = branch.find(|p| matches!(p.event, Some(BranchEvent::Grazing { .. }))).unwrap();
    let points = curve(&osc, &point, &frame(0.9..=1.3, 0.0..=6.0));
    let mut checked = 0;
    for p in points.iter().filter(|p| p.event.is_none() && p.physical).step_by(3) {
        // the cycle without the impact of speed zero
        let mut without = p.cycle.clone();
        let k = (0..2).find(|&k| without.points[k].state.velocity.abs() < 1e-9).unwrap();
        without.points.remove(k);
        without.points[0].interval = 2.0 * at(p.values.0, 0.0, 0.5, 0.0).period();
        let physical = |h: f64| refine(&at(p.values.0, p.values.1 + h, 0.5, 0.0), &without).unwrap().physical;
        assert!(physical(1e-7) != physical(-1e-7), "{:?}", p.values);
        checked += 1;
    }
    assert!(checked > 5, "{checked}");
}

/// The branch that leaves 1/4 by a touch turns twice; the two folds meet in a cusp. Between the fold curves there are two
/// orbits more than beside them.
#[test]
fn two_folds_meet_in_a_cusp() {
    let osc = at(1.11, 4.8, 0.5, 0.0);
    let orbits = find(&osc, Label::new(1, 4), FindOptions::default());
    let begin = &orbits.iter().find(|o| o.physical).unwrap().cycle;
    let options = BranchOptions::default();
    let branch = Branch::new(&osc, begin, Parameter::Gap, 4.0..=6.0, Direction::Down, options).unwrap();
    let folds: Vec<SolutionPoint> = branch.filter(|p| p.event == Some(BranchEvent::Fold)).collect();
    assert_eq!(folds.len(), 2);
    let frame = frame(1.0..=1.2, 3.0..=7.0);
    let cusps: Vec<(f64, f64)> = folds
        .iter()
        .flat_map(|fold| curve(&osc, fold, &frame))
        .filter(|p| p.event == Some(CurveEvent::Cusp))
        .map(|p| p.values)
        .collect();
    let [(p, q), (r, s)] = cusps[..] else { panic!("{cusps:?}") };
    assert!((p - r).abs() < 1e-9 && (q - s).abs() < 1e-9, "{cusps:?}");
    let count = |inverse: f64, gap: f64| {
        let found = find(&at(inverse, gap, 0.5, 0.0), Label::new(2, 4), FindOptions::default());
        found.iter().filter(|o| o.physical).count()
    };
    let (low, high) = (folds[1].value, folds[0].value);
    assert_eq!(count(1.11, high - 3e-3), 2 + count(1.11, high + 3e-3));
    assert_eq!(count(1.11, low + 3e-3), 2 + count(1.11, low - 3e-3));
    // on the other side of the cusp nothing folds
    assert_eq!(count(p - 0.003, q - 0.02), count(p - 0.003, q + 0.02));
}

/// Item 10: without damping 1/1 touches at delta = |f| whatever the restitution, which does not enter the equations of an impact
/// without speed. The curve was refused with a sentence about its equations.
#[test]
fn f10_a_grazing_curve_along_which_one_parameter_does_not_change() {
    let osc = Oscillator::from_inverse_beta(0.632_645_083_847_320_9, 1.422_755_681_087_771, 0.5).unwrap();
    let orbit = find(&osc, Label::new(1, 1), FindOptions::default()).pop().unwrap();
    for (parameters, ranges) in [
        ((Parameter::Gap, Parameter::Restitution), (-0.8..=3.0, 0.3..=0.7)),
        ((Parameter::Restitution, Parameter::Gap), (0.3..=0.7, -0.8..=3.0)),
    ] {
        let frame = Frame { plane: parameters.into(), ranges };
        let branch = |direction| {
            let options = BranchOptions::default();
            Branch::new(&osc, &orbit.cycle, Parameter::Gap, -0.8..=3.0, direction, options).unwrap()
        };
        let lost = |point: &SolutionPoint| matches!(point.event, Some(BranchEvent::LossOfContact { .. }));
        let touch = [Direction::Up, Direction::Down].into_iter().flat_map(branch).find(lost).unwrap();
        let both = Curve::through(&osc, &touch, Parameter::Gap, &frame, CurveOptions::default()).unwrap();
        let mut ends = both.map(|curve| {
            let points: Vec<_> = curve.collect();
            let gap = |p: &CurvePoint| {
                if parameters.0 == Parameter::Gap { p.values } else { (p.values.1, p.values.0) }
            };
            assert!(points.iter().all(|p| (gap(p).0 - osc.free_amplitude()).abs() < 1e-12));
            assert_eq!(points.last().unwrap().event, Some(CurveEvent::EndOfBox));
            gap(points.last().unwrap()).1
        });
        ends.sort_by(f64::total_cmp);
        assert!((ends[0] - 0.3).abs() < 1e-12 && (ends[1] - 0.7).abs() < 1e-12, "{ends:?}");
    }
}

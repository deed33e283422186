//! Points of codimension two and ends of curves, each from a second side: another curve through the same point, a closed
//! form, or equations solved here.

use crate::closed_forms::Form;
use vibroimpact::continuation::{
    Branch, BranchEvent, BranchOptions, Curve, CurveEvent, CurveOptions, CurvePoint, Direction, Frame,
};
use vibroimpact::orbit::{FindOptions, find, refine};
use vibroimpact::{Label, Oscillator, Parameter, Side};

const UP: Direction = Direction::Up;
const DOWN: Direction = Direction::Down;

/// All points, both ways, on the curve through the first event of that name on the branch of `label` in the gap.
fn curve(osc: &Oscillator, label: Label, direction: Direction, name: &str, frame: &Frame) -> Vec<CurvePoint> {
    let orbits = find(osc, label, FindOptions::default());
    let begin = &orbits.iter().find(|o| o.physical).unwrap().cycle;
    let range = frame.ranges.1.clone();
    let range =
        if frame.plane.parameters().is_some_and(|(_, second)| second == Parameter::Gap) { range } else { -5.0..=8.0 };
    let mut branch = Branch::new(osc, begin, Parameter::Gap, range, direction, BranchOptions::default()).unwrap();
    let point = branch.find(|p| p.event.is_some_and(|e| e.name() == name)).unwrap();
    let ways = Curve::through(osc, &point, Parameter::Gap, frame, CurveOptions::default()).unwrap();
    ways.into_iter().flatten().collect()
}

/// The points with this event, on any stop.
fn at(points: &[CurvePoint], event: CurveEvent) -> Vec<&CurvePoint> {
    points.iter().filter(|p| p.event.is_some_and(|known| known.name() == event.name())).collect()
}

/// Two grazing curves, of a touch on either stop, cross: on each the other touch is found, at the same point.
#[test]
fn double_grazing_is_where_two_grazing_curves_cross() {
    let osc = Oscillator::new(0.7, 1.0, 0.7).unwrap().with_damping(0.1).unwrap().with_second_stop(0.8, 0.6).unwrap();
    let frame = Frame { plane: (Parameter::Beta, Parameter::Gap).into(), ranges: (0.5..=0.65, 0.05..=3.0) };
    let osc = Parameter::Beta.set(&osc, 0.6).unwrap();
    let mut found = Vec::new();
    for direction in [DOWN, UP] {
        let points = curve(&osc, Label::new(2, 1), direction, "grazing", &frame);
        let double = at(&points, CurveEvent::DoubleGrazing { stop: 0 });
        let touched =
            |p: &CurvePoint| p.cycle.points.iter().find(|q| q.state.velocity.abs() < 1e-12).unwrap().state.side;
        found.push(double.iter().map(|p| (touched(p), p.values)).collect::<Vec<_>>());
        // the event names the stop of the second contact
        let second = |p: &CurvePoint| p.event == Some(CurveEvent::DoubleGrazing { stop: 1 - touched(p).place() });
        assert!(double.iter().all(|p| p.physical && second(p)), "{double:?}");
    }
    let near = |(a, (p, q)): &(Side, (f64, f64)), (b, (r, s)): &(Side, (f64, f64))| {
        a != b && (p - r).abs() < 1e-10 && (q - s).abs() < 1e-10
    };
    assert!(found[0].iter().any(|a| found[1].iter().any(|b| near(a, b))), "{found:?}");
}

/// With restitution 1 and no damping both multipliers are -1 on the curve of flips: its closed form there.
#[test]
fn one_to_two_where_nothing_is_lost() {
    let osc = Oscillator::from_inverse_beta(1.11, 1.0, 0.5).unwrap();
    let frame = Frame { plane: (Parameter::Gap, Parameter::Restitution).into(), ranges: (-5.0..=8.0, 0.2..=1.0) };
    let points = curve(&osc, Label::new(1, 1), UP, "flip", &frame);
    let found = at(&points, CurveEvent::OneToTwo);
    let [point] = found[..] else { panic!("{} of them", found.len()) };
    let (gap, eps) = point.values;
    assert!((eps - 1.0).abs() < 1e-13);
    let expected = Form::new(1.0 / 1.11, 1.0, 0.0, 1).doubling().0;
    assert!((gap - expected).abs() < 1e-10, "{gap} {expected}");
    for multiplier in point.cycle.multipliers {
        // a double one is known to the root of rounding
        assert!((multiplier.re + 1.0).abs() < 1e-5 && multiplier.im.abs() < 1e-5, "{multiplier:?}");
    }
    // with a loss there is none
    let frame = Frame { plane: (Parameter::Gap, Parameter::Restitution).into(), ranges: (-5.0..=8.0, 0.2..=0.9) };
    assert!(at(&curve(&osc, Label::new(1, 1), UP, "flip", &frame), CurveEvent::OneToTwo).is_empty());
}

#[test]
fn curves_end_for_a_reason() {
    // 1/3 without damping: four natural periods in three of the force
    let osc = Oscillator::from_inverse_beta(1.11, 4.0, 0.5).unwrap();
    let frame = Frame { plane: (Parameter::Beta, Parameter::Gap).into(), ranges: (0.7..=1.1, 0.5..=8.0) };
    let points = curve(&osc, Label::new(1, 3), UP, "loss of contact", &frame);
    let whole = at(&points, CurveEvent::WholePeriods);
    let [end] = whole[..] else { panic!("{:?}", points.last()) };
    assert!((end.values.0 - 0.75).abs() < 1e-15, "{:?}", end.values);
    // beside a singular point the equations say little about the gap
    assert!((end.values.1 - 1.0 / (1.0 - 0.5625)).abs() < 1e-6, "{:?}", end.values);
    assert!(at(&points, CurveEvent::DoubleGrazing { stop: 0 }).is_empty());
    // damped: the folds of 2/2 end on the flips of 1/1
    let osc = Oscillator::from_inverse_beta(1.11, 1.0, 0.5).unwrap().with_damping(0.03).unwrap();
    let frame = Frame { plane: (Parameter::Beta, Parameter::Gap).into(), ranges: (0.72..=1.125, -0.9..=6.0) };
    let up = find(&osc, Label::new(1, 1), FindOptions::default());
    let begin = &up.iter().find(|o| o.physical).unwrap().cycle;
    let options = BranchOptions::default();
    let mut branch = Branch::new(&osc, begin, Parameter::Gap, -0.9..=6.0, UP, options).unwrap();
    let flip = branch.find(|p| p.event == Some(BranchEvent::Flip)).unwrap();
    let mut doubled = Branch::from_flip(&osc, &flip, Parameter::Gap, -0.9..=6.0, options).unwrap();
    let fold = doubled.find(|p| p.event == Some(BranchEvent::Fold)).unwrap();
    let ways = Curve::through(&osc, &fold, Parameter::Gap, &frame, CurveOptions::default()).unwrap();
    let points: Vec<CurvePoint> = ways.into_iter().flatten().collect();
    let merged = at(&points, CurveEvent::DegenerateFlip);
    let [end] = merged[..] else { panic!("{:?}", points.iter().filter_map(|p| p.event).collect::<Vec<_>>()) };
    // there 1/1 has the multiplier -1
    let (beta, gap) = end.values;
    let there = Parameter::Gap.set(&Parameter::Beta.set(&osc, beta).unwrap(), gap).unwrap();
    let mut once = end.cycle.clone();
    once.label = Label::new(1, 1);
    once.points.truncate(1);
    once.points[0].interval = there.period();
    let orbit = refine(&there, &once).unwrap();
    let expected = Form::new(beta, 0.5, 0.03, 1).doubling().0;
    assert!((gap - expected).abs() < 1e-7, "{gap} {expected}");
    assert!(orbit.cycle.multipliers.iter().any(|m| (m.re + 1.0).abs() < 1e-6), "{:?}", orbit.cycle.multipliers);
    // 2/3 with a touch, down to where it has no speed
    let points = curve(&Parameter::Gap.set(&osc, 3.93).unwrap(), Label::new(1, 3), DOWN, "grazing", &frame);
    let lost = at(&points, CurveEvent::LossOfContact);
    let [end] = lost[..] else { panic!("{:?}", points.iter().filter_map(|p| p.event).collect::<Vec<_>>()) };
    let there = Parameter::Beta.set(&osc, end.values.0).unwrap();
    assert!((end.values.1 - there.free_amplitude()).abs() < 1e-9, "{:?}", end.values);
    assert!(end.cycle.points.iter().all(|p| p.state.velocity.abs() < 1e-9), "{:?}", end.cycle);
}

/// The last point of a curve of folds is the limit of those before it, and a motion if they are.
#[test]
fn a_limit_of_motions_is_one() {
    // 3/1: at one end an impact has no speed, where another multiplier would be infinite
    let osc = Oscillator::from_inverse_beta(1.9, 0.6, 0.8).unwrap();
    let start = find(&osc, Label::new(3, 1), FindOptions::default()).into_iter().find(|o| o.physical).unwrap().cycle;
    let options = BranchOptions::default();
    let mut branch = Branch::new(&osc, &start, Parameter::Gap, -3.0..=6.0, UP, options).unwrap();
    let fold = branch.find(|p| p.event == Some(BranchEvent::Fold)).unwrap();
    let frame = Frame { plane: (Parameter::Gap, Parameter::Restitution).into(), ranges: (-3.0..=6.0, 0.0..=1.0) };
    let ways = Curve::through(&osc, &fold, Parameter::Gap, &frame, CurveOptions::default()).unwrap();
    let mut found = 0;
    for way in ways {
        let points: Vec<CurvePoint> = way.collect();
        let (last, before) = (points.last().unwrap(), &points[points.len() - 2]);
        if matches!(last.event, Some(CurveEvent::ResonantGrazing { .. })) {
            assert!(last.cycle.points.iter().any(|p| p.state.velocity.abs() < 1e-12));
            assert!(before.physical && last.physical);
            found += 1;
        }
    }
    assert_eq!(found, 1);
    // over the frequency, with restitution 0.5, all three impacts end as one touch: 1/beta = 1/2, delta = -1/3 = f, and no motions
    let osc = Oscillator::from_inverse_beta(0.5, -0.53, 0.5).unwrap();
    let frame = Frame { plane: (Parameter::InverseBeta, Parameter::Gap).into(), ranges: (0.4..=2.0, -3.0..=6.0) };
    let points = curve(&osc, Label::new(3, 1), DOWN, "fold", &frame);
    let lost = at(&points, CurveEvent::LossOfContact);
    let [end] = lost[..] else { panic!("{:?}", points.iter().filter_map(|p| p.event).collect::<Vec<_>>()) };
    assert!((end.values.0 - 0.5).abs() < 1e-6 && (end.values.1 + 1.0 / 3.0).abs() < 1e-6, "{:?}", end.values);
    assert!(!end.physical);
}

/// Towards restitution 1 the folds of 3/1 run to 1/beta = 3/2: three equal flights of half a natural period each, at any speed.
#[test]
fn speeds_without_bound() {
    let frame =
        Frame { plane: (Parameter::InverseBeta, Parameter::Restitution).into(), ranges: (0.4..=2.6, 0.0..=1.0) };
    for (inverse, gap, eps) in [(1.6, 0.25, 0.5), (1.9, 0.6, 0.8)] {
        let osc = Oscillator::from_inverse_beta(inverse, gap, eps).unwrap();
        let points = [UP, DOWN].into_iter().find_map(|direction| {
            let orbits = find(&osc, Label::new(3, 1), FindOptions::default());
            let begin = &orbits.iter().find(|o| o.physical).unwrap().cycle;
            let options = BranchOptions::default();
            let mut branch = Branch::new(&osc, begin, Parameter::Gap, -3.0..=6.0, direction, options).unwrap();
            let fold = branch.find(|p| p.event == Some(BranchEvent::Fold))?;
            let ways = Curve::through(&osc, &fold, Parameter::Gap, &frame, CurveOptions::default()).unwrap();
            Some(ways.into_iter().flatten().collect::<Vec<CurvePoint>>())
        });
        let points = points.unwrap();
        let found = at(&points, CurveEvent::Unbounded);
        let [end] = found[..] else { panic!("{:?}", points.iter().filter_map(|p| p.event).collect::<Vec<_>>()) };
        assert!((end.values.0 - 1.5).abs() < 2e-4 && (end.values.1 - 1.0).abs() < 1e-15, "{:?}", end.values);
    }
}

//! The line 1/beta = 1.11, eps = 1/2 without damping: 1/1, its doubling, what branches off and comes back as 1/2, the
//! doubling of that, down to loss of contact at delta = |f|. Each event is confirmed by simulation on either side of it.

use vibroimpact::continuation::{Branch, BranchEvent, BranchOptions, Direction, SolutionPoint};
use vibroimpact::motion::{EventKind, ImpactState, Motion};
use vibroimpact::orbit::{Cycle, FindOptions, Orbit, find, refine};
use vibroimpact::verdict::{SettleOptions, Verdict, settle};
use vibroimpact::{Label, Oscillator, Parameter, Start};

fn at(gap: f64) -> Oscillator {
    Oscillator::from_inverse_beta(1.11, gap, 0.5).unwrap()
}

fn range() -> std::ops::RangeInclusive<f64> {
    -0.1..=6.0
}

/// The branch of the only physical orbit called `label` at this gap.
fn branch(label: Label, gap: f64, direction: Direction) -> Vec<SolutionPoint> {
    let osc = at(gap);
    let orbits = find(&osc, label, FindOptions::default());
    let orbit = orbits.iter().find(|o| o.physical).unwrap();
    Branch::new(&osc, &orbit.cycle, Parameter::Gap, range(), direction, BranchOptions::default()).unwrap().collect()
}

fn doubled(points: &[SolutionPoint]) -> Vec<SolutionPoint> {
    let flip = points.iter().find(|p| p.event == Some(BranchEvent::Flip)).unwrap();
    Branch::from_flip(&at(0.0), flip, Parameter::Gap, range(), BranchOptions::default()).unwrap().collect()
}

fn events(points: &[SolutionPoint]) -> Vec<(&'static str, String, f64)> {
    points.iter().filter_map(|p| Some((p.event?.name(), p.cycle.label.to_string(), p.value))).collect()
}

fn assert_events(points: &[SolutionPoint], expected: &[(&str, &str, f64)]) {
    let found = events(points);
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for ((name, label, value), (n, l, v)) in found.iter().zip(expected) {
        assert_eq!((*name, label.as_str()), (*n, *l), "{found:?}");
        assert!((value - v).abs() < 1e-12 * (1.0 + v.abs()), "{name} of {label} at {value}, expected {v}");
    }
}

/// The point of a branch nearest to a gap, among those of that label and stability.
fn nearest<'a>(points: &'a [SolutionPoint], label: &str, stable: bool, gap: f64) -> &'a Cycle {
    let of = points.iter().filter(|p| p.event.is_none() && p.cycle.label.to_string() == label && p.stable() == stable);
    &of.min_by(|a, b| (a.value - gap).abs().total_cmp(&(b.value - gap).abs())).unwrap().cycle
}

/// The cycle at this gap, followed from a near one.
fn refined(near: &Cycle, gap: f64) -> Orbit {
    refine(&at(gap), near).unwrap()
}

/// What the motion settles into from beside the first impact of a cycle.
fn settled(cycle: &Cycle, gap: f64, aside: f64) -> String {
    let osc = at(gap);
    let state = cycle.points[0].state;
    let start = ImpactState { velocity: state.velocity * (1.0 + aside), ..state }.rebound(&osc);
    match settle(&osc, start, &SettleOptions::default()).verdict {
        Verdict::Periodic(cycle) => cycle.label.to_string(),
        other => other.label().to_string(),
    }
}

/// Whether the simulation from the first impact makes exactly the impacts of the cycle over one period of it.
fn flown(cycle: &Cycle, gap: f64) -> bool {
    let osc = at(gap);
    let mut motion = Motion::after(&osc, &cycle.points[0].state, Default::default());
    let mut time = 0.0;
    let m = cycle.points.len();
    (0..m).all(|k| {
        time += cycle.points[k].interval;
        // a touch without effect is none
        let hit = motion.by_ref().find(|e| !matches!(e.kind, EventKind::Graze { .. }));
        matches!(hit, Some(e) if matches!(e.kind, EventKind::Impact { .. }) && (e.time - time).abs() < 1e-5)
    })
}

const FLIP: f64 = 1.829_006_189_683_6;
const FOLD: f64 = 1.905_668_842_180_4;
const GRAZE: f64 = 1.831_961_666_268_9;
const HALF_FLIP: f64 = 2.881_420_240_512_4;
const QUARTER_GRAZE: f64 = 2.916_166_025_222_1;
const FIRST_GRAZE: f64 = 0.239_845_465_204_5;

#[test]
fn the_events_in_their_order() {
    let f = at(0.0).free_amplitude();
    let up = branch(Label::new(1, 1), 1.0, Direction::Up);
    assert_events(&up, &[("flip", "1/1", FLIP), ("loss of contact", "1/1", f)]);
    assert_events(
        &doubled(&up),
        &[("fold", "2/2", FOLD), ("grazing", "2/2", GRAZE), ("flip", "1/2", HALF_FLIP), ("loss of contact", "1/2", f)],
    );
    // the same loop from the other end: 1/2 back to where 2/2 left 1/1
    let half = branch(Label::new(1, 2), 2.0, Direction::Down);
    assert_events(&half, &[("grazing", "1/2", GRAZE), ("fold", "2/2", FOLD), ("halving", "2/2", FLIP)]);
    let up = branch(Label::new(1, 2), 2.0, Direction::Up);
    assert_events(&doubled(&up), &[("grazing", "2/4", QUARTER_GRAZE), ("loss of contact", "3/4", f)]);
    // the other way 1/1 comes to an end by a touch too
    let down = branch(Label::new(1, 1), 1.0, Direction::Down);
    assert_eq!(events(&down)[0].0, "grazing");
    assert!((events(&down)[0].2 - FIRST_GRAZE).abs() < 1e-12);
    let Some(BranchEvent::Grazing { appears, turns, detail: Some(detail), .. }) = down.iter().find_map(|p| p.event)
    else {
        panic!()
    };
    assert_eq!((appears, detail.labels.1, turns), (true, Some(Label::new(2, 1)), true));
}

#[test]
fn where_1_1_touches_it_ceases_to_be() {
    let points = branch(Label::new(1, 1), 1.0, Direction::Down);
    let near = nearest(&points, "1/1", true, FIRST_GRAZE);
    for h in [1e-4, 1e-8, 1e-10] {
        let (before, after) = (refined(near, FIRST_GRAZE + h), refined(near, FIRST_GRAZE - h));
        assert!(before.physical && flown(&before.cycle, FIRST_GRAZE + h), "{h}");
        assert!(!after.physical && !flown(&after.cycle, FIRST_GRAZE - h), "{h}");
    }
    // the orbit that takes over is unstable, so the motion ends elsewhere
    // (a start further aside than its clearance touches the stop)
    let before = refined(near, FIRST_GRAZE + 1e-3).cycle;
    assert_eq!(settled(&before, FIRST_GRAZE + 1e-3, 1e-6), "1/1");
    assert_ne!(settled(&before, FIRST_GRAZE - 1e-3, 1e-6), "1/1");
}

#[test]
fn where_1_1_doubles_2_2_takes_over() {
    let points = branch(Label::new(1, 1), 1.0, Direction::Up);
    let near = nearest(&points, "1/1", true, FLIP);
    for h in [1e-3, 1e-6, 1e-11] {
        assert!(refined(near, FLIP - h).cycle.stable() && !refined(near, FLIP + h).cycle.stable());
    }
    // nearer to it a motion takes longer to leave or to settle than it is followed for
    let h = 1e-2;
    assert_eq!(settled(&refined(near, FLIP - h).cycle, FLIP - h, 1e-3), "1/1");
    assert_eq!(settled(&refined(near, FLIP + h).cycle, FLIP + h, 1e-3), "2/2");
}

#[test]
fn beyond_the_fold_there_is_no_2_2() {
    let points = doubled(&branch(Label::new(1, 1), 1.0, Direction::Up));
    let h = 1e-4;
    let (stable, unstable) = (nearest(&points, "2/2", true, FOLD - h), nearest(&points, "2/2", false, FOLD - h));
    let (stable, unstable) = (refined(stable, FOLD - h), refined(unstable, FOLD - h));
    assert!(stable.physical && unstable.physical && !stable.cycle.same_as(&unstable.cycle, 1e-3));
    assert!(flown(&stable.cycle, FOLD - h) && flown(&unstable.cycle, FOLD - h));
    assert_eq!(settled(&stable.cycle, FOLD - h, 1e-4), "2/2");
    // a little further both are gone, and the motion slips through to 1/2
    assert_eq!(settled(&stable.cycle, FOLD + h, 1e-4), "1/2");
    assert!(find(&at(FOLD + h), Label::new(2, 2), FindOptions::default()).iter().all(|o| !o.physical));
}

#[test]
fn where_2_2_loses_an_impact_1_2_begins() {
    let points = doubled(&branch(Label::new(1, 1), 1.0, Direction::Up));
    for h in [1e-4, 1e-6, 1e-8, 1e-10] {
        let half = nearest(&points, "1/2", true, GRAZE);
        // 1/2 clears the stop on one side of the event and passes through it on the other
        let (after, before) = (refined(half, GRAZE + h), refined(half, GRAZE - h));
        assert!(after.physical && after.cycle.stable() && flown(&after.cycle, GRAZE + h));
        assert!(!before.physical && !flown(&before.cycle, GRAZE - h));
        // 2/2 turns back at it: its gentle impact has a speed on the same side, and none (below zero) on the other
        let weak = points.iter().find(|p| matches!(p.event, Some(BranchEvent::Grazing { .. }))).unwrap();
        let (with, without) = (refined(&weak.cycle, GRAZE + h), refined(&weak.cycle, GRAZE - h));
        assert!(with.physical && !with.cycle.stable(), "{h} {with:?}");
        // an impact that dips less than rounding below the stop is a touch to the simulation
        assert!(h < 1e-6 || flown(&with.cycle, GRAZE + h), "{h} {with:?}");
        assert!(without.cycle.points.iter().any(|p| p.state.velocity < 0.0) && !without.physical, "{h} {without:?}");
    }
    let half = refined(nearest(&points, "1/2", true, GRAZE), GRAZE + 1e-4).cycle;
    assert_eq!(settled(&half, GRAZE + 1e-4, 1e-6), "1/2");
    assert_eq!(settled(&half, GRAZE - 1e-4, 1e-6), "2/2");
}

#[test]
fn where_1_2_doubles_and_2_4_touches() {
    let points = branch(Label::new(1, 2), 2.0, Direction::Up);
    let near = nearest(&points, "1/2", true, HALF_FLIP);
    let h = 1e-3;
    assert_eq!(settled(&refined(near, HALF_FLIP - h).cycle, HALF_FLIP - h, 1e-3), "1/2");
    assert_eq!(settled(&refined(near, HALF_FLIP + h).cycle, HALF_FLIP + h, 1e-3), "2/4");
    let doubled = doubled(&points);
    let four = nearest(&doubled, "2/4", true, QUARTER_GRAZE);
    assert_eq!(settled(four, QUARTER_GRAZE - 1e-4, 1e-5), "2/4");
    assert_ne!(settled(four, QUARTER_GRAZE + 1e-4, 1e-5), "2/4");
    // an impact appears and the gap goes on growing: 3/4 exists beyond, unstable
    let grazing = doubled.iter().find(|p| matches!(p.event, Some(BranchEvent::Grazing { .. }))).unwrap();
    let Some(BranchEvent::Grazing { turns, detail: Some(detail), .. }) = grazing.event else { panic!() };
    let after = Label::new(3, 4);
    assert_eq!((detail.labels.1, turns), (Some(after), false));
    for h in [1e-5, 1e-8] {
        let (before, past) = (refined(four, QUARTER_GRAZE - h), refined(four, QUARTER_GRAZE + h));
        assert!(before.physical && flown(&before.cycle, QUARTER_GRAZE - h));
        assert!(!past.physical && !flown(&past.cycle, QUARTER_GRAZE + h));
    }
    let three = doubled.iter().find(|p| p.cycle.label == after && p.value > QUARTER_GRAZE + 1e-3).unwrap();
    let three = refined(&three.cycle, three.value);
    assert!(three.physical && !three.cycle.stable());
    assert!(flown(
        &three.cycle,
        doubled.iter().find(|p| p.cycle.label == after && p.value > QUARTER_GRAZE + 1e-3).unwrap().value
    ));
}

#[test]
fn contact_is_lost_where_the_free_motion_fits() {
    let f = at(0.0).free_amplitude();
    let points = branch(Label::new(1, 1), 1.0, Direction::Up);
    let last = points.last().unwrap();
    let Some(BranchEvent::LossOfContact { detail: Some(detail), .. }) = last.event else { panic!("{last:?}") };
    assert!((detail.phase.sin() - 1.0).abs() < 1e-9);
    assert!(last.cycle.fastest().abs() < 1e-9);
    for h in [1e-3, 1e-6, 1e-9] {
        let inside = refined(&nearest(&points, "1/1", false, f - h).clone(), f - h);
        assert!(inside.physical && inside.cycle.residual < 1e-14, "{h} {inside:?}");
        // an impact that dips less than rounding below the stop is a touch to the simulation
        assert!(h < 1e-6 || flown(&inside.cycle, f - h), "{h} {inside:?}");
        assert_eq!(Start::free_motion(&at(f - h)), None);
        let start = Start::free_motion(&at(f + h)).unwrap();
        assert_eq!(Motion::new(&at(f + h), start).next(), None);
        assert!(find(&at(f + h), Label::new(1, 1), FindOptions::default()).iter().all(|o| !o.physical));
    }
}

//! Branches of cycles that rest on a stop: where they end and change, by closed forms, by the law of a chatter that only just
//! completes, and by motions settled on either side.

use std::f64::consts::{PI, TAU};
use vibroimpact::continuation::{Branch, BranchError, BranchEvent, BranchOptions, Curve, CurveOptions};
use vibroimpact::continuation::{Direction, EventDetail, Frame, SolutionPoint};
use vibroimpact::orbit::{Cycle, DEFAULT_EVENTS, FindOptions, find, from_release};
use vibroimpact::verdict::{Count, SettleOptions, Verdict, settle};
use vibroimpact::{Label, Oscillator, Parameter, Side, Start};

/// The branch of the cycle that begins with the release from the stop on `side`.
fn branch(
    osc: &Oscillator,
    side: Side,
    vary: Parameter,
    range: (f64, f64),
    direction: Direction,
) -> Vec<SolutionPoint> {
    let cycle = from_release(osc, side, DEFAULT_EVENTS).unwrap();
    let branch = Branch::new(osc, &cycle, vary, range.0..=range.1, direction, BranchOptions::default()).unwrap();
    let mut points: Vec<SolutionPoint> = branch.collect();
    // what follows where the rest is over, or another one begins, is not determined by this release alone
    if let Some(last) = points.iter().position(other) {
        points.truncate(last + 1);
    }
    for point in &points {
        let at = vary.set(osc, point.value).unwrap();
        assert!(point.physical && point.stable() && point.cycle.multipliers[0].modulus() == 0.0);
        // each point is what its release leads to
        if point.event.is_none() {
            assert!(same(&from_release(&at, side, DEFAULT_EVENTS).unwrap(), &point.cycle));
        }
    }
    let rises = |a: &SolutionPoint, b: &SolutionPoint| {
        (b.value - a.value) * if direction == Direction::Up { 1.0 } else { -1.0 }
    };
    assert!(points.windows(2).all(|p| rises(&p[0], &p[1]) >= 0.0));
    points
}

/// Whether the rest of a cycle is over here, or another one begins.
fn other(point: &SolutionPoint) -> bool {
    matches!(point.event, Some(BranchEvent::Sticking { .. }))
}

fn same(a: &Cycle, b: &Cycle) -> bool {
    a.label == b.label && a.points == b.points && a.rests == b.rests
}

fn events(points: &[SolutionPoint]) -> Vec<(f64, BranchEvent)> {
    points.iter().filter_map(|p| Some((p.value, p.event?))).collect()
}

/// What a motion from a release comes to.
fn settled(osc: &Oscillator, side: Side) -> String {
    let gap = osc.stop(side).unwrap().gap;
    let pressed = if side == Side::Upper { 1.5 } else { 1.5 + PI };
    let start = Start { x: side.sign() * gap, v: 0.0, phase: pressed };
    settle(osc, start, &SettleOptions::default()).verdict.label().into_owned()
}

/// 1/beta = 1.11, eps = 1/2: down to where the force holds the mass for ever, up to where the chatter only just completes.
#[test]
fn a_chatter_that_only_just_completes() {
    let at = |gap: f64| Oscillator::from_inverse_beta(1.11, gap, 0.5).unwrap();
    let down = branch(&at(-0.5), Side::Upper, Parameter::Gap, (-1.2, 0.5), Direction::Down);
    assert_eq!(events(&down), [(-1.0, BranchEvent::RestForEver { stop: 0 })]);
    assert_eq!(
        (settled(&at(-1.0 + 1e-3), Side::Upper).as_str(), settled(&at(-1.0), Side::Upper).as_str()),
        ("inf/1", "stuck")
    );
    let up = branch(&at(-0.5), Side::Upper, Parameter::Gap, (-1.2, 0.5), Direction::Up);
    let [(end, BranchEvent::Sticking { stop: 0, begins: false, detail: Some(EventDetail { phase, .. }) })] =
        events(&up)[..]
    else {
        panic!("{:?}", events(&up))
    };
    assert!((phase - (PI - end.asin())).abs() < 1e-14);
    for h in [1e-4, 1e-8, 1e-12] {
        assert!(from_release(&at(end - h), Side::Upper, DEFAULT_EVENTS).is_some_and(|c| c.label.periods == 1), "{h}");
        assert!(from_release(&at(end + h), Side::Upper, DEFAULT_EVENTS).is_none_or(|c| c.label.periods != 1), "{h}");
    }
    assert_eq!(settled(&at(end - 1e-6), Side::Upper), "inf/1");
    assert_ne!(settled(&at(end + 1e-6), Side::Upper), "inf/1");
    // near the release the flights are alike: with the time left as unit, a flight of length x lands with what its start had
    // where (2 + l) l^2 = eps (1 + 2 l), l = 1 - x. Times shrink by l, and the distance from the verge grows by eps^2/l^5
    let mut l = 0.5_f64;
    for _ in 0..60 {
        let miss = (2.0 + l) * l * l - 0.5 * (1.0 + 2.0 * l);
        l -= miss / (4.0 * l + 3.0 * l * l - 1.0);
    }
    let power = l.ln().abs() / (0.25 / l.powi(5)).ln();
    let held = |gap: f64| {
        let rest = from_release(&at(gap), Side::Upper, DEFAULT_EVENTS).unwrap().rests[0];
        rest.release - rest.begin
    };
    // the law holds up to a periodic factor: over one whole step of the chatter
    let step = 0.25 / l.powi(5);
    for k in 12..18 {
        let h = step.powi(-k);
        let measured = (held(end - h) / held(end - h / step)).ln() / step.ln();
        assert!((measured - power).abs() < 2e-3, "{measured} {power}");
    }
    let times = |k: usize| up.last().unwrap().cycle.points[k].interval;
    assert!((times(30) / times(29) - l).abs() < 1e-5, "{} {l}", times(30) / times(29));
}

/// 1/1 gains impact after impact below delta = 0.24, at values that come closer together; the limit is where the rest of inf/1 ends.
#[test]
fn ever_more_impacts_tend_to_a_chatter() {
    let at = |gap: f64| Oscillator::from_inverse_beta(1.11, gap, 0.5).unwrap();
    let orbits = find(&at(1.0), Label::new(1, 1), FindOptions::default());
    let begin = &orbits.iter().find(|o| o.physical).unwrap().cycle;
    for impacts in [12, 32] {
        let options = BranchOptions { impacts, ..BranchOptions::default() };
        let branch = Branch::new(&at(1.0), begin, Parameter::Gap, -1.0..=2.0, Direction::Down, options).unwrap();
        let points: Vec<SolutionPoint> = branch.collect();
        let chatter = points.iter().position(other).unwrap();
        let (last, beyond) = (&points[chatter], &points[chatter + 1..]);
        // down to where the force holds the mass for ever
        assert!(beyond.iter().all(|point| point.cycle.label.to_string() == "inf/1"));
        assert_eq!(events(beyond), [(-1.0, BranchEvent::RestForEver { stop: 0 })]);
        let Some(BranchEvent::Sticking {
            stop: 0,
            begins: true,
            detail: Some(EventDetail { phase, labels: (before, _), .. }),
        }) = last.event
        else {
            panic!("{:?} at {}", last.event, last.value)
        };
        let rest = branch_end();
        assert!((last.value - rest).abs() < 1e-12, "{} {rest}", last.value);
        assert!((phase - (PI - rest.asin())).abs() < 1e-12 && before.periods == 1);
        assert_eq!(last.cycle.label.to_string(), "inf/1");
        // the touches at which m/1 gains an impact, and their factor: lambda^5/eps^2 with (2 + lambda) lambda^2 = eps (1 + 2 lambda)
        let added: Vec<f64> = points[..chatter]
            .iter()
            .filter(|p| matches!(p.event, Some(BranchEvent::Grazing { appears: true, .. })))
            .map(|p| p.value)
            .collect();
        assert!(added.len() >= 10, "{added:?}");
        let ratios: Vec<f64> = added.windows(3).map(|v| (v[2] - v[1]) / (v[1] - v[0])).collect();
        let l: f64 = 0.660_442_249_723_743;
        assert!(((2.0 + l) * l * l - 0.5 * (1.0 + 2.0 * l)).abs() < 1e-14);
        let factor = l.powi(5) / 0.25;
        assert!((ratios[9] - factor).abs() < 1e-3 * factor, "{ratios:?} {factor}");
        let (a, b) = (added[10], added[11]);
        let limit = b + (b - a) * factor / (1.0 - factor);
        assert!((limit - rest).abs() < 1e-2 * (b - a).abs(), "{limit} {rest}");
    }
}

/// Where the rest of inf/1 ends on that line.
fn branch_end() -> f64 {
    let osc = Oscillator::from_inverse_beta(1.11, -0.5, 0.5).unwrap();
    branch(&osc, Side::Upper, Parameter::Gap, (-1.2, 0.5), Direction::Up).last().unwrap().value
}

/// Restitution 0 without damping: one impact and a rest a period, whose flight is a closed form.
#[test]
fn restitution_zero_by_the_flight_itself() {
    let at = |inverse: f64, gap: f64| Oscillator::from_inverse_beta(inverse, gap, 0.0).unwrap();
    // the flight from a release comes back after just a period where delta^2 (1 + beta^2 tan^2(pi/beta)) = 1
    let points = branch(&at(1.3, 0.3), Side::Upper, Parameter::InverseBeta, (0.4, 1.5), Direction::Down);
    let (end, event) = events(&points)[0];
    assert!(matches!(event, BranchEvent::Sticking { begins: false, .. }), "{event:?}");
    let beta = 1.0 / end;
    let off = |beta: f64| 0.09 * (1.0 + (beta * (PI / beta).tan()).powi(2)) - 1.0;
    assert!(off(beta - 1e-12) * off(beta + 1e-12) < 0.0, "{end}");
    assert_eq!((settled(&at(end + 1e-4, 0.3), Side::Upper), settled(&at(end - 1e-4, 0.3), Side::Upper)).0, "1/1");
    // it lands as the force begins to press, at asin(delta): a moment earlier the mass leaves once more
    let points = branch(&at(1.3, 0.3), Side::Upper, Parameter::Gap, (-1.2, 1.2), Direction::Up);
    let [(value, event @ BranchEvent::Grazing { appears: true, turns: false, .. }), (_, last)] = events(&points)[..]
    else {
        panic!("{:?}", events(&points))
    };
    let EventDetail { impact, phase, labels, .. } = event.detail().unwrap();
    assert_eq!((impact, labels), (Some(0), (Label::new(1, 1), Some(Label::new(2, 1)))));
    assert!((phase - value.asin()).abs() < 1e-12);
    let landing = |gap: f64| {
        let (beta, f) = (1.0 / 1.3, 1.0 / (1.0 - 1.0 / 1.69));
        let release = PI - gap.asin();
        let s = (gap.asin() + TAU - release) / beta;
        (gap - f * release.sin()) * s.cos() - f * beta * release.cos() * s.sin() + f * (release + beta * s).sin() - gap
    };
    assert!(landing(value - 1e-11) * landing(value + 1e-11) < 0.0, "{value}");
    assert!(matches!(last, BranchEvent::Sticking { begins: false, .. }), "{last:?}");
    for (gap, label) in [(value - 1e-4, "1/1"), (value + 1e-4, "2/1")] {
        assert_eq!(settled(&at(1.3, gap), Side::Upper), label);
    }
}

/// Without damping a flight is the same forwards and backwards. One that is level at the force's lowest lands without speed, at
/// the phase at which the force begins to press: all impacts of the chatter vanish there at once, and come back.
#[test]
fn a_landing_without_speed() {
    let at = |gap: f64| Oscillator::from_inverse_beta(2.5, gap, 0.5).unwrap();
    let points = branch(&at(0.25), Side::Upper, Parameter::Gap, (-1.2, 1.2), Direction::Up);
    let found = events(&points);
    let [
        (value, BranchEvent::SoftLanding { detail: Some(detail), .. }),
        (_, BranchEvent::Sticking { begins: false, .. }),
    ] = found[..]
    else {
        panic!("{found:?}")
    };
    let EventDetail { impact: Some(0), phase, .. } = detail else { panic!("{detail:?}") };
    let (beta, f) = (0.4, 1.0 / (1.0 - 0.16));
    // velocity at the force's lowest, of the flight from the release
    let level = |gap: f64| {
        let release = PI - gap.asin();
        let s = (1.5 * PI - release) / beta;
        -(gap - f * release.sin()) * s.sin() - f * beta * release.cos() * s.cos()
    };
    assert!(level(value - 1e-11) * level(value + 1e-11) < 0.0, "{value}");
    assert!((phase - value.asin()).abs() < 1e-12);
    for h in [1e-3, 1e-5, 1e-7] {
        for gap in [value - h, value + h] {
            let cycle = from_release(&at(gap), Side::Upper, DEFAULT_EVENTS).unwrap();
            assert!(cycle.fastest() < 4.0 * h.sqrt() && settled(&at(gap), Side::Upper) == "inf/1");
        }
    }
}

/// Two stops: with the second one nearer impacts on it appear one by one, up to a complete chatter there; from the other side that
/// is where its rest ends.
#[test]
fn impacts_on_the_way_accumulate() {
    let at =
        |second: f64| Oscillator::from_inverse_beta(2.5, 0.25, 0.5).unwrap().with_second_stop(second, 0.5).unwrap();
    let range = (-0.1, 2.0);
    let near = branch(&at(0.25), Side::Upper, Parameter::SecondGap, range, Direction::Up);
    let [(end, BranchEvent::Sticking { stop: 1, begins: false, .. })] = events(&near)[..] else {
        panic!("{:?}", events(&near))
    };
    let far = branch(&at(0.6), Side::Upper, Parameter::SecondGap, range, Direction::Down);
    let found = events(&far);
    let (limit, BranchEvent::Sticking { stop: 1, begins: true, detail: Some(detail) }) = *found.last().unwrap() else {
        panic!("{found:?}")
    };
    let before = detail.labels.0;
    assert!((limit - end).abs() < 1e-12 && before.impacts == Count::Infinite, "{limit} {end}");
    // each graze: one impact more on the second stop, and the same motions elsewhere
    let grazes = &found[..found.len() - 1];
    assert!(grazes.len() >= 8);
    for &(value, event) in grazes {
        let BranchEvent::Grazing { stop: 1, appears: true, detail: Some(detail), .. } = event else {
            panic!("{event:?}")
        };
        let (impact, phase) = (detail.impact.unwrap(), detail.phase);
        let count = |second: f64| {
            let cycle = from_release(&at(second), Side::Upper, DEFAULT_EVENTS).unwrap();
            let lower = cycle.points.iter().filter(|p| p.state.side == Side::Lower).count();
            (lower, cycle.points[impact + 1].state)
        };
        for h in [1e-7, 1e-10, 1e-12] {
            let ((fewer, _), (more, new)) = (count(value + h), count(value - h));
            assert_eq!(more, fewer + 1, "{value} {h}");
            assert!(new.velocity < 20.0 * h.sqrt() && (new.phase - phase).abs() < 20.0 * h.sqrt(), "{h} {new:?}");
        }
        assert_eq!((settled(&at(value + 1e-4), Side::Upper), settled(&at(value - 1e-4), Side::Upper)).0, "inf/1");
    }
    // they come closer together by the same factor each time
    let gaps: Vec<f64> = grazes.windows(2).map(|pair| pair[0].0 - pair[1].0).collect();
    let last = gaps[gaps.len() - 1] / gaps[gaps.len() - 2];
    let extrapolated = grazes.last().unwrap().0 - gaps[gaps.len() - 1] * last / (1.0 - last);
    assert!((extrapolated - limit).abs() < 1e-2 * gaps[gaps.len() - 1], "{extrapolated} {limit}");
}

/// Two stops alike, restitution 0: what happens on one happens on the other half a turn later, and both are told. Without damping the
/// flight from a release to the phase at which the force begins to press at the other stop, which is 2 asin(delta) = pi/3 later, ends on that
/// stop if it takes an odd number of half natural periods, (pi/3)/beta = pi or 3 pi.
#[test]
fn two_stops_alike() {
    let at =
        |inverse: f64| Oscillator::from_inverse_beta(inverse, 0.5, 0.0).unwrap().with_second_stop(0.5, 0.0).unwrap();
    let mut seen = 0;
    for (vary, direction) in [
        (Parameter::InverseBeta, Direction::Up),
        (Parameter::InverseBeta, Direction::Down),
        (Parameter::Damping, Direction::Up),
    ] {
        let range = if vary == Parameter::Damping { (0.0, 2.0) } else { (0.3, 12.0) };
        for point in branch(&at(4.0), Side::Upper, vary, range, direction) {
            let Some(BranchEvent::Grazing { stop, also: Some(also), appears, detail: Some(detail), .. }) = point.event
            else {
                assert!(!matches!(point.event, Some(BranchEvent::Grazing { .. })), "{:?}", point.event);
                continue;
            };
            let (impact, phase) = detail.also.unwrap();
            assert!(also != stop && ((phase - detail.phase).abs() - PI).abs() < 1e-9);
            let [one, other] = [detail.impact, impact].map(|impact| point.cycle.points[impact.unwrap()].state);
            if !appears {
                assert_eq!((one.side.place(), other.side.place()), (stop, also));
                assert!(one.velocity < 1e-4 && other.velocity < 1e-4);
            }
            if vary == Parameter::InverseBeta {
                assert!((point.value - 3.0).abs().min((point.value - 9.0).abs()) < 1e-12, "{}", point.value);
            }
            seen += 1;
        }
    }
    assert!(seen >= 3, "{seen}");
}

/// Every parameter, with and without damping, one and two stops: a branch ends where something happens.
#[test]
fn every_end_has_a_name() {
    let mut numbers = crate::Random(5);
    let mut followed = 0;
    for count in 0..60 {
        let eps = |numbers: &mut crate::Random| if count % 5 == 0 { 0.0 } else { numbers.between(0.1, 0.7) };
        let (inverse, gap) = (numbers.between(0.6, 3.5), numbers.between(-0.9, 0.9));
        let mut osc = Oscillator::from_inverse_beta(inverse, gap, eps(&mut numbers)).unwrap();
        if count % 3 == 0 {
            osc = osc.with_damping(numbers.between(0.0, 0.3)).unwrap();
        }
        if count % 2 == 0 {
            let second = numbers.between(0.05 - gap, 2.0);
            osc = osc.with_second_stop(second, eps(&mut numbers)).unwrap();
        }
        for side in [Side::Upper, Side::Lower] {
            let Some(cycle) = from_release(&osc, side, DEFAULT_EVENTS).filter(|cycle| cycle.label.periods < 3) else {
                continue;
            };
            for (vary, low, high) in
                [(Parameter::InverseBeta, 0.4, 4.0), (Parameter::Restitution, 0.0, 0.8), (Parameter::Damping, 0.0, 1.0)]
            {
                for direction in [Direction::Up, Direction::Down] {
                    let points = branch(&osc, side, vary, (low, high), direction);
                    let last = points.last().unwrap();
                    let named = other(last) || last.event.is_some_and(|e| e.ends() && e != BranchEvent::NoConvergence);
                    assert!(named, "{:?} at {} of {:?} from {} of {osc:?}", last.event, last.value, vary, cycle.label);
                    followed += 1;
                }
            }
        }
    }
    assert!(followed > 150, "{followed}");
}

/// What a branch of a resting cycle is not asked for.
#[test]
fn what_cannot_be_followed() {
    let osc = Oscillator::from_inverse_beta(2.5, 0.25, 0.5).unwrap();
    let cycle = from_release(&osc, Side::Upper, DEFAULT_EVENTS).unwrap();
    let from = |osc: &Oscillator, cycle: &Cycle| {
        Branch::new(osc, cycle, Parameter::Gap, 0.0..=1.0, Direction::Up, BranchOptions::default()).map(|_| ())
    };
    assert_eq!(from(&osc, &cycle), Ok(()));
    // the cycle of another gap, and one where the mass is never released
    let other = Parameter::Gap.set(&osc, 0.5).unwrap();
    assert_eq!(from(&other, &cycle), Err(BranchError::NoCycle));
    let two = Oscillator::from_inverse_beta(2.5, 0.25, 0.5).unwrap().with_second_stop(0.6, 0.5).unwrap();
    let cycle = from_release(&two, Side::Upper, DEFAULT_EVENTS).unwrap();
    let branch =
        Branch::new(&two, &cycle, Parameter::SecondGap, 0.0..=2.0, Direction::Down, BranchOptions::default()).unwrap();
    let graze = branch.into_iter().find(|p| matches!(p.event, Some(BranchEvent::Grazing { .. }))).unwrap();
    let frame = Frame { plane: (Parameter::SecondGap, Parameter::Damping).into(), ranges: (0.0..=2.0, 0.0..=1.0) };
    let curve = Curve::through(&two, &graze, Parameter::SecondGap, &frame, CurveOptions::default());
    assert_eq!(curve.map(|_| ()), Err(BranchError::Rests));
    assert!(matches!(settle(&two, Start::at_rest(&two), &SettleOptions::default()).verdict, Verdict::Periodic(_)));
}

/// With restitution 0 the mass stays on the stop if the force does not pull it away at once. With any other one the impact throws it off: a
/// branch over the restitution that begins at 0 goes on where that force is zero.
#[test]
fn an_impact_with_a_rebound_needs_no_force() {
    let osc = Oscillator::new(2.887, 0.211, 0.0).unwrap().with_damping(0.1).unwrap();
    let found = find(&osc, Label::new(1, 2), FindOptions::default());
    let stable = found.iter().find(|orbit| orbit.cycle.stable()).unwrap();
    let vary = Parameter::Restitution;
    let branch = Branch::new(&osc, &stable.cycle, vary, 0.0..=0.885, Direction::Up, BranchOptions::default()).unwrap();
    let points: Vec<SolutionPoint> = branch.collect();
    assert_eq!(events(&points), [(0.885, BranchEvent::EndOfRange)]);
    assert!(points.iter().all(|point| point.physical && point.stable()));
}

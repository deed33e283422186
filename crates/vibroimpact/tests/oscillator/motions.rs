//! Motions between and at events: positions of the stops, crossings of a position, states at given times, and those in every period.

use vibroimpact::flight::Flight;
use vibroimpact::motion::{Crossing, EventKind, Level, Motion, Strobes, sample, states_at, stroboscopic_map};
use vibroimpact::{Oscillator, Side, Start, scenario, system::phase};

#[test]
fn two_stops_are_both_struck_and_never_passed() {
    let osc = Oscillator::new(0.8, 0.5, 0.7).unwrap().with_second_stop(0.4, 0.6).unwrap();
    let mut struck = [0, 0];
    let mut motion = Motion::new(&osc, Start::at_rest(&osc));
    for _ in 0..2000 {
        let Some(event) = motion.next() else { break };
        struck[usize::from(event.side == Side::Lower)] += 1;
        let leg = motion.leg().unwrap();
        for k in 0..=20 {
            let (x, _) = leg.state(&osc, leg.duration * f64::from(k) / 20.0);
            assert!((-0.4 - 1e-14..=0.5 + 1e-14).contains(&x), "{x}");
        }
    }
    assert!(struck[0] > 100 && struck[1] > 100, "{struck:?}");
}

/// The crossings lie where a finely sampled motion changes its side, and the closed form is at the position there.
#[test]
fn where_the_sampled_motion_changes_side() {
    for (point, position) in [(scenario::N, 0.0), (scenario::N, 0.2), (scenario::U, -1.0), (scenario::S, 0.7)] {
        let osc = point.oscillator();
        let start = Start { x: -1.3, v: 0.4, phase: 0.3 };
        let level = Level::new(&osc, position).unwrap();
        let found: Vec<Crossing> = level.crossings(start, 80.0).collect();
        let wave = sample(&osc, start, 80.0, 1e-3, 1_000_000);
        let changes: Vec<f64> = wave
            .windows(2)
            .filter(|pair| (pair[0].x - position) * (pair[1].x - position) < 0.0)
            .map(|pair| pair[0].time)
            .collect();
        assert!(changes.len() > 10);
        assert_eq!(found.len(), changes.len(), "{position}");
        for (crossing, time) in found.iter().zip(&changes) {
            assert!((crossing.time - time).abs() < 2e-3);
            let state = states_at(&osc, start, &[crossing.time])[0].unwrap();
            assert!((state.x - position).abs() < 1e-13 * (1.0 + state.v.abs()), "{}", state.x - position);
            assert!((state.v - crossing.velocity).abs() < 1e-12);
        }
    }
}

#[test]
fn with_two_stops_and_damping_and_from_the_position_itself() {
    let osc = Oscillator::new(0.8, 0.5, 0.7).unwrap().with_damping(0.02).unwrap();
    let osc = osc.with_second_stop(0.4, 0.6).unwrap();
    for start in [Start { x: 0.1, v: 1.0, phase: 0.0 }, Start { x: 0.1, v: 0.0, phase: 4.0 }] {
        let found: Vec<Crossing> = Level::new(&osc, 0.1).unwrap().crossings(start, 100.0).collect();
        assert!(found.len() > 20 && found[0].time > 0.0, "{found:?}");
        assert!(found.windows(2).all(|pair| pair[0].velocity * pair[1].velocity < 0.0));
    }
    assert!(Level::new(&osc, 0.5).is_err() && Level::new(&osc, -0.4).is_err() && Level::new(&osc, f64::NAN).is_err());
}

/// At the times of events the states are those after them, and between them those of the closed form.
#[test]
fn at_events_and_between() {
    let osc = scenario::N.oscillator();
    let start = Start { x: -1.0, v: 0.3, phase: 0.5 };
    let events: Vec<_> = Motion::new(&osc, start).take(60).collect();
    let times: Vec<f64> = events.iter().map(|event| event.time).collect();
    for (event, state) in events.iter().zip(states_at(&osc, start, &times)) {
        let EventKind::Impact { velocity_after, .. } = event.kind else { continue };
        let state = state.unwrap();
        assert!((state.x - osc.gap()).abs() < 1e-15 && (state.v - velocity_after).abs() < 1e-14);
        assert!(phase::difference(state.phase, event.phase).abs() < 1e-14);
    }
    let mut motion = Motion::new(&osc, start);
    for _ in 0..30 {
        motion.next();
        let leg = *motion.leg().unwrap();
        let time = leg.begin + 0.4 * leg.duration;
        let (x, v) = leg.state(&osc, 0.4 * leg.duration);
        let state = states_at(&osc, start, &[time])[0].unwrap();
        assert!((state.x - x).abs() < 1e-13 && (state.v - v).abs() < 1e-13);
    }
}

#[test]
fn after_the_last_event_and_before_the_start() {
    let pressed = Oscillator::new(0.9, -1.5, 0.5).unwrap();
    let start = Start { x: -3.0, v: 0.0, phase: 0.0 };
    let states = states_at(&pressed, start, &[-1.0, 0.0, 1e4]);
    assert_eq!((states[0], states[1]), (None, Some(start)));
    assert_eq!(states[2].map(|state| (state.x, state.v)), Some((-1.5, 0.0)));
    // a flight without end
    let far = Oscillator::new(0.5, 40.0, 0.5).unwrap();
    let rest = Start::at_rest(&far);
    assert!(states_at(&far, rest, &[1e5])[0].is_some_and(|state| state.x.abs() < 40.0));
}

/// The same states from the stroboscopic map, period by period.
#[test]
fn as_the_stroboscopic_map() {
    let osc = scenario::U.oscillator();
    let mut state = Start { x: 0.1, v: 0.2, phase: 1.5 };
    for strobe in Strobes::new(&osc, state, 1.5).take(20) {
        assert!((strobe.x - state.x).abs() < 1e-9 && (strobe.v - state.v).abs() < 1e-9, "{strobe:?} {state:?}");
        state = stroboscopic_map(&osc, state, 1000).unwrap().state;
    }
}

#[test]
fn motions_without_events_have_states_too() {
    let osc = Oscillator::new(0.5, 2.0, 0.5).unwrap().with_damping(0.2).unwrap();
    let free = Start::free_motion(&osc).unwrap();
    let strobe = Strobes::new(&osc, Start { x: 1.0, v: 0.0, phase: 3.0 }, 0.0).nth(100).unwrap();
    assert!((strobe.x - free.x).abs() < 1e-13 && (strobe.v - free.v).abs() < 1e-13, "{strobe:?}");
}

#[test]
fn without_impacts_it_is_the_flight() {
    let osc = Oscillator::new(1.0 / 0.7, 2.5, 0.5).unwrap();
    let start = Start { x: 0.1, v: 0.2, phase: 1.0 };
    let strobe = stroboscopic_map(&osc, start, 100).unwrap();
    let (x, v) = Flight::new(&osc, start).state(osc.period());
    assert_eq!((strobe.state.x, strobe.state.v, strobe.impacts), (x, v, 0));
}

#[test]
fn a_one_over_one_motion_is_a_fixed_point() {
    let osc = Oscillator::from_inverse_beta(1.3, 0.75, 0.5).unwrap();
    let start = Start { x: 0.75, v: -0.5 * 2.797_349_151_953_767_4, phase: 1.190_509_613_787_888_5 };
    // from just after an impact to just after the next one: the start is moved a little past the impact
    let later = Flight::new(&osc, start).state(0.1);
    let from = Start { x: later.0, v: later.1, phase: start.phase + 0.1 * osc.beta() };
    let strobe = stroboscopic_map(&osc, from, 100).unwrap();
    assert_eq!(strobe.impacts, 1);
    assert!((strobe.state.x - from.x).abs() < 1e-13 && (strobe.state.v - from.v).abs() < 1e-13);
}

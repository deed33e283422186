//! Where rests and holds begin and end along branches, against closed forms.

use crate::closed_forms::ball;
use std::f64::consts::PI;
use vibroimpact::continuation::{BranchOptions, Direction, MachineBranch, MachineBranchEvent, MachineFamily};
use vibroimpact::events::MachineStart;
use vibroimpact::machine::{Machine, MachineParts};
use vibroimpact::verdict::{MachineVerdict, SettleOptions, settle_machine};

/// An oscillator with dry friction (J. P. Den Hartog, Trans. ASME 53 (1931) 107-115).
pub(crate) fn den_hartog(beta: f64, friction: f64) -> Machine {
    let parts = MachineParts::new(["mass"])
        .with_mass(0, 1.0)
        .with_link(&[1.0], 1.0, 0.0)
        .with_frequency(beta)
        .with_force(0, 1, 1.0, 0.0)
        .with_joint("floor", &[1.0], friction, friction, 0.0);
    Machine::new(parts).unwrap()
}

/// The first event of the branch of the settled motion, and its value.
fn first_event(
    make: fn(f64) -> Machine,
    (from, start): (f64, &MachineStart),
    (range, direction): ((f64, f64), Direction),
) -> (MachineBranchEvent, f64) {
    let family = MachineFamily::new(move |value| Some(make(value)));
    let verdict = settle_machine(&make(from), start, &SettleOptions::default()).unwrap().verdict;
    let MachineVerdict::Periodic(cycle) = verdict else { panic!("{}", verdict.label()) };
    let range = range.0..=range.1;
    let branch = MachineBranch::new((&family, from), &cycle, &range, direction, BranchOptions::default()).unwrap();
    branch.into_iter().find_map(|point| point.event.map(|event| (event, point.value))).unwrap()
}

/// A ball without rebound on a vibrating table rests for a part of each period below the amplitude at which it lands in the
/// moment at which the table throws it again: sqrt(1 + pi^2), from both sides.
#[test]
fn a_ball_without_rebound() {
    let make = |gamma: f64| ball(gamma, 0.0);
    let expected = (1.0 + PI * PI).sqrt();
    for (from, direction, begins) in [(2.0, Direction::Up, false), (3.5, Direction::Down, true)] {
        let start = MachineStart { q: vec![from + 0.1], qdot: vec![0.0], phase: 0.0 };
        let (event, value) = first_event(make, (from, &start), ((0.5, 6.0), direction));
        assert_eq!(event, MachineBranchEvent::Sticking { stop: 0, begins }, "{value}");
        assert!((value - expected).abs() < 1e-12, "{value} {expected}");
    }
}

/// The mass holds at its turning points from the friction on at which the spring and the force together no longer exceed it
/// there: f = b^2 V / sqrt(1 + b^4 U^2) with V = 1/(1 - b^2) and U = sin(pi/b) / (b (1 + cos(pi/b))), by Den Hartog's
/// closed form of the motion that never holds.
#[test]
fn dry_friction() {
    let beta = 0.8_f64;
    let (v, u) = (1.0 / (1.0 - beta * beta), (PI / beta).sin() / (beta * (1.0 + (PI / beta).cos())));
    let expected = beta * beta * v / (1.0 + beta.powi(4) * u * u).sqrt();
    for (from, direction, begins) in [(0.7, Direction::Up, true), (0.85, Direction::Down, false)] {
        let start = MachineStart::default();
        let (event, value) =
            first_event(|friction| den_hartog(0.8, friction), (from, &start), ((0.001, 1.2), direction));
        assert_eq!(event, MachineBranchEvent::Holding { joint: 0, begins }, "{value}");
        assert!((value - expected).abs() < 1e-12, "{value} {expected}");
    }
}

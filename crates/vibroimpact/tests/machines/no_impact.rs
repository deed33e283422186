//! Motions without a further event, for ever: the steady part of each gap stays open, though the sum of its amplitudes does not.

use vibroimpact::events::{ContactStart, End, Limits, Motion, Start};
use vibroimpact::machine::{HarmonicMotion, Machine, MachineParts, Opening, StopLaw};
use vibroimpact::regime::ContactState;
use vibroimpact::verdict::{SettleOptions, settle_machine};

fn label(parts: MachineParts, start: &Start) -> String {
    let machine = Machine::new(parts).unwrap();
    settle_machine(&machine, start, &SettleOptions::default()).unwrap().verdict.label().into_owned()
}

fn from_rest(parts: MachineParts) -> String {
    label(parts, &Start::default())
}

/// The largest displacement of the steady motion is 0.45662, the sum of its amplitudes 0.61086 (closed form).
fn two_harmonics() -> MachineParts {
    MachineParts::new(["x"])
        .with_mass(0, 1.0)
        .with_link(&[1.0], 1.0, 0.1)
        .with_frequency(0.7)
        .with_force(0, 1, 0.25, 0.1)
        .with_force(0, 3, 0.0, 0.3)
}

/// 1. Between the largest displacement and the sum of the amplitudes there is no impact; before there is.
#[test]
fn between_the_maximum_and_the_sum_of_amplitudes() {
    for gap in [0.48, 0.5, 0.55, 0.6, 0.61, 0.62] {
        assert_eq!(from_rest(two_harmonics().with_rigid_stop("s", &[1.0], gap, 0.5)), "0", "{gap}");
    }
    assert_eq!(from_rest(two_harmonics().with_rigid_stop("s", &[1.0], 0.44, 0.5)), "1/1");
    // from rest an impact motion is reached here, as plain stepping finds too: impacts of speed 0.0336 every two periods
    assert_eq!(from_rest(two_harmonics().with_rigid_stop("s", &[1.0], 0.47, 0.5)), "1/2");
}

/// 2. The same with a stop that moves, with a soft stop, and with a preloaded one that stays closed in front of a rigid one.
#[test]
fn moving_and_staged_stops() {
    let mut moving = two_harmonics().with_rigid_stop("s", &[1.0], 0.65, 0.5);
    moving.stops[0].motion.push(HarmonicMotion { order: 2, cos: 0.1, sin: 0.05 });
    assert_eq!(from_rest(moving), "0");
    let soft = StopLaw::Compliant { stiffness: 40.0, damping: 2.0, preload: 0.0, opening: Opening::Force };
    assert_eq!(from_rest(two_harmonics().with_stop("s", &[1.0], 0.52, soft)), "0");
    // pressed into the first stage for ever: about 2.7 / 3 = 0.9 at most, with amplitudes beside it
    for gap in [1.5, 5.0] {
        let stage = StopLaw::Compliant { stiffness: 2.0, damping: 0.1, preload: 0.0, opening: Opening::Force };
        let staged = two_harmonics().with_constant(0, 2.7).with_stop("stage", &[1.0], 0.0, stage);
        let start = Start { q: vec![0.9], ..Start::default() };
        assert_eq!(label(staged.with_rigid_stop("end", &[1.0], gap, 0.5), &start), "0", "{gap}");
    }
}

/// 3. Bodies that move freely as a whole, with and without a damper to the ground and a constant force, beside a stop between
///    them that is out of reach: its gap does not see the drift.
#[test]
fn free_bodies() {
    for (ground, between) in [(0.1, 0.2), (0.0, 0.2), (0.1, 0.0), (4.0, 0.2), (0.0, 0.0), (1e-3, 1.0), (2.0, 2.0)] {
        for constant in [0.0, 0.3, -0.2] {
            for mass in [1.0, 0.37] {
                let parts = MachineParts::new(["a", "b"])
                    .with_mass(0, 1.0)
                    .with_mass(1, mass)
                    .with_link(&[1.0, -1.0], 1.0, between)
                    .with_link(&[1.0, 0.0], 0.0, ground)
                    .with_frequency(2.0)
                    .with_force(1, 1, 0.0, 0.1)
                    .with_constant(0, constant)
                    .with_rigid_stop("s", &[-1.0, 1.0], 3.0, 0.6);
                assert_eq!(from_rest(parts), "0", "{ground} {between} {constant} {mass}");
            }
        }
    }
}

/// 4. A free body that moves towards a stop reaches it, however slowly, and one that moves away does not.
#[test]
fn drifts_towards_and_away() {
    let body = |direction: f64| {
        MachineParts::new(["a"]).with_mass(0, 1.0).with_frequency(1.0).with_force(0, 1, 0.3, 0.0).with_rigid_stop(
            "wall",
            &[direction],
            1.0,
            0.8,
        )
    };
    let start = Start { qdot: vec![0.05], ..Start::default() };
    assert_eq!(label(body(-1.0), &start), "0");
    let machine = Machine::new(body(1.0)).unwrap();
    let settled =
        settle_machine(&machine, &start, &SettleOptions { max_impacts: 1, ..SettleOptions::default() }).unwrap();
    assert!(settled.impacts > 0, "{}", settled.verdict.label());
}

/// 5. Damping that couples modes which are nearly defective, so that the structure has no modes: the same answer.
#[test]
fn structures_without_modes() {
    let parts = |gap| {
        MachineParts::new(["a", "b"])
            .with_mass(0, 1.0)
            .with_mass(1, 1.0)
            .with_link(&[1.0, 0.0], 1.0, 0.595_126_65)
            .with_link(&[0.0, 1.0], 0.912_081_07, 0.05)
            .with_link(&[1.0, -1.0], 0.3, 0.0)
            .with_frequency(0.9)
            .with_force(0, 1, 0.3, 0.1)
            .with_force(1, 2, 0.2, 0.2)
            .with_force(0, 3, 0.2, 0.0)
            .with_rigid_stop("s", &[1.0, 0.0], gap, 0.6)
    };
    for gap in [1.0, 1.5, 3.0] {
        assert_eq!(from_rest(parts(gap)), "0", "{gap}");
    }
    assert_ne!(from_rest(parts(0.1)), "0");
    // a free pair whose damper to the ground makes two rates of decay meet
    let free = |gap| {
        MachineParts::new(["a", "b"])
            .with_mass(0, 1.0)
            .with_mass(1, 1.0)
            .with_link(&[1.0, -1.0], 1.0, 2.0)
            .with_link(&[1.0, 0.0], 0.0, 1e-7)
            .with_frequency(2.0)
            .with_force(1, 1, 0.0, 0.1)
            .with_rigid_stop("s", &[-1.0, 1.0], gap, 0.6)
    };
    assert_eq!(from_rest(free(3.0)), "0");
}

/// 6. Without damping, with frequencies that have no common period: each mode has its amplitude, and the harmonics their smallest
///    sum.
#[test]
fn undamped_modes() {
    let parts = |gap| {
        MachineParts::new(["x"])
            .with_mass(0, 1.0)
            .with_link(&[1.0], 1.0, 0.0)
            .with_frequency(std::f64::consts::SQRT_2)
            // the steady motion is 0.3 cos + 0.3 cos 2, whose smallest value is -0.3 * 9/8 = -0.3375, and not -0.6
            .with_force(0, 1, -0.3, 0.0)
            .with_force(0, 2, -2.1, 0.0)
            .with_rigid_stop("s", &[-1.0], gap, 0.6)
    };
    // beside the steady motion by 0.05
    let start = Start { q: vec![0.65], ..Start::default() };
    assert_eq!(label(parts(0.4), &start), "0");
    assert_ne!(label(parts(0.33), &start), "0");
}

/// 4. A harmonic without an amplitude has no effect, however fast it is: not on the steps of the search either.
#[test]
fn a_harmonic_without_an_amplitude_drives_nothing() {
    let events = |frequency: f64, order| {
        let spring = StopLaw::Compliant { stiffness: 1.0, damping: 0.0, preload: 0.0, opening: Opening::Force };
        let mut parts = MachineParts::new(["x"]).with_mass(0, 2.3).with_stop("s", &[1.0], -0.2, spring);
        parts = parts.with_frequency(frequency).with_force(0, order, 0.0, 0.0);
        parts.stops[0].motion.push(HarmonicMotion { order: 2, cos: 0.0, sin: 0.0 });
        let machine = Machine::new(parts).unwrap();
        let motion = Motion::new(&machine, &Start::default(), Limits::default()).unwrap();
        motion.take(3).map(|event| event.time.to_bits()).collect::<Vec<_>>()
    };
    let slow = events(1.0, 1);
    assert_eq!(slow.len(), 1, "the body leaves the spring and flies on");
    for frequency in [1e-100, 1e6, 1e100] {
        assert_eq!(events(frequency, 3), slow, "{frequency}");
    }
}

/// 7. A mode without damping beside one that decays, and a stop that the first does not reach by some rounding errors: after the
///    decay a period without an event shows that there is none.
#[test]
fn an_undamped_mode_beside_a_damped_one() {
    let parts = |gap| {
        MachineParts::new(["a", "b"])
            .with_mass(0, 1.0)
            .with_mass(1, 1.0)
            .with_link(&[1.0, 0.0], 1.0, 0.0)
            .with_link(&[0.0, 1.0], 3.0, 4.0)
            .with_rigid_stop("s", &[1.0, 1.0], gap, 0.5)
    };
    let end = |gap| {
        let machine = Machine::new(parts(gap)).unwrap();
        let start = Start { q: vec![-0.5, -0.1], ..Start::default() };
        let mut motion = Motion::new(&machine, &start, Limits::default()).unwrap();
        (motion.by_ref().count(), motion.end())
    };
    assert_eq!(end(0.5 + 2e-14), (0, Some(End::Never)));
    assert_eq!(end(0.5 + 4e-15), (0, Some(End::Never)));
    assert!(end(0.499).0 > 0);
}

/// 8. Without damping of the structure, but with a surface that comes back slowly: it meets the swing when it stands back by 0.2,
///    after 100 ln 4 = 138.6.
#[test]
fn a_surface_that_comes_back_is_waited_for() {
    let slow = StopLaw::Compliant { stiffness: 0.05, damping: 5.0, preload: 0.0, opening: Opening::Force };
    let parts =
        MachineParts::new(["a"]).with_mass(0, 1.0).with_link(&[1.0], 1.0, 0.0).with_stop("s", &[1.0], 0.3, slow);
    let machine = Machine::new(parts).unwrap();
    let contacts = vec![ContactStart { place: 0, state: ContactState::Open, surface: 0.8 }];
    let start = Start { q: vec![-0.5], contacts, ..Start::default() };
    let first = Motion::new(&machine, &start, Limits::default()).unwrap().next().unwrap();
    // the peak after that time is at 45 pi = 141.37
    assert!((138.6..141.4).contains(&first.time), "{first:?}");
}

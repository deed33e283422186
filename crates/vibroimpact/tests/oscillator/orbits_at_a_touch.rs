//! Solutions whose impact has no speed: the motion without that impact touches the stop, and they are no orbits.

use vibroimpact::orbit::{FindOptions, find, one_impact, refine};
use vibroimpact::{Label, Oscillator};

const FEW: FindOptions = FindOptions { seeds: (24, 12), tolerance: 1e-7 };

/// Speeds of all impacts of all orbits of some labels.
fn speeds(osc: &Oscillator) -> Vec<f64> {
    let labels = [(1, 1), (1, 2), (1, 3), (2, 1), (2, 2), (2, 3), (3, 2)].map(|(m, n)| Label::new(m, n));
    let orbits = labels.iter().flat_map(|label| find(osc, *label, FEW));
    orbits.filter(|orbit| orbit.physical).flat_map(|orbit| orbit.cycle.points).map(|p| p.state.velocity).collect()
}

/// Item 5: beta 3, gap 1/8: delta = |f| exactly, and orbits of speed 1.3e-16 were listed as motions.
#[test]
fn f05_a_touch_is_no_impact() {
    let osc = Oscillator::new(3.0, 0.125, 0.5).unwrap();
    assert_eq!(one_impact(&osc, 1).len(), 0);
    // the one root of the quadratic that is not zero
    let two = one_impact(&osc, 2);
    assert!(two.len() == 1 && two[0].physical && (two[0].cycle.points[0].state.velocity - 0.556_730_6).abs() < 1e-7);
    assert!(speeds(&osc).iter().all(|speed| *speed > 0.1), "{:?}", speeds(&osc));
}

/// The family: other frequencies, gaps rounded to |f|, dampings, restitutions and a second stop.
#[test]
fn f05b_at_the_amplitude_of_the_motion_without_impacts() {
    let mut found = 0;
    for beta in [0.3, 0.7, 2.0, 2.5, 1.0 / 0.7] {
        for damping in [0.0, 0.1] {
            for restitution in [0.0, 0.8] {
                let far = Oscillator::new(beta, 100.0, restitution).unwrap().with_damping(damping).unwrap();
                let gap = far.free_amplitude();
                let osc = Oscillator::new(beta, gap, restitution).unwrap().with_damping(damping).unwrap();
                let all = speeds(&osc);
                assert!(all.iter().all(|speed| *speed > 1e-6), "{osc:?} {all:?}");
                found += all.len();
                if let Ok(two) = osc.with_second_stop(1.5 * gap, restitution) {
                    let all = speeds(&two);
                    assert!(all.iter().all(|speed| *speed > 1e-6), "{two:?} {all:?}");
                }
            }
        }
    }
    assert!(found > 20, "{found}");
}

/// A little inside the touch the orbit is there, as slow as it may be, by its closed form and by Newton's method; followed to the
/// touch it is none.
#[test]
fn f05c_beside_the_touch_it_exists() {
    let at = |gap: f64| Oscillator::new(3.0, gap, 0.5).unwrap();
    let mut rates = Vec::new();
    for off in [1e-4, 1e-6, 1e-9, 1e-12] {
        let orbits = one_impact(&at(0.125 - off), 1);
        let slow = orbits.iter().find(|orbit| orbit.cycle.points[0].state.velocity < 100.0 * off).unwrap();
        let speed = slow.cycle.points[0].state.velocity;
        rates.push(speed / off);
        let refined = refine(&at(0.125 - off), &slow.cycle).unwrap();
        assert!(refined.physical && slow.physical, "{off:e} {slow:?} {refined:?}");
        assert!((refined.cycle.points[0].state.velocity - speed).abs() < 1e-13);
        let touch = refine(&at(0.125), &slow.cycle).unwrap();
        assert!(!touch.physical && touch.earlier.is_some_and(|contact| contact.time == 0.0), "{touch:?}");
    }
    // in proportion to the distance, to as many digits as the gap leaves of it
    assert!(rates.iter().all(|rate| *rate > 1.0 && (rate / rates[1] - 1.0).abs() < 1e-3), "{rates:?}");
}

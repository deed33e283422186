//! A small mass between a spring and a damper stands for a node without mass. Its fast decay does not set the steps of a search.

use vibroimpact::events::{Event, Limits, Motion, Start};
use vibroimpact::machine::{Machine, MachineParts, Opening, StopLaw};

/// A body on a spring, and beside it a spring and a damper in series, with a node of this mass between them.
fn machine(mass: f64, at_node: bool, law: StopLaw) -> Machine {
    let parts = MachineParts::new(["body", "node"])
        .with_mass(0, 1.0)
        .with_mass(1, mass)
        .with_link(&[1.0, 0.0], 1.0, 0.0)
        .with_link(&[1.0, -1.0], 5.0, 0.0)
        .with_link(&[0.0, 1.0], 0.0, 0.7)
        .with_frequency(1.3)
        .with_force(0, 1, 0.0, 1.0);
    let direction = if at_node { [0.0, 1.0] } else { [1.0, 0.0] };
    Machine::new(parts.with_stop("stop", &direction, 0.3, law)).unwrap()
}

fn events(machine: &Machine) -> Vec<Event> {
    let mut motion = Motion::new(machine, &Start::default(), Limits::default()).unwrap();
    let events: Vec<Event> = motion.by_ref().take(20).collect();
    assert!(events.len() == 20, "{:?} after {} events", motion.end(), events.len());
    events
}

/// Events at small masses differ by what the masses change, and that is small.
#[test]
fn a13_a_small_mass_is_a_node() {
    let soft = StopLaw::Compliant { stiffness: 100.0, damping: 3.0, preload: 0.0, opening: Opening::Force };
    let undamped = StopLaw::Compliant { stiffness: 100.0, damping: 0.0, preload: 0.0, opening: Opening::Force };
    let rigid = StopLaw::Rigid { restitution: 0.6 };
    let small: &[f64] = &[1e-12, 1e-9, 1e-6];
    // the surface of a damped stop that stands back, and its force, still need steps as short as the fast decay
    let cases =
        [(false, rigid, small), (false, undamped, small), (false, soft, &[1e-6, 1e-5]), (true, soft, &[1e-6, 1e-5])];
    for (at_node, law, masses) in cases {
        let least = events(&machine(masses[0], at_node, law));
        for mass in masses[1..].iter().copied() {
            for (one, other) in events(&machine(mass, at_node, law)).iter().zip(&least) {
                assert_eq!((one.kind, one.place), (other.kind, other.place), "{mass} {law:?}");
                let allowed = 1e-8 + 100.0 * mass;
                assert!((one.time - other.time).abs() < allowed, "{mass} {law:?}: {} {}", one.time, other.time);
                assert!((one.q[0] - other.q[0]).abs() < allowed, "{mass} {law:?}: {:?} {:?}", one.q, other.q);
            }
        }
    }
}

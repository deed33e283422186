//! Numbers of machines that are known in closed form.

use core::f64::consts::PI;
use vibroimpact::continuation::{
    BranchEvent, BranchOptions, Direction,
    machine::{Branch, Family},
};
use vibroimpact::events::{Event, EventKind, Limits, Motion, Start};
use vibroimpact::machine::{HarmonicMotion, Machine, MachineParts, Opening, SpringDamper, StopLaw};
use vibroimpact::verdict::{SettleOptions, Verdict, settle_machine};

fn events(machine: &Machine, start: &Start) -> impl Iterator<Item = Event> {
    Motion::new(machine, start, Limits::default()).unwrap()
}

fn soft(stiffness: f64, damping: f64) -> StopLaw {
    StopLaw::Compliant { stiffness, damping, preload: 0.0, opening: Opening::Force }
}

/// A ball on a table that moves with acceleration Gamma times gravity.
pub(crate) fn ball(gamma: f64, e: f64) -> Machine {
    let mut parts = MachineParts::new(["height"])
        .with_mass(0, 1.0)
        .with_constant(0, -1.0)
        .with_frequency(1.0)
        .with_rigid_stop("table", &[-1.0], 0.0, e);
    // the table is at Gamma sin t
    parts.stops[0].motion.push(HarmonicMotion { order: 1, cos: 0.0, sin: gamma });
    Machine::new(parts).unwrap()
}

/// One impact in n periods of the table: it exists from Gamma = n pi (1 - e)/(1 + e), where it folds, and doubles at
/// Gamma^2 = that squared + (2 (1 + e^2)/(1 + e)^2)^2.
#[test]
fn ball_on_a_table() {
    for (n, e, between) in [(1.0, 0.5, 1.2), (1.0, 0.8, 0.8), (2.0, 0.6, 1.8)] {
        let fold: f64 = n * PI * (1.0 - e) / (1.0 + e);
        let flip = fold.hypot(2.0 * (1.0 + e * e) / ((1.0 + e) * (1.0 + e)));
        assert!(fold < between && between < flip);
        let machine = ball(between, e);
        // it leaves the table with half of the time of flight as its velocity; at phases round the circle
        let cycle = (0..48)
            .find_map(|k| {
                let phase = 2.0 * PI * f64::from(k) / 48.0;
                let (height, rate) = (between * phase.sin(), between * phase.cos());
                let start = Start { q: vec![height + 1e-9], qdot: vec![rate + n * PI], phase, ..Start::default() };
                let settled = settle_machine(&machine, &start, &SettleOptions::default()).unwrap();
                match settled.verdict {
                    Verdict::Periodic(cycle) if cycle.label.to_string() == format!("1/{n}") => Some(cycle),
                    _ => None,
                }
            })
            .expect("the locked motion is stable between the fold and the flip");
        let family = Family::new(move |gamma| (gamma > 0.0).then(|| ball(gamma, e)));
        for (direction, kind, value) in
            [(Direction::Up, BranchEvent::Flip, flip), (Direction::Down, BranchEvent::Fold, fold)]
        {
            let mut branch =
                Branch::new((&family, between), &cycle, &(0.1..=4.0), direction, BranchOptions::default()).unwrap();
            let point = branch.find(|point| point.event.is_some()).unwrap();
            assert_eq!(point.event, Some(kind), "{n} {e} {}", point.value);
            assert!((point.value - value).abs() < 1e-11, "{n} {e} {kind:?}: {} {value}", point.value);
        }
    }
}

/// Den Hartog's oscillator with Coulomb friction: x'' + x + f sgn x' = cos b t has the amplitude 2.626104875723 at b = 0.8,
/// f = 0.3.
#[test]
fn coulomb_friction() {
    let parts = MachineParts::new(["x"])
        .with_mass(0, 1.0)
        .with_link(&[1.0], 1.0, 0.0)
        .with_frequency(0.8)
        .with_force(0, 1, 1.0, 0.0)
        .with_joint("friction", &[1.0], 0.3, 0.3, 0.0);
    let machine = Machine::new(parts).unwrap();
    let start = Start { q: vec![2.5], ..Start::default() };
    let settled = settle_machine(&machine, &start, &SettleOptions::default()).unwrap();
    let Verdict::Periodic(cycle) = settled.verdict else { panic!("{settled:?}") };
    // it turns round at its largest displacements
    let amplitude = cycle.events.iter().map(|event| event.q[0].abs()).fold(0.0, f64::max);
    assert!((amplitude - 2.626_104_875_723).abs() < 1e-12, "{amplitude}");
}

/// Elastic balls of masses 1 and 100^k and a wall collide as often as pi has digits.
#[test]
fn digits_of_pi() {
    for (k, expected) in [(0, 3), (1, 31), (2, 314), (3, 3141), (4, 31415)] {
        let parts = MachineParts::new(["light", "heavy"])
            .with_mass(0, 1.0)
            .with_mass(1, 100.0_f64.powi(k))
            .with_rigid_stop("wall", &[-1.0, 0.0], 0.0, 1.0)
            .with_rigid_stop("balls", &[1.0, -1.0], 0.0, 1.0);
        let machine = Machine::new(parts).unwrap();
        let start = Start { q: vec![1.0, 2.0], qdot: vec![0.0, -1.0], phase: 0.0, ..Start::default() };
        let count = events(&machine, &start).filter(|event| event.kind == EventKind::Impact).count();
        assert_eq!(count, expected, "mass 100^{k}");
    }
}

/// A mass of 100 at speed 1 on a spring of 1e4 and a stop of 1e6 at gap 0 (code_aster's test SDND101, in closed form): how
/// long it touches, and what the stop pushes.
#[test]
fn a_stiff_spring() {
    let parts = MachineParts::new(["x"]).with_mass(0, 100.0).with_link(&[1.0], 1e4, 0.0).with_stop(
        "stop",
        &[1.0],
        0.0,
        soft(1e6, 0.0),
    );
    let machine = Machine::new(parts).unwrap();
    let start = Start { qdot: vec![1.0], ..Start::default() };
    let found: Vec<Event> = events(&machine, &start).take(2).collect();
    assert_eq!(found[1].kind, EventKind::Open);
    assert!((found[1].time - found[0].time - 0.031_260_015).abs() < 5e-10, "{}", found[1].time);
    // the impulse of the stop: that of both springs less that of the own one, m (v0 - v1) k_stop / (k_stop + k)
    let impulse = 100.0 * (1.0 - found[1].qdot[0]) * 1e6 / 1.01e6;
    assert!((impulse - 198.019_802).abs() < 5e-7, "{impulse}");
}

/// A gear pair x'' + d x' = 4 pi d - 4 pi^2 e cos 2 pi t - 2 pi d e sin 2 pi t rests on one flank iff
/// e < 2 d / sqrt(4 pi^2 + d^2).
#[test]
fn quiet_gears() {
    for d in [0.1, 0.4, 1.3] {
        let limit = 2.0 * d / (4.0 * PI * PI + d * d).sqrt();
        let gears = |e: f64| {
            let parts = MachineParts::new(["x"])
                .with_mass(0, 1.0)
                .with_link(&[1.0], 0.0, d)
                .with_constant(0, 4.0 * PI * d)
                .with_frequency(2.0 * PI)
                .with_force(0, 1, -4.0 * PI * PI * e, -2.0 * PI * d * e)
                .with_rigid_stop("front", &[1.0], 0.1, 0.8)
                .with_rigid_stop("back", &[-1.0], 0.1, 0.8);
            Machine::new(parts).unwrap()
        };
        let settled = |e: f64| {
            let start = Start { q: vec![0.1], ..Start::default() };
            settle_machine(&gears(e), &start, &SettleOptions::default()).unwrap().verdict
        };
        assert!(
            matches!(settled(limit * (1.0 - 1e-9)), Verdict::Stuck(_)),
            "{d} {:?}",
            settled(limit * (1.0 - 1e-9)).label()
        );
        assert!(!matches!(settled(limit * (1.0 + 1e-9)), Verdict::Stuck(_)), "{d}");
    }
}

/// A soft stop of growing stiffness tends to the rigid one with the restitution of its damping; the times of impacts are
/// wrong by the order of k^(-1/2).
#[test]
fn soft_stops_become_rigid() {
    let z: f64 = 0.2;
    // the restitution of a damped stop that opens at zero force
    let root = (1.0 - z * z).sqrt();
    let e = (-(z / root) * (2.0 * z * root).atan2(2.0 * z * z - 1.0)).exp();
    assert!((e - 0.571_740_027_585).abs() < 1e-12);
    let machine = |law: StopLaw| {
        let parts = MachineParts::new(["x"])
            .with_mass(0, 1.0)
            .with_link(&[1.0], 1.0, 0.02)
            .with_frequency(0.7)
            .with_force(0, 1, 0.0, 1.0);
        Machine::new(parts.with_stop("stop", &[1.0], 0.3, law)).unwrap()
    };
    let third = |machine: &Machine| {
        let strikes = |event: &Event| matches!(event.kind, EventKind::Impact | EventKind::Close);
        events(machine, &Start::default()).filter(strikes).nth(2).unwrap().time
    };
    let rigid = third(&machine(StopLaw::Rigid { restitution: e }));
    let errors: Vec<f64> =
        [1e6_f64, 1e8, 1e10].iter().map(|k| (third(&machine(soft(*k, 2.0 * z * k.sqrt()))) - rigid).abs()).collect();
    for pair in errors.windows(2) {
        let ratio = pair[0] / pair[1];
        // a hundred times stiffer: ten times closer
        assert!((9.0..11.0).contains(&ratio), "{errors:?}");
    }
}

/// An impact damper of vanishing mass in a structure that moves as A sin t, with the clearance half-width b: two impacts a
/// cycle exist iff A/b >= s / sqrt(pi^2/4 + s^2), s = (1 - r)/(1 + r); for r = 0.6 from 0.157176725478.
#[test]
fn a_light_impact_damper() {
    let damper = |b: f64| {
        let mut parts = MachineParts::new(["ball"])
            .with_mass(0, 1.0)
            .with_frequency(1.0)
            .with_rigid_stop("right", &[1.0], b, 0.6)
            .with_rigid_stop("left", &[-1.0], b, 0.6);
        // the walls move with the structure
        parts.stops[0].motion.push(HarmonicMotion { order: 1, cos: 0.0, sin: -1.0 });
        parts.stops[1].motion.push(HarmonicMotion { order: 1, cos: 0.0, sin: 1.0 });
        Machine::new(parts).unwrap()
    };
    let begin = 1.0 / 0.4;
    let machine = damper(begin);
    let cycle = (0..40)
        .find_map(|k| {
            let phase = f64::from(k) * PI / 20.0;
            let start = Start { qdot: vec![2.0], phase, ..Start::default() };
            match settle_machine(&machine, &start, &SettleOptions::default()).unwrap().verdict {
                Verdict::Periodic(cycle) if cycle.label.to_string() == "2/1" => Some(cycle),
                _ => None,
            }
        })
        .expect("two impacts a cycle");
    let family = Family::new(move |b| (b > 0.0).then(|| damper(b)));
    let branch = Branch::new((&family, begin), &cycle, &(0.5..=12.0), Direction::Up, BranchOptions::default()).unwrap();
    let fold = branch.into_iter().find(|point| point.event == Some(BranchEvent::Fold)).unwrap();
    assert!((1.0 / fold.value - 0.157_176_725_478).abs() < 1e-12, "{}", 1.0 / fold.value);
}

/// A free mass strikes a spring with a damper: it leaves with the restitution, after the time and at the depth of the closed form.
#[test]
fn a_mass_on_a_spring_and_a_damper() {
    let (mass, stiffness, speed) = (2.0, 50.0, 0.7);
    for opening in [Opening::Force, Opening::Position] {
        for ratio in [0.0, 0.05, 0.4, 0.6, 0.95, 1.0, 1.4, 5.0] {
            let damping = 2.0 * ratio * f64::sqrt(stiffness * mass);
            let contact = SpringDamper::new(mass, stiffness, damping, opening).unwrap();
            if contact.contact_time().is_infinite() {
                continue;
            }
            let law = StopLaw::Compliant { stiffness, damping, preload: 0.0, opening };
            let parts = MachineParts::new(["mass"]).with_mass(0, mass).with_stop("wall", &[1.0], 0.0, law);
            let machine = Machine::new(parts).unwrap();
            let start = Start { q: vec![-speed], qdot: vec![speed], ..Start::default() };
            let [close, open] = &events(&machine, &start).take(2).collect::<Vec<_>>()[..] else { panic!("two events") };
            assert_eq!((close.kind, open.kind), (EventKind::Close, EventKind::Open));
            let told = [open.time - close.time, open.q[0], -open.qdot[0] / speed];
            let wanted = [contact.contact_time(), contact.residual_depth(speed), contact.restitution()];
            for (told, wanted) in told.into_iter().zip(wanted) {
                assert!((told - wanted).abs() < 1e-12, "{contact:?}: {told} {wanted}");
            }
        }
    }
}

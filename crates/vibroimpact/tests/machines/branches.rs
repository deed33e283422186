//! Branches of machines of one coordinate against those of the oscillator.

use vibroimpact::continuation::{Branch, BranchEvent, BranchOptions, Direction, MachineBranch, MachineBranchEvent};
use vibroimpact::events::MachineStart;
use vibroimpact::machine::{Machine, MachineParts};
use vibroimpact::verdict::{MachineVerdict, SettleOptions, Verdict, settle, settle_machine};
use vibroimpact::{Oscillator, Parameter, Start};

fn of(osc: &Oscillator) -> Machine {
    let parts = MachineParts::new(["mass"])
        .with_mass(0, 1.0)
        .with_link(&[1.0], 1.0, 2.0 * osc.damping())
        .with_frequency(osc.beta())
        .with_force(0, 1, 0.0, 1.0)
        .with_rigid_stop("stop", &[1.0], osc.gap(), osc.restitution());
    Machine::new(parts).unwrap()
}

#[test]
fn the_same_events() {
    for (inverse, gap, eps, zeta, start, range, direction) in [
        (1.11, 1.0, 0.5, 0.0, (0.0, 0.0), (0.0, 4.0), Direction::Up),
        (1.3, 0.75, 0.5, 0.05, (0.0, 0.0), (0.1, 2.0), Direction::Up),
        (1.3, 0.75, 0.5, 0.05, (0.0, 0.0), (0.1, 2.0), Direction::Down),
        (0.8, 0.5, 0.7, 0.1, (0.0, 0.0), (0.0, 3.0), Direction::Up),
    ] {
        let osc = Oscillator::from_inverse_beta(inverse, gap, eps).unwrap().with_damping(zeta).unwrap();
        let (x, v) = start;
        let options = SettleOptions::default();
        let Verdict::Periodic(cycle) = settle(&osc, Start { x, v, phase: 0.0 }, &options).verdict else { panic!() };
        let machine = of(&osc);
        let own = MachineStart { q: vec![x], qdot: vec![v], phase: 0.0 };
        let MachineVerdict::Periodic(found) = settle_machine(&machine, &own, &options).unwrap().verdict else {
            panic!()
        };
        let range = range.0..=range.1;
        let expected: Vec<_> =
            Branch::new(&osc, &cycle, Parameter::Gap, range.clone(), direction, BranchOptions::default())
                .unwrap()
                .filter_map(|point| point.event.map(|event| (event, point.value)))
                .collect();
        let events: Vec<_> =
            MachineBranch::new(&machine, &found, "stop.stop.gap", &range, direction, BranchOptions::default())
                .unwrap()
                .filter_map(|point| point.event.map(|event| (event, point.value)))
                .collect();
        assert_eq!(events.len(), expected.len(), "{expected:?} {events:?}");
        for ((want, at), (event, value)) in expected.iter().zip(&events) {
            assert_eq!(want.name(), event.name());
            assert!((at - value).abs() < 1e-9, "{} {at} {value}", want.name());
            if let (BranchEvent::Grazing { turns, .. }, MachineBranchEvent::Grazing { turns: found, .. }) =
                (want, event)
            {
                assert_eq!(turns, found);
            }
        }
    }
}

#[test]
#[ignore = "prints"]
fn explore() {
    use vibroimpact::machine::{Opening, StopLaw};
    let mut state = 5_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(state >> 33).unwrap()) / f64::from(1_u32 << 31)
    };
    for case in 0..24 {
        let mut parts = MachineParts::new(["a", "b"])
            .with_mass(0, 1.0)
            .with_mass(1, 0.5 + random())
            .with_link(&[1.0, -1.0], 0.5 + random(), 0.05 + 0.2 * random())
            .with_link(&[0.0, 1.0], 0.5 + random(), 0.05 + 0.2 * random())
            .with_frequency(0.5 + random())
            .with_force(1, 1, 0.3, 0.9);
        let gap = 0.2 + 0.8 * random();
        let soft = |preload, damping, opening| StopLaw::Compliant { stiffness: 20.0, damping, preload, opening };
        let name = ["rigid", "soft", "damped", "preload", "friction", "inelastic"][case % 6];
        parts = match case % 6 {
            0 => parts.with_rigid_stop("stop", &[1.0, 0.0], gap, 0.4 + 0.5 * random()),
            1 => parts.with_stop("stop", &[1.0, 0.0], gap, soft(0.0, 0.0, Opening::Force)),
            2 => parts.with_stop("stop", &[1.0, -1.0], gap, soft(0.0, 0.8, Opening::Force)),
            3 => parts.with_stop("stop", &[1.0, 0.0], gap, soft(0.3, 0.0, Opening::Position)),
            4 => parts.with_rigid_stop("stop", &[1.0, 0.0], gap, 0.6).with_joint("floor", &[0.0, 1.0], 0.2, 0.2, 0.0),
            _ => parts.with_rigid_stop("stop", &[1.0, 0.0], gap, 0.0),
        };
        let machine = Machine::new(parts).unwrap();
        let options = SettleOptions::default();
        let settled = settle_machine(&machine, &MachineStart::default(), &options).unwrap();
        let label = settled.verdict.label();
        eprintln!(
            "case {case} {name} gap {gap:.3} frequency {:.3}: {label} {:?}",
            machine.number("frequency").unwrap(),
            settled.events
        );
        let MachineVerdict::Periodic(found) = settled.verdict else { continue };
        for (path, range) in [("stop.stop.gap", -0.2..=2.0), ("frequency", 0.3..=2.0)] {
            for direction in [Direction::Up, Direction::Down] {
                let now = std::time::Instant::now();
                let branch = MachineBranch::new(
                    &machine,
                    &found,
                    path,
                    &range,
                    direction,
                    BranchOptions { points: 600, ..BranchOptions::default() },
                );
                let branch = match branch {
                    Ok(branch) => branch,
                    Err(error) => {
                        eprintln!("   {error}");
                        continue;
                    }
                };
                let points: Vec<_> = branch.collect();
                eprintln!("  {path} {direction:?} {} points {:?}", points.len(), now.elapsed());
                for point in &points {
                    if let Some(event) = point.event {
                        eprintln!(
                            "     {:.9} {event:?} {} {:?} largest {:.4}",
                            point.value,
                            point.cycle.label,
                            point.cycle.counts,
                            point.cycle.multipliers[0].modulus()
                        );
                    }
                }
            }
        }
    }
}

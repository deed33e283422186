//! Stability in three words, rests on different stops, and chaos that is followed to the end of the budget.

use core::f64::consts::{FRAC_PI_2, PI};
use vibroimpact::continuation::{
    BranchEvent, BranchOptions, Direction,
    machine::{Branch, Family},
};
use vibroimpact::events::Start;
use vibroimpact::machine::{HarmonicMotion, Machine, MachineParts, Opening, StopLaw};
use vibroimpact::orbit::{find_machine_while, machine::Cycle};
use vibroimpact::verdict::{
    Census, Chaos, SettleOptions, Stability, Verdict, scattered_machine_starts, settle_machine,
};

fn settled(machine: &Machine, start: &Start) -> Verdict<Machine> {
    settle_machine(machine, start, &SettleOptions::default()).unwrap().verdict
}

/// An elastic ball between a wall at 0 and a wall at 1 + eps sin t.
fn fermi(eps: f64) -> Machine {
    let elastic = StopLaw::Rigid { restitution: 1.0 };
    let mut parts = MachineParts::new(["ball"])
        .with_mass(0, 1.0)
        .with_frequency(1.0)
        .with_stop("fixed", &[-1.0], 0.0, elastic)
        .with_stop("moving", &[1.0], 1.0, elastic);
    parts.stops[1].motion.push(HarmonicMotion { order: 1, cos: 0.0, sin: -eps });
    Machine::new(parts).unwrap()
}

/// On the orbit that strikes each wall once in a period, the moving one where it turns: speed (1 + eps) / pi, half way between
/// the walls at phase 0. The trace of its derivative is 2 - 4 pi^2 eps / (1 + eps).
fn on_orbit(eps: f64) -> Start {
    let length = 1.0 + eps;
    Start { q: vec![0.5 * length], qdot: vec![length / PI], phase: 0.0, ..Start::default() }
}

/// 42.5: the multipliers lie on the unit circle until they meet at -1, where pi^2 eps = 1 + eps.
#[test]
fn an_elliptic_family_is_neutral_and_has_no_events() {
    let flip = 1.0 / (PI * PI - 1.0);
    for eps in [1e-3, 0.01, 0.05, 0.1, 0.11] {
        let Verdict::Periodic(cycle) = settled(&fermi(eps), &on_orbit(eps)) else { panic!("{eps}") };
        assert_eq!((cycle.label.to_string().as_str(), cycle.stability()), ("2/1", Stability::Neutral), "{eps}");
        assert!(!cycle.stable());
        let trace: f64 = cycle.multipliers.iter().map(|one| one.re).sum();
        assert!((trace - (2.0 - 4.0 * PI * PI * eps / (1.0 + eps))).abs() < 1e-10, "{eps} {trace}");
        assert!(cycle.events.iter().any(|event| event.place == 1 && (event.phase - FRAC_PI_2).abs() < 1e-9));
    }
    let family = Family::new(|eps| (eps > 0.0).then(|| fermi(eps)));
    let Verdict::Periodic(cycle) = settled(&fermi(0.05), &on_orbit(0.05)) else { panic!() };
    let branch = |range: core::ops::RangeInclusive<f64>, direction| {
        Branch::new((&family, 0.05), &cycle, &range, direction, BranchOptions::default()).unwrap()
    };
    let down: Vec<_> = branch(1e-3..=0.05, Direction::Down).collect();
    assert!(down.len() > 5 && down.iter().all(|point| point.cycle.stability() == Stability::Neutral));
    let events: Vec<_> = down.iter().filter_map(|point| point.event).collect();
    assert_eq!(events, [BranchEvent::EndOfRange]);
    // up to the flip and beyond
    let up: Vec<_> = branch(0.05..=0.15, Direction::Up).collect();
    let events: Vec<_> = up.iter().filter_map(|point| point.event).collect();
    assert_eq!(events, [BranchEvent::Flip, BranchEvent::EndOfRange]);
    let at = up.iter().position(|point| point.event == Some(BranchEvent::Flip)).unwrap();
    assert!((up[at].value - flip).abs() < 1e-11, "{} {flip}", up[at].value);
    assert!(up[..at].iter().all(|point| point.cycle.stability() == Stability::Neutral));
    assert!(up[at + 1..].iter().all(|point| point.cycle.stability() == Stability::Unstable));
}

/// Elastic machines without damping: one body between two stops, one of which moves; two bodies with rigid, soft and stiff
/// stops; three of very different frequencies.
fn conservative() -> Vec<(&'static str, Machine)> {
    let soft = |stiffness| StopLaw::Compliant { stiffness, damping: 0.0, preload: 0.0, opening: Opening::Force };
    let rigid = StopLaw::Rigid { restitution: 1.0 };
    let two = |law| {
        MachineParts::new(["a", "b"])
            .with_mass(0, 1.0)
            .with_mass(1, 0.8)
            .with_link(&[1.0, -1.0], 1.1, 0.0)
            .with_link(&[0.0, 1.0], 0.9, 0.0)
            .with_frequency(0.8)
            .with_force(1, 1, 0.0, 0.3)
            .with_stop("stop", &[1.0, 0.0], 0.3, law)
    };
    let three = MachineParts::new(["a", "b", "c"])
        .with_mass(0, 1.0)
        .with_mass(1, 0.8)
        .with_mass(2, 0.8)
        .with_link(&[1.0, -1.0, 0.0], 1.1, 0.0)
        .with_link(&[0.0, 1.0, -1.0], 300.0, 0.0)
        .with_link(&[0.0, 0.0, 1.0], 0.9, 0.0)
        .with_frequency(0.7)
        .with_force(0, 1, 0.2, 0.1)
        .with_stop("left", &[-1.0, 0.0, 0.0], 0.4, soft(1e5))
        .with_stop("right", &[0.0, 1.0, 0.0], 0.5, rigid);
    let machines = [("rigid", two(rigid)), ("soft", two(soft(20.0))), ("stiff", two(soft(1e6))), ("three", three)];
    let machines = machines.map(|(name, parts)| (name, Machine::new(parts).unwrap()));
    machines.into_iter().chain([("fermi", fermi(0.05))]).collect()
}

/// Along the branch of a neutral cycle no point is stable, and no event is one of rounding: pairs of multipliers whose product is 1
/// everywhere cross nothing.
fn followed(name: &str, machine: &Machine, cycle: &Cycle) {
    let (family, value) = Family::of_path(machine, "frequency").unwrap();
    let range = 0.9 * value..=1.1 * value;
    let options = BranchOptions { points: 60, ..BranchOptions::default() };
    let Ok(branch) = Branch::new((&family, value), cycle, &range, Direction::Up, options) else { return };
    for point in branch {
        assert!(!point.cycle.stable(), "{name} {} {:?}", point.value, point.cycle.multipliers);
        assert_ne!(point.event, Some(BranchEvent::Torus), "{name} {} {:?}", point.value, point.cycle.multipliers);
    }
}

/// 42.5: without losses no cycle is stable, whatever its length: multipliers within rounding of the circle are neutral.
#[test]
fn without_losses_no_cycle_is_stable() {
    let (mut neutral, mut unstable) = (0, 0);
    for (name, machine) in conservative() {
        for label in ["1/1", "2/1", "2/2"] {
            let starts = (0..20).map(|k| scattered_machine_starts(&machine, 1, k));
            for cycle in find_machine_while(&machine, label.parse().unwrap(), starts, &|| true).unwrap() {
                let off = cycle.multipliers.iter().map(|one| (one.modulus() - 1.0).abs()).fold(0.0, f64::max);
                match cycle.stability() {
                    Stability::Stable => panic!("{name} {label} {:?}", cycle.multipliers),
                    Stability::Neutral => {
                        neutral += 1;
                        followed(name, &machine, &cycle);
                    }
                    Stability::Unstable => {
                        assert!(off > 1e-7, "{name} {label} {:?}", cycle.multipliers);
                        unstable += 1;
                    }
                }
            }
        }
    }
    assert!(neutral >= 4 && unstable >= 4, "{neutral} {unstable}");
}

/// 42.5: the structure decides where no further event follows; a joint that holds keeps its place, so there are rests beside it.
#[test]
fn motions_without_events_have_a_stability() {
    let parts = |damping: f64| {
        MachineParts::new(["a", "b"])
            .with_mass(0, 1.0)
            .with_mass(1, 1.0)
            .with_link(&[1.0, 0.0], 1.0, damping)
            .with_link(&[1.0, -1.0], 2.0, damping)
            .with_frequency(0.3)
            .with_force(0, 1, 0.0, 0.1)
    };
    let rest = |parts: MachineParts| {
        let machine = Machine::new(parts).unwrap();
        let verdict = settled(&machine, &Start::default());
        assert!(matches!(verdict, Verdict::NoImpact(_)), "{}", verdict.label());
        verdict.stability(&machine)
    };
    assert_eq!(rest(parts(0.1)), Some(Stability::Stable));
    assert_eq!(rest(parts(1e-6)), Some(Stability::Stable));
    assert_eq!(rest(parts(0.0)), Some(Stability::Neutral));
    // it holds wherever it is
    assert_eq!(rest(parts(0.1).with_joint("hold", &[0.0, 1.0], 9.0, 9.0, 0.0)), Some(Stability::Neutral));
}

/// A slider that friction holds, and a hammer on it between two stops.
fn slider() -> Machine {
    let parts = MachineParts::new(["slider", "hammer"])
        .with_mass(0, 1.0)
        .with_mass(1, 1.0)
        .with_link(&[1.0, -1.0], 1.0, 0.2)
        .with_frequency(1.0)
        .with_force(1, 1, 0.05, 0.0)
        .with_rigid_stop("right", &[0.0, 1.0], 1.0, 0.5)
        .with_rigid_stop("left", &[0.0, -1.0], 1.0, 0.5)
        .with_joint("ground", &[1.0, 0.0], 5.0, 5.0, 0.0);
    Machine::new(parts).unwrap()
}

/// 42.8: rests on different stops are different motions, and a rest in which only the place of a joint differs is the same.
#[test]
fn rests_on_different_stops() {
    let machine = slider();
    let mut census = Census::default();
    let from = |slider: f64, hammer: f64| {
        settled(&machine, &Start { q: vec![slider, hammer], qdot: vec![0.0; 2], phase: 0.0, ..Start::default() })
    };
    for (slider, stop) in [(3.0, 0), (2.0, 0), (-3.0, 1), (-2.0, 1), (2.5, 0)] {
        let verdict = from(slider, 0.3);
        assert_eq!((&*verdict.label(), verdict.closed()), ("stuck", vec![stop]), "{slider}");
        census.add(&verdict);
    }
    let counts: Vec<u64> = census.motions().iter().map(|found| found.count).collect();
    assert_eq!(counts, [3, 2]);
    assert!(!from(3.0, 0.0).same_as(&from(-3.0, 0.0), 1.0));
}

/// 42.5: a joint that holds all the time keeps its place, which is no reason to leave the motion of the rest undecided: it repeats,
/// and it is neutral, because beside it there are others with the joint elsewhere.
#[test]
fn cycles_beside_a_joint_that_holds() {
    let machine = slider();
    let mut fastest = Vec::new();
    for (slider, stop) in [(1.0, 0), (1.02, 0), (-1.0, 1)] {
        let start = Start { q: vec![slider, 0.0], qdot: vec![0.0; 2], phase: 0.0, ..Start::default() };
        let verdict = settled(&machine, &start);
        let Verdict::Periodic(cycle) = verdict else { panic!("{slider} {verdict:?}") };
        assert_eq!(cycle.stability(), Stability::Neutral, "{:?}", cycle.multipliers);
        assert!(cycle.events.iter().all(|event| event.place == stop && (event.q[0] - slider).abs() < 1e-12));
        let one = cycle.multipliers.iter().filter(|m| (m.re - 1.0).abs() < 1e-12 && m.im == 0.0).count();
        assert_eq!(one, 1, "{:?}", cycle.multipliers);
        fastest.push(cycle.fastest());
    }
    assert!((fastest[0] - fastest[2]).abs() < 1e-9, "{fastest:?}");
}

/// 42.8: also of compliant stops, which push for ever while the label is 0.
#[test]
fn contacts_with_different_compliant_stops() {
    let soft = StopLaw::Compliant { stiffness: 50.0, damping: 1.0, preload: 0.0, opening: Opening::Force };
    let parts = MachineParts::new(["slider", "hammer"])
        .with_mass(0, 1.0)
        .with_mass(1, 1.0)
        .with_link(&[1.0, -1.0], 1.0, 0.2)
        .with_stop("right", &[0.0, 1.0], 1.0, soft)
        .with_stop("left", &[0.0, -1.0], 1.0, soft)
        .with_joint("ground", &[1.0, 0.0], 5.0, 5.0, 0.0);
    let machine = Machine::new(parts).unwrap();
    let from = |slider: f64| {
        settled(&machine, &Start { q: vec![slider, 0.0], qdot: vec![0.0; 2], phase: 0.0, ..Start::default() })
    };
    let (right, left) = (from(3.0), from(-3.0));
    assert_eq!((&*right.label(), right.closed(), left.closed()), ("0", vec![0], vec![1]));
    assert!(!right.same_as(&left, 1.0) && right.same_as(&from(2.8), 1.0));
}

/// A structure of three coordinates with three compliant stops, two of them stiff.
fn long_transient() -> (Machine, Start) {
    let soft = |stiffness, damping| StopLaw::Compliant { stiffness, damping, preload: 0.0, opening: Opening::Position };
    let mut parts = MachineParts::new(["x1", "x2", "x3"])
        .with_mass(0, 1.151)
        .with_mass(1, 0.3236)
        .with_mass(2, 2.706)
        .with_frequency(1.743)
        .with_force(0, 1, 0.8068, -0.0504)
        .with_force(2, 1, 0.4877, 0.257)
        .with_stop("s0", &[0.5778, 0.9634, 0.82], 0.5865, soft(389.5, 52.34))
        .with_stop("s1", &[-1.0, 0.0, 1.0], 0.1934, soft(49980.0, 23.76))
        .with_stop("s2", &[1.0, 0.0, -1.0], 0.3786, soft(1222.0, 16.39));
    for (i, constant) in [0.0013, 0.2998, 0.3128].into_iter().enumerate() {
        parts = parts.with_constant(i, constant);
    }
    let rows = |values: [[f64; 3]; 3], matrix: &mut vibroimpact::math::Matrix| {
        for (i, row) in values.into_iter().enumerate() {
            for (j, value) in row.into_iter().enumerate() {
                matrix[(i, j)] = value;
            }
        }
    };
    let stiffness = [[7.08, -3.534, 0.0], [-3.534, 3.8682, -0.3342], [0.0, -0.3342, 0.3342]];
    let damping = [[0.13005, -0.01095, 0.0], [-0.01095, 0.02223, -0.01128], [0.0, -0.01128, 0.07717]];
    rows(stiffness, &mut parts.stiffness);
    rows(damping, &mut parts.damping);
    let start = Start {
        q: vec![-0.1479, -0.0759, 0.2969],
        qdot: vec![-0.4201, 0.976, -0.0398],
        phase: 2.1116,
        ..Start::default()
    };
    (Machine::new(parts).unwrap(), start)
}

/// 42.9: chaos is followed to the end of the budget, and how far is said.
#[test]
fn chaos_lasts_as_long_as_the_budget() {
    let (machine, first) = long_transient();
    let settled = |start: &Start, budget: u64| {
        settle_machine(&machine, start, &SettleOptions::at_most(u32::try_from(budget).unwrap())).unwrap()
    };
    // how long chaos lasts from a start depends on rounding errors: one from which it lasts long
    let starts = (0..40).map(|k| {
        let mut start = first.clone();
        start.q[0] += 1e-3 * f64::from(k);
        start
    });
    let long = |start: &Start| {
        let whole = settled(start, 20_000);
        (whole.verdict.label() == "9/4" && whole.impacts > 4_000).then_some(whole)
    };
    let (start, whole) = starts.into_iter().find_map(|start| long(&start).map(|whole| (start, whole))).unwrap();
    // it ends within the default budget
    assert!(whole.transient.is_some_and(|chaos| chaos.spectrum.exponents[0].value > 0.0));
    let budget = whole.impacts / 2;
    let short = settled(&start, budget);
    let Verdict::Chaotic(Chaos { impacts: events, .. }) = &short.verdict else { panic!("{}", short.verdict.label()) };
    assert!(*events >= budget && short.impacts == *events && short.verdict.seen_events() == Some(*events));
    assert_eq!(short.verdict.stability(&machine), Some(Stability::Unstable));
}

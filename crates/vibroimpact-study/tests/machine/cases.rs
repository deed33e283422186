//! Machines that symmetry, equal bodies, contact at the start, dependent contacts and friction beside a stop make degenerate, by
//! number. Each was answered wrongly once; `cases/NAME.toml` is the machine of `cNN_NAME`.

use core::f64::consts::{FRAC_PI_2, PI};
use vibroimpact::chaos::machine_exponents_while;
use vibroimpact::continuation::{
    BranchEvent, BranchOptions, Direction,
    machine::{Branch, Family},
};
use vibroimpact::events::{End, Event, EventKind, Limits, Motion, Start};
use vibroimpact::machine::{ImpactLaw, Machine};
use vibroimpact::orbit::machine::Cycle;
use vibroimpact::verdict::{Chaos, SettleOptions, Stability, Undecided, UndecidedCause, Verdict, settle_machine};
use vibroimpact_study::machine::{MachineSource, no_files};

/// A machine file with other numbers, and its start.
struct Case(MachineSource);

impl Case {
    fn named(name: &str) -> Self {
        let path = format!("{}/tests/machine/cases/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        Self(MachineSource::from_text(&std::fs::read_to_string(path).unwrap(), no_files).unwrap())
    }

    fn of_catalogue(name: &str) -> Self {
        Self(MachineSource::of_catalogue(name).unwrap())
    }

    fn with(self, path: &str, value: f64) -> Self {
        Self(self.0.with(path, value).unwrap())
    }

    fn machine(&self) -> Machine {
        self.0.machine().unwrap()
    }

    fn start(&self) -> Start {
        let start = self.0.start().unwrap();
        Start { q: start.q, qdot: start.qdot, phase: start.phase, ..Start::default() }
    }

    /// The first events from its start, and why there are no more.
    fn events(&self, most: usize) -> (Vec<Event>, Option<End>) {
        events(&self.machine(), &self.start(), most)
    }

    fn settled(&self) -> Verdict<Machine> {
        settled(&self.machine(), &self.start())
    }

    fn label(&self) -> String {
        self.settled().label().into_owned()
    }

    fn cycle(&self) -> Cycle {
        match self.settled() {
            Verdict::Periodic(cycle) => cycle,
            other => panic!("{}", other.label()),
        }
    }
}

fn settled(machine: &Machine, start: &Start) -> Verdict<Machine> {
    settle_machine(machine, start, &SettleOptions::default()).unwrap().verdict
}

fn events(machine: &Machine, start: &Start, most: usize) -> (Vec<Event>, Option<End>) {
    let mut motion = Motion::new(machine, start, Limits::default()).unwrap();
    let events = motion.by_ref().take(most).collect();
    (events, motion.end())
}

fn at(q: &[f64], qdot: &[f64]) -> Start {
    Start { q: q.to_vec(), qdot: qdot.to_vec(), ..Start::default() }
}

fn close(one: f64, other: f64, error: f64) -> bool {
    (one - other).abs() <= error * (1.0 + other.abs())
}

/// A body at rest on a stop without a load hides no impact of another one: at pi/6 with the speed sqrt(3)/2.
#[test]
fn c01_idle_rest() {
    let (found, end) = Case::named("idle-rest").events(6);
    let impact = found.iter().find(|event| event.kind == EventKind::Impact).unwrap();
    assert!(close(impact.time, PI / 6.0, 1e-15) && close(impact.speed, 0.75_f64.sqrt(), 1e-15), "{impact:?}");
    assert_ne!(end, Some(End::SearchLimit));
}

/// Two equal bodies that touch strike the wall together (DOP853, rtol 1e-12).
#[test]
fn c02_twin() {
    let (found, _) = Case::named("twin").events(4);
    let wall = found.iter().find(|event| event.kind == EventKind::Impact && event.place == 0).unwrap();
    assert!(close(wall.time, 3.528_402_82, 1e-8), "{wall:?}");
    let (apart, _) = Case::named("twin").with("stop.c.gap", 1e-12).events(4);
    let other = apart.iter().find(|event| event.kind == EventKind::Impact && event.place == 0).unwrap();
    assert!(close(wall.time, other.time, 1e-11), "{wall:?} {other:?}");
}

/// Two equal oscillators that touch and never press move as one: no impact.
#[test]
fn c03_touching_twins() {
    let verdict = Case::named("touching-twins").settled();
    assert_eq!((&*verdict.label(), matches!(verdict, Verdict::Periodic(_))), ("0", false));
}

/// Two bodies without rebound on a table that shakes are one.
#[test]
fn c04_stack() {
    for amplitude in [1.2, 1.4, 1.6, 1.8, 2.0, 2.2, 2.4, 2.6, 2.8, 3.0] {
        let stack = Case::named("stack").with("stop.table.motion.1.sin", amplitude);
        let one = Case::of_catalogue("bouncing-ball").with("e", 0.0).with("Gamma", amplitude);
        assert_eq!(stack.label(), one.label(), "{amplitude}");
    }
}

/// Five equal balls in contact: together the energy is shared, in turn the last one leaves with the whole speed, as with gaps
/// of 1e-9.
#[test]
fn c05_cradle() {
    let case = Case::named("cradle");
    let (together, _) = case.events(4);
    let energy = |event: &Event| event.q.iter().chain(&event.qdot).map(|x| x * x).sum::<f64>() / 2.0;
    let first = energy(&together[0]);
    assert!(together.iter().all(|event| close(energy(event), first, 1e-14)), "{together:?}");
    let mut parts = case.machine().parts().clone();
    parts.impacts = ImpactLaw::InTurn;
    let (in_turn, _) = events(&Machine::new(parts).unwrap(), &case.start(), 8);
    let mut apart = Case::named("cradle");
    for stop in ["c1", "c2", "c3", "c4"] {
        apart = apart.with(&format!("stop.{stop}.gap"), 1e-9);
    }
    let (apart, _) = apart.events(4);
    for events in [&in_turn, &apart] {
        let last = events.iter().find(|event| close(event.qdot[4], 1.0, 1e-8)).unwrap();
        assert!(close(last.time, FRAC_PI_2, 1e-8) && last.qdot[..4].iter().all(|v| v.abs() < 1e-8), "{last:?}");
    }
}

/// A stop that is there twice, and a compliant stop at the place of a rigid one, change nothing.
#[test]
fn c06_same_stop_twice() {
    let one = Case::named("rigid-only").cycle();
    assert_eq!(one.label.to_string(), "3/1");
    for name in ["same-stop-twice", "rigid-and-compliant"] {
        let same = Case::named(name);
        let (found, _) = same.events(40);
        let impacts = |events: &[Event]| -> Vec<(f64, f64)> {
            let of = events.iter().filter(|event| event.kind == EventKind::Impact && event.speed > 1e-5);
            let mut all: Vec<(f64, f64)> = of.map(|event| (event.time, event.speed)).collect();
            all.dedup();
            all
        };
        let wanted = impacts(&Case::named("rigid-only").events(60).0);
        for ((time, speed), (of, by)) in impacts(&found).iter().zip(&wanted) {
            assert!(close(*time, *of, 1e-12) && close(*speed, *by, 1e-11), "{name}: {time} {of}");
        }
        let cycle = same.cycle();
        assert!(close(cycle.period, one.period, 1e-14), "{name}");
        for (own, of) in cycle.multipliers.iter().zip(&one.multipliers) {
            assert!((own.modulus() - of.modulus()).abs() < 1e-10, "{name}: {own:?} {of:?}");
        }
    }
}

/// Two friction joints on one coordinate are one of their sum.
#[test]
fn c07_two_joints() {
    let two = Case::named("two-joints");
    let mut one = two.machine().parts().clone();
    one.joints.truncate(1);
    one.joints[0].sliding *= 2.0;
    one.joints[0].limit *= 2.0;
    let one = settled(&Machine::new(one).unwrap(), &Start::default());
    assert_eq!(two.label(), one.label());
}

/// A chatter beside a friction joint is complete, and ends where force and friction balance: sin phase = (gap - sliding)/force.
#[test]
fn c08_friction_and_stop() {
    let cycle = Case::named("friction-and-stop").cycle();
    assert_eq!(cycle.label.to_string(), "inf/1");
    let release = cycle.events.iter().find(|event| event.kind == EventKind::Release).unwrap();
    assert!(close(release.phase, PI - 0.2_f64.asin(), 1e-14), "{release:?}");
}

/// The same oscillator twice is the oscillator: inf/n stays, other labels count twice as many impacts.
#[test]
fn c09_pair() {
    for restitution in [0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9] {
        let one = Case::named("single").with("stop.s.restitution", restitution).label();
        let two = Case::named("pair").with("stop.s.restitution", restitution).with("stop.t.restitution", restitution);
        let twice = match one.split_once('/') {
            Some((impacts, periods)) if impacts != "inf" => {
                format!("{}/{periods}", 2 * impacts.parse::<u32>().unwrap())
            }
            _ => one,
        };
        assert_eq!(two.label(), twice, "{restitution}");
    }
}

/// One ball twice.
#[test]
fn c10_two_balls() {
    let case = Case::named("two-balls");
    assert_eq!(settled(&case.machine(), &at(&[1.0, 1.0], &[])).label(), "inf/1");
}

/// Two beads without a load against a wall come to rest there (300 digits).
#[test]
fn c11_two_beads() {
    let (found, end) = Case::named("two-beads").with("r", 0.1).events(100_000);
    let last = found.last().unwrap();
    assert!(close(last.time, 0.852_136_674_048_54, 1e-13), "{last:?}");
    assert!(last.qdot.iter().all(|v| v.abs() < 1e-12) && end == Some(End::Stuck) || end == Some(End::Never));
    assert!(found.iter().filter(|event| event.kind == EventKind::Impact).all(|event| event.speed > 1e-15));
}

/// Five beads of a column come to rest on each other while those above fall on (300 digits).
#[test]
fn c12_column() {
    let (found, _) = Case::named("column").events(3_000);
    let rest = found.iter().find(|event| event.kind == EventKind::Collapse).unwrap();
    assert!(close(rest.time, 0.474_657_811_676_884, 1e-11), "{rest:?}");
    assert!(rest.qdot[..5].iter().all(|v| v.abs() < 1e-9) && rest.qdot[5..].iter().all(|v| *v < -1.0), "{rest:?}");
    assert!(close(rest.q[5] - rest.q[4], 0.045, 0.05), "{rest:?}");
}

/// A plate dropped flat on two supports stays flat.
#[test]
fn c13_plate() {
    let case = Case::named("plate");
    let (found, _) = events(&case.machine(), &at(&[1.0, 0.0], &[]), 4);
    assert!(found.iter().all(|event| event.q[1] == 0.0 && event.qdot[1] == 0.0), "{found:?}");
    assert!(found.iter().any(|event| close(event.qdot[0], 0.3 * 0.3 * 2.0_f64.sqrt(), 1e-14)), "{found:?}");
}

/// A bar on springs that strikes with both ends at once does not pitch, whatever its inertia.
#[test]
fn c14_bumpers() {
    // between about 0.31 and 0.45 it is unstable against pitch, which never begins
    for inertia in [0.25, 0.3, 0.35, 0.4, 0.44, 0.45, 0.5, 0.75, 1.0] {
        let cycle = Case::named("bumpers").with("frequency", 0.9).with("mass.pitch", inertia).cycle();
        assert_eq!(cycle.label.to_string(), "4/1", "{inertia}");
        assert_eq!(cycle.stability() == Stability::Unstable, (0.31..=0.45).contains(&inertia), "{inertia}");
        assert!(cycle.events.iter().all(|event| event.q[1].abs() < 1e-20 && event.qdot[1] == 0.0), "{inertia}");
    }
}

/// A bar that lands flat on two feet comes to rest as a ball would: at sqrt(2/g) (1 + 2 e/(1 - e)).
#[test]
fn c15_bar() {
    for inertia in [0.25, 1.0 / 3.0, 1.0, 2.0] {
        let (found, _) = Case::named("bar").with("J", inertia).events(400);
        let rest = found.iter().find(|event| event.kind == EventKind::Stick).unwrap();
        assert!(close(rest.time, 3.0 * (2.0 / 9.81_f64).sqrt(), 1e-13), "{inertia}: {rest:?}");
        assert!(found.iter().all(|event| event.q[1] == 0.0), "{inertia}");
    }
}

/// A symmetric tube in loose damped supports goes on, whatever opens together.
#[test]
fn c16_tube() {
    let machine = Case::named("tube").machine();
    let mut motion = Motion::new(&machine, &Start::default(), Limits::default()).unwrap();
    let period = 2.0 * PI / machine.parts().frequency.unwrap();
    let last = motion.by_ref().take(200_000).find(|event| event.time > 40.0 * period);
    assert!(last.is_some(), "{:?}", motion.end());
}

/// Rests on different stops are different motions.
#[test]
fn c17_stuck() {
    let machine = Case::named("stuck").machine();
    let [right, left] = [3.0, -3.0].map(|slider| settled(&machine, &at(&[slider, 0.0], &[])));
    assert_eq!((right.closed(), left.closed()), (vec![0], vec![1]));
    assert!(!right.same_as(&left, 1.0));
}

/// Two free bodies on a spring: the stop between them is out of reach.
#[test]
fn c18_free_pair() {
    assert_eq!(Case::named("free-pair").label(), "0");
}

/// No impact where the gap is larger than the largest displacement, 0.45662, though smaller than the sum of the amplitudes. Up to
/// 0.47 a cycle 1/2 is beside that motion, and rest leads to it: an integration that shares nothing with this one (matrix exponentials,
/// 4000 steps a period, and DOP853) ends in it with impacts at 0.033604, and stays without impacts from the steady motion.
#[test]
fn c19_harmonics() {
    for gap in [0.475, 0.48, 0.5, 0.55, 0.6] {
        assert_eq!(Case::named("harmonics").with("stop.s.gap", gap).label(), "0", "{gap}");
    }
    let both = Case::named("harmonics").with("stop.s.gap", 0.47);
    let cycle = both.cycle();
    assert_eq!(cycle.label.to_string(), "1/2");
    assert!(close(cycle.fastest(), 0.033_604, 1e-6), "{}", cycle.fastest());
    let steady = at(&[0.449_319_541_060_794_97], &[-0.003_109_310_204_249_316]);
    assert_eq!(settled(&both.machine(), &steady).label(), "0");
    assert_ne!(Case::named("harmonics").with("stop.s.gap", 0.456).label(), "0");
}

/// The exponents of a cycle through an overdamped stop (77 digits at 20), and their sum by Liouville.
#[test]
fn c20_overdamped() {
    let exponents = |damping: f64| -> Vec<f64> {
        let machine = Case::named("overdamped").with("stop.s.damping", damping).machine();
        let start = Start::default();
        let found = machine_exponents_while(&machine, &start, (4_000, 500), &|| true).unwrap().unwrap();
        found.exponents.iter().map(|exponent| exponent.value).collect()
    };
    let at_20 = exponents(20.0);
    assert!(close(at_20[0], -3.27243, 2e-6) && close(at_20[1], -4.49465, 2e-6), "{at_20:?}");
    for (damping, sum) in [(60.0, -25.265), (100.0, -44.933)] {
        let found = exponents(damping);
        assert!(close(found.iter().sum(), sum, 2e-5), "{damping}: {found:?}");
    }
}

/// An elastic ball between a wall and a moving wall: all multipliers lie on the unit circle, and no branch has an event by
/// rounding errors.
#[test]
fn c21_fermi() {
    let case = Case::named("fermi");
    let on_orbit = |eps: f64| at(&[0.5 * (1.0 + eps)], &[(1.0 + eps) / PI]);
    let Verdict::Periodic(cycle) = settled(&case.machine(), &on_orbit(0.05)) else { panic!() };
    assert_eq!((cycle.label.to_string().as_str(), cycle.stability()), ("2/1", Stability::Neutral));
    let trace: f64 = cycle.multipliers.iter().map(|one| one.re).sum();
    assert!(close(trace, 2.0 - 4.0 * PI * PI * 0.05 / 1.05, 1e-10), "{trace}");
    let family = Family::new(|eps| Case::named("fermi").0.with("eps", eps).ok()?.machine().ok());
    let options = BranchOptions::default();
    let branch = Branch::new((&family, 0.05), &cycle, &(0.001..=0.05), Direction::Down, options).unwrap();
    let points: Vec<_> = branch.collect();
    assert!(points.len() > 5 && points.iter().all(|point| point.cycle.stability() == Stability::Neutral));
    let events: Vec<_> = points.iter().filter_map(|point| point.event).collect();
    assert_eq!(events, [BranchEvent::EndOfRange]);
    assert!(cycle.events.iter().any(|event| event.place == 1 && close(event.phase, FRAC_PI_2, 1e-9)));
}

/// Chaos that ends within the budget is none; where the budget is shorter the verdict says over how many events it was seen.
#[test]
fn c22_transient_chaos() {
    let case = Case::named("transient-chaos");
    let start = case.start();
    for budget in [4_000, 20_000] {
        let settled = settle_machine(&case.machine(), &start, &SettleOptions::at_most(budget)).unwrap();
        match &settled.verdict {
            Verdict::Chaotic(Chaos { impacts: events, .. }) => {
                assert_eq!((*events, settled.impacts), (u64::from(budget), u64::from(budget)));
            }
            other => assert_eq!(other.label(), "9/4"),
        }
    }
}

/// A branch goes on where a hold vanishes.
#[test]
fn c23_hold_vanishes() {
    let case = Case::named("hold-vanishes");
    let (machine, cycle) = (case.machine(), case.cycle());
    let (family, value) = Family::of_path(&machine, "mass.x1").unwrap();
    let options = BranchOptions { points: 400, ..BranchOptions::default() };
    let range = 0.918..=value;
    let points: Vec<_> = Branch::new((&family, value), &cycle, &range, Direction::Down, options).unwrap().collect();
    let events: Vec<_> = points.iter().filter_map(|point| Some((point.event?, point.value))).collect();
    let holding = BranchEvent::Holding { joint: 2, begins: false };
    assert!(events.iter().any(|(event, value)| *event == holding && close(*value, 1.075_901_139, 1e-8)), "{events:?}");
    assert!(matches!(events.last(), Some((BranchEvent::EndOfRange, _))), "{events:?}");
}

/// The branch of N over its gap has the events of the branch of the oscillator that it is (equations of its own), and takes no
/// more than a few times as long: see `tests/one_coordinate` of the core.
#[test]
fn c24_n() {
    let case = Case::named("n");
    let (machine, cycle) = (case.machine(), case.cycle());
    assert_eq!(cycle.label.to_string(), "4/1");
    let (family, value) = Family::of_path(&machine, "stop.stop.gap").unwrap();
    let range = value..=0.6;
    let options = BranchOptions::default();
    let branch = Branch::new((&family, value), &cycle, &range, Direction::Up, options).unwrap();
    let events: Vec<_> = branch.filter_map(|point| Some((point.event?, point.value))).collect();
    let grazing = BranchEvent::Grazing { stop: 0, also: None, appears: false, turns: true, detail: None };
    for (event, value) in [
        (BranchEvent::Fold, 0.278_507_288_818_434_6),
        (grazing, 0.258_480_239_026_615_1),
        (BranchEvent::Fold, 0.524_722_695_377_955),
        (grazing, 0.509_859_364_490_333_4),
    ] {
        let near = |(of, at): &(BranchEvent, f64)| {
            core::mem::discriminant(of) == core::mem::discriminant(&event) && close(*at, value, 1e-13)
        };
        assert!(events.iter().any(near), "{event:?} at {value}: {events:?}");
    }
}

/// What doubles cannot know is not claimed: with 60 digits these are inf/38 and inf/122.
#[test]
fn c25_bouncing_ball() {
    for amplitude in [1.72, 5.0] {
        let case = Case::of_catalogue("bouncing-ball").with("Gamma", amplitude).with("e", 0.5);
        let verdict = settled(&case.machine(), &at(&[3.0], &[1.0]));
        let Verdict::Undecided(Undecided { why, .. }) = verdict else { panic!("{amplitude}: {}", verdict.label()) };
        assert_eq!(why, UndecidedCause::Unconfirmed, "{amplitude}");
    }
}

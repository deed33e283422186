//! Metres and seconds: every command gives the same numbers converted, in JSON and in its table, or a refusal.
#![allow(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

mod axes;
mod figures;
mod tables;

use crate::Folder;
use serde_json::Value;
use std::collections::BTreeSet;
use vibroimpact::QuantityKind;
use vibroimpact::quantities::Quantity;

/// A machine, and its conversion to nondimensional numbers by hand.
#[derive(Clone, Copy, Debug)]
struct Machine {
    mass: f64,
    stiffness: f64,
    force: f64,
    omega: f64,
    damping_ratio: f64,
    gap: f64,
    second_gap: Option<f64>,
    restitution: f64,
}

/// omega_n = 8 rad/s, F/k = 0.5 m: its units are powers of two, so that conversion is exact.
const MACHINE: Machine = Machine {
    mass: 1.0,
    stiffness: 64.0,
    force: 32.0,
    omega: 7.2,
    damping_ratio: 0.0,
    gap: 0.75,
    second_gap: None,
    restitution: 0.5,
};

impl Machine {
    /// Random machines; those with a second stop have damping too.
    fn random() -> impl Iterator<Item = Self> {
        let mut state = 20_261_123_u64;
        let mut part = move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            f64::from(u32::try_from(state >> 33).unwrap()) / f64::from(u32::MAX >> 1)
        };
        (0..12).map(move |k| {
            let (mass, stiffness, force) = (0.1 + 5.0 * part(), 200.0 + 2e4 * part(), 1.0 + 40.0 * part());
            let (length, natural) = (force / stiffness, (stiffness / mass).sqrt());
            Self {
                mass,
                stiffness,
                force,
                omega: natural * (0.6 + part()),
                damping_ratio: if k % 3 == 0 { 0.0 } else { 0.08 * part() },
                gap: length * (0.2 + part()),
                second_gap: (k % 3 == 2).then(|| length * (0.8 + part())),
                restitution: 0.4 + 0.5 * part(),
            }
        })
    }

    fn length(&self) -> f64 {
        self.force / self.stiffness
    }

    fn time(&self) -> f64 {
        1.0 / (self.stiffness / self.mass).sqrt()
    }

    fn velocity(&self) -> f64 {
        self.length() / self.time()
    }

    fn in_si(&self, without: &[&str]) -> String {
        let all = [
            ("--mass-kg", Some(self.mass)),
            ("--stiffness-n-per-m", Some(self.stiffness)),
            ("--force-n", Some(self.force)),
            ("--omega-rad-per-s", Some(self.omega)),
            ("--damping-ratio", Some(self.damping_ratio)),
            ("--gap-m", Some(self.gap)),
            ("--second-gap-m", self.second_gap),
            ("--restitution", Some(self.restitution)),
        ];
        given(&all, without)
    }

    fn by_hand(&self, without: &[&str]) -> String {
        let beta = self.omega / (self.stiffness / self.mass).sqrt();
        let all = [
            ("--beta", Some(beta)),
            ("--damping", Some(self.damping_ratio)),
            ("--gap", Some(self.gap / self.length())),
            ("--second-gap", self.second_gap.map(|gap| gap / self.length())),
            ("--restitution", Some(self.restitution)),
        ];
        given(&all, without)
    }

    /// The command line in SI units, and by hand.
    fn lines(&self, name: &str, rest: &str, without: &[&str]) -> (String, String) {
        let numbers = |si: bool| {
            let part = |part: &str| {
                let found = [("L=", self.length()), ("V=", self.velocity())];
                let found = found.into_iter().find_map(|(sign, unit)| Some((part.find(sign)?, unit)));
                let Some((at, unit)) = found else { return part.to_owned() };
                let given = part[at + 2..].parse::<f64>().unwrap() * unit;
                format!("{}{:?}", &part[..at], if si { given } else { given / unit })
            };
            let word = |word: &str| word.split(':').map(part).collect::<Vec<_>>().join(":");
            rest.split(' ').map(word).collect::<Vec<_>>().join(" ")
        };
        (
            format!("{name} {} --units si {}", self.in_si(&[]), numbers(true)),
            format!("{name} {} {}", self.by_hand(without), numbers(false)),
        )
    }
}

/// The flags that have a value, without some of them.
fn given(all: &[(&str, Option<f64>)], without: &[&str]) -> String {
    let given = all.iter().filter(|(flag, _)| !without.contains(flag));
    given.filter_map(|(flag, value)| Some(format!("{flag} {:?}", (*value)?))).collect::<Vec<_>>().join(" ")
}

/// A command with units.
struct Command {
    name: &'static str,
    /// Its flags, in which `L=` stands before a length and `V=` before a velocity.
    flags: &'static str,
    /// Flags of the nondimensional system that it does not take, because they vary.
    without: &'static [&'static str],
    store: bool,
    table: bool,
}

const fn command(name: &'static str, flags: &'static str, (store, table): (bool, bool)) -> Command {
    Command { name, flags, without: &[], store, table }
}

const COMMANDS: [Command; 10] = [
    command("simulate", "--x L=-0.3 --v V=0.5 --impacts 5", (false, true)),
    command("settle", "--x L=-0.3 --v V=0.5", (false, true)),
    command("attractors", "--starts 20", (true, true)),
    command("orbit", "--label 1/1", (false, false)),
    command("basin", "--x L=-0.5:L=0.1:6 --v V=-1:V=1:5", (true, true)),
    Command { without: &["--gap"], ..command("diagram", "--vary gap --over L=0.5:L=1.5:5 --keep 8", (true, true)) },
    command("branch", "--label 1/1 --vary gap --to L=2.25", (false, true)),
    command("curve", "--label 1/1 --kind flip --vary gap=L=1:L=2.5 --and restitution=0.45:0.55", (false, true)),
    Command {
        without: &["--beta", "--gap"],
        ..command("region", "--label 1/1 --beta 0.85:0.95 --gap L=1:L=2.5 --grid 3", (false, true))
    },
    command("lyapunov", "--impacts 1000 --x L=-0.3", (false, true)),
];

/// The unit of the numbers under a key, if the key determines it.
fn unit(machine: &Machine, key: &str) -> Option<f64> {
    let (length, time, velocity) = (machine.length(), machine.time(), machine.velocity());
    match key {
        "x" | "q" | "gap" => Some(length),
        "v" | "qdot" | "speed" | "fastest" => Some(velocity),
        "time" | "period" => Some(time),
        // the columns of quantities end in their units
        _ => Quantity::ALL.into_iter().find(|quantity| key == quantity.name()).map(|quantity| {
            let mass = machine.mass;
            match quantity.kind() {
                QuantityKind::Number => 1.0,
                QuantityKind::Length => length,
                QuantityKind::Velocity => velocity,
                QuantityKind::Acceleration => velocity / time,
                QuantityKind::Impulse => mass * velocity,
                QuantityKind::Energy => mass * velocity * velocity,
                QuantityKind::Force => mass * velocity / time,
                QuantityKind::Power => mass * velocity * velocity / time,
                QuantityKind::Rate => 1.0 / time,
            }
        }),
    }
}

fn units(machine: &Machine) -> Vec<f64> {
    vec![1.0, machine.length(), machine.time(), machine.velocity(), 1.0 / machine.time()]
}

/// The name of a column without its unit.
fn bare(head: &str) -> String {
    let suffixes = QuantityKind::ALL.map(QuantityKind::suffix).into_iter().chain(["_s"]).filter(|end| !end.is_empty());
    suffixes.filter_map(|end| head.strip_suffix(end)).min_by_key(|bare| bare.len()).unwrap_or(head).to_owned()
}

/// Equal but for the last digit, which the order of the multiplications determines.
fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 4.0 * f64::EPSILON * a.abs().max(b.abs())
}

/// Compares two results, and collects the factors by which numbers differ.
fn compare(machine: &Machine, path: &str, key: &str, plain: &Value, si: &Value, factors: &mut BTreeSet<String>) {
    match (plain, si) {
        (Value::Object(a), Value::Object(b)) => {
            assert!(a.keys().eq(b.keys()), "{path}: {a:?} {b:?}");
            for (name, value) in a {
                compare(machine, &format!("{path}.{name}"), name, value, &b[name], factors);
            }
        }
        // names of columns end in their units
        (Value::Array(a), Value::Array(b)) if key == "columns" => {
            let bare: Vec<Value> = b.iter().map(|name| Value::from(bare(name.as_str().unwrap()))).collect();
            assert_eq!(a, &bare, "{path}");
        }
        (Value::Array(a), Value::Array(b)) => {
            assert_eq!(a.len(), b.len(), "{path}");
            for (k, (a, b)) in a.iter().zip(b).enumerate() {
                compare(machine, &format!("{path}[{k}]"), key, a, b, factors);
            }
        }
        (Value::Number(a), Value::Number(b)) => {
            let (a, b) = (a.as_f64().unwrap(), b.as_f64().unwrap());
            number(machine, path, key, (a, b), factors);
        }
        (a, b) => assert_eq!(a, b, "{path}"),
    }
}

fn number(machine: &Machine, path: &str, key: &str, (a, b): (f64, f64), factors: &mut BTreeSet<String>) {
    let units = unit(machine, key).map_or_else(|| units(machine), |unit| vec![unit]);
    let Some(unit) = units.iter().find(|unit| near(a * **unit, b)) else { panic!("{path}: {a} and {b}") };
    factors.insert(unit.to_string());
}

/// The objects of both commands; `None` if neither has one.
fn both(plain: &str, si: &str) -> Option<[Value; 2]> {
    let [(a, plain, _), (b, si, complaint)] = [plain, si].map(|line| Folder::new().ran(&format!("{line} --json")));
    assert_eq!(a, b, "{complaint}");
    (a == Some(0)).then(|| [plain, si].map(|text| serde_json::from_str(&text).unwrap()))
}

/// Compares the object of a command with that by hand, and returns both; `None` if neither has one, because there is no such orbit.
fn same_json(machine: &Machine, Command { name, flags, without, .. }: &Command) -> Option<[Value; 2]> {
    let (si, plain) = machine.lines(name, flags, without);
    let [a, b] = both(&plain, &si)?;
    assert_eq!((a["units"].as_str(), b["units"].as_str()), (Some("nondimensional"), Some("si")), "{name}");
    let mut factors = BTreeSet::new();
    for (key, value) in a.as_object().unwrap() {
        // the plan is nondimensional in both results, and the system is reported as it was given
        if !["units", "plan", "system"].contains(&key.as_str()) {
            compare(machine, &format!("{si}\n{plain}\n{key}"), key, value, &b[key], &mut factors);
        }
    }
    assert!(factors.len() > 1 || *name == "attractors", "{name}: nothing is converted");
    Some([a, b])
}

/// The numbers of all commands are those by hand times the unit, to the last digit.
#[test]
fn f08_every_command_converts_its_json() {
    for command in &COMMANDS {
        let [a, b] = same_json(&MACHINE, command).expect("an answer");
        // the plans differ in their units alone
        let mut plan = b["plan"].clone();
        let units = plan.as_object_mut().unwrap().remove("units").unwrap();
        let machine = plan["system"].as_object_mut().unwrap().remove("machine");
        assert!(machine.is_some() || command.name == "region", "{}", command.name);
        assert_eq!((&a["plan"], units["length_m"].as_f64()), (&plan, Some(MACHINE.length())), "{}", command.name);
    }
    let mut compared = 0;
    for machine in Machine::random().take(6) {
        compared += COMMANDS.iter().filter(|command| same_json(&machine, command).is_some()).count();
    }
    assert!(compared > 35, "{compared} of 60");
}

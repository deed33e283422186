//! Metres and seconds: every command gives the same numbers converted, in JSON and in its table, or a refusal.
#![allow(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::{json, vibro};
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

    fn in_si(&self) -> String {
        let Self { mass, stiffness, force, omega, damping_ratio, gap, restitution, .. } = self;
        let second = self.second_gap.map_or_else(String::new, |gap| format!(" --second-gap-m {gap:?}"));
        format!(
            "--mass-kg {mass:?} --stiffness-n-per-m {stiffness:?} --force-n {force:?} --omega-rad-per-s {omega:?} \
             --damping-ratio {damping_ratio:?} --gap-m {gap:?}{second} --restitution {restitution:?} --units si"
        )
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
        let given = all.into_iter().filter(|(flag, _)| !without.contains(flag));
        given.filter_map(|(flag, value)| Some(format!("{flag} {:?}", value?))).collect::<Vec<_>>().join(" ")
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
            format!("{name} {} {}", self.in_si(), numbers(true)),
            format!("{name} {} {}", self.by_hand(without), numbers(false)),
        )
    }
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
        "x" | "gap" => Some(length),
        "v" | "velocity" | "velocity_before" | "velocity_after" => Some(velocity),
        "t" | "time" | "interval" => Some(time),
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

/// Compares the object of a command with that by hand; false if neither has one, because there is no such orbit.
fn same_json(machine: &Machine, Command { name, flags, without, .. }: &Command) -> bool {
    let (si, plain) = machine.lines(name, flags, without);
    let run = |line: &str| vibro(&format!("{line} --json")).output().unwrap();
    let (a, b) = (run(&plain), run(&si));
    assert_eq!(a.status.code(), b.status.code(), "{si}\n{plain}\n{}", String::from_utf8_lossy(&b.stderr));
    if !a.status.success() {
        return false;
    }
    let read = |output: &[u8]| serde_json::from_slice::<Value>(output).unwrap();
    let (a, b) = (read(&a.stdout), read(&b.stdout));
    assert_eq!((a["units"].as_str(), b["units"].as_str()), (Some("nondimensional"), Some("si")), "{name}");
    let mut factors = BTreeSet::new();
    for (key, value) in a.as_object().unwrap() {
        // the plan is nondimensional in both results, and the system is reported as it was given
        if !["units", "plan", "system"].contains(&key.as_str()) {
            compare(machine, &format!("{si}\n{plain}\n{key}"), key, value, &b[key], &mut factors);
        }
    }
    assert!(factors.len() > 1 || *name == "attractors", "{name}: nothing is converted");
    true
}

#[test]
fn f08_every_command_converts_its_json() {
    for command in &COMMANDS {
        assert!(same_json(&MACHINE, command), "{}", command.name);
        // the plans differ in their units alone
        let (si, plain) = MACHINE.lines(command.name, command.flags, command.without);
        let (a, b) = (json(&plain), json(&si));
        let mut plan = b["plan"].clone();
        let units = plan.as_object_mut().unwrap().remove("units").unwrap();
        let machine = plan["system"].as_object_mut().unwrap().remove("machine");
        assert!(machine.is_some() || command.name == "region", "{}", command.name);
        assert_eq!((&a["plan"], units["length_m"].as_f64()), (&plan, Some(MACHINE.length())), "{}", command.name);
    }
}

/// Random machines, all commands: the numbers are those by hand times the unit, to the last digit.
#[test]
fn random_machines_convert_their_json() {
    let mut compared = 0;
    for machine in Machine::random() {
        compared += COMMANDS.iter().filter(|command| same_json(&machine, command)).count();
    }
    assert!(compared > 70, "{compared} of 120");
}

fn rows(line: &str) -> Vec<Vec<String>> {
    let output = vibro(line).output().unwrap();
    assert!(output.status.success(), "{line}: {}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).unwrap();
    text.lines().map(|row| row.split(',').map(str::to_owned).collect()).collect()
}

/// Compares two tables: names of columns without their units, and the numbers.
fn same_table(machine: &Machine, name: &str, a: &[Vec<String>], b: &[Vec<String>]) {
    assert!(a.len() == b.len() && a.len() > 1, "{name}");
    assert_eq!(a[0], b[0].iter().map(|head| bare(head)).collect::<Vec<_>>(), "{name}");
    let mut factors = BTreeSet::new();
    for (left, right) in a.iter().zip(b).skip(1) {
        for ((head, left), right) in a[0].iter().zip(left).zip(right) {
            for (left, right) in left.split(' ').zip(right.split(' ')) {
                match (left.parse::<f64>(), right.parse::<f64>()) {
                    (Ok(left), Ok(right)) => {
                        number(machine, &format!("{name} {head}"), head, (left, right), &mut factors);
                    }
                    _ => assert_eq!(left, right, "{name} {head}"),
                }
            }
        }
    }
    assert!(factors.len() > 1 || name == "attractors", "{name}: nothing is converted");
}

#[test]
fn f08_every_command_converts_its_table() {
    for Command { name, flags, without, .. } in COMMANDS.iter().filter(|command| command.table) {
        let (si, plain) = MACHINE.lines(name, flags, without);
        let flag = if *name == "lyapunov" { " --points 20 --section -" } else { " --csv -" };
        same_table(&MACHINE, name, &rows(&(plain + flag)), &rows(&(si + flag)));
    }
}

/// A store keeps its units: the table exported from it is that of the command without a store.
#[test]
fn stores_keep_their_units() {
    let machines: Vec<Machine> = core::iter::once(MACHINE).chain(Machine::random().take(3)).collect();
    let stored: Vec<&Command> = COMMANDS.iter().filter(|command| command.store).collect();
    assert_eq!(stored.len(), 3, "attractors, basin and diagram");
    for (Command { name, flags, without, .. }, machine) in
        stored.iter().flat_map(|c| machines.iter().map(move |m| (c, m)))
    {
        let (si, plain) = machine.lines(name, flags, without);
        let tables = [("plain.zarr", plain), ("si.zarr", si)].map(|(place, line)| {
            let folder = tempfile::tempdir().unwrap();
            let filled = vibro(&format!("{line} --store {place} --quiet")).current_dir(&folder).output().unwrap();
            assert!(filled.status.success(), "{name}: {}", String::from_utf8_lossy(&filled.stderr));
            let again = vibro(&format!("{line} --store {place} --quiet --csv -")).current_dir(&folder).output();
            let exported = String::from_utf8(again.unwrap().stdout).unwrap();
            if *name != "attractors" {
                let printed = vibro(&format!("{line} --csv -")).output().unwrap().stdout;
                assert_eq!(exported, String::from_utf8(printed).unwrap(), "{name}");
                // the figure of the store is that of the command
                let draw = |line: &str, file: &str| {
                    let drawn = vibro(line).current_dir(&folder).output().unwrap();
                    assert!(drawn.status.success(), "{line}: {}", String::from_utf8_lossy(&drawn.stderr));
                    std::fs::read_to_string(folder.path().join(file)).unwrap()
                };
                let stored = draw(&format!("plot {place} stored.svg"), "stored.svg");
                assert_eq!(stored, draw(&format!("{line} --plot own.svg"), "own.svg"), "{name}");
            }
            exported.lines().map(|row| row.split(',').map(str::to_owned).collect::<Vec<_>>()).collect::<Vec<_>>()
        });
        if *name != "attractors" {
            same_table(machine, name, &tables[0], &tables[1]);
        }
    }
}

/// A map in physical units, in memory and in a store: each number is the nondimensional one times its unit.
#[test]
fn a_map_in_hertz() {
    let folder = tempfile::tempdir().unwrap();
    let rows = |line: &str| {
        let output = vibro(line).current_dir(&folder).output().unwrap();
        assert!(output.status.success(), "{line}: {}", String::from_utf8_lossy(&output.stderr));
        let text = String::from_utf8(output.stdout).unwrap();
        text.lines().map(|row| row.split(',').map(str::to_owned).collect()).collect::<Vec<Vec<_>>>()
    };
    // omega_n = 8 rad/s
    let hertz = 8.0 / std::f64::consts::TAU;
    let tail = "--restitution 0.5 --starts 4 --fields impact-speed-max,power,displacement-rms,impulse-max";
    let machine = "--mass-kg 1 --stiffness-n-per-m 64 --force-n 32 --damping-ratio 0.05";
    let si = format!("map {machine} --frequency-hz 0.8:1.6:3 --gap-m 0.25:0.75:3 {tail}");
    let (low, high) = (0.8 / hertz, 1.6 / hertz);
    let plain = rows(&format!("map --beta {low:?}:{high:?}:3 --gap 0.5:1.5:3 --damping 0.05 {tail} --csv -"));
    let found = rows(&format!("{si} --csv -"));
    let head = "frequency_hz,gap_m,label,share,impact_speed_max_m_per_s,power_w,displacement_rms_m,impulse_max_n_s";
    assert_eq!(found[0].join(","), head);
    assert_eq!(found[1][0], "0.8");
    assert_eq!(plain.len(), found.len());
    let (length, time, velocity) = (MACHINE.length(), MACHINE.time(), MACHINE.velocity());
    let factors = [hertz, length, 1.0, 1.0, velocity, velocity * velocity / time, length, velocity];
    for (a, b) in plain.iter().zip(&found).skip(1) {
        for ((a, b), factor) in a.iter().zip(b).zip(factors) {
            match (a.parse::<f64>(), b.parse::<f64>()) {
                (Ok(a), Ok(b)) => assert!((a * factor / b - 1.0).abs() < 1e-12, "{a} {b} {factor}"),
                _ => assert_eq!(a, b),
            }
        }
    }
    let filled = vibro(&format!("{si} --store map.zarr --quiet")).current_dir(&folder).output().unwrap();
    assert!(filled.status.success(), "{}", String::from_utf8_lossy(&filled.stderr));
    assert_eq!(rows(&format!("{si} --store map.zarr --csv -")), found);
}

/// A sweep in Hz moves the frequency ratio alone, in every command that varies a parameter.
#[test]
fn frequencies_in_hertz() {
    let hertz = 8.0 / std::f64::consts::TAU;
    let same = |si: &str, plain: &str, head: &str| {
        let text = |line: &str| String::from_utf8(vibro(line).output().unwrap().stdout).unwrap();
        let (a, b) = (text(&format!("{si} --csv -")), text(&format!("{plain} --csv -")));
        assert!(a.starts_with(head), "{si}: {a}");
        assert_eq!(a.lines().count(), b.lines().count(), "{si}");
        assert!(a.lines().count() > 3, "{si}");
    };
    let machine = "--mass-kg 1 --stiffness-n-per-m 64 --force-n 32 --gap-m 0.75 --restitution 0.5";
    let (low, high) = (0.8 / hertz, 1.2 / hertz);
    same(
        &format!("diagram {machine} --vary frequency-hz --over 0.8:1.2:5 --keep 8"),
        &format!("diagram --gap 1.5 --restitution 0.5 --vary beta --over {low:?}:{high:?}:5 --keep 8"),
        "frequency_hz,sweep,kind,side,phase,velocity_m_per_s",
    );
    let begin = 1.146 / hertz;
    same(
        &format!("branch {machine} --frequency-hz 1.146 --label 1/1 --vary frequency-hz --to 1.2"),
        &format!("branch --gap 1.5 --restitution 0.5 --beta {begin:?} --label 1/1 --vary beta --to {high:?}"),
        "branch,frequency_hz,label",
    );
    same(
        "region --mass-kg 1 --stiffness-n-per-m 64 --force-n 32 --restitution 0.5 --label 1/1 --frequency-hz 1.1:1.2 --gap-m 0.5:1.25 --grid 3",
        &format!("region --restitution 0.5 --label 1/1 --beta {:?}:{high:?} --gap 1:2.5 --grid 3", 1.1 / hertz),
        "region,polygon,hole,sheet,frequency_hz,gap_m,bound",
    );
    let refused = vibro("diagram --gap 1 --restitution 0.5 --vary frequency-hz --over 1:2:3").output().unwrap();
    let complaint = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(refused.status.code() == Some(2) && complaint.contains("physical units"), "{complaint}");
}

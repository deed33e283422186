//! Command lines of any command, drawn from the options that its parser has, and of plans: a new command or option needs nothing
//! here.

use super::machines;
use crate::plan::{drawn, small};
use crate::system::{parameter, start, system};
use crate::values::{
    ProptestText, count, damping, file, interval, label, number, odd, plain, range, restitution, typed, word,
};
use clap::{Arg, ArgAction, Command};
use proptest::prelude::*;
use std::collections::BTreeMap;
use std::sync::LazyLock;
use vibroimpact_report::question::command;
use vibroimpact_study::Plan;

/// Words of a command line.
type Words = BoxedStrategy<Vec<String>>;

/// The commands with all their options.
static PARSER: LazyLock<Command> = LazyLock::new(|| {
    let mut command = vibroimpact_cli::parser();
    command.build();
    command
});

/// What fuzzing asks of an option, where the name of its value in the help does not say it or a usual value takes too long.
/// An option of [`ALWAYS`] is always given.
fn usual(name: &str, kind: &str) -> Option<ProptestText> {
    Some(match name {
        "impacts" => word(&["1", "60", "200", "400", "1000", "0"]),
        "periods" | "time" => (0.0..20.0_f64).prop_map(typed).boxed(),
        "transient" => word(&["10", "100", "0", "300", "1000001"]),
        "keep" | "starts" | "jobs" | "cpus" => word(&["1", "2", "5", "0"]),
        "points" if kind == "FILE" => word(&["points.csv", "points.csv", "bad.csv", "none.csv"]),
        "points" => word(&["2", "5", "20", "100", "1"]),
        "lines" => word(&["0", "1", "5", "100001"]),
        "follow" => word(&["0", "1", "2", "101"]),
        "laps" => word(&["1", "2", "1000001"]),
        "grid" => word(&["2", "3", "5", "401"]),
        "tile" => word(&["1", "2", "4096", "4097"]),
        "refine" => word(&["2", "3", "64", "65"]),
        "shard" => word(&["1", "2", "1024", "1025"]),
        "threads" => word(&["1", "2", "3", "4", "1024", "1025"]),
        "budget" => word(&["1ms", "0.01s", "5s", "1h", "0s", "-1h", "8", "h"]),
        "tiles" => word(&["1/1", "1/2", "2/1", "0/1", "1/0", "1", "/", "1/99999999999999999999"]),
        "fields" => {
            word(&["power", "impact-speed-max,displacement_rms", "stop.one.impact-speed-max", "speed", "power,power"])
        }
        "colour" | "quantity" => word(&["power", "impact-speed-max", "impacts-per-period", "velocity-max", "speed"]),
        "show" => word(&["velocity", "strobe", "speed", "q.a", "qdot.b", "power", "waveform", "phase,multipliers"]),
        "axes" => word(&["gap,inverse-beta", "gap", "mass"]),
        "layers" => word(&["regions", "amplitude", "paper,stripes", "none,paper", "boundaries", "lines"]),
        "over" | "x-limits" | "y-limits" | "colour-range" => {
            prop_oneof![4 => range(0.2, 1.5), 1 => interval(0.1, 2.0), 1 => word(&["0.3,0.5,1.2", "0.5,x"])].boxed()
        }
        "to" => {
            prop_oneof![4 => (-0.5..3.0_f64).prop_map(typed), 1 => word(&["0,3", "1,1", "0,x"]), 1 => number()].boxed()
        }
        "label" => label(),
        "sample" if kind == "N" => word(&["1", "4", "0"]),
        "sample" => word(&["sobol:4", "lhs:3", "lhs:0"]),
        "mark" => word(&["1,1", "1.3,9", "1.3"]),
        "line" => word(&["1,1:2,1", "1,2:1,2", "3,1:4,1"]),
        "other" => word(&["x=-1,v=2", "v=3", "q.a=1", "x=1", "y=1"]),
        "q" | "qdot" => prop::collection::vec(plain(), 1..4).prop_map(|list| list.join(",")).boxed(),
        "second_gap" | "second_gap_m" => plain(),
        "start" => word(&["start.json", "machine.toml", "none"]),
        "python" => word(&["no-such-program", "false"]),
        "seconds" => word(&["0.01", "0.01", "0.01", "0", "nan"]),
        "out" => word(&["plan.toml", "thesis.zarr/x", ""]),
        "port" => word(&["-1", "65536", "x", ""]),
        "within" => word(&["1.5", "1", "100"]),
        "damping" | "damping_ratio" => damping(),
        "restitution" | "second_restitution" => restitution(),
        _ => return None,
    })
}

/// Options without which a line takes too long or never ends.
const ALWAYS: [(&str, &str); 9] = [
    ("bench", "seconds"),
    ("reproduce", "out"),
    ("explore", "port"),
    ("lyapunov", "impacts"),
    ("lyapunov", "transient"),
    ("diagram", "transient"),
    ("diagram", "keep"),
    ("region", "grid"),
    ("branch", "points"),
];

/// A value of an option, by the name that its value has in the help.
fn named(kind: &str, machine: bool) -> ProptestText {
    match kind {
        "N" | "K" | "S" => count(),
        "A:B:N" | "VALUES" => range(0.1, 2.0),
        "A:B" | "LOW:HIGH" => interval(0.1, 2.0),
        "m/n" => label(),
        "FILE" => file(&[".csv", ".csv", ".txt", ".svg", ".svg", ".png", ".jpg"]),
        "STORE" | "DIR" => word(&["s.zarr", "s.zarr", "ünï.zarr", "thesis.zarr", ".", "none/s.zarr", "s3://", "s3://bucket/x", "file:///none"]),
        "PLAN" => word(&["plan.toml", "plan.toml", "plan.toml", "bad.toml", "none.toml", "."]),
        "NAME|FILE" => prop_oneof![
            12 => word(&[machines::FILE]),
            3 => word(&["two-mass-hammer", "soft-stop", "impact-damper", "bouncing-ball", "capsule", "sdnd101", "chain"]),
            1 => word(&["machine.toml", "bad.toml", "none", "."]),
        ]
        .boxed(),
        "WxH" => word(&["85x60mm", "8cmx5cm", "3x2in", "0x1mm", "x"]),
        "TIME" => word(&["04:00:00", "2-12:00:00", "soon", "1;rm"]),
        "COMMAND" | "COMMAND|TOPIC" => word(&["settle", "map", "system", "units", "machine", "frobnicate"]),
        _ if kind.contains("PATH") || kind.contains("PARAMETER") || kind.contains("NAME") => varied(kind, machine),
        _ => prop_oneof![8 => (0.05..20.0_f64).prop_map(typed), 2 => number(), 1 => word(&["1.5mm", "12 N/mm", "2 %", "3 furlongs"])].boxed(),
    }
}

/// The name of a number that varies, with the values that the help asks for after it.
fn varied(kind: &str, machine: bool) -> ProptestText {
    const NAMES: &[&str] = &[
        "gap",
        "inverse-beta",
        "beta",
        "restitution",
        "damping",
        "second-gap",
        "mass-kg",
        "force-n",
        "frequency-hz",
        "gap-m",
    ];
    let (of, other) = if machine { (machines::PATHS, NAMES) } else { (NAMES, machines::PATHS) };
    let starts: &[&str] = if machine { machines::STARTS } else { &["x", "v"] };
    let name = prop_oneof![24 => word(of), 6 => word(starts), 1 => word(other), 1 => odd()];
    let value = match kind.split_once('=') {
        None => return name.boxed(),
        Some((_, "A:B:N")) => range(-0.5, 1.5),
        Some((_, "A:B")) => interval(0.1, 1.5),
        Some(_) => plain(),
    };
    (name, value).prop_map(|(name, value)| format!("{name}={value}")).boxed()
}

/// An option of a command, or an argument without a name, with this probability; numbers that vary are those of a machine, or else
/// of an oscillator.
fn option(arg: &Arg, often: f64, machine: bool) -> Words {
    let name = arg.get_id().as_str();
    let flag = arg.get_long().map(|long| format!("--{long}"));
    let possible: Vec<String> = arg.get_possible_values().iter().map(|one| one.get_name().to_owned()).collect();
    let kind = arg.get_value_names().and_then(|names| names.first()).map(ToString::to_string).unwrap_or_default();
    let words = if !matches!(arg.get_action(), ArgAction::Set | ArgAction::Append) {
        Just(flag.into_iter().collect()).boxed()
    } else {
        let value = usual(name, &kind).unwrap_or_else(|| {
            if possible.is_empty() { named(&kind, machine) } else { prop::sample::select(possible).boxed() }
        });
        prop_oneof![50 => value, 1 => odd()]
            .prop_map(move |value| vec![flag.as_ref().map_or_else(|| value.clone(), |flag| format!("{flag}={value}"))])
            .boxed()
    };
    if often >= 1.0 { words } else { prop::option::weighted(often, words).prop_map(Option::unwrap_or_default).boxed() }
}

/// The numbers of an oscillator, or some of a body in SI units, as flags; those that a command takes as ranges are ranges.
fn flags(command: &Command) -> Words {
    let takes = |name: &str| {
        let arg = command.get_arguments().find(|arg| arg.get_id() == name)?;
        arg.get_value_names()?.first().map(ToString::to_string)
    };
    let over: fn(f64, f64) -> ProptestText = match (command.get_name(), takes("gap").as_deref()) {
        ("region", _) => interval,
        (_, Some("VALUES")) => range,
        _ => |_, _| Just(String::new()).boxed(),
    };
    let ranges =
        prop::collection::vec(parameter().prop_flat_map(move |(name, low, high)| (Just(name), over(low, high))), 1..3);
    let body = prop::collection::vec((0.05..20.0_f64).prop_map(typed), 5);
    let of_body = ["mass-kg", "stiffness-n-per-m", "force-n", "frequency-hz", "gap-m"];
    let known: Vec<String> = command
        .get_arguments()
        .filter(|arg| !ranged(arg))
        .filter_map(|arg| arg.get_long().map(str::to_owned))
        .collect();
    (prop_oneof![9 => Just(false), 1 => Just(true)], system(), start(), ranges, body)
        .prop_map(move |(si, system, start, ranges, body)| {
            let mut given: Vec<(String, String)> = if si {
                let of = of_body.iter().map(|name| (*name).to_owned()).zip(body);
                of.chain([("restitution".to_owned(), "0.5".to_owned())]).collect()
            } else {
                system.into_iter().map(|(name, value)| (name.replace('_', "-"), value)).collect()
            };
            given.extend(start.into_iter().map(|(name, value)| (name.to_owned(), value)));
            for (name, over) in ranges.into_iter().filter(|(_, over)| !si && !over.is_empty()) {
                let name = name.replace('_', "-");
                let same = |other: &str| other == name || other.ends_with("beta") && name.ends_with("beta");
                given.retain(|(other, _)| !same(other));
                given.push((name, over));
            }
            given.retain(|(name, _)| known.contains(name));
            given.into_iter().map(|(name, value)| format!("--{name}={value}")).collect()
        })
        .boxed()
}

/// The numbers of an oscillator.
const NUMBERS: [&str; 7] =
    ["beta", "inverse_beta", "gap", "restitution", "damping", "second_gap", "second_restitution"];

/// Whether an option is a number of a start.
fn of_start(arg: &Arg) -> bool {
    ["x", "v", "phase"].contains(&arg.get_id().as_str())
}

/// Whether an option takes values over a range for a grid of starts.
fn ranged(arg: &Arg) -> bool {
    arg.get_value_names().is_some_and(|names| names.iter().any(|name| name == "A:B:N"))
}

/// A command line of this command, at times with an additional, repeated or truncated word.
fn line(verb: Vec<String>, command: &Command, machine: bool) -> Words {
    let systems = |arg: &&Arg| {
        let heading = arg.get_help_heading().unwrap_or_default();
        if !ranged(arg) && (NUMBERS.contains(&arg.get_id().as_str()) || of_start(arg)) {
            return true;
        }
        ["System", "Excitation", "Start", "Machine"].iter().any(|of| heading.starts_with(of)) && !arg.is_required_set()
    };
    let of_machine: Vec<Words> = ["machine", "set", "q", "qdot"]
        .iter()
        .filter_map(|name| command.get_arguments().find(|arg| arg.get_id() == *name))
        .map(|arg| option(arg, if arg.get_id() == "machine" { 1.0 } else { 0.2 }, true))
        .collect();
    let system = if machine { all(of_machine) } else { flags(command) };
    let rest = command.get_arguments().filter(|arg| !systems(arg)).map(|arg| {
        let name = arg.get_id().as_str();
        let always = ALWAYS.iter().any(|of| *of == (command.get_name(), name));
        let in_group =
            command.get_groups().any(|group| group.is_required_set() && group.get_args().any(|id| id == arg.get_id()));
        let often = match (arg.get_help_heading().unwrap_or_default(), name) {
            _ if always => 1.0,
            _ if in_group => 0.02,
            _ if arg.is_required_set() => 0.97,
            _ if arg.is_positional() => 0.5,
            (_, "help" | "version") => 0.005,
            (_, "axis") if !machine => 0.05,
            (_, "label" | "vary" | "to" | "over" | "kind" | "starts" | "x" | "v" | "other" | "and" | "axis") => 0.9,
            (_, "json" | "impacts") => 0.5,
            ("Figure" | "Store", _) => 0.015,
            _ => 0.05,
        };
        option(arg, often, machine)
    });
    // one of the options of which one is needed
    let needed = command.get_groups().filter(|group| group.is_required_set()).map(|group| {
        let of = command.get_arguments().filter(|arg| group.get_args().any(|id| id == arg.get_id()));
        proptest::strategy::Union::new(of.map(|arg| option(arg, 0.97, machine)).collect::<Vec<_>>()).boxed()
    });
    let odd_system = command.get_arguments().filter(systems).map(|arg| option(arg, 0.002, machine));
    let parts = all([system].into_iter().chain(rest).chain(needed).chain(odd_system).collect());
    let spoil = prop::option::weighted(0.06, (any::<prop::sample::Index>(), 0..5_u8, odd()));
    (parts, spoil).prop_map(move |(parts, spoil)| spoiled(verb.iter().cloned().chain(parts).collect(), spoil)).boxed()
}

/// The command lines of plans, which ask sound questions, with some of the options that a command has besides.
fn of_plans() -> Words {
    let mut further: BTreeMap<String, Words> = BTreeMap::new();
    for of in PARSER.get_subcommands() {
        let json = |arg: &Arg| if arg.get_id() == "json" { 0.5 } else { 0.03 };
        let beside = |arg: &&Arg| !arg.is_required_set() && !["help", "version"].contains(&arg.get_id().as_str());
        let beside = |arg: &&Arg| beside(arg) && !arg.get_help_heading().unwrap_or_default().starts_with("Excitation");
        let all_of = all(of.get_arguments().filter(beside).map(|arg| option(arg, json(arg), false)).collect());
        further.insert(of.get_name().to_owned(), all_of);
    }
    let asked = drawn().prop_filter_map("a plan that flags can express", |plan| {
        let plan = Plan::from_text(&plan.to_string()).ok().filter(small)?;
        command(&plan).map(|words| words[1..].to_vec())
    });
    let with = move |words: Vec<String>| (Just(words.clone()), further[&words[0]].clone());
    let known = |words: &[String], flag: &str| words.iter().any(|word| Some(word.as_str()) == flag.split('=').next());
    asked
        .prop_flat_map(with)
        .prop_map(move |(words, more)| {
            let more = more.into_iter().filter(|flag| !known(&words, flag)).collect();
            [words.clone(), more].concat()
        })
        .boxed()
}

fn all(parts: Vec<Words>) -> Words {
    parts.prop_map(|parts| parts.concat()).boxed()
}

fn spoiled(mut line: Vec<String>, spoil: Option<(prop::sample::Index, u8, String)>) -> Vec<String> {
    let Some((place, how, odd)) = spoil else { return line };
    let k = place.index(line.len());
    match how {
        0 => line.insert(k + 1, odd),
        1 => line.insert(k + 1, format!("--{odd}")),
        2 => line.push(line[k].clone()),
        3 => line[k] = line[k].chars().take(line[k].chars().count() / 2).collect(),
        _ => line[k].push_str(&odd),
    }
    // no operating system passes a word with this character
    line.iter_mut().for_each(|word| word.retain(|c| c != '\0'));
    line
}

/// A line of any command. Questions about motions are drawn three times as often as commands for files and pages.
pub(super) fn lines() -> Words {
    let mut lines: Vec<(u32, Words)> = Vec::new();
    for command in PARSER.get_subcommands() {
        let name = command.get_name().to_owned();
        let has = |name: &str| command.get_arguments().any(|arg| arg.get_id() == name);
        lines.push((if has("beta") { 3 } else { 1 }, line(vec![name.clone()], command, false)));
        if has("beta") && has("machine") {
            lines.push((2, line(vec![name.clone()], command, true)));
        }
        for sub in command.get_subcommands() {
            lines.push((1, line(vec![name.clone(), sub.get_name().to_owned()], sub, true)));
        }
    }
    prop_oneof![of_plans(), proptest::strategy::Union::new_weighted(lines)].boxed()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::runner;
    use proptest::strategy::ValueTree;

    /// Of each command some lines are read by its parser.
    #[test]
    fn many_lines_are_read() {
        // a parser is built when it is first used, which takes longer than to read a line
        let (lines, mut parser) = (lines(), PARSER.clone());
        let mut read: BTreeMap<String, [usize; 2]> = BTreeMap::new();
        for k in 0..1500 {
            let words = lines.new_tree(&mut runner(1, "commands", k)).unwrap().current();
            let parsed = parser.try_get_matches_from_mut([&["vibro".to_owned()][..], &words].concat()).is_ok();
            let of = read.entry(words[0].clone()).or_default();
            of[0] += 1;
            of[1] += usize::from(parsed);
        }
        // a port at which the explorer listens would be served until Ctrl-C
        for command in PARSER.get_subcommands().map(Command::get_name).filter(|name| *name != "explore") {
            let [drawn, read] = read[command];
            assert!(5 * read > drawn, "{command}: {read} of {drawn} lines are read");
        }
    }
}

//! Command lines about an oscillator or a body: those of the plans that are drawn, with flags that no plan has, and some words changed.

use super::parts::{Words, all, flag, flags, line, machine, machine_with_ranges, outputs, start, switch, system, word};
use crate::plan::{drawn, small};
use crate::system::{SystemValues, parameter, without};
use crate::values::{count, interval, label, number, odd, range, restitution};
use proptest::prelude::*;
use proptest::sample::Index;
use vibroimpact_report::question::command;
use vibroimpact_study::Plan;

/// Any of these command lines.
pub(super) fn lines() -> Words {
    prop_oneof![14 => of_plans(), 3 => others(), 3 => many()].boxed()
}

/// Flags that are in no plan: the command, the flag, how often it is given, and its values; a flag without values is a switch.
const FURTHER: [(&str, &str, f64, &[&str]); 27] = [
    ("settle", "rule", 0.1, &["paper", "confirmed", "proved", "none"]),
    ("settle", "percent", 0.05, &["0.1", "0", "nan"]),
    ("settle", "limit", 0.05, &["2", "100", "1", "x"]),
    ("settle", "show", 0.1, &["phase", "multipliers", "sections", "speed"]),
    ("simulate", "step", 0.05, &["0.1", "0", "-1", "nan"]),
    ("lyapunov", "section", 0.1, &["s.csv", "-", ""]),
    ("branch", "no-diagram", 0.05, &[]),
    ("branch", "virtual", 0.05, &[]),
    ("branch", "also", 0.1, &["gap=1", "gap-m=0.1", "beta=1", "gap", "x=1"]),
    ("branch", "to", 0.1, &["0,3", "3,-0.5", "1,1", "0,x", "0,1,2"]),
    ("diagram", "also", 0.1, &["gap=1:2", "restitution=0.5:0.4", "gap=1", "mass-kg=1:2"]),
    ("diagram", "show", 0.2, &["power", "impact-speed-max", "all"]),
    ("diagram", "branches", 0.05, &["1/1", "1/1,2/1", "3/0", "inf/1", ""]),
    ("map", "layers", 0.08, &["paper", "amplitude,stripes", "boundaries", "none", "none,paper", "lines", ""]),
    ("map", "mark", 0.08, &["1,1", "0.5,0.5", "-1,1", "1e300,0", "nan,1", "1", ""]),
    ("map", "line", 0.08, &["0,0:3,3", "1,1:1,1", "0,-1:1e300,2", "-5,0:-4,0", "1,2", ""]),
    ("map", "colour", 0.1, &["power", "impact-speed-max", "speed"]),
    ("map", "of", 0.05, &["largest", "smallest", "likeliest", "worst", "all"]),
    ("map", "colour-range", 0.05, &["0:1", "-1:2", "1:1", "2:1", "a:b", ""]),
    ("basin", "colour", 0.1, &["power", "impact-speed-mean", "speed"]),
    ("basin", "fields", 0.1, &["power", "impact-speed-max,displacement_rms", "speed", "", "power,power"]),
    // the places of stores are those of every grid
    ("map basin diagram attractors", "store", 0.15, &["s.zarr", "s.zarr", "ünï.zarr", "none/s.zarr", "", "."]),
    ("map basin diagram attractors", "tile", 0.08, &["1", "2", "4096", "4097", "0", "-1"]),
    ("map basin", "refine", 0.04, &["2", "3", "64", "65", "0"]),
    ("map basin diagram attractors", "shard", 0.05, &["1", "2", "1024", "1025", "0"]),
    ("map basin diagram attractors", "budget", 0.04, &["0.001s", "1h", "0s", "8"]),
    ("map region", "axes", 0.05, &["gap,inverse-beta", "gap", "mass", ""]),
];

/// The command lines of plans.
fn of_plans() -> Words {
    let words = drawn().prop_filter_map("no command with a small budget says it", |plan| {
        let plan: Plan = serde_json::from_value(plan).ok()?;
        command(&plan).filter(|_| small(&plan))
    });
    let change = prop::option::weighted(0.3, (any::<Index>(), prop::option::weighted(0.8, odd())));
    (words, change).prop_flat_map(|(words, change)| of_plan(&words, change)).boxed()
}

/// One of them, of which a value may be another one, or a flag may be missing.
fn of_plan(words: &[String], change: Option<(Index, Option<String>)>) -> Words {
    let verb = words[1].clone();
    let mut given: Vec<String> = Vec::new();
    for word in &words[2..] {
        match given.last_mut().filter(|flag| !word.starts_with("--") && !flag.contains('=')) {
            Some(flag) => *flag = format!("{flag}={word}"),
            None => given.push(word.clone()),
        }
    }
    if let Some((place, odd)) = change.filter(|_| !given.is_empty()) {
        let k = place.index(given.len());
        match (odd, given[k].split_once('=')) {
            (Some(odd), Some((flag, _))) => given[k] = format!("{flag}={odd}"),
            _ => drop(given.remove(k)),
        }
    }
    let own = FURTHER.iter().filter(|(verbs, ..)| verbs.split(' ').any(|known| known == verb));
    let further = own.map(|(_, name, often, values)| match values {
        [] => switch(name, *often),
        values => flag(name, *often, word(values)),
    });
    let mut parts = vec![Just(given).boxed()];
    parts.extend(further);
    parts.push(outputs("csv"));
    line(verb, parts)
}

fn budget() -> Words {
    flag("impacts", 0.6, prop_oneof![4 => word(&["1", "60", "200", "1500"]), 1 => count()].boxed())
}

/// Questions whose plans are not drawn: margins, responses, and those about bodies.
fn others() -> Words {
    const NUMBERS: &[&str] =
        &["gap", "inverse-beta", "damping", "second-gap", "mass-kg", "force-n", "gap-m", "mass", ""];
    let response = varied(1, range).prop_map(|(over, system)| [flags(&over), flags(&system)].concat());
    let starts = || flag("starts", 0.97, word(&["1", "2", "3"]));
    prop_oneof![
        line(
            "margins",
            vec![
                system(),
                start(),
                flag("label", 0.3, label()),
                flag("vary", 0.3, word(NUMBERS)),
                flag("scale", 0.1, word(&["gap=0.1", "gap-m=0.1", "damping=0", "x"])),
                flag("within", 0.2, word(&["1.5", "1", "100", "nan"])),
                flag("lines", 0.9, word(&["0", "1", "5", "100001"])),
                outputs("csv"),
            ]
        ),
        line(
            "response",
            vec![
                prop_oneof![3 => response, 1 => machine_with_ranges()].boxed(),
                flag("quantity", 0.4, word(&["power", "impact-speed-max", "sticking_fraction", "speed", ""])),
                outputs("csv"),
            ]
        ),
        line("settle", vec![machine(), start(), budget(), outputs("csv")]),
        line(
            "branch",
            vec![
                machine(),
                flag("label", 0.98, label()),
                flag("vary", 0.98, word(NUMBERS)),
                flag("to", 0.98, number()),
                flag("points", 1.0, word(&["2", "20", "100"])),
                outputs("csv")
            ]
        ),
        line("map", vec![machine_with_ranges(), starts(), budget(), outputs("csv")]),
        line(
            "diagram",
            vec![
                machine(),
                flag("vary", 0.98, word(NUMBERS)),
                flag("over", 0.98, range(0.1, 3.0)),
                flag("transient", 1.0, word(&["0", "10", "100"])),
                flag("keep", 1.0, word(&["1", "5", "64"])),
                outputs("csv")
            ]
        ),
    ]
    .boxed()
}

/// A system in which this number of parameters vary over ranges.
fn varied(most: usize, over: fn(f64, f64) -> BoxedStrategy<String>) -> BoxedStrategy<(SystemValues, SystemValues)> {
    let one = move || parameter().prop_flat_map(move |(name, low, high)| (Just(name), over(low, high)));
    (prop::collection::vec(one(), most), crate::system::system())
        .prop_map(|(mut over, system)| {
            // without this, nine of ten would be refused for a parameter that is given twice
            over.sort_by_key(|(name, _)| name.trim_start_matches("inverse_"));
            over.dedup_by_key(|(name, _)| name.trim_start_matches("inverse_"));
            let names: Vec<&str> = over.iter().map(|(name, _)| *name).collect();
            let system = without(system, &names);
            (over, system)
        })
        .boxed()
}

/// Points of systems and starts.
fn many() -> Words {
    let of_system = varied(2, interval).prop_map(|(over, system)| [flags(&over), flags(&system)].concat());
    let sample = flag("sample", 0.97, word(&["lhs:7", "sobol:4", "lhs:1", "sobol:0", "lhs:1e10", "sobol:x", "grid:3"]));
    let sampled = all(vec![prop_oneof![5 => of_system.boxed(), 1 => machine_with_ranges()].boxed(), sample]);
    let listed = all(vec![
        flag("points", 1.0, word(&["points.csv", "points.csv", "bad.csv", "none.csv", "plan.toml", ""])),
        flag("restitution", 0.9, restitution()),
    ]);
    let place = || prop_oneof![3 => interval(-2.0, 0.0), 2 => number()].boxed();
    line(
        "settle-many",
        vec![
            prop_oneof![3 => sampled, 1 => listed].boxed(),
            flag("x", 0.2, place()),
            flag("v", 0.4, place()),
            flag("phase", 0.2, place()),
            flag("seed", 0.2, count()),
            budget(),
            flag("fields", 0.2, word(&["power", "impact-speed-max,displacement_rms", "speed", ""])),
            switch("transient", 0.2),
            flag("store", 0.2, word(&["s.zarr", "none/s.zarr", ""])),
            flag("csv", 0.3, word(&["-", "t.csv", ""])),
            switch("json", 0.4),
        ],
    )
}

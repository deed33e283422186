//! Stability in three words, rests that name their stops, and how far chaos was seen.

use crate::{json, machine_file, printed};
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;

/// An elastic ball between a wall and a moving wall.
const BALL: &str = r#"
[parameters]
L = 1
eps = 0.05
[machine]
bodies = { ball = 1 }
frequency = 1
[[machine.stop]]
name = "fixed"
between = ["ground", "ball"]
gap = 0
restitution = 1
[[machine.stop]]
name = "moving"
at = "ball"
gap = "L"
restitution = 1
motion = [{ sin = "-eps" }]
[start]
q = [0.5]
qdot = [0.33]
"#;

/// A slider that friction holds, and a hammer on it between two stops.
const SLIDER: &str = r#"
[machine]
coordinates = ["slider", "hammer"]
mass = [1, 1]
stiffness = [[1, -1], [-1, 1]]
damping = [[0.2, -0.2], [-0.2, 0.2]]
frequency = 1.0
[[machine.force]]
order = 1
cos = [0, 0.05]
sin = [0, 0]
[[machine.stop]]
name = "right"
direction = [0, 1]
gap = 1.0
restitution = 0.5
[[machine.stop]]
name = "left"
direction = [0, -1]
gap = 1.0
restitution = 0.5
[[machine.friction]]
name = "ground"
direction = [1, 0]
sliding = 5
static = 5
"#;

/// A structure of three coordinates with stiff stops, whose chaos ends.
const LONG: &str = r#"
[start]
q = [-0.1479, -0.0759, 0.2969]
qdot = [-0.4201, 0.976, -0.0398]
phase = 2.1116
[machine]
coordinates = ["x1", "x2", "x3"]
mass = [1.151, 0.3236, 2.706]
stiffness = [[7.08, -3.534, 0.0], [-3.534, 3.8682, -0.3342], [0.0, -0.3342, 0.3342]]
damping = [[0.13005, -0.01095, 0.0], [-0.01095, 0.02223, -0.01128], [0.0, -0.01128, 0.07717]]
constant = [0.0013, 0.2998, 0.3128]
frequency = 1.743
[[machine.force]]
order = 1
cos = [0.8068, 0.0, 0.4877]
sin = [-0.0504, 0.0, 0.257]
[[machine.stop]]
name = "s0"
direction = [0.5778, 0.9634, 0.82]
gap = 0.5865
stiffness = 389.5
damping = 52.34
opening = "position"
[[machine.stop]]
name = "s1"
direction = [-1.0, 0.0, 1.0]
gap = 0.1934
stiffness = 49980.0
damping = 23.76
opening = "position"
[[machine.stop]]
name = "s2"
direction = [1.0, 0.0, -1.0]
gap = 0.3786
stiffness = 1222.0
damping = 16.39
opening = "position"
"#;

/// The cells of a column of a table.
fn column(table: &str, name: &str) -> Vec<String> {
    let mut rows = table.lines().map(|row| row.split(','));
    let at = rows.next().expect("a head").position(|head| head == name).unwrap_or_else(|| panic!("{name}: {table}"));
    rows.map(|mut row| row.nth(at).expect("a cell").to_owned()).collect()
}

fn kinds(branch: &Value) -> Vec<&str> {
    branch["branches"][0]["events"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|event| event["kind"].as_str().expect("a text"))
        .collect()
}

/// 42.5: of 87 points of this branch 33 were called stable, with torus events between them.
#[test]
fn an_elliptic_family_is_neutral() {
    let (folder, path) = machine_file(BALL);
    let line = format!("--machine {}", path.display());
    let orbits = json(&format!("orbit {line} --label 2/1"));
    let words: Vec<_> =
        orbits["orbits"].as_array().expect("a list").iter().map(|orbit| orbit["stability"].clone()).collect();
    assert_eq!(words, ["unstable", "neutral"]);
    assert_eq!(orbits["orbits"][1]["stable"], false);
    let told = printed(&format!("orbit {line} --label 2/1"));
    assert!(told.contains("\n  unstable; multipliers ") && told.contains("\n  neutral; multipliers "), "{told}");
    let branch = format!("branch {line} --label 2/1 --orbit 2 --vary eps --to 0.001");
    let answer = json(&branch);
    let points = answer["branches"][0]["points"].as_array().expect("a list");
    assert!(
        points.len() > 20 && points.iter().all(|point| point["stability"] == "neutral" && point["stable"] == false)
    );
    assert_eq!(kinds(&answer), ["end of range"]);
    let text = printed(&branch);
    assert!(text.starts_with("branch 1: 2/1 (orbit 2 of 2, neutral there), eps from "), "{text}");
    assert!(text.contains(&format!(", {} points\n", points.len())) && text.contains(", 2/1 neutral: end of range\n"));
    let table = folder.path().join("branch.csv");
    let figure = folder.path().join("branch.svg");
    printed(&format!("{branch} --csv {} --plot {}", table.display(), figure.display()));
    assert!(column(&fs::read_to_string(table).unwrap(), "stability").iter().all(|word| word == "neutral"));
    let figure = fs::read_to_string(figure).unwrap();
    assert!(figure.contains(">neutral<") && !figure.contains(">stable<"));
}

/// 42.5: the same for an oscillator without losses.
#[test]
fn an_elastic_oscillator_is_neutral_or_unstable() {
    let system = "--inverse-beta 1.3 --gap 0.75 --restitution 1";
    let mut words = Vec::new();
    for label in ["1/1", "2/1", "1/2", "2/2"] {
        let orbits = json(&format!("orbit {system} --label {label}"));
        for orbit in orbits["orbits"].as_array().expect("a list") {
            assert_eq!(orbit["stable"], false);
            words.push(orbit["stability"].as_str().expect("a text").to_owned());
        }
    }
    assert!(words.iter().any(|word| word == "neutral") && words.iter().all(|word| word != "stable"), "{words:?}");
    let free = json("settle --inverse-beta 1.3 --gap 20 --restitution 0.5");
    assert_eq!((&free["motion"]["stability"], &free["motion"]["stable"]), (&"neutral".into(), &false.into()));
    let damped = json("settle --inverse-beta 1.3 --gap 20 --restitution 0.5 --damping 0.1");
    assert_eq!((&damped["motion"]["stability"], &damped["motion"]["stable"]), (&"stable".into(), &true.into()));
    let stuck = json("settle --inverse-beta 0.5 --gap -3 --restitution 0.5");
    assert_eq!((&stuck["motion"]["stop"], &stuck["motion"]["stops"]), (&"upper".into(), &serde_json::json!(["upper"])));
}

/// 42.8: rests on different stops were one motion.
#[test]
fn rests_name_their_stops() {
    let (folder, path) = machine_file(SLIDER);
    let line = format!("--machine {}", path.display());
    let settled = json(&format!("settle {line} --q=-3,0"));
    let motion = &settled["motion"];
    assert_eq!(
        (&motion["label"], &motion["stop"], &motion["stability"]),
        (&"stuck".into(), &"left".into(), &"neutral".into())
    );
    assert_eq!(motion["stops"], serde_json::json!(["left"]));
    assert!(settled["events_followed"].as_u64().unwrap() > 0 && settled["time_followed"].is_number());
    assert!(printed(&format!("settle {line} --q=3,0")).contains("at rest on right for ever"));
    let basin = format!("basin {line} --axis q.slider=-3:3:7 --axis q.hammer=-0.5:0.5:3");
    let answer = json(&basin);
    let motions = answer["motions"].as_array().expect("a list");
    let stuck: Vec<_> = motions.iter().filter(|motion| motion["label"] == "stuck").collect();
    let stops: Vec<_> = stuck.iter().map(|motion| motion["stop"].as_str().expect("a text")).collect();
    assert_eq!(stops, ["left", "right"]);
    let shares: f64 = stuck.iter().map(|motion| motion["share"].as_f64().unwrap()).sum();
    assert!((shares - 12.0 / 21.0).abs() < 1e-12, "{shares}");
    // the rest repeats, beside a joint that holds: none is undecided
    assert!(motions.iter().all(|motion| motion["label"] != "undecided"), "{motions:?}");
    let table = folder.path().join("basin.csv");
    printed(&format!("{basin} --csv {}", table.display()));
    let table = fs::read_to_string(table).unwrap();
    let cells: Vec<(String, String)> = column(&table, "label").into_iter().zip(column(&table, "stop")).collect();
    let count = |label: &str, stop: &str| cells.iter().filter(|(a, b)| a == label && b == stop).count();
    assert_eq!((count("stuck", "left"), count("stuck", "right"), count("stuck", "")), (6, 6, 0));
    // the same table of a store, in which each rest has a number, and both count as one label
    let store = folder.path().join("basin.zarr");
    let stored = folder.path().join("stored.csv");
    printed(&format!("{basin} --store {} --csv {}", store.display(), stored.display()));
    assert_eq!(fs::read_to_string(stored).unwrap(), table);
    let long = printed(&format!("export {} --csv -", store.display()));
    let numbered = cells.iter().zip(column(&long, "cycle").into_iter().zip(column(&long, "closed")));
    let numbers: BTreeSet<_> = numbered.filter(|((label, _), _)| label == "stuck").collect();
    let stops: Vec<_> = numbers.iter().map(|((_, stop), (_, closed))| (stop.as_str(), closed.as_str())).collect();
    // right is stop 0, left is stop 1
    assert_eq!(stops, [("left", "2"), ("right", "1")]);
    assert!(printed(&format!("{basin} --store {}", store.display())).contains("  stuck      12           57.1 %\n"));
}

/// The rests of maps have the names of their stops in the tables of the command and of a store.
#[test]
fn rests_of_maps_name_their_stops() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = |name: &str| folder.path().join(name).display().to_string();
    let map = "map --machine gear-rattle --axis eps=0.17:0.19:3 --starts 4";
    printed(&format!("{map} --csv {}", place("map.csv")));
    printed(&format!("{map} --store {} --csv {}", place("map.zarr"), place("stored.csv")));
    let table = fs::read_to_string(place("map.csv")).unwrap();
    assert_eq!(
        (column(&table, "label"), column(&table, "stop")),
        (vec!["stuck".to_owned(); 3], vec!["front".to_owned(); 3])
    );
    assert_eq!(fs::read_to_string(place("stored.csv")).unwrap(), table);
}

/// 42.9: chaos is followed to the end of the budget, and how far stands beside the word.
#[test]
fn chaos_says_how_far_it_was_seen() {
    let (folder, path) = machine_file(LONG);
    // how long chaos lasts from a start depends on rounding errors: one from which it lasts long
    let starts = (0..40).map(|k| -0.1479 + 1e-3 * f64::from(k));
    let lines = starts.map(|q| format!("--machine {} --q={q},-0.0759,0.2969", path.display()));
    let long = |line: &String| {
        let whole = json(&format!("settle {line}"));
        (whole["motion"]["label"] == "9/4" && whole["events_followed"].as_u64() > Some(5000)).then_some(whole)
    };
    let (line, whole) = lines.into_iter().find_map(|line| long(&line).map(|whole| (line, whole))).unwrap();
    assert!(whole["chaotic_transient"]["exponents"].is_array());
    let short = json(&format!("settle {line} --impacts 2000"));
    assert_eq!(short["motion"]["label"], "chaotic");
    let seen = short["motion"]["seen_events"].as_u64().unwrap();
    assert!(seen >= 2000 && short["events_followed"] == seen);
    assert!(
        printed(&format!("settle {line} --impacts 2000")).contains(&format!("chaotic: no repetition in {seen} events"))
    );
    let line = format!("--machine {}", path.display());
    let map = format!("map {line} --axis stop.s0.gap=0.5865:0.587:2 --starts 1 --impacts 6000");
    let answer = json(&map);
    if answer["labels"].as_array().unwrap().iter().any(|of| of["label"] == "chaotic") {
        let seen = answer["seen_events"].as_u64().unwrap();
        assert!(seen >= 6000 && printed(&map).contains(&format!("seen over at least {seen} events")));
        let table = folder.path().join("map.csv");
        printed(&format!("{map} --csv {}", table.display()));
        assert!(!column(&fs::read_to_string(table).unwrap(), "seen_events").is_empty());
    }
}

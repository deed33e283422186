//! Stability in three words, rests that name their stops, and how far chaos was seen.

use crate::{Folder, has, list, number, printed, rows, texts};
use std::collections::BTreeSet;

/// An elastic ball between a wall and a moving wall.
const BALL: &str = r#"
parameters = { L = 1, eps = 0.05 }
start = { q = [0.5], qdot = [0.33] }
[machine]
bodies = { ball = 1 }
frequency = 1
stop = [
  { name = "fixed", between = ["ground", "ball"], gap = 0, restitution = 1 },
  { name = "moving", at = "ball", gap = "L", restitution = 1, motion = [{ sin = "-eps" }] },
]
"#;

/// A slider that friction holds, and a hammer on it between two stops.
const SLIDER: &str = r#"
[machine]
coordinates = ["slider", "hammer"]
mass = [1, 1]
stiffness = [[1, -1], [-1, 1]]
damping = [[0.2, -0.2], [-0.2, 0.2]]
frequency = 1.0
force = [{ order = 1, cos = [0, 0.05], sin = [0, 0] }]
stop = [
  { name = "right", direction = [0, 1], gap = 1.0, restitution = 0.5 },
  { name = "left", direction = [0, -1], gap = 1.0, restitution = 0.5 },
]
friction = [{ name = "ground", direction = [1, 0], sliding = 5, static = 5 }]
"#;

/// A structure of three coordinates with stiff stops, whose chaos ends.
const LONG: &str = r#"
start = { q = [-0.1479, -0.0759, 0.2969], qdot = [-0.4201, 0.976, -0.0398], phase = 2.1116 }
[machine]
coordinates = ["x1", "x2", "x3"]
mass = [1.151, 0.3236, 2.706]
stiffness = [[7.08, -3.534, 0.0], [-3.534, 3.8682, -0.3342], [0.0, -0.3342, 0.3342]]
damping = [[0.13005, -0.01095, 0.0], [-0.01095, 0.02223, -0.01128], [0.0, -0.01128, 0.07717]]
constant = [0.0013, 0.2998, 0.3128]
frequency = 1.743
force = [{ order = 1, cos = [0.8068, 0.0, 0.4877], sin = [-0.0504, 0.0, 0.257] }]
stop = [
  { name = "s0", direction = [0.5778, 0.9634, 0.82], gap = 0.5865, stiffness = 389.5, damping = 52.34, opening = "position" },
  { name = "s1", direction = [-1.0, 0.0, 1.0], gap = 0.1934, stiffness = 49980.0, damping = 23.76, opening = "position" },
  { name = "s2", direction = [1.0, 0.0, -1.0], gap = 0.3786, stiffness = 1222.0, damping = 16.39, opening = "position" },
]
"#;

/// The cells of a column of a table.
fn column(table: &str, name: &str) -> Vec<String> {
    let rows = rows(table);
    let at = rows[0].iter().position(|head| *head == name).unwrap_or_else(|| panic!("{name}: {table}"));
    rows[1..].iter().map(|row| row[at].to_owned()).collect()
}

/// 42.5: of 87 points of this branch 33 were called stable, with torus events between them.
#[test]
fn an_elliptic_family_is_neutral() {
    let folder = Folder::with("ball.toml", BALL);
    let orbit = "orbit --machine ball.toml --label 2/1";
    let orbits = folder.json(orbit);
    assert_eq!(texts(&orbits["orbits"], "stability"), ["unstable", "neutral"]);
    assert_eq!(orbits["orbits"][1]["stable"], false);
    has(&folder.printed(orbit), &["\n  unstable; multipliers ", "\n  neutral; multipliers "]);
    let branch = "branch --machine ball.toml --label 2/1 --orbit 2 --vary eps --to 0.001";
    let answer = folder.json(branch);
    let points = list(&answer["branches"][0]["points"]);
    assert!(points.len() > 20);
    assert!(points.iter().all(|point| point["stability"] == "neutral" && point["stable"] == false));
    assert_eq!(texts(&answer["branches"][0]["events"], "kind"), ["end of range"]);
    let count = format!(", {} points\n", points.len());
    let head = "branch 1: 2/1 (orbit 2 of 2, neutral there), eps from ";
    let text = folder.printed(&format!("{branch} --csv branch.csv --plot branch.svg"));
    has(&text, &[head, &count, ", 2/1 neutral: end of range\n"]);
    let figure = folder.read("branch.svg");
    assert!(column(&folder.read("branch.csv"), "stability").iter().all(|word| word == "neutral"));
    assert!(figure.contains(">neutral<") && !figure.contains(">stable<"));
}

/// 42.8: rests on different stops were one motion.
#[test]
fn rests_name_their_stops() {
    let folder = Folder::with("slider.toml", SLIDER);
    let settled = folder.json("settle --machine slider.toml --q=-3,0");
    let motion = &settled["motion"];
    assert!(motion["label"] == "stuck" && motion["stop"] == "left" && motion["stability"] == "neutral", "{motion}");
    assert_eq!(motion["stops"], serde_json::json!(["left"]));
    assert!(settled["events_followed"].as_u64().unwrap() > 0 && settled["time_followed"].is_number());
    has(&folder.printed("settle --machine slider.toml --q=3,0"), &["at rest on right for ever"]);
    let basin = "basin --machine slider.toml --axis q.slider=-3:3:7 --axis q.hammer=-0.5:0.5:3";
    let answer = folder.json(basin);
    let motions = list(&answer["motions"]);
    let stuck: Vec<_> = motions.iter().filter(|motion| motion["label"] == "stuck").collect();
    let stops: Vec<_> = stuck.iter().map(|motion| motion["stop"].as_str().expect("a text")).collect();
    assert_eq!(stops, ["left", "right"]);
    let shares: f64 = stuck.iter().map(|motion| number(&motion["share"])).sum();
    assert!((shares - 12.0 / 21.0).abs() < 1e-12, "{shares}");
    // the rest repeats, beside a joint that holds: none is undecided
    assert!(motions.iter().all(|motion| motion["label"] != "undecided"), "{motions:?}");
    let table = folder.printed(&format!("{basin} --csv -"));
    let cells: Vec<(String, String)> = column(&table, "label").into_iter().zip(column(&table, "stop")).collect();
    let count = |label: &str, stop: &str| cells.iter().filter(|(a, b)| a == label && b == stop).count();
    assert_eq!((count("stuck", "left"), count("stuck", "right"), count("stuck", "")), (6, 6, 0));
    // the same table of a store, in which each rest has a number, and both count as one label
    assert_eq!(folder.printed(&format!("{basin} --store basin.zarr --csv -")), table);
    let long = folder.printed("export basin.zarr --csv -");
    let numbered = cells.iter().zip(column(&long, "cycle").into_iter().zip(column(&long, "closed")));
    let numbers: BTreeSet<_> = numbered.filter(|((label, _), _)| label == "stuck").collect();
    let stops: Vec<_> = numbers.iter().map(|((_, stop), (_, closed))| (stop.as_str(), closed.as_str())).collect();
    // right is stop 0, left is stop 1
    assert_eq!(stops, [("left", "2"), ("right", "1")]);
    has(&folder.printed(&format!("{basin} --store basin.zarr")), &["  stuck      12           57.1 %\n"]);
}

/// The rests of maps have the names of their stops in the tables of the command and of a store.
#[test]
fn rests_of_maps_name_their_stops() {
    let map = "map --machine gear-rattle --axis eps=0.17:0.19:3 --starts 4 --csv -";
    let table = printed(map);
    assert_eq!(
        (column(&table, "label"), column(&table, "stop")),
        (vec!["stuck".to_owned(); 3], vec!["front".to_owned(); 3])
    );
    assert_eq!(printed(&format!("{map} --store map.zarr")), table);
}

/// 42.9: chaos is followed to the end of the budget, and how far stands beside the word.
#[test]
fn chaos_says_how_far_it_was_seen() {
    let folder = Folder::with("long.toml", LONG);
    // how long chaos lasts from a start depends on rounding errors: one from which it lasts long
    let starts = (0..40).map(|k| -0.1479 + 1e-3 * f64::from(k));
    let lines = starts.map(|q| format!("settle --machine long.toml --q={q},-0.0759,0.2969"));
    let long = |line: &String| {
        let whole = folder.json(line);
        (whole["motion"]["label"] == "9/4" && whole["events_followed"].as_u64() > Some(5000)).then_some(whole)
    };
    let (line, whole) = lines.into_iter().find_map(|line| long(&line).map(|whole| (line, whole))).unwrap();
    assert!(whole["chaotic_transient"]["exponents"].is_array());
    let line = format!("{line} --impacts 2000");
    let short = folder.json(&line);
    assert_eq!(short["motion"]["label"], "chaotic");
    let seen = short["motion"]["seen_events"].as_u64().unwrap();
    assert!(seen >= 2000 && short["events_followed"] == seen);
    has(&folder.printed(&line), &[&format!("chaotic: no repetition in {seen} events")]);
    let map = "map --machine long.toml --axis stop.s0.gap=0.5865:0.587:2 --starts 1 --impacts 6000";
    let answer = folder.json(map);
    if texts(&answer["labels"], "label").contains(&"chaotic") {
        let seen = answer["seen_events"].as_u64().unwrap();
        assert!(seen >= 6000);
        has(&folder.printed(map), &[&format!("seen over at least {seen} events")]);
        assert!(!column(&folder.printed(&format!("{map} --csv -")), "seen_events").is_empty());
    }
}

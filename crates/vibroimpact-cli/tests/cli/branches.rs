//! Tests of `vibro branch`: points, events and texts.

use crate::{Folder, has, json, list, number, printed, refuse, rows};
use serde_json::{Value, json};

/// Begins below the flip of 1/1 on the line 1/beta = 1.11.
const DOUBLING: &str = "branch --inverse-beta 1.11 --gap 1.5 --restitution 0.5 --label 1/1 --vary gap";

/// The events of a branch, or of the first one of an answer.
fn events<'a>(branch: &'a Value, kind: &str) -> Vec<&'a Value> {
    let branch = branch.get("branches").map_or(branch, |all| &all[0]);
    list(&branch["events"]).iter().filter(|event| event["kind"] == kind).collect()
}

/// One branch, joined of the two that are followed from the same orbit, for both kinds of system.
#[test]
fn both_ways_from_the_system() {
    for (system, names, (back, start, to)) in [
        (DOUBLING, "gap", (0.2, 1.5, 2.5)),
        ("branch --machine two-mass-hammer --vary frequency", "frequency", (1.3, 1.2, 1.0)),
    ] {
        let whole = json(&format!("{system} --to {back},{to}"));
        let branch = &whole["branches"][0];
        let points = list(&branch["points"]);
        let at = usize::try_from(branch["start"].as_u64().unwrap()).unwrap();
        assert_eq!((&whole["from"], &whole["to"]), (&json!(back), &json!(to)));
        let parameters = [0, at, points.len() - 1].map(|k| points[k]["parameter"].as_f64().unwrap());
        assert_eq!(parameters, [back, start, to]);
        assert_eq!((&branch["begin"], &branch["end"]), (&json!("end of range"), &json!("end of range")));
        let table = printed(&format!("{system} --to {back},{to} --csv -"));
        let marks: Vec<&str> = table.lines().filter(|row| row.contains(",start,")).collect();
        assert!(marks.len() == 1 && marks[0].starts_with(&format!("1,{start},")), "{marks:?}");
        let text = printed(&format!("{system} --to {back},{to}"));
        let ways = [back, to].map(|end| format!("  to {names} {end}:"));
        has(&text, &[&format!("both ways from {start}"), &ways[0], &ways[1]]);
        let beside = format!("{system} --to {},{}", start + 0.1, start + 0.2);
        refuse([(beside, "of the system does not lie between")]);
    }
}

#[test]
fn points_events_and_the_branch_that_begins_at_a_flip() {
    let answer = json(&format!("{DOUBLING} --to 2.5 --follow 3"));
    assert_eq!((&answer["vary"], &answer["from"], &answer["to"]), (&"gap".into(), &1.5.into(), &2.5.into()));
    let flip = events(&answer, "flip")[0];
    assert!((number(&flip["parameter"]) - 1.829_006_189_683_6).abs() < 1e-12);
    for point in list(&answer["branches"][0]["points"]) {
        let before = number(&point["parameter"]) < number(&flip["parameter"]);
        let at = (number(&point["parameter"]) - number(&flip["parameter"])).abs() < 1e-9;
        assert!(at || point["stable"] == before, "{point}");
        assert_eq!((&point["label"], &point["admissible"]), (&"1/1".into(), &true.into()));
        assert_eq!(list(&point["cycle"]).len(), 1);
    }
    let place = flip["point"].as_u64().unwrap();
    assert_eq!(answer["branches"][0]["points"][usize::try_from(place).unwrap()]["parameter"], flip["parameter"]);
    let end = list(&answer["branches"][0]["events"]).last().unwrap();
    assert_eq!((&end["kind"], &end["ends"], &end["parameter"]), (&"end of range".into(), &true.into(), &2.5.into()));

    assert_eq!(list(&answer["branches"]).len(), 2);
    assert_eq!((&answer["branches"][0]["from"], &answer["branches"][0]["end"]), (&Value::Null, &"end of range".into()));
    let second = &answer["branches"][1];
    assert_eq!((&second["from"]["kind"], &second["from"]["branch"]), (&"flip".into(), &1.into()));
    assert_eq!(second["from"]["parameter"], flip["parameter"]);
    let grazing = events(second, "grazing")[0];
    assert_eq!((&grazing["before"], &grazing["after"]), (&"2/2".into(), &"1/2".into()));
    assert_eq!((&grazing["appears"], &grazing["turns"]), (&false.into(), &true.into()));
    assert_eq!((&grazing["impact"], &grazing["stop"]), (&2.into(), &"upper".into()));
    assert!(number(&grazing["phase"]) > 0.0 && events(second, "fold").len() == 1);
    assert_eq!(list(&json(&format!("{DOUBLING} --to 2.5"))["branches"]).len(), 1);
}

/// The numbers of a body vary themselves, so both ends of a branch are printed as they were typed.
#[test]
fn typed_ends_come_back() {
    let machine = "branch --mass-kg 0.8 --stiffness-n-per-m 12000 --force-n 30 --damping-ratio 0.02 --restitution 0.65 \
                   --label 1/1";
    let ends = |line: &str| {
        let answer = json(&format!("{machine} {line}"));
        let point = |k: usize| answer["branches"][0]["points"][k]["parameter"].to_string();
        let last = list(&answer["branches"][0]["points"]).len() - 1;
        let table = printed(&format!("{machine} {line} --csv -"));
        let rows: Vec<&str> = table.lines().filter(|row| row.starts_with("1,")).collect();
        let cell = |row: &str| row.split(',').nth(1).unwrap().parse::<f64>().unwrap().to_string();
        let table = [cell(rows[0]), cell(rows[last])];
        ([answer["from"].to_string(), answer["to"].to_string()], [point(0), point(last)], table)
    };
    for hertz in ["20.0", "20.1", "19.37", "18.3"] {
        let line = format!("--gap-m 0.0015 --frequency-hz {hertz} --vary frequency-hz --to 23.7");
        let (typed, points, table) = ends(&line);
        assert_eq!((&typed[0], &typed[1]), (&hertz.to_owned(), &"23.7".to_owned()));
        assert_eq!((&points, table.map(|cell| format!("{:?}", cell.parse::<f64>().unwrap()))), (&typed, typed.clone()));
    }
    let (typed, points, _) = ends("--frequency-hz 20 --gap-m 0.0015 --vary gap-m --to 0.0016");
    assert_eq!((&typed, &points), (&["0.0015".to_owned(), "0.0016".to_owned()], &typed));
}

#[test]
fn text_and_table() {
    let text = printed(&format!("{DOUBLING} --to 2.5 --follow 1"));
    let sentences = [
        "branch 1: 1/1 (stable there), gap from 1.5 to 2.5",
        "flip   1.82900618968  1/1 stable  1/1 unstable",
        "ends at gap 2.50000000000, 1/1 unstable: end of range",
        "branch 2: 2/2 from the flip of branch 1 at gap 1.82900618968",
        "impact 2 on the stop disappears",
    ];
    has(&text, &sentences);
    let table = printed(&format!("{DOUBLING} --to 2.5 --follow 1 --csv -"));
    let rows = rows(&table);
    assert_eq!(rows[0][..7], ["branch", "gap", "label", "admissible", "stable", "stability", "event"]);
    assert!(rows.iter().all(|row| row.len() == rows[0].len()), "{table}");
    let double = rows.iter().find(|row| row[0] == "2" && row[2] == "2/2").unwrap();
    assert_eq!((double[13].split(' ').count(), double[14].split(' ').count()), (2, 2));
    assert!(rows.iter().any(|row| row[6] == "flip") && rows.iter().any(|row| row[0] == "2" && row[2] == "1/2"));
}

/// inf/n has no equations and is followed by its release. Its phases of sticking are reported at each point.
#[test]
fn a_cycle_that_rests() {
    let line = "branch --inverse-beta 2.5 --gap 0.25 --restitution 0.5 --label inf/1 --vary gap --to 1";
    let answer = json(line);
    for point in list(&answer["branches"][0]["points"]) {
        let cycle = list(&point["cycle"]);
        let of = |kind: &str| cycle.iter().find(|event| event["kind"] == kind).unwrap();
        let (stick, leaves) = (of("stick"), of("release"));
        assert!(point["label"] == "inf/1" && point["stable"] == true && stick["chatter"] == true, "{point}");
        assert!(number(&stick["phase"]) < number(&leaves["phase"]));
        assert_eq!(point["multipliers"], serde_json::json!([[0.0, 0.0], [0.0, 0.0]]));
    }
    let head = "branch 1: inf/1 (stable there), gap from 0.25 to 1";
    has(&printed(line), &[head, "it lands on the stop without speed", "the rest on the stop is over as it begins"]);
    let table = printed(&format!("{line} --csv -"));
    assert!(rows(&table)[1..].iter().all(|row| row.len() == 16 && row[2..6] == ["inf/1", "true", "true", "stable"]));
    // with restitution 0 the label is m/n, and an impact follows the release
    let zero = "branch --inverse-beta 1.3 --gap 0.3 --restitution 0 --label 1/1 --vary gap --to 1";
    has(&printed(zero), &["1/1 stable      2/1 stable      an impact on the stop appears after the release"]);
}

/// Two identical stops: the symmetric 2/1 loses its symmetry to two mirror-image orbits, which --follow follows.
#[test]
fn the_branches_at_a_branch_point() {
    let system = "--gap 0.4 --restitution 0.8 --damping 0.02 --second-gap 0.4 --second-restitution 0.8";
    let line = format!("branch --beta 2 {system} --label 2/1 --vary beta --to 1.5 --follow 2");
    let answer = json(&line);
    let point = events(&answer, "branch point")[0];
    let branches = &answer["branches"].as_array().unwrap()[1..];
    assert_eq!(branches.len(), 2);
    for branch in branches {
        assert_eq!((&branch["from"]["kind"], &branch["from"]["branch"]), (&"branch point".into(), &1.into()));
        assert_eq!(branch["from"]["parameter"], point["parameter"]);
        assert!(list(&branch["points"]).len() > 20);
    }
    let from = [2, 3].map(|number| format!("branch {number}: 2/1 from the branch point of branch 1 at beta"));
    has(&printed(&line), &["branch point", &from[0], &from[1]]);
}

/// Two equal masses side by side, driven alike, strike their stops at the same time where the gaps are equal: both are named.
#[test]
fn a_corner_names_both_stops() {
    let text = r#"
[machine]
bodies = { a = 1, b = 1 }
frequency = 1.1
link = [
  { between = ["a", "ground"], stiffness = 1, damping = 0.2 },
  { between = ["b", "ground"], stiffness = 1, damping = 0.2 },
  { between = ["a", "b"], stiffness = 0.2, damping = 0.02 },
]
force = [{ at = "a", sin = 1 }, { at = "b", sin = 1 }]
stop = [
  { name = "one", at = "a", gap = 0.3, restitution = 0.6 },
  { name = "two", at = "b", gap = 0.4, restitution = 0.6 },
]
"#;
    let answer = Folder::with("two.toml", text).json("branch --machine two.toml --vary stop.one.gap --to 0.6");
    let corner = &events(&answer, "corner")[0];
    assert!((number(&corner["parameter"]) - 0.4).abs() < 1e-9, "{corner}");
    let names = [&corner["stop"], &corner["also"]["stop"]].map(|name| name.as_str().unwrap());
    assert!(names == ["one", "two"] || names == ["two", "one"], "{corner}");
}

/// Two simultaneous grazing contacts, one on each of two identical stops, are both reported.
#[test]
fn touches_of_both_stops() {
    let line = "branch --beta 0.7 --gap 3 --restitution 0.6 --damping 0.1 --second-gap 3 --second-restitution 0.6 --label 0 --vary beta --to 1.2";
    let grazing = &events(&json(line), "grazing")[0].clone();
    assert_eq!((&grazing["before"], &grazing["after"]), (&"0".into(), &"2/1".into()));
    assert!(grazing["stop"] != grazing["also"]["stop"] && grazing["impact"] == Value::Null);
    let apart = (number(&grazing["phase"]) - number(&grazing["also"]["phase"])).abs();
    assert!((apart - std::f64::consts::PI).abs() < 1e-9);
    has(&printed(line), &["an impact on the stop appears, phase 2.1019, and an impact on the second stop appears"]);
}

/// A branch that ends because ever more impacts are added reports this, and the limit.
#[test]
fn ever_more_impacts() {
    let line = "branch --inverse-beta 1.11 --gap -0.3 --restitution 0.5 --label 4/1 --vary gap --to -1";
    let limit = "impacts are added without end, towards a rest on the stop at phase 3.51709; beyond, inf/1";
    has(&printed(line), &[limit]);
}

/// Along a line through two parameters each event has both values. It is an event in the gap alone at the same
/// frequency.
#[test]
fn a_line_through_two_parameters() {
    let answer = json(&format!("{DOUBLING} --to 2.5 --also inverse-beta=1.05"));
    let flip = events(&answer, "flip")[0];
    let (gap, inverse) = (number(&flip["values"][0]), number(&flip["values"][1]));
    assert_eq!(flip["values"][0], flip["parameter"]);
    assert!((inverse - (1.11 - 0.06 * (gap - 1.5))).abs() < 1e-15, "{inverse}");
    let alone = format!("branch --inverse-beta {inverse} --gap 1.5 --restitution 0.5 --label 1/1 --vary gap --to 2.5");
    assert!((number(&events(&json(&alone), "flip")[0]["parameter"]) - gap).abs() < 1e-11);
    assert_eq!(answer["also"], serde_json::json!({ "parameter": "inverse_beta", "from": 1.11, "to": 1.05 }));
    let text = printed(&format!("{DOUBLING} --to 2.5 --also inverse-beta=1.05"));
    assert!(text.contains("gap from 1.5 to 2.5, inverse beta from 1.11 to 1.05"), "{text}");
    let table = printed(&format!("{DOUBLING} --to 2.5 --also inverse-beta=1.05 --csv -"));
    assert!(table.starts_with("branch,gap,inverse_beta,label,"));
    let refused = [("gap=2", "gap and gap cannot vary together"), ("restitution=2", "restitution eps = 2")];
    refuse(refused.map(|(also, sentence)| (format!("{DOUBLING} --to 2.5 --also {also}"), sentence)));
}

/// From 1/1 through 17/1 to the complete chatter: more labels than the legend names, which names those with the longest ranges.
#[test]
fn the_legend_names_the_longest_of_many_labels() {
    let folder = Folder::new();
    let line = "branch --inverse-beta 1.11 --gap 1 --restitution 0.5 --label 1/1 --vary gap --to -1";
    folder.printed(&format!("{line} --plot branch.svg"));
    let figure = folder.read("branch.svg");
    for text in [">1/1<", ">2/1<", ">∞/1<", " others<"] {
        assert!(figure.contains(text), "{text}");
    }
    assert!(!figure.contains(">17/1<"));
}

/// Regression test (item 11): between a fold and a flip 3e-6 apart the table had no stability.
#[test]
fn f11_between_close_events_the_stability_is_known() {
    let line = "branch --beta 2.55 --gap 0 --restitution 0.8 --label 1/1 --vary beta --to 3 --follow 4";
    let text = printed(line);
    let rows = |kind: &str| text.lines().filter(|row| row.trim_start().starts_with(kind)).collect::<Vec<_>>();
    let fold = rows("fold").into_iter().find(|row| row.contains("2.84935992652")).unwrap();
    assert!(fold.contains("5/4 unstable  5/4 stable"), "{fold}");
    let flip = rows("flip").into_iter().find(|row| row.contains("2.84936316018")).unwrap();
    assert!(flip.contains("5/4 stable    5/4 unstable"), "{flip}");
    for row in rows("fold").iter().chain(&rows("flip")) {
        let states: Vec<&str> =
            row.split_whitespace().filter(|word| word.ends_with("stable") || *word == "unresolved").collect();
        assert_eq!(states.len(), 2, "{row}");
    }
}

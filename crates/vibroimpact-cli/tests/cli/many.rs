//! `vibro settle-many`: points that are listed in a table or drawn from ranges, with and without a store.
#![allow(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::{Folder, has, list, vibro};
use serde_json::{Value, json};

const HYPERCUBE: &str =
    "settle-many --sample lhs:120 --seed 3 --inverse-beta 0.6:2 --gap 0:2 --restitution 0.3:0.8 --v 0.5";

/// A row of a table without its first cell, the number of the point.
fn rows(text: &str) -> Vec<Vec<String>> {
    text.lines().map(|line| line.split(',').skip(1).map(str::to_owned).collect()).collect()
}

#[test]
fn a_sample_is_that_of_its_plan_in_memory_in_a_store_and_as_a_table() {
    let (folder, task) = (Folder::new(), "--fields impact-speed-max --transient");
    let memory = folder.printed(&format!("{HYPERCUBE} {task} --csv -"));
    assert_eq!(memory.lines().count(), 121);
    let store = folder.printed(&format!("{HYPERCUBE} {task} --store cube.zarr --tile 25 --csv -"));
    assert_eq!(memory, store);
    // the same plan as a file
    let of = |vary: &str, from: f64, to: f64| json!({ "vary": vary, "from": from, "to": to });
    let over = [of("inverse_beta", 0.6, 2.0), of("gap", 0.0, 2.0), of("restitution", 0.3, 0.8)];
    let drawn = json!({ "rule": "lhs", "count": 120, "seed": 3, "over": over });
    let basin = json!({ "points": { "drawn": drawn }, "start": { "v": 0.5 }, "fields": ["impact_speed_max"], "transient": true });
    let plan = json!({ "version": 1, "tile": 25, "system": { "restitution": 0.3 }, "task": { "basin": basin } });
    folder.write("plan.json", plan.to_string());
    let ran = folder.json("run plan.json --store cube.zarr");
    assert_eq!((&ran["computed"], &ran["found"]), (&json!(0), &json!(5)));
    // the values of the sample as a table
    let columns: Vec<String> = rows(&memory).iter().map(|row| row[..3].join(",")).collect();
    folder.write("points.csv", columns.join("\n"));
    let listed = folder.printed(&format!("settle-many --points points.csv --v 0.5 {task} --csv -"));
    assert_eq!(listed, memory);
    // and from stdin, with the names of flags
    let table = columns.join("\n").replace("inverse_beta", "inverse-beta");
    let mut piped = vibro(&format!("settle-many --points - --v 0.5 {task} --csv -"));
    let output = piped.write_stdin(table).output().unwrap();
    assert_eq!(String::from_utf8(output.stdout).unwrap(), memory);
}

#[test]
fn a_sample_is_exported_and_verified() {
    let folder = Folder::new();
    let line = format!("{HYPERCUBE} --tile 10 --store cube.zarr");
    assert!(folder.printed(&format!("{HYPERCUBE} --csv -")) == folder.printed(&format!("{line} --csv -")));
    // an export has all fields
    has(folder.printed("export cube.zarr --csv -").lines().next().unwrap(), &["multiplier_1_re"]);
    has(&folder.printed("verify cube.zarr --sample 3"), &["12"]);
}

/// A body in SI units has the same motions as its oscillator.
#[test]
fn the_same_motions_in_other_units() {
    let folder = Folder::new();
    // F/k = 5 mm, omega_n = 20 /s
    let machine = "--mass-kg 2 --stiffness-n-per-m 800 --force-n 4 --frequency-hz 2.5 --restitution 0.6";
    let beta = 2.5 * std::f64::consts::TAU / 20.0;
    let sobol = |rest: &str| folder.printed(&format!("settle-many --sample sobol:32 {rest} --csv -"));
    let metres = sobol(&format!("{machine} --gap-m 0.001:0.006 --v 0.02"));
    let plain = sobol(&format!("--beta {beta} --gap 0.2:1.2 --restitution 0.6 --v 0.2"));
    let labels = |text: &str| rows(text).iter().skip(1).map(|row| row[1].clone()).collect::<Vec<_>>();
    assert_eq!(labels(&metres), labels(&plain));
    assert!(metres.starts_with("sample,gap_m,label"), "{metres}");
    folder.write("gaps.csv", "gap_m,v\n0.001,0.02\n0.004,0.02\n");
    let listed = folder.printed(&format!("settle-many --points gaps.csv {machine} --csv -"));
    assert!(rows(&listed)[2][..2] == ["0.004", "0.02"], "{listed}");
}

#[test]
fn summaries_and_refusals() {
    let folder = Folder::new();
    let text = folder.printed("settle-many --sample sobol:64 --beta 1 --gap 1 --restitution 0.5 --v -2:2");
    has(&text, &["64 points", "share of starts"]);
    let line = "settle-many --sample sobol:8 --beta 1 --gap 0.5:1 --restitution 0.5";
    let answer = folder.json(line);
    let points = list(&answer["points"]);
    let table = folder.printed(&format!("{line} --csv -"));
    let row = |point: &Value| format!("{},{}", point["gap"], point["motions"][0]["label"].as_str().unwrap());
    let listed: Vec<String> = rows(&table).iter().skip(1).map(|row| row.join(",")).collect();
    assert!(points.len() == 8 && listed == points.iter().map(row).collect::<Vec<_>>(), "{answer} {table}");
    assert!(answer["system"]["gap"].is_null() && answer["system"]["restitution"] == 0.5, "{answer}");
    assert_eq!(answer["plan"]["task"]["basin"]["points"]["drawn"]["rule"], "sobol");
    folder.write("gaps.csv", "gap\n0.5\n1\n");
    folder.write("bad.csv", "gap,mass\n0.5,1\n");
    let many = |rest: &str| format!("settle-many {rest} --restitution 0.5");
    folder.refuse([
        (many("--beta 1 --gap 0:1"), "the following required arguments were not provided"),
        (many("--sample lhs:9 --beta 1 --gap 1"), "nothing varies"),
        (many("--points gaps.csv --beta 1 --gap 1"), "--gap cannot go together with the column gap"),
        (many("--points gaps.csv --beta 1:2"), "--beta is a range, and points of a table have one value"),
        (many("--points gaps.csv --beta 1 --v -1:1"), "--v is a range"),
        (many("--points bad.csv --beta 1"), "`bad.csv`: the column `mass` is no parameter"),
        (many("--points none.csv --beta 1"), "the points `none.csv` cannot be read"),
        ("settle-many --points gaps.csv --beta 1".to_owned(), "the restitution is not given"),
        (many("--points gaps.csv"), "the frequency is given nowhere"),
        (many("--sample lhs:9 --beta 1 --gap 0:1 --tile 3"), "--store"),
    ]);
}

/// Points of a machine: listed and drawn ones are as single questions, and what makes no sense is refused.
#[test]
fn points_of_a_machine() {
    let folder = Folder::with("points.csv", "q.head,b\n0,0.4\n0.2,0.6\n7,0.3\n");
    let machine = "settle-many --machine two-mass-hammer";
    let listed = format!("{machine} --points points.csv --csv - --fields power");
    let table = folder.printed(&listed);
    let rows = crate::rows(&table);
    assert_eq!(rows[0], ["sample", "q.head", "b", "label", "power"]);
    assert_eq!((rows.len(), rows[3][3], rows[3][4]), (4, "refused", ""));
    for row in &rows[1..3] {
        let alone = folder.json(&format!("settle --machine two-mass-hammer --set b={} --q 0,{}", row[2], row[1]));
        assert_eq!(alone["motion"]["label"], row[3]);
        assert_eq!(alone["motion"]["quantities"]["power"].as_f64().unwrap(), row[4].parse::<f64>().unwrap());
    }
    let stored = folder.printed(&format!("{listed} --store points.zarr"));
    assert_eq!(stored, table, "the table of the store");
    let drawn = folder.json(&format!("{machine} --sample lhs:6 --seed 2 --over frequency=0.9:1.3"));
    let points = list(&drawn["points"]);
    assert!(points.len() == 6 && points.iter().all(|point| point["motions"][0]["label"].is_string()), "{drawn}");
    folder.refuse([
        (format!("{machine} --sample lhs:6"), "--over PATH=A:B"),
        (format!("{machine} --sample lhs:6 --over nix=1:2"), "no such number in this machine"),
        (format!("{machine} --sample lhs:6 --over q.nix=1:2"), "q.nix"),
        (format!("{machine} --sample lhs:6 --over b=1:2 --transient"), "for points of oscillators"),
    ]);
}

/// The figure of labels over the points is the same from memory and from a store.
#[test]
fn labels_over_the_points() {
    let folder = Folder::new();
    for (k, (line, across, label)) in [
        ("--sample sobol:16 --beta 1 --gap 0.5:1 --restitution 0.5 --v -1:1", ">δ<", "1/1"),
        ("--machine two-mass-hammer --sample sobol:4 --over frequency=0.9:1.3 --over q.head=-1:0.4", "frequency", "/1"),
    ]
    .into_iter()
    .enumerate()
    {
        let drawn = folder.drawn(&format!("settle-many {line}"), "a.svg");
        has(&drawn, &[across, label]);
        folder.printed(&format!("settle-many {line} --store {k}.zarr"));
        folder.printed(&format!("plot {k}.zarr stored-{k}.svg"));
        assert_eq!(drawn, folder.read(&format!("stored-{k}.svg")), "{line}");
    }
}

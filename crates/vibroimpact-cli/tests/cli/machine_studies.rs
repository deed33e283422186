//! Studies of machines from outside: the same results with a store and without, in parts, refined, damaged and mended.
#![allow(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::{files, json, printed_in, refused, refused_in, vibro};
use serde_json::Value;
use std::fs;

const FIELDS: &str = "map --machine two-mass-hammer --axis stop.anvil.gap=0.3:0.7:5 --starts 2 --fields power,stop.anvil.impact-speed-max,q.head.displacement_rms";
const MAP: &str =
    "map --machine two-mass-hammer --axis frequency=0.8:1.2:9 --axis stop.anvil.gap=0.3,0.5,0.75 --starts 3";
const BASIN: &str = "basin --machine impact-damper --axis q.particle=-0.3:0.3:7 --axis qdot.particle=-1:1:5";

const DIAGRAM: &str = "diagram --machine two-mass-hammer --vary stop.anvil.gap --over 0.3:0.7:7 --transient 50";

/// The table and the figure of a store are those of the command without one, byte by byte.
#[test]
fn stores_have_the_results_of_commands() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    for (name, line) in [
        ("map", MAP),
        ("basin", BASIN),
        ("line", "map --machine soft-stop --axis frequency=0.7:0.9:5 --starts 2"),
        ("fields", FIELDS),
        (
            "basin-fields",
            "basin --machine soft-stop --axis q.mass=-1:2:4 --axis phase=0:6:3 --fields stop.stop.force_max",
        ),
        ("diagram", DIAGRAM),
        ("listed", "diagram --machine two-mass-hammer --vary stop.anvil.gap --over 0.7,0.6,0.35,0.3 --transient 50"),
        (
            "quantity",
            "diagram --machine two-mass-hammer --vary frequency --over 0.9:1.1:5 --show stop.anvil.impact_loss_per_period",
        ),
        (
            "scatter",
            "diagram --machine soft-stop --vary frequency --over 0.7:0.9:3 --show qdot.mass --direction scatter --starts 3 --transient 20",
        ),
    ] {
        printed_in(here, &format!("{line} --csv {name}.csv --plot {name}.svg"));
        printed_in(here, &format!("{line} --store {name}.zarr --csv {name}-stored.csv --plot {name}-stored.svg"));
        for kind in ["csv", "svg"] {
            let read = |name: &str| fs::read_to_string(here.join(format!("{name}.{kind}"))).unwrap();
            assert_eq!(read(name), read(&format!("{name}-stored")), "{name}.{kind}");
        }
        printed_in(here, &format!("plot {name}.zarr {name}-again.svg"));
        assert_eq!(
            fs::read(here.join(format!("{name}.svg"))).unwrap(),
            fs::read(here.join(format!("{name}-again.svg"))).unwrap()
        );
        assert!(printed_in(here, &format!("verify {name}.zarr --sample 100")).contains("nothing is wrong"), "{name}");
        let status = printed_in(here, &format!("status {name}.zarr"));
        assert!(status.contains("complete\n") && status.contains("[machine]"), "{status}");
    }
}

/// The hint of a refusal names the tasks of machines that a store takes.
#[test]
fn attractors_of_machines_have_no_store() {
    let folder = tempfile::tempdir().unwrap();
    let plan = json("attractors --machine two-mass-hammer --starts 2")["plan"].clone();
    fs::write(folder.path().join("a.json"), plan.to_string()).unwrap();
    let complaint = refused_in(folder.path(), "run a.json --store a.zarr");
    assert!(complaint.contains("map, basin, settle-many, diagram, and lyapunov over axes"), "{complaint}");
}

/// Two jobs with a part each fill the same store as one, byte by byte; a tile that is damaged is computed again.
#[test]
fn parts_and_damage() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let plan = json(BASIN)["plan"].clone();
    fs::write(here.join("study.json"), plan.to_string()).unwrap();
    printed_in(here, "run study.json");
    printed_in(here, "run study.json --store parts.zarr --tiles 2/2");
    let half: Value = serde_json::from_str(&printed_in(here, "status parts.zarr --json")).unwrap();
    assert!(half["complete"] == false && half["tiles_done"].as_u64() < half["tiles"].as_u64(), "{half}");
    printed_in(here, "run study.json --store parts.zarr --tiles 1/2");
    let whole = files(&here.join("study.zarr"));
    assert_eq!(files(&here.join("parts.zarr")), whole);
    // the first chunk of the labels
    let chunk = whole.keys().find(|name| name.starts_with("label/c/")).unwrap();
    fs::write(here.join("parts.zarr").join(chunk), b"damaged").unwrap();
    assert_eq!(vibro("verify parts.zarr").current_dir(here).output().unwrap().status.code(), Some(1));
    printed_in(here, "resume parts.zarr");
    assert_eq!(files(&here.join("parts.zarr")), whole);
    let script = printed_in(here, "slurm study.json --jobs 4");
    assert!(script.contains("run ") && script.contains("--tiles"), "{script}");
}

/// A refined map has the labels of the whole one at every point that it computes, and fewer of them.
#[test]
fn refined_maps() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let line = "map --machine two-mass-hammer --axis frequency=0.9:1.2:17 --axis stop.anvil.gap=0.4:0.6:9 --starts 1";
    let whole = printed_in(here, &format!("{line} --csv -"));
    printed_in(here, &format!("{line} --store refined.zarr --tile 17 --refine 4"));
    let table = printed_in(here, "export refined.zarr --csv -");
    let labels: Vec<&str> = whole.lines().skip(1).map(|row| row.split(',').nth(2).unwrap()).collect();
    let rows: Vec<Vec<&str>> = table.lines().skip(1).map(|row| row.split(',').collect()).collect();
    assert_eq!((labels.len(), rows.len()), (17 * 9, 17 * 9));
    let computed = rows.iter().zip(&labels).filter(|(row, _)| row[6] == "computed");
    assert!(computed.clone().all(|(row, label)| row[2] == *label));
    assert!(computed.count() < 17 * 9);
}

/// The oscillator at S of the 1971 paper as a machine.
const ONE: &str = "[machine]\ncoordinates = [\"x\"]\nmass = [1]\nstiffness = [1]\nfrequency = 0.76923076923076927\n\
    force = [{ sin = [1] }]\nstop = [{ name = \"wall\", direction = [1], gap = 0.75, restitution = 0.5 }]\n";

/// The values of fields are the quantities of the motions that `settle` reports.
#[test]
fn fields_are_quantities() {
    let folder = tempfile::tempdir().unwrap();
    let table = printed_in(folder.path(), &format!("{FIELDS} --csv -"));
    let mut lines = table.lines();
    let header = "stop.anvil.gap,label,share,power,stop.anvil.impact_speed_max,q.head.displacement_rms";
    assert_eq!(lines.next(), Some(header));
    for line in lines {
        let cells: Vec<&str> = line.split(',').collect();
        let settled = json(&format!("settle --machine two-mass-hammer --set stop.anvil.gap={}", cells[0]));
        assert_eq!(settled["motion"]["label"], cells[1]);
        let quantities = &settled["motion"]["quantities"];
        let expected = [
            &quantities["power"],
            &quantities["stops"]["anvil"]["impact_speed_max"],
            &quantities["coordinates"]["head"]["displacement_rms"],
        ];
        for (cell, value) in cells[3..].iter().zip(expected) {
            let (a, b) = (cell.parse::<f64>().unwrap(), value.as_f64().unwrap());
            assert!((a - b).abs() < 1e-7 * b.abs(), "{line}: {value}");
        }
    }
    let said = refused("map --machine two-mass-hammer --axis frequency=1:2:3 --starts 1 --fields stop.anvil.gap");
    assert!(said.contains("stop.anvil.gap"), "{said}");
}

/// Sweeps of a machine of one coordinate are those of the oscillator, hysteresis included.
#[test]
fn a_diagram_of_one_coordinate_is_that_of_the_oscillator() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::write(here.join("one.toml"), ONE).unwrap();
    // value, sweep, and the numbers of the row, in order
    let rows = |line: &str, numbers: &[usize]| {
        let mut rows: Vec<(String, String, Vec<f64>)> = printed_in(here, line)
            .lines()
            .skip(1)
            .map(|row| {
                let cells: Vec<&str> = row.split(',').collect();
                let of = |k: &usize| cells[*k].parse().unwrap_or(f64::NAN);
                (cells[0].to_owned(), cells[1].to_owned(), numbers.iter().map(of).collect())
            })
            .collect();
        // a cycle can begin at another impact
        rows.sort_by(|a, b| (&a.0, &a.1).cmp(&(&b.0, &b.1)).then(a.2[0].total_cmp(&b.2[0])));
        rows
    };
    let machine = "diagram --machine one.toml --vary stop.wall.gap --over 0.5:1:11 --csv -";
    let osc = "diagram --inverse-beta 1.3 --restitution 0.5 --vary gap --over 0.5:1:11 --csv -";
    for (line, of_machine, of_osc) in [("", [4, 5], [4, 5]), ("strobe", [3, 3], [3, 3])] {
        let (a, b) = if line.is_empty() {
            (machine.to_owned(), osc.to_owned())
        } else {
            (format!("{machine} --show q.x"), format!("{osc} --show strobe"))
        };
        let (found, expected) = (rows(&a, &of_machine), rows(&b, &of_osc));
        assert_eq!(found.len(), expected.len(), "{line}");
        for (a, b) in found.iter().zip(&expected) {
            assert_eq!((&a.0, &a.1), (&b.0, &b.1));
            assert!(a.2.iter().zip(&b.2).all(|(a, b)| (a - b).abs() < 1e-8), "{a:?} {b:?}");
        }
    }
    // both motions of S
    let here_at = |sweep: &str| rows(machine, &[5]).iter().filter(|row| row.0 == "0.75" && row.1 == sweep).count();
    assert_eq!((here_at("up"), here_at("down")), (2, 1));
}

/// The start of a diagram is legal or is put onto the stop at its first value, whatever the machine's own value is; so are
/// scattered starts.
#[test]
fn starts_of_diagrams() {
    let folder = tempfile::tempdir().unwrap();
    for line in [
        "diagram --machine bouncing-ball --set e=0.5 --vary Gamma --over 1.1:1.75:3 --direction up --phase 0.51 --q 1 --qdot 4.1",
        "diagram --machine impact-pair --vary a --over 0.1:2:4 --direction scatter --starts 3 --transient 50",
    ] {
        let told = printed_in(folder.path(), &format!("{line} --json"));
        let told: Value = serde_json::from_str(&told).unwrap();
        assert!(told["sweeps"][0]["points"].as_u64() > Some(0), "{told}");
    }
}

/// The starts of a machine of one coordinate lead to the motions to which those of the oscillator lead.
#[test]
fn a_basin_of_one_coordinate_is_that_of_the_oscillator() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let plane = [("x", "-3:0.7:9"), ("v", "-2:2:7")];
    printed_in(here, &format!("basin {} --x {} --v {} --csv osc.csv", crate::S, plane[0].1, plane[1].1));
    fs::write(here.join("one.toml"), ONE).unwrap();
    let line = format!("basin --machine one.toml --axis q.x={} --axis qdot.x={}", plane[0].1, plane[1].1);
    printed_in(here, &format!("{line} --store one.zarr --csv one.csv"));
    let read = |name: &str| fs::read_to_string(here.join(name)).unwrap();
    let rows = |text: String| text.lines().skip(1).map(str::to_owned).collect::<Vec<_>>();
    assert_eq!(rows(read("one.csv")), rows(read("osc.csv")));
    assert!(read("osc.csv").contains("2/1") && read("osc.csv").contains("1/1"));
}

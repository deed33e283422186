//! Studies of machines from outside: the same results with a store and without, in parts, refined, damaged and mended.
#![allow(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::{Folder, has, json, number, printed, refuse, rows};

const FIELDS: &str = "map --machine two-mass-hammer --axis stop.anvil.gap=0.3:0.7:5 --starts 2 --fields power,stop.anvil.impact-speed-max,q.head.displacement_rms";
const MAP: &str =
    "map --machine two-mass-hammer --axis frequency=0.8:1.2:9 --axis stop.anvil.gap=0.3,0.5,0.75 --starts 3";
const BASIN: &str = "basin --machine impact-damper --axis q.particle=-0.3:0.3:7 --axis qdot.particle=-1:1:5";

const DIAGRAM: &str = "diagram --machine two-mass-hammer --vary stop.anvil.gap --over 0.3:0.7:7 --transient 50";

/// The table and the figure of a store are those of the command without one, byte by byte.
#[test]
fn stores_have_the_results_of_commands() {
    let folder = Folder::new();
    let (soft, over) = ("--machine soft-stop", "diagram --machine two-mass-hammer --vary");
    let scatter = format!("diagram {soft} --vary frequency --over 0.7:0.9:3");
    for (name, line) in [
        ("map", MAP),
        ("basin", BASIN),
        ("line", "map --machine soft-stop --axis frequency=0.7:0.9:5 --starts 2"),
        ("fields", FIELDS),
        ("basin-fields", &format!("basin {soft} --axis q.mass=-1:2:4 --axis phase=0:6:3 --fields stop.stop.force_max")),
        ("diagram", DIAGRAM),
        ("listed", &format!("{over} stop.anvil.gap --over 0.7,0.6,0.35,0.3 --transient 50")),
        ("quantity", &format!("{over} frequency --over 0.9:1.1:5 --show stop.anvil.impact_loss_per_period")),
        ("scatter", &format!("{scatter} --show qdot.mass --direction scatter --starts 3 --transient 20")),
    ] {
        folder.printed(&format!("{line} --csv {name}.csv --plot {name}.svg"));
        folder.printed(&format!("{line} --store {name}.zarr --csv {name}-stored.csv --plot {name}-stored.svg"));
        folder.printed(&format!("plot {name}.zarr {name}-again.svg"));
        let read = |end: &str| folder.read(&format!("{name}{end}"));
        assert_eq!(read(".csv"), read("-stored.csv"), "{name}");
        assert_eq!((read(".svg"), read(".svg")), (read("-stored.svg"), read("-again.svg")), "{name}");
        assert!(folder.printed(&format!("verify {name}.zarr --sample 100")).contains("nothing is wrong"), "{name}");
        let status = folder.printed(&format!("status {name}.zarr"));
        has(&status, &["complete\n", "[machine]"]);
    }
}

/// The hint of a refusal names the tasks of machines that a store takes.
#[test]
fn attractors_of_machines_have_no_store() {
    let folder = Folder::new();
    let plan = json("attractors --machine two-mass-hammer --starts 2")["plan"].clone();
    folder.write("a.json", plan.to_string());
    folder.refuse([("run a.json --store a.zarr", "map, basin, settle-many, diagram, and lyapunov over axes")]);
}

/// A refined map has the labels of the whole one at every point that it computes, and fewer of them.
#[test]
fn refined_maps() {
    let folder = Folder::new();
    let line = "map --machine two-mass-hammer --axis frequency=0.9:1.2:17 --axis stop.anvil.gap=0.4:0.6:9 --starts 1";
    let whole = folder.printed(&format!("{line} --csv -"));
    folder.printed(&format!("{line} --store refined.zarr --tile 17 --refine 4"));
    let table = folder.printed("export refined.zarr --csv -");
    let (whole, rows) = (rows(&whole), rows(&table));
    assert_eq!((whole.len(), rows.len()), (17 * 9 + 1, 17 * 9 + 1));
    let computed = rows.iter().zip(&whole).skip(1).filter(|(row, _)| row[6] == "computed");
    assert!(computed.clone().all(|(row, whole)| row[2] == whole[2]));
    assert!(computed.count() < 17 * 9);
}

/// The oscillator at S of the 1971 paper as a machine.
const ONE: &str = "[machine]\ncoordinates = [\"x\"]\nmass = [1]\nstiffness = [1]\nfrequency = 0.76923076923076927\n\
    force = [{ sin = [1] }]\nstop = [{ name = \"wall\", direction = [1], gap = 0.75, restitution = 0.5 }]\n";

/// The values of fields are the quantities of the motions that `settle` reports.
#[test]
fn fields_are_quantities() {
    let table = printed(&format!("{FIELDS} --csv -"));
    let rows = rows(&table);
    let header = "stop.anvil.gap,label,share,power,stop.anvil.impact_speed_max,q.head.displacement_rms";
    assert_eq!(rows[0].join(","), header);
    for cells in &rows[1..] {
        let settled = json(&format!("settle --machine two-mass-hammer --set stop.anvil.gap={}", cells[0]));
        assert_eq!(settled["motion"]["label"], cells[1]);
        let quantities = &settled["motion"]["quantities"];
        let expected = [
            &quantities["power"],
            &quantities["stops"]["anvil"]["impact_speed_max"],
            &quantities["coordinates"]["head"]["displacement_rms"],
        ];
        for (cell, value) in cells[3..].iter().zip(expected) {
            let (a, b) = (cell.parse::<f64>().unwrap(), number(value));
            assert!((a - b).abs() < 1e-7 * b.abs(), "{cells:?}: {value}");
        }
    }
    let map = "map --machine two-mass-hammer --axis frequency=1:2:3 --starts 1 --fields stop.anvil.gap";
    refuse([(map, "stop.anvil.gap")]);
}

/// Sweeps of a machine of one coordinate are those of the oscillator, hysteresis included.
#[test]
fn a_diagram_of_one_coordinate_is_that_of_the_oscillator() {
    let folder = Folder::with("one.toml", ONE);
    // value, sweep, and the numbers of the row, in order
    let rows = |line: &str, numbers: &[usize]| {
        let mut rows: Vec<(String, String, Vec<f64>)> = folder
            .printed(line)
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
    for (own, other, numbers) in [("speed", "velocity", [4, 5]), ("q.x", "strobe", [3, 3])] {
        let found = rows(&format!("{machine} --show {own}"), &numbers);
        let expected = rows(&format!("{osc} --show {other}"), &numbers);
        assert_eq!(found.len(), expected.len(), "{own}");
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
    for line in [
        "diagram --machine bouncing-ball --set e=0.5 --vary Gamma --over 1.1:1.75:3 --direction up --phase 0.51 --q 1 --qdot 4.1",
        "diagram --machine impact-pair --vary a --over 0.1:2:4 --direction scatter --starts 3 --transient 50",
    ] {
        let told = json(line);
        assert!(told["sweeps"][0]["points"].as_u64() > Some(0), "{told}");
    }
}

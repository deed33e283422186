//! Machines: the catalogue, files, changed numbers, schematics, refusals.

use super::{json, vibro};
use std::fs;
use vibroimpact_report::machine_answer;
use vibroimpact_study::machine::{CATALOGUE, MachineSource, no_files};
use vibroimpact_study::{Control, MachinePlan, MachineTask};

fn printed(line: &str) -> String {
    let output = vibro(line).output().expect("vibro runs");
    assert!(output.status.success(), "{line}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("text")
}

fn refused(line: &str) -> String {
    let output = vibro(line).output().expect("vibro runs");
    assert_eq!((output.status.code(), output.stdout.is_empty()), (Some(2), true), "{line}");
    String::from_utf8(output.stderr).expect("text")
}

#[test]
fn the_catalogue_is_listed_and_shown() {
    let list = printed("machine list");
    let listed = json("machine list");
    assert_eq!(list.lines().count(), CATALOGUE.len());
    for (k, entry) in CATALOGUE.iter().enumerate() {
        assert!(list.contains(entry.name) && listed["machines"][k]["name"] == entry.name);
    }
    assert_eq!(listed["machines"][7]["coordinates"], serde_json::json!(["first", "second"]));
    let shown = json("machine show chain --set kn=50 --set frequency=0.7 --set damping.first=0.04");
    assert_eq!(shown["parameters"]["kn"], 50.0);
    assert_eq!(shown["numbers"]["stop.stop.stiffness"], 50.0);
    assert_eq!(shown["numbers"]["frequency"], 0.7);
    assert_eq!(shown["machine"]["damping"], serde_json::json!([[0.04, -0.03], [-0.03, 0.06]]));
}

/// What is printed as a file reads as the same machine.
#[test]
fn printed_machines_are_files() {
    let line = "machine show capsule --set beta=20 --set stop.plate.preload=0.5";
    let machine = |text: &str| MachineSource::from_text(text, no_files).unwrap().machine().unwrap();
    let (expansion, written) = (printed(&format!("{line} --toml")), printed(&format!("{line} --written")));
    assert_eq!(machine(&expansion), machine(&written));
    assert_eq!(machine(&written).number("stop.plate.preload"), Ok(0.5));
    assert!(written.contains("beta = 20.0") && written.contains("[set]\n\"stop.plate.preload\" = 0.5\n"), "{written}");
    let text = printed(line);
    assert!(text.contains(expansion.split("[machine]").nth(1).unwrap()), "{text}");
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("mine.toml");
    fs::write(&file, written).unwrap();
    assert_eq!(printed(&format!("machine show {} --toml", file.display())), expansion);
}

#[test]
fn schematics() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name);
    printed(&format!("machine show vi-nes --figure {}", file("a.svg").display()));
    printed(&format!("machine show cantilever --figure {} --dpi 100 --title beam", file("a.png").display()));
    let svg = fs::read_to_string(file("a.svg")).unwrap();
    assert!(svg.contains("oscillator") && svg.contains("gap 1, e 0.6"), "{svg}");
    assert!(fs::read(file("a.png")).unwrap().starts_with(b"\x89PNG"));
    assert!(refused("machine show vi-nes --title none").contains("hint: --figure FILE.svg"));
    assert!(refused(&format!("machine show vi-nes --figure {}", file("a.svg").display())).contains("exists already"));
}

#[test]
fn refusals() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| {
        fs::write(folder.path().join(name), text).unwrap();
        folder.path().join(name).display().to_string()
    };
    let bad = file(
        "bad.toml",
        "[machine]\nbodies = { a = 1 }\nstop = [{ name = \"s\", at = \"a\", gap = 1, restitution = 2 }]\n",
    );
    let none = file("none.toml", "[machine]\nmodes = \"none.csv\"\n");
    for (line, said) in [
        (
            "machine show soft",
            "error: `soft` is neither a machine of the catalogue nor a file\nhint: `vibro machine list`".to_owned(),
        ),
        ("machine show a/b.toml", "error: the machine `a/b.toml` cannot be read: ".to_owned()),
        (
            "machine show chain --set stop.stop.gapp=1",
            "error: stop.stop.gapp: no such number in this machine\nhint: the numbers of stop are gap".to_owned(),
        ),
        ("machine show chain --set kn", "a path and a value are needed, such as stop.wall.gap=0.5".to_owned()),
        ("machine show chain --set kn=0", "error: stop.stop.stiffness: 0 lies outside stiffness > 0".to_owned()),
        (&format!("machine show {bad}"), "error: stop.s.restitution: 2 lies outside 0 <= restitution <= 1".to_owned()),
        (
            &format!("machine show {none}"),
            format!("error: {none}: modes: the file `none.csv` cannot be read: No such file"),
        ),
    ] {
        let told = refused(line);
        assert!(told.contains(&said), "{line}: {told}");
    }
}

#[test]
fn the_schema_of_machine_files() {
    let schema: serde_json::Value = serde_json::from_str(&printed("schema --machine")).unwrap();
    assert_eq!(schema["additionalProperties"], false);
    assert_eq!(schema["required"], serde_json::json!(["machine"]));
    let stop = &schema["$defs"]["StopText"]["properties"];
    assert!(stop["gap"]["description"].as_str().is_some_and(|text| text.contains("coordinates are 0")), "{stop}");
}

#[test]
fn the_schema_of_plans_of_machines() {
    let schema: serde_json::Value = serde_json::from_str(&printed("schema --machine-plan")).unwrap();
    assert_eq!(schema["additionalProperties"], false);
    assert_eq!(schema["required"], serde_json::json!(["version", "machine", "task"]));
    assert!(schema["$defs"]["MachineTask"].to_string().contains("periods"), "{schema}");
}

/// The contact of SDND101 has a closed form: half a period of the mass on both springs.
#[test]
fn a_machine_begins_where_its_file_says() {
    let events = json("simulate --machine sdnd101 --impacts 2")["events"].clone();
    let first = &events[0];
    assert!(first["kind"] == "close" && first["time"] == 0.0 && first["speed"] == 1.0, "{events}");
    assert_eq!(events[1]["kind"], "open");
    let contact = core::f64::consts::PI / (1.01e6_f64 / 100.0).sqrt();
    assert!((events[1]["time"].as_f64().unwrap() - contact).abs() < 1e-14, "{events}");
    let still = json("simulate --machine sdnd101 --impacts 2 --qdot 0");
    assert_ne!(still["events"], events);
}

/// The phase of the command line is that of the start, 0 too; what is not given is that of the file.
#[test]
fn a_start_is_that_of_the_command_line_or_of_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.toml");
    let text = "[start]\nq = { a = 0.25 }\nphase = 1\n[machine]\nbodies = { a = 1 }\nfrequency = 1\n\
        force = [{ at = \"a\", sin = 1 }]\nstop = [{ name = \"s\", at = \"a\", gap = 1, restitution = 0.5 }]\n";
    fs::write(&file, text).unwrap();
    let start =
        |flags: &str| json(&format!("simulate --machine {} --impacts 1 {flags}", file.display()))["start"].clone();
    assert_eq!(start(""), serde_json::json!({"q": [0.25], "qdot": [0.0], "phase": 1.0}));
    assert_eq!(start("--phase 0"), serde_json::json!({"q": [0.25], "qdot": [0.0], "phase": 0.0}));
    assert_eq!(start("--qdot -1 --q 0"), serde_json::json!({"q": [0.0], "qdot": [-1.0], "phase": 1.0}));
    let said = refused(&format!("simulate --machine {} --q 1,2", file.display()));
    assert!(said.contains("start.q: has 2 numbers, and 1 are needed"), "{said}");
    assert!(refused(&format!("simulate --machine {} --q 2", file.display())).contains("error: stop.s"));
}

/// The plan that is printed runs again to the same bytes, as JSON and as TOML.
#[test]
fn printed_plans_run_again() {
    let folder = tempfile::tempdir().unwrap();
    for line in [
        "--machine capsule --set beta=20 --periods 5",
        "--machine sdnd101 --impacts 4",
        "--machine cantilever --phase 2",
    ] {
        let told = json(&format!("simulate {line}"));
        let plan = MachinePlan::from_text(&told["plan"].to_string(), no_files).unwrap();
        for (name, text) in [("plan.json", told["plan"].to_string()), ("plan.toml", plan.to_toml())] {
            let file = folder.path().join(name);
            fs::write(&file, text).unwrap();
            let again = json(&format!("run {}", file.display()));
            for field in ["events", "end", "plan", "start"] {
                assert_eq!(again[field], told[field], "{line}: {name}");
            }
            assert!(refused(&format!("run {} --store a.zarr", file.display())).contains("fills no store"));
        }
    }
    let bad = folder.path().join("bad.toml");
    fs::write(&bad, "version = 1\n[machine]\nbodies = { a = 1 }\n[task.simulate]\nperiods = 3\n").unwrap();
    let said = refused(&format!("run {}", bad.display()));
    assert!(said.contains("bad.toml`: the machine has no forcing, so no forcing periods"), "{said}");
}

#[test]
fn waveforms() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).display().to_string();
    let table = printed("simulate --machine capsule --periods 2 --csv - --step 0.5");
    let header = table.lines().next().unwrap();
    assert!(
        header.starts_with("time,q.") && header.contains(",gap.plate") && header.contains(",force.plate"),
        "{header}"
    );
    let columns = header.split(',').count();
    let rows: Vec<Vec<f64>> =
        table.lines().skip(1).map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect()).collect();
    assert!(rows.len() > 20 && rows.iter().all(|row| row.len() == columns), "{table}");
    assert!(rows.windows(2).all(|pair| pair[0][0] <= pair[1][0]));
    for (name, said, absent) in [
        ("soft-stop", "force of stop", "impact</"),
        ("two-mass-hammer", ">impact<", "contact force"),
        ("impact-damper", ">particle<", "contact force"),
    ] {
        printed(&format!("simulate --machine {name} --periods 8 --plot {}", file(&format!("{name}.svg"))));
        let svg = fs::read_to_string(file(&format!("{name}.svg"))).unwrap();
        assert!(svg.contains(said) && !svg.contains(absent) && svg.contains("displacement"), "{name}");
    }
    // a motion that ends where it begins
    printed(&format!("simulate --machine sdnd101 --impacts 1 --plot {} --csv -", file("short.png")));
    assert!(fs::read(file("short.png")).unwrap().starts_with(b"\x89PNG"));
    assert!(refused("simulate --machine soft-stop --periods 1 --csv - --step 0").contains("step = 0 lies outside"));
    assert!(refused("simulate --machine soft-stop --periods 1 --csv - --step 1e-9").contains("at most"));
}

#[test]
fn the_command_answers_as_the_library_does() {
    let source = MachineSource::from_text(&printed("machine show impact-damper --written"), no_files).unwrap();
    let plan = MachinePlan::new(source, MachineTask::Simulate { impacts: Some(30), periods: None });
    let answer = machine_answer("impact-damper", &plan, &Control::default()).unwrap();
    let line = "simulate --machine impact-damper --impacts 30";
    assert_eq!(printed(&format!("{line} --json")), answer.json() + "\n");
    let mut table = Vec::new();
    answer.table(None).unwrap().unwrap().write(&mut table).unwrap();
    assert_eq!(printed(&format!("{line} --csv -")).as_bytes(), table);
    let folder = tempfile::tempdir().unwrap();
    let svg = folder.path().join("a.svg");
    printed(&format!("{line} --plot {}", svg.display()));
    assert_eq!(fs::read_to_string(svg).unwrap(), answer.figure().unwrap().unwrap().to_svg());
}

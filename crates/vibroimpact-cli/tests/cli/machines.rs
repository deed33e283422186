//! Machines: the catalogue, files, changed numbers, schematics, refusals.

use crate::{json, machine_file, printed, refused};
use std::collections::BTreeSet;
use std::fs;
use vibroimpact_study::Plan;
use vibroimpact_study::machine::{CATALOGUE, MachineSource, no_files};

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
    let (_folder, file) = machine_file(&written);
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
fn the_schema_of_plans_is_one_for_both_systems() {
    assert_eq!(printed("schema --machine-plan"), printed("schema"));
    let schema: serde_json::Value = serde_json::from_str(&printed("schema")).unwrap();
    assert_eq!(schema["additionalProperties"], false);
    assert_eq!(schema["required"], serde_json::json!(["version", "task"]));
    let fields = schema["properties"].as_object().unwrap();
    assert!(["system", "units", "machine", "start", "set"].iter().all(|name| fields.contains_key(*name)), "{schema}");
    assert!(schema["$defs"]["SimulatePlan"].to_string().contains("periods"), "{schema}");
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
    let text = "[start]\nq = { a = 0.25 }\nphase = 1\n[machine]\nbodies = { a = 1 }\nfrequency = 1\n\
        force = [{ at = \"a\", sin = 1 }]\nstop = [{ name = \"s\", at = \"a\", gap = 1, restitution = 0.5 }]\n";
    let (_folder, file) = machine_file(text);
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
        "--machine sdnd106 --time 0.15",
        "--machine cantilever --phase 2",
    ] {
        let told = json(&format!("simulate {line}"));
        let plan = Plan::from_text(&told["plan"].to_string()).unwrap();
        for (name, text) in [("plan.json", told["plan"].to_string()), ("plan.toml", plan.to_toml())] {
            let file = folder.path().join(name);
            fs::write(&file, text).unwrap();
            let again = json(&format!("run {}", file.display()));
            for field in ["events", "end", "plan", "start"] {
                assert_eq!(again[field], told[field], "{line}: {name}");
            }
            assert!(refused(&format!("run {} --store a.zarr", file.display())).contains("nothing to store"));
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
    assert!(header.ends_with(",force.plate,force.surface,state.plate,state.surface,phase,exact"), "{header}");
    // without the phase, and the last column, which is empty or an object in JSON
    let columns = header.split(',').count() - 2;
    let cells: Vec<Vec<&str>> = table.lines().skip(1).map(|line| line.split(',').take(columns).collect()).collect();
    assert!(cells.len() > 20 && cells.iter().all(|row| row.len() == columns), "{table}");
    // the states of the stop and of the joint are words, all others are numbers
    let states = |k: usize| cells.iter().map(|row| row[k]).collect::<BTreeSet<_>>();
    assert_eq!(states(columns - 2), BTreeSet::from(["closed", "open"]));
    assert_eq!(states(columns - 1), BTreeSet::from(["backward", "forward", "holding"]));
    let rows: Vec<Vec<f64>> =
        cells.iter().map(|row| row[..columns - 2].iter().map(|cell| cell.parse().unwrap()).collect()).collect();
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
    // without further events, and without forcing, up to the time asked for
    let pulled = printed("simulate --machine sdnd106 --time 0.15 --csv - --step 0.05");
    assert!(pulled.lines().last().unwrap().starts_with("0.15,1.35333766089"), "{pulled}");
    assert!(refused("simulate --machine sdnd106 --time 0").contains("time = 0 lies outside 0 < time <= 1e10"));
    assert!(refused("simulate --machine soft-stop --periods 1 --csv - --step 0").contains("step = 0 lies outside"));
    assert!(refused("simulate --machine soft-stop --periods 1 --csv - --step 1e-9").contains("at most"));
}

fn close(value: &serde_json::Value, expected: f64) -> bool {
    value.as_f64().is_some_and(|value| (value - expected).abs() <= 1e-9 * expected.abs().max(1.0))
}

/// The determinant of the monodromy matrix of a rigid stop is known: damping in flight, and the restitution squared.
#[test]
fn a_motion_settles() {
    let found = json("settle --machine two-mass-hammer");
    let motion = &found["motion"];
    assert!(motion["kind"] == "periodic" && motion["label"] == "1/1" && motion["stable"] == true, "{motion}");
    assert_eq!(motion["counts"], serde_json::json!({"anvil": 1}));
    let multipliers: Vec<[f64; 2]> = serde_json::from_value(motion["multipliers"].clone()).unwrap();
    assert_eq!(multipliers.len(), 4);
    let product = multipliers.iter().fold((1.0, 0.0), |(re, im), [a, b]| (re * a - im * b, re * b + im * a));
    let period = core::f64::consts::TAU / 1.2;
    let expected = 0.36 * (-0.4 * period).exp();
    assert!((product.0 - expected).abs() < 1e-9 && product.1.abs() < 1e-9, "{product:?}, not {expected}");
    let cycle = motion["cycle"].as_array().unwrap();
    assert!(cycle.len() == 1 && cycle[0]["stop"] == "anvil" && cycle[0]["kind"] == "impact", "{motion}");
    assert!(close(&cycle[0]["q"][1], 0.5) && cycle[0]["qdot"].as_array().unwrap().len() == 2, "{motion}");
    assert!(cycle[0]["phase"].is_f64() && cycle[0]["speed"].as_f64().unwrap() > 0.0, "{motion}");
    let text = printed("settle --machine two-mass-hammer");
    assert!(
        text.starts_with("1/1: one impact every forcing period\n  event    phase    speed  kind    stop\n"),
        "{text}"
    );
    assert!(text.contains("  impact  anvil\n  stable; multipliers "), "{text}");
    // the state of the cycle is on the cycle
    let list = |of: &serde_json::Value| {
        let numbers: Vec<String> = of.as_array().unwrap().iter().map(ToString::to_string).collect();
        numbers.join(",")
    };
    let state = &motion["state"];
    let (q, qdot, phase) = (list(&state["q"]), list(&state["qdot"]), &state["phase"]);
    let again = json(&format!("settle --machine two-mass-hammer --q {q} --qdot {qdot} --phase {phase}"));
    assert!(close(&again["motion"]["cycle"][0]["speed"], cycle[0]["speed"].as_f64().unwrap()), "{again}");
    assert_eq!(json("settle --machine two-mass-hammer --set frequency=3")["motion"]["kind"], "no_impact");
}

/// The views of a settled motion: tables of one period and of the multipliers, figures of each, and what has none.
#[test]
fn a_settled_motion_is_shown() {
    let hammer = "settle --machine two-mass-hammer --set frequency=1.06";
    let table = printed(&format!("{hammer} --csv -"));
    let rows: Vec<Vec<f64>> =
        table.lines().skip(1).map(|row| row.split(',').take(7).map(|cell| cell.parse().unwrap()).collect()).collect();
    assert!(
        table.starts_with("time,q.frame,q.head,qdot.frame,qdot.head,gap.anvil,force.anvil,state.anvil,phase,exact\n")
    );
    let (first, last) = (&rows[0], &rows[rows.len() - 1]);
    assert!((last[0] - core::f64::consts::TAU / 1.06).abs() < 1e-12, "{last:?}");
    assert!((1..5).all(|k| (first[k] - last[k]).abs() < 1e-9), "{first:?} {last:?}");
    let motion = &json(hammer)["motion"];
    let multipliers = printed(&format!("{hammer} --show multipliers --csv -"));
    assert_eq!(multipliers.lines().count(), 5);
    assert_eq!(multipliers.lines().nth(1).unwrap(), format!("{},0", motion["multipliers"][0][0]));
    let folder = tempfile::tempdir().unwrap();
    for (command, view, said) in [
        (hammer, "waveform", "displacement"),
        (hammer, "phase", "qdot.head"),
        (hammer, "multipliers", "Re "),
        ("settle --machine impact-pair", "waveform", "chaotic"),
        ("settle --machine stick-slip", "phase", "0/T"),
    ] {
        let file = folder.path().join(format!("{}-{view}.svg", command.len()));
        printed(&format!("{command} --show {view} --plot {}", file.display()));
        assert!(fs::read_to_string(&file).unwrap().contains(said), "{command} {view}");
    }
    assert!(refused(&format!("{hammer} --show phase")).contains("belongs to --plot and --csv"));
    assert!(refused(&format!("{hammer} --show sections --csv -")).contains("vibro lyapunov --points N"));
    assert!(refused(&format!("{hammer} --rule paper")).contains("for oscillators"));
    assert!(refused("settle --machine impact-pair --show multipliers --csv -").contains("no multipliers"));
}

/// A machine without forcing: a limit cycle, of which JSON has the period and no forcing periods, with its branch.
#[test]
fn a_limit_cycle() {
    let found = json("settle --machine stick-slip");
    let motion = &found["motion"];
    assert!(motion["label"] == "0/T" && motion["stable"] == true && motion["periods"].is_null(), "{motion}");
    assert_eq!(motion["multipliers"].as_array().unwrap().len(), 1);
    let times: Vec<f64> = motion["cycle"].as_array().unwrap().iter().map(|at| at["time"].as_f64().unwrap()).collect();
    assert!((times[1] - times[0] - 4.0).abs() < 1e-12, "{times:?}");
    let period = |belt: f64| 0.4 / belt + core::f64::consts::PI + 2.0 * (belt / 0.2).atan();
    assert!(close(&motion["period"], period(0.1)), "{motion}");
    let orbits = json("orbit --machine stick-slip --label 0/T")["orbits"].clone();
    let [orbit] = orbits.as_array().unwrap().as_slice() else { panic!("{orbits}") };
    assert!(orbit["label"] == "0/T" && close(&orbit["period"], period(0.1)), "{orbit}");
    let branch = json("branch --machine stick-slip --vary V --to 1 --points 40");
    for point in branch["branches"][0]["points"].as_array().unwrap() {
        let belt = point["parameter"].as_f64().unwrap();
        assert!(point["label"] == "0/T" && close(&point["period"], period(belt)), "{point}");
    }
    let table = printed("branch --machine stick-slip --label 0/T --vary V --to 1 --csv -");
    let last = table.lines().last().unwrap();
    assert!(last.starts_with("1,1,0/T,true,true,stable,end of range,,0,0,") && last.contains(",,,,6.28839"), "{last}");
    let text = printed("branch --machine stick-slip --vary V --to 1");
    assert!(text.starts_with("branch 1: 0/T (stable there), V from 0.1 to 1, "), "{text}");
    assert!(
        text.contains("  ends at V 1.00000000000, period 6.28839") && text.ends_with(", 0/T stable: end of range\n")
    );
    for command in ["orbit", "branch --vary V --to 0.2"] {
        let said = refused(&format!("{command} --machine stick-slip --label 1/1"));
        assert!(said.contains("not m/T") && said.contains("for example 2/T"), "{said}");
    }
    assert!(refused("orbit --machine den-hartog --label 1/T").contains("the machine has a forcing"));
}

#[test]
fn attractors_orbits_and_exponents() {
    let found = json("attractors --machine two-mass-hammer --starts 8");
    let motions = found["motions"].as_array().unwrap();
    let total: f64 = motions.iter().map(|motion| motion["share"].as_f64().unwrap()).sum();
    assert!(found["starts"] == 8 && (total - 1.0).abs() < 1e-12, "{found}");
    let orbits = json("orbit --machine two-mass-hammer --label 1/1")["orbits"].clone();
    let stable: Vec<_> = orbits.as_array().unwrap().iter().filter(|orbit| orbit["stable"] == true).collect();
    assert_eq!(stable.len(), 1, "{orbits}");
    let speed = stable[0]["cycle"][0]["speed"].as_f64().unwrap();
    assert!(close(&motions[0]["cycle"][0]["speed"], speed), "{motions:?}");
    let found = json("lyapunov --machine two-mass-hammer --impacts 500");
    let exponents = found["exponents"].as_array().unwrap();
    let period = core::f64::consts::TAU / 1.2;
    let multipliers: Vec<[f64; 2]> = serde_json::from_value(stable[0]["multipliers"].clone()).unwrap();
    assert_eq!(exponents.len(), multipliers.len());
    for (exponent, [re, im]) in exponents.iter().zip(multipliers) {
        let expected = re.hypot(im).ln() / period;
        let within = exponent["error"].as_f64().unwrap() + 1e-6;
        assert!((exponent["value"].as_f64().unwrap() - expected).abs() <= within, "{exponent}, not {expected}");
    }
    let text = printed("lyapunov --machine two-mass-hammer --impacts 500");
    assert!(text.contains("  exponent 4  ") && text.starts_with("1/1: one impact every forcing period\n"), "{text}");
    let told = printed("attractors --machine two-mass-hammer --starts 8");
    let row = "  100.0 %       8  1/1    ";
    assert!(told.starts_with("starts  8\n\n") && told.lines().any(|line| line.starts_with(row)), "{told}");
    let table = printed("attractors --machine two-mass-hammer --starts 8 --csv -");
    assert!(table.starts_with("label,share,starts,count.anvil,multiplier_1_re,multiplier_1_im,"), "{table}");
    // the quantities of a motion are those of its JSON
    let of = |name: &str| {
        let at = table.lines().next().unwrap().split(',').position(|head| head == name).unwrap();
        table.lines().nth(1).unwrap().split(',').nth(at).unwrap().parse::<f64>().unwrap()
    };
    let quantities = &motions[0]["quantities"];
    assert_eq!(Some(of("power")), quantities["power"].as_f64());
    assert_eq!(Some(of("stop.anvil.impulse_max")), quantities["stops"]["anvil"]["impulse_max"].as_f64());
    assert_eq!(Some(of("q.head.displacement_rms")), quantities["coordinates"]["head"]["displacement_rms"].as_f64());
}

/// Orbits are numbered as `--orbit` counts them.
#[test]
fn numbers_of_orbits() {
    let machine = "--machine two-mass-hammer --set frequency=1.06 --label 2/1";
    let text = printed(&format!("orbit {machine}"));
    let (one, two) = text.split_once("\norbit 2 of 2\n2/1: two impacts every forcing period\n").expect("two orbits");
    assert!(one.starts_with("orbit 1 of 2\n2/1: ") && one.contains("\n  unstable; multipliers "), "{text}");
    assert!(two.contains("\n  stable; multipliers "), "{text}");
    let orbits = json(&format!("orbit {machine}"))["orbits"].clone();
    for k in [0, 1] {
        let found = json(&format!("branch {machine} --orbit {} --vary frequency --to 1.065", k + 1));
        let speed = orbits[k]["cycle"][0]["speed"].as_f64().unwrap();
        assert!(
            close(&found["branches"][0]["points"][0]["cycle"][0]["speed"], speed),
            "{}",
            found["branches"][0]["points"][0]
        );
        assert_eq!(found["orbit"], serde_json::json!({"number": k + 1, "count": 2}));
    }
    let curve = "--kind fold --vary frequency=1:1.1 --and b=0.45:0.55 --points 5";
    let [one, two] = [1, 2].map(|k| json(&format!("curve {machine} --orbit {k} {curve}")));
    assert_eq!((&one["orbit"]["number"], &two["orbit"]["number"]), (&1.into(), &2.into()));
    // both orbits meet at the fold
    assert!(close(&one["found_at"][0], two["found_at"][0].as_f64().unwrap()), "{one}");
    assert!(refused(&format!("curve {machine} --orbit 3 {curve}")).contains("there is no orbit 2/1 number 3"));
}

/// The sections of an attractor: a cycle is a few points, in the table and in the figure.
#[test]
fn sections() {
    let line = "lyapunov --machine two-mass-hammer --set frequency=1.06 --impacts 500 --points 40";
    let table = printed(&format!("{line} --csv -"));
    let mut rows = table.lines();
    assert_eq!(rows.next(), Some("section,stop,phase,speed,q.frame,q.head,qdot.frame,qdot.head"));
    let rows: Vec<Vec<&str>> = rows.map(|row| row.split(',').collect()).collect();
    assert_eq!(rows.iter().map(|row| row[0]).filter(|name| *name == "strobe").count(), 40);
    let cycle = json("settle --machine two-mass-hammer --set frequency=1.06")["motion"]["cycle"].clone();
    for row in rows.iter().filter(|row| row[0] == "closing") {
        let number = |k: usize| row[k].parse::<f64>().unwrap();
        let same = |event: &serde_json::Value| close(&event["phase"], number(2)) && close(&event["speed"], number(3));
        assert!(row[1] == "anvil" && cycle.as_array().unwrap().iter().any(same), "{row:?}");
    }
    let folder = tempfile::tempdir().unwrap();
    let svg = folder.path().join("sections.svg");
    printed(&format!(
        "{} --plot {}",
        line.replace("two-mass-hammer --set frequency=1.06", "impact-pair"),
        svg.display()
    ));
    let svg = fs::read_to_string(svg).unwrap();
    for text in ["closings of stops", "states at phase 0", ">right<", ">left<", "q.ball", "qdot.ball"] {
        assert!(svg.contains(text), "{text}");
    }
    assert!(refused("lyapunov --machine two-mass-hammer --points 4").contains("--section FILE or --plot FILE"));
    assert!(refused("lyapunov --machine sdnd122 --csv -").contains("no forcing, so its attractor has no section"));
}

#[test]
fn branches() {
    let found = json("branch --machine two-mass-hammer --vary frequency --to 1.05");
    assert_eq!(found["vary"], "frequency");
    let found = found["branches"][0].clone();
    let points = found["points"].as_array().unwrap();
    let kinds: Vec<&str> =
        found["events"].as_array().unwrap().iter().map(|event| event["kind"].as_str().unwrap()).collect();
    assert_eq!(kinds, ["grazing", "fold", "end of range"]);
    let grazing = &found["events"][0];
    assert!(grazing["stop"] == "anvil" && grazing["appears"] == true, "{grazing}");
    // a settled motion before the grazing is on the branch
    let settled = json("settle --machine two-mass-hammer --set frequency=1.1")["motion"]["label"].clone();
    assert!(settled == "1/1" && grazing["parameter"].as_f64().unwrap() < 1.1, "{grazing}");
    assert!(points.iter().all(|point| point["multipliers"].as_array().unwrap().len() == 4));
    let at = usize::try_from(grazing["point"].as_u64().unwrap()).unwrap();
    assert_eq!(points[at]["parameter"], grazing["parameter"]);
    let table = printed("branch --machine two-mass-hammer --vary frequency --to 1.05 --csv -");
    assert!(
        table.starts_with("branch,frequency,label,admissible,stable,stability,event,stop,fastest,multiplier_1_re,"),
        "{table}"
    );
    assert!(table.lines().next().unwrap().ends_with(",multiplier_4_im,phases,speeds,stops"), "{table}");
    assert_eq!(table.lines().count(), points.len() + 1);
    let row: Vec<&str> = table.lines().nth(at + 1).unwrap().split(',').collect();
    assert_eq!((row[5], row[6], row[7]), ("stable", "grazing", "anvil"), "{row:?}");
    let closings = points[at]["cycle"].as_array().unwrap();
    let speeds: Vec<f64> = row[18].split(' ').map(|speed| speed.parse().unwrap()).collect();
    assert!(
        speeds.len() == closings.len() && closings.iter().zip(&speeds).all(|(of, speed)| close(&of["speed"], *speed))
    );
    assert_eq!(row[19].split(' ').collect::<Vec<_>>(), vec!["anvil"; closings.len()]);
    // a parameter of the file has no dot
    let text = printed("branch --machine two-mass-hammer --vary b --to 0.45");
    assert!(text.contains("end of range") && text.contains("stable"), "{text}");
}

/// Branches that begin at flips are in the table and in the figure, before the simulation; the second number of a line is a column.
#[test]
fn all_branches_of_a_machine_are_written_and_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).display().to_string();
    let line = "branch --machine two-mass-hammer --set frequency=0.95 --vary frequency --to 0.895 --follow 1";
    printed(&format!("{line} --csv {} --plot {}", file("a.csv"), file("a.svg")));
    let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    let of = |k: &str| read("a.csv").lines().filter(|row| row.starts_with(k)).count();
    let found = json(line);
    let count = |points: &serde_json::Value| points.as_array().unwrap().len();
    assert!(
        of("2,") > 2
            && of("2,") == count(&found["branches"][1]["points"])
            && of("1,") == count(&found["branches"][0]["points"])
    );
    for text in [">stable<", ">unstable<", ">flip<", ">fold<", ">grazing<", ">simulation<", ">5/2<", "stroke-dasharray"]
    {
        assert!(read("a.svg").contains(text), "{text}");
    }
    printed(&format!("{line} --plot {} --no-diagram", file("b.svg")));
    assert!(!read("b.svg").contains(">simulation<") && read("b.svg").contains(">5/2<"));
    assert!(refused(&format!("{line} --no-diagram")).contains("hint: --plot FILE"));

    let line = "--machine two-mass-hammer --vary frequency";
    let table = printed(&format!("branch {line} --to 1.1 --also stop.anvil.gap=0.6 --csv -"));
    assert!(table.starts_with("branch,frequency,stop.anvil.gap,label,"), "{table}");
    let last: Vec<&str> = table.lines().last().unwrap().split(',').collect();
    assert_eq!((last[1], last[2], last[6], last[7]), ("1.1", "0.6", "stable", "end of range"));
    let diagram =
        printed(&format!("diagram {line} --over 1.2:1.1:3 --also stop.anvil.gap=0.5:0.6 --direction up --csv -"));
    let rows: Vec<Vec<&str>> = diagram.lines().map(|row| row.split(',').collect()).collect();
    assert_eq!(rows[0], ["frequency", "stop.anvil.gap", "sweep", "kind", "stop", "phase", "speed"]);
    assert_eq!(
        rows[1..].iter().map(|row| (row[0], row[1])).collect::<Vec<_>>(),
        [("1.1", "0.6"), ("1.15", "0.55"), ("1.2", "0.5")]
    );
    // the sweep ends on the branch
    let (swept, followed): (f64, f64) = (rows[1][6].parse().unwrap(), last[9].parse().unwrap());
    assert!((swept - followed).abs() < 1e-7, "{swept} {followed}");
    let object = json(&format!("branch {line} --to 1.1 --also b=0.6"));
    assert_eq!(object["also"], serde_json::json!({"parameter": "b", "from": 0.5, "to": 0.6}));
    let end = object["branches"][0]["events"].as_array().unwrap().last().unwrap().clone();
    assert_eq!(end["values"], serde_json::json!([1.1, 0.6]));
}

/// The curve of flips of the ball on a table in closed form.
#[test]
fn curves() {
    let line =
        "curve --machine bouncing-ball --set Gamma=1.2 --label 1/1 --kind flip --vary Gamma=0.2:3 --and e=0.3:0.8";
    let found = json(line);
    assert_eq!((&found["kind"], &found["parameters"]), (&"flip".into(), &serde_json::json!(["Gamma", "e"])));
    let points = found["points"].as_array().unwrap();
    for point in points {
        let (gamma, e) = (point["values"][0].as_f64().unwrap(), point["values"][1].as_f64().unwrap());
        let fold = core::f64::consts::PI * (1.0 - e) / (1.0 + e);
        let flip = fold.hypot(2.0 * (1.0 + e * e) / ((1.0 + e) * (1.0 + e)));
        assert!((gamma - flip).abs() < 1e-9 && point["residual"].as_f64().unwrap() < 1e-9, "{point}");
    }
    let kinds: Vec<&str> =
        found["events"].as_array().unwrap().iter().map(|event| event["kind"].as_str().unwrap()).collect();
    assert_eq!(kinds, ["end of box", "end of box"]);
    let text = printed(line);
    assert!(
        text.starts_with("flip of 1/1 (orbit 1 of 2, stable there)\n  found at Gamma 1.5268")
            && text.contains("end of box"),
        "{text}"
    );
    let folder = tempfile::tempdir().unwrap();
    let (svg, csv) = (folder.path().join("curve.svg"), folder.path().join("curve.csv"));
    printed(&format!("{line} --points 20 --plot {} --csv {}", svg.display(), csv.display()));
    let (svg, csv) = (fs::read_to_string(svg).unwrap(), fs::read_to_string(csv).unwrap());
    assert!(svg.contains(">Gamma<") && svg.contains(">flip of 1/1<") && svg.contains(">found on the branch<"));
    assert!(csv.starts_with("Gamma,e,label,admissible,event,stop,residual,touch,multiplier_1_re,"), "{csv}");
    assert_eq!(csv.lines().count(), 1 + 39);
}

#[test]
fn basins_and_maps() {
    let table = printed("basin --machine two-mass-hammer --axis q.head=-1:1:3 --axis qdot.head=0:1:2 --csv -");
    assert_eq!(table, "q.head,qdot.head,label\n-1,0,1/1\n0,0,1/1\n1,0,refused\n-1,1,1/1\n0,1,1/1\n1,1,refused\n");
    let found = json("basin --machine two-mass-hammer --axis q.head=-1:1:3");
    assert_eq!(found["cells"], serde_json::json!([0, 0, null]));
    assert!(found["refused"] == 1 && found["motions"][0]["starts"] == 2, "{found}");
    let line = "map --machine two-mass-hammer --axis frequency=0.8:1.2:3 --starts 2";
    let table = printed(&format!("{line} --csv -"));
    assert!(table.starts_with("frequency,label,share\n0.8,"), "{table}");
    for row in table.lines().skip(1) {
        let cells: Vec<&str> = row.split(',').collect();
        let alone = json(&format!("attractors --machine two-mass-hammer --set frequency={} --starts 2", cells[0]));
        assert!(alone["motions"].as_array().unwrap().iter().any(|motion| motion["label"] == cells[1]), "{row}");
    }
    let answer = json(line);
    let text = printed(line);
    let rows: Vec<String> = (answer["points"].as_array().unwrap().iter())
        .flat_map(|point| point["motions"].as_array().unwrap().iter().map(move |motion| (point, motion)))
        .map(|(point, motion)| (point["frequency"].as_f64().unwrap(), motion["label"].as_str().unwrap()))
        .map(|(frequency, label)| format!("{frequency},{label},"))
        .collect();
    assert_eq!(rows.len(), table.lines().count() - 1);
    assert!(table.lines().skip(1).zip(&rows).all(|(row, own)| row.starts_with(own)), "{rows:?} {table}");
    for of in answer["labels"].as_array().unwrap() {
        let (label, count) = (of["label"].as_str().unwrap(), &of["points"]);
        let row = text.lines().find(|row| row.split_whitespace().next() == Some(label)).expect("a row of the label");
        assert_eq!(row.split_whitespace().nth(1).unwrap(), count.to_string(), "{text}");
    }
}

/// Figures have the paths as names of axes; what has none is refused before anything is computed.
#[test]
fn figures() {
    let folder = tempfile::tempdir().unwrap();
    let drawn = |line: &str, name: &str| {
        let file = folder.path().join(name);
        printed(&format!("{line} --plot {}", file.display()));
        fs::read_to_string(file).unwrap()
    };
    let branch = drawn("branch --machine two-mass-hammer --vary frequency --to 1.05", "branch.svg");
    for said in [">frequency<", "speed of closing", ">grazing<", ">fold<", ">stable<", ">unstable<", ">2/1<"] {
        assert!(branch.contains(said), "{said}");
    }
    let basin = "basin --machine two-mass-hammer --axis q.head=-1:0.4:4";
    let (line, plane) = (drawn(basin, "line.svg"), drawn(&format!("{basin} --axis qdot.head=-1:1:3"), "plane.svg"));
    assert!(line.contains("share of starts") && line.contains(">q.head<") && line.contains("1/1, 100"));
    assert!(plane.contains(">q.head<") && plane.contains(">qdot.head<"));
    let map = "map --machine two-mass-hammer --axis frequency=0.8:1.2:3 --starts 2";
    let (line, plane) = (drawn(map, "map.svg"), drawn(&format!("{map} --axis stop.anvil.gap=0.4:0.5:2"), "maps.svg"));
    assert!(line.contains("share of starts") && line.contains(">3/1<"));
    assert!(plane.contains(">stop.anvil.gap<") && plane.contains(">2/1<"));
    let settled = drawn("settle --machine two-mass-hammer", "settle.svg");
    assert!(settled.contains("displacement") && settled.contains(">impact<") && settled.contains("hammer: 1/1"));
    let none = folder.path().join("none.svg").display().to_string();
    let said = refused(&format!("settle --machine sdnd101 --impacts 200 --plot {none}"));
    assert!(said.contains("can be shown: undecided\nhint: `vibro simulate"), "{said}");
    let said = refused(&format!("{basin} --axis qdot.head=0:1:2 --axis phase=0:1:2 --plot {none}"));
    assert!(said.contains("one or two axes, not 3"), "{said}");
}

#[test]
fn refusals_of_questions() {
    for (line, said) in [
        ("orbit --machine sdnd101 --label 1/1", "error: label `1/1` is not m/T"),
        ("branch --machine sdnd101 --vary stop.stop.gap --to 1", "no cycle of events, so no branch begins there"),
        ("orbit --machine two-mass-hammer --label one", "error: "),
        (
            "basin --machine two-mass-hammer --axis q.tail=0:1:3",
            "hint: q.NAME, qdot.NAME or phase; the coordinates are frame, head",
        ),
        (
            "map --machine two-mass-hammer --axis stop.anvil.gapp=0:1:3 --starts 2",
            "hint: the numbers of anvil are gap, restitution",
        ),
        ("map --machine two-mass-hammer --starts 2", "hint: --axis PATH=A:B:N"),
        ("map --machine two-mass-hammer --axis mu=0:1 --starts 2", "--axis <PATH=A:B:N>"),
        ("branch --machine two-mass-hammer --vary nothing --to 1", "error: nothing: no such number in this machine"),
        ("branch --machine two-mass-hammer --vary frequency --to 1.2", "error: "),
        (
            "curve --machine two-mass-hammer --kind torus --vary frequency=1.1:1.3 --and b=0.4:0.6",
            "error: no torus was found on the branch of 1/1 with frequency from 1.1 to 1.3",
        ),
        (
            "curve --machine two-mass-hammer --kind flip --vary frequency=1.3:1.4 --and b=0.4:0.6",
            "error: frequency = 1.2 lies outside the range from 1.3 to 1.4",
        ),
        (
            "curve --machine two-mass-hammer --kind flip --vary frequency=1:1.4 --and c=0.4:0.6",
            "error: c: no such number in this machine",
        ),
        (
            "curve --beta 1 --gap 1 --restitution 0.5 --label 1/1 --kind torus --vary gap=0:2 --and beta=1:2",
            "hint: --machine NAME|FILE",
        ),
        ("settle --machine two-mass-hammer --q 1,2,3", "start.q: has 3 numbers, and 2 are needed"),
        ("settle --machine two-mass-hammer --impacts 0", "error: "),
        // without a machine all of the system is needed
        ("map --gap 1 --starts 2", "the frequency ratio and the restitution are not given"),
        ("map --restitution 0.5 --starts 2", "the frequency ratio and the gap are not given"),
        (
            "branch --beta 1 --gap 1 --restitution 0.5 --label 1/1 --vary gapp --to 1",
            "error: invalid value 'gapp' for '--vary",
        ),
    ] {
        let told = refused(line);
        assert!(told.contains(said), "{line}: {told}");
    }
}

//! Machines: the catalogue, files, changed numbers, schematics, refusals.

use crate::{Folder, has, json, list, number, printed, refuse, refused, rows, texts};
use serde_json::{Value, json as object};
use std::collections::BTreeSet;
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
    assert_eq!(listed["machines"][7]["coordinates"], object!(["first", "second"]));
    let shown = json("machine show chain --set kn=50 --set frequency=0.7 --set damping.first=0.04");
    assert_eq!(shown["parameters"]["kn"], 50.0);
    assert_eq!(shown["numbers"]["stop.stop.stiffness"], 50.0);
    assert_eq!(shown["numbers"]["frequency"], 0.7);
    assert_eq!(shown["machine"]["damping"], object!([[0.04, -0.03], [-0.03, 0.06]]));
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
    assert_eq!(Folder::with("machine.toml", &written).printed("machine show machine.toml --toml"), expansion);
}

#[test]
fn schematics() {
    let folder = Folder::new();
    folder.printed("machine show vi-nes --figure a.svg");
    has(&folder.read("a.svg"), &["oscillator", "gap 1, e 0.6"]);
    folder.printed("machine show cantilever --figure a.png --dpi 100 --title beam");
    assert!(folder.bytes("a.png").starts_with(b"\x89PNG"));
    folder.refuse([
        ("machine show vi-nes --title none", "hint: --figure FILE.svg"),
        ("machine show vi-nes --figure a.svg", "exists already"),
    ]);
}

#[test]
fn refusals() {
    let stop = "stop = [{ name = \"s\", at = \"a\", gap = 1, restitution = 2 }]";
    let folder = Folder::with("bad.toml", &format!("[machine]\nbodies = {{ a = 1 }}\n{stop}\n"));
    folder.write("none.toml", "[machine]\nmodes = \"none.csv\"\n");
    let unknown = "error: `soft` is neither a machine of the catalogue nor a file\nhint: `vibro machine list`";
    let no_number = "error: stop.stop.gapp: no such number in this machine\nhint: the numbers of stop are gap";
    folder.refuse([
        ("machine show soft", unknown),
        ("machine show a/b.toml", "error: the machine `a/b.toml` cannot be read: "),
        ("machine show chain --set stop.stop.gapp=1", no_number),
        ("machine show chain --set kn", "a path and a value are needed, such as stop.wall.gap=0.5"),
        ("machine show chain --set kn=0", "error: stop.stop.stiffness: 0 lies outside stiffness > 0"),
        ("machine show bad.toml", "error: stop.s.restitution: 2 lies outside 0 <= restitution <= 1"),
        ("machine show none.toml", "error: none.toml: modes: the file `none.csv` cannot be read: No such file"),
    ]);
}

#[test]
fn the_schema_of_machine_files() {
    let schema: Value = serde_json::from_str(&printed("schema --machine")).unwrap();
    assert_eq!(schema["additionalProperties"], false);
    assert_eq!(schema["required"], object!(["machine"]));
    let stop = &schema["$defs"]["StopText"]["properties"];
    assert!(stop["gap"]["description"].as_str().is_some_and(|text| text.contains("coordinates are 0")), "{stop}");
}

#[test]
fn the_schema_of_plans_is_one_for_both_systems() {
    assert_eq!(printed("schema --machine-plan"), printed("schema"));
    let schema: Value = serde_json::from_str(&printed("schema")).unwrap();
    assert_eq!(schema["additionalProperties"], false);
    assert_eq!(
        (&schema["required"], &schema["properties"]["version"]["maximum"]),
        (&object!(["version", "task"]), &1.into())
    );
    let fields = schema["properties"].as_object().unwrap();
    assert!(["system", "units", "machine", "start", "set"].iter().all(|name| fields.contains_key(*name)), "{schema}");
    assert!(schema["$defs"]["SimulatePlan"].to_string().contains("periods"), "{schema}");
    has(&schema.to_string(), &["\"inverse_beta\""]);
}

/// The phase of the command line is that of the start, 0 too; what is not given is that of the file.
#[test]
fn a_start_is_that_of_the_command_line_or_of_the_file() {
    let text = "[start]\nq = { a = 0.25 }\nphase = 1\n[machine]\nbodies = { a = 1 }\nfrequency = 1\n\
        force = [{ at = \"a\", sin = 1 }]\nstop = [{ name = \"s\", at = \"a\", gap = 1, restitution = 0.5 }]\n";
    let folder = Folder::with("machine.toml", text);
    let start =
        |flags: &str| folder.json(&format!("simulate --machine machine.toml --impacts 1 {flags}"))["start"].clone();
    assert_eq!(start(""), object!({"q": [0.25], "qdot": [0.0], "phase": 1.0}));
    assert_eq!(start("--phase 0"), object!({"q": [0.25], "qdot": [0.0], "phase": 0.0}));
    assert_eq!(start("--qdot -1 --q 0"), object!({"q": [0.0], "qdot": [-1.0], "phase": 1.0}));
    folder.refuse([
        ("simulate --machine machine.toml --q 1,2", "start.q: has 2 numbers, and 1 are needed"),
        ("simulate --machine machine.toml --q 2", "error: stop.s"),
    ]);
}

/// The plan that is printed runs again to the same bytes, as JSON and as TOML.
#[test]
fn printed_plans_run_again() {
    let folder = Folder::new();
    for line in [
        "--machine capsule --set beta=20 --periods 5",
        "--machine sdnd101 --impacts 4",
        "--machine sdnd106 --time 0.15",
        "--machine cantilever --phase 2",
    ] {
        let told = json(&format!("simulate {line}"));
        let plan = Plan::from_text(&told["plan"].to_string()).unwrap();
        for (name, text) in [("plan.json", told["plan"].to_string()), ("plan.toml", plan.to_toml())] {
            folder.write(name, text);
            let again = folder.json(&format!("run {name}"));
            for field in ["events", "end", "plan", "start"] {
                assert_eq!(again[field], told[field], "{line}: {name}");
            }
            folder.refuse([(format!("run {name} --store a.zarr"), "nothing to store")]);
        }
    }
    folder.write("bad.toml", "version = 1\n[machine]\nbodies = { a = 1 }\n[task.simulate]\nperiods = 3\n");
    folder.refuse([("run bad.toml", "bad.toml`: the machine has no forcing, so no forcing periods")]);
}

#[test]
fn waveforms() {
    let folder = Folder::new();
    let table = printed("simulate --machine capsule --periods 2 --csv - --step 0.5");
    let header = table.lines().next().unwrap();
    has(header, &["time,q.", ",gap.plate", ",force.plate"]);
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
        let svg = folder.drawn(&format!("simulate --machine {name} --periods 8"), "a.svg");
        assert!(svg.contains(said) && !svg.contains(absent) && svg.contains("displacement"), "{name}");
    }
    // a motion that ends where it begins
    folder.printed("simulate --machine sdnd101 --impacts 1 --plot short.png --csv -");
    assert!(folder.bytes("short.png").starts_with(b"\x89PNG"));
    // without further events, and without forcing, up to the time asked for
    let pulled = printed("simulate --machine sdnd106 --time 0.15 --csv - --step 0.05");
    assert!(pulled.lines().last().unwrap().starts_with("0.15,1.35333766089"), "{pulled}");
    refuse([
        ("simulate --machine sdnd106 --time 0", "time = 0 lies outside 0 < time <= 1e10"),
        ("simulate --machine soft-stop --periods 1 --csv - --step 0", "step = 0 lies outside"),
        ("simulate --machine soft-stop --periods 1 --csv - --step 1e-9", "at most"),
    ]);
}

fn close(value: &Value, expected: f64) -> bool {
    value.as_f64().is_some_and(|value| (value - expected).abs() <= 1e-9 * expected.abs().max(1.0))
}

#[test]
fn a_motion_settles() {
    let found = json("settle --machine two-mass-hammer");
    let motion = &found["motion"];
    assert!(motion["kind"] == "periodic" && motion["label"] == "1/1" && motion["stable"] == true, "{motion}");
    assert_eq!(motion["counts"], object!({"anvil": 1}));
    let multipliers: Vec<[f64; 2]> = serde_json::from_value(motion["multipliers"].clone()).unwrap();
    assert_eq!(multipliers.len(), 4);
    let cycle = list(&motion["cycle"]);
    assert!(cycle.len() == 1 && cycle[0]["stop"] == "anvil" && cycle[0]["kind"] == "impact", "{motion}");
    assert!(close(&cycle[0]["q"][1], 0.5) && list(&cycle[0]["qdot"]).len() == 2, "{motion}");
    assert!(cycle[0]["phase"].is_f64() && number(&cycle[0]["speed"]) > 0.0, "{motion}");
    let text = printed("settle --machine two-mass-hammer");
    let head = "1/1: one impact every forcing period\n  event    phase    speed  kind    stop\n";
    assert!(text.starts_with(head) && text.contains("  impact  anvil\n  stable; multipliers "), "{text}");
    // the state of the cycle is on the cycle
    let list = |of: &Value| of.to_string().replace(['[', ']'], "");
    let state = &motion["state"];
    let (q, qdot, phase) = (list(&state["q"]), list(&state["qdot"]), &state["phase"]);
    let again = json(&format!("settle --machine two-mass-hammer --q {q} --qdot {qdot} --phase {phase}"));
    assert!(close(&again["motion"]["cycle"][0]["speed"], number(&cycle[0]["speed"])), "{again}");
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
    let folder = Folder::new();
    for (command, view, said) in [
        (hammer, "waveform", "displacement"),
        (hammer, "phase", "qdot.head"),
        (hammer, "multipliers", "Re "),
        ("settle --machine impact-pair", "waveform", "chaotic"),
        ("settle --machine stick-slip", "phase", "0/T"),
    ] {
        has(&folder.drawn(&format!("{command} --show {view}"), "a.svg"), &[said]);
    }
    refuse([
        (&*format!("{hammer} --show phase"), "belongs to --plot and --csv"),
        (&format!("{hammer} --show sections --csv -"), "vibro lyapunov --points N"),
        (&format!("{hammer} --rule paper"), "for oscillators"),
        ("settle --machine impact-pair --show multipliers --csv -", "no multipliers"),
    ]);
}

/// A machine without forcing: a limit cycle, of which JSON has the period and no forcing periods, with its branch.
#[test]
fn a_limit_cycle() {
    let found = json("settle --machine stick-slip");
    let motion = &found["motion"];
    assert!(motion["label"] == "0/T" && motion["stable"] == true && motion["periods"].is_null(), "{motion}");
    assert_eq!(list(&motion["multipliers"]).len(), 1);
    let times: Vec<f64> = list(&motion["cycle"]).iter().map(|at| number(&at["time"])).collect();
    assert!((times[1] - times[0] - 4.0).abs() < 1e-12, "{times:?}");
    let period = |belt: f64| 0.4 / belt + core::f64::consts::PI + 2.0 * (belt / 0.2).atan();
    assert!(close(&motion["period"], period(0.1)), "{motion}");
    let orbits = json("orbit --machine stick-slip --label 0/T")["orbits"].clone();
    let [orbit] = list(&orbits) else { panic!("{orbits}") };
    assert!(orbit["label"] == "0/T" && close(&orbit["period"], period(0.1)), "{orbit}");
    let table = printed("branch --machine stick-slip --label 0/T --vary V --to 1 --csv -");
    let last = table.lines().last().unwrap();
    assert!(last.starts_with("1,1,0/T,true,true,stable,end of range,,0,0,") && last.contains(",,,,6.28839"), "{last}");
    let text = printed("branch --machine stick-slip --vary V --to 1");
    assert!(text.starts_with("branch 1: 0/T (stable there), V from 0.1 to 1, "), "{text}");
    has(&text, &["  ends at V 1.00000000000, period 6.28839", ", 0/T stable: end of range\n"]);
    for command in ["orbit", "branch --vary V --to 0.2"] {
        has(&refused(&format!("{command} --machine stick-slip --label 1/1")), &["not m/T", "for example 2/T"]);
    }
    refuse([("orbit --machine den-hartog --label 1/T", "the machine has a forcing")]);
}

#[test]
fn attractors_orbits_and_exponents() {
    let found = json("attractors --machine two-mass-hammer --starts 8");
    let motions = list(&found["motions"]);
    let total: f64 = motions.iter().map(|motion| number(&motion["share"])).sum();
    assert!(found["starts"] == 8 && (total - 1.0).abs() < 1e-12, "{found}");
    let orbits = json("orbit --machine two-mass-hammer --label 1/1")["orbits"].clone();
    let stable: Vec<_> = list(&orbits).iter().filter(|orbit| orbit["stable"] == true).collect();
    assert_eq!(stable.len(), 1, "{orbits}");
    let speed = number(&stable[0]["cycle"][0]["speed"]);
    assert!(close(&motions[0]["cycle"][0]["speed"], speed), "{motions:?}");
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
        let speed = number(&orbits[k]["cycle"][0]["speed"]);
        assert!(close(&found["branches"][0]["points"][0]["cycle"][0]["speed"], speed), "{k}");
        assert_eq!(found["orbit"], object!({"number": k + 1, "count": 2}));
    }
    let curve = "--kind fold --vary frequency=1:1.1 --and b=0.45:0.55 --points 5";
    let [one, two] = [1, 2].map(|k| json(&format!("curve {machine} --orbit {k} {curve}")));
    assert_eq!((&one["orbit"]["number"], &two["orbit"]["number"]), (&1.into(), &2.into()));
    // both orbits meet at the fold
    assert!(close(&one["found_at"][0], number(&two["found_at"][0])), "{one}");
    refuse([(format!("curve {machine} --orbit 3 {curve}"), "there is no orbit 2/1 number 3")]);
}

/// The sections of an attractor: a cycle is a few points, in the table and in the figure.
#[test]
fn sections() {
    let line = "lyapunov --machine two-mass-hammer --set frequency=1.06 --impacts 500 --points 40";
    let table = printed(&format!("{line} --csv -"));
    let rows = rows(&table);
    assert_eq!(rows[0].join(","), "section,stop,phase,speed,q.frame,q.head,qdot.frame,qdot.head");
    assert_eq!(rows.iter().map(|row| row[0]).filter(|name| *name == "strobe").count(), 40);
    let cycle = json("settle --machine two-mass-hammer --set frequency=1.06")["motion"]["cycle"].clone();
    for row in rows.iter().filter(|row| row[0] == "closing") {
        let number = |k: usize| row[k].parse::<f64>().unwrap();
        let same = |event: &Value| close(&event["phase"], number(2)) && close(&event["speed"], number(3));
        assert!(row[1] == "anvil" && list(&cycle).iter().any(same), "{row:?}");
    }
    let pair = line.replace("two-mass-hammer --set frequency=1.06", "impact-pair");
    let svg = Folder::new().drawn(&pair, "sections.svg");
    has(&svg, &["closings of stops", "states at phase 0", ">right<", ">left<", "q.ball", "qdot.ball"]);
    refuse([
        ("lyapunov --machine two-mass-hammer --points 4", "--section FILE or --plot FILE"),
        ("lyapunov --machine sdnd122 --csv -", "no forcing, so its attractor has no section"),
    ]);
}

#[test]
fn branches() {
    let found = json("branch --machine two-mass-hammer --vary frequency --to 1.05");
    assert_eq!(found["vary"], "frequency");
    let found = found["branches"][0].clone();
    let points = list(&found["points"]);
    assert_eq!(texts(&found["events"], "kind"), ["grazing", "fold", "end of range"]);
    let grazing = &found["events"][0];
    assert!(grazing["stop"] == "anvil" && grazing["appears"] == true, "{grazing}");
    // a settled motion before the grazing is on the branch
    let settled = json("settle --machine two-mass-hammer --set frequency=1.1")["motion"]["label"].clone();
    assert!(settled == "1/1" && number(&grazing["parameter"]) < 1.1, "{grazing}");
    assert!(points.iter().all(|point| list(&point["multipliers"]).len() == 4));
    let at = usize::try_from(grazing["point"].as_u64().unwrap()).unwrap();
    assert_eq!(points[at]["parameter"], grazing["parameter"]);
    let table = printed("branch --machine two-mass-hammer --vary frequency --to 1.05 --csv -");
    let rows = rows(&table);
    let head = "branch,frequency,label,admissible,stable,stability,event,stop,fastest,multiplier_1_re";
    assert_eq!(rows[0][..10].join(","), head);
    assert!(rows[0].ends_with(&["multiplier_4_im", "phases", "speeds", "stops"]), "{table}");
    assert_eq!(rows.len(), points.len() + 1);
    let row = &rows[at + 1];
    assert_eq!((row[5], row[6], row[7]), ("stable", "grazing", "anvil"), "{row:?}");
    let closings = list(&points[at]["cycle"]);
    let speeds: Vec<f64> = row[18].split(' ').map(|speed| speed.parse().unwrap()).collect();
    assert_eq!(speeds.len(), closings.len());
    assert!(closings.iter().zip(&speeds).all(|(of, speed)| close(&of["speed"], *speed)));
    assert_eq!(row[19].split(' ').collect::<Vec<_>>(), vec!["anvil"; closings.len()]);
    // a parameter of the file has no dot
    let text = printed("branch --machine two-mass-hammer --vary b --to 0.45");
    has(&text, &["end of range", "stable"]);
}

/// Branches that begin at flips are in the table and in the figure, before the simulation; the second number of a line is a column.
#[test]
fn all_branches_of_a_machine_are_written_and_drawn() {
    let folder = Folder::new();
    let line = "branch --machine two-mass-hammer --set frequency=0.95 --vary frequency --to 0.895 --follow 1";
    let drawn = folder.drawn(&format!("{line} --csv a.csv"), "a.svg");
    let of = |k: &str| folder.read("a.csv").lines().filter(|row| row.starts_with(k)).count();
    let found = json(line);
    let count = |branch: usize| list(&found["branches"][branch]["points"]).len();
    assert!(of("2,") > 2 && of("2,") == count(1) && of("1,") == count(0));
    has(
        &drawn,
        &[">stable<", ">unstable<", ">flip<", ">fold<", ">grazing<", ">simulation<", ">5/2<", "stroke-dasharray"],
    );
    let drawn = folder.drawn(&format!("{line} --no-diagram"), "b.svg");
    assert!(!drawn.contains(">simulation<") && drawn.contains(">5/2<"));
    refuse([(format!("{line} --no-diagram"), "hint: --plot FILE")]);

    let line = "--machine two-mass-hammer --vary frequency";
    let table = printed(&format!("branch {line} --to 1.1 --also stop.anvil.gap=0.6 --csv -"));
    assert!(table.starts_with("branch,frequency,stop.anvil.gap,label,"), "{table}");
    let last: Vec<&str> = table.lines().last().unwrap().split(',').collect();
    assert_eq!((last[1], last[2], last[6], last[7]), ("1.1", "0.6", "stable", "end of range"));
    let line_of_both = "--over 1.2:1.1:3 --also stop.anvil.gap=0.5:0.6";
    let diagram = printed(&format!("diagram {line} {line_of_both} --direction up --csv -"));
    let rows = rows(&diagram);
    assert_eq!(rows[0].join(","), "frequency,stop.anvil.gap,sweep,kind,stop,phase,speed");
    let values: Vec<_> = rows[1..].iter().map(|row| (row[0], row[1])).collect();
    assert_eq!(values, [("1.1", "0.6"), ("1.15", "0.55"), ("1.2", "0.5")]);
    // the sweep ends on the branch
    let (swept, followed): (f64, f64) = (rows[1][6].parse().unwrap(), last[9].parse().unwrap());
    assert!((swept - followed).abs() < 1e-7, "{swept} {followed}");
    let object = json(&format!("branch {line} --to 1.1 --also b=0.6"));
    assert_eq!(object["also"], object!({"parameter": "b", "from": 0.5, "to": 0.6}));
    assert_eq!(list(&object["branches"][0]["events"]).last().unwrap()["values"], object!([1.1, 0.6]));
}

#[test]
fn curves() {
    let line =
        "curve --machine bouncing-ball --set Gamma=1.2 --label 1/1 --kind flip --vary Gamma=0.2:3 --and e=0.3:0.8";
    let found = json(line);
    assert_eq!((&found["kind"], &found["parameters"]), (&"flip".into(), &object!(["Gamma", "e"])));
    assert_eq!(texts(&found["events"], "kind"), ["end of box", "end of box"]);
    let text = printed(line);
    has(&text, &["flip of 1/1 (orbit 1 of 2, stable there)\n  found at Gamma 1.5268", "end of box"]);
    let folder = Folder::new();
    let svg = folder.drawn(&format!("{line} --points 20 --csv curve.csv"), "curve.svg");
    let csv = folder.read("curve.csv");
    has(&svg, &[">Gamma<", ">flip of 1/1<", ">found on the branch<"]);
    assert!(csv.starts_with("Gamma,e,label,admissible,event,stop,residual,touch,multiplier_1_re,"), "{csv}");
    assert_eq!(csv.lines().count(), 1 + 39);
}

#[test]
fn basins_and_maps() {
    let table = printed("basin --machine two-mass-hammer --axis q.head=-1:1:3 --axis qdot.head=0:1:2 --csv -");
    assert_eq!(table, "q.head,qdot.head,label\n-1,0,1/1\n0,0,1/1\n1,0,refused\n-1,1,1/1\n0,1,1/1\n1,1,refused\n");
    let found = json("basin --machine two-mass-hammer --axis q.head=-1:1:3");
    assert_eq!(found["cells"], object!([0, 0, null]));
    assert!(found["refused"] == 1 && found["motions"][0]["starts"] == 2, "{found}");
    let line = "map --machine two-mass-hammer --axis frequency=0.8:1.2:3 --starts 2";
    let table = printed(&format!("{line} --csv -"));
    assert!(table.starts_with("frequency,label,share\n0.8,"), "{table}");
    for row in table.lines().skip(1) {
        let cells: Vec<&str> = row.split(',').collect();
        let alone = json(&format!("attractors --machine two-mass-hammer --set frequency={} --starts 2", cells[0]));
        assert!(list(&alone["motions"]).iter().any(|motion| motion["label"] == cells[1]), "{row}");
    }
    let (answer, text) = (json(line), printed(line));
    for of in answer["labels"].as_array().unwrap() {
        let (label, count) = (of["label"].as_str().unwrap(), &of["points"]);
        let row = text.lines().find(|row| row.split_whitespace().next() == Some(label)).expect("a row of the label");
        assert_eq!(row.split_whitespace().nth(1).unwrap(), count.to_string(), "{text}");
    }
}

/// Figures have the paths as names of axes; what has none is refused before anything is computed.
#[test]
fn figures() {
    let folder = Folder::new();
    let drawn = |line: &str| folder.drawn(line, "a.svg");
    let branch = drawn("branch --machine two-mass-hammer --vary frequency --to 1.05");
    has(&branch, &[">frequency<", "speed of closing", ">grazing<", ">fold<", ">stable<", ">unstable<", ">2/1<"]);
    let basin = "basin --machine two-mass-hammer --axis q.head=-1:0.4:4";
    has(&drawn(basin), &["share of starts", ">q.head<", "1/1, 100"]);
    has(&drawn(&format!("{basin} --axis qdot.head=-1:1:3")), &[">q.head<", ">qdot.head<"]);
    let map = "map --machine two-mass-hammer --axis frequency=0.8:1.2:3 --starts 2";
    has(&drawn(map), &["share of starts", ">3/1<"]);
    has(&drawn(&format!("{map} --axis stop.anvil.gap=0.4:0.5:2")), &[">stop.anvil.gap<", ">2/1<"]);
    has(&drawn("settle --machine two-mass-hammer"), &["displacement", ">impact<", "hammer: 1/1"]);
    let three = format!("{basin} --axis qdot.head=0:1:2 --axis phase=0:1:2 --plot none.svg");
    folder.refuse([
        ("settle --machine sdnd101 --impacts 200 --plot none.svg", "can be shown: undecided\nhint: `vibro simulate"),
        (&three, "one or two axes, not 3"),
    ]);
}

#[test]
fn refusals_of_questions() {
    let coordinates = "hint: q.NAME, qdot.NAME or phase; the coordinates are frame, head";
    let no_torus = "error: no torus was found on the branch of 1/1 with frequency from 1.1 to 1.3";
    let hammer = |line: &str| line.replacen(' ', " --machine two-mass-hammer ", 1);
    refuse([
        (hammer("basin --axis q.tail=0:1:3"), coordinates),
        (hammer("map --axis stop.anvil.gapp=0:1:3 --starts 2"), "hint: the numbers of anvil are gap, restitution"),
        (hammer("map --starts 2"), "hint: --axis PATH=A:B:N"),
        (hammer("map --axis mu=0:1 --starts 2"), "--axis <PATH=A:B:N>"),
        (hammer("branch --vary frequency --to 1.2"), "error: "),
        (hammer("curve --kind torus --vary frequency=1.1:1.3 --and b=0.4:0.6"), no_torus),
        (
            hammer("curve --kind flip --vary frequency=1.3:1.4 --and b=0.4:0.6"),
            "error: frequency = 1.2 lies outside the range from 1.3 to 1.4",
        ),
        (
            hammer("curve --kind flip --vary frequency=1:1.4 --and c=0.4:0.6"),
            "error: c: no such number in this machine",
        ),
    ]);
    let label = "--beta 1 --gap 1 --restitution 0.5 --label 1/1";
    refuse([
        ("orbit --machine sdnd101 --label 1/1", "error: label `1/1` is not m/T"),
        ("branch --machine sdnd101 --vary stop.stop.gap --to 1", "no cycle of events, so no branch begins there"),
        (&format!("curve {label} --kind torus --vary gap=0:2 --and beta=1:2"), "hint: --machine NAME|FILE"),
        (&format!("branch {label} --vary gapp --to 1"), "error: invalid value 'gapp' for '--vary"),
        // without a machine all of the system is needed
        ("map --gap 1 --starts 2", "the frequency ratio and the restitution are not given"),
        ("map --restitution 0.5 --starts 2", "the frequency ratio and the gap are not given"),
    ]);
}

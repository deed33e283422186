//! The command line that the library writes for a plan gives exactly this plan.

use crate::Folder;
use proptest::prelude::*;
use serde_json::{Value, json};
use vibroimpact_report::question::{command, shell_line};
use vibroimpact_study::Plan;

/// The plan that the command for a plan prints.
fn asked(plan: &Plan) -> Plan {
    let words = command(plan).expect("a command says it");
    let folder = Folder::new();
    let mut vibro = assert_cmd::Command::new(env!("CARGO_BIN_EXE_vibro"));
    vibro.args(&words[1..]).arg("--json").current_dir(&folder).timeout(std::time::Duration::from_secs(60));
    let output = vibro.output().expect("vibro runs");
    assert!(output.status.success(), "{words:?}: {}", String::from_utf8_lossy(&output.stderr));
    let object: Value = serde_json::from_slice(&output.stdout).expect("stdout is one JSON object");
    serde_json::from_value(object["plan"].clone()).expect("a plan")
}

fn plan(system: &Value, task: &Value) -> Plan {
    let plan: Plan = serde_json::from_value(json!({ "version": 1, "system": system, "task": task })).expect("a plan");
    plan.check().expect("it makes sense");
    plan
}

/// The command of a plan asks for this plan.
fn comes_back(system: &Value, task: &Value) {
    let plan = plan(system, task);
    let complete = plan.complete().expect("it was checked");
    assert_eq!(asked(&plan).hash(), complete.hash(), "{:?}", command(&plan));
}

#[test]
fn of_every_task() {
    let one = json!({ "inverse_beta": 1.11, "gap": 1.5, "restitution": 0.5 });
    let two = json!({ "beta": 0.9, "gap": 0.75, "restitution": 0.5, "damping": 0.05, "second_stop": { "gap": 2.0, "restitution": 0.4 } });
    let over = |parameter: &str, from: f64, to: f64| json!({ "parameter": parameter, "from": from, "to": to });
    for task in [
        json!({ "simulate": { "start": { "x": -0.5, "v": 1e-7, "phase": 0.1 }, "impacts": 3, "periods": 2.5, "time": 11.25 } }),
        json!({ "settle": { "start": { "v": -1.0 } } }),
        json!({ "attractors": { "starts": 4, "seed": 0 } }),
        json!({ "settle": { "start": {}, "impacts": 80 } }),
        json!({ "attractors": { "starts": 3, "seed": 1, "impacts": 80 } }),
        json!({ "orbit": { "label": " 1/1" } }),
        json!({ "basin": { "axes": [{ "vary": "x", "over": "-1:0.5:3" }, { "vary": "v", "over": "0.1:1:2:log" }],
                           "start": { "phase": -1.5 }, "impacts": 50 } }),
        json!({ "basin": { "axes": [{ "vary": "x", "over": "-1:0.5:3" }, { "vary": "v", "over": "0:1:2" }], "refine": 2 } }),
        json!({ "map": { "axes": [{ "vary": "gap", "over": "1:2:3" }, { "vary": "restitution", "over": [0.3, 0.2] }],
                         "starts": 2, "seed": 7, "impacts": 300 } }),
        json!({ "map": { "axes": [{ "vary": "inverse_beta", "over": "1:1.2:4" }], "starts": 1, "refine": 4 } }),
        json!({ "diagram": { "vary": "damping", "over": "0:0.1:2", "direction": "down", "transient": 10, "keep": 3 } }),
        json!({ "diagram": { "vary": "inverse_beta", "over": "1:1.2:2", "show": "strobe", "transient": 9,
                             "direction": { "scatter": { "starts": 2, "seed": 5 } } } }),
        json!({ "diagram": { "vary": "inverse_beta", "over": "1:1.2:3", "also": over("damping", 0.1, -0.0), "keep": 3 } }),
        json!({ "diagram": { "vary": "inverse_beta", "over": [1.2, 1.15, 1.0], "keep": 3 } }),
        json!({ "lyapunov": { "start": { "phase": 3.0 }, "impacts": 1000, "transient": 5 } }),
        json!({ "lyapunov": { "impacts": 1000, "points": 20 } }),
        json!({ "lyapunov": { "axes": [{ "vary": "gap", "over": "1:2:2" }, { "vary": "x", "over": [-0.5, 0.25] }],
                              "start": { "v": 0.5 }, "impacts": 1000, "transient": 20 } }),
        json!({ "margins": { "start": { "v": -1.0 }, "lines": 3 } }),
    ] {
        for system in [&one, &two] {
            comes_back(system, &task);
        }
    }
    let branch = |rest: Value| json!({ "branch": with(json!({ "label": "1/1", "vary": "gap", "to": 1.6, "points": 60 }), &rest) });
    let margins = |rest: Value| json!({ "margins": with(json!({ "label": "1/1", "within": 1.5, "lines": 0 }), &rest) });
    let region = |rest: Value| json!({ "region": with(json!({ "label": "1/1", "grid": 2 }), &rest) });
    let (beta, gap) = (over("beta", 0.9, 0.91), over("gap", 1.0, 1.1));
    let three = json!([{ "vary": "damping", "over": [0.1, 0.2] }, { "vary": "gap", "over": "1:2:2" },
                       { "vary": "inverse_beta", "over": "1:2:2" }]);
    for (system, task) in [
        (&two, json!({ "diagram": { "vary": "second_restitution", "over": "0.2:0.3:2", "transient": 10, "keep": 3 } })),
        (&two, json!({ "map": { "axes": [{ "vary": "second_gap", "over": "1:2:2" }], "starts": 1 } })),
        (&one, branch(json!({ "orbit": 1, "follow": 1 }))),
        (&one, branch(json!({ "also": { "parameter": "inverse_beta", "to": 1.1 } }))),
        (&one, margins(json!({ "vary": [{ "parameter": "gap", "scale": 0.25 }, { "parameter": "damping" }] }))),
        (
            &one,
            json!({ "curve": { "label": "1/1", "kind": "flip", "vary": over("gap", 1.0, 2.0),
                                  "and": over("inverse_beta", 1.1, 1.12), "orbit": 1, "event": 1 } }),
        ),
        (&one, region(json!({ "across": beta, "up": gap }))),
        (&one, region(json!({ "across": gap, "up": beta }))),
        (&one, json!({ "map": { "starts": 1, "axes": three } })),
        (&two, region(json!({ "across": gap, "up": over("second_restitution", 0.3, 0.4) }))),
    ] {
        comes_back(system, &task);
    }
}

/// An object with the fields of another one too.
fn with(mut object: Value, more: &Value) -> Value {
    let fields = object.as_object_mut().expect("an object");
    fields.extend(more.as_object().expect("an object").clone());
    object
}

/// The command of a body has the numbers of the body, and starts in metres.
#[test]
fn of_a_machine_in_its_units() {
    let machine = json!({ "mass_kg": 0.8, "stiffness_n_per_m": 12000, "force_n": 30, "frequency_hz": 15.5, "gap_m": 0.0015,
                          "restitution": 0.65, "damping_ratio": 0.02, "second_gap_m": 0.004, "second_restitution": 0.5 });
    let length = 30.0 / 12000.0;
    let axis = |vary: &str, over: &str| json!({ "vary": vary, "over": over });
    let map = |axes: &[Value]| json!({ "map": { "axes": axes, "starts": 1 } });
    let (frequency, gap) = (|| axis("frequency_hz", "10:20:3"), || axis("gap_m", "0.001:0.002:2"));
    let xs = format!("{}:{}:3", -0.002 / length, 0.001 / length);
    for (task, part) in [
        (json!({ "settle": { "start": { "x": 0.0005 / length } } }), "--x 0.0005"),
        (json!({ "simulate": { "start": {}, "periods": 3.0 } }), "--frequency-hz 15.5"),
        (json!({ "simulate": { "start": {}, "time": 0.25 * (12_000.0_f64 / 0.8).sqrt() } }), "--time 0.25"),
        (map(&[frequency(), gap()]), "--frequency-hz 10:20:3"),
        (map(&[gap(), frequency()]), "--axes gap-m,frequency-hz"),
        (map(&[axis("damping_ratio", "0:0.1:2"), axis("restitution", "0.5:0.6:2")]), "--damping-ratio 0:0.1:2"),
        (
            json!({ "diagram": { "vary": "gap_m", "over": "0.001:0.002:3", "keep": 3,
                                 "also": { "parameter": "frequency_hz", "from": 15.0, "to": 15.5 } } }),
            "--also frequency-hz=15:15.5",
        ),
        (json!({ "basin": { "axes": [axis("x", &xs), axis("v", "0:1:2")] } }), "--x -0.002:0.001:3"),
    ] {
        let plan: Plan =
            serde_json::from_value(json!({ "version": 1, "system": { "machine": machine }, "task": task })).unwrap();
        plan.check().unwrap();
        let words = command(&plan).unwrap().join(" ");
        assert!(words.contains(part) && words.contains("--mass-kg 0.8"), "{words}");
        let (asked, complete) = (asked(&plan), plan.complete().unwrap());
        assert_eq!((asked.system, asked.task), (complete.system, complete.task), "{words}");
    }
    // a parameter of the oscillator has no flag beside a machine
    let plan: Plan = serde_json::from_value(json!({ "version": 1, "system": { "machine": machine },
        "task": { "map": { "axes": [{ "vary": "gap", "over": "1:2:2" }], "starts": 1 } } }))
    .unwrap();
    assert_eq!(command(&plan), None);
}

/// The command line for a panel of the page draws exactly the figure of that panel.
#[test]
fn f10_the_command_of_a_view_draws_that_view() {
    use vibroimpact_report::question::shell_line_showing;
    use vibroimpact_report::scene::View;
    use vibroimpact_report::{Shown, Units, answer};
    use vibroimpact_study::Control;
    let plan = plan(
        &json!({ "inverse_beta": 1.3, "gap": 0.75, "restitution": 0.5 }),
        &json!({ "settle": { "start": { "v": 1.0 } } }),
    );
    let answer = answer(&plan, Units::default(), &Control::default()).expect("an answer");
    for view in View::ALL {
        let line = shell_line_showing(&plan, view).expect("a command says it");
        let folder = Folder::new();
        folder.printed(line.strip_prefix("vibro ").expect("it is vibro"));
        let drawn = folder.read(&format!("{}.svg", view.name()));
        let shown = answer.figure(&Shown { view: Some(view), ..Shown::default() }, &Control::default());
        assert_eq!(drawn, shown.expect("a figure").expect("it has this view").to_svg(), "{line}");
    }
    let chaos = "settle --inverse-beta 1.11 --gap 3 --restitution 0.5 --show multipliers --plot none.svg";
    let folder = Folder::new();
    let (code, _, complaint) = folder.ran(chaos);
    assert!(code != Some(0) && complaint.contains("the motion `chaotic` has no multipliers"), "{complaint}");
    assert!(!folder.at("none.svg").exists());
    folder.refused("settle --inverse-beta 1.3 --gap 0.75 --restitution 0.5 --show phase");
}

/// A size of tiles needs a store. A plan that no flags can express has no command; if it is a study, it is run from a
/// file.
#[test]
fn stores_and_plans_in_files() {
    let one = json!({ "inverse_beta": 1.11, "gap": 1.5, "restitution": 0.5 });
    for task in [
        json!({ "attractors": { "starts": 4, "seed": 1 } }),
        json!({ "diagram": { "vary": "gap", "over": "0:1:2", "transient": 10, "keep": 3 } }),
        json!({ "lyapunov": { "axes": [{ "vary": "gap", "over": "1:2:3" }], "start": {}, "impacts": 1000, "transient": 20 } }),
    ] {
        let tiled = Plan { tile: Some(2), ..plan(&one, &task) };
        assert_eq!(asked(&tiled), tiled);
    }
    let axes = |axes: Value| json!({ "axes": axes, "starts": 1 });
    let gap = json!({ "vary": "gap", "over": [1.0] });
    for task in [
        json!({ "map": axes(json!([{ "vary": "gap", "over": [1.0] }])) }),
        json!({ "basin": { "axes": [{ "vary": "x", "over": [0.0, 0.5] }, { "vary": "v", "over": "0:1:2" }] } }),
        json!({ "diagram": { "vary": "gap", "over": [1.0], "transient": 10, "keep": 3 } }),
        json!({ "lyapunov": { "axes": [gap], "impacts": 1000 } }),
    ] {
        let plan = plan(&one, &task);
        assert_eq!(command(&plan), None, "{task}");
        let line = shell_line(&plan).expect("it is a study");
        let folder = Folder::new();
        let program = std::path::Path::new(env!("CARGO_BIN_EXE_vibro")).parent().expect("a folder");
        let run = std::process::Command::new("sh")
            .args(["-c", &format!("{line} --json")])
            .env("PATH", std::env::join_paths([program, "/usr/bin".as_ref(), "/bin".as_ref()]).expect("a path"))
            .current_dir(&folder)
            .output()
            .expect("there is a shell");
        let object: Value = serde_json::from_slice(&run.stdout).expect("stdout is one JSON object");
        assert_eq!(object["plan_hash"], plan.hash(), "{line}");
    }
}

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        -1e3..1e3,
        -1e-9..1e-9,
        Just(-0.0),
        Just(0.0),
        Just(1.0),
        any::<f64>().prop_filter("a phase", |x| x.abs() <= 1e15)
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    /// All numbers are preserved, whatever their size: the flags of the system and of the start.
    #[test]
    fn of_any_system(
        beta in 1e-3..1e3_f64, inverse: bool, restitution in 0.0..=1.0, damping in prop_oneof![Just(0.0), 1e-12..0.5],
        room in prop_oneof![Just(0.0), 0.0..1e3_f64], second in prop::option::of((1e-9..1e3, 0.0..=1.0)), v in -1e3..1e3, phase in number(),
    ) {
        let gap: f64 = 0.1 + room;
        let mut system = json!({ "gap": gap, "restitution": restitution, "damping": damping });
        system[if inverse { "inverse_beta" } else { "beta" }] = beta.into();
        if let Some((gap, restitution)) = second {
            system["second_stop"] = json!({ "gap": gap, "restitution": restitution });
        }
        let plan = plan(&system, &json!({ "simulate": { "start": { "x": 0.1 * gap.min(1.0), "v": v, "phase": phase }, "impacts": 1, "periods": 0.5 } }));
        prop_assert_eq!(asked(&plan).hash(), plan.hash());
    }
}

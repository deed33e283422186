//! Command lines for files, pages and the program itself, and questions with a very large budget.

use super::parts::{Words, all, flag, line, switch, system, word};
use crate::values::{count, number, odd};
use proptest::prelude::*;

/// The files in the folder of every case: a valid plan, an invalid one, points, invalid points, a file that is no store, and a
/// machine.
pub(super) const FILES: [(&str, &str); 6] = [
    (
        "plan.toml",
        "version = 1\nsystem = { inverse_beta = 1.3, gap = 0.75, restitution = 0.5 }\n[task.basin]\naxes = [{ vary = \"x\", over = \"-2:0.5:5\" }, { vary = \"v\", over = \"-1:1:4\" }]\n",
    ),
    ("bad.toml", "version = 1\n[task.map]\naxes = [{ vary = \"gap\", over = [0, NaN] }]\n"),
    ("points.csv", "inverse_beta,gap,v\n1.3,0.75,0.5\n0.9,1.5,-1\n1.8,0.25,0\n"),
    ("bad.csv", "gap,v\n1,x\n"),
    ("thesis.zarr", "years of work"),
    (
        "machine.toml",
        "parameters = { mu = 0.25 }\n[machine]\nbodies = { body = 1, shoe = \"mu\" }\nlink = [{ between = [\"body\", \"shoe\"], stiffness = \"1/mu\" }]\n[[machine.stop]]\nname = \"wall\"\nat = \"body\"\ngap = 1\nrestitution = 0.8\n",
    ),
];

fn words(choice: &'static [&'static str]) -> Words {
    prop_oneof![9 => word(choice), 1 => odd()].prop_map(|word| vec![word]).boxed()
}

/// Any of these command lines.
pub(super) fn lines() -> Words {
    const PLACES: &[&str] =
        &["s.zarr", "thesis.zarr", ".", "", "none/s.zarr", "plan.toml", "s3://", "s3://bucket/x", "file:///none"];
    const PLANS: &[&str] = &["plan.toml", "plan.toml", "bad.toml", "none.toml", "", ".", "thesis.zarr"];
    let place = || words(PLACES);
    let parts = || flag("tiles", 0.2, word(&["1/1", "1/2", "2/1", "0/1", "1/0", "1", "/", "1/99999999999999999999"]));
    let spent = || flag("budget", 0.3, word(&["1ms", "0.01s", "5s", "1h", "0s", "-1h", "8", "h", ""]));
    prop_oneof![
        2 => line("run", vec![words(PLANS), flag("store", 0.6, word(&["s.zarr", "thesis.zarr", "plan.toml", ""])), parts(), spent(), switch("json", 0.5),
            flag("csv", 0.3, word(&["-", "t.csv", ""])), flag("plot", 0.2, word(&["f.svg", "f.png", "f"]))]),
        1 => line("estimate", vec![words(PLANS), flag("sample", 0.7, word(&["1", "4", "0", "-1"])), spent(), switch("json", 0.5)]),
        1 => line("slurm", vec![words(PLANS), flag("store", 0.3, odd()), flag("jobs", 0.4, count()), flag("cpus", 0.3, count()),
            flag("time", 0.3, word(&["04:00:00", "2-12:00:00", "", "soon", "1;rm"])), flag("partition", 0.3, odd()),
            flag("memory", 0.2, word(&["2G", "", "8 GB"])), flag("setup", 0.2, odd()), flag("throttle", 0.2, count()), switch("requeue", 0.3)]),
        1 => line("status", vec![place(), switch("json", 0.5)]),
        1 => line("verify", vec![place(), flag("sample", 0.3, count()), switch("json", 0.5)]),
        1 => line("resume", vec![place(), parts(), spent(), switch("json", 0.5)]),
        1 => line("export", vec![place(), flag("csv", 0.6, word(&["-", "t.csv", ""])), flag("parquet", 0.1, word(&["t.parquet"])),
            flag("python", 0.5, word(&["no-such-program", "", "false"]))]),
        1 => line("plot", vec![place(), words(&["f.svg", "f.png", "f", "", "none/f.svg"])]),
        2 => machine(),
        1 => line("schema", vec![switch("machine", 0.5)]),
        1 => line("contact", vec![flag("restitution", 0.6, odd()), flag("damping-ratio", 0.3, odd()), flag("mass-kg", 0.7, odd()),
            flag("stiffness-n-per-m", 0.5, odd()), flag("frequency-hz", 0.3, odd()), flag("contact-time-s", 0.3, odd()),
            flag("speed", 0.2, odd()), flag("opening", 0.3, word(&["force", "position", "both"])), switch("json", 0.5)]),
        1 => line("completions", vec![words(&["bash", "zsh", "fish", "elvish", "powershell", "tcsh"])]),
        1 => line("man", vec![words(&[".", "none", "plan.toml"])]),
        1 => line("bench", vec![flag("seconds", 1.0, prop_oneof![2 => word(&["0.01"]), 1 => word(&["0", "-1", "nan", "1e9"])].boxed()),
            flag("workload", 0.9, word(&["chaos", "regular", "basin", "none"])),
            flag("width", 0.4, word(&["portable", "avx2", "avx512", "none"])), switch("json", 0.5)]),
        1 => line("reproduce", vec![flag("out", 1.0, word(&["plan.toml", "thesis.zarr/x", ""])), switch("quick", 1.0)]),
        1 => line("explore", vec![flag("port", 1.0, word(&["-1", "65536", "x", ""])), switch("no-open", 1.0)]),
        1 => all(vec![words(&["help", "--help", "--version", "-h", "frobnicate", "settle", ""])]),
    ]
    .boxed()
}

/// Questions about machines and the numbers in them.
fn machine() -> Words {
    const MACHINES: &[&str] =
        &["machine.toml", "chain", "sdnd101", "cantilever", "capsule", "plan.toml", "bad.toml", "none", "", "."];
    const PATHS: &[&str] = &[
        "mu",
        "stop.wall.gap",
        "stop.wall.restitution",
        "mass.body",
        "stiffness.body.shoe",
        "link.body-shoe.stiffness",
        "frequency",
        "stop.wall",
        "",
    ];
    let set = || {
        let set = (prop_oneof![9 => word(PATHS), 1 => odd()], number());
        let set = set.prop_map(|(path, value)| format!("{path}={value}"));
        flag("set", 0.4, prop_oneof![19 => set, 1 => odd()].boxed())
    };
    prop_oneof![
        9 => line("machine", vec![word(&["show"]).prop_map(|word| vec![word]).boxed(), words(MACHINES), set(), set(),
            switch("toml", 0.3), switch("written", 0.3), switch("json", 0.4)]),
        1 => line("machine", vec![words(&["list", "list", "show", "help"]), switch("json", 0.5)]),
    ]
    .boxed()
}

/// Valid questions with a budget of minutes or days, which must stop at Ctrl-C.
pub(super) fn heavy() -> Words {
    let most = || word(&["1000000", "100000", "1000000000", "5000000"]);
    let huge = || word(&["-3:-1:5000", "-3:-1:100000", "-2:-1:1000000"]);
    let pair = || word(&["0.5:1.9:3000", "0.4:2:200000", "0.4:2:400"]);
    let long = || word(&["10000000", "3000000"]);
    prop_oneof![
        line("attractors", vec![system(), flag("starts", 1.0, most())]),
        line(
            "basin",
            vec![system(), flag("x", 1.0, huge()), flag("v", 1.0, huge()), flag("store", 0.3, word(&["s.zarr"]))]
        ),
        line(
            "map",
            vec![
                flag("inverse-beta", 1.0, pair()),
                flag("gap", 1.0, pair()),
                flag("restitution", 1.0, word(&["0.5", "0.9", "0", "1"])),
                flag("starts", 1.0, most()),
                flag("store", 0.3, word(&["s.zarr"])),
            ]
        ),
        line(
            "diagram",
            vec![
                flag("inverse-beta", 1.0, word(&["1.11", "0.7", "2"])),
                flag("restitution", 1.0, word(&["0.5", "0.9", "0"])),
                flag("vary", 1.0, word(&["gap"])),
                flag("over", 1.0, pair()),
                flag("transient", 1.0, word(&["1000000"])),
                flag("keep", 1.0, word(&["100000"])),
            ]
        ),
        line("simulate", vec![system(), flag("impacts", 1.0, long()), switch("json", 0.3)]),
        line("lyapunov", vec![system(), flag("impacts", 1.0, long())]),
        line(
            "orbit",
            vec![system(), flag("label", 1.0, word(&["10000/10000", "3000/2000", "500/1", "1/10000", "inf/9999"]))]
        ),
        line(
            "region",
            vec![
                flag("label", 1.0, word(&["1/1", "2/1", "9/7"])),
                flag("inverse-beta", 1.0, word(&["0.4:2", "0.4:20"])),
                flag("gap", 1.0, word(&["-1:5", "0:300"])),
                flag("restitution", 1.0, word(&["0.5", "1", "0"])),
                flag("grid", 1.0, word(&["400", "60"])),
            ]
        ),
        line("explore", vec![flag("port", 1.0, word(&["0"])), switch("no-open", 1.0)]),
        line("bench", vec![flag("seconds", 1.0, word(&["3600", "60"]))]),
        line("reproduce", vec![flag("out", 1.0, word(&["out"])), switch("quick", 0.5)]),
        line(
            "settle",
            vec![
                system(),
                flag("x", 1.0, number()),
                flag("rule", 1.0, word(&["paper"])),
                flag("limit", 1.0, word(&["100000"]))
            ]
        ),
    ]
    .boxed()
}

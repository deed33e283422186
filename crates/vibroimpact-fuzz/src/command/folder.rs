//! The files in the folder of every case, and questions with a very large budget.

/// A valid plan, an invalid one, points, invalid points, a file that is no store, a machine, and a start.
pub(super) const FILES: [(&str, &str); 7] = [
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
    ("start.json", "{\"q\":[0.1],\"qdot\":[0.2],\"phase\":0.3}"),
];

/// Valid questions with a budget of minutes or days, which must stop at Ctrl-C.
pub(super) const HEAVY: [&str; 16] = [
    "attractors --inverse-beta 1.3 --gap 0.75 --restitution 0.5 --starts 1000000000",
    "attractors --machine chain --starts 1000000",
    "basin --inverse-beta 1.3 --gap 0.75 --restitution 0.5 --x -3:-1:5000 --v -3:-1:100000",
    "basin --inverse-beta 1.3 --gap 0.75 --restitution 0.5 --x -3:-1:5000 --v -2:-1:5000 --store s.zarr",
    "map --inverse-beta 0.5:1.9:3000 --gap 0.4:2:200000 --restitution 0.9 --starts 100000",
    "map --inverse-beta 0.5:1.9:3000 --gap 0.4:2:400 --restitution 0 --starts 5000000 --store s.zarr",
    "diagram --inverse-beta 1.11 --restitution 0.5 --vary gap --over 0.4:2:200000 --transient 1000000 --keep 100000",
    "simulate --inverse-beta 1.3 --gap 0.75 --restitution 0.5 --impacts 10000000",
    "lyapunov --inverse-beta 1.11 --gap 1.5 --restitution 0.9 --impacts 3000000",
    "orbit --inverse-beta 1.3 --gap 0.75 --restitution 0.5 --label 3000/2000",
    "region --label 9/7 --inverse-beta 0.4:20 --gap 0:300 --restitution 0.5 --grid 400",
    "explore --port 0 --no-open",
    "bench --seconds 3600",
    "reproduce --out out",
    "settle --inverse-beta 1.3 --gap 0.75 --restitution 0.5 --rule paper --limit 100000",
    "response --machine chain --axis frequency=0.4:1.2:100000",
];

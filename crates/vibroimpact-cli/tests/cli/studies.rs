//! Tests of studies from outside: killed, resumed, damaged, run twice at the same time, and refused.
#![allow(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::{Folder, has, number, rows, vibro};
use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

const PLAN: &str = r#"
version = 1
tile = 4
system = { restitution = 0.5 }

[task.map]
starts = 4
seed = 1
impacts = 2000
axes = [
  { vary = "inverse_beta", over = "0.6:1.9:28" },
  { vary = "gap", over = "0:3:28" },
]
"#;

/// A folder with the study of a plan.
fn study(plan: &str) -> Folder {
    Folder::with("study.toml", plan)
}

/// The plan with so many values on both axes.
fn smaller(count: u32) -> String {
    PLAN.replace(":28\"", &format!(":{count}\""))
}

/// Starts `vibro` in a folder, in the background.
fn begin(folder: &Folder, line: &str) -> Child {
    Command::new(env!("CARGO_BIN_EXE_vibro"))
        .args(line.split_whitespace())
        .current_dir(folder)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap()
}

impl Folder {
    /// The exit code of `vibro`, and what it complains of.
    fn said(&self, line: &str) -> (Option<i32>, String) {
        let (code, _, complaint) = self.ran(line);
        (code, complaint)
    }
}

/// A study that is killed at twenty moments and resumed is equal to that of a run without interruption, byte for byte; with
/// and without shards.
#[test]
#[cfg(unix)]
fn killed_at_twenty_moments() {
    killed_at_ten_moments(PLAN);
    killed_at_ten_moments(&sharded());
}

/// The plan in smaller tiles, in shards of 25 tiles.
fn sharded() -> String {
    PLAN.replace("tile = 4", "tile = 2\nshard = 5")
}

#[cfg(unix)]
fn killed_at_ten_moments(text: &str) {
    let folder = study(text);
    let begun = Instant::now();
    folder.printed("run study.toml --store whole.zarr --threads 2");
    let time = begun.elapsed();
    let want = folder.files("whole.zarr");
    let (mut killed, mut moment) = (0, 0_u64);
    let mut store = 0;
    while killed < 10 {
        // a fixed pseudorandom sequence of moments, spread over a third of the duration of the whole run
        moment = moment.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let share = (moment >> 33) as f64 / (1_u64 << 31) as f64;
        let verb = if folder.at(&format!("{store}.zarr/zarr.json")).exists() {
            format!("resume {store}.zarr --threads 2")
        } else {
            format!("run study.toml --store {store}.zarr --threads 2")
        };
        let mut run = begin(&folder, &verb);
        std::thread::sleep(time.mul_f64(0.33 * share));
        if run.try_wait().unwrap().is_some() {
            // the study was complete before the moment came, so a new one is begun
            assert!(folder.files(&format!("{store}.zarr")) == want, "{killed} kills");
            store += 1;
            continue;
        }
        run.kill().unwrap();
        run.wait().unwrap();
        killed += 1;
    }
    let begun = folder.at(&format!("{store}.zarr/zarr.json")).exists();
    let verb = if begun { "resume" } else { "run study.toml --store" };
    folder.printed(&format!("{verb} {store}.zarr"));
    assert!(folder.files(&format!("{store}.zarr")) == want);
}

/// The parts of sweeps in a store, with the times at which they were written.
#[cfg(unix)]
fn parts_in(store: &Path) -> Vec<(std::ffi::OsString, std::time::SystemTime)> {
    let Ok(entries) = fs::read_dir(store.join(".begun")) else { return Vec::new() };
    // a part may be replaced while the folder is read
    let written = |entry: fs::DirEntry| Some((entry.file_name(), entry.metadata().ok()?.modified().ok()?));
    let mut parts: Vec<_> = entries.flatten().filter_map(written).collect();
    parts.sort();
    parts
}

/// Sweeps of an orbit diagram that are killed again and again, before any run could complete one of them: each run goes on
/// from the last state that was written, and the bytes are those of a run without interruption.
#[test]
#[cfg(unix)]
fn sweeps_go_on_however_often_they_are_killed() {
    let folder = Folder::new();
    let begun = Instant::now();
    folder.printed(&sweep("few", 8));
    // as many values as take three times as long as a part; more, if the machine has become faster since
    let mut values = 8 * 3 * PART.as_millis() / begun.elapsed().as_millis().max(1);
    loop {
        let (kills, parts) = killed_sweep(&folder, u32::try_from(values).unwrap().max(8));
        if kills >= 2 && parts >= 1 {
            break;
        }
        values *= 3;
        assert!(values < 200_000, "{values} values, {kills} kills, {parts} with parts");
    }
}

/// A part of a sweep is written this long after the begin of a run.
#[cfg(unix)]
const PART: Duration = Duration::from_secs(2);

#[cfg(unix)]
fn sweep(store: &str, values: u32) -> String {
    format!(
        "diagram --inverse-beta 1.11 --restitution 0.5 --vary gap --over 2:4:{values} --transient 20000 --keep 16 \
         --store {store}.zarr --threads 1"
    )
}

/// Kills the run of a sweep and goes on, until it is complete, and compares it with an undisturbed one; returns how often it was
/// killed, and how often there was a part of it then.
#[cfg(unix)]
fn killed_sweep(folder: &Folder, values: u32) -> (u32, usize) {
    let (whole, killed) = (format!("whole{values}"), format!("killed{values}"));
    folder.printed(&sweep(&whole, values));
    let want = folder.files(&format!("{whole}.zarr"));
    let place = folder.at(&format!("{killed}.zarr"));
    let (mut kills, mut parts) = (0, 0);
    loop {
        let goes_on = kills % 2 == 1 && place.join("zarr.json").exists();
        let line = if goes_on { format!("resume {killed}.zarr --threads 1") } else { sweep(&killed, values) };
        let before = parts_in(&place);
        let mut run = begin(folder, &line);
        // the first one before anything is written, the others when a further part of a sweep has been written
        std::thread::sleep(PART / 4);
        while kills > 0 && parts_in(&place) == before && run.try_wait().unwrap().is_none() {
            std::thread::sleep(Duration::from_millis(20));
        }
        if let Some(status) = run.try_wait().unwrap() {
            assert!(status.success(), "{line}: {status}");
            break;
        }
        run.kill().unwrap();
        run.wait().unwrap();
        kills += 1;
        parts += usize::from(place.join(".begun").is_dir());
        assert!(kills < 40, "it does not get on");
    }
    assert!(folder.files(&format!("{killed}.zarr")) == want, "{values} values, {kills} kills");
    (kills, parts)
}

/// After Ctrl-C, complete tiles are kept, and a hint says how to continue.
#[test]
#[cfg(unix)]
fn stopped_it_can_be_resumed() {
    let folder = study(&smaller(120));
    let run = Command::new(env!("CARGO_BIN_EXE_vibro"))
        .args(["run", "study.toml", "--store", "s.zarr"])
        .current_dir(&folder)
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let status = || folder.at("s.zarr/status/c");
    let begun = Instant::now();
    while !status().exists() && begun.elapsed() < Duration::from_secs(30) {
        std::thread::sleep(Duration::from_millis(5));
    }
    Command::new("kill").args(["-INT", &run.id().to_string()]).status().unwrap();
    let output = run.wait_with_output().unwrap();
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(130), "{complaint}");
    assert!(complaint.contains("`vibro resume` goes on"), "{complaint}");
    let answer = folder.json("status s.zarr");
    assert!(answer["tiles_done"].as_u64().unwrap() > 0 && answer["complete"] == false, "{answer}");
    assert_eq!(answer["tiles"], 900);
}

/// A run whose budget is spent says what is done and how to go on; what it leaves is completed to the same bytes.
#[test]
fn a_budget_stops_a_run_and_the_status_says_how_far_it_is() {
    let folder = study(&smaller(16));
    folder.printed("run study.toml --store whole.zarr --threads 1");
    let want = folder.files("whole.zarr");
    let (code, note) = folder.said("run study.toml --store s.zarr --budget 0.000001s --threads 1");
    assert!(code == Some(130), "{note}");
    let stopped = "stopped: the budget is spent, 1 of 16 tiles are there; `vibro resume s.zarr` goes on";
    has(&note, &["1 of 16 tiles computed; 15 left\n", stopped]);
    let status = || folder.json("status s.zarr");
    let first = status();
    assert_eq!((first["tiles_done"].as_u64(), first["tiles_left"].as_u64()), (Some(1), Some(15)), "{first}");
    assert_eq!((&first["progress"], &first["tiles_damaged"]), (&(16.0 / 256.0).into(), &0.into()));
    assert_eq!(first["tile"].to_string(), r#"{"gap":4,"inverse_beta":4}"#);
    assert_eq!(first["cost"]["tiles"], 1);
    let watch = begin(&folder, "status s.zarr --watch --every 0.01s --json");
    let (code, printed, _) = folder.ran("resume s.zarr --budget 0.000001s --json");
    assert_eq!((code, printed.as_str()), (Some(130), ""));
    let map = "map --inverse-beta 0.6:1.9:16 --gap 0:3:16 --restitution 0.5 --starts 4 --impacts 2000 --tile 4 --store s.zarr";
    assert_eq!(folder.said(&format!("{map} --budget 0.000001s --plot a.png")).0, Some(130));
    assert!(!folder.at("a.png").exists());
    // what is there is drawn
    folder.printed("plot s.zarr some.svg");
    folder.printed("resume s.zarr --budget 1h");
    assert!(folder.files("s.zarr") == want);
    // with shards
    let map = map.replace("--store s.zarr", "--shard 3 --store shards.zarr");
    assert_eq!(folder.said(&format!("{map} --budget 0.000001s")).0, Some(130));
    folder.printed("plot shards.zarr some-shards.svg");
    folder.printed(&format!("{map} --threads 2"));
    let sharded = folder.json("status shards.zarr");
    assert_eq!(sharded["shard"].to_string(), r#"{"gap":12,"inverse_beta":12}"#);
    assert_eq!(sharded["files"].as_u64(), Some(folder.files("shards.zarr").len() as u64));
    folder.printed("verify shards.zarr --sample 16");
    for store in ["s", "shards"] {
        folder.printed(&format!("export {store}.zarr --csv {store}.csv"));
    }
    assert!(folder.bytes("s.csv") == folder.bytes("shards.csv"));
    // the watch ends when the store is complete
    assert!(watch.wait_with_output().unwrap().status.success());
    let last = status();
    assert_eq!((&last["progress"], &last["complete"], &last["cost"]["tiles"]), (&1.0.into(), &true.into(), &16.into()));
    let regions = last["cost"]["regions"].as_array().unwrap();
    let points: u64 = regions.iter().map(|region| region["points"].as_u64().unwrap()).sum();
    assert_eq!((regions.len(), points), (16, 256));
    let line = folder.printed("status s.zarr --watch");
    assert_eq!(line, "100.0 %  16 of 16 tiles, 256 of 256 points, complete\n");
    folder.refuse([
        ("run study.toml --budget 8", "hint: 8h, 8m or 8s"),
        ("run study.toml --budget -1h", "outside 0 < time <= 36500d"),
        ("resume s.zarr --budget 04:00:00", "hint: write 4h"),
        ("status s.zarr --watch --every 0s", "outside 0 < time <= 36500d"),
        ("map --inverse-beta 0.6:1.9:16 --gap 0:3:16 --restitution 0.5 --starts 4 --budget 1h", "--store"),
    ]);
}

/// The estimate holds for the run: points, files to the last one, and times and bytes in their order of magnitude.
#[test]
fn an_estimate_before_anything_starts() {
    let folder = study(&smaller(16));
    let estimate = |flags: &str| folder.json(&format!("estimate study.toml {flags}"));
    let found = estimate("--threads 2");
    assert_eq!(folder.count(), 1, "nothing is written");
    folder.printed("run study.toml --threads 2");
    let status = folder.json("status study.zarr");
    assert_eq!((&found["points"], &found["tiles"], &found["threads"]), (&256.into(), &16.into(), &2.into()));
    assert_eq!((&found["points_sampled"], &found["plan_hash"]), (&64.into(), &status["plan_hash"]));
    assert_eq!(found["files"].as_u64(), Some(folder.files("study.zarr").len() as u64));
    let seconds = number(&found["processor_seconds"]);
    let interval = [0, 1].map(|k| number(&found["processor_seconds_interval"][k]));
    assert!(interval[0] <= seconds && seconds <= interval[1] && interval[0] > 0.0, "{found}");
    // the machine may be busy, and the sample is a quarter of the points
    let used = number(&status["cost"]["seconds"]);
    assert!((0.1..10.0).contains(&(seconds / used)), "{seconds} {used}");
    let bytes = number(&status["bytes"]);
    assert!((0.2..5.0).contains(&(number(&found["bytes"]) / bytes)), "{found} {bytes}");
    // a sample of all points has no interval
    let all = estimate("--sample 1000");
    assert_eq!(
        (&all["points_sampled"], &all["processor_seconds_interval"][0]),
        (&256.into(), &all["processor_seconds"])
    );
    let text = folder.printed("estimate study.toml --sample 4 --threads 1");
    has(
        &text,
        &["256 points in 16 tiles\nprocessor time: about ", "from 4 points", "time with 1 thread: about ", "\nstore: "],
    );
    folder.write("no.toml", PLAN.replace("map", "settle"));
    folder.refuse([("estimate no.toml", ""), ("estimate study.toml --sample 0", "")]);
}

/// Runs at the same time, of the whole study or of a part of the tiles, with and without shards.
#[test]
fn two_at_once_and_parts_make_the_same_store() {
    for plan in [PLAN, &sharded()] {
        let folder = study(plan);
        folder.printed("run study.toml --store whole.zarr --threads 1");
        let want = folder.files("whole.zarr");
        let line = "run study.toml --store both.zarr --threads 2";
        let mut both = [1, 2].map(|_| begin(&folder, line));
        assert!(both.iter_mut().all(|run| run.wait().unwrap().success()));
        assert!(folder.files("both.zarr") == want);
        // parts of tiles, and parts of whole shards
        for (of, store) in [(3, "tiles.zarr"), (2, "shards.zarr")] {
            let mut parts = (1..=of).map(|part| format!("run study.toml --store {store} --tiles {part}/{of}"));
            let mut runs: Vec<Child> = parts.by_ref().map(|line| begin(&folder, &line)).collect();
            assert!(runs.iter_mut().all(|run| run.wait().unwrap().success()));
            // two parts that end at the same moment may each see the other's last tile missing
            folder.printed(&format!("resume {store}"));
            assert!(folder.files(store) == want, "{store}");
        }
    }
}

#[test]
fn damage_is_found_by_verify_and_mended_by_resume() {
    let folder = study(&smaller(12));
    folder.printed("run study.toml");
    let want = folder.files("study.zarr");
    folder.printed("verify study.zarr --sample 9");
    let chunk = folder.at("study.zarr/label/c/1/2/0");
    let bytes = fs::read(&chunk).unwrap();
    let mut flipped = bytes.clone();
    flipped[bytes.len() / 2] ^= 4;
    for damaged in [flipped.as_slice(), &bytes[..bytes.len() - 1], b""] {
        fs::write(&chunk, damaged).unwrap();
        let (code, text, _) = folder.ran("verify study.zarr");
        assert_eq!(code, Some(1), "{text}");
        assert!(text.contains("tile 5: a chunk is missing, cut short or has a wrong check sum"), "{text}");
        let (code, note) = folder.said("resume study.zarr");
        assert!(code == Some(0) && note.contains("1 of 9 tiles computed, 1 of them because of damage"), "{note}");
        assert!(folder.files("study.zarr") == want);
    }
}

#[test]
fn tables_and_figures_of_every_kind_of_store() {
    let folder = Folder::new();
    let system = "--inverse-beta 1.3 --gap 0.75 --restitution 0.5";
    let free = "--inverse-beta 1.3 --restitution 0.5";
    for (line, fast) in [
        (format!("basin {system} --x -4:0.75:30 --v -4:4:20"), true),
        (format!("diagram {free} --vary gap --over 0:2:21"), true),
        (format!("diagram {free} --vary gap --over 0,0.5,0.6,2"), true),
        (format!("diagram {free} --vary gap --over 0:2:9 --direction scatter --starts 3 --show strobe"), true),
        ("map --beta 0.5:2:8:log --gap 0.5,1,2 --restitution 0.5 --starts 3".to_owned(), true),
        ("map --beta 0.8 --gap 0:2:3 --restitution 0.3,0.6 --damping 0:0.1:2 --starts 2".to_owned(), false),
    ] {
        let figure = if fast { "--plot a.svg" } else { "" };
        folder.printed(&format!("{line} --csv a.csv {figure} --force"));
        let store = "s.zarr";
        let _ = fs::remove_dir_all(folder.at(store));
        folder.printed(&format!("{line} --csv b.csv {} --store {store} --force", figure.replace('a', "b")));
        assert!(folder.bytes("a.csv") == folder.bytes("b.csv"), "{line}");
        if fast {
            assert!(folder.bytes("a.svg") == folder.bytes("b.svg"), "{line}");
            folder.printed(&format!("plot {store} c.svg --force"));
            assert!(folder.bytes("a.svg") == folder.bytes("c.svg"), "{line}");
        }
        folder.printed(&format!("export {store} --csv c.csv --force"));
        let table = folder.read("c.csv");
        let rows = rows(&table);
        assert!(rows.iter().all(|row| row.len() == rows[0].len()), "{line}");
    }
    folder.write(
        "study.toml",
        r#"{"version":1,"system":{"inverse_beta":1.11,"restitution":0.5},
            "task":{"lyapunov":{"impacts":1000,"axes":[{"vary":"gap","over":"2:3:3"}]}}}"#,
    );
    folder.printed("run study.toml --store l.zarr --csv l.csv --plot l.svg");
    let table = folder.read("l.csv");
    assert!(table.starts_with("gap,direction,exponent,exponent_error,impacts_per_period"), "{table}");
    assert_eq!(table.lines().count(), 7);
    folder.printed("attractors --inverse-beta 1.3 --gap 0.75 --restitution 0.5 --starts 100 --store a.zarr");
    folder.printed("export a.zarr --csv a.csv --force");
    let table = folder.read("a.csv");
    assert!(table.starts_with("start,label,cycle,x,v,phase\n1,") && table.lines().count() == 101, "{table}");
    folder.refuse([("plot a.zarr a.png", "no figure")]);
}

#[test]
fn refusals_are_one_sentence_and_lose_nothing() {
    let folder = study(&smaller(8));
    folder.printed("run study.toml --store s.zarr");
    let want = folder.files("s.zarr");
    fs::create_dir(folder.at("thesis")).unwrap();
    folder.write("thesis/text.tex", "years");
    let settle = r#"{"version":1,"system":{"beta":1,"gap":1,"restitution":0.5},"task":{"settle":{"start":{}}}}"#;
    for (name, text) in [
        ("misspelt.toml", PLAN.replace("starts", "start")),
        ("later.toml", PLAN.replace("version = 1", "version = 2")),
        ("beyond.toml", PLAN.replace("restitution = 0.5", "restitution = 1.5")),
        ("nothing.toml", String::new()),
        ("other.toml", PLAN.to_owned()),
        ("settle.json", settle.to_owned()),
    ] {
        folder.write(name, text);
    }
    for (line, word) in [
        ("run none.toml", "cannot be read"),
        ("run misspelt.toml", "unknown field `start`"),
        ("run later.toml", "version 2"),
        ("run beyond.toml", "restitution eps = 1.5"),
        ("run nothing.toml", "missing field"),
        ("run settle.json", "fills no grid"),
        ("run other.toml --store s.zarr", "holds another plan"),
        ("run study.toml --store thesis", "is not empty, and no store"),
        ("run study.toml --store thesis/text.tex", "no store"),
        ("run study.toml --store /proc/s.zarr", "cannot be begun"),
        ("run study.toml --tiles 4/3", "1 <= I <= N"),
        ("resume none.zarr", "there is no store"),
        ("status thesis", "there is no store"),
        ("export s.zarr", "--csv"),
        ("slurm study.toml --time soon", "as Slurm writes it"),
        ("map --beta 1 --gap 1 --restitution 0.5 --starts 2", "nothing varies"),
    ] {
        let (code, complaint) = folder.said(line);
        assert!(matches!(code, Some(1 | 2)), "{line}: {code:?}");
        assert!(complaint.contains(word) && complaint.len() < 900, "{line}: {complaint}");
        assert!(!complaint.contains("panicked") && !complaint.contains("defect"), "{line}: {complaint}");
    }
    assert!(folder.files("s.zarr") == want);
    assert_eq!(folder.read("thesis/text.tex"), "years");
    assert!(!folder.at("study.zarr").exists());
}

/// The script `job.sh` of a task of an array, without a cluster.
fn job(folder: &Folder, task: &str) -> Command {
    let mut job = Command::new("bash");
    job.arg("job.sh").current_dir(folder).env("SLURM_ARRAY_TASK_ID", task).env("SLURM_CPUS_PER_TASK", "1");
    job
}

/// The script of a job that puts itself into the queue again until its part is complete; here `scontrol` starts it again.
#[test]
#[cfg(unix)]
fn a_job_that_is_put_into_the_queue_again() {
    use std::os::unix::fs::PermissionsExt;
    let folder = study(&smaller(12));
    let line = "slurm study.toml --jobs 9 --cpus 2 --time 1-00:00:00 --requeue --partition long --memory 2G --account vi-17 --throttle 4";
    let setup = ["--setup", "export SETUP=\"a b\"", "--setup", "echo $SETUP"];
    let output = vibro(line).args(setup).current_dir(&folder).output().unwrap();
    let script = String::from_utf8(output.stdout).unwrap();
    for line in [
        "#SBATCH --array=1-9%4",
        "#SBATCH --partition=long",
        "#SBATCH --account=vi-17",
        "#SBATCH --mem=2G",
        "#SBATCH --requeue",
        "#SBATCH --open-mode=append",
        "export SETUP=\"a b\"",
        "echo $SETUP",
    ] {
        assert!(script.lines().any(|of| of == line), "{line}\n{script}");
    }
    // a day less half an hour
    assert!(script.contains("--budget 84600s"), "{script}");
    let script = script.replace("--budget 84600s", "--budget 0.000001s").replace("ID/9", "ID/1");
    folder.write("job.sh", script);
    folder.write("scontrol", "#!/bin/sh\necho \"$@\" >> queue\nexec bash job.sh\n");
    fs::set_permissions(folder.at("scontrol"), fs::Permissions::from_mode(0o755)).unwrap();
    let path = format!("{}:{}", folder.at("").display(), std::env::var("PATH").unwrap());
    let job = job(&folder, "1").env("SLURM_ARRAY_JOB_ID", "71").env("PATH", path).output().unwrap();
    assert!(job.status.success(), "{}", String::from_utf8_lossy(&job.stderr));
    assert!(String::from_utf8_lossy(&job.stdout).starts_with("a b\n"));
    assert_eq!(folder.read("queue"), "requeue 71_1\n".repeat(8));
    assert_eq!(folder.json("status study.zarr")["complete"], true);
    let flags = [("--memory 8g", "hint: 8G"), ("--account a;b", "letters, digits"), ("--throttle 0", "1")];
    folder.refuse(flags.map(|(flag, word)| (format!("slurm study.toml {flag}"), word)));
}

/// Whether a disk of memory could be mounted, or mounted anew.
#[cfg(target_os = "linux")]
fn mount(disk: &Path, options: &str) -> bool {
    let ran = Command::new("mount").args(["-t", "tmpfs", "-o", options, "tmpfs"]).arg(disk).status();
    ran.is_ok_and(|status| status.success())
}

/// A complete store is not written again, whether its folder is writable or not.
#[test]
#[cfg(target_os = "linux")]
fn a_complete_study_where_nothing_can_be_written() {
    let folder = study(&smaller(8));
    let disk = folder.at("disk");
    fs::create_dir(&disk).unwrap();
    let mount = |options: &str| mount(&disk, options);
    let mounted = mount("size=8m");
    let ran = folder.said("run study.toml --store disk/s.zarr");
    // the modification times of folders change when a file is created in them
    let written = || {
        let times = |path: &Path| fs::metadata(path).unwrap().modified().unwrap();
        let folders = ["", "label", "status", "share/c/0"].map(|name| times(&disk.join("s.zarr").join(name)));
        (folder.files("disk/s.zarr"), folders)
    };
    let before = written();
    let locked = mounted && mount("remount,ro");
    let run = "run study.toml --store disk/s.zarr";
    let said = [run, "resume disk/s.zarr", &format!("{run} --csv a.csv")].map(|line| folder.said(line));
    let after = written();
    if mounted {
        Command::new("umount").arg(&disk).status().unwrap();
    }
    assert_eq!(ran.0, Some(0), "{}", ran.1);
    for (code, note) in said {
        assert_eq!(code, Some(0), "{note}");
        has(&note, &["disk/s.zarr: 0 of 4 tiles computed, 4 found there; complete"]);
    }
    assert!(before == after);
    if !locked {
        println!("not on a read-only disk: this user may not mount one");
    }
}

/// A full disk: complete tiles are kept, and the run can be resumed when there is space; with and without shards.
#[test]
#[cfg(target_os = "linux")]
fn a_full_disk() {
    fills_a_disk(PLAN);
    fills_a_disk(&sharded());
}

#[cfg(target_os = "linux")]
#[allow(clippy::print_stdout, reason = "a test says that it is skipped")]
fn fills_a_disk(plan: &str) {
    let folder = study(plan);
    let disk = folder.at("disk");
    fs::create_dir(&disk).unwrap();
    let mount = |options: &str| mount(&disk, options);
    if !mount("size=96k") {
        println!("skipped: this user may not mount a small disk");
        return;
    }
    let (code, complaint) = folder.said("run study.toml --store disk/s.zarr");
    let outcome = mount("remount,size=8m").then(|| folder.said("resume disk/s.zarr"));
    let refused = mount("remount,ro").then(|| folder.said("run study.toml --store disk/other.zarr"));
    let stored = folder.files("disk/s.zarr");
    Command::new("umount").arg(&disk).status().unwrap();
    assert!(code == Some(1) && complaint.contains("No space left on device"), "{code:?} {complaint}");
    assert!(complaint.contains("hint: the tiles that are finished are kept"), "{complaint}");
    let (code, note) = outcome.unwrap();
    assert_eq!(code, Some(0), "{note}");
    folder.printed("run study.toml --store whole.zarr");
    assert!(stored == folder.files("whole.zarr"));
    if let Some((code, complaint)) = refused {
        assert!(code == Some(1) && complaint.contains("Read-only file system"), "{code:?} {complaint}");
    }
}

#[test]
fn the_script_for_a_cluster() {
    let folder = study(&smaller(8));
    let script = folder.printed("slurm study.toml --jobs 3 --cpus 1 --partition debug");
    has(&script, &["#SBATCH --array=1-3\n", "#SBATCH --partition=debug\n"]);
    // the script without a cluster: its jobs run one after another
    folder.write("job.sh", &script);
    for task in ["2", "1", "3"] {
        assert!(job(&folder, task).status().unwrap().success());
    }
    assert_eq!(folder.json("status study.zarr")["complete"], true);
}

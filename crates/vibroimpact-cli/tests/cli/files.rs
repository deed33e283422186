//! Tests of files and pipes: complete or absent, not overwritten without --force, equal for any number of threads.

use crate::{Folder, S, printed, rows};
use std::fs;
use std::io::Read;
use std::process::{Command, Stdio};

const GRID: &str = "--x -4:0.75:37 --v -4:4:29";
const SWEEP: &str = "--inverse-beta 1.3 --restitution 0.5 --vary gap --over -0.5:3:31";
const BRANCH: &str = "branch --inverse-beta 1.11 --gap 1.5 --restitution 0.5 --label 1/1 --vary gap --to 2 --follow 1";
const CURVE: &str = "curve --inverse-beta 0.7 --gap 2 --restitution 0.5 --label 1/1 --kind fold --vary gap=0:4 \
                     --and inverse-beta=0.45:0.8";
const REGION: &str = "region --label 1/1 --inverse-beta 1.05:1.2 --gap 1:2.5 --restitution 0.5 --grid 4";
const PLANE: &str = "--inverse-beta 0.5:1.9:8 --gap -0.5:3:6 --restitution 0.5 --starts 6";

/// A process with pipes of its own.
fn vibro(line: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_vibro"));
    command.args(line.split_whitespace());
    command
}

#[test]
fn tables_do_not_depend_on_threads() {
    let folder = Folder::new();
    for (name, line, header, rows) in [
        ("basin", format!("basin {S} {GRID}"), "x,v,label", 37 * 29),
        ("map", format!("map {PLANE}"), "inverse_beta,gap,label,share", 8 * 6),
        ("diagram", format!("diagram {SWEEP}"), "gap,sweep,kind,stop,phase,speed", 2 * 31),
        ("strobe", format!("diagram {SWEEP} --direction scatter --show strobe"), "gap,sweep,kind,x,v", 8 * 31),
    ] {
        let mut tables = Vec::new();
        for threads in [1, 2, 3] {
            let file = format!("{name}{threads}.csv");
            let line = format!("{line} --csv {file} --threads {threads} --quiet");
            assert_eq!(folder.ran(&line), (Some(0), String::new(), String::new()));
            tables.push(folder.read(&file));
        }
        assert_eq!(tables[0].lines().next(), Some(header));
        assert!(tables[0].lines().count() > rows, "{name}");
        assert!(tables.iter().all(|table| *table == tables[0]), "{name}");
        assert_eq!(printed(&format!("{line} --csv -")), tables[0]);
    }
    assert_eq!(folder.count(), 12, "no temporary file is left");
}

#[test]
fn existing_files_stay_unless_forced() {
    let folder = Folder::with("keep.csv", "precious");
    for line in [
        format!("basin {S} {GRID} --csv keep.csv"),
        format!("map {PLANE} --csv keep.csv"),
        format!("simulate {S} --csv keep.csv"),
        format!("diagram {SWEEP} --csv keep.csv"),
        format!("lyapunov {S} --section keep.csv"),
        format!("{BRANCH} --csv keep.csv"),
        format!("{CURVE} --csv keep.csv"),
        format!("{REGION} --csv keep.csv"),
        // a question without an answer leaves the file unchanged
        format!("branch {S} --label 7/5 --vary gap --to 1 --orbit 99 --csv keep.csv --force"),
    ] {
        let complaint = folder.refused(&line);
        assert!(complaint.contains("`keep.csv` exists already") || line.contains("--force"), "{complaint}");
        assert_eq!(folder.read("keep.csv"), "precious");
    }
    folder.printed(&format!("simulate {S} --csv keep.csv --force"));
    assert!(folder.read("keep.csv").starts_with("time,x,v,phase\n0,0,0,0\n"));
}

#[test]
fn places_that_cannot_hold_a_file() {
    let folder = Folder::with("file", "");
    fs::create_dir(folder.at("directory.svg")).unwrap();
    folder.refuse([
        (format!("simulate {S} --csv nowhere/a.csv"), "there is no directory"),
        (format!("simulate {S} --csv file/a.csv"), "cannot be written"),
        (format!("simulate {S} --plot directory.svg"), "is a directory"),
        (format!("simulate {S} --plot nowhere/a.png"), "there is no directory"),
        (format!("basin {S} {GRID} --csv same.svg --plot same.svg"), ""),
    ]);
    assert_eq!(folder.count(), 2);
}

#[cfg(unix)]
#[test]
fn a_directory_without_permission() {
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::new();
    let locked = folder.at("locked");
    fs::create_dir(&locked).unwrap();
    fs::set_permissions(&locked, fs::Permissions::from_mode(0o555)).unwrap();
    // root can write everywhere, so the test does not apply
    if fs::write(locked.join("probe"), "").is_err() {
        folder.refused(&format!("simulate {S} --csv locked/a.csv"));
    }
}

#[test]
fn pictures() {
    let folder = Folder::new();
    let inside = "--inverse-beta 1.11 --restitution 0.5 --vary gap --over 3.1:3.2:900";
    let two = "--beta 0.7 --gap 0.6 --restitution 0.7 --second-gap 0.8";
    for (file, line) in [
        ("a.png", "settle --beta 0.9 --gap -0.5 --restitution 0.5".to_owned()),
        ("a.svg", format!("settle {S} --second-gap 1")),
        ("a.png", format!("basin {S} {GRID}")),
        ("a.png", format!("diagram {SWEEP} --direction scatter")),
        ("a.png", format!("diagram {inside}")),
        ("a.png", "lyapunov --inverse-beta 1.11 --gap 3 --restitution 0.5 --impacts 1000".to_owned()),
        ("a.svg", format!("lyapunov {two} --impacts 1000")),
        ("a.svg", "lyapunov --beta 0.9 --gap -1.5 --restitution 0.5".to_owned()),
        ("a.png", BRANCH.to_owned()),
        ("a.svg", format!("{BRANCH} --no-diagram --virtual")),
        ("a.pdf", format!("{CURVE} --size 85x60mm")),
        ("a.svg", "diagram --beta 2 --restitution 0.5 --vary gap --over 5:6:3".to_owned()),
    ] {
        folder.printed(&format!("{line} --force --plot {file}"));
        let bytes = folder.bytes(file);
        let begin = match file {
            "a.svg" => &b"<svg"[..],
            "a.png" => b"\x89PNG",
            _ => b"%PDF-",
        };
        assert!(bytes.starts_with(begin) && (file != "a.pdf" || bytes.len() < 100_000), "{line}");
    }
}

#[test]
fn manual_pages() {
    let folder = Folder::new();
    folder.printed("man .");
    for page in ["vibro.1", "vibro-settle.1", "vibro-map.1"] {
        assert!(folder.read(page).contains("vibro"));
    }
    folder.refused("man .");
}

#[test]
fn a_reader_that_has_enough_is_no_failure() {
    for line in [
        "simulate --beta 0.9 --gap -0.5 --restitution 0.5 --periods 2000 --json".to_owned(),
        format!("basin {S} --x -4:0.75:100 --v -4:4:100 --csv -"),
        "man".into(),
        "--help".into(),
    ] {
        let mut child = vibro(&line).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let mut stdout = child.stdout.take().unwrap();
        let _ = stdout.read(&mut [0; 8]).unwrap();
        drop(stdout);
        let output = child.wait_with_output().unwrap();
        let complaint = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{line}: {complaint}");
        assert!(!complaint.contains("error"), "{complaint}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_a_failure() {
    let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let status = vibro(&format!("simulate {S}")).stdout(full).status().unwrap();
    assert_eq!(status.code(), Some(1));
}

#[cfg(unix)]
#[test]
fn control_c_stops_cleanly() {
    let folder = Folder::new();
    let line = format!("basin {S} --x -4:0.75:9000 --v -4:4:9000 --csv big.csv");
    let child = vibro(&line).current_dir(&folder).stderr(Stdio::piped()).spawn().unwrap();
    while folder.count() == 0 {
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    let pid = child.id().to_string();
    Command::new("kill").args(["-INT", &pid]).status().unwrap();
    let output = child.wait_with_output().unwrap();
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(130), "{complaint}");
    assert!(complaint.contains("stopped"), "{complaint}");
    assert_eq!(folder.count(), 0);
}

/// With `--csv -` nothing but the table goes to stdout, in every command that has a table.
#[test]
fn a_table_on_stdout_is_alone() {
    let folder = Folder::new();
    let plan = r#"{"version":1,"system":{"inverse_beta":1.3,"gap":0.75,"restitution":0.5},"task":{"attractors":{"starts":3,"seed":1}}}"#;
    folder.write("plan.json", plan);
    let grid = "--x -1:0.5:4 --v 0:1:3";
    for line in [
        format!("simulate {S} --impacts 3"),
        format!("settle {S}"),
        format!("attractors {S} --starts 5"),
        format!("attractors {S} --starts 5 --store attractors.zarr"),
        format!("basin {S} {grid}"),
        format!("basin {S} {grid} --store basin.zarr"),
        "map --inverse-beta 1:1.3:3 --gap 1 --restitution 0.5 --starts 3".into(),
        "diagram --inverse-beta 1.3 --restitution 0.5 --vary gap --over 0:1:3".into(),
        format!("lyapunov {S} --impacts 1000"),
        format!("branch {S} --label 1/1 --vary gap --to 0.8"),
        CURVE.to_owned(),
        "region --label 1/1 --inverse-beta 1:1.2 --gap 1:2 --restitution 0.5 --grid 4".into(),
        "response --beta 0.7:0.8:3 --gap 0.75 --restitution 0.5".into(),
        "run plan.json --store run.zarr".into(),
        "export basin.zarr".into(),
    ] {
        let text = folder.printed(&format!("{line} --csv -"));
        let rows = rows(&text);
        let width = rows[0].len();
        assert!(width > 1 && rows.len() > 1 && rows.iter().all(|row| row.len() == width), "{line}: {text}");
    }
}

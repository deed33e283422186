//! Tests of files and pipes: complete or absent, not overwritten without --force, equal for any number of threads.

use crate::{S, printed, printed_in, refused_in, vibro};
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

#[test]
fn tables_do_not_depend_on_threads() {
    let folder = tempfile::tempdir().unwrap();
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
            let output = vibro(&line).current_dir(&folder).output().unwrap();
            assert!(output.status.success() && output.stderr.is_empty());
            tables.push(fs::read_to_string(folder.path().join(file)).unwrap());
        }
        assert_eq!(tables[0].lines().next(), Some(header));
        assert!(tables[0].lines().count() > rows, "{name}");
        assert!(tables.iter().all(|table| *table == tables[0]), "{name}");
        assert_eq!(printed(&format!("{line} --csv -")), tables[0]);
    }
    let names: Vec<_> = folder.path().read_dir().unwrap().collect();
    assert_eq!(names.len(), 12, "no temporary file is left: {names:?}");
}

#[test]
fn existing_files_stay_unless_forced() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("keep.csv");
    fs::write(&file, "precious").unwrap();
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
        let complaint = refused_in(&folder, &line);
        assert!(complaint.contains("`keep.csv` exists already") || line.contains("--force"), "{complaint}");
        assert_eq!(fs::read_to_string(&file).unwrap(), "precious");
    }
    let forced = format!("simulate {S} --csv keep.csv --force");
    printed_in(&folder, &forced);
    assert!(fs::read_to_string(&file).unwrap().starts_with("time,x,v,phase\n0,0,0,0\n"));
}

#[test]
fn places_that_cannot_hold_a_file() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("file"), "").unwrap();
    fs::create_dir(folder.path().join("directory.svg")).unwrap();
    for (place, sentence) in [
        ("--csv nowhere/a.csv", "there is no directory"),
        ("--csv file/a.csv", "cannot be written"),
        ("--plot directory.svg", "is a directory"),
        ("--plot nowhere/a.png", "there is no directory"),
    ] {
        let line = format!("simulate {S} {place}");
        let complaint = refused_in(&folder, &line);
        assert!(complaint.contains(sentence), "{complaint}");
    }
    let twice = format!("basin {S} {GRID} --csv same.svg --plot same.svg");
    refused_in(&folder, &twice);
    assert_eq!(folder.path().read_dir().unwrap().count(), 2);
}

#[cfg(unix)]
#[test]
fn a_directory_without_permission() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let locked = folder.path().join("locked");
    fs::create_dir(&locked).unwrap();
    fs::set_permissions(&locked, fs::Permissions::from_mode(0o555)).unwrap();
    // root can write everywhere, so the test does not apply
    if fs::write(locked.join("probe"), "").is_err() {
        let line = format!("simulate {S} --csv locked/a.csv");
        refused_in(&folder, &line);
    }
}

#[test]
fn pictures() {
    let folder = tempfile::tempdir().unwrap();
    for (name, line) in [
        ("wave", format!("simulate {S} --periods 5 --plot wave.svg --csv wave.csv --step 0.1")),
        ("steady", "settle --beta 0.9 --gap -0.5 --restitution 0.5 --plot steady.png".into()),
        ("two", format!("settle {S} --second-gap 1 --plot two.svg")),
        ("basin", format!("basin {S} {GRID} --plot basin.png")),
        ("map", format!("map {PLANE} --plot map.svg")),
        ("diagram", format!("diagram {SWEEP} --plot diagram.svg")),
        ("scatter", format!("diagram {SWEEP} --direction scatter --plot scatter.png")),
        (
            "cells",
            "diagram --inverse-beta 1.11 --restitution 0.5 --vary gap --over 3.1:3.2:900 --plot cells.png".into(),
        ),
        ("section", format!("lyapunov {S} --impacts 1000 --plot section.svg")),
        ("cloud", "lyapunov --inverse-beta 1.11 --gap 3 --restitution 0.5 --impacts 1000 --plot cloud.png".into()),
        (
            "sides",
            "lyapunov --beta 0.7 --gap 0.6 --restitution 0.7 --second-gap 0.8 --impacts 1000 --plot sides.svg".into(),
        ),
        ("still", "lyapunov --beta 0.9 --gap -1.5 --restitution 0.5 --plot still.svg".into()),
        ("branch", format!("{BRANCH} --plot branch.png")),
        ("alone", format!("{BRANCH} --no-diagram --virtual --plot alone.svg")),
        ("curve", format!("{CURVE} --plot curve.svg")),
        ("region", format!("{REGION} --plot region.svg")),
        ("paper", format!("{CURVE} --plot paper.pdf --size 85x60mm")),
        ("nothing", "diagram --beta 2 --restitution 0.5 --vary gap --over 5:6:3 --plot nothing.svg".into()),
    ] {
        printed_in(&folder, &line);
        let svg = folder.path().join(format!("{name}.svg"));
        if svg.exists() {
            assert!(fs::read_to_string(svg).unwrap().starts_with("<svg"));
        } else if name == "paper" {
            let pdf = fs::read(folder.path().join("paper.pdf")).unwrap();
            assert!(pdf.starts_with(b"%PDF-") && pdf.len() < 100_000, "{} bytes", pdf.len());
        } else {
            let png = fs::read(folder.path().join(format!("{name}.png"))).unwrap();
            assert!(png.starts_with(b"\x89PNG"));
        }
    }
}

#[test]
fn manual_pages() {
    let folder = tempfile::tempdir().unwrap();
    printed_in(&folder, "man .");
    for page in ["vibro.1", "vibro-settle.1", "vibro-map.1"] {
        assert!(fs::read_to_string(folder.path().join(page)).unwrap().contains("vibro"));
    }
    refused_in(&folder, "man .");
}

#[test]
fn a_reader_that_has_enough_is_no_failure() {
    for line in [
        "simulate --beta 0.9 --gap -0.5 --restitution 0.5 --periods 2000 --json".to_owned(),
        format!("basin {S} --x -4:0.75:100 --v -4:4:100 --csv -"),
        "man".into(),
        "--help".into(),
    ] {
        let mut child = Command::new(env!("CARGO_BIN_EXE_vibro"))
            .args(line.split_whitespace())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
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
    let output = Command::new(env!("CARGO_BIN_EXE_vibro"))
        .args(format!("simulate {S}").split_whitespace())
        .stdout(full)
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(1));
}

#[cfg(unix)]
#[test]
fn control_c_stops_cleanly() {
    let folder = tempfile::tempdir().unwrap();
    let child = Command::new(env!("CARGO_BIN_EXE_vibro"))
        .args(format!("basin {S} --x -4:0.75:9000 --v -4:4:9000 --csv big.csv").split_whitespace())
        .current_dir(&folder)
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    while folder.path().read_dir().unwrap().count() == 0 {
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    let pid = child.id().to_string();
    Command::new("kill").args(["-INT", &pid]).status().unwrap();
    let output = child.wait_with_output().unwrap();
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(130), "{complaint}");
    assert!(complaint.contains("stopped"), "{complaint}");
    assert_eq!(folder.path().read_dir().unwrap().count(), 0);
}

/// With `--csv -` nothing but the table goes to stdout, in every command that has a table.
#[test]
fn a_table_on_stdout_is_alone() {
    let folder = tempfile::tempdir().unwrap();
    let plan = r#"{"version":1,"system":{"inverse_beta":1.3,"gap":0.75,"restitution":0.5},"task":{"attractors":{"starts":3,"seed":1}}}"#;
    fs::write(folder.path().join("plan.json"), plan).unwrap();
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
        "curve --inverse-beta 1.11 --gap 1.5 --restitution 0.5 --label 1/1 --kind flip --vary gap=1:2.5 --and inverse-beta=1:1.2"
            .into(),
        "region --label 1/1 --inverse-beta 1:1.2 --gap 1:2 --restitution 0.5 --grid 4".into(),
        "response --beta 0.7:0.8:3 --gap 0.75 --restitution 0.5".into(),
        "run plan.json --store run.zarr".into(),
        "export basin.zarr".into(),
    ] {
        let text = printed_in(&folder, &format!("{line} --csv -"));
        let columns = |line: &str| line.split(',').count();
        let width = columns(text.lines().next().unwrap());
        assert!(width > 1 && text.lines().count() > 1, "{line}: {text}");
        for row in text.lines() {
            assert_eq!(columns(row), width, "{line}: {row}");
        }
    }
}

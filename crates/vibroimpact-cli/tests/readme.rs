//! Runs every `vibro` line of the README, and of the pages on questions and on machines, and compares its output with what they show.

use assert_cmd::Command;
use std::fs;
use std::path::Path;

/// Fenced blocks of one language.
fn blocks(text: &str, language: &str) -> Vec<String> {
    let fence = format!("```{language}\n");
    text.split(&fence).skip(1).filter_map(|rest| rest.split("```").next()).map(str::to_owned).collect()
}

fn page(name: &str) -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(name)).expect("it is in the workspace")
}

fn vibro(line: &str, folder: &Path) -> std::process::Output {
    let words = line.split_whitespace().skip(1);
    Command::cargo_bin("vibro").expect("vibro is built").args(words).current_dir(folder).output().expect("vibro runs")
}

/// Runs a line as a shell does: with quotes, a comment, and what is printed in a file.
fn typed(line: &str, folder: &Path) -> std::process::Output {
    let line = line.split(" #").next().expect("a part of the line").replace('\'', "");
    let (command, file) = line.split_once(" > ").map_or((line.as_str(), None), |(command, file)| (command, Some(file)));
    let output = vibro(command, folder);
    if let Some(file) = file {
        fs::write(folder.join(file.trim()), &output.stdout).expect("a file in the folder of the test");
    }
    output
}

#[test]
fn shown_output_is_real_output() {
    let mut shown = 0;
    let pages = ["README.md", "docs/tour.md", "docs/units.md", "docs/basins.md"];
    let blocks = pages.map(|name| blocks(&page(name), "console")).concat();
    for block in blocks {
        // pages may name the same file
        let folder = tempfile::tempdir().unwrap();
        let (command, expected) = block.split_once('\n').unwrap();
        let output = vibro(command.trim_start_matches("$ "), folder.path());
        assert!(output.status.success(), "{command}");
        let out = String::from_utf8(output.stdout).unwrap();
        let mut lines = out.lines();
        for want in expected.lines().filter(|line| !line.is_empty()) {
            assert!(
                lines.any(|line| line == want),
                "{command}\nshould print, in this order\n{want}\nbut prints\n{out}"
            );
            shown += 1;
        }
    }
    assert!(shown > 60, "{shown} lines");
}

/// Runs the lines of a page in one folder, and returns it.
fn ran(name: &str, least: usize) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let blocks = blocks(&page(name), "sh").concat();
    let lines: Vec<&str> = blocks.lines().filter(|line| line.starts_with("vibro ")).collect();
    for line in &lines {
        let output = vibro(line, folder.path());
        assert!(output.status.success(), "{line}\n{}", String::from_utf8_lossy(&output.stderr));
    }
    assert!(lines.len() >= least, "{name}: {} lines", lines.len());
    folder
}

#[test]
fn every_command_line_runs() {
    let readme = ran("README.md", 1);
    let tour = ran("docs/tour.md", 12);
    for (folder, files) in [
        (&readme, &["map.csv", "map.svg"][..]),
        (&tour, &["basin.csv", "basin.png", "diagram.csv", "diagram.png", "attractor.png", "region.csv", "region.png"]),
    ] {
        for file in files {
            assert!(folder.path().join(file).exists(), "{file}");
        }
    }
}

/// Runs the page on studies: its plan, then every command line, in one folder.
#[test]
fn the_page_on_studies_runs() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let text = fs::read_to_string(root.join("docs/studies.md")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    // the same plan with fewer points
    let plan = blocks(&text, "toml").remove(0).replace(":33\"", ":7\"").replace(":41\"", ":9\"");
    fs::write(folder.path().join("map.toml"), plan).unwrap();
    fs::write(folder.path().join("systems.csv"), &blocks(&text, "csv")[0]).unwrap();
    let mut ran = 0;
    for line in blocks(&text, "sh").iter().flat_map(|block| block.lines()).filter(|line| line.starts_with("vibro ")) {
        // fewer points here too
        let line = &line.replace("lhs:1e4", "lhs:200").replace("lhs:1e5", "lhs:100");
        let output = vibro(line, folder.path());
        assert!(output.status.success(), "{line}\n{}", String::from_utf8_lossy(&output.stderr));
        ran += 1;
    }
    assert!(ran >= 9);
    assert_eq!(fs::read(folder.path().join("map.png")).unwrap(), fs::read(folder.path().join("again.png")).unwrap());
    let example = fs::read_to_string(root.join("examples/map-1971-fine.toml")).unwrap();
    let plan = vibroimpact_study::Plan::from_text(&example).unwrap();
    assert_eq!(vibroimpact_study::Study::new(&plan).unwrap().grid().points(), 3201 * 4001);
}

/// Writes the files of a page about machines, whose first line is their name, runs its command lines in one folder, and
/// counts them.
fn runs(name: &str, folder: &Path) -> usize {
    let text = page(name);
    let files = ["csv", "toml"].map(|language| blocks(&text, language)).concat();
    for block in &files {
        let file = block.lines().next().and_then(|line| line.strip_prefix("# ")).expect("the first line is the name");
        fs::write(folder.join(file), block).expect("a file in the folder of the test");
        if file.ends_with(".toml") && !block.contains("[task.") {
            let output = vibro(&format!("vibro machine show {file}"), folder);
            assert!(output.status.success(), "{name}: {file}\n{}", String::from_utf8_lossy(&output.stderr));
        }
    }
    let mut ran = files.len();
    for block in blocks(&text, "console") {
        let (command, expected) = block.split_once('\n').expect("a command and its output");
        let output = vibro(command.trim_start_matches("$ "), folder);
        let out = String::from_utf8(output.stdout).expect("the output is text");
        let mut lines = out.lines();
        for want in expected.lines() {
            assert!(
                lines.any(|line| line == want),
                "{name}: {command}\nshould print, in this order\n{want}\nbut prints\n{out}"
            );
        }
        ran += 1;
    }
    for line in blocks(&text, "sh").iter().flat_map(|block| block.lines()) {
        let output = typed(line, folder);
        assert!(output.status.success(), "{name}: {line}\n{}", String::from_utf8_lossy(&output.stderr));
        ran += 1;
    }
    ran
}

#[test]
fn the_page_on_machines_runs() {
    let folder = tempfile::tempdir().unwrap();
    let ran = runs("docs/machines.md", folder.path());
    assert!(ran >= 12, "{ran}");
    let expansion = |name: &str| vibro(&format!("vibro machine show {name} --toml"), folder.path()).stdout;
    assert_eq!(expansion("beam.toml"), expansion("table.toml"));
    assert!(folder.path().join("hammer.png").exists() && folder.path().join("waveform.png").exists());
}

#[test]
fn the_page_on_answers_runs() {
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(runs("docs/answers.md", folder.path()), 3);
}

/// Every machine of the catalogue has a page in the gallery, and every page runs and draws its figure.
#[test]
fn the_gallery_of_machines_runs() {
    let index = page("papers/machines/README.md");
    let entries = fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../papers/machines")).unwrap();
    let files: Vec<String> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    for name in vibroimpact_study::machine::CATALOGUE.iter().map(|entry| entry.name) {
        assert!(files.contains(&format!("{name}.md")), "{name} has no page");
    }
    for name in files.iter().filter_map(|file| file.strip_suffix(".md")).filter(|name| *name != "README") {
        let folder = tempfile::tempdir().unwrap();
        let (page, picture) = (format!("papers/machines/{name}.md"), format!("{name}.png"));
        // a page that is not in the catalogue can have a script instead of commands
        let known = vibroimpact_study::machine::CATALOGUE.iter().any(|entry| entry.name == name);
        let script = !known && self::page(&page).contains(&format!("$ python {name}.py"));
        assert!(script || runs(&page, folder.path()) >= 2, "{name}");
        let drawn = script || folder.path().join(&picture).exists();
        assert!(drawn && files.contains(&picture), "{name} draws no figure");
        assert!(index.contains(&picture) && index.contains(&format!("({name}.md)")), "{name}");
    }
}

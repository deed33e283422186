//! Runs every `vibro` line of the README, and of the pages on questions and on machines, and compares its output with what they show.
#![allow(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::{Folder, vibro, with_few_points};
use std::path::{Path, PathBuf};
use std::time::Duration;
use vibroimpact_study::machine::CATALOGUE;
use vibroimpact_study::{Plan, Study};

/// Fenced blocks of one language.
fn blocks(text: &str, language: &str) -> Vec<String> {
    let fence = format!("```{language}\n");
    text.split(&fence).skip(1).filter_map(|rest| rest.split("```").next()).map(str::to_owned).collect()
}

/// The command lines of a page, which stand in blocks for a shell, with few points: the page does not show what they print.
fn lines(text: &str) -> Vec<String> {
    blocks(text, "sh").iter().flat_map(|block| block.lines()).map(with_few_points).collect()
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn page(name: &str) -> String {
    std::fs::read_to_string(root().join(name)).expect("it is in the workspace")
}

/// Runs a line as a shell does: with quotes, a comment, and what is printed in a file.
fn typed(line: &str, folder: &Folder) -> Vec<u8> {
    let line = line.split(" #").next().expect("a part of the line").replace('\'', "");
    let (command, file) = line.split_once(" > ").map_or((line.as_str(), None), |(command, file)| (command, Some(file)));
    let mut run = vibro(command.strip_prefix("vibro ").expect(command));
    let run = run.current_dir(folder).timeout(Duration::from_secs(600)).output().expect("vibro runs");
    assert!(run.status.success(), "{line}\n{}", String::from_utf8_lossy(&run.stderr));
    if let Some(file) = file {
        folder.write(file.trim(), &run.stdout);
    }
    run.stdout
}

/// Runs the command of a block that shows its output, and checks that it prints these lines in this order; their number.
fn shown(block: &str, folder: &Folder) -> usize {
    let (command, expected) = block.split_once('\n').expect("a command and its output");
    let out = String::from_utf8(typed(command.trim_start_matches("$ "), folder)).expect("the output is text");
    let mut lines = out.lines();
    for want in expected.lines() {
        let printed = lines.any(|line| line == want);
        assert!(printed, "{command}\nshould print, in this order\n{want}\nbut prints\n{out}");
    }
    expected.lines().count()
}

#[test]
fn shown_output_is_real_output() {
    let pages = ["README.md", "docs/tour.md", "docs/units.md", "docs/basins.md"];
    let blocks = pages.map(|name| blocks(&page(name), "console")).concat();
    // pages may name the same file
    let lines: usize = blocks.iter().map(|block| shown(block, &Folder::new())).sum();
    assert!(lines > 60, "{lines} lines");
}

#[test]
fn every_command_line_runs() {
    let of_tour = ["basin.csv", "basin.png", "diagram.csv", "diagram.png", "attractor.png", "region.csv", "region.png"];
    for (name, least, files) in [("README.md", 1, &["map.csv", "map.svg"][..]), ("docs/tour.md", 12, &of_tour)] {
        let folder = Folder::new();
        let lines = lines(&page(name)).into_iter().filter(|line| line.starts_with("vibro "));
        let ran: Vec<_> = lines.map(|line| typed(&line, &folder)).collect();
        assert!(ran.len() >= least, "{name}: {} lines", ran.len());
        for file in files {
            assert!(folder.at(file).exists(), "{file}");
        }
    }
}

/// Runs the page on studies: its plan, then every command line, in one folder.
#[test]
fn the_page_on_studies_runs() {
    let text = page("docs/studies.md");
    // the same plan with fewer points
    let plan = blocks(&text, "toml").remove(0).replace(":33\"", ":7\"").replace(":41\"", ":9\"");
    let folder = Folder::with("map.toml", &plan);
    folder.write("systems.csv", &blocks(&text, "csv")[0]);
    let lines = lines(&text).into_iter().filter(|line| line.starts_with("vibro "));
    let ran: Vec<_> = lines.map(|line| typed(&line, &folder)).collect();
    assert!(ran.len() >= 9);
    assert_eq!(folder.bytes("map.png"), folder.bytes("again.png"));
    let plan = Plan::from_text(&page("examples/map-1971-fine.toml")).unwrap();
    assert_eq!(Study::new(&plan).unwrap().grid().points(), 3201 * 4001);
}

/// Writes the files of a page about machines, whose first line is their name, runs its command lines in one folder, and
/// counts them.
fn runs(name: &str, folder: &Folder) -> usize {
    let text = page(name);
    let files = ["csv", "toml"].map(|language| blocks(&text, language)).concat();
    for block in &files {
        let file = block.lines().next().and_then(|line| line.strip_prefix("# ")).expect("the first line is the name");
        folder.write(file, block);
        if file.ends_with(".toml") && !block.contains("[task.") {
            folder.printed(&format!("machine show {file}"));
        }
    }
    let (shows, lines) = (blocks(&text, "console"), lines(&text));
    for block in &shows {
        shown(block, folder);
    }
    for line in &lines {
        typed(line, folder);
    }
    files.len() + shows.len() + lines.len()
}

#[test]
fn the_pages_on_machines_and_answers_run() {
    let folder = Folder::new();
    let ran = runs("docs/machines.md", &folder);
    assert!(ran >= 12, "{ran}");
    let expansion = |name: &str| folder.printed(&format!("machine show {name} --toml"));
    assert_eq!(expansion("beam.toml"), expansion("table.toml"));
    assert!(folder.at("hammer.png").exists() && folder.at("waveform.png").exists());
    assert_eq!(runs("docs/answers.md", &Folder::new()), 3);
}

/// Every machine of the catalogue has a page in the gallery, and every page runs and draws its figure.
#[test]
fn the_gallery_of_machines_runs() {
    let index = page("papers/machines/README.md");
    let entries = std::fs::read_dir(root().join("papers/machines")).unwrap();
    let files: Vec<String> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    for entry in CATALOGUE {
        assert!(files.contains(&format!("{}.md", entry.name)), "{} has no page", entry.name);
    }
    for name in files.iter().filter_map(|file| file.strip_suffix(".md")).filter(|name| *name != "README") {
        let folder = Folder::new();
        let (page, picture) = (format!("papers/machines/{name}.md"), format!("{name}.png"));
        // a page that is not in the catalogue can have a script instead of commands
        let known = CATALOGUE.iter().any(|entry| entry.name == name);
        let script = !known && self::page(&page).contains(&format!("$ python {name}.py"));
        assert!(script || runs(&page, &folder) >= 2, "{name}");
        let drawn = script || folder.at(&picture).exists();
        assert!(drawn && files.contains(&picture), "{name} draws no figure");
        assert!(index.contains(&picture) && index.contains(&format!("({name}.md)")), "{name}");
    }
}

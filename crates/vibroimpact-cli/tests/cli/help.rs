//! Help: its examples run as they are written, and topics have what commands share.

use crate::{printed, printed_in, refused};
use std::fs;

/// The examples of a command, each as one line.
fn examples(command: &str) -> Vec<String> {
    let help = printed(&format!("{command} --help"));
    let (_, examples) = help.split_once("\nExample").expect("examples");
    let lines = examples.replace(" \\\n    ", " ");
    lines.lines().filter_map(|line| line.trim().strip_prefix("vibro ").map(str::to_owned)).collect()
}

/// The line with few points along an axis, few starts, and without long searches that other tests have: what the examples can
/// do does not depend on their number.
fn with_few_points(line: &str) -> String {
    let fewer = |word: &str| match word.splitn(4, ':').collect::<Vec<_>>()[..] {
        [from, to, count, ..] if count.parse().is_ok_and(|count: u32| count > 5) => {
            word.replacen(&format!("{from}:{to}:{count}"), &format!("{from}:{to}:5"), 1)
        }
        _ => word.to_owned(),
    };
    let shorter = [
        ("--layers regions,", "--layers "),
        ("--starts 20", "--starts 2"),
        ("frequency=1:1.2", "frequency=1.1:1.2"),
        ("lhs:2000", "lhs:200"),
        ("0.7:1.3:", "1:1.2:"),
    ];
    let line = shorter.iter().fold(line.to_owned(), |line, (long, short)| line.replace(long, short));
    line.split(' ').map(fewer).collect::<Vec<_>>().join(" ")
}

/// Those of questions, in the order of the list of commands, pasted one after another in a folder that is empty at first.
#[test]
fn examples_run_in_an_empty_folder() {
    let folder = tempfile::tempdir().unwrap();
    let mut ran = 0;
    for command in [
        "simulate",
        "settle",
        "settle-many",
        "attractors",
        "orbit",
        "branch",
        "curve",
        "region",
        "response",
        "margins",
        "basin",
        "map",
        "diagram",
        "lyapunov",
        "edge",
        "contact",
    ] {
        // the table of the user
        fs::write(folder.path().join("systems.csv"), "inverse_beta,gap\n1.3,0.75\n1.8,0.25\n").unwrap();
        for line in examples(command) {
            printed_in(&folder, &with_few_points(&line));
            ran += 1;
        }
    }
    assert!(ran > 35, "{ran} examples");
}

#[test]
fn topics_and_commands_are_explained() {
    let help = |of: &str| printed(&format!("help {of}"));
    assert_eq!(help("settle"), printed("settle --help"));
    assert!(help("machine show").contains("--toml") && help("").contains("vibro help units"));
    assert!(help("system").contains("--stiffness-n-per-m <K>") && help("system").contains("--machine <NAME|FILE>"));
    assert!(help("figure").contains("--greyscale") && help("figure").contains("--threads <N>"));
    assert!(help("store").contains("--shard <N>") && help("units").contains("N/mm"));
    assert!(help("quantities").contains("impact-speed-max") && help("machines").contains("two-mass-hammer"));
    assert!(refused("help mass").contains("no command and no topic `mass`\nhint: `vibro help`"));
}

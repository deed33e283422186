//! Help: its examples run as they are written, and topics have what commands share.

use crate::{Folder, has, printed, refuse, with_few_points};

/// The examples of a command, each as one line.
fn examples(command: &str) -> Vec<String> {
    let help = printed(&format!("{command} --help"));
    let (_, examples) = help.split_once("\nExample").expect("examples");
    let lines = examples.replace(" \\\n    ", " ");
    lines.lines().filter_map(|line| line.trim().strip_prefix("vibro ").map(str::to_owned)).collect()
}

/// Those of questions, in the order of the list of commands, pasted one after another in a folder that is empty at first.
#[test]
fn examples_run_in_an_empty_folder() {
    let folder = Folder::new();
    let mut ran = 0;
    let commands = "simulate settle settle-many attractors orbit branch curve region response margins basin map diagram lyapunov \
                    edge contact";
    for command in commands.split_whitespace() {
        // the table of the user
        folder.write("systems.csv", "inverse_beta,gap\n1.3,0.75\n1.8,0.25\n");
        for line in examples(command) {
            folder.printed(&with_few_points(&line));
            ran += 1;
        }
    }
    assert!(ran > 35, "{ran} examples");
}

#[test]
fn topics_and_commands_are_explained() {
    let help = |of: &str| printed(&format!("help {of}"));
    assert_eq!(help("settle"), printed("settle --help"));
    for (topic, words) in [
        ("machine show", &["--toml"][..]),
        ("", &["vibro help units"]),
        ("system", &["--stiffness-n-per-m <K>", "--machine <NAME|FILE>"]),
        ("figure", &["--greyscale", "--threads <N>"]),
        ("store", &["--shard <N>"]),
        ("units", &["N/mm"]),
        ("quantities", &["impact-speed-max"]),
        ("machines", &["two-mass-hammer"]),
    ] {
        has(&help(topic), words);
    }
    refuse([("help mass", "no command and no topic `mass`\nhint: `vibro help`")]);
}

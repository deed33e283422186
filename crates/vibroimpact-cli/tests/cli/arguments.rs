//! Random arguments: each gives an answer or a refusal within a short time, and no defect. `cargo xtask fuzz` runs
//! longer.

use std::collections::BTreeSet;
use std::path::Path;
use vibroimpact_fuzz::case::{Property, run, runner};
use vibroimpact_fuzz::command::Commands;

/// The same questions in every run, so that a failure is reproducible.
const SEED: u64 = 1971;
/// A small number of cases for the regular tests.
const CASES: u64 = 100;

#[test]
fn an_answer_or_a_refusal() {
    let mut commands = Commands::new(Path::new(env!("CARGO_BIN_EXE_vibro"))).unwrap();
    let mut known = BTreeSet::new();
    let strategy = commands.strategy();
    let faults: Vec<String> = (0..CASES)
        .filter_map(|k| run(&mut commands, (&strategy, runner(SEED, "commands", k)), &mut known, |_| {}).err())
        .map(|fault| format!("{}\n{}", fault.case, fault.why))
        .collect();
    assert!(faults.is_empty(), "{}", faults.join("\n\n"));
}

//! The tables of results in metres and seconds, printed and exported from stores.

use super::{COMMANDS, Command, MACHINE, Machine, bare, number};
use crate::vibro;
use std::collections::BTreeSet;

fn rows(line: &str) -> Vec<Vec<String>> {
    let output = vibro(line).output().unwrap();
    assert!(output.status.success(), "{line}: {}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).unwrap();
    text.lines().map(|row| row.split(',').map(str::to_owned).collect()).collect()
}

/// Compares two tables: names of columns without their units, and the numbers.
fn same_table(machine: &Machine, name: &str, a: &[Vec<String>], b: &[Vec<String>]) {
    assert!(a.len() == b.len() && a.len() > 1, "{name}");
    assert_eq!(a[0], b[0].iter().map(|head| bare(head)).collect::<Vec<_>>(), "{name}");
    let mut factors = BTreeSet::new();
    for (left, right) in a.iter().zip(b).skip(1) {
        for ((head, left), right) in a[0].iter().zip(left).zip(right) {
            for (left, right) in left.split(' ').zip(right.split(' ')) {
                match (left.parse::<f64>(), right.parse::<f64>()) {
                    (Ok(left), Ok(right)) => {
                        number(machine, &format!("{name} {head}"), head, (left, right), &mut factors);
                    }
                    _ => assert_eq!(left, right, "{name} {head}"),
                }
            }
        }
    }
    assert!(factors.len() > 1 || name == "attractors", "{name}: nothing is converted");
}

#[test]
fn f08_every_command_converts_its_table() {
    for Command { name, flags, without, .. } in COMMANDS.iter().filter(|command| command.table) {
        let (si, plain) = MACHINE.lines(name, flags, without);
        let flag = if *name == "lyapunov" { " --points 20 --section -" } else { " --csv -" };
        same_table(&MACHINE, name, &rows(&(plain + flag)), &rows(&(si + flag)));
    }
}

/// Random machines, the commands whose tables come from motions at one point or at given starts.
#[test]
fn random_machines_convert_their_tables() {
    for machine in Machine::random().take(6) {
        for Command { name, flags, without, .. } in COMMANDS.iter().filter(|c| AT_A_POINT.contains(&c.name)) {
            let (si, plain) = machine.lines(name, flags, without);
            same_table(&machine, name, &rows(&(plain + " --csv -")), &rows(&(si + " --csv -")));
        }
    }
}

/// Of the other commands values on an axis may differ in the last digit, and so may chaotic motions there.
const AT_A_POINT: [&str; 4] = ["simulate", "settle", "attractors", "basin"];

/// A store keeps its units: the table exported from it is that of the command without a store.
#[test]
fn stores_keep_their_units() {
    let machines: Vec<Machine> = core::iter::once(MACHINE).chain(Machine::random().take(3)).collect();
    let stored: Vec<&Command> = COMMANDS.iter().filter(|command| command.store).collect();
    assert_eq!(stored.len(), 3, "attractors, basin and diagram");
    for (Command { name, flags, without, .. }, machine) in
        stored.iter().flat_map(|c| machines.iter().map(move |m| (c, m)))
    {
        let (si, plain) = machine.lines(name, flags, without);
        let tables = [("plain.zarr", plain), ("si.zarr", si)].map(|(place, line)| {
            let folder = tempfile::tempdir().unwrap();
            let filled = vibro(&format!("{line} --store {place} --quiet")).current_dir(&folder).output().unwrap();
            assert!(filled.status.success(), "{name}: {}", String::from_utf8_lossy(&filled.stderr));
            let again = vibro(&format!("{line} --store {place} --quiet --csv -")).current_dir(&folder).output();
            let exported = String::from_utf8(again.unwrap().stdout).unwrap();
            if *name != "attractors" {
                let printed = vibro(&format!("{line} --csv -")).output().unwrap().stdout;
                assert_eq!(exported, String::from_utf8(printed).unwrap(), "{name}");
                // the figure of the store is that of the command
                let draw = |line: &str, file: &str| {
                    let drawn = vibro(line).current_dir(&folder).output().unwrap();
                    assert!(drawn.status.success(), "{line}: {}", String::from_utf8_lossy(&drawn.stderr));
                    std::fs::read_to_string(folder.path().join(file)).unwrap()
                };
                let stored = draw(&format!("plot {place} stored.svg"), "stored.svg");
                assert_eq!(stored, draw(&format!("{line} --plot own.svg"), "own.svg"), "{name}");
            }
            exported.lines().map(|row| row.split(',').map(str::to_owned).collect::<Vec<_>>()).collect::<Vec<_>>()
        });
        if *name != "attractors" {
            same_table(machine, name, &tables[0], &tables[1]);
        }
    }
}

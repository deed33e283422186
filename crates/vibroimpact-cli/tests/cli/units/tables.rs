//! The tables of results in metres and seconds, printed and exported from stores.

use super::{COMMANDS, Command, MACHINE, Machine, bare, number};
use crate::{Folder, printed, rows};
use std::collections::BTreeSet;

/// Compares two tables: names of columns without their units, and the numbers.
fn same_table(machine: &Machine, name: &str, plain: &str, si: &str) {
    let (a, b) = (rows(plain), rows(si));
    assert!(a.len() == b.len() && a.len() > 1, "{name}");
    assert_eq!(a[0], b[0].iter().map(|head| bare(head)).collect::<Vec<_>>(), "{name}");
    let mut factors = BTreeSet::new();
    for (left, right) in a.iter().zip(&b).skip(1) {
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
        same_table(&MACHINE, name, &printed(&(plain + flag)), &printed(&(si + flag)));
    }
}

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
            let folder = Folder::new();
            folder.printed(&format!("{line} --store {place} --quiet"));
            let exported = folder.printed(&format!("{line} --store {place} --quiet --csv -"));
            if *name != "attractors" {
                assert_eq!(exported, folder.printed(&format!("{line} --csv -")), "{name}");
                // the figure of the store is that of the command
                folder.printed(&format!("plot {place} stored.svg"));
                assert_eq!(folder.read("stored.svg"), folder.drawn(&line, "own.svg"), "{name}");
            }
            exported
        });
        if *name != "attractors" {
            same_table(machine, name, &tables[0], &tables[1]);
        }
    }
}

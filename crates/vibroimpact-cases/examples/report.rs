//! How many machines of each family break which rule: `cargo run -p vibroimpact-cases --example report [COUNT] [FAMILY]`.
//!
//! With a family, all its faults are listed. With `show FAMILY SEED` the file of a machine is printed, and its faults as comments,
//! with `show FAMILY SEED K` that of the machine in its writing K, from 0 to 7.
#![allow(clippy::print_stdout, reason = "it is a report")]

use std::collections::BTreeMap;
use std::panic::catch_unwind;
use vibroimpact_cases::{Budget, Case, Changed, DrawnFamily, FAMILIES, Rewriting, Rule, changed, faults};
use vibroimpact_study::machine::MachineSource;

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    if let ["show", family, seed, ref writing @ ..] = words.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        let (Some(family), Ok(seed)) = (DrawnFamily::named(family), seed.parse()) else {
            return println!("no such case");
        };
        let mut case = family.case(seed);
        if let Some(writing) = writing.first() {
            let Some(writing) = writing.parse().ok().and_then(|k: usize| Rewriting::ALL.get(k)) else {
                return println!("no such writing");
            };
            let Changed { machine, start, .. } = changed(&case, *writing);
            // what is known of its motion is in the order of the case
            case = Case { machine, start, symmetries: Vec::new(), equal: Vec::new(), same_as: None, ..case };
        }
        println!("{}", MachineSource::from(&case.machine).starting(&case.start).to_toml());
        for fault in faults(&case, Budget::default()) {
            println!("# {fault}");
        }
        return;
    }
    let count: u64 = words.first().and_then(|word| word.parse().ok()).unwrap_or(50);
    let only = words.get(1);
    println!("{:12} {:>5} {:>5}  rules broken: machines (first seeds)", "family", "all", "bad");
    for family in FAMILIES.iter().filter(|family| only.is_none_or(|name| name == family.name)) {
        let begin = std::time::Instant::now();
        let mut broken: BTreeMap<String, Vec<u64>> = BTreeMap::new();
        let mut bad = 0;
        for seed in 0..count {
            let found = catch_unwind(|| faults(&family.case(seed), Budget::default()));
            let names: Vec<String> = match &found {
                Ok(faults) => faults.iter().map(|fault| format!("{:?}", fault.rule)).collect(),
                Err(_) => vec!["panic".to_owned()],
            };
            bad += u32::from(!names.is_empty());
            if only.is_some() {
                for fault in found.iter().flatten() {
                    println!("  {seed}: {fault}");
                }
            }
            for name in names {
                broken.entry(name).or_default().push(seed);
            }
        }
        let order = |name: &str| Rule::ALL.iter().position(|rule| format!("{rule:?}") == name);
        let mut rows: Vec<_> = broken.iter().collect();
        rows.sort_by_key(|(name, _)| order(name));
        let text: Vec<String> = rows
            .iter()
            .map(|(name, seeds)| format!("{name}: {} {:?}", seeds.len(), &seeds[..seeds.len().min(4)]))
            .collect();
        println!("{:12} {count:5} {bad:5}  {}  [{:.1} s]", family.name, text.join("; "), begin.elapsed().as_secs_f64());
    }
}

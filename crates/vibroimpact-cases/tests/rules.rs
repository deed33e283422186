//! The rules that every motion keeps, on machines of all families.

use vibroimpact_cases::{Budget, FAMILIES, OPEN, faults, is_open};

/// Everyday 10 machines of each family; with `VIBROIMPACT_LONG=1` 60, more than a thousand together.
#[test]
fn motions_keep_all_rules() {
    let count = if std::env::var("VIBROIMPACT_LONG").is_ok() { 60 } else { 10 };
    let mut wrong = Vec::new();
    for family in FAMILIES {
        for seed in 0..count {
            for fault in faults(&family.case(seed), Budget::default()) {
                if !is_open(family.name, fault.rule) {
                    wrong.push(format!("{} {seed}: {fault}", family.name));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}:\n{}", wrong.len(), wrong.join("\n"));
}

/// The faults that are listed as open are there.
#[test]
fn open_faults_are_still_there() {
    for (name, rule, seed) in OPEN {
        let family = FAMILIES.iter().find(|family| family.name == *name);
        let found = family.map(|family| faults(&family.case(*seed), Budget::default())).unwrap_or_default();
        assert!(found.iter().any(|fault| fault.rule == *rule), "{name} {seed} keeps {rule:?}: remove it from the list");
    }
}

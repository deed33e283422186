//! The rules that every motion keeps, on machines of all families.

use vibroimpact_cases::{Budget, FAMILIES, faults};

/// Everyday 10 machines of each family; with `VIBROIMPACT_LONG=1` 60, more than a thousand together.
#[test]
fn motions_keep_all_rules() {
    let count = if std::env::var("VIBROIMPACT_LONG").is_ok() { 60 } else { 10 };
    let mut wrong = Vec::new();
    for family in FAMILIES {
        for seed in 0..count {
            for fault in faults(&family.case(seed), Budget::default()) {
                wrong.push(format!("{} {seed}: {fault}", family.name));
            }
        }
    }
    assert!(wrong.is_empty(), "{}:\n{}", wrong.len(), wrong.join("\n"));
}

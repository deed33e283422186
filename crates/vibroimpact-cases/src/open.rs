//! What is known to be wrong with drawn machines.

use crate::rules::Rule;

/// Faults that are known: family, rule, and a seed that shows it. A fault that is mended is removed here.
pub const OPEN: &[(&str, Rule, u64)] = &[
    // a body of 1e-9 of the mass of the other one, which has not moved yet, leaves a rigid stop
    ("light", Rule::Faint, 64),
    // more than 100 events at one time before bodies that strike each other without order are at rest
    ("columns", Rule::End, 170),
    ("chains", Rule::End, 189),
];

/// Whether a fault of a family against a rule is known.
#[must_use]
pub fn is_open(family: &str, rule: Rule) -> bool {
    OPEN.iter().any(|(name, known, _)| *name == family && *known == rule)
}

/// Machines whose events differ by more than rounding errors explain when they are written in another way: family and seed.
pub const DIFFERS: &[(&str, u64)] = &[
    // the number of impacts before a collapse without order, and its time to 1e-11
    ("columns", 10),
    ("columns", 18),
    ("columns", 53),
    // the time of a rest beside joints that slip and hold, to 1e-11
    ("friction", 25),
    ("friction", 44),
    ("duplicates", 46),
    // which of two joints on one coordinate slips
    ("friction", 35),
];

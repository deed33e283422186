//! What is known to be wrong with drawn machines.

use crate::rules::Rule;

/// Faults that are known: family, rule, and a seed that shows it. A fault that is mended is removed here.
pub const OPEN: &[(&str, Rule, u64)] = &[
    // a damped stop on a body of less than 1e-7 of the mass of the others
    ("light", Rule::End, 25),
    ("light", Rule::Faint, 64),
    ("light", Rule::Force, 61),
    // rows of bodies that touch without a load, some of which come to rest on each other
    ("chains", Rule::End, 66),
    ("chains", Rule::Faint, 60),
    ("chains", Rule::Symmetry, 153),
    ("chains", Rule::Gap, 168),
    ("chains", Rule::Jump, 168),
    ("cradles", Rule::End, 63),
    ("cradles", Rule::Jump, 164),
    ("columns", Rule::Gap, 122),
    ("columns", Rule::Jump, 122),
    ("twins", Rule::Force, 100),
];

/// Whether a fault of a family against a rule is known.
#[must_use]
pub fn is_open(family: &str, rule: Rule) -> bool {
    OPEN.iter().any(|(name, known, _)| *name == family && *known == rule)
}

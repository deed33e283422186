//! Command lines for one system.

use super::parts::{Words, flag, line, outputs, start, switch, system, word};
use crate::values::{count, label, number, plain};
use proptest::prelude::*;

const PARAMETERS: &[&str] = &[
    "gap",
    "inverse-beta",
    "beta",
    "restitution",
    "damping",
    "second-gap",
    "second-restitution",
    "mass-kg",
    "force-n",
    "frequency-hz",
    "gap-m",
    "mass",
    "",
];

/// Any of these command lines.
pub(super) fn lines() -> Words {
    let few = || prop_oneof![4 => word(&["1", "2", "5", "40"]), 1 => count()].boxed();
    prop_oneof![
        4 => line("settle", vec![
            system(),
            start(),
            flag("rule", 0.1, word(&["paper", "confirmed", "proved", "none"])),
            flag("percent", 0.05, number()),
            flag("limit", 0.05, count()),
            flag("impacts", 0.1, few()),
            outputs("csv"),
        ]),
        3 => line("simulate", vec![
            system(),
            start(),
            flag("impacts", 0.6, few()),
            flag("periods", 0.4, prop_oneof![3 => (0.0..20.0_f64).prop_map(crate::values::typed), 1 => plain()].boxed()),
            flag("step", 0.05, number()),
            outputs("csv"),
        ]),
        2 => line("attractors", vec![
            system(),
            flag("starts", 0.97, few()),
            flag("seed", 0.2, word(&["0", "7", "18446744073709551615", "-1", "x"])),
            flag("impacts", 0.2, few()),
            outputs("csv"),
        ]),
        2 => line("orbit", vec![system(), flag("label", 0.98, label()), switch("json", 0.6)]),
        2 => line("lyapunov", vec![
            system(),
            start(),
            flag("impacts", 0.9, word(&["1000", "1500", "999", "0", "-1"])),
            flag("transient", 0.9, word(&["100", "0", "300", "-1", "1000001"])),
            flag("points", 0.1, few()),
            flag("section", 0.1, word(&["s.csv", "-", ""])),
            outputs(""),
        ]),
        2 => branch(),
        1 => line("margins", vec![
            system(),
            start(),
            flag("label", 0.3, label()),
            flag("vary", 0.3, word(PARAMETERS)),
            flag("scale", 0.1, word(&["gap=0.1", "gap-m=0.1", "damping=0", "x"])),
            flag("within", 0.2, word(&["1.5", "1", "100", "nan"])),
            flag("lines", 0.9, word(&["0", "1", "5", "100001"])),
            flag("csv", 0.1, word(&["-", "m.csv"])),
            switch("json", 0.5),
        ]),
    ]
    .boxed()
}

fn branch() -> Words {
    let to = prop_oneof![
        8 => (-0.5..3.0_f64).prop_map(crate::values::typed),
        2 => word(&["0,3", "3,-0.5", "1,1", "0,x", "0,1,2"]),
        2 => number()
    ]
    .boxed();
    let also = (word(PARAMETERS), number()).prop_map(|(name, value)| format!("{name}={value}")).boxed();
    line(
        "branch",
        vec![
            system(),
            flag("label", 0.98, label()),
            flag("vary", 0.98, word(PARAMETERS)),
            flag("to", 0.98, to),
            flag("also", 0.1, also),
            flag("orbit", 0.1, count()),
            flag("follow", 0.3, word(&["0", "1", "2", "101", "-1"])),
            flag("points", 0.9, word(&["2", "20", "100", "1", "x"])),
            switch("no-diagram", 0.05),
            switch("virtual", 0.05),
            outputs("csv"),
        ],
    )
}

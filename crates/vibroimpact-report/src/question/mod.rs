//! The same question in two other forms: as a command line, and as a call in Python.

mod arguments;
mod command;
mod python;
mod shell;

pub use command::command;
pub use python::{python, python_showing};
pub use shell::{quoted, shell_line, shell_line_figure, shell_line_showing};

/// The text of a number that reads back as the same double in Rust, Python and the shell.
fn number(x: f64) -> String {
    let text = format!("{x:?}");
    text.strip_suffix(".0").map_or(text.clone(), str::to_owned)
}

/// The numbers of a nondimensional oscillator by name.
fn numbers(system: &vibroimpact_study::SystemPlan) -> [(&'static str, Option<f64>); 7] {
    let second = system.second_stop;
    [
        ("beta", system.beta),
        ("inverse_beta", system.inverse_beta),
        ("gap", Some(system.gap)),
        ("restitution", Some(system.restitution)),
        ("damping", Some(system.damping).filter(|damping| damping.to_bits() != 0)),
        ("second_gap", second.map(|stop| stop.gap)),
        ("second_restitution", second.map(|stop| stop.restitution)),
    ]
}

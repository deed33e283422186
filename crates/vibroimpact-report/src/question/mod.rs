//! The same question in two other forms: as a command line, and as a call in Python.

mod body;
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

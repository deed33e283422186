//! SET: numbers of a machine that are changed by their paths.

use super::numbers::number;
use crate::failure::Failure;
use clap::Args;
use vibroimpact_study::machine::MachineSource;

/// Numbers of a machine that are changed.
#[derive(Clone, Debug, Default, Args)]
pub(crate) struct SetArgs {
    /// Another value of a number of the machine, by its path, such as stop.wall.gap=0.5; any number of times
    #[arg(long, value_parser = change, value_name = "PATH=VALUE", allow_hyphen_values = true)]
    set: Vec<(String, f64)>,
}

/// Reads a path and a value.
fn change(text: &str) -> Result<(String, f64), String> {
    let (path, value) = text.split_once('=').ok_or("a path and a value are needed, such as stop.wall.gap=0.5")?;
    Ok((path.trim().to_owned(), number(value.trim())?))
}

impl SetArgs {
    /// The machine with these numbers, in the order in which they are given.
    pub(crate) fn apply(&self, source: MachineSource) -> Result<MachineSource, Failure> {
        let mut source = source;
        for (path, value) in &self.set {
            source = source.with(path, *value)?;
        }
        Ok(source)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_and_a_value() {
        assert_eq!(change("a.b = -1e-3"), Ok(("a.b".to_owned(), -1e-3)));
        assert!(change("a.b").is_err_and(|why| why.contains("such as stop.wall.gap=0.5")));
        assert!(change("a.b=x").is_err_and(|why| why.contains("`x` is not a number")));
    }
}

//! SET: numbers of a machine that are changed by their paths.

use super::numbers::number;
use crate::failure::Failure;
use clap::Args;
use core::str::FromStr;
use vibroimpact_study::machine::MachineSource;

/// Numbers of a machine that are changed.
#[derive(Clone, Debug, Default, Args)]
pub(crate) struct SetArgs {
    /// Another value of a number of the machine, by its path, such as stop.wall.gap=0.5; any number of times
    #[arg(long, value_name = "PATH=VALUE", allow_hyphen_values = true)]
    set: Vec<Change>,
}

/// A path and a value.
#[derive(Clone, Debug, PartialEq)]
struct Change {
    path: String,
    value: f64,
}

impl FromStr for Change {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (path, value) = text.split_once('=').ok_or("a path and a value are needed, such as stop.wall.gap=0.5")?;
        Ok(Self { path: path.trim().to_owned(), value: number(value.trim())? })
    }
}

impl SetArgs {
    /// The machine with these numbers, in the order in which they are given.
    pub(crate) fn apply(&self, source: MachineSource) -> Result<MachineSource, Failure> {
        let mut source = source;
        for Change { path, value } in &self.set {
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
        assert_eq!("a.b = -1e-3".parse(), Ok(Change { path: "a.b".to_owned(), value: -1e-3 }));
        assert!("a.b".parse::<Change>().is_err_and(|why| why.contains("such as stop.wall.gap=0.5")));
        assert!("a.b=x".parse::<Change>().is_err_and(|why| why.contains("`x` is not a number")));
    }
}

//! `cargo xtask bench-peers`: vibroimpact and others on the same workloads, side by side, into `docs/performance.md`.
//!
//! Every number of that page comes from here. Each round runs each contender once, so that what else happens on the
//! machine falls on all of them.

mod accuracy;
mod contender;
mod machine;
mod notes;
mod page;
mod rates;
mod setup;
mod starts;

use std::fs;
use std::path::Path;

/// What to run, from the switches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Options {
    /// Rounds of all contenders.
    rounds: usize,
    /// Time for each contender, workload and round.
    seconds: f64,
    /// Starts for each row of the accuracy table.
    starts: usize,
    /// A look, which leaves the page of the repository alone.
    quick: bool,
}

impl Options {
    /// Reads `--rounds N`, `--seconds S` and `--quick`.
    ///
    /// # Errors
    /// The sentence that names what cannot be read.
    pub(crate) fn parse(switches: &[&str]) -> Result<Self, String> {
        let quick = switches.contains(&"--quick");
        let mut options = if quick {
            Self { rounds: 2, seconds: 0.2, starts: 30, quick }
        } else {
            Self { rounds: 5, seconds: 1.0, starts: 300, quick }
        };
        let mut rest = switches;
        while let [switch, after @ ..] = rest {
            rest = after;
            match (*switch, after) {
                ("--quick", _) => {}
                ("--rounds", [value, after @ ..]) => {
                    options.rounds = value
                        .parse()
                        .ok()
                        .filter(|n| (1..=1000).contains(n))
                        .ok_or_else(|| format!("--rounds = {value} is not a number of rounds, 1 to 1000"))?;
                    rest = after;
                }
                ("--seconds", [value, after @ ..]) => {
                    options.seconds = value
                        .parse()
                        .ok()
                        .filter(|s| (0.01..=600.0).contains(s))
                        .ok_or_else(|| format!("--seconds = {value} is not a time in seconds, 0.01 to 600"))?;
                    rest = after;
                }
                ("--rounds" | "--seconds", []) => return Err(format!("{switch} needs a number")),
                (other, _) => {
                    return Err(format!("`bench-peers` knows --rounds N, --seconds S and --quick, not `{other}`"));
                }
            }
        }
        Ok(options)
    }
}

/// Sets the contenders up, runs them and writes the page.
///
/// # Errors
/// The sentence that says what cannot be set up, or which contender failed.
pub(crate) fn run(root: &Path, options: Options) -> Result<String, String> {
    let workshop = setup::prepare(root)?;
    let contenders = contender::all(&workshop);
    let machine = machine::describe(root, &workshop);
    let rates = rates::measure(&contenders, options)?;
    let accuracy = accuracy::judge(&workshop, &contenders, options.starts)?;
    let text = page::write(&page::Findings { options, machine: &machine, rates: &rates, accuracy: &accuracy });

    let path = if options.quick { workshop.folder.join("performance.md") } else { root.join("docs/performance.md") };
    fs::write(&path, text).map_err(|error| format!("{} cannot be written: {error}", path.display()))?;
    let missing: Vec<_> = rates.missing.iter().map(|why| format!("\n{why}")).collect();
    Ok(format!("{} written{}", path.display(), missing.concat()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn switches_are_read_in_any_order() {
        let plain = Options::parse(&[]).unwrap();
        assert_eq!((plain.rounds, plain.starts, plain.quick), (5, 300, false));
        let asked = Options::parse(&["--seconds", "0.5", "--quick", "--rounds", "7"]).unwrap();
        assert_eq!(asked, Options { rounds: 7, seconds: 0.5, starts: 30, quick: true });
    }

    #[test]
    fn what_cannot_be_read_is_named() {
        let refusal = |switches: &[&str]| Options::parse(switches).unwrap_err();
        assert!(refusal(&["--rounds", "0"]).contains("--rounds = 0"));
        assert!(refusal(&["--seconds", "NaN"]).contains("--seconds = NaN"));
        assert!(refusal(&["--rounds"]).contains("--rounds needs a number"));
        assert!(refusal(&["--fast"]).contains("`--fast`"));
    }
}

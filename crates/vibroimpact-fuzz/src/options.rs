//! The options of the driver: `--seconds N --seed S`, and how to run one case again.

use crate::Family;
use std::path::PathBuf;

/// The usage text of the program.
pub const USAGE: &str = "\
usage: cargo xtask fuzz [--seconds N] [--seed S] [--only FAMILY] [--cases N] [--case K]

  --seconds N    about how long, 1 to 86400; 60 by default
  --seed S       which cases; drawn from the clock and printed by default
  --only FAMILY  one family: commands, plans, stores, page, verdicts or machines
  --cases N      at most N cases of each family
  --case K       case K alone, with --seed and --only as a fault was printed
  --jobs N       workers at a time; one per processor by default
  --vibro FILE   the command to test; the one built beside this program by default
";

/// The options, checked.
#[derive(Clone, Debug, PartialEq)]
pub struct FuzzOptions {
    /// Wall time in seconds.
    pub seconds: f64,
    /// Seed of the cases; `None` to take one from the clock.
    pub seed: Option<u64>,
    /// The only family to run; `None` for all.
    pub only: Option<Family>,
    /// Maximum number of cases of each family.
    pub cases: Option<u64>,
    /// The only case to run.
    pub case: Option<u64>,
    /// Number of simultaneous workers; 0 for one per processor.
    pub jobs: usize,
    /// The command to test.
    pub vibro: Option<PathBuf>,
}

impl Default for FuzzOptions {
    fn default() -> Self {
        Self { seconds: 60.0, seed: None, only: None, cases: None, case: None, jobs: 0, vibro: None }
    }
}

impl FuzzOptions {
    /// Parses the words after `fuzz`.
    ///
    /// # Errors
    /// A message that names the invalid word.
    pub fn parse(words: &[String]) -> Result<Self, String> {
        let mut options = Self::default();
        let mut words = words.iter();
        while let Some(word) = words.next() {
            let value = words.next().ok_or_else(|| format!("`{word}` needs a value"))?;
            let whole =
                || value.parse::<u64>().map_err(|_| format!("{word} `{value}` is not a whole number, 0 or more"));
            match word.as_str() {
                "--seconds" => {
                    let seconds = value.parse().ok().filter(|s| (1.0..=86_400.0).contains(s));
                    options.seconds = seconds.ok_or_else(|| format!("seconds = {value} lies outside 1 to 86400"))?;
                }
                "--seed" => options.seed = Some(whole()?),
                "--cases" => options.cases = Some(whole()?),
                "--case" => options.case = Some(whole()?),
                "--jobs" => options.jobs = usize::try_from(whole()?).unwrap_or(0),
                "--vibro" => options.vibro = Some(value.into()),
                "--only" => {
                    let known = Family::ALL.map(Family::name).join(", ");
                    let family = Family::named(value);
                    options.only =
                        Some(family.ok_or_else(|| format!("there is no family `{value}`; there are {known}"))?);
                }
                other => return Err(format!("`fuzz` has no option `{other}`")),
            }
        }
        if options.case.is_some() && (options.only.is_none() || options.seed.is_none()) {
            return Err("--case needs --only and --seed, as they were printed with the fault".to_owned());
        }
        Ok(options)
    }

    /// The families to run.
    #[must_use]
    pub fn families(&self) -> Vec<Family> {
        self.only.map_or_else(|| Family::ALL.to_vec(), |family| vec![family])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(line: &str) -> Result<FuzzOptions, String> {
        FuzzOptions::parse(&line.split_whitespace().map(str::to_owned).collect::<Vec<_>>())
    }

    #[test]
    fn words_are_read_and_nonsense_is_named() {
        assert_eq!(parse(""), Ok(FuzzOptions::default()));
        let one = parse("--seed 7 --only plans --case 12").unwrap();
        assert_eq!((one.seed, one.only, one.case), (Some(7), Some(Family::Plans), Some(12)));
        for (line, sentence) in [
            ("--seconds 0", "lies outside"),
            ("--seconds nan", "lies outside"),
            ("--seed -1", "whole number"),
            ("--seed", "needs a value"),
            ("--only everything", "there is no family `everything`"),
            ("--quick 1", "no option `--quick`"),
            ("--case 3", "--case needs"),
        ] {
            let refused = parse(line).unwrap_err();
            assert!(refused.contains(sentence), "{line}: {refused}");
        }
    }
}

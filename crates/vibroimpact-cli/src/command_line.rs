//! A command line that the parser refuses: all that is missing is named at once, and flags without their dashes are recognised.

use crate::args::flags;
use crate::failure::Failure;
use clap::ArgMatches;
use clap::builder::StyledStr;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::parser::ValueSource;

/// Commands of one system, whose parameters the parser does not require, because there are two forms of a system.
const OF_ONE_SYSTEM: [&str; 7] = ["attractors", "basin", "orbit", "branch", "curve", "diagram", "region"];
/// Commands in which at least one parameter has a range.
const OF_RANGES: [&str; 2] = ["map", "response"];
/// Short names of numbers of a body that may have a range there, besides the names of parameters.
const SHORT: [&str; 3] = ["mass", "stiffness", "frequency"];

/// Flags any one of which gives a quantity, and how the parser writes them.
type Needed = (&'static [&'static str], &'static str);

const NONDIMENSIONAL: [Needed; 3] = [
    (&["--beta", "--inverse-beta"], "<--beta <B>|--inverse-beta <X>>"),
    (&["--gap"], "--gap <D>"),
    (&["--restitution"], "--restitution <E>"),
];

const MACHINE: [Needed; 6] = [
    (&["--mass-kg", "--mass"], "--mass-kg <M>"),
    (&["--stiffness-n-per-m", "--stiffness"], "--stiffness-n-per-m <K>"),
    (
        &[
            "--force-n",
            "--base-displacement-m",
            "--base-velocity-m-per-s",
            "--base-acceleration-m-per-s2",
            "--stop-displacement-m",
            "--unbalance-kg-m",
        ],
        "--force-n <F>",
    ),
    (&["--frequency-hz", "--frequency", "--omega-rad-per-s", "--omega"], "--frequency-hz <HZ>"),
    (&["--gap-m", "--gaps-m", "--gap"], "--gap-m <D>"),
    (&["--restitution"], "--restitution <E>"),
];

/// Flags that do not tell the two forms of a system apart.
const OF_BOTH: [&str; 2] = ["--restitution", "--gap"];

/// The same error, with everything that is missing, or with a tip on dashes. `words` are those of the command line.
pub(crate) fn explained(mut error: clap::Error, words: &[String]) -> clap::Error {
    match (error.kind(), error.get(ContextKind::InvalidArg)) {
        (ErrorKind::MissingRequiredArgument, Some(ContextValue::Strings(named))) => {
            let all = [named.clone(), lacking(words, named)].concat();
            error.insert(ContextKind::InvalidArg, ContextValue::Strings(all));
        }
        (ErrorKind::UnknownArgument, Some(ContextValue::String(word))) => {
            if let Some(tip) = dashed(word, words).or_else(|| after_force(word, words)) {
                error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![StyledStr::from(tip)]));
            }
        }
        (ErrorKind::InvalidValue, _) => {
            if let (Some(ContextValue::String(given)), Some(ContextValue::Strings(known))) =
                (error.get(ContextKind::InvalidValue), error.get(ContextKind::ValidValue))
                && let Some(same) = known.iter().find(|name| name.eq_ignore_ascii_case(given)).cloned()
            {
                error.insert(ContextKind::SuggestedValue, ContextValue::String(same));
            }
        }
        _ => {}
    }
    error
}

/// Flags of an oscillator that are no parameters, and those of its start but the phase, which a machine has too.
const OF_AN_OSCILLATOR: [&str; 8] =
    ["log-decrement", "omega-rad-per-s", "base-phase", "stop-in-space", "stop-phase", "x", "v", "units"];

/// Refuses flags that would have no effect: those of an oscillator beside a machine, and those of a machine without one.
pub(crate) fn without_effect(command: &ArgMatches) -> Result<(), Failure> {
    let typed = |id: &str| command.value_source(id) == Some(ValueSource::CommandLine);
    let given: Vec<String> =
        command.ids().map(clap::Id::as_str).filter(|id| typed(id)).map(|id| id.replace('_', "-")).collect();
    let has = |flag: &str| given.iter().any(|given| given == flag);
    let of_oscillator = || flags().chain(OF_AN_OSCILLATOR);
    if has("machine") {
        if let Some(flag) = of_oscillator().find(|flag| has(flag)) {
            return Err(Failure::bad(format!(
                "--{flag} is of an oscillator and has no effect with --machine\nhint: {}",
                instead(flag)
            )));
        }
    } else if has("set") && of_oscillator().any(has) {
        return Err(Failure::bad(
            "--set has no effect without --machine\nhint: an oscillator has a flag for each number",
        ));
    }
    Ok(())
}

/// What stands for a flag of an oscillator where there is a machine.
fn instead(flag: &str) -> &'static str {
    match flag {
        "x" | "v" => "--q and --qdot have a value for each coordinate",
        "units" => "results are in the units of the machine",
        _ => "--set PATH=VALUE; `vibro machine show NAME` lists the paths",
    }
}

/// What a command needs besides the flags that are named already.
fn lacking(words: &[String], named: &[String]) -> Vec<String> {
    let known = |word: &&String| OF_ONE_SYSTEM.iter().chain(&OF_RANGES).any(|name| name == word);
    let Some(command) = words.iter().find(known).map(String::as_str) else { return Vec::new() };
    let ranges = OF_RANGES.contains(&command) && value(words, "--axis").is_none();
    // a machine brings its numbers
    if value(words, "--machine").is_some() {
        return if ranges { vec!["--axis <PATH=A:B:N>".to_owned()] } else { Vec::new() };
    }
    let varied: Vec<String> =
        ["--vary", "--also"].iter().filter_map(|flag| value(words, flag)).map(varied_flag).collect();
    // without --vary it is not known which parameter is left out
    if command == "diagram" && varied.is_empty() {
        return Vec::new();
    }
    let axes: Vec<String> = values(words, "--axis").map(varied_flag).collect();
    let varies = |flag: &&str| axes.iter().chain(varied.iter().filter(|_| command == "diagram")).any(|v| v == flag);
    let given = |flag: &&str| value(words, flag).is_some() || varies(flag);
    let machine = MACHINE.iter().flat_map(|(flags, _)| *flags).any(|flag| !OF_BOTH.contains(flag) && given(flag));
    let needed: &[Needed] = if machine { &MACHINE } else { &NONDIMENSIONAL };
    let open = |(flags, _): &&Needed| {
        !flags.iter().any(given) && !named.iter().any(|text| flags.iter().any(|flag| text.contains(flag)))
    };
    let mut all: Vec<String> = needed.iter().filter(open).map(|(_, text)| (*text).to_owned()).collect();
    let ranged = |flag: &str| value(words, &format!("--{flag}")).is_some_and(|text| text.contains([':', ',']));
    let mut varying = flags().chain(SHORT);
    if ranges && !varying.any(ranged) {
        all.push("a range A:B:N instead of one of the values".to_owned());
    }
    all
}

/// The value of a flag.
fn value<'a>(words: &'a [String], flag: &str) -> Option<&'a str> {
    values(words, flag).next()
}

/// The values of a flag that can be repeated.
fn values<'a>(words: &'a [String], flag: &str) -> impl Iterator<Item = &'a str> {
    words.iter().enumerate().filter_map(move |(k, word)| {
        let rest = word.strip_prefix(flag)?;
        if rest.is_empty() { Some(words.get(k + 1).map_or("", String::as_str)) } else { rest.strip_prefix('=') }
    })
}

/// The flag of the number in the value of a flag that varies it, as in `--axis gap=0:1:3`.
fn varied_flag(text: &str) -> String {
    format!("--{}", text.split('=').next().unwrap_or(text).replace('_', "-"))
}

/// The tip for a flag with another number of dashes: `-beta`, `gap=1`, or with the long dash of typeset text.
fn dashed(unknown: &str, words: &[String]) -> Option<String> {
    let word = words.iter().find(|word| word.starts_with(unknown))?;
    let name = word.trim_start_matches(['-', '\u{2013}', '\u{2014}', '\u{2212}']);
    let long = name.len() > 1 && name.starts_with(|c: char| c.is_ascii_alphabetic());
    let wrong = !word.starts_with("--") && (name.len() < word.len() || word.contains('='));
    (long && wrong).then(|| format!("flags begin with two dashes: '--{name}'"))
}

/// The tip for a force that was given to `--force`, which replaces files and takes no value.
fn after_force(unknown: &str, words: &[String]) -> Option<String> {
    let given = words.windows(2).any(|pair| pair[0] == "--force" && pair[1] == unknown);
    let number = unknown.starts_with(|c: char| c.is_ascii_digit() || c == '.');
    (given && number).then(|| format!("the force of a body is '--force-n {unknown}'; '--force' replaces files"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(line: &str) -> Vec<String> {
        line.split_whitespace().map(str::to_owned).collect()
    }

    #[test]
    fn all_that_is_missing() {
        let lacks = |line: &str, named: &[&str]| {
            lacking(&words(line), &named.iter().map(|text| (*text).to_owned()).collect::<Vec<_>>())
        };
        let system = ["<--beta <B>|--inverse-beta <X>>", "--gap <D>", "--restitution <E>"];
        assert_eq!(lacks("vibro basin", &["--x <A:B:N>"]), system);
        assert_eq!(lacks("vibro --quiet orbit --beta=1", &["--label <m/n>"]), system[1..]);
        assert_eq!(lacks("vibro region --gap 1", &["--restitution <E>"]), system[..1]);
        assert_eq!(lacks("vibro diagram --vary inverse-beta", &["--over <A:B:N>"]), system[1..]);
        assert_eq!(lacks("vibro diagram --gap 1", &["--vary <PARAMETER>"]), [""; 0]);
        assert_eq!(lacks("vibro branch --vary gap --beta 1", &["--label <m/n>"]), system[1..]);
        assert_eq!(
            lacks("vibro attractors --mass-kg 1 --unbalance-kg-m 1 --gap-m 1", &["--starts <N>"]),
            ["--stiffness-n-per-m <K>", "--frequency-hz <HZ>", "--restitution <E>"]
        );
        let range = "a range A:B:N instead of one of the values";
        assert_eq!(lacks("vibro map --beta 1 --gap 1 --restitution 0.5", &["--starts <N>"]), [range]);
        assert_eq!(lacks("vibro map --beta 1 --gap 0:1:3 --restitution 0.5", &["--starts <N>"]), [""; 0]);
        assert_eq!(lacks("vibro map --restitution 0.5 --beta 1 --axis gap=0:1:3", &["--starts <N>"]), [""; 0]);
        assert_eq!(lacks("vibro map --machine chain", &["--starts <N>"]), ["--axis <PATH=A:B:N>"]);
        assert_eq!(lacks("vibro map --machine chain --axis frequency=1:2:3", &["--starts <N>"]), [""; 0]);
        assert_eq!(lacks("vibro basin --machine=chain", &["--label <m/n>"]), [""; 0]);
        assert_eq!(lacks("vibro run", &["<PLAN>"]), [""; 0]);
    }

    #[test]
    fn dashes() {
        let tip = |unknown: &str, line: &str| dashed(unknown, &words(line));
        assert_eq!(tip("-b", "vibro settle -beta 1").as_deref(), Some("flags begin with two dashes: '--beta'"));
        assert_eq!(tip("gap=1", "vibro settle gap=1").as_deref(), Some("flags begin with two dashes: '--gap=1'"));
        assert_eq!(tip("\u{2014}gap", "vibro \u{2014}gap 1").as_deref(), Some("flags begin with two dashes: '--gap'"));
        for (unknown, line) in
            [("--betta", "vibro settle --betta 1"), ("-b", "vibro settle -b 1"), ("1", "vibro settle 1")]
        {
            assert_eq!(tip(unknown, line), None, "{line}");
        }
    }

    #[test]
    fn a_force_that_is_no_flag() {
        let tip = |unknown: &str, line: &str| after_force(unknown, &words(line));
        let found = tip("30N", "vibro attractors --force 30N --gap 1");
        assert_eq!(found.as_deref(), Some("the force of a body is '--force-n 30N'; '--force' replaces files"));
        assert_eq!(tip("x", "vibro attractors --force x"), None);
        assert_eq!(tip("30", "vibro attractors --gap 1 30"), None);
    }
}

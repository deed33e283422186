//! `vibro`: vibro-impact dynamics on the command line. The program and the Python package both call [`run`].
//!
//! Every command has the same steps: parse (text to arguments), plan (arguments to a checked plan), run (plan to
//! results), report (results to stdout and files). Data go to stdout, everything else to stderr.

mod args;
mod command_line;
mod commands;
mod exit;
mod failure;
mod files;
mod help;
mod hints;
mod machine_file;
mod measure;
mod picture;
mod points_file;
mod program;
mod progress;
mod report;
mod session;
mod signal;
mod state_file;
mod unit_table;
mod units_typed;

use clap::{ArgMatches, CommandFactory, FromArgMatches};
use std::ffi::OsString;
use std::path::PathBuf;

/// The parser of command lines, with all commands and their options.
#[must_use]
pub fn parser() -> clap::Command {
    commands::CommandLine::command()
}

/// Runs a command line, whose first word is the name of the program, and returns the exit code. `program` is the file to
/// name in scripts that run the command again; that of this process when absent.
///
/// It installs handlers for Ctrl-C and for defects of the program, so it is called once in a process.
#[must_use]
pub fn run(words: &[OsString], program: Option<PathBuf>) -> u8 {
    exit::no_backtraces();
    program::remember(program);
    // the help is rearranged only where it is asked for, because this takes longer than a short question
    let helps = words.iter().any(|word| word == "-h" || word == "--help");
    // what the parser of the named command alone refuses is explained by the parser of all
    let named = words.get(1).filter(|_| !helps).and_then(|word| commands::alone(word.to_str()?));
    let parsed = named.and_then(|command| command.try_get_matches_from(words).ok()).map_or_else(
        || {
            let all = parser();
            if helps { help::shown(all) } else { all }.try_get_matches_from(words)
        },
        Ok,
    );
    let read = |found: ArgMatches| Ok((commands::CommandLine::from_arg_matches(&found)?, found));
    let (line, found) = match parsed.and_then(read) {
        Ok(read) => read,
        Err(refusal) => {
            let words: Vec<String> = words.iter().map(|word| word.to_string_lossy().into_owned()).collect();
            return exit::parsed(&command_line::explained(refusal, &words));
        }
    };
    if let Some((_, command)) = found.subcommand()
        && let Err(refusal) = command_line::without_effect(command)
    {
        return exit::code(Err(refusal));
    }
    signal::listen();
    let session = session::Session::new(line.globals);
    exit::code(commands::run(&line, &session))
}

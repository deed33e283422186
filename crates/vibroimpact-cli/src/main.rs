//! `vibro`: vibro-impact dynamics on the command line.
//!
//! Every command has the same steps: parse (text to arguments), plan (arguments to a checked plan), run (plan to
//! results), report (results to stdout and files). Data go to stdout, everything else to stderr.

mod args;
mod command_line;
mod commands;
mod complain;
mod exit;
mod failure;
mod files;
mod hints;
mod machine_file;
mod measure;
mod picture;
mod progress;
mod report;
mod session;
mod signal;
mod unit_table;
mod units_typed;

use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    exit::no_backtraces();
    let line = match commands::CommandLine::try_parse() {
        Ok(line) => line,
        Err(refusal) => {
            let words: Vec<String> = std::env::args_os().map(|word| word.to_string_lossy().into_owned()).collect();
            return exit::parsed(&command_line::explained(refusal, &words));
        }
    };
    signal::listen();
    let session = session::Session::new(line.globals);
    exit::code(commands::run(&line, &session))
}

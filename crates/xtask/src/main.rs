//! `cargo xtask`: the tasks of a developer of this repository, one file for each command.
//!
//! The arguments are a few words and switches, so they are parsed without a library. The command then builds within
//! seconds in a fresh checkout.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a program for the terminal: printing is what it is for")]

mod command;
mod cost;
mod docs;
mod examples;
mod explorer;
mod figures;
mod fuzz;
mod licences;
mod python;
mod release;
mod s3;
mod test;
mod tools;
mod totals;
mod venv;
mod wasm;
mod words;

use std::process::ExitCode;

const USAGE: &str = "\
usage: cargo xtask COMMAND

  test [--fast] [--long]  every check of every language; ends with `N passed, M failed`
                          --fast  format, lints and tests only
                          --long  the long-running tests too (VIBROIMPACT_LONG=1)
  docs                    the API documentation, with formulas, in target/doc
  figures                 the pictures of the README, by `vibro reproduce`
  line                    the table and the figure of docs/orbits.md
  python                  the Python package for its tests, into target/python
  licences                the licence of every dependency against the allow-list
  words                   links in the Markdown files, and spelling, by lychee and typos
  explorer                the explorer's page in a browser, against the server
  fuzz [--seconds N] [--seed S]
                          random and adversarial questions to the command, plans, stores and the page; a minute
                          by default; `cargo xtask fuzz --help` lists all options
  wasm                    whether the core, plans, plots and reports compile for WebAssembly
  examples                runs the examples of the core
  cost [PACKAGE]          what a cold release build costs, by package: processor time, and bytes in the program;
                          vibroimpact-cli by default
  release                 whether the crates compile with the oldest Rust they name, and all packages build
  s3                      studies in buckets, against a server that it installs in target/s3-venv
";

/// Exit status for invalid arguments, as in `vibro`.
const BAD_QUESTION: u8 = 2;

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    if let Some(compiled) = cost::compile(&words) {
        return compiled;
    }
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let root = command::root();
    match words.as_slice() {
        ["test", switches @ ..] => match test::Options::parse(switches) {
            Ok(options) => test::run(&root, options),
            Err(sentence) => bad_question(&sentence),
        },
        ["docs"] => finish(docs::build(&root)),
        ["figures"] => finish(figures::draw(&root)),
        ["line"] => finish(figures::line(&root)),
        ["python"] => finish(python::install(&root)),
        ["licences"] => finish(licences::check(&root)),
        ["words"] => finish(words::check(&root)),
        ["fuzz", words @ ..] => fuzz::run(&root, words),
        ["explorer"] => finish(explorer::test(&root)),
        ["s3"] => finish(s3::test(&root)),
        ["wasm"] => finish(wasm::check(&root)),
        ["release"] => finish(release::check(&root)),
        ["cost"] => finish(cost::print(&root, "vibroimpact-cli")),
        ["cost", package] => finish(cost::print(&root, package)),
        ["examples"] => finish(examples::run(&root)),
        ["help" | "--help" | "-h"] => {
            print!("{USAGE}");
            ExitCode::SUCCESS
        }
        [] => bad_question("no command is given"),
        other => bad_question(&format!("`{}` is not a command of xtask", other.join(" "))),
    }
}

/// Prints the result of a check, and converts it to an exit status.
fn finish(outcome: Result<String, String>) -> ExitCode {
    match outcome {
        Ok(sentence) => {
            println!("{sentence}");
            ExitCode::SUCCESS
        }
        Err(sentence) => {
            eprintln!("{sentence}");
            ExitCode::FAILURE
        }
    }
}

fn bad_question(sentence: &str) -> ExitCode {
    eprintln!("{sentence}\n\n{USAGE}");
    ExitCode::from(BAD_QUESTION)
}

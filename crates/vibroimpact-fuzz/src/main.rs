//! The program behind `cargo xtask fuzz`: the driver, or with the word `worker` one of its workers.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a program for the terminal: printing is what it is for")]

use std::io;
use std::process::ExitCode;
use vibroimpact_fuzz::worker::{self, Job};
use vibroimpact_fuzz::{FuzzOptions, driver, options};

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    if let [first, rest @ ..] = words.as_slice()
        && first == "worker"
    {
        return Job::parse(rest)
            .map_or(ExitCode::from(2), |task| done(worker::work(&task, &mut io::stdout()).map(|()| true)));
    }
    if words.iter().any(|word| matches!(word.as_str(), "--help" | "-h")) {
        print!("{}", options::USAGE);
        return ExitCode::SUCCESS;
    }
    match FuzzOptions::parse(&words) {
        Ok(options) => {
            let say = |line: &str| println!("{line}");
            done(std::env::current_exe().and_then(|program| driver::run(&options, &program, &say)))
        }
        Err(sentence) => {
            eprintln!("{sentence}\n\n{}", options::USAGE);
            ExitCode::from(2)
        }
    }
}

fn done(outcome: io::Result<bool>) -> ExitCode {
    match outcome {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

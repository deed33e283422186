//! The program behind `cargo xtask fuzz`: the driver, or with the word `worker` one of its workers.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a program for the terminal: printing is what it is for")]

use clap::Parser;
use std::io;
use std::process::ExitCode;
use vibroimpact_fuzz::options::Worker;
use vibroimpact_fuzz::{FuzzOptions, driver, worker};

fn main() -> ExitCode {
    let options = FuzzOptions::parse();
    let outcome = match &options.worker {
        Some(Worker::Worker(task)) => worker::work(task, &mut io::stdout()).map(|()| true),
        None => {
            let say = |line: &str| println!("{line}");
            std::env::current_exe().and_then(|program| driver::run(&options, &program, &say))
        }
    };
    match outcome {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

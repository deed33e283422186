//! The program of the paper: what `vibro reproduce` does, built in less than half the time because it needs nothing else.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a program for the terminal")]

use fukaya_irie_1971::{ReproductionOptions, reproduce};
use std::path::PathBuf;
use std::process::ExitCode;
use vibroimpact_study::Control;

const USAGE: &str = "\
Compute the figures of the 1971 paper and compare them with the paper

usage: cargo run --release -p fukaya-irie-1971 -- [--quick] [--out DIR] [--force]

  --quick    coarser grids and fewer starts: seconds instead of minutes
  --out DIR  folder to write into, out/fukaya-irie-1971 by default; made if it does not exist
  --force    write into a folder with other files

`vibro reproduce` is the same with a progress bar.
";

/// The folder and the options of a run.
type Request = (PathBuf, ReproductionOptions);

/// The request of these arguments; `None` if help is wanted.
fn parse(mut words: impl Iterator<Item = String>) -> Result<Option<Request>, String> {
    let (mut out, mut options) = (PathBuf::from("out/fukaya-irie-1971"), ReproductionOptions::default());
    while let Some(word) = words.next() {
        match word.as_str() {
            "--quick" => options.quick = true,
            "--force" => options.force = true,
            "--out" => out = words.next().ok_or("--out needs the name of a folder")?.into(),
            "--help" | "-h" | "help" => return Ok(None),
            // the word with which `vibro` does the same
            "reproduce" => {}
            other => return Err(format!("`{other}` is not an option")),
        }
    }
    Ok(Some((out, options)))
}

fn main() -> ExitCode {
    let (out, options) = match parse(std::env::args().skip(1)) {
        Ok(Some(request)) => request,
        Ok(None) => {
            print!("{USAGE}");
            return ExitCode::SUCCESS;
        }
        Err(sentence) => {
            eprintln!("error: {sentence}\n\n{USAGE}");
            return ExitCode::from(2);
        }
    };
    let stage = |name: &str, points: u64| match points {
        0 => eprintln!("{name}"),
        _ => eprintln!("{name}: {points} points"),
    };
    match reproduce(&out, &options, &Control::default(), &stage) {
        Ok(report) => {
            print!("{}", report.table());
            eprintln!("wrote {}", out.display());
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(if error.is_bad_question() { 2 } else { 1 })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arguments_are_read() {
        let parse = |line: &str| parse(line.split_whitespace().map(str::to_owned));
        let quick = ReproductionOptions { quick: true, force: false };
        assert_eq!(parse("reproduce --quick --out a"), Ok(Some((PathBuf::from("a"), quick))));
        assert_eq!(parse("--help"), Ok(None));
        assert!(parse("--out").is_err_and(|why| why.contains("--out needs")));
        assert!(parse("--fast").is_err_and(|why| why.contains("`--fast`")));
    }
}

//! Reproduces the paper into the given folder: `cargo run --release -p fukaya-irie-1971 --example run -- OUT
//! [--quick]`.
#![allow(clippy::print_stdout, clippy::print_stderr)] // an example talks to the terminal

use fukaya_irie_1971::{Error, ReproductionOptions, reproduce};
use std::path::Path;
use std::time::Instant;
use vibroimpact_study::Control;

fn main() -> Result<(), Error> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let out = arguments.first().map_or("reproduction", String::as_str);
    let options = ReproductionOptions { quick: arguments.iter().any(|a| a == "--quick"), force: false };
    let begin = Instant::now();
    let stage = |name: &str, points: u64| {
        eprintln!("{:6.1} s  {name} ({points})", begin.elapsed().as_secs_f64());
    };
    let report = reproduce(Path::new(out), &options, &Control::default(), &stage)?;
    eprintln!("{:6.1} s  done", begin.elapsed().as_secs_f64());
    println!("{}", report.table());
    Ok(())
}

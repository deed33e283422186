//! The program `vibro`.

use std::ffi::OsString;
use std::process::ExitCode;

/// Many small vectors are allocated for each event of a machine.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> ExitCode {
    let words: Vec<OsString> = std::env::args_os().collect();
    ExitCode::from(vibroimpact_cli::run(&words, None))
}

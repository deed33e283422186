//! `vibro completions SHELL`.

use crate::commands::CommandLine;
use crate::failure::Failure;
use crate::session::Session;
use clap::{Args, CommandFactory};
use clap_complete::Shell;

/// Print a completion script for your shell
#[derive(Clone, Copy, Debug, Args)]
#[command(after_help = "Example:\n  vibro completions bash > ~/.local/share/bash-completion/completions/vibro")]
pub(crate) struct Completions {
    /// The shell
    shell: Shell,
}

pub(super) fn run(args: &Completions, session: &Session) -> Result<(), Failure> {
    let mut command = CommandLine::command();
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut command, "vibro", &mut script);
    session.to_stdout(|out| out.write_all(&script))
}

//! The command line. Groups that several commands share are here; what belongs to one command is in its file.

mod axes;
mod output;
mod plane;
mod ranged;
mod start;
mod store;
mod system;
mod vary;

pub(crate) use axes::AxesArgs;
pub(crate) use output::Globals;
pub(crate) use plane::{Ends, Named, Over, Place};
pub(crate) use ranged::Ranged;
pub(crate) use start::StartArgs;
pub(crate) use store::{StoreArgs, Tiles};
pub(crate) use system::{Convention, MachineArgs, SystemArgs};
pub(crate) use vary::parameter;

use crate::commands::Command;
use clap::Parser;

/// Vibro-impact dynamics: what an oscillator that strikes a stop does, settles into, and from where.
///
/// The oscillator is x'' + 2 zeta x' + x = sin(beta t + phase) with a stop at x = gap: an arrival with velocity u leaves with
/// -eps u. Lengths are in units of the static deflection F/k, times in units of 1/omega_n, phases in radians.
#[derive(Debug, Parser)]
#[command(
    name = "vibro",
    version,
    arg_required_else_help = true,
    propagate_version = true,
    after_help = "Examples:\n  \
        vibro settle --inverse-beta 1.8 --gap 0.25 --restitution 0.5\n  \
        vibro attractors --inverse-beta 1.3 --gap 0.75 --restitution 0.5 --starts 500\n  \
        vibro basin --inverse-beta 1.3 --gap 0.75 --restitution 0.5 --x -4:0.75:300 --v -4:4:300 --plot basin.png\n\n\
        Exit codes: 0 done, 1 failed, 2 the question makes no sense, 130 stopped by Ctrl-C.\n\
        Data goes to stdout, everything else to stderr. `vibro COMMAND --help` explains each command."
)]
pub(crate) struct CommandLine {
    #[command(flatten)]
    pub(crate) globals: Globals,
    #[command(subcommand)]
    pub(crate) command: Command,
}

//! The command line and its commands. The file of a command has its arguments, plan, run and report.

mod attractors;
mod basin;
mod bench;
mod branch;
mod completions;
mod contact;
mod curve;
mod diagram;
mod edge;
mod estimate;
mod explore;
mod export;
mod help;
mod lyapunov;
mod machine;
mod man;
mod map;
mod margins;
mod orbit;
mod outputs;
mod plot;
mod region;
#[cfg(feature = "reproduce")]
mod reproduce;
mod respond;
mod response;
mod resume;
mod run;
mod schema;
mod settle;
mod settle_many;
mod simulate;
mod slurm;
mod status;
mod stored;
mod verify;

use crate::args::Globals;
use crate::failure::Failure;
use crate::session::Session;
use clap::{Args, Parser, Subcommand};

/// Vibro-impact dynamics: what an oscillator that strikes a stop does, settles into, and from where.
///
/// The oscillator is x'' + 2 zeta x' + x = sin(beta t + phase) with a stop at x = gap: an arrival with velocity u leaves with
/// -eps u. Lengths are in units of the static deflection F/k, times in units of 1/omega_n, phases in radians.
#[derive(Debug, Parser)]
#[command(
    name = "vibro",
    version,
    arg_required_else_help = true,
    disable_help_subcommand = true,
    propagate_version = true,
    after_help = "Examples:\n  \
        vibro settle --inverse-beta 1.8 --gap 0.25 --restitution 0.5\n  \
        vibro attractors --inverse-beta 1.3 --gap 0.75 --restitution 0.5 --starts 500\n  \
        vibro basin --inverse-beta 1.3 --gap 0.75 --restitution 0.5 \\\n    \
        --x -4:0.75:300 --v -4:4:300 --plot basin.png\n\n\
        Topics: vibro help system, figure, store, units, quantities or machines\n\n\
        Exit codes: 0 done, 1 failed, 2 the question makes no sense, 130 stopped by Ctrl-C or a spent budget.\n\
        Data goes to stdout, everything else to stderr. `vibro COMMAND --help` explains each command."
)]
pub(crate) struct CommandLine {
    #[command(flatten)]
    pub(crate) globals: Globals,
    #[command(subcommand)]
    command: Command,
}

/// The commands from one list: their arguments, what runs them, and the parser of one of them alone.
macro_rules! commands {
    ($($(#[$when:meta])* $name:ident($word:literal, $module:ident::$args:ident),)*) => {
        #[derive(Debug, Subcommand)]
        enum Command {
            $($(#[$when])* #[command(name = $word)] $name($module::$args),)*
        }

        /// Runs the command of a command line.
        pub(crate) fn run(line: &CommandLine, session: &Session) -> Result<(), Failure> {
            match &line.command {
                $($(#[$when])* Command::$name(args) => $module::run(args, session),)*
            }
        }

        /// The parser of a command line with one command, which is named so. To make the arguments of all commands takes longer
        /// than a short question.
        pub(crate) fn alone(word: &str) -> Option<clap::Command> {
            let named = match word {
                $($(#[$when])* $word => $module::$args::augment_args(clap::Command::new($word)),)*
                _ => return None,
            };
            // `help` is a command of this list
            let line = clap::Command::new("vibro").disable_help_subcommand(true);
            Some(Globals::augment_args(line).subcommand(named))
        }
    };
}

commands! {
    Simulate("simulate", simulate::Simulate),
    Settle("settle", settle::Settle),
    SettleMany("settle-many", settle_many::SettleMany),
    Attractors("attractors", attractors::Attractors),
    Orbit("orbit", orbit::Orbit),
    Branch("branch", branch::Branch),
    Curve("curve", curve::Curve),
    Region("region", region::Region),
    Response("response", response::Response),
    Margins("margins", margins::Margins),
    Contact("contact", contact::Contact),
    Edge("edge", edge::Edge),
    Machine("machine", machine::MachineCommand),
    Basin("basin", basin::Basin),
    Map("map", map::Map),
    Diagram("diagram", diagram::Diagram),
    Lyapunov("lyapunov", lyapunov::Lyapunov),
    Explore("explore", explore::Explore),
    Estimate("estimate", estimate::Estimate),
    Run("run", run::Run),
    Resume("resume", resume::Resume),
    Status("status", status::Status),
    Verify("verify", verify::Verify),
    Export("export", export::Export),
    Plot("plot", plot::Plot),
    Slurm("slurm", slurm::Slurm),
    Schema("schema", schema::Schema),
    Bench("bench", bench::Bench),
    #[cfg(feature = "reproduce")]
    Reproduce("reproduce", reproduce::Reproduce),
    Completions("completions", completions::Completions),
    Man("man", man::Man),
    Help("help", help::Help),
}

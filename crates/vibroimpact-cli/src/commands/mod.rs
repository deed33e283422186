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
use clap::{CommandFactory, Parser, Subcommand};

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

#[derive(Debug, Subcommand)]
enum Command {
    Simulate(simulate::Simulate),
    Settle(settle::Settle),
    SettleMany(settle_many::SettleMany),
    Attractors(attractors::Attractors),
    Orbit(orbit::Orbit),
    Branch(branch::Branch),
    Curve(curve::Curve),
    Region(region::Region),
    Response(response::Response),
    Margins(margins::Margins),
    Contact(contact::Contact),
    Edge(edge::Edge),
    Machine(machine::MachineCommand),
    Basin(basin::Basin),
    Map(map::Map),
    Diagram(diagram::Diagram),
    Lyapunov(lyapunov::Lyapunov),
    Explore(explore::Explore),
    Estimate(estimate::Estimate),
    Run(run::Run),
    Resume(resume::Resume),
    Status(status::Status),
    Verify(verify::Verify),
    Export(export::Export),
    Plot(plot::Plot),
    Slurm(slurm::Slurm),
    Schema(schema::Schema),
    Bench(bench::Bench),
    #[cfg(feature = "reproduce")]
    Reproduce(reproduce::Reproduce),
    Completions(completions::Completions),
    Man(man::Man),
    Help(help::Help),
}

pub(crate) fn run(line: &CommandLine, session: &Session) -> Result<(), Failure> {
    match &line.command {
        Command::Simulate(args) => simulate::run(args, session),
        Command::Settle(args) => settle::run(args, session),
        Command::SettleMany(args) => settle_many::run(args, session),
        Command::Attractors(args) => attractors::run(args, session),
        Command::Orbit(args) => orbit::run(args, session),
        Command::Branch(args) => branch::run(args, session),
        Command::Curve(args) => curve::run(args, session),
        Command::Region(args) => region::run(args, session),
        Command::Response(args) => response::run(args, session),
        Command::Margins(args) => margins::run(args, session),
        Command::Contact(args) => contact::run(args, session),
        Command::Edge(args) => edge::run(args, session),
        Command::Machine(args) => machine::run(args, session),
        Command::Basin(args) => basin::run(args, session),
        Command::Map(args) => map::run(args, session),
        Command::Diagram(args) => diagram::run(args, session),
        Command::Lyapunov(args) => lyapunov::run(args, session),
        Command::Explore(args) => explore::run(args, session),
        Command::Estimate(args) => estimate::run(args, session),
        Command::Run(args) => run::run(args, session),
        Command::Resume(args) => resume::run(args, session),
        Command::Status(args) => status::run(args, session),
        Command::Verify(args) => verify::run(args, session),
        Command::Export(args) => export::run(args, session),
        Command::Plot(args) => plot::run(args, session),
        Command::Slurm(args) => slurm::run(args, session),
        Command::Schema(args) => schema::run(args, session),
        Command::Bench(args) => bench::run(args, session),
        #[cfg(feature = "reproduce")]
        Command::Reproduce(args) => reproduce::run(args, session),
        Command::Completions(args) => completions::run(*args, CommandLine::command(), session),
        Command::Man(args) => man::run(args, CommandLine::command(), session),
        Command::Help(args) => help::run(args, CommandLine::command(), session),
    }
}

//! The commands, one file each: its arguments, its plan, its run, its report.

mod attractors;
mod basin;
mod bench;
mod branch;
mod completions;
mod curve;
mod diagram;
mod explore;
mod export;
mod lyapunov;
mod man;
mod map;
mod orbit;
mod outputs;
mod plot;
mod region;
mod reproduce;
mod resume;
mod run;
mod schema;
mod settle;
mod simulate;
mod slurm;
mod status;
mod stored;
mod verify;

use crate::exit::Failure;
use crate::session::Session;
use clap::Subcommand;

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Simulate(simulate::Simulate),
    Settle(settle::Settle),
    Attractors(attractors::Attractors),
    Orbit(orbit::Orbit),
    Branch(branch::Branch),
    Curve(curve::Curve),
    Region(region::Region),
    Basin(basin::Basin),
    Map(map::Map),
    Diagram(diagram::Diagram),
    Lyapunov(lyapunov::Lyapunov),
    Explore(explore::Explore),
    Run(run::Run),
    Resume(resume::Resume),
    Status(status::Status),
    Verify(verify::Verify),
    Export(export::Export),
    Plot(plot::Plot),
    Slurm(slurm::Slurm),
    Schema(schema::Schema),
    Bench(bench::Bench),
    Reproduce(reproduce::Reproduce),
    Completions(completions::Completions),
    Man(man::Man),
}

pub(crate) fn run(command: &Command, session: &Session) -> Result<(), Failure> {
    match command {
        Command::Simulate(args) => simulate::run(args, session),
        Command::Settle(args) => settle::run(args, session),
        Command::Attractors(args) => attractors::run(args, session),
        Command::Orbit(args) => orbit::run(args, session),
        Command::Branch(args) => branch::run(args, session),
        Command::Curve(args) => curve::run(args, session),
        Command::Region(args) => region::run(args, session),
        Command::Basin(args) => basin::run(args, session),
        Command::Map(args) => map::run(args, session),
        Command::Diagram(args) => diagram::run(args, session),
        Command::Lyapunov(args) => lyapunov::run(args, session),
        Command::Explore(args) => explore::run(args, session),
        Command::Run(args) => run::run(args, session),
        Command::Resume(args) => resume::run(args, session),
        Command::Status(args) => status::run(args, session),
        Command::Verify(args) => verify::run(args, session),
        Command::Export(args) => export::run(args, session),
        Command::Plot(args) => plot::run(args, session),
        Command::Slurm(args) => slurm::run(args, session),
        Command::Schema(_) => schema::run(session),
        Command::Bench(args) => bench::run(args, session),
        Command::Reproduce(args) => reproduce::run(args, session),
        Command::Completions(args) => completions::run(*args, session),
        Command::Man(args) => man::run(args, session),
    }
}

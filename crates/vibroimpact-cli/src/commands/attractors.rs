//! `vibro attractors`: the attractors of a system, and the share of starts that lead to each.

use crate::args::{MachineArgs, OutputArgs, StoreArgs, SystemArgs, whole};
use crate::commands::respond;
use crate::failure::Failure;
use crate::session::Session;
use clap::Args;
use vibroimpact_study::Task;

/// The steady motions that many scattered starts lead to, and their shares
///
/// The starts are spread evenly over positions, velocities and phases of a box around the motion. They are the same on
/// every machine. Two motions with one label are counted apart if their impacts differ.
#[derive(Clone, Debug, Args)]
#[command(
    override_usage = "vibro attractors --beta B --gap D --restitution E --starts N [OPTIONS]\n       \
        vibro attractors --machine NAME|FILE [--set PATH=VALUE] --starts N [OPTIONS]",
    after_help = "Example:\n  vibro attractors --inverse-beta 1.3 --gap 0.75 --restitution 0.5 --starts 500",
    mut_arg("plot", |arg| arg.help("Draw the shares as bars into this file, .svg, .png or .pdf")),
    mut_arg("csv", |arg| arg.help(
        "Write one row a motion to this file; - for stdout. Columns: label, share, starts, real and imaginary \
        part of both multipliers, all quantities"
    ))
)]
pub(crate) struct Attractors {
    #[command(flatten)]
    system: SystemArgs,
    #[command(flatten)]
    machine: MachineArgs,

    /// How many starts, 1 to 1e9
    #[arg(long, value_parser = whole::<u64>, value_name = "N", allow_hyphen_values = true, help_heading = "Starts")]
    starts: u64,

    /// Which sequence of starts
    #[arg(long, value_parser = whole::<u64>, value_name = "S", default_value_t = 1, help_heading = "Starts")]
    seed: u64,

    /// Budget of impacts for each start, 1 to 1000000; what is not settled by then is undecided [default: 20000]
    #[arg(long, value_parser = whole::<u32>, value_name = "N", allow_hyphen_values = true, help_heading = "Starts")]
    impacts: Option<u32>,

    #[command(flatten)]
    store: StoreArgs,

    #[command(flatten)]
    output: OutputArgs,
}

pub(super) fn run(args: &Attractors, session: &Session) -> Result<(), Failure> {
    let system = args.machine.or_oscillator(None, || args.system.asked())?;
    let task = Task::Attractors { starts: args.starts, seed: args.seed, impacts: args.impacts };
    respond::ask(&system.stored(task, Some(&args.store))?, &args.output, Some(&args.store), session)
}

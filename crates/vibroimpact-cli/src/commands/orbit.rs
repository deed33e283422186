//! `vibro orbit`: the periodic orbits with a label, stable or not.

use crate::args::{MachineArgs, OutputArgs, SystemArgs};
use crate::commands::respond;
use crate::failure::Failure;
use crate::session::Session;
use clap::Args;
use vibroimpact_study::Task;

/// All periodic orbits with m impacts in n forcing periods, stable or unstable
///
/// Newton's method starts from many seeds; orbits 1/n are also found in closed form. An orbit that no seed leads to is
/// not found.
///
/// A solution of the equations that passes through a stop is inadmissible. In JSON its "admissible" is false, and
/// "earlier_contact" gives the impact, counted from 1, after which it meets a stop, the stop, and the time since that
/// impact (for 0, which has no impacts, the time since phase 0). Only some of the inadmissible solutions are found.
#[derive(Clone, Debug, Args)]
#[command(
    override_usage = "vibro orbit --beta B --gap D --restitution E --label m/n [OPTIONS]\n       \
        vibro orbit --machine NAME|FILE [--set PATH=VALUE] --label m/n [OPTIONS]",
    after_help = "Example: the unstable 1/1 beside the stable 1/2 it gave way to\n  \
        vibro orbit --inverse-beta 1.11 --gap 2 --restitution 0.5 --label 1/1\n  \
        vibro orbit --inverse-beta 1.11 --gap 2 --restitution 0.5 --label 1/2",
    mut_arg("csv", |arg| arg.help(
        "Write one row an orbit to this file; - for stdout. Columns: orbit, label, admissible, stable, stability, \
        fastest closing, real and imaginary part of the multipliers, phases, speeds and stops of the closings \
        (lists with blanks between)"
    )),
    mut_arg("plot", |arg| arg.help(
        "Draw phase and speed of the closings of the admissible orbits into this file, .svg, .png or .pdf"
    ))
)]
pub(crate) struct Orbit {
    #[command(flatten)]
    system: SystemArgs,
    #[command(flatten)]
    machine: MachineArgs,

    /// m impacts in n forcing periods, for example 2/1; m and n from 1 to 10000; or inf/n; 0 is the steady motion without impacts;
    /// of a machine without forcing m/T: m impacts in one period of the motion, m from 0 to 10000, or inf/T
    #[arg(long, value_name = "m/n", allow_hyphen_values = true, help_heading = "Orbit")]
    label: String,

    #[command(flatten)]
    output: OutputArgs,
}

pub(super) fn run(args: &Orbit, session: &Session) -> Result<(), Failure> {
    let system = args.machine.or_oscillator(None, || args.system.asked())?;
    respond::ask(&system.question(Task::Orbit { label: args.label.clone() })?, &args.output, None, session)
}

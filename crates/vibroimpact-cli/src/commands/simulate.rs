//! `vibro simulate`: the events of a motion.

use crate::args::{OutputArgs, StartedArgs, number, whole};
use crate::commands::respond;
use crate::failure::Failure;
use crate::session::Session;
use clap::Args;
use vibroimpact_report::Shown;
use vibroimpact_study::SimulatePlan;

/// Follow a motion event by event: impacts, grazes, sticking, release
///
/// Prints every event with its time, the phase of the force and the velocities. It ends after a given number of impacts,
/// of forcing periods or a time, or when no event follows, and says which.
#[derive(Clone, Debug, Args)]
#[command(
    override_usage = "vibro simulate --beta B --gap D --restitution E [--x X --v V --phase P] [OPTIONS]\n       \
        vibro simulate --machine NAME|FILE [--set PATH=VALUE] [--q A,B --qdot A,B --phase P] [OPTIONS]",
    after_help = "Examples:\n  \
        vibro simulate --inverse-beta 1.8 --gap 0.25 --restitution 0.5 --impacts 20\n  \
        vibro simulate --beta 0.9 --gap -0.5 --restitution 0.5 --periods 4 \\\n    \
        --plot chatter.svg\n  \
        vibro simulate --beta 0.9 --gap 0.5 --restitution 0.7 --periods 10 \\\n    \
        --csv wave.csv --step 0.01\n  \
        vibro simulate --machine soft-stop --time 20\n  \
        vibro simulate --machine two-mass-hammer --periods 10 --plot hammer.svg",
    mut_arg("csv", |arg| arg.help(
        "Write the waveform, columns time, x, v, phase, to this file; - for stdout. Of a machine: time, coordinates, \
        velocities, gaps, forces, surfaces of damped stops, what stops and joints do, phase, and after an event the \
        digits that these leave out"
    )),
    mut_arg("plot", |arg| arg.help("Draw the waveform into this file, .svg, .png or .pdf"))
)]
pub(crate) struct Simulate {
    #[command(flatten)]
    of: StartedArgs,

    /// Stop after this number of impacts, 1 to 10000000 [default: 100, or 1000000 with --periods or --time]
    #[arg(long, value_parser = whole::<u64>, value_name = "N", allow_hyphen_values = true, help_heading = "Length")]
    impacts: Option<u64>,

    /// Stop after this number of forcing periods, up to 1e9, of 2 pi / beta each
    #[arg(long, value_parser = number, value_name = "N", allow_hyphen_values = true, help_heading = "Length")]
    periods: Option<f64>,

    /// Stop at this time, up to 1e10 1/omega_n; of a body in SI units in seconds, of a machine in its unit of time
    #[arg(long, value_parser = number, value_name = "T", allow_hyphen_values = true, help_heading = "Length")]
    time: Option<f64>,

    /// Time between points of the waveform [default: a hundredth of the forcing period]
    #[arg(long, value_parser = number, value_name = "T", requires = "csv", allow_hyphen_values = true, help_heading = "Output")]
    step: Option<f64>,

    #[command(flatten)]
    output: OutputArgs,
}

pub(super) fn run(args: &Simulate, session: &Session) -> Result<(), Failure> {
    let (system, start) = args.of.asked()?;
    let unit = system.units().time();
    let time = args.time.map(|time| time / unit);
    let question = system.question(SimulatePlan { start, impacts: args.impacts, periods: args.periods, time })?;
    let step = checked(args.step)?.map(|step| step / unit);
    respond::run(&question, (&args.output, Shown { step, ..Shown::default() }), None, session)
}

fn checked(step: Option<f64>) -> Result<Option<f64>, Failure> {
    match step {
        Some(step) if !(step > 0.0 && step.is_finite()) => {
            Err(Failure::bad(format!("step = {step} lies outside 0 < step < infinity")))
        }
        step => Ok(step),
    }
}

//! `vibro response`: a quantity of all motions over one parameter.

use crate::args::{MachineArgs, MachineAxesArgs, OutputArgs, RangedSystemArgs, StartOfMachineArgs, quantity, whole};
use crate::commands::respond;
use crate::failure::Failure;
use crate::session::Session;
use clap::Args;
use vibroimpact_study::ResponsePlan;

/// The response over a number, such as the frequency: a quantity of all motions, from branches and sweeps
///
/// One parameter takes a range A:B:N or a list of values. A sweep with rising values and one with falling values settle the
/// motion at each value from the state of the motion at the value before. The branch of each cycle that they find is followed
/// over the range through its folds and grazing impacts, stable or not. Orbits on branches that no sweep meets are not found.
#[derive(Clone, Debug, Args)]
#[command(
    override_usage = "vibro response --beta A:B:N --gap D --restitution E [OPTIONS]\n       \
        vibro response --machine NAME|FILE --axis PATH=A:B:N [OPTIONS]",
    after_help = "Examples:\n  \
        vibro response --beta 0.5:1.5:201 --gap 1.5 --restitution 0.7 \\\n    \
        --damping 0.02 --plot response.png\n  \
        vibro response --mass-kg 0.8 --stiffness-n-per-m 12000 --force-n 30 \\\n    \
        --damping-ratio 0.02 --gap-m 0.0015 \\\n    \
        --restitution 0.65 --frequency-hz 15:25:201 --quantity impact-speed-max \\\n    \
        --csv rattle.csv --plot rattle.png\n  \
        vibro response --machine two-mass-hammer --axis frequency=0.9:1.3:41 \\\n    \
        --quantity stop.anvil.impact-speed-max --plot hammer.png",
    mut_arg("csv", |arg| arg.help(
        "Write one row for each motion of a sweep and each point of a branch to this file; - for stdout. Columns: \
        curve (up, down or the number of a branch), the parameter, label, admissible, stable, stability, event, \
        all quantities"
    )),
    mut_arg("plot", |arg| arg.help(
        "Draw the response into this file, .svg, .png or .pdf: stable branches solid, neutral dashed and dotted, \
        unstable dashed, the sweeps as dots"
    ))
)]
pub(crate) struct Response {
    #[command(flatten)]
    system: RangedSystemArgs,
    #[command(flatten)]
    machine: MachineArgs,
    #[command(flatten)]
    start: StartOfMachineArgs,
    #[command(flatten)]
    machine_axes: MachineAxesArgs,

    /// The quantity, such as displacement-amplitude, displacement-max, impact-speed-max, power; of a machine its path, such as
    /// q.head.displacement-amplitude or stop.anvil.impact-speed-max [default: displacement-amplitude, of a machine that of its first coordinate, or its largest speed if all coordinates drift]
    #[arg(long, value_name = "NAME", help_heading = "Output")]
    quantity: Option<String>,

    /// Budget of impacts for the motion at each value, 1 to 1000000; what is not settled by then is undecided [default: 20000]
    #[arg(long, value_parser = whole::<u32>, value_name = "N", allow_hyphen_values = true, help_heading = "Sweep")]
    impacts: Option<u32>,

    #[command(flatten)]
    output: OutputArgs,
}

pub(super) fn run(args: &Response, session: &Session) -> Result<(), Failure> {
    let system = args.machine.or_oscillator(Some((&args.start, None)), || args.system.asked())?;
    let quantity = if system.is_machine() {
        args.quantity.clone()
    } else {
        let named = args.quantity.as_deref().map(|name| quantity(name).map_err(Failure::bad)).transpose()?;
        named.map(|named| named.name().to_owned())
    };
    let axes = system.ranged(&args.system, &args.machine_axes)?;
    let [axis] = axes.as_slice() else {
        return Err(Failure::bad(format!(
            "a response is over one number, and ranges are given for {}\nhint: --beta 0.5:1.5:201, or of a machine --axis frequency=0.5:1.5:201; `vibro map` takes several",
            axes.len()
        )));
    };
    let task =
        ResponsePlan { quantity, impacts: args.impacts, ..ResponsePlan::new(axis.vary.clone(), axis.over.clone()) };
    respond::ask(&system.question(task)?, &args.output, None, session)
}

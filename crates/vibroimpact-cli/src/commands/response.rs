//! `vibro response`: a quantity of all motions over one parameter.

use crate::args::{FigureArgs, RangedSystemArgs, quantity, whole};
use crate::commands::outputs::Outputs;
use crate::commands::respond;
use crate::failure::Failure;
use crate::session::Session;
use clap::Args;
use std::path::PathBuf;
use vibroimpact_report::{Asked, Shown};
use vibroimpact_study::{Coordinate, Plan, Quantity, ResponsePlan, Task};

/// The response over a parameter, such as the frequency: a quantity of all motions, from branches and sweeps
///
/// One parameter takes a range A:B:N or a list of values. A sweep with rising values and one with falling values settle the
/// motion at each value from the state of the motion at the value before. The branch of each cycle that they find is followed
/// over the range through its folds and grazing impacts, stable or not. Orbits on branches that no sweep meets are not found.
#[derive(Clone, Debug, Args)]
#[command(
    override_usage = "vibro response --beta A:B:N --gap D --restitution E [OPTIONS]",
    after_help = "Examples:\n  \
        vibro response --beta 0.5:1.5:201 --gap 1.5 --restitution 0.7 --damping 0.02 --plot response.png\n  \
        vibro response --mass-kg 0.8 --stiffness-n-per-m 12000 --force-n 30 --damping-ratio 0.02 --gap-m 0.0015 \\\n    \
        --restitution 0.65 --frequency-hz 15:25:201 --quantity impact-speed-max --csv response.csv --plot response.png"
)]
pub(crate) struct Response {
    #[command(flatten)]
    system: RangedSystemArgs,

    /// The quantity, such as displacement-amplitude, displacement-max, impact-speed-max, power [default:
    /// displacement-amplitude]
    #[arg(long, value_name = "NAME", value_parser = quantity, help_heading = "Output")]
    quantity: Option<Quantity>,

    /// Budget of impacts for the motion at each value, 1 to 1000000; what is not settled by then is undecided [default: 20000]
    #[arg(long, value_parser = whole::<u32>, value_name = "N", allow_hyphen_values = true, help_heading = "Sweep")]
    impacts: Option<u32>,

    /// Write one row for each motion of a sweep and each point of a branch to this file; - for stdout. Columns: curve (up,
    /// down or the number of a branch), the parameter, label, physical, stable, stability, all quantities
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    csv: Option<PathBuf>,

    /// Draw the response into this file, .svg, .png or .pdf: stable branches solid, neutral dashed and dotted,
    /// unstable dashed, the sweeps as dots
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    plot: Option<PathBuf>,

    #[command(flatten)]
    figure: FigureArgs,

    /// Print one JSON object instead of text
    #[arg(long, help_heading = "Output")]
    json: bool,
}

pub(super) fn run(args: &Response, session: &Session) -> Result<(), Failure> {
    let Asked { system, units } = args.system.asked()?;
    let axes = args.system.axes()?;
    let [axis] = axes.as_slice() else {
        return Err(Failure::bad(format!(
            "a response is over one parameter, and ranges are given for {}\nhint: --beta 0.5:1.5:201; `vibro map` takes several",
            axes.len()
        )));
    };
    let Coordinate::Parameter(vary) = axis.vary else {
        return Err(Failure::bad("a response is over a parameter of the system\nhint: --beta 0.5:1.5:201"));
    };
    let task = ResponsePlan::new(vary, axis.over.clone());
    let task = ResponsePlan { quantity: args.quantity.unwrap_or(task.quantity), impacts: args.impacts, ..task };
    let plan = Plan::new(system, Task::Response(task));
    plan.check()?;
    let outputs = Outputs::reserve(args.csv.as_deref(), (args.plot.as_deref(), &args.figure), args.json, session)?;
    respond::run(&plan, units, (outputs, Shown::default()), None, session)
}

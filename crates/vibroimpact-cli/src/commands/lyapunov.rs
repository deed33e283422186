//! `vibro lyapunov`: the Lyapunov exponents of a motion, and sections of its attractor.

use crate::args::{OutputArgs, StartedArgs, StoreArgs, StudyAxesArgs, whole};
use crate::commands::respond;
use crate::failure::Failure;
use crate::session::Session;
use clap::Args;
use vibroimpact_report::ReportError;
use vibroimpact_study::{Axis, Coordinate, DEFAULT_POINTS, LyapunovPlan, Variable};

/// The Lyapunov exponents of the motion from a start, with error bars, and the dimension of its attractor
///
/// Both exponents are measured through impacts over a long motion, per unit of time and per forcing period. The error
/// bars are three standard errors and allow for correlation. A positive exponent is chaos. The sum of the exponents is 2
/// ln(eps) times the rate of impacts minus 2 zeta. A motion without impacts has the exponents of its flight. After
/// sticking all neighbours are one motion, so both exponents are minus infinity; with restitution 0 one of them is. A
/// motion that only grazes the stop has no exponents. In JSON such a value is null, and "why" is minus_infinity or
/// undefined; "grounds" says how the values were found. Over axes, the exponents of each point are a study, with a table and a
/// figure of its own.
#[derive(Clone, Debug, Args)]
#[command(
    override_usage = "vibro lyapunov --beta B --gap D --restitution E [--x X --v V --phase P] [OPTIONS]\n       \
        vibro lyapunov --machine NAME|FILE [--set PATH=VALUE] [--q A,B --qdot A,B --phase P] [OPTIONS]",
    after_help = "Examples:\n  \
        vibro lyapunov --inverse-beta 1.11 --gap 3 --restitution 0.5\n  \
        vibro lyapunov --inverse-beta 1.11 --gap 3 --restitution 0.5 \\\n    \
        --section section.csv --plot section.png\n  \
        vibro lyapunov --inverse-beta 1.11 --gap 3 --restitution 0.5 \\\n    \
        --axis gap=2.5:3.5:101 --impacts 20000 --plot exponents.png",
    mut_arg("csv", |arg| arg.visible_alias("section").help(
        "Write the points of both sections of the attractor to this file; - for stdout. Columns: section \
        (closing, or strobe for the states at phase 0), stop, phase, speed of the closing, and positions and \
        velocities, which at a closing are those after it. Over axes one row for each exponent of a point"
    )),
    mut_arg("plot", |arg| arg.help("Draw both sections into this file, .svg, .png or .pdf; over axes the exponents"))
)]
pub(crate) struct Lyapunov {
    #[command(flatten)]
    of: StartedArgs,

    #[command(flatten)]
    axes: StudyAxesArgs,

    /// Impacts to measure over, 1000 to 10000000 [default: 100000]; of a machine events, 25 to 10000000 [default: 20000]
    #[arg(long, value_parser = whole::<u64>, value_name = "N", allow_hyphen_values = true, help_heading = "Length")]
    impacts: Option<u64>,

    /// Impacts to pass before, up to 1000000 and at least 100; for the stroboscopic section forcing periods [default: 1000]; of
    /// a machine events [default: 1000]
    #[arg(long, value_parser = whole::<u64>, value_name = "K", allow_hyphen_values = true, help_heading = "Length")]
    transient: Option<u64>,

    /// Points of each section, 1 to 100000 [default: 5000]
    #[arg(long, value_parser = whole::<u64>, value_name = "N", allow_hyphen_values = true, help_heading = "Output")]
    points: Option<u64>,

    #[command(flatten)]
    store: StoreArgs,

    #[command(flatten)]
    output: OutputArgs,
}

pub(super) fn run(args: &Lyapunov, session: &Session) -> Result<(), Failure> {
    let study = args.axes.count() > 0;
    if !study && args.store.store.is_some() {
        return Err(Failure::bad("one motion needs no store\nhint: --axis gap=0:5:41 for the exponents over an axis"));
    }
    if study && args.store.store.is_none() && !args.output.any_file() && !args.output.json {
        return Err(Failure::bad(
            "the exponents of the points would be lost\nhint: --csv FILE, --plot FILE or --store DIR",
        ));
    }
    if args.axes.count() > 1 && args.output.plot.is_some() {
        return Err(ReportError::Exponents.into());
    }
    let shown = !study && args.output.any_file();
    if args.points.is_some() && !shown {
        return Err(Failure::bad(if study {
            "--points says how much of the sections is shown; they are of one motion, without --axis"
        } else {
            "--points says how much of the sections is shown\nhint: --section FILE or --plot FILE"
        }));
    }
    let points = shown.then(|| args.points.unwrap_or(DEFAULT_POINTS));
    let (system, start) = args.of.asked()?;
    let axes = system.axes(&args.axes)?;
    let measured = |axis: &Axis<Variable>| matches!(axis.vary, Variable::Coordinate(Coordinate::X | Coordinate::V));
    if system.units().plan().is_some() && axes.iter().any(measured) {
        return Err(Failure::bad("an axis of x or v is nondimensional\nhint: without --units si"));
    }
    let (impacts, transient) = (args.impacts, args.transient);
    let task = LyapunovPlan { axes, start, impacts, transient, points };
    let store = study.then_some(&args.store);
    respond::ask(&system.stored(task, store)?, &args.output, store, session)
}

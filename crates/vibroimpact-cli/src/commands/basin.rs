//! `vibro basin`: the motion to which each start of a plane leads.

use crate::args::{
    ColourArgs, FieldsArgs, MachineArgs, MachineAxesArgs, OutputArgs, StartOfMachineArgs, StoreArgs, SystemArgs,
    number, whole,
};
use crate::commands::respond;
use crate::failure::Failure;
use crate::session::Session;
use clap::Args;
use vibroimpact_report::Shown;
use vibroimpact_study::{Axis, BasinPlan, Coordinate, Span, StartPlan, Variable};

/// Which motion each start of a plane of positions and velocities leads to
///
/// A:B:N is N values from A to B, both included. Without --csv, --plot or --json the command prints the shares, and
/// measures of the boundary between the basins: entropies, the uncertainty exponent, and with at least three motions the
/// merging method, which tells whether all basins have one boundary (Wada) at the resolution of the grid.
#[derive(Clone, Debug, Args)]
#[command(
    override_usage = "vibro basin --beta B --gap D --restitution E --x A:B:N --v A:B:N [OPTIONS]\n       \
        vibro basin --machine NAME|FILE --axis q.NAME=A:B:N --axis qdot.NAME=A:B:N [OPTIONS]",
    after_help = "Example:\n  \
        vibro basin --inverse-beta 1.3 --gap 0.75 --restitution 0.5 \\\n    \
        --x -4:0.75:400 --v -4:4:400 --csv basin.csv --plot basin.png",
    mut_arg("csv", |arg| arg.help(
        "Write one row a start, columns x, v, label and --fields, to this file; - for stdout. Of a machine also \
        the stops that stay closed for ever and the events over which chaos was seen"
    )),
    mut_arg("plot", |arg| arg.help("Draw the basin into this file, .svg, .png or .pdf"))
)]
pub(crate) struct Basin {
    #[command(flatten)]
    system: SystemArgs,
    #[command(flatten)]
    machine: MachineArgs,
    #[command(flatten)]
    of_machine: StartOfMachineArgs,
    #[command(flatten)]
    axes: MachineAxesArgs,

    /// Positions, none beyond a stop
    #[arg(
        long,
        value_name = "A:B:N",
        allow_hyphen_values = true,
        required_unless_present = "machine",
        help_heading = "Starts"
    )]
    x: Option<Span>,

    /// Velocities
    #[arg(
        long,
        value_name = "A:B:N",
        allow_hyphen_values = true,
        required_unless_present = "machine",
        help_heading = "Starts"
    )]
    v: Option<Span>,

    /// Phase of the force at all starts, in radians [default: 0]
    #[arg(long, value_parser = number, value_name = "P", allow_hyphen_values = true, help_heading = "Starts")]
    phase: Option<f64>,

    /// Budget of impacts for each start, 1 to 1000000; what is not settled by then is undecided
    #[arg(long, value_parser = whole::<u32>, value_name = "N", allow_hyphen_values = true, help_heading = "Starts")]
    impacts: Option<u32>,

    #[command(flatten)]
    store: StoreArgs,

    /// Compute every K-th start first, and those between only where neighbours differ; needs --store
    #[arg(long, value_parser = whole::<u32>, value_name = "K", requires = "store", help_heading = "Store")]
    refine: Option<u32>,

    #[command(flatten)]
    colour: ColourArgs,
    #[command(flatten)]
    fields: FieldsArgs,

    #[command(flatten)]
    output: OutputArgs,
}

pub(super) fn run(args: &Basin, session: &Session) -> Result<(), Failure> {
    let start = Some((&args.of_machine, args.phase));
    let system = args.machine.or_oscillator(start, || args.system.asked())?;
    let units = system.units();
    let (axes, start) = if system.is_machine() {
        (args.axes.axes(), None)
    } else {
        let (Some(x), Some(v)) = (&args.x, &args.v) else {
            return Err(Failure::bad("a basin needs --x A:B:N and --v A:B:N"));
        };
        let (x, v) = (x.scaled(units.length())?, v.scaled(units.velocity())?);
        let start = StartPlan { phase: args.phase.unwrap_or(0.0), ..StartPlan::default() };
        let axis = |vary: Coordinate, over: Span| Axis { vary: Variable::from(vary), over: over.into() };
        (vec![axis(Coordinate::X, x), axis(Coordinate::V, v)], Some(start))
    };
    let task = BasinPlan {
        axes,
        points: None,
        start,
        refine: args.refine,
        impacts: args.impacts,
        fields: system.fields(&args.colour, &args.fields)?,
        transient: false,
    };
    let question = system.stored(task, Some(&args.store))?;
    let shown = Shown { colour: args.colour.coloured(args.output.plot.is_some())?, ..Shown::default() };
    respond::run(&question, (&args.output, shown), Some(&args.store), session)
}

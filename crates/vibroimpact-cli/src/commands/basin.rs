//! `vibro basin`: the motion to which each start of a plane leads.

use crate::args::{
    ColourArgs, FieldsArgs, MachineArgs, MachineAxesArgs, OutputArgs, StartOfMachineArgs, StoreArgs, SystemArgs,
    number, whole,
};
use crate::commands::outputs::Outputs;
use crate::commands::{of_machine, respond};
use crate::failure::Failure;
use crate::session::Session;
use clap::Args;
use vibroimpact_report::Shown;
use vibroimpact_study::{BasinPlan, MachineBasinPlan, MachineTask, Plan, Span, Task};

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
    let task = || {
        let (axes, refine, impacts) = (args.axes.axes(), args.refine, args.impacts);
        let fields = args.colour.with(&args.fields).paths();
        Ok(MachineTask::Basin(MachineBasinPlan { axes, refine, impacts, fields }))
    };
    let shown = |drawn| Ok(Shown { colour: args.colour.coloured(drawn)?, ..Shown::default() });
    if let Some(answer) =
        of_machine::asked(&args.machine, start, task, args.output.files(), (Some(&args.store), shown), session)
    {
        return answer;
    }
    let (Some(x), Some(v)) = (&args.x, &args.v) else {
        return Err(Failure::bad("a basin needs --x A:B:N and --v A:B:N"));
    };
    let asked = args.system.asked()?;
    let units = asked.units;
    let plane = BasinPlan::plane(x.scaled(units.length())?, v.scaled(units.velocity())?, args.phase.unwrap_or(0.0));
    let task = BasinPlan {
        refine: args.refine,
        impacts: args.impacts,
        fields: args.colour.with(&args.fields).quantities()?,
        ..plane
    };
    let axes = task.axes.clone();
    let plan = args.store.tiled(Plan::new(asked.system, Task::Basin(task)))?;
    let outputs = Outputs::reserve(args.output.files(), session)?;
    outputs.drawable(&axes, 2)?;
    let shown = Shown { colour: args.colour.coloured(outputs.drawn())?, ..Shown::default() };
    respond::run(&plan, units, (outputs, shown), Some(&args.store), session)
}

//! `vibro map`: the motions at each point of a plane of parameters.

use crate::args::{
    ColourArgs, FieldsArgs, MachineArgs, MachineAxesArgs, OutputArgs, OverlayArgs, RangedSystemArgs, StoreArgs, whole,
};
use crate::commands::respond;
use crate::failure::Failure;
use crate::session::Session;
use clap::Args;
use vibroimpact_report::Shown;
use vibroimpact_study::MapPlan;

/// Which motions exist at each point of a plane of parameters
///
/// At each point the number of starts given by --starts is settled: the first from rest, the second on the motion without
/// stops if that clears them, the others scattered over a box around the motion. One to four parameters take ranges, the
/// others one value: A:B:N is N values from A to B, both included, A:B:N:log is N values in equal ratios, and A,B,C is a
/// list. The first of the ranges, or of --axes, is the abscissa. Without --csv, --plot or --json the command prints a
/// summary.
#[derive(Clone, Debug, Args)]
#[command(
    override_usage = "vibro map --inverse-beta A:B:N --gap A:B:N --restitution E --starts N [OPTIONS]\n       \
        vibro map --machine NAME|FILE --axis PATH=A:B:N [--axis PATH=A:B:N] --starts N [OPTIONS]",
    after_help = "Examples:\n  \
        vibro map --inverse-beta 0.4:2:33 --gap 0:5:41 --restitution 0.5 \\\n    \
        --starts 4 --csv map.csv --plot map.png\n  \
        vibro map --inverse-beta 0.9:1.5:31 --gap 0.5:3:26 --restitution 0.5 \\\n    \
        --starts 4 --plot map.svg \\\n    \
        --layers regions,amplitude,stripes --mark 1.3,1 --line 1.1,1.5:1.1,2.5\n  \
        vibro map --beta 0.1:10:30:log --restitution 0.2:0.9:20 --gap 1 --starts 4 \\\n    \
        --plot restitution.png\n  \
        vibro map --inverse-beta 0.4:2:161 --gap 0:5:161 --restitution 0.5 \\\n    \
        --starts 4 --store map.zarr --refine 8",
    mut_arg("csv", |arg| arg.help(
        "Write one row a motion to this file; - for stdout. Columns: what varies, then label, share, and \
        --fields; of a machine also the stops that stay closed for ever and the events over which chaos was seen"
    )),
    mut_arg("plot", |arg| arg.help(
        "Draw the map into this file, .svg, .png or .pdf: the labels over two parameters, their shares over one"
    ))
)]
pub(crate) struct Map {
    #[command(flatten)]
    plane: RangedSystemArgs,
    #[command(flatten)]
    machine: MachineArgs,
    #[command(flatten)]
    machine_axes: MachineAxesArgs,

    /// Starts at each point, 1 to 1e9
    #[arg(long, value_parser = whole::<u64>, value_name = "N", allow_hyphen_values = true, help_heading = "Starts")]
    starts: u64,

    /// Which sequence of starts
    #[arg(long, value_parser = whole::<u64>, value_name = "S", default_value_t = 1, help_heading = "Starts")]
    seed: u64,

    /// Budget of impacts for each start, 1 to 1000000; what is not settled by then is undecided
    #[arg(long, value_parser = whole::<u32>, value_name = "N", allow_hyphen_values = true, help_heading = "Starts")]
    impacts: Option<u32>,

    #[command(flatten)]
    store: StoreArgs,

    /// Compute every K-th point first, and those between only where neighbours differ; needs --store
    #[arg(long, value_parser = whole::<u32>, value_name = "K", requires = "store", help_heading = "Store")]
    refine: Option<u32>,

    #[command(flatten)]
    colour: ColourArgs,
    #[command(flatten)]
    overlay: OverlayArgs,
    #[command(flatten)]
    fields: FieldsArgs,

    #[command(flatten)]
    output: OutputArgs,
}

pub(super) fn run(args: &Map, session: &Session) -> Result<(), Failure> {
    let system = args.machine.or_oscillator(None, || args.plane.asked())?;
    if system.is_machine() && args.overlay.any() {
        return Err(Failure::bad("--layers, --mark and --line are for maps without --machine"));
    }
    let axes = system.ranged(&args.plane, &args.machine_axes)?;
    if axes.is_empty() && !system.is_machine() {
        return Err(Failure::bad(
            "nothing varies\nhint: give one of the parameters a range, --gap 0:5:41; `vibro attractors` answers for one point",
        ));
    }
    let task = MapPlan {
        axes,
        starts: args.starts,
        seed: args.seed,
        refine: args.refine,
        impacts: args.impacts,
        fields: system.fields(&args.colour, &args.fields)?,
    };
    let question = system.stored(task, Some(&args.store))?;
    let drawn = args.output.plot.is_some();
    let colour = args.colour.coloured(drawn)?;
    let overlay = args.overlay.overlay(drawn, colour.is_some())?;
    let shown = Shown { colour, overlay, ..Shown::default() };
    respond::run(&question, (&args.output, shown), Some(&args.store), session)
}

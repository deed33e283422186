//! `vibro region`: the regions of a plane of two parameters in which a motion exists and in which it is stable.

use crate::args::{
    AxesArgs, BodyArgs, Convention, MachineArgs, NumbersArgs, OutputArgs, VariedOver, of_oscillator, ranges, whole,
};
use crate::commands::respond;
use crate::failure::Failure;
use crate::session::Session;
use clap::Args;
use vibroimpact_study::{DEFAULT_GRID, RegionPlan, Stretch, Variable};

/// Where a motion exists and where it is stable, over two parameters: closed polygons
///
/// Two parameters are given as ranges A:B, the others as values; ranges replace values of a body in physical units.
/// Orbits are searched for on a grid. From each orbit the boundary of its part of the region is followed along the curves
/// that bound it: fold (two orbits meet), flip (a multiplier is -1), no speed (an impact has speed zero), touch (a flight
/// touches a stop), merging (with an orbit of half the period), frame. The surface of orbits folds, so polygons of
/// different sheets may overlap. The region of the motion without impacts, label 0, is known in closed form: its
/// amplitude exceeds no gap, and a touch bounds it.
///
/// Of a machine any two numbers vary, by their paths. One that is an oscillator, with one coordinate, forcing of order 1 and
/// rigid stops, has the regions of this. Of any other one the cycles found at points of the grid are followed over the plane, and
/// the edge of what they reach is outlined to about 1e-3 of a quarter of a range; an edge can also be torus (a pair of complex
/// multipliers is on the unit circle) or change (the events change in another way). It takes longer, by a factor of some hundred:
/// begin with --grid 8.
#[derive(Clone, Debug, Args)]
#[command(
    mut_args(ranges),
    override_usage = "vibro region --label m/n --inverse-beta A:B --gap A:B --restitution E [OPTIONS]\n       \
        vibro region --machine NAME|FILE --label m/n --axis PATH=A:B --axis PATH=A:B [OPTIONS]",
    after_help = "Examples:\n  \
        vibro region --label 1/1 --inverse-beta 0.4:2 --gap -1:5 --restitution 0.5 \\\n    \
        --csv region.csv --plot region.png\n  \
        vibro region --label 1/2 --inverse-beta 1.11 --gap 0:3 \\\n    \
        --restitution 0.2:0.9 --plot plane.png\n  \
        vibro region --machine fukaya-irie-1971 --label 1/1 \\\n    \
        --axis inverse_beta=1.05:1.2 --axis delta=1:2.5 --csv machine-region.csv\n  \
        vibro region --machine two-mass-hammer --label 1/1 --grid 4 \\\n    \
        --axis frequency=1:1.2 --axis stop.anvil.gap=0.4:0.6",
    mut_arg("csv", |arg| arg.help(
        "Write one row a vertex to this file; - for stdout. Columns: region (existence or stability), polygon, \
        hole, sheet (below: multipliers below +1, or above), both parameters, and what bounds the region from \
        here to the next vertex"
    )),
    mut_arg("plot", |arg| arg.help(
        "Draw both regions into this file, .svg, .png or .pdf; edges of the sheet \"above\" are thin"
    ))
)]
pub(crate) struct Region {
    /// m impacts in n forcing periods, for example 2/1; 0 for the motion without impacts
    #[arg(long, value_name = "m/n", allow_hyphen_values = true, help_heading = "Motion")]
    label: String,

    #[command(flatten, next_help_heading = "Plane")]
    system: NumbersArgs,

    #[command(flatten, next_help_heading = "Plane")]
    axes: AxesArgs,

    #[command(flatten)]
    body: BodyArgs,
    #[command(flatten)]
    of_machine: MachineArgs,

    /// What varies over a machine, once for each axis: the path of a number and its range
    #[arg(long, value_name = "PATH=A:B", allow_hyphen_values = true, requires = "machine", help_heading = "Machine")]
    axis: Vec<VariedOver>,

    /// Units of ranges and results
    #[arg(long, value_enum, value_name = "UNITS", default_value_t = Convention::Nondimensional, help_heading = "Plane")]
    units: Convention,

    /// Points of the grid at which orbits are looked for, in each direction, 2 to 400: smaller parts may be missed
    #[arg(long, value_parser = whole::<u32>, value_name = "N", default_value_t = DEFAULT_GRID, allow_hyphen_values = true, help_heading = "Plane")]
    grid: u32,

    #[command(flatten)]
    output: OutputArgs,
}

impl Region {
    /// The two parameters with ranges, the abscissa first.
    fn plane(&self, over: Vec<Stretch>) -> Result<(Stretch, Stretch), Failure> {
        let over = self.axes.order(over, |stretch| stretch.parameter)?;
        match over.as_slice() {
            [across, up] => Ok((*across, *up)),
            _ => Err(Failure::bad(format!(
                "a plane has two parameters, and ranges A:B are given for {}\nhint: --inverse-beta 0.4:2 --gap -1:5",
                over.len()
            ))),
        }
    }
}

impl Region {
    /// The plane of two numbers of a machine.
    fn of_machine(&self) -> Result<[Stretch<Variable>; 2], Failure> {
        let [across, up] = self.axis.as_slice() else {
            return Err(Failure::bad(format!(
                "a plane has two numbers, and --axis PATH=A:B is given {} times\nhint: --axis frequency=30:60 --axis stop.wall.gap=0.001:0.01",
                self.axis.len()
            )));
        };
        Ok([across, up].map(|over| {
            let (from, to) = over.ends();
            Stretch { parameter: Variable::Path(over.0.path()), from, to }
        }))
    }
}

pub(super) fn run(args: &Region, session: &Session) -> Result<(), Failure> {
    let mut plane = None;
    let system = args.of_machine.or_oscillator(None, || {
        let (asked, over) = args.system.over_ranges((&args.body, args.units), &[], of_oscillator)?;
        let (across, up) = args.plane(over)?;
        plane =
            Some([across, up].map(|side| Stretch { parameter: side.parameter.into(), from: side.from, to: side.to }));
        Ok(asked)
    })?;
    let [across, up] = plane.map_or_else(|| args.of_machine(), Ok)?;
    let task = RegionPlan { label: args.label.clone(), across, up, grid: args.grid };
    respond::ask(&system.question(task)?, &args.output, None, session)
}

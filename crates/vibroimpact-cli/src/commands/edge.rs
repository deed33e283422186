//! `vibro edge`: the border between the starts of two motions, and the saddle on it.

use crate::args::{OutputArgs, StartedArgs, number, whole};
use crate::commands::respond;
use crate::failure::Failure;
use crate::session::Session;
use clap::Args;
use vibroimpact_study::{Coordinate, EdgePlan, Name, PlacePlan, PlanError, Variable};

/// The border between the starts that lead to two motions, and the unstable motion on it
///
/// The way from the first start to another one is halved until the border between their motions is known to rounding. Then the
/// motion on the border is followed for as long as is needed: two states close to each other, one on each side, are followed until they
/// part, and their way is halved again. Where it comes back to itself, Newton's method finds the periodic motion to which it leads: the
/// saddle that separates the two motions.
#[derive(Clone, Debug, Args)]
#[command(
    override_usage = "vibro edge --beta B --gap D --restitution E [--x X --v V --phase P] --other v=V [OPTIONS]\n       \
        vibro edge --machine NAME|FILE [--set PATH=VALUE] [--q A,B --qdot A,B --phase P] --other qdot.NAME=V [OPTIONS]",
    after_help = "Examples:\n  \
        vibro edge --inverse-beta 1.3 --gap 0.75 --restitution 0.5 --other x=-2\n  \
        vibro edge --inverse-beta 1.3 --gap 0.75 --restitution 0.5 --other x=-2,v=1 \\\n    --csv border.csv\n  \
        vibro edge --machine fukaya-irie-1971 --other q.mass=-2",
    mut_arg("plot", |arg| arg.help("Draw the states on the border into this file, .svg, .png or .pdf")),
    mut_arg("csv", |arg| arg.help(
        "Write one row for each state on the border to this file; - for stdout. Columns: time, the coordinates and velocities, phase, apart"
    ))
)]
pub(crate) struct Edge {
    #[command(flatten)]
    of: StartedArgs,

    /// In what the second start differs from the first: x or v, of a machine q.NAME or qdot.NAME; several separated by commas
    #[arg(long, value_delimiter = ',', value_parser = place, value_name = "NAME=VALUE", required = true, allow_hyphen_values = true, help_heading = "Border")]
    other: Vec<(String, f64)>,

    /// Forcing periods for which the motion on the border is followed at most, 1 to 10000 [default: 200]
    #[arg(long, value_parser = whole::<u32>, value_name = "N", allow_hyphen_values = true, help_heading = "Border")]
    laps: Option<u32>,

    /// Budget of impacts for each start, 1 to 1000000 [default: 20000]
    #[arg(long, value_parser = whole::<u32>, value_name = "N", allow_hyphen_values = true, help_heading = "Border")]
    impacts: Option<u32>,

    #[command(flatten)]
    output: OutputArgs,
}

/// A coordinate of a start and its value.
fn place(text: &str) -> Result<(String, f64), String> {
    let (name, value) = text.split_once('=').ok_or_else(|| format!("`{text}` is not NAME=VALUE, such as v=1"))?;
    Ok((name.trim().to_owned(), number(value)?))
}

pub(super) fn run(args: &Edge, session: &Session) -> Result<(), Failure> {
    let (system, start) = args.of.asked()?;
    let units = system.units();
    let other = args.other.iter().map(|(name, value)| {
        if system.is_machine() {
            return Ok(PlacePlan { coordinate: Variable::Path(name.clone()), value: *value });
        }
        let coordinate = Coordinate::of(name)?;
        let unit = match coordinate {
            Coordinate::X => units.length(),
            Coordinate::V => units.velocity(),
            _ => 1.0,
        };
        Ok(PlacePlan { coordinate: Variable::Coordinate(coordinate), value: value / unit })
    });
    let other = other.collect::<Result<_, PlanError>>()?;
    let task = EdgePlan { start, other, laps: args.laps, impacts: args.impacts };
    respond::ask(&system.question(task)?, &args.output, None, session)
}

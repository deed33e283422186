//! `vibro branch`: a branch of periodic orbits in one parameter, through its events.

use crate::args::{
    BranchEnds, MachineArgs, OutputArgs, StartOfMachineArgs, SystemArgs, Value, Varied, VariedNamed, varied, whole,
};
use crate::commands::respond;
use crate::failure::Failure;
use crate::session::Session;
use clap::Args;
use vibroimpact_report::Shown;
use vibroimpact_study::{BranchPlan, DEFAULT_BRANCH_POINTS, Target};

/// Follow an orbit in one parameter, stable or unstable, with all events on the branch
///
/// The orbit is found at the given system as `vibro orbit` does, and followed by pseudo-arclength to the value of --to.
/// Events are located to rounding: fold, flip (a multiplier is -1), branch point, grazing (an impact appears or
/// disappears, and the branch continues with the motion beyond), loss of contact.
///
/// An orbit that sticks, inf/n or one with restitution 0, is followed by its release, to where the sticking ends.
///
/// In JSON an infinite multiplier, as at a grazing, is null. Impacts are counted from 1, after sticking from the release
/// on.
#[derive(Clone, Debug, Args)]
#[command(
    override_usage = "vibro branch --beta B --gap D --restitution E --label m/n --vary PARAMETER --to VALUE [OPTIONS]\n       \
        vibro branch --machine NAME|FILE [--label m/n] --vary PATH --to VALUE [OPTIONS]",
    after_help = "Examples:\n  \
        vibro branch --inverse-beta 1.11 --gap 1.5 --restitution 0.5 --label 1/1 \\\n    \
        --vary gap --to 2.5\n  \
        vibro branch --inverse-beta 1.11 --gap 1.5 --restitution 0.5 --label 1/1 \\\n    \
        --vary gap --to 0,2.5 --follow 3 --csv branch.csv --plot branch.png\n  \
        vibro branch --inverse-beta 1.11 --gap 1.5 --restitution 0.5 --label 1/1 \\\n    \
        --vary gap --to 2.5 --also inverse-beta=1.05",
    mut_arg("csv", |arg| arg.help(
        "Write one row a point to this file; - for stdout. Columns: branch, the parameter, that of --also, label, \
        admissible, stable, stability, event, its stop, fastest closing, real and imaginary part of the \
        multipliers, phases, speeds and stops of the closings (lists with blanks between)"
    )),
    mut_arg("plot", |arg| arg.help(
        "Draw the bifurcation diagram into this file, .svg, .png or .pdf: stable solid, neutral dashed and \
        dotted, unstable dashed, behind it in grey what simulation finds"
    ))
)]
pub(crate) struct Branch {
    #[command(flatten)]
    system: SystemArgs,
    #[command(flatten)]
    machine: MachineArgs,
    #[command(flatten)]
    of_machine: StartOfMachineArgs,

    /// m impacts in n forcing periods, for example 2/1, or inf/n; m/T of a machine without forcing: the orbit at the system
    /// given [default for a machine: the motion from the start]
    #[arg(
        long,
        value_name = "m/n",
        allow_hyphen_values = true,
        required_unless_present = "machine",
        help_heading = "Branch"
    )]
    label: Option<String>,

    /// Which of several orbits, as `vibro orbit` numbers them [default: the stable one, else the fastest motion]
    #[arg(long, value_parser = whole::<u32>, value_name = "K", allow_hyphen_values = true, help_heading = "Branch")]
    orbit: Option<u32>,

    /// The parameter that varies, from its value in the system; of a machine the path of a number, as stop.wall.gap
    #[arg(long, value_parser = varied(), value_name = "PARAMETER|PATH", help_heading = "Branch")]
    vary: Varied,

    /// The other end of its range; both ends, A,B, for a branch that is followed both ways from the system
    #[arg(long, value_name = "VALUE|A,B", allow_hyphen_values = true, help_heading = "Branch")]
    to: BranchEnds,

    /// A second parameter, or path, that varies with it in proportion, from its value in the system to this one when the first is
    /// at --to: the branch along any line through two parameters
    #[arg(long, value_name = "PARAMETER|PATH=VALUE", allow_hyphen_values = true, help_heading = "Branch")]
    also: Option<VariedNamed<Value>>,

    /// Follow up to this number of the branches that begin at flips and branch points, 0 to 100
    #[arg(long, value_parser = whole::<u32>, value_name = "N", default_value_t = 0, allow_hyphen_values = true, help_heading = "Branch")]
    follow: u32,

    /// Points of each branch at most, 2 to 100000
    #[arg(long, value_parser = whole::<u32>, value_name = "N", default_value_t = DEFAULT_BRANCH_POINTS, allow_hyphen_values = true, help_heading = "Branch")]
    points: u32,

    /// Leave out the simulation behind the figure
    #[arg(long, help_heading = "Output")]
    no_diagram: bool,

    /// Draw inadmissible solutions too, dotted. Not for a machine, whose branches end where an orbit ceases to be admissible
    #[arg(long = "virtual", conflicts_with = "machine", help_heading = "Output")]
    show_virtual: bool,

    #[command(flatten)]
    output: OutputArgs,
}

pub(super) fn run(args: &Branch, session: &Session) -> Result<(), Failure> {
    if args.output.plot.is_none() && (args.no_diagram || args.show_virtual) {
        return Err(Failure::bad("--no-diagram and --virtual say how the figure is drawn\nhint: --plot FILE"));
    }
    let shown = Shown { diagram: !args.no_diagram, inadmissible: args.show_virtual, ..Shown::default() };
    let varied = || core::iter::once(&args.vary).chain(args.also.iter().map(|also| &also.0));
    let oscillator = || args.system.over(&varied().map(Varied::parameter).collect::<Result<Vec<_>, _>>()?);
    let system = args.machine.or_oscillator(Some((&args.of_machine, None)), oscillator)?;
    let Target { parameter: vary, to } = system.target(&args.vary, args.to.to)?;
    let back = args.to.back.map(|back| system.target(&args.vary, back)).transpose()?;
    let task = BranchPlan {
        label: args.label.clone(),
        vary,
        to,
        back: back.map(|Target { to, .. }| to),
        also: system.also(args.also.as_ref())?,
        orbit: args.orbit,
        follow: args.follow,
        points: args.points,
    };
    let question = system.question(task)?;
    respond::run(&question, (&args.output, shown), None, session)
}

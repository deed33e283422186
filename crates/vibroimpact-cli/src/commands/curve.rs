//! `vibro curve`: a fold, flip or grazing impact of an orbit in a plane of two parameters.

use crate::args::{
    MachineArgs, OutputArgs, StartOfMachineArgs, SystemArgs, Varied, VariedOver, Words, of_oscillator, whole, word,
};
use crate::commands::respond;
use crate::failure::Failure;
use crate::session::Session;
use clap::Args;
use vibroimpact_report::Asked;
use vibroimpact_study::{CurvePlan, FollowedEvent, Parameter};

/// The curve of an event of an orbit over two parameters: fold, flip or grazing
///
/// The orbit is found at the given system and followed in the first parameter, to both ends of its range, while it keeps
/// its label. From an event of the given kind the curve is followed in both directions to the edge of the plane. Points
/// of codimension two are named: cusp, resonant grazing (curves of folds and flips end there), double grazing, degenerate
/// grazing, touch (beyond it the orbit is inadmissible), 1:2. The cycles of a grazing curve include the impact of speed
/// zero.
///
/// Of a machine any two numbers vary, by their paths. Its curves are those of folds, flips, torus bifurcations, grazing,
/// corners, at which two events happen at the same time, and of the begin and the end of sticking on a stop and of holding of
/// a friction joint. They end where the orbit ceases to be admissible.
#[derive(Clone, Debug, Args)]
#[command(
    override_usage = "vibro curve --beta B --gap D --restitution E --label m/n --kind KIND --vary PARAMETER=A:B --and PARAMETER=A:B [OPTIONS]\n       \
        vibro curve --machine NAME|FILE [--label m/n] --kind KIND --vary PATH=A:B --and PATH=A:B [OPTIONS]",
    after_help = "Examples: where 1/1 doubles its period; where it begins\n  \
        vibro curve --inverse-beta 1.11 --gap 1.5 --restitution 0.5 --label 1/1 \\\n    \
        --kind flip --vary gap=0:3 --and inverse-beta=1.05:1.2 --plot flip.png\n  \
        vibro curve --inverse-beta 0.7 --gap 2 --restitution 0.5 --label 1/1 \\\n    \
        --kind fold --vary gap=1:5 --and inverse-beta=0.6:0.9 --csv fold.csv\n  \
        vibro curve --machine bouncing-ball --set Gamma=1.2 --label 1/1 \\\n    \
        --kind flip --vary Gamma=0.2:4 --and e=0.2:0.9",
    mut_arg("csv", |arg| arg.help(
        "Write one row a point to this file; - for stdout. Columns: both parameters, label, admissible, event, \
        real and imaginary part of the multipliers, phases, speeds and stops of the closings (lists with blanks \
        between); of a machine also the stop of the event, the residual of the condition and the phase of the \
        touch"
    )),
    mut_arg("plot", |arg| arg.help("Draw the curve into this file, .svg, .png or .pdf"))
)]
pub(crate) struct Curve {
    #[command(flatten)]
    system: SystemArgs,
    #[command(flatten)]
    machine: MachineArgs,
    #[command(flatten)]
    of_machine: StartOfMachineArgs,

    /// m impacts in n forcing periods, for example 2/1, or m/T of a machine without forcing: the orbit at the system given
    /// [default for a machine: the motion from the start]
    #[arg(
        long,
        value_name = "m/n",
        allow_hyphen_values = true,
        required_unless_present = "machine",
        help_heading = "Curve"
    )]
    label: Option<String>,

    /// Which of several orbits, as `vibro orbit` numbers them [default: the stable one, else the fastest motion]
    #[arg(long, value_parser = whole::<u32>, value_name = "K", allow_hyphen_values = true, help_heading = "Curve")]
    orbit: Option<u32>,

    /// What holds along the curve
    #[arg(long, value_parser = word(&KINDS), value_name = "KIND", help_heading = "Curve")]
    kind: FollowedEvent,

    /// The parameter in which the orbit is followed to the event, and its range; of a machine the path of a number
    #[arg(long, value_name = "PARAMETER|PATH=A:B", help_heading = "Curve")]
    vary: VariedOver,

    /// The other parameter and its range
    #[arg(long, value_name = "PARAMETER|PATH=A:B", help_heading = "Curve")]
    and: VariedOver,

    /// Which of several events, counted from 1 from small values to large [default: the nearest]
    #[arg(long, value_parser = whole::<u32>, value_name = "K", allow_hyphen_values = true, help_heading = "Curve")]
    event: Option<u32>,

    /// Points in each direction at most, 2 to 100000 [default: 20000; of a machine 5000]
    #[arg(long, value_parser = whole::<u32>, value_name = "N", allow_hyphen_values = true, help_heading = "Curve")]
    points: Option<u32>,

    #[command(flatten)]
    output: OutputArgs,
}

const KINDS: Words<FollowedEvent, 7> = [
    ("fold", FollowedEvent::Fold, "A multiplier is +1: two orbits meet"),
    ("flip", FollowedEvent::Flip, "A multiplier is -1: the period doubles"),
    (
        "grazing",
        FollowedEvent::Grazing,
        "An impact has speed zero: one appears, disappears, or the mass no longer reaches the stop",
    ),
    ("torus", FollowedEvent::Torus, "Of a machine: a pair of complex multipliers lies on the unit circle"),
    ("corner", FollowedEvent::Corner, "Of a machine: two events happen at the same time"),
    ("sticking", FollowedEvent::Sticking, "Of a machine: sticking on a stop begins or ends"),
    ("holding", FollowedEvent::Holding, "Of a machine: holding of a friction joint begins or ends"),
];

impl Curve {
    /// The oscillator, and both parameters in which its curve is followed.
    fn oscillator(&self) -> Result<(Asked, [Parameter; 2]), Failure> {
        use FollowedEvent as Kind;
        if let Kind::Torus | Kind::Corner | Kind::Sticking | Kind::Holding = self.kind {
            return Err(Failure::bad(
                "torus, corner, sticking and holding are curves of machines\nhint: --machine NAME|FILE",
            ));
        }
        let varied = [self.vary.0.parameter()?, self.and.0.parameter()?];
        let mut asked = self.system.over(&varied)?;
        let parameters = of_oscillator(&mut asked, &varied);
        Ok((asked, [parameters[0], parameters[1]]))
    }
}

pub(super) fn run(args: &Curve, session: &Session) -> Result<(), Failure> {
    let mut varied = [args.vary.0.clone(), args.and.0.clone()];
    let oscillator = || {
        let (asked, parameters) = args.oscillator()?;
        varied = parameters.map(Varied::Parameter);
        Ok(asked)
    };
    let system = args.machine.or_oscillator(Some((&args.of_machine, None)), oscillator)?;
    let [vary, and] = &varied;
    let task = CurvePlan {
        label: args.label.clone(),
        kind: args.kind,
        vary: system.stretch(vary, args.vary.ends())?,
        and: system.stretch(and, args.and.ends())?,
        orbit: args.orbit,
        event: args.event,
        points: args.points,
    };
    respond::ask(&system.question(task)?, &args.output, None, session)
}

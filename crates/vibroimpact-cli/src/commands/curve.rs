//! `vibro curve`: a fold, flip or grazing impact of an orbit in a plane of two parameters.

use crate::args::{
    MachineArgs, Named, OutputArgs, Over, StartOfMachineArgs, SystemArgs, VariedOver, of_oscillator, whole,
};
use crate::commands::outputs::Outputs;
use crate::commands::{of_machine, respond};
use crate::failure::Failure;
use crate::session::Session;
use clap::{Args, ValueEnum};
use vibroimpact_report::{Shown, Units};
use vibroimpact_study::{
    CurvePlan, DEFAULT_BRANCH_POINTS, FollowedEvent, MachineCurvePlan, MachineFollowedEvent, MachineTask, Parameter,
    Plan, Stretch, Task,
};

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
    #[arg(long, value_enum, value_name = "KIND", help_heading = "Curve")]
    kind: Kind,

    /// The parameter in which the orbit is followed to the event, and its range; of a machine the path of a number
    #[arg(long, value_name = "PARAMETER|PATH=A:B", help_heading = "Curve")]
    vary: VariedOver,

    /// The other parameter and its range
    #[arg(long, value_name = "PARAMETER|PATH=A:B", help_heading = "Curve")]
    and: VariedOver,

    /// Which of several events, counted from 1 from small values to large [default: the nearest]
    #[arg(long, value_parser = whole::<u32>, value_name = "K", allow_hyphen_values = true, help_heading = "Curve")]
    event: Option<u32>,

    /// Points in each direction at most, 2 to 100000, for a machine
    #[arg(long, value_parser = whole::<u32>, value_name = "N", requires = "machine", allow_hyphen_values = true, help_heading = "Curve")]
    points: Option<u32>,

    #[command(flatten)]
    output: OutputArgs,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Kind {
    /// A multiplier is +1: two orbits meet
    Fold,
    /// A multiplier is -1: the period doubles
    Flip,
    /// An impact has speed zero: one appears, disappears, or the mass no longer reaches the stop
    Grazing,
    /// Of a machine: a pair of complex multipliers lies on the unit circle
    Torus,
    /// Of a machine: two events happen at the same time
    Corner,
    /// Of a machine: sticking on a stop begins or ends
    Sticking,
    /// Of a machine: holding of a friction joint begins or ends
    Holding,
}

impl Curve {
    fn plan(&self, (vary, and): (&Over, &Over), units: &Units, parameters: &[Parameter]) -> Result<CurvePlan, Failure> {
        let stretch = |k: usize, Named(_, range): &Over| {
            let (parameter, unit) = (parameters[k], units.of(parameters[k]));
            Stretch { parameter, from: range.0 / unit, to: range.1 / unit }
        };
        Ok(CurvePlan {
            label: self.label.clone().unwrap_or_default(),
            kind: match self.kind {
                Kind::Fold => FollowedEvent::Fold,
                Kind::Flip => FollowedEvent::Flip,
                Kind::Grazing => FollowedEvent::Grazing,
                Kind::Torus | Kind::Corner | Kind::Sticking | Kind::Holding => {
                    return Err(Failure::bad(
                        "torus, corner, sticking and holding are curves of machines\nhint: --machine NAME|FILE",
                    ));
                }
            },
            vary: stretch(0, vary),
            and: stretch(1, and),
            orbit: self.orbit,
            event: self.event,
        })
    }

    fn of_machine(&self) -> MachineTask {
        MachineTask::Curve(MachineCurvePlan {
            label: self.label.clone(),
            orbit: self.orbit,
            kind: match self.kind {
                Kind::Fold => MachineFollowedEvent::Fold,
                Kind::Flip => MachineFollowedEvent::Flip,
                Kind::Grazing => MachineFollowedEvent::Grazing,
                Kind::Torus => MachineFollowedEvent::Torus,
                Kind::Corner => MachineFollowedEvent::Corner,
                Kind::Sticking => MachineFollowedEvent::Sticking,
                Kind::Holding => MachineFollowedEvent::Holding,
            },
            vary: self.vary.stretch(),
            and: self.and.stretch(),
            event: self.event,
            points: self.points.unwrap_or(DEFAULT_BRANCH_POINTS),
        })
    }
}

pub(super) fn run(args: &Curve, session: &Session) -> Result<(), Failure> {
    let start = Some((&args.of_machine, None));
    let task = || Ok(args.of_machine());
    if let Some(answer) =
        of_machine::asked(&args.machine, start, task, args.output.files(), (None, |_| Ok(Shown::default())), session)
    {
        return answer;
    }
    let over = (args.vary.of_oscillator()?, args.and.of_oscillator()?);
    let varied = [over.0.0, over.1.0];
    let mut asked = args.system.over(&varied)?;
    let parameters = of_oscillator(&mut asked, &varied);
    let plan = Plan::new(asked.system, Task::Curve(args.plan((&over.0, &over.1), &asked.units, &parameters)?));
    plan.check()?;
    let outputs = Outputs::reserve(args.output.files(), session)?;
    respond::run(&plan, asked.units, (outputs, Shown::default()), None, session)
}

//! `vibro margins`: how far a periodic motion is from the events that end or change it.

use crate::args::{Named, OutputArgs, StartedArgs, Varied, VariedNamed, flag, number, varied, whole};
use crate::commands::respond;
use crate::failure::Failure;
use crate::session::Session;
use clap::Args;
use vibroimpact_report::Asked;
use vibroimpact_study::{DEFAULT_LINES, DEFAULT_WITHIN, MarginsPlan, Parameter, ScaledParameter, StartPlan, Variable};

/// How far a motion is from the events that end or change it
///
/// The periodic motion from a start, or with a label, is followed in each parameter alone, up and down, to the nearest
/// event: a fold, a flip, a grazing impact, the end of sticking. The distance is given in the units of the parameter and
/// relative to its value. Events are looked for up to an end of the range of --within.
///
/// Then the largest box of all parameters together is looked for in which the motion with its label is stable: each
/// parameter lies within one multiple of its scale from its value. It is found by trying: the motion is carried along
/// lines from the centre to the surface of the box, so events between the lines may be missed.
///
/// A system in physical units has its results in SI units. A machine has no box.
#[derive(Clone, Debug, Args)]
#[command(
    override_usage = "vibro margins --beta B --gap D --restitution E [--x X --v V --phase P | --label m/n] [OPTIONS]\n       \
        vibro margins --machine NAME|FILE [--set PATH=VALUE] [--q A,B --qdot A,B | --label m/n] [OPTIONS]",
    after_help = "Examples:\n  \
        vibro margins --inverse-beta 1.11 --gap 1.5 --restitution 0.5\n  \
        vibro margins --inverse-beta 1.11 --gap 1.5 --restitution 0.5 --label 1/1 \\\n    \
        --vary gap,restitution --scale gap=0.05 --csv margins.csv\n  \
        vibro margins --mass-kg 0.8 --stiffness-n-per-m 12000 --force-n 30 \\\n    \
        --damping-ratio 0.02 --gap-m 0.0015 --restitution 0.65 --frequency-hz 20\n  \
        vibro margins --machine two-mass-hammer --vary frequency,stop.anvil.gap",
    mut_arg("plot", |arg| arg.help(
        "Draw the change of each parameter to its nearest events as bars into this file, .svg, .png or .pdf"
    )),
    mut_arg("csv", |arg| arg.help(
        "Write one row for each parameter and direction to this file; - for stdout. Columns: parameter, value, \
        direction, limit, at, distance, relative, event, before, after; without an event the last six are empty"
    ))
)]
pub(crate) struct Margins {
    #[command(flatten)]
    of: StartedArgs,

    /// m/n of the motion instead of a start: the stable orbit, else the fastest one
    #[arg(long, value_name = "m/n", allow_hyphen_values = true, help_heading = "Margins")]
    label: Option<String>,

    /// The parameters that vary, separated by commas; of a machine paths, as stop.wall.gap [default: all of the system; of a machine
    /// its parameters, and the numbers that are written in its file and are not 0]
    #[arg(long, value_delimiter = ',', value_parser = varied(), value_name = "PARAMETERS|PATHS", help_heading = "Margins")]
    vary: Vec<Varied>,

    /// The change of a parameter that counts as 1 in the box [default: its value]; may be repeated
    #[arg(
        long,
        value_name = "PARAMETER=VALUE",
        allow_hyphen_values = true,
        conflicts_with = "machine",
        help_heading = "Margins"
    )]
    scale: Vec<VariedNamed<f64>>,

    /// Events are looked for from each value divided by this number to the value times this number, above 1 and up to
    /// 100; a restitution from 0 to 1
    #[arg(long, value_parser = number, value_name = "FACTOR", default_value_t = DEFAULT_WITHIN, allow_hyphen_values = true, help_heading = "Margins")]
    within: f64,

    /// Lines from the centre of the box to scattered points of its surface, 0 to 100000, besides those to the centres of
    /// its faces and to its corners
    #[arg(long, value_parser = whole::<u32>, value_name = "N", default_value_t = DEFAULT_LINES, allow_hyphen_values = true, conflicts_with = "machine", help_heading = "Margins")]
    lines: u32,

    #[command(flatten)]
    output: OutputArgs,
}

pub(super) fn run(args: &Margins, session: &Session) -> Result<(), Failure> {
    let mut vary: Vec<ScaledParameter<Variable>> = Vec::new();
    let oscillator = || {
        let (asked, varied) = args.varied()?;
        let name = |one: ScaledParameter| ScaledParameter { parameter: one.parameter.into(), scale: one.scale };
        vary = varied.into_iter().map(name).collect();
        Ok(asked)
    };
    let (system, start) = args.of.asked_as(oscillator)?;
    let path = |varied: &Varied| ScaledParameter { parameter: Variable::Path(varied.path()), scale: None };
    let machine = system.is_machine();
    if machine {
        vary = args.vary.iter().map(path).collect();
    }
    if args.label.is_some() && start.is_some_and(|start| start != StartPlan::default()) {
        return Err(Failure::bad("--label cannot go together with a start\nhint: --label, or --x, --v and --phase"));
    }
    let lines = (!machine).then_some(args.lines);
    let task = MarginsPlan { start, label: args.label.clone(), vary, within: args.within, lines };
    respond::ask(&system.question(task)?, &args.output, None, session)
}

impl Margins {
    /// The system with its units, and the parameters that vary; none stands for all.
    fn varied(&self) -> Result<(Asked, Vec<ScaledParameter>), Failure> {
        let body = self.of.system().is_body();
        let asked = if body { self.of.system().in_si().asked()? } else { self.of.system().asked()? };
        let known = MarginsPlan::parameters(&asked.system);
        let vary = self.vary.iter().map(Varied::parameter).collect::<Result<Vec<Parameter>, Failure>>()?;
        let scales = self.scale.iter().map(VariedNamed::of_oscillator).collect::<Result<Vec<Named<f64>>, Failure>>()?;
        let named = vary.iter().chain(scales.iter().map(|Named(named, _)| named));
        let nondimensional = |of: &Parameter| {
            matches!(
                of,
                Parameter::Beta | Parameter::InverseBeta | Parameter::Gap | Parameter::SecondGap | Parameter::Damping
            )
        };
        if let Some(wrong) = named.clone().find(|named| body && nondimensional(named)) {
            return Err(Failure::bad(format!(
                "{} is nondimensional, and margins of a system in physical units are in SI units\nhint: {}",
                flag(*wrong),
                match wrong {
                    Parameter::Gap => "gap-m",
                    Parameter::SecondGap => "second-gap-m",
                    Parameter::Damping => "damping-ratio",
                    _ => "frequency-hz",
                }
            )));
        }
        let parameters = if vary.is_empty() { known } else { vary };
        let scale = |parameter| {
            let of = |Named(named, value): &Named<f64>| (*named == parameter).then_some(*value);
            scales.iter().rev().find_map(of).map(|value| value / asked.units.of(parameter))
        };
        let unknown = |Named(named, _): &&Named<f64>| !parameters.contains(named);
        if let Some(Named(named, _)) = scales.iter().find(unknown) {
            return Err(Failure::bad(format!(
                "--scale {0} has no effect: {0} does not vary\nhint: --vary",
                flag(*named)
            )));
        }
        let scaled = |parameter: &Parameter| ScaledParameter { parameter: *parameter, scale: scale(*parameter) };
        let all = self.vary.is_empty() && self.scale.is_empty();
        Ok((asked, if all { Vec::new() } else { parameters.iter().map(scaled).collect() }))
    }
}

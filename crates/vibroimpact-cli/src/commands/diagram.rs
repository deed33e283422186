//! `vibro diagram`: the orbit diagram, the motion after its transient at each value of a parameter.

use crate::args::{
    AskedSystem, Ends, MachineArgs, Named, OutputArgs, Question, StartOfMachineArgs, StoreArgs, SystemArgs, Varied,
    VariedNamed, axis_values, number, quantity, varied, whole,
};
use crate::commands::outputs::Outputs;
use crate::commands::respond;
use crate::failure::Failure;
use crate::session::Session;
use clap::{Args, ValueEnum};
use vibroimpact_report::number::short;
use vibroimpact_report::scene::{BifurcationDiagram, BifurcationEvent, bifurcation, machine_bifurcation};
use vibroimpact_report::{AnswerError, Asked, Told, Units, Varied as _};
use vibroimpact_study::diagram::{DEFAULT_KEEP, DEFAULT_TRANSIENT, Show, ShowText, SweepDirection};
use vibroimpact_study::{DiagramPlan, PlanError, System, Task, Values, Variable};

/// The orbit diagram: impacts or states after the transient, over one parameter or along a line through two
///
/// The parameter that varies is left out of the system (a body in physical units is given completely, and the value is
/// replaced).
///
/// A sweep starts at rest and carries the state from value to value, so sweeps up and down differ where motions coexist.
/// A mass on the stop stays on it when the gap changes; a mass beyond the moved stop is put on the stop. Motions without
/// impacts are carried too.
///
/// Kinds of rows: impact; chatter (the end of infinitely many impacts, at velocity 0); and without numbers none (no more
/// impacts), stuck (sticks for ever), undecided (the search ran out of steps). In a stroboscopic diagram the kind says
/// whether the motion strikes in the periods shown. A motion that repeats to within 1e-9 is shown once.
///
/// Without --csv, --plot or --json the command prints a summary.
#[derive(Clone, Debug, Args)]
#[command(
    override_usage = "vibro diagram --inverse-beta X --restitution E --vary gap --over A:B:N [OPTIONS]\n       \
        vibro diagram --machine NAME|FILE --vary PATH --over A:B:N [OPTIONS]",
    after_help = "Examples:\n  \
        vibro diagram --inverse-beta 1.3 --restitution 0.5 --vary gap --over 0:3:601 \\\n    \
        --csv gap.csv --plot gap.png\n  \
        vibro diagram --gap 0 --restitution 0.8 --vary beta --over 2.5:3:401 \\\n    \
        --direction scatter --starts 20 --plot beta.png\n  \
        vibro diagram --beta 0.9 --gap 2 --damping 0.05 --vary restitution \\\n    \
        --over 0:1:201 --show strobe --csv strobe.csv\n  \
        vibro diagram --inverse-beta 1.3 --restitution 0.5 --vary gap \\\n    \
        --over 0:3:301 --show impact-speed-max --plot speed.png\n  \
        vibro diagram --restitution 0.5 --vary inverse-beta --over 1.05:1.15:401 \\\n    \
        --also gap=1.5:3 --plot line.png\n  \
        vibro diagram --machine two-mass-hammer --vary frequency \\\n    \
        --over 0.7:1.3:61 --branches --plot frequency.png",
    mut_arg("csv", |arg| arg.help(
        "Write one row a point to this file; - for stdout. Columns: the parameter, that of --also, sweep, kind, \
        stop, phase, speed; for strobe the parameters, sweep, kind, x, v; for a quantity the parameters, sweep, \
        kind, its value"
    )),
    mut_arg("plot", |arg| arg.help("Draw the diagram into this file, .svg, .png or .pdf"))
)]
pub(crate) struct Diagram {
    #[command(flatten)]
    system: SystemArgs,
    #[command(flatten)]
    machine: MachineArgs,
    #[command(flatten)]
    of_machine: StartOfMachineArgs,

    /// Phase of the forcing at the start of a machine, radians [default: that of the machine file, or 0]
    #[arg(long, value_parser = number, value_name = "P", allow_hyphen_values = true, requires = "machine", help_heading = "Machine")]
    phase: Option<f64>,

    /// The parameter that varies, or the path of a number of the machine
    #[arg(long, value_parser = varied(), value_name = "PARAMETER", help_heading = "Sweep")]
    vary: Varied,

    /// Its values: A:B:N is N values from A to B, both included, A:B:N:log is N values in equal ratios, and A,B,C is a list of rising or
    /// falling values
    #[arg(long, value_parser = axis_values, value_name = "A:B:N", allow_hyphen_values = true, help_heading = "Sweep")]
    over: Values,

    /// A second parameter, or path, that varies with it in proportion, from A at its first value to B at its last: the diagram
    /// along any line through two parameters
    #[arg(long, value_name = "PARAMETER|PATH=A:B", allow_hyphen_values = true, help_heading = "Sweep")]
    also: Option<VariedNamed<Ends>>,

    /// From which starts
    #[arg(long, value_enum, value_name = "DIRECTION", default_value_t = Way::Both, help_heading = "Sweep")]
    direction: Way,

    /// Scattered starts at each value, 1 to 1e9 [default: 8]
    #[arg(long, value_parser = whole::<u64>, value_name = "N", allow_hyphen_values = true, help_heading = "Sweep")]
    starts: Option<u64>,

    /// Which sequence of scattered starts [default: 1]
    #[arg(long, value_parser = whole::<u64>, value_name = "S", help_heading = "Sweep")]
    seed: Option<u64>,

    /// What is shown: velocity (phase and speed of arrival of each impact), strobe (position and velocity once in every
    /// forcing period, at phase 0), or a quantity of the settled motion by name, one value of each motion: impact-speed-max,
    /// power and others, as in --fields of `vibro map`. Of a machine speed (phase and speed of each closing of a stop; the
    /// default), or q.NAME or qdot.NAME, a coordinate or velocity once in every forcing period, at phase 0
    #[arg(long, value_name = "WHAT", help_heading = "Sweep")]
    show: Option<String>,

    /// Impacts (velocity) or forcing periods (strobe) to pass before anything is shown, up to 1000000
    #[arg(long, value_parser = whole::<u64>, value_name = "K", default_value_t = DEFAULT_TRANSIENT, allow_hyphen_values = true, help_heading = "Sweep")]
    transient: u64,

    /// Impacts or states to show at each value at most, 1 to 100000
    #[arg(long, value_parser = whole::<u64>, value_name = "K", default_value_t = DEFAULT_KEEP, allow_hyphen_values = true, help_heading = "Sweep")]
    keep: u64,

    /// Follow the periodic motions on the line through their folds, flips and grazing impacts too: their branches are drawn over
    /// the diagram, and in the table. Labels, separated by commas [default: those found on the line]
    #[arg(long, value_name = "LABELS", num_args = 0..=1, value_delimiter = ',', default_missing_value = "", conflicts_with_all = ["store", "json"], help_heading = "Sweep")]
    branches: Option<Vec<String>>,

    #[command(flatten)]
    store: StoreArgs,

    #[command(flatten)]
    output: OutputArgs,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Way {
    /// Rising values, each from the state the one before led to
    Up,
    /// Falling values
    Down,
    /// One sweep up and one down
    Both,
    /// Several scattered starts at each value
    Scatter,
}

/// What is shown of an oscillator.
fn what(text: Option<&str>) -> Result<Show, Failure> {
    match text {
        None | Some("velocity") => Ok(Show::Velocity),
        Some("strobe") => Ok(Show::Strobe),
        Some(name) => quantity(name)
            .map(Show::Quantity)
            .map_err(|why| Failure::bad(format!("--show: {why}; besides these, velocity and strobe"))),
    }
}

impl Diagram {
    fn direction(&self) -> Result<SweepDirection, Failure> {
        if self.direction != Way::Scatter && (self.starts.is_some() || self.seed.is_some()) {
            return Err(Failure::bad("--starts and --seed belong to --direction scatter"));
        }
        Ok(match self.direction {
            Way::Up => SweepDirection::Up,
            Way::Down => SweepDirection::Down,
            Way::Both => SweepDirection::Both,
            Way::Scatter => SweepDirection::Scatter { starts: self.starts.unwrap_or(8), seed: self.seed.unwrap_or(1) },
        })
    }
}

/// The labels of `--branches`; `None` for those found on the line.
fn given(labels: &[String]) -> Option<Vec<String>> {
    let given: Vec<String> = labels.iter().filter(|label| !label.is_empty()).cloned().collect();
    (!given.is_empty()).then_some(given)
}

/// A line for each event, with the column of what varies and its unit.
fn listed(events: &[BifurcationEvent], (column, unit): (&str, f64)) -> String {
    let row = |event: &BifurcationEvent| {
        format!("{} of {} at {column} = {}\n", event.kind, event.label, short(event.value * unit))
    };
    events.iter().map(row).collect()
}

impl Diagram {
    /// The oscillator, whose parameters that vary have their first values.
    fn oscillator(&self) -> Result<Asked, Failure> {
        let first = (self.vary.parameter()?, self.over.ends().0, ["vary", "over"]);
        let also = self.also.as_ref().map(VariedNamed::of_oscillator).transpose()?;
        let second = also.map(|Named(named, ends)| (named, ends.0, ["also", "also"]));
        self.system.varied(&[first].into_iter().chain(second).collect::<Vec<_>>())
    }

    /// The plan of a diagram of this system.
    fn plan(&self, system: &AskedSystem<'_>) -> Result<DiagramPlan<Variable, ShowText>, Failure> {
        let show = match &self.show {
            Some(path) if system.is_machine() => ShowText::Word(path.clone()),
            None if system.is_machine() => ShowText::Word("speed".to_owned()),
            text => what(text.as_deref())?.into(),
        };
        let (vary, unit) = system.variable(&self.vary)?;
        Ok(DiagramPlan {
            vary,
            over: if system.is_machine() { self.over.clone() } else { self.over.scaled(unit)? },
            also: system.ends(self.also.as_ref())?,
            show,
            direction: self.direction()?,
            transient: self.transient,
            keep: self.keep,
        })
    }
}

pub(super) fn run(args: &Diagram, session: &Session) -> Result<(), Failure> {
    let system = args.machine.or_oscillator(Some((&args.of_machine, args.phase)), || args.oscillator())?;
    let task = args.plan(&system)?;
    if args.store.store.is_some() && matches!(task.show, ShowText::Quantity { .. }) {
        return Err(PlanError::NoStoredQuantity.into());
    }
    let question = system.stored(task, Some(&args.store))?;
    if let Some(labels) = &args.branches {
        let outputs = Outputs::reserve(args.output.files(), session)?;
        return with_branches(&question, given(labels).as_deref(), outputs, session);
    }
    respond::ask(&question, &args.output, Some(&args.store), session)
}

/// The diagram with the branches of these labels; without labels of those found on the line.
fn with_branches(
    question: &Question<'_>,
    labels: Option<&[String]>,
    outputs: Outputs,
    session: &Session,
) -> Result<(), Failure> {
    let (plan, units) = (&question.plan, question.units);
    let silent = outputs.any();
    let text = match (&plan.system, &plan.task) {
        (System::Oscillator(system), Task::Diagram(task)) => {
            let task: DiagramPlan = task.typed()?;
            if matches!(task.show, Show::Quantity(_)) {
                return Err(Failure::bad("--branches has speeds or positions\nhint: --show velocity or --show strobe"));
            }
            let asked = Asked { system: *system, units };
            let found = session.watched(None, |control| bifurcation(&asked, &task, labels, control));
            written(found, &units, outputs, session)?
        }
        _ => {
            let name = question.machine.unwrap_or_default();
            let found = session.watched(None, |control| machine_bifurcation(name, plan, labels, control));
            written(found, &Units::default(), outputs, session)?
        }
    };
    if silent { Ok(()) } else { session.print(&text) }
}

/// Writes the files of a diagram with branches. Returns its events as text.
fn written<D: Told>(
    found: Result<BifurcationDiagram<D>, AnswerError>,
    units: &Units,
    outputs: Outputs,
    session: &Session,
) -> Result<String, Failure> {
    let found = found.map_err(|error| respond::stopped(error, None))?;
    outputs.write(session, || Ok(found.table()?), || Ok(found.figure()?))?;
    let vary = &found.behind.plan.vary;
    Ok(listed(&found.events(), (vary.column(units), vary.unit(units))))
}

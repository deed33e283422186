//! `vibro settle-many`: the motions at many points of parameters and starts, listed or drawn.

use crate::args::{
    BodyArgs, Convention, FieldsArgs, MachineArgs, NumbersArgs, OutputArgs, Ranged, StartOfMachineArgs, StoreArgs,
    VariedOver, place, ranges, whole,
};
use crate::commands::outputs::Outputs;
use crate::commands::{respond, stored};
use crate::failure::Failure;
use crate::points_file;
use crate::session::Session;
use clap::Args;
use std::path::PathBuf;
use vibroimpact_report::{Asked, Shown, Units, Varied};
use vibroimpact_study::{
    BasinPlan, Coordinate, DrawnPoints, ListedColumn, ManyPlan, Parameter, PointRange, PointRule, PointsPlan,
    StartPlan, Task,
};

/// Which motion each of many systems and starts leads to: points from a table, or drawn from ranges
///
/// --points FILE is a table with a header: a column for each parameter and coordinate of the start that varies. --sample
/// draws points from the ranges A:B of parameters and starts, by Sobol's sequence or as a Latin hypercube. What is in no
/// column and has no range is the same at all points. Without --csv, --plot or --json the command prints the shares of the motions.
#[derive(Clone, Debug, Args)]
#[command(
    mut_args(ranges),
    mut_arg("csv", |arg| arg.help(
        "Write one row a point to this file; - for stdout. Columns: what varies, then label, and --fields"
    )),
    mut_arg("plot", |arg| arg.help(
        "Draw the label of each point over the two numbers that vary first into this file, .svg, .png or .pdf"
    )),
    override_usage = "vibro settle-many --sample lhs:N --inverse-beta A:B --gap A:B --restitution E [OPTIONS]\n       \
        vibro settle-many --points FILE.csv --restitution E [OPTIONS]\n       \
        vibro settle-many --machine NAME|FILE --sample lhs:N --over PATH=A:B [--over PATH=A:B] [OPTIONS]",
    after_help = "Examples:\n  \
        vibro settle-many --sample lhs:2000 --inverse-beta 0.6:2 --gap 0:2 \\\n    \
        --restitution 0.3:0.8 --v 0.5 --csv sample.csv\n  \
        vibro settle-many --sample sobol:65536 --beta 1 --gap 1 --restitution 0.5 \\\n    \
        --x -4:1 --v -4:4 --store starts.zarr\n  \
        vibro settle-many --points systems.csv --restitution 0.5 \\\n    \
        --fields impact-speed-max --csv -\n  \
        vibro settle-many --machine two-mass-hammer --sample sobol:64 \\\n    \
        --over frequency=0.9:1.3 --over q.head=-1:0.4 --csv -"
)]
#[command(group = clap::ArgGroup::new("of_points").required(true).args(["points", "sample"]))]
pub(crate) struct SettleMany {
    /// A table of points, comma-separated, with the names of what varies in its first line; - for stdin
    #[arg(long, value_name = "FILE", help_heading = "Points")]
    points: Option<PathBuf>,

    /// Draw N points from the ranges: by Sobol's sequence, or as a Latin hypercube
    #[arg(long, value_parser = drawn, value_name = "sobol:N|lhs:N", help_heading = "Points")]
    sample: Option<Drawn>,

    /// Which of the sequences of --sample
    #[arg(long, value_parser = whole::<u64>, value_name = "S", default_value_t = 0, help_heading = "Points")]
    seed: u64,

    #[command(flatten, next_help_heading = "System")]
    system: NumbersArgs,

    #[command(flatten)]
    body: BodyArgs,
    #[command(flatten)]
    of_machine: MachineArgs,
    #[command(flatten)]
    start_of_machine: StartOfMachineArgs,

    /// What is drawn for a machine, once for each: the path of a number, or q.NAME, qdot.NAME and phase of the start, and its range
    #[arg(long, value_name = "PATH=A:B", allow_hyphen_values = true, requires = "machine", help_heading = "Machine")]
    over: Vec<VariedOver>,

    /// Units of ranges, columns and results
    #[arg(long, value_enum, value_name = "UNITS", default_value_t = Convention::Nondimensional, help_heading = "System")]
    units: Convention,

    /// Position, a value or a range A:B [default: 0, or on the stop when the gap is negative]
    #[arg(long, value_parser = place, value_name = "X", allow_hyphen_values = true, help_heading = "Starts")]
    x: Option<Ranged>,

    /// Velocity, a value or a range A:B [default: 0]
    #[arg(long, value_parser = place, value_name = "V", allow_hyphen_values = true, help_heading = "Starts")]
    v: Option<Ranged>,

    /// Phase of the force in radians, a value or a range A:B [default: 0]
    #[arg(long, value_parser = place, value_name = "P", allow_hyphen_values = true, help_heading = "Starts")]
    phase: Option<Ranged>,

    /// Budget of impacts for each start, 1 to 1000000; what is not settled by then is undecided
    #[arg(long, value_parser = whole::<u32>, value_name = "N", allow_hyphen_values = true, help_heading = "Starts")]
    impacts: Option<u32>,

    #[command(flatten)]
    store: StoreArgs,

    #[command(flatten)]
    fields: FieldsArgs,

    /// Report the number of impacts after which each motion was decided too
    #[arg(long, help_heading = "Output")]
    transient: bool,

    #[command(flatten)]
    output: OutputArgs,
}

/// The rule of a sample, and its number of points.
type Drawn = (PointRule, u64);

/// Reads `sobol:N` or `lhs:N`.
fn drawn(text: &str) -> Result<Drawn, String> {
    let shown: String = text.chars().take(60).collect();
    let (rule, count) = text.split_once(':').ok_or_else(|| format!("`{shown}` is not sobol:N or lhs:N"))?;
    let rule = match rule.trim() {
        "sobol" => PointRule::Sobol,
        "lhs" => PointRule::Lhs,
        other => return Err(format!("`{other}` is neither sobol nor lhs")),
    };
    Ok((rule, whole(count.trim())?))
}

impl SettleMany {
    /// The points of a machine.
    fn points_of_machine(&self) -> Result<PointsPlan<String>, Failure> {
        match (&self.points, self.sample) {
            (Some(path), _) => Ok(PointsPlan::Listed(points_file::read_for_machine(path)?)),
            (None, Some((rule, count))) => {
                let range = |over: &VariedOver| {
                    let (from, to) = over.ends();
                    PointRange { vary: over.0.path(), from, to }
                };
                if self.over.is_empty() {
                    return Err(Failure::bad(
                        "nothing varies\nhint: --over PATH=A:B, such as --over frequency=0.9:1.3",
                    ));
                }
                let over = self.over.iter().map(range).collect();
                Ok(PointsPlan::Drawn(DrawnPoints { rule, count, seed: self.seed, over }))
            }
            (None, None) => Err(without_points()),
        }
    }

    fn starts(&self) -> impl Iterator<Item = (Coordinate, &Ranged)> {
        let all = [(Coordinate::X, &self.x), (Coordinate::V, &self.v), (Coordinate::Phase, &self.phase)];
        all.into_iter().filter_map(|(vary, given)| Some((vary, given.as_ref()?)))
    }

    /// The coordinates that are the same at all points.
    fn start(&self, units: &Units) -> StartPlan {
        let at = |given: &Option<Ranged>| given.as_ref().filter(|given| given.is_one()).map(Ranged::first);
        StartPlan {
            x: at(&self.x).map(|x| x / units.length()),
            v: at(&self.v).unwrap_or(0.0) / units.velocity(),
            phase: at(&self.phase).unwrap_or(0.0),
        }
    }

    /// The system and the points of a table.
    fn listed(&self, columns: Vec<ListedColumn>) -> Result<(Asked, PointsPlan), Failure> {
        let of_system = self.system.given().map(|(parameter, _)| Coordinate::Parameter(parameter));
        let flags: Vec<Coordinate> = self.starts().map(|(vary, _)| vary).chain(of_system).collect();
        let same = |a: Coordinate, b: Coordinate| match (a, b) {
            (Coordinate::Parameter(a), Coordinate::Parameter(b)) => a.same_number(b),
            (a, b) => a == b,
        };
        for column in &columns {
            if let Some(flag) = flags.iter().find(|flag| same(**flag, column.vary)) {
                let (flag, name) = (flag.name().replace('_', "-"), column.vary.name());
                return Err(Failure::bad(format!(
                    "--{flag} cannot go together with the column {name}\nhint: leave it out, the table has its values"
                )));
            }
        }
        let first = |column: &ListedColumn| match (column.vary, column.values.first()) {
            (Coordinate::Parameter(parameter), Some(value)) => Some((parameter, *value)),
            _ => None,
        };
        let first: Vec<(Parameter, f64)> = columns.iter().filter_map(first).collect();
        let (asked, over) = self.asked(&first)?;
        let ranged = self.starts().find(|(_, given)| !given.is_one()).map(|(vary, _)| vary.name());
        if let Some(name) = over.first().map(|stretch| stretch.parameter.name()).or(ranged) {
            return Err(Failure::bad(format!(
                "--{} is a range, and points of a table have one value\nhint: --sample lhs:N draws points from ranges",
                name.replace('_', "-")
            )));
        }
        let scaled = |column: ListedColumn| {
            let unit = Varied::unit(&column.vary, &asked.units);
            ListedColumn { values: column.values.iter().map(|value| value / unit).collect(), ..column }
        };
        let columns = columns.into_iter().map(scaled).collect();
        Ok((asked, PointsPlan::Listed(columns)))
    }

    /// The system and the points that are drawn.
    fn drawn(&self, (rule, count): Drawn) -> Result<(Asked, PointsPlan), Failure> {
        let (asked, over) = self.asked(&[])?;
        let of_system = over.iter().map(|stretch| PointRange {
            vary: Coordinate::Parameter(stretch.parameter),
            from: stretch.from,
            to: stretch.to,
        });
        let of_starts = self.starts().filter_map(|(vary, given)| {
            let ((from, to), unit) = (given.ends()?, Varied::unit(&vary, &asked.units));
            Some(PointRange { vary, from: from / unit, to: to / unit })
        });
        let over: Vec<PointRange> = of_system.chain(of_starts).collect();
        if over.is_empty() {
            return Err(Failure::bad(
                "nothing varies\nhint: give a parameter or a start a range, --gap 0:5 or --v -1:1",
            ));
        }
        Ok((asked, PointsPlan::Drawn(DrawnPoints { rule, count, seed: self.seed, over })))
    }

    fn asked(&self, first: &[(Parameter, f64)]) -> Result<(Asked, Vec<vibroimpact_study::Stretch>), Failure> {
        self.system.over_ranges((&self.body, self.units), first, |_, as_they_are| as_they_are.to_vec())
    }
}

pub(super) fn run(args: &SettleMany, session: &Session) -> Result<(), Failure> {
    let mut points = None;
    let oscillator = || {
        let (asked, of_oscillator) = match (&args.points, args.sample) {
            (Some(path), _) => args.listed(points_file::read(path)?)?,
            (None, Some(drawn)) => args.drawn(drawn)?,
            (None, None) => return Err(without_points()),
        };
        points = Some(of_oscillator);
        Ok(asked)
    };
    let system = args.of_machine.or_oscillator(Some((&args.start_of_machine, None)), oscillator)?;
    let fields = system.paths(&args.fields)?;
    let task: Task = match points {
        Some(points) => {
            let task = BasinPlan { impacts: args.impacts, ..BasinPlan::of_points(points, args.start(&system.units())) };
            BasinPlan { fields: args.fields.quantities()?, transient: args.transient, ..task }.into()
        }
        None if args.transient => return Err(Failure::bad("--transient is for points of oscillators")),
        None => ManyPlan { points: args.points_of_machine()?, impacts: args.impacts, fields }.into(),
    };
    let question = system.stored(task, Some(&args.store))?;
    // the points of an oscillator are a study
    if question.machine.is_some() {
        return respond::ask(&question, &args.output, Some(&args.store), session);
    }
    let outputs = Outputs::reserve(args.output.files(), session)?;
    stored::filled(&question.plan, args.store.filling(), (outputs, Shown::default()), session)
}

fn without_points() -> Failure {
    Failure::bad("there are no points\nhint: --points FILE.csv, or --sample lhs:N")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rules_and_numbers_of_points() {
        assert_eq!(drawn("lhs:1e5"), Ok((PointRule::Lhs, 100_000)));
        assert_eq!(drawn("sobol: 64"), Ok((PointRule::Sobol, 64)));
        for bad in ["lhs", "grid:5", "lhs:", "sobol:1.5", ":5"] {
            assert!(drawn(bad).is_err(), "{bad}");
        }
    }
}

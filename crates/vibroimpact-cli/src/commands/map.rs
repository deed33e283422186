//! `vibro map`: which motions there are at each point of a plane of parameters.

use crate::args::{Ranged, StoreArgs};
use crate::commands::outputs::Outputs;
use crate::commands::stored;
use crate::exit::Failure;
use crate::plot;
use crate::report::csv::{self, Number};
use crate::report::json::{PROGRAM, Range};
use crate::report::stored::{LabelCount, label_table};
use crate::session::Session;
use clap::Args;
use serde::Serialize;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::PathBuf;
use vibroimpact_plot::{GROUPS, legend_group};
use vibroimpact_study::store::Part;
use vibroimpact_study::{
    Axis, Coordinate, MapPlan, MapPoint, Parameter, Plan, RegionMap, SecondStop, SystemPlan, Task, Values, map,
};

/// Which motions there are at each point of a plane of parameters
///
/// At each point so many starts are settled: the first from rest, the second on the motion
/// without stops if that clears them, the others scattered over a box around the motion.
/// One to four of the parameters take ranges, the others a value each: A:B:N is N values from A to B,
/// both included, A:B:N:log the same in equal ratios, and A,B,C these. The first of them runs to the right.
/// Without --csv, --plot or --json a summary is printed.
#[derive(Clone, Debug, Args)]
#[command(
    override_usage = "vibro map --inverse-beta A:B:N --gap A:B:N --restitution E --starts N [OPTIONS]",
    after_help = "Examples:\n  \
        vibro map --inverse-beta 0.4:2:33 --gap 0:5:41 --restitution 0.5 --starts 20 --csv map.csv --plot map.png\n  \
        vibro map --beta 0.1:10:60:log --restitution 0.2:0.9:40 --gap 1 --starts 8 --plot restitution.png\n  \
        vibro map --inverse-beta 0.4:2:800 --gap 0:5:800 --restitution 0.5 --starts 8 --store map.zarr --refine 8"
)]
pub(crate) struct Map {
    #[command(flatten)]
    plane: PlaneArgs,

    /// Starts at each point, 1 to 1e9
    #[arg(long, value_name = "N", allow_hyphen_values = true, help_heading = "Starts")]
    starts: u64,

    /// Which sequence of starts
    #[arg(long, value_name = "S", default_value_t = 1, help_heading = "Starts")]
    seed: u64,

    /// Follow each start for so many impacts at most, 1 to 1000000; what is not settled by then is undecided
    #[arg(long, value_name = "N", allow_hyphen_values = true, help_heading = "Starts")]
    impacts: Option<u32>,

    #[command(flatten)]
    store: StoreArgs,

    /// Compute every K-th point first, and those between only where neighbours differ; needs --store
    #[arg(long, value_name = "K", requires = "store", help_heading = "Store")]
    refine: Option<u32>,

    /// Write one row a motion to this file; - for stdout. Columns: what varies, then label, share
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    csv: Option<PathBuf>,

    /// Draw the map into this file, .svg or .png
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    plot: Option<PathBuf>,

    /// Print one JSON object with the labels and how often they occur
    #[arg(long, help_heading = "Output")]
    json: bool,
}

/// The parameters of a map, values or ranges.
#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "System and plane")]
struct PlaneArgs {
    /// Frequency ratio omega/omega_n, positive
    #[arg(long, value_name = "VALUES", allow_hyphen_values = true, conflicts_with = "inverse_beta")]
    beta: Option<Ranged>,

    /// Its inverse omega_n/omega instead, the abscissa of the 1971 paper; positive
    #[arg(long, value_name = "VALUES", allow_hyphen_values = true)]
    inverse_beta: Option<Ranged>,

    /// Gap, in units of F/k
    #[arg(long, value_name = "VALUES", allow_hyphen_values = true)]
    gap: Ranged,

    /// Restitution: rebound speed over arrival speed, 0 to 1
    #[arg(long, value_name = "VALUES", allow_hyphen_values = true)]
    restitution: Ranged,

    /// Damping ratio zeta, 0 or more [default: 0]
    #[arg(long, value_name = "VALUES", allow_hyphen_values = true)]
    damping: Option<Ranged>,

    /// A second stop on the other side, at x = -D2
    #[arg(long, value_name = "VALUES", allow_hyphen_values = true)]
    second_gap: Option<Ranged>,

    /// Restitution of the second stop [default: that of the first, if that is one value]
    #[arg(long, value_name = "VALUES", allow_hyphen_values = true, requires = "second_gap")]
    second_restitution: Option<Ranged>,
}

impl PlaneArgs {
    /// The parameters that were given, in the order of the axes.
    fn given(&self) -> impl Iterator<Item = (Parameter, &Ranged)> {
        let all = [
            (Parameter::Beta, self.beta.as_ref()),
            (Parameter::InverseBeta, self.inverse_beta.as_ref()),
            (Parameter::Gap, Some(&self.gap)),
            (Parameter::Restitution, Some(&self.restitution)),
            (Parameter::Damping, self.damping.as_ref()),
            (Parameter::SecondGap, self.second_gap.as_ref()),
            (Parameter::SecondRestitution, self.second_restitution.as_ref()),
        ];
        all.into_iter().filter_map(|(parameter, given)| Some((parameter, given?)))
    }

    fn system(&self) -> Result<SystemPlan, Failure> {
        let first = |given: &Option<Ranged>| given.as_ref().map(Ranged::first);
        let second_restitution = match (&self.second_restitution, &self.restitution) {
            (None, Ranged::Over(_)) if self.second_gap.is_some() => {
                return Err(Failure::bad(
                    "the restitution varies and that of the second stop is not given\nhint: --second-restitution E2",
                ));
            }
            (None, one) => one.first(),
            (Some(own), _) => own.first(),
        };
        Ok(SystemPlan {
            beta: first(&self.beta),
            inverse_beta: first(&self.inverse_beta),
            gap: self.gap.first(),
            restitution: self.restitution.first(),
            damping: first(&self.damping).unwrap_or(0.0),
            second_stop: first(&self.second_gap).map(|gap| SecondStop { gap, restitution: second_restitution }),
        })
    }

    fn axes(&self) -> Vec<Axis> {
        self.given().filter_map(|(parameter, given)| given.axis(parameter)).collect()
    }
}

#[derive(Serialize)]
struct Answer<'a> {
    system: serde_json::Map<String, Value>,
    #[serde(flatten)]
    axes: serde_json::Map<String, Value>,
    starts: u64,
    seed: u64,
    points: usize,
    coexisting: usize,
    labels: Vec<LabelCount>,
    plan: &'a Plan,
    program: &'static str,
}

/// What is the same at all points, and what varies.
fn objects(system: &SystemPlan, axes: &[Axis]) -> (serde_json::Map<String, Value>, serde_json::Map<String, Value>) {
    let mut fixed = serde_json::Map::new();
    for parameter in Parameter::ALL {
        let given = match parameter {
            Parameter::Beta => system.beta,
            Parameter::InverseBeta => system.inverse_beta,
            Parameter::SecondGap | Parameter::SecondRestitution => None,
            _ => system.value(parameter).ok(),
        };
        if let Some(value) = given.filter(|_| !axes.iter().any(|axis| axis.vary == Coordinate::Parameter(parameter))) {
            fixed.insert(parameter.name().to_owned(), value.into());
        }
    }
    if let Some(stop) = system.second_stop {
        fixed.insert("second_stop".into(), serde_json::json!({ "gap": stop.gap, "restitution": stop.restitution }));
    }
    let range = |axis: &Axis| match &axis.over {
        Values::Span(span) => serde_json::to_value(Range::new(span)).unwrap_or_default(),
        Values::Listed(values) => values.clone().into(),
    };
    (fixed, axes.iter().map(|axis| (axis.vary.name().to_owned(), range(axis))).collect())
}

pub(super) fn run(args: &Map, session: &Session) -> Result<(), Failure> {
    let (system, axes) = (args.plane.system()?, args.plane.axes());
    if axes.is_empty() {
        return Err(Failure::bad(
            "nothing varies\nhint: give one of the parameters a range, --gap 0:5:41; `vibro attractors` answers for one point",
        ));
    }
    let task = MapPlan { axes, starts: args.starts, seed: args.seed, refine: args.refine, impacts: args.impacts };
    let plan = args.store.tiled(Plan::new(system, Task::Map(task.clone())))?;
    let outputs = Outputs::reserve(args.csv.as_deref(), args.plot.as_deref(), args.json, session)?;
    outputs.drawable(&task.axes)?;
    if let Some(place) = &args.store.store {
        return stored::run(&plan, place, Part::ALL, outputs, session);
    }

    let total = task.points();
    let found = session.tiled(total, "points", |control, _| map(&system, &task, control))?;

    let silent = outputs.any();
    let names: Vec<&str> = task.axes.iter().map(|axis| axis.vary.name()).collect();
    outputs.write(
        session,
        |out| csv::write(out, &format!("{},label,share", names.join(",")), rows(&found)),
        || {
            let varied: Vec<Parameter> =
                args.plane.given().filter(|(p, g)| g.axis(*p).is_some()).map(|(p, _)| p).collect();
            let cell = |point: &MapPoint| plot::map::groups(point.motions.iter().map(|motion| motion.verdict.label()));
            let cells: Vec<Vec<usize>> = found.points.iter().map(cell).collect();
            plot::map::figure(&plot::stored::plane(&task.axes)?, &cells, plot::title_without(&system, &varied))
        },
    )?;
    let labels = counts(&found);
    let coexisting = found.points.iter().filter(|p| p.motions.len() > 1).count();
    if args.json {
        let (system, axes) = objects(&system, &task.axes);
        return session.print_json(&Answer {
            system,
            axes,
            starts: args.starts,
            seed: args.seed,
            points: found.points.len(),
            coexisting,
            labels,
            plan: &plan,
            program: PROGRAM,
        });
    }
    if silent {
        return Ok(());
    }
    session.print(&format!(
        "{} points, {} starts each; several motions coexist at {coexisting} of them\n\n{}",
        found.points.len(),
        args.starts,
        label_table(&labels)
    ))?;
    session.note("hint: --csv FILE keeps every point, --plot FILE.png draws them");
    Ok(())
}

fn rows(found: &RegionMap) -> impl Iterator<Item = String> + '_ {
    found.points.iter().flat_map(|point| {
        point.motions.iter().map(|motion| {
            let place: Vec<String> = point.at.iter().map(|at| Number(*at).to_string()).collect();
            format!("{},{},{}", place.join(","), motion.verdict.label(), Number(motion.share))
        })
    })
}

/// Labels in the order of a legend, then by name.
fn counts(found: &RegionMap) -> Vec<LabelCount> {
    let mut counts: BTreeMap<(usize, String), (u64, f64)> = BTreeMap::new();
    for point in &found.points {
        let mut here: Vec<String> = Vec::new();
        for motion in &point.motions {
            let label = motion.verdict.label().into_owned();
            let group = legend_group(&label);
            let rank = GROUPS.iter().position(|g| *g == group).unwrap_or(GROUPS.len());
            let entry = counts.entry((rank, label.clone())).or_default();
            entry.1 += motion.share;
            if !here.contains(&label) {
                entry.0 += 1;
                here.push(label);
            }
        }
    }
    #[allow(clippy::cast_precision_loss)] // at most 1e8
    let all = found.points.len() as f64;
    counts.into_iter().map(|((_, label), (points, share))| LabelCount { label, points, share: share / all }).collect()
}

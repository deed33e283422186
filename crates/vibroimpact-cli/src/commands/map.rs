//! `vibro map`: which motions there are at each point of the plane of inverse frequency and gap.

use crate::commands::outputs::Outputs;
use crate::exit::Failure;
use crate::plot;
use crate::report::csv::{self, Number};
use crate::report::json::{PROGRAM, Range, SecondStop as StopObject};
use crate::report::text::{percent, short, table};
use crate::session::Session;
use clap::Args;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::PathBuf;
use vibroimpact::verdict::SettleOptions;
use vibroimpact_plot::{GROUPS, legend_group};
use vibroimpact_study::{MapPlan, Plan, RegionMap, SecondStop, Span, SystemPlan, Task, map};

/// Which motions there are at each point of the plane of 1/beta and gap
///
/// At each point so many starts are settled: the first from rest, the second on the motion
/// without stops if that clears them, the others scattered over a box around the motion.
/// A:B:N is N values from A to B, both included. Without --csv, --plot or --json a summary is printed.
#[derive(Clone, Debug, Args)]
#[command(
    override_usage = "vibro map --inverse-beta A:B:N --gap A:B:N --restitution E --starts N [OPTIONS]",
    after_help = "Example:\n  \
        vibro map --inverse-beta 0.4:2:33 --gap 0:5:41 --restitution 0.5 --starts 20 --csv map.csv --plot map.png"
)]
pub(crate) struct Map {
    /// Values of 1/beta = omega_n/omega, all positive
    #[arg(long, value_name = "A:B:N", allow_hyphen_values = true, help_heading = "Plane")]
    inverse_beta: Span,

    /// Values of the gap, in units of F/k
    #[arg(long, value_name = "A:B:N", allow_hyphen_values = true, help_heading = "Plane")]
    gap: Span,

    /// Restitution: rebound speed over arrival speed, 0 to 1
    #[arg(long, value_name = "E", allow_hyphen_values = true, help_heading = "System")]
    restitution: f64,

    /// Damping ratio zeta, 0 or more
    #[arg(long, value_name = "Z", default_value_t = 0.0, allow_hyphen_values = true, help_heading = "System")]
    damping: f64,

    /// A second stop on the other side, at x = -D2 at every point
    #[arg(long, value_name = "D2", allow_hyphen_values = true, help_heading = "System")]
    second_gap: Option<f64>,

    /// Restitution of the second stop [default: that of the first]
    #[arg(long, value_name = "E2", allow_hyphen_values = true, requires = "second_gap", help_heading = "System")]
    second_restitution: Option<f64>,

    /// Starts at each point, 1 to 1e9
    #[arg(long, value_name = "N", allow_hyphen_values = true, help_heading = "Starts")]
    starts: u64,

    /// Which sequence of starts
    #[arg(long, value_name = "S", default_value_t = 1, help_heading = "Starts")]
    seed: u64,

    /// Write one row a motion, columns inverse_beta, gap, label, share, to this file; - for stdout
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    csv: Option<PathBuf>,

    /// Draw the map into this file, .svg or .png
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    plot: Option<PathBuf>,

    /// Print one JSON object with the labels and how often they occur
    #[arg(long, help_heading = "Output")]
    json: bool,
}

#[derive(Serialize)]
struct Answer<'a> {
    system: SystemObject,
    inverse_beta: Range,
    gap: Range,
    starts: u64,
    seed: u64,
    points: usize,
    coexisting: usize,
    labels: Vec<LabelCount>,
    plan: &'a Plan,
    program: &'static str,
}

#[derive(Serialize)]
struct SystemObject {
    restitution: f64,
    damping: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    second_stop: Option<StopObject>,
}

/// How often a label occurs.
#[derive(Clone, Serialize)]
struct LabelCount {
    label: String,
    /// Points that have such a motion.
    points: usize,
    /// Its share of all starts.
    share: f64,
}

pub(super) fn run(args: &Map, session: &Session) -> Result<(), Failure> {
    let system = SystemPlan {
        beta: None,
        inverse_beta: Some(args.inverse_beta.ends().0),
        gap: args.gap.ends().0,
        restitution: args.restitution,
        damping: args.damping,
        second_stop: args
            .second_gap
            .map(|gap| SecondStop { gap, restitution: args.second_restitution.unwrap_or(args.restitution) }),
    };
    let task = MapPlan::plane(args.inverse_beta, args.gap, args.starts, args.seed);
    let plan = Plan::new(system, Task::Map(task.clone()));
    plan.check()?;
    let total = task.points();
    let outputs = Outputs::reserve(args.csv.as_deref(), args.plot.as_deref(), args.json, session)?;
    outputs.drawable(&args.inverse_beta, &args.gap)?;

    let found = session.tiled(total, "points", |control, _| map(&system, &task, &SettleOptions::default(), control))?;

    let silent = outputs.any();
    outputs.write(
        session,
        |out| csv::write(out, "inverse_beta,gap,label,share", rows(&found)),
        || {
            let damping = if args.damping > 0.0 { format!(", *ζ* = {}", short(args.damping)) } else { String::new() };
            plot::map::figure(
                &found,
                (&args.inverse_beta, &args.gap),
                format!("*ε* = {}{damping}", short(args.restitution)),
            )
        },
    )?;
    let labels = counts(&found);
    let coexisting = found.points.iter().filter(|p| p.motions.len() > 1).count();
    if args.json {
        return session.print_json(&Answer {
            system: SystemObject {
                restitution: args.restitution,
                damping: args.damping,
                second_stop: system.second_stop.map(|stop| StopObject { gap: stop.gap, restitution: stop.restitution }),
            },
            inverse_beta: Range::new(&args.inverse_beta),
            gap: Range::new(&args.gap),
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
    let heads = ["<label", "points", "share of starts"].map(str::to_owned);
    let rows: Vec<Vec<String>> =
        labels.iter().map(|count| vec![count.label.clone(), count.points.to_string(), percent(count.share)]).collect();
    session.print(&format!(
        "{} points, {} starts each; several motions coexist at {coexisting} of them\n\n{}",
        found.points.len(),
        args.starts,
        table(&heads, &rows)
    ))?;
    session.note("hint: --csv FILE keeps every point, --plot FILE.png draws them");
    Ok(())
}

fn rows(found: &RegionMap) -> impl Iterator<Item = String> + '_ {
    found.points.iter().flat_map(|point| {
        point.motions.iter().map(|motion| {
            format!(
                "{},{},{},{}",
                Number(point.at[0]),
                Number(point.at[1]),
                motion.verdict.label(),
                Number(motion.share)
            )
        })
    })
}

/// Labels in the order of a legend, then by name.
fn counts(found: &RegionMap) -> Vec<LabelCount> {
    let mut counts: BTreeMap<(usize, String), (usize, f64)> = BTreeMap::new();
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

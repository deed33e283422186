//! `vibro basin`: which motion each start of a plane leads to.

use crate::args::{StoreArgs, SystemArgs};
use crate::commands::outputs::Outputs;
use crate::commands::stored;
use crate::exit::Failure;
use crate::plot;
use crate::plot::plane::{Plane, Side};
use crate::report::csv::{self, Number};
use crate::report::json::{Document, Motion, Range, SharedMotion};
use crate::report::text::{self, percent};
use crate::session::Session;
use clap::Args;
use serde::Serialize;
use std::path::PathBuf;
use vibroimpact_study::store::Part;
use vibroimpact_study::{Basin as Computed, BasinPlan, Plan, Span, Task, basin};

/// Which motion each start of a plane of positions and velocities leads to
///
/// A:B:N is N values from A to B, both included. Without --csv, --plot or --json the shares are printed.
#[derive(Clone, Debug, Args)]
#[command(
    override_usage = "vibro basin --beta B --gap D --restitution E --x A:B:N --v A:B:N [OPTIONS]",
    after_help = "Example:\n  \
        vibro basin --inverse-beta 1.3 --gap 0.75 --restitution 0.5 --x -4:0.75:400 --v -4:4:400 \\\n    \
        --csv basin.csv --plot basin.png"
)]
pub(crate) struct Basin {
    #[command(flatten)]
    system: SystemArgs,

    /// Positions, none beyond a stop
    #[arg(long, value_name = "A:B:N", allow_hyphen_values = true, help_heading = "Starts")]
    x: Span,

    /// Velocities
    #[arg(long, value_name = "A:B:N", allow_hyphen_values = true, help_heading = "Starts")]
    v: Span,

    /// Phase of the force at all starts, in radians
    #[arg(long, value_name = "P", default_value_t = 0.0, allow_hyphen_values = true, help_heading = "Starts")]
    phase: f64,

    /// Follow each start for so many impacts at most, 1 to 1000000; what is not settled by then is undecided
    #[arg(long, value_name = "N", allow_hyphen_values = true, help_heading = "Starts")]
    impacts: Option<u32>,

    #[command(flatten)]
    store: StoreArgs,

    /// Compute every K-th start first, and those between only where neighbours differ; needs --store
    #[arg(long, value_name = "K", requires = "store", help_heading = "Store")]
    refine: Option<u32>,

    /// Write one row a start, columns x, v, label, to this file; - for stdout
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    csv: Option<PathBuf>,

    /// Draw the basin into this file, .svg or .png
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    plot: Option<PathBuf>,

    /// Print one JSON object with the motions and their shares
    #[arg(long, help_heading = "Output")]
    json: bool,
}

#[derive(Serialize)]
struct Answer {
    x: Range,
    v: Range,
    phase: f64,
    motions: Vec<SharedMotion>,
    starts: usize,
}

pub(super) fn run(args: &Basin, session: &Session) -> Result<(), Failure> {
    let asked = args.system.asked()?;
    let units = asked.units;
    let plane = BasinPlan::plane(args.x.scaled(units.length())?, args.v.scaled(units.velocity())?, args.phase);
    let task = BasinPlan { refine: args.refine, impacts: args.impacts, ..plane };
    let plan = args.store.tiled(Plan::new(asked.system, Task::Basin(task.clone())))?;
    let osc = asked.system.oscillator()?;
    let total = task.starts();
    let outputs = Outputs::reserve(args.csv.as_deref(), args.plot.as_deref(), args.json, session)?;
    outputs.drawable(&task.axes)?;
    if let Some(place) = &args.store.store {
        return stored::run(&plan, place, Part::ALL, outputs, session);
    }

    let found = session.tiled(total, "starts", |control, _| basin(&asked.system, &task, control))?;

    let silent = outputs.any();
    outputs.write(
        session,
        |out| csv::write(out, "x,v,label", rows(&found, (&args.x, &args.v))),
        || {
            let title = plot::title(&asked.system);
            let names = (units.named("*ξ*_0", "m"), units.named("*ξ*_0′", "m/s"));
            let plane = Plane { x: Side::new(names.0, &args.x.into())?, y: Side::new(names.1, &args.v.into())? };
            let motion = |m: usize| plot::basin::Motion {
                label: found.motions[m].verdict.label().into_owned(),
                share: found.share(m),
            };
            let motions: Vec<_> = (0..found.motions.len()).map(motion).collect();
            plot::basin::figure(&plane, &motions, found.cells.clone(), title)
        },
    )?;
    let mut order: Vec<usize> = (0..found.motions.len()).collect();
    order.sort_by_key(|m| core::cmp::Reverse(found.motions[*m].count));
    if args.json {
        let motions = order
            .iter()
            .map(|&m| SharedMotion {
                motion: Motion::new(&found.motions[m].verdict, &osc, &units),
                share: found.share(m),
                count: found.motions[m].count,
            })
            .collect();
        let answer = Answer {
            x: Range::new(&args.x),
            v: Range::new(&args.v),
            phase: args.phase,
            motions,
            starts: found.cells.len(),
        };
        return session.print_json(&Document::new(&asked, &osc, &plan, answer));
    }
    if silent {
        return Ok(());
    }
    let heads = ["share", "starts", "<label", "<meaning"].map(str::to_owned);
    let rows: Vec<Vec<String>> = order
        .iter()
        .map(|&m| {
            let motion = &found.motions[m];
            vec![
                percent(found.share(m)),
                motion.count.to_string(),
                motion.verdict.label().into_owned(),
                text::meaning(&motion.verdict),
            ]
        })
        .collect();
    session.print(&(text::system(&asked, &osc) + "\n" + &text::table(&heads, &rows)))?;
    session.note("hint: --csv FILE keeps every start, --plot FILE.png draws them");
    Ok(())
}

/// Rows in the order of the cells, in the units and with the very numbers of the question.
fn rows<'a>(found: &'a Computed, (x, v): (&'a Span, &'a Span)) -> impl Iterator<Item = String> + 'a {
    let labels: Vec<String> = found.motions.iter().map(|motion| motion.verdict.label().into_owned()).collect();
    let columns = x.count() as usize;
    let xs: Vec<String> = x.values().map(|x| Number(x).to_string()).collect();
    let vs: Vec<String> = v.values().map(|v| Number(v).to_string()).collect();
    found.cells.iter().enumerate().map(move |(k, motion)| {
        let (x, v) = (&xs[k % columns], &vs[k / columns]);
        format!("{x},{v},{}", labels[usize::from(*motion)])
    })
}

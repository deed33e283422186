//! `vibro attractors`: the steady motions of a system and the share of starts that lead to each.

use crate::args::{StoreArgs, SystemArgs};
use crate::commands::outputs::Outputs;
use crate::commands::stored;
use crate::exit::Failure;
use crate::report::json::{Document, Motion, SharedMotion};
use crate::report::text::{self, multipliers, percent};
use crate::session::Session;
use clap::Args;
use serde::Serialize;
use vibroimpact::verdict::{SettleOptions, StartBox};
use vibroimpact_study::store::Part;
use vibroimpact_study::{Plan, Task, attractors};

/// The steady motions that many scattered starts lead to, and their shares
///
/// Starts are spread evenly over positions, velocities and phases of a box around the motion; the same starts on every
/// machine. Two motions with one label are two if their impacts differ.
#[derive(Clone, Debug, Args)]
#[command(
    override_usage = "vibro attractors --beta B --gap D --restitution E --starts N [OPTIONS]",
    after_help = "Example:\n  vibro attractors --inverse-beta 1.3 --gap 0.75 --restitution 0.5 --starts 500"
)]
pub(crate) struct Attractors {
    #[command(flatten)]
    system: SystemArgs,

    /// How many starts, 1 to 1e9
    #[arg(long, value_name = "N", allow_hyphen_values = true, help_heading = "Starts")]
    starts: u64,

    /// Which sequence of starts
    #[arg(long, value_name = "S", default_value_t = 1, help_heading = "Starts")]
    seed: u64,

    #[command(flatten)]
    store: StoreArgs,

    /// Print one JSON object instead of text
    #[arg(long, help_heading = "Output")]
    json: bool,
}

#[derive(Serialize)]
struct Answer {
    motions: Vec<SharedMotion>,
    starts: u64,
    seed: u64,
    #[serde(rename = "box")]
    area: Area,
}

/// Where the starts were.
#[derive(Serialize)]
struct Area {
    x: (f64, f64),
    v: (f64, f64),
    phase: (f64, f64),
}

pub(super) fn run(args: &Attractors, session: &Session) -> Result<(), Failure> {
    let asked = args.system.asked()?;
    let task = Task::Attractors { starts: args.starts, seed: args.seed };
    let plan = args.store.tiled(Plan::new(asked.system, task))?;
    if let Some(place) = &args.store.store {
        let outputs = Outputs::reserve(None, None, args.json, session)?;
        return stored::run(&plan, place, Part::ALL, outputs, session);
    }
    let osc = asked.system.oscillator()?;
    let area = StartBox::natural(&osc);

    let starts = (args.starts, args.seed);
    let census = session.tiled(args.starts, "starts", |control, _| {
        attractors(&osc, area, starts, &SettleOptions::default(), control)
    })?;

    let found = census.by_share();
    let units = &asked.units;
    let scaled = |(a, b): (f64, f64), unit: f64| (a * unit, b * unit);
    let area = Area { x: scaled(area.x, units.length()), v: scaled(area.v, units.velocity()), phase: area.phase };
    if args.json {
        let motions = found
            .iter()
            .map(|found| SharedMotion {
                motion: Motion::new(&found.verdict, &osc, units),
                share: census.share(found),
                count: found.count,
            })
            .collect();
        let answer = Answer { motions, starts: args.starts, seed: args.seed, area };
        return session.print_json(&Document::new(&asked, &osc, &plan, answer));
    }
    let heads = ["share", "starts", "<label", "multipliers", "<meaning"].map(str::to_owned);
    let rows: Vec<Vec<String>> = found
        .iter()
        .map(|found| {
            vec![
                percent(census.share(found)),
                found.count.to_string(),
                found.verdict.label().into_owned(),
                found.verdict.multipliers(&osc).map_or_else(|| "-".into(), multipliers),
                text::meaning(&found.verdict),
            ]
        })
        .collect();
    let mut text = text::system(&asked, &osc);
    text.push_str(&format!(
        "starts  {} in x {} to {}, v {} to {}, all phases\n\n",
        args.starts,
        text::short(area.x.0),
        text::short(area.x.1),
        text::short(area.v.0),
        text::short(area.v.1)
    ));
    session.print(&(text + &text::table(&heads, &rows)))?;
    session.note("hint: --json has the impacts of each motion; `vibro basin` shows where they start from");
    Ok(())
}

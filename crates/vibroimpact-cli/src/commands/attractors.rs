//! `vibro attractors`: the steady motions of a system and the share of starts that lead to each.

use crate::args::{StoreArgs, SystemArgs, whole};
use crate::commands::outputs::Outputs;
use crate::commands::stored;
use crate::failure::Failure;
use crate::report::text::{self, multipliers};
use crate::session::Session;
use clap::Args;
use std::path::PathBuf;
use vibroimpact::verdict::{SettleOptions, StartBox};
use vibroimpact_report::json::attractors::document;
use vibroimpact_report::number::{percent, short};
use vibroimpact_report::table::attractors::table;
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
    #[arg(long, value_parser = whole::<u64>, value_name = "N", allow_hyphen_values = true, help_heading = "Starts")]
    starts: u64,

    /// Which sequence of starts
    #[arg(long, value_parser = whole::<u64>, value_name = "S", default_value_t = 1, help_heading = "Starts")]
    seed: u64,

    #[command(flatten)]
    store: StoreArgs,

    /// Write one row a motion to this file; - for stdout. Columns: label, share, starts, real and imaginary part of both multipliers
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    csv: Option<PathBuf>,

    /// Print one JSON object instead of text
    #[arg(long, help_heading = "Output")]
    json: bool,
}

pub(super) fn run(args: &Attractors, session: &Session) -> Result<(), Failure> {
    let asked = args.system.asked()?;
    let task = Task::Attractors { starts: args.starts, seed: args.seed };
    let plan = args.store.tiled(Plan::new(asked.system, task), &asked.units)?;
    let outputs = Outputs::reserve(args.csv.as_deref(), None, args.json, session)?;
    if let Some(place) = &args.store.store {
        return stored::run(&plan, place, Part::ALL, outputs, session);
    }
    let osc = asked.system.oscillator()?;
    let area = StartBox::natural(&osc);

    let starts = (args.starts, args.seed);
    let census = session.tiled(args.starts, "starts", |control, _| {
        attractors(&osc, area, starts, &SettleOptions::default(), control)
    })?;

    let to_stdout = outputs.table_on_stdout();
    outputs.write(session, || Ok(table(&census, &osc)), || Err(Failure::bad("attractors have no figure")))?;
    if to_stdout {
        return Ok(());
    }
    let found = census.by_share();
    let units = &asked.units;
    if args.json {
        return session.print_json(&document(&asked, &plan, &osc, starts, &census));
    }
    let (x, v) = (area.x, area.v);
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
        short(x.0 * units.length()),
        short(x.1 * units.length()),
        short(v.0 * units.velocity()),
        short(v.1 * units.velocity())
    ));
    session.print(&(text + &text::table(&heads, &rows)))?;
    session.note("hint: --json has the impacts of each motion; `vibro basin` shows where they start from");
    Ok(())
}

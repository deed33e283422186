//! `vibro simulate`: the events of a motion, one after another.

use crate::args::{StartArgs, SystemArgs, number, whole};
use crate::commands::outputs::Outputs;
use crate::failure::Failure;
use crate::report::text;
use crate::session::Session;
use crate::signal;
use clap::Args;
use std::path::PathBuf;
use vibroimpact::motion::EventKind;
use vibroimpact_report::Asked;
use vibroimpact_report::figure::title;
use vibroimpact_report::figure::waveform::figure;
use vibroimpact_report::json::simulate::document;
use vibroimpact_report::number::short;
use vibroimpact_report::table::waveform::table;
use vibroimpact_study::{Control, Plan, Simulated, Task, counted, most_impacts, simulate};

/// Follow a motion event by event: impacts, grazes, sticking, release
///
/// Prints every event with its time, the phase of the force and the velocities. It ends after so many impacts, after so
/// many forcing periods, or when nothing happens any more, and says which.
#[derive(Clone, Debug, Args)]
#[command(
    override_usage = "vibro simulate --beta B --gap D --restitution E [--x X --v V --phase P] [OPTIONS]",
    after_help = "Examples:\n  \
        vibro simulate --inverse-beta 1.8 --gap 0.25 --restitution 0.5 --impacts 20\n  \
        vibro simulate --beta 0.9 --gap -0.5 --restitution 0.5 --periods 4 --plot chatter.svg\n  \
        vibro simulate --beta 0.9 --gap 0.5 --restitution 0.7 --periods 10 --csv wave.csv --step 0.01"
)]
pub(crate) struct Simulate {
    #[command(flatten)]
    system: SystemArgs,
    #[command(flatten)]
    start: StartArgs,

    /// Stop after so many impacts, 1 to 10000000 [default: 100, or 1000000 with --periods]
    #[arg(long, value_parser = whole::<u64>, value_name = "N", allow_hyphen_values = true, help_heading = "Length")]
    impacts: Option<u64>,

    /// Stop after so many forcing periods, up to 1e9, of 2 pi / beta each
    #[arg(long, value_parser = number, value_name = "N", allow_hyphen_values = true, help_heading = "Length")]
    periods: Option<f64>,

    /// Print one JSON object instead of text
    #[arg(long, help_heading = "Output")]
    json: bool,

    /// Write the waveform, columns t, x, v, to this file; - for stdout
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    csv: Option<PathBuf>,

    /// Time between points of the waveform [default: a hundredth of the forcing period]
    #[arg(long, value_parser = number, value_name = "T", requires = "csv", allow_hyphen_values = true, help_heading = "Output")]
    step: Option<f64>,

    /// Draw the waveform into this file, .svg or .png
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    plot: Option<PathBuf>,
}

pub(super) fn run(args: &Simulate, session: &Session) -> Result<(), Failure> {
    let asked = args.system.asked()?;
    let impacts = most_impacts(args.impacts, args.periods);
    let task = Task::Simulate { start: args.start.plan(&asked.units), impacts: Some(impacts), periods: args.periods };
    let plan = Plan::new(asked.system, task);
    plan.check()?;
    let osc = asked.system.oscillator()?;
    let start = args.start.plan(&asked.units).start(&osc)?;
    let step = args.step.map_or(osc.period() / 100.0, |step| step / asked.units.time());
    if !(step > 0.0 && step.is_finite()) {
        return Err(Failure::bad(format!("step = {step} lies outside 0 < step < infinity")));
    }
    let outputs = Outputs::reserve(args.csv.as_deref(), args.plot.as_deref(), args.json, session)?;
    let to_stdout = outputs.table_on_stdout();

    let control = Control { stop: signal::flag(), ..Control::default() };
    let followed = simulate(&osc, start, impacts, args.periods, &control).map_err(|stopped| {
        Failure::Stopped(format!("after {} of {}; nothing was written", stopped.done, counted(stopped.total, "impact")))
    })?;
    let until = followed.shown_until(&osc);
    outputs.write(
        session,
        || Ok(table(&osc, start, (until, step), asked.units)?),
        || Ok(figure(&osc, start, (0.0, until), &asked.units, title(&asked.system))),
    )?;
    if to_stdout {
        return Ok(());
    }
    if args.json {
        session.print_json(&document(&asked, &plan, (&osc, &start), &followed))
    } else {
        let head = text::system(&asked, &osc) + &text::start(&start, &asked.units);
        session.print(&(head + &report(&followed, &asked)))
    }
}

fn report(followed: &Simulated, asked: &Asked) -> String {
    let units = &asked.units;
    let heads = [
        units.named("time", "s"),
        "phase".into(),
        "<event".into(),
        units.named("before", "m/s"),
        units.named("after", "m/s"),
    ];
    let both = asked.system.second_stop.is_some();
    let rows: Vec<Vec<String>> = followed
        .events
        .iter()
        .map(|event| {
            let mut row = vec![short(event.time * units.time()), short(event.phase)];
            let at = if both && event.side == vibroimpact::Side::Lower { " (second stop)" } else { "" };
            let name = match event.kind {
                EventKind::Impact { .. } => "impact",
                EventKind::Graze { .. } => "graze",
                EventKind::Stick { chatter: true, .. } => "stick after chatter",
                EventKind::Stick { chatter: false, .. } => "stick",
                EventKind::Release => "release",
            };
            row.push(format!("{name}{at}"));
            if let EventKind::Impact { velocity_before, velocity_after } = event.kind {
                row.push(short(velocity_before * units.velocity()));
                row.push(short(velocity_after * units.velocity()));
            }
            row
        })
        .collect();
    let mut text = if rows.is_empty() { "no events\n".to_owned() } else { text::table(&heads, &rows) };
    let time = short(followed.time * units.time());
    text.push_str(&match (followed.reason, &followed.horizon) {
        ("no_more_impacts", Some(horizon)) => {
            let why = vibroimpact::verdict::Verdict::NoImpact(*horizon);
            format!("end     after time {time}: {}\n", text::meaning(&why))
        }
        ("stuck", _) => format!("end     after time {time}: it stays on the stop for ever\n"),
        ("impact_limit", _) => format!("end     at time {time}: the number of impacts asked for\n"),
        ("time_limit", _) => format!("end     at time {time}: the number of periods asked for\n"),
        _ => format!("end     after time {time}: the search for the next impact ran out of steps\n"),
    });
    text
}

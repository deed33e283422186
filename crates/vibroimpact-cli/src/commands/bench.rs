//! `vibro bench`: the rates of this machine.

use crate::args::{Words, number, word};
use crate::failure::Failure;
use crate::measure::{Rates, Workload, measure};
use crate::session::Session;
use crate::signal;
use clap::Args;
use serde::Serialize;
use std::sync::atomic::Ordering;
use std::time::Duration;
use vibroimpact::lanes::Width;
use vibroimpact_report::PROGRAM;

/// Measure the speed of this machine, in about ten seconds
///
/// Impacts per second on one thread: `scalar` follows one motion, `lanes` many side by side. chaos: the chaotic motion at
/// 1/beta = 1.11, gap 3, restitution 0.5. regular: the settled motions at 1/beta = 1.3, gap 0.75, as many impacts of 1/1
/// as of 2/1. Starts per second: a basin of 100 x 100 starts there, each to its confirmed motion. All rates are medians
/// over many short intervals.
#[derive(Clone, Debug, Args)]
#[command(override_usage = "vibro bench [OPTIONS]", after_help = "Example: for a script\n  vibro bench --json")]
pub(crate) struct Bench {
    /// Only this one
    #[arg(long, value_name = "WORKLOAD", help_heading = "Measurement")]
    workload: Option<Workload>,

    /// Seconds for each workload, from 0.01 to 3600
    #[arg(long, value_name = "S", default_value_t = 3.0, value_parser = seconds, help_heading = "Measurement")]
    seconds: f64,

    /// Lanes to use instead of the fastest this machine has; results never depend on it
    #[arg(long, value_parser = word(&WIDTHS), value_name = "WIDTH", help_heading = "Measurement")]
    width: Option<Width>,

    /// Print one JSON object instead of text
    #[arg(long, help_heading = "Output")]
    json: bool,
}

const WIDTHS: Words<Width, 3> = [
    ("portable", Width::Portable, "Four, in the vectors every machine of this kind has"),
    ("avx2", Width::Avx2, "Sixteen, with AVX2"),
    ("avx512", Width::Avx512, "Sixteen, with AVX-512"),
];

fn name(width: Width) -> &'static str {
    WIDTHS.iter().find(|(_, known, _)| *known == width).map_or("", |(name, ..)| name)
}

fn seconds(text: &str) -> Result<f64, String> {
    let value = number(text)?;
    if (0.01..=3600.0).contains(&value) {
        Ok(value)
    } else {
        Err(format!("seconds = {value} lies outside 0.01 to 3600"))
    }
}

#[derive(Default, Serialize)]
struct BenchFields {
    impacts_per_second: Impacts,
    starts_per_second: Starts,
    lanes: &'static str,
    threads: u32,
    program: &'static str,
}

#[derive(Default, Serialize)]
struct Impacts {
    #[serde(skip_serializing_if = "Option::is_none")]
    chaos: Option<Rates>,
    #[serde(skip_serializing_if = "Option::is_none")]
    regular: Option<Rates>,
}

#[derive(Default, Serialize)]
struct Starts {
    #[serde(skip_serializing_if = "Option::is_none")]
    basin: Option<f64>,
    /// The same for starts that are settled one after another, each without the results of the others.
    #[serde(skip_serializing_if = "Option::is_none")]
    basin_scalar: Option<f64>,
}

pub(super) fn run(args: &Bench, session: &Session) -> Result<(), Failure> {
    let width = args.width.unwrap_or_else(Width::best);
    if !width.available() {
        return Err(Failure::bad(format!("this machine has no {}\nhint: leave --width away", name(width))));
    }
    let mut answer = BenchFields { lanes: name(width), threads: 1, program: PROGRAM, ..BenchFields::default() };
    let duration = Duration::from_secs_f64(args.seconds);
    for workload in Workload::ALL.into_iter().filter(|one| args.workload.is_none_or(|only| only == *one)) {
        let rates = measure(workload, width, duration);
        if signal::flag().load(Ordering::Relaxed) {
            return Err(Failure::Stopped("while measuring".into()));
        }
        match workload {
            Workload::Chaos => answer.impacts_per_second.chaos = Some(rates),
            Workload::Regular => answer.impacts_per_second.regular = Some(rates),
            Workload::Basin => {
                answer.starts_per_second = Starts { basin: Some(rates.lanes), basin_scalar: Some(rates.scalar) };
            }
        }
    }
    if args.json { session.print_json(&answer) } else { session.print(&text(&answer)) }
}

fn text(answer: &BenchFields) -> String {
    let million = |rate: f64| format!("{:.2} million", rate / 1e6);
    let mut text = format!("one thread, lanes: {}\n", answer.lanes);
    for (name, rates) in [("chaos", &answer.impacts_per_second.chaos), ("regular", &answer.impacts_per_second.regular)]
    {
        if let Some(rates) = rates {
            let (scalar, lanes) = (million(rates.scalar), million(rates.lanes));
            text.push_str(&format!("{name:<8} impacts per second: {scalar} one motion alone, {lanes} in lanes\n"));
        }
    }
    if let Starts { basin: Some(lanes), basin_scalar: Some(scalar) } = answer.starts_per_second {
        let (scalar, lanes) = (million(scalar), million(lanes));
        text.push_str(&format!(
            "basin    starts per second to a confirmed motion: {scalar} one after another, {lanes} in lanes\n"
        ));
    }
    text
}

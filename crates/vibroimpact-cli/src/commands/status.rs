//! `vibro status`: the progress of a store.

use super::stored;
use crate::args::end;
use crate::failure::Failure;
use crate::report::status::Status as Report;
use crate::session::Session;
use crate::signal;
use clap::Args;
use std::io::IsTerminal;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};
use vibroimpact_study::typed::duration;

/// The progress of a store: the tiles that are done, the time that is left, the processor time used, and the plan
///
/// The processor time of each tile is recorded beside the store, under its name with `.costs`; without these files it is
/// unknown.
#[derive(Clone, Debug, Args)]
pub(crate) struct Status {
    /// The store
    #[arg(value_name = "STORE")]
    store: String,

    /// Print the progress again and again, until the store is complete
    #[arg(long)]
    watch: bool,

    /// Time between two reports of --watch
    #[arg(long, value_parser = duration, value_name = "TIME", default_value = "5s", requires = "watch", allow_hyphen_values = true)]
    every: Duration,

    /// Print one JSON object instead of text; with --watch, one at a time
    #[arg(long, help_heading = "Output")]
    json: bool,
}

pub(super) fn run(args: &Status, session: &Session) -> Result<(), Failure> {
    if args.watch {
        return watch(args, session);
    }
    let store = stored::open(&args.store)?;
    let report = Report::whole(&store, session)?;
    if args.json { session.print_json(&report.fields()) } else { session.print(&report.text()) }
}

/// Time between two looks at the stop flag.
const BEAT: Duration = Duration::from_millis(100);

/// Reports until the store is complete: on a terminal in one place, elsewhere a line each time.
fn watch(args: &Status, session: &Session) -> Result<(), Failure> {
    let in_place = !args.json && std::io::stdout().is_terminal();
    loop {
        // opened each time: a store that was deleted has no progress
        let store = stored::open(&args.store)?;
        let report = Report::brief(&store)?;
        if args.json {
            session.print_json(&report.fields())?;
        } else if in_place {
            // the line before is deleted
            let end = if report.complete() { "\n" } else { "" };
            session.print(&format!("\r\x1b[2K{}{end}", report.line().trim_end()))?;
        } else {
            session.print(&report.line())?;
        }
        if report.complete() {
            return Ok(());
        }
        let next = end(args.every);
        while next.is_none_or(|next| Instant::now() < next) {
            if signal::flag().load(Ordering::Relaxed) {
                return Err(Failure::Stopped("the study itself goes on if it is running".to_owned()));
            }
            std::thread::sleep(BEAT);
        }
    }
}

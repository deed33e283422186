//! `vibro reproduce`: the figures of the 1971 paper.

use crate::failure::Failure;
use crate::session::Session;
use clap::Args;
use fukaya_irie_1971::{Error, ReproductionOptions, reproduce};
use std::path::{Path, PathBuf};

/// Compute the figures of the 1971 paper and compare them with the paper
///
/// Writes every figure as SVG, PNG and CSV with a report that compares each statement of the paper with the result here,
/// and prints that comparison. A full run takes minutes, --quick seconds.
#[derive(Clone, Debug, Args)]
#[command(after_help = "Example:\n  vibro reproduce --quick --out /tmp/paper")]
pub(crate) struct Reproduce {
    /// Folder to write into; made if it does not exist
    #[arg(long, value_name = "DIR", default_value = "out/fukaya-irie-1971")]
    out: PathBuf,

    /// Coarser grids and fewer starts
    #[arg(long)]
    quick: bool,
}

pub(super) fn run(args: &Reproduce, session: &Session) -> Result<(), Failure> {
    if args.out == Path::new("-") {
        return Err(Failure::bad("`-` is no place for the figures of a paper: --out names a folder"));
    }
    let options = ReproductionOptions { quick: args.quick, force: session.force };
    let report = session
        .tiled(0, "points", |control, progress| {
            let stage = |name: &str, total: u64| progress.stage(name, total);
            reproduce(&args.out, &options, control, &stage)
        })
        .map_err(|error| refused(&error))?;
    session.print(&report.table())?;
    session.note(&format!("wrote {}", args.out.display()));
    Ok(())
}

fn refused(error: &Error) -> Failure {
    let sentence = error.to_string();
    if error.is_stopped() {
        Failure::Stopped(sentence)
    } else if error.is_bad_question() {
        Failure::BadQuestion(sentence)
    } else {
        Failure::Failed(sentence)
    }
}

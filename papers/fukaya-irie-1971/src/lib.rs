//! The 1971 paper of Fukaya and Irie, reproduced figure by figure.
//!
//! K. Fukaya, T. Irie, "On the Transient Oscillation of a Vibro-Impact System", Bulletin of the Faculty of
//! Engineering, Hokkaido University 62 (1971) 31-39, <https://hdl.handle.net/2115/41063>.
//!
//! [`reproduce`] computes every figure, writes it as SVG, PNG and CSV, and compares each statement of the paper with
//! the result found here, in numbers. The statements of the paper are in this crate in our own words; the results come
//! only from the run. Restitution is 0.5 in all figures, and there is no damping.
//!
//! | the paper | file |
//! |---|---|
//! | figures 1 and 2: the model, a waveform | `figure02` |
//! | figure 3: the method and its rule (11)-(12) | `figure03` |
//! | figure 4: the plane of 1/beta and delta; negative delta | `figure04`, `grid`, `regions`, `search`, `below_zero` |
//! | figure 5: a motion of order four | `figure05` |
//! | figures 6 to 9: the motion to which each start leads | `basins` |
//! | figure 10: from an unstable motion to a stable one | `figure10` |
//! | figure 11: a chaotic motion | `figure11` |
//! | section 4: the conclusions | `conclusions` |
//! | the line through T and U, for `docs/orbits.md` | [`mod@line`] |
//!
//! | other parts | file |
//! |---|---|
//! | a row of the report, the report, its table for a terminal | [`Claim`], [`Report`] |
//! | the report as a page | `page` |
//! | the output folder | `folder` |

mod basins;
mod below_zero;
mod claims;
mod conclusions;
mod error;
mod figure02;
mod figure03;
mod figure04;
mod figure05;
mod figure10;
mod figure11;
mod folder;
mod grid;
pub mod line;
mod looks;
mod page;
mod regions;
mod search;
mod waves;

pub use claims::{Agreement, Claim, Report};
pub use error::Error;

use crate::folder::Folder;
use std::path::Path;
use std::sync::atomic::Ordering;
use vibroimpact_study::Control;

/// Restitution of every figure.
const EPS: f64 = 0.5;

/// The options of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ReproductionOptions {
    /// Whether to run a small version within seconds, with coarser grids and fewer starts. Its report states this.
    pub quick: bool,
    /// Whether to write into a folder that contains other files; files with the same names are overwritten.
    pub force: bool,
}

/// The data common to all parts of a run.
struct Run<'a> {
    quick: bool,
    control: &'a Control<'a>,
    stage: &'a dyn Fn(&str, u64),
    folder: Folder,
    report: Report,
}

impl Run<'_> {
    /// Announces a stage with this number of points, unless the run is stopped.
    fn stage(&self, name: &str, points: u64) -> Result<(), Error> {
        (self.stage)(name, points);
        if self.control.stop.load(Ordering::Relaxed) {
            return Err(Error::Stopped);
        }
        Ok(())
    }

    /// Returns `full`, or `quick` in a quick run.
    fn size<T>(&self, full: T, quick: T) -> T {
        if self.quick { quick } else { full }
    }
}

/// Computes the figures, writes them and the report into the folder `out`, and returns the report.
///
/// `stage` is called at the beginning of each stage with its name and its number of points, which `control.progress`
/// then counts. The files have the same bytes for any number of threads.
///
/// # Errors
/// [`Error`] for a folder that cannot be written or may not be overwritten, and for a run that was stopped through
/// `control`. Complete figures are kept.
pub fn reproduce(
    out: &Path,
    options: &ReproductionOptions,
    control: &Control<'_>,
    stage: &dyn Fn(&str, u64),
) -> Result<Report, Error> {
    let folder = Folder::open(out, options.force)?;
    let mut run = Run { quick: options.quick, control, stage, folder, report: Report::new(options.quick) };
    figure02::run(&mut run)?;
    let grid = grid::settle_all(&run)?;
    figure03::run(&mut run, &grid)?;
    let plane = figure04::run(&mut run, &grid)?;
    below_zero::run(&mut run)?;
    figure05::run(&mut run)?;
    let shares = basins::run(&mut run)?;
    figure10::run(&mut run)?;
    figure11::run(&mut run)?;
    conclusions::run(&mut run, &grid, &plane, &shares);
    run.stage("report", 0)?;
    run.folder.write("report.html", page::html(&run.report).as_bytes())?;
    Ok(run.report)
}

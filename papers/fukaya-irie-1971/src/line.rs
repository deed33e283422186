//! The line 1/beta = 1.11 through the points T and U of the paper, with restitution 1/2 and no damping: its periodic
//! orbits over the gap, every event on their branches, and simulation near each event.
//!
//! The document `docs/orbits.md` shows the table and the figure that [`write()`] makes.
//!
//! | idea | file |
//! |---|---|
//! | the branches followed, and the events on them | `branches` |
//! | simulation just below and just above an event | `beside` |
//! | the events as a table | `table` |
//! | the figure | `draw` |

mod beside;
mod branches;
mod draw;
mod table;

pub(crate) use branches::branch;

use crate::Error;
use std::path::Path;
use vibroimpact_plot::DPI_300;

/// The lines before and after the table in the document.
const MARKERS: (&str, &str) = (
    "<!-- Written by `cargo xtask line`. Do not edit: change papers/fukaya-irie-1971/src/line instead. -->\n",
    "<!-- End of what `cargo xtask line` writes. -->\n",
);

/// The document with a newly computed table.
///
/// # Errors
/// [`Error::Unexpected`] if a branch cannot begin, or the document lacks the markers.
pub fn table_in(document: &str) -> Result<String, Error> {
    let lacks = Error::Unexpected("the document lacks the comments that a table goes between");
    let Some((before, rest)) = document.split_once(MARKERS.0) else { return Err(lacks) };
    let Some((_, after)) = rest.split_once(MARKERS.1) else { return Err(lacks) };
    let table = table::markdown(&branches::events(&branches::all()?))?;
    Ok(format!("{before}{}\n{table}\n{}{after}", MARKERS.0, MARKERS.1))
}

/// Writes the table into `orbits.md` and the figure into `line.png`, both in the folder `docs`.
///
/// # Errors
/// As for [`table_in`], and [`Error::Write`] for a file that cannot be read or written.
pub fn write(docs: &Path) -> Result<(), Error> {
    let failed = |path: &Path| {
        let path = path.to_owned();
        |source| Error::Write { path, source }
    };
    let page = docs.join("orbits.md");
    let document = std::fs::read_to_string(&page).map_err(failed(&page))?;
    std::fs::write(&page, table_in(&document)?).map_err(failed(&page))?;
    let picture = docs.join("line.png");
    let png = draw::figure(&branches::all()?)?.to_png(DPI_300)?;
    std::fs::write(&picture, png).map_err(failed(&picture))
}

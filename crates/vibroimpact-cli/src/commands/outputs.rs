//! What a grid command writes: a table, a picture, or both, reserved before anything is computed.

use crate::exit::Failure;
use crate::files::Target;
use crate::plot::Picture;
use crate::session::Session;
use std::path::Path;
use vibroimpact_study::Span;

/// Columns and rows a picture can show.
const MOST_CELLS: u32 = 16_384;

/// The outputs of a grid command.
pub(super) struct Outputs {
    csv: Option<Sheet>,
    picture: Option<Picture>,
    json: bool,
}

enum Sheet {
    Stdout,
    File(Target, String),
}

impl Outputs {
    pub(super) fn reserve(
        csv: Option<&Path>,
        plot: Option<&Path>,
        json: bool,
        session: &Session,
    ) -> Result<Self, Failure> {
        let csv = match csv {
            None => None,
            Some(path) if path == Path::new("-") && json => {
                return Err(Failure::bad("a table and --json both want stdout"));
            }
            Some(path) if path == Path::new("-") => Some(Sheet::Stdout),
            Some(path) => {
                let target = Target::reserve(path, session.force)?;
                Some(Sheet::File(target, path.display().to_string()))
            }
        };
        let picture = plot.map(|path| Picture::reserve(path, session.force)).transpose()?;
        Ok(Self { csv, picture, json })
    }

    /// Refuses a picture of more cells than it has room for.
    pub(super) fn drawable(&self, columns: &Span, rows: &Span) -> Result<(), Failure> {
        let most = columns.count().max(rows.count());
        if self.picture.is_some() && most > MOST_CELLS {
            return Err(Failure::bad(format!(
                "a figure shows at most {MOST_CELLS} values on an axis, not {most}\nhint: --csv has no such limit"
            )));
        }
        Ok(())
    }

    /// Whether anything but text was asked for.
    pub(super) const fn any(&self) -> bool {
        self.csv.is_some() || self.picture.is_some() || self.json
    }

    /// Whether the table goes to stdout: then it is the answer, and no text follows it.
    pub(super) const fn table_on_stdout(&self) -> bool {
        matches!(self.csv, Some(Sheet::Stdout))
    }

    pub(super) fn write(
        self,
        session: &Session,
        table: impl FnOnce(&mut dyn std::io::Write) -> std::io::Result<()>,
        figure: impl FnOnce() -> Result<vibroimpact_plot::Figure, Failure>,
    ) -> Result<(), Failure> {
        if let Some(picture) = self.picture {
            picture.write(&figure()?)?;
        }
        match self.csv {
            None => Ok(()),
            Some(Sheet::Stdout) => session.to_stdout(table),
            Some(Sheet::File(target, name)) => {
                target.write(table)?;
                session.note(&format!("wrote {name}"));
                Ok(())
            }
        }
    }
}

//! The output files of a command: a table, a figure, or both. They are reserved before the computation.

use crate::args::{FigureArgs, Files};
use crate::commands::respond::none;
use crate::failure::Failure;
use crate::files::Target;
use crate::picture::Picture;
use crate::session::Session;
use std::path::Path;
use vibroimpact_plot::Figure;
use vibroimpact_report::figure::plane::{PlaneAxis, Sides};
use vibroimpact_report::{Table, Units, Varied};
use vibroimpact_study::{Coordinate, Plan, Task, typed_axes};

/// The outputs of a command.
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
    pub(super) fn reserve(Files { csv, plot, look, json }: Files<'_>, session: &Session) -> Result<Self, Failure> {
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
        if plot.is_none() && look.is_some_and(FigureArgs::any) {
            return Err(Failure::bad(
                "--title, --size, --dpi, --x-limits, --y-limits and --greyscale say how the figure looks\nhint: --plot FILE",
            ));
        }
        let picture = plot.zip(look).map(|(path, look)| Picture::reserve(path, look, session.force)).transpose()?;
        Ok(Self { csv, picture, json })
    }

    /// Refuses a table or a figure that the answer to a plan does not have, before the computation.
    pub(super) fn check(&self, plan: &Plan) -> Result<(), Failure> {
        let without_points = match &plan.task {
            Task::Lyapunov(task) => task.axes.is_empty() && task.points.is_none(),
            _ => false,
        };
        if without_points && self.drawn() {
            return Err(none("figure"));
        }
        if without_points && self.csv.is_some() {
            return Err(none("table"));
        }
        if self.drawn() { drawable(plan) } else { Ok(()) }
    }

    /// Whether a figure was requested.
    pub(super) const fn drawn(&self) -> bool {
        self.picture.is_some()
    }

    /// Whether a table or a figure was requested.
    pub(super) const fn any_file(&self) -> bool {
        self.csv.is_some() || self.picture.is_some()
    }

    /// Whether JSON was requested.
    pub(super) const fn json(&self) -> bool {
        self.json
    }

    /// Whether any output other than text was requested.
    pub(super) const fn any(&self) -> bool {
        self.csv.is_some() || self.picture.is_some() || self.json
    }

    /// Whether the table goes to stdout. It is then the only output there, and no text is printed.
    pub(super) const fn table_on_stdout(&self) -> bool {
        matches!(self.csv, Some(Sheet::Stdout))
    }

    /// Writes the requested outputs of a result.
    pub(super) fn write<'a>(
        self,
        session: &Session,
        table: impl FnOnce() -> Result<Table<'a>, Failure>,
        figure: impl FnOnce() -> Result<Figure, Failure>,
    ) -> Result<(), Failure> {
        let table = self.csv.is_some().then(table).transpose()?;
        self.stream(session, |out| table.map_or(Ok(()), |table| table.write(out)), figure)
    }

    /// The same, with a table that is read while it is written.
    pub(super) fn stream(
        self,
        session: &Session,
        table: impl FnOnce(&mut dyn std::io::Write) -> std::io::Result<()>,
        figure: impl FnOnce() -> Result<Figure, Failure>,
    ) -> Result<(), Failure> {
        if let Some(picture) = self.picture {
            picture.write(figure()?)?;
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

/// Refuses axes over which no figure can be drawn. Some figures need one axis only.
fn drawable(plan: &Plan) -> Result<(), Failure> {
    match plan.machine() {
        Some(_) => drawable_over::<String>(&plan.task),
        None => drawable_over::<Coordinate>(&plan.task),
    }
}

fn drawable_over<V: Varied>(task: &Task) -> Result<(), Failure> {
    let units = Units::default();
    match task {
        // points that are no grid
        Task::Basin(plan) if plan.points.is_some() && plan.axes.is_empty() => {}
        Task::Basin(_) | Task::Map(_) => Sides::of(&typed_axes::<V>(task.axes())?, &units).map(drop)?,
        Task::Lyapunov(_) => {
            typed_axes::<V>(task.axes())?.iter().try_for_each(|axis| PlaneAxis::of(axis, &units).map(drop))?;
        }
        _ => {}
    }
    Ok(())
}

//! `vibro export`: a store as a table, or in other formats.

use super::stored;
use crate::args::Files;
use crate::commands::outputs::Outputs;
use crate::failure::Failure;
use crate::report::stored::table;
use crate::session::Session;
use clap::Args;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Write a store as CSV, Parquet or NetCDF
///
/// The table has a row for each point, or each point and motion: the coordinates, then all fields. That of an orbit diagram is
/// the table of `vibro diagram`, a row for each impact or state. Parquet holds the same table. Parquet and NetCDF are written by
/// the Python package `vibroimpact`, which has to be installed for them.
#[derive(Clone, Debug, Args)]
#[command(group = clap::ArgGroup::new("format").required(true))]
pub(crate) struct Export {
    /// The store
    #[arg(value_name = "STORE")]
    store: String,

    /// Write a table to this file; - for stdout
    #[arg(long, value_name = "FILE", group = "format")]
    csv: Option<PathBuf>,

    /// Write the table as Parquet
    #[arg(long, value_name = "FILE", group = "format")]
    parquet: Option<PathBuf>,

    /// Write the arrays as NetCDF
    #[arg(long, value_name = "FILE", group = "format")]
    netcdf: Option<PathBuf>,

    /// The Python that has the package
    #[arg(long, value_name = "PROGRAM", default_value = "python3")]
    python: String,
}

pub(super) fn run(args: &Export, session: &Session) -> Result<(), Failure> {
    let store = stored::open(&args.store)?;
    if let Some(path) = &args.csv {
        let outputs = Outputs::reserve(Files { csv: Some(path), plot: None, look: None, json: false }, session)?;
        // check for damage before the first row, because output to stdout cannot be taken back
        session.tiled(0, "points", |control, _| store.whole(control))?;
        return outputs.stream(
            session,
            |out| table(&store, true, out),
            || Err(Failure::bad("no figure was asked for")),
        );
    }
    match (&args.parquet, &args.netcdf) {
        (Some(path), _) => by_python(args, "parquet", path, session),
        (None, Some(path)) => by_python(args, "netcdf", path, session),
        (None, None) => Err(Failure::bad("--csv, --parquet or --netcdf FILE is needed")),
    }
}

fn by_python(args: &Export, format: &str, path: &Path, session: &Session) -> Result<(), Failure> {
    if path == Path::new("-") {
        return Err(Failure::bad(format!("{format} cannot go to stdout\nhint: --csv - writes the table there")));
    }
    if path.exists() && !session.force {
        let name = path.display();
        return Err(Failure::bad(format!(
            "`{name}` exists already\nhint: choose another name, or --force to replace it"
        )));
    }
    let ran = Command::new(&args.python)
        .args(["-m", "vibroimpact", "export", &args.store, "--format", format])
        .arg(path)
        .status();
    match ran {
        Ok(status) if status.success() => {
            session.note(&format!("wrote {}", path.display()));
            Ok(())
        }
        Ok(_) => Err(Failure::Failed(format!(
            "`{} -m vibroimpact export` did not write {}\nhint: --python names the Python that has the package vibroimpact; `pip install .` in its repository builds it (it is not on PyPI)",
            args.python,
            path.display()
        ))),
        Err(error) => Err(Failure::Failed(format!("`{}` cannot be run: {error}", args.python))),
    }
}

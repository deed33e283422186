//! `vibro machine`: the machines of the catalogue, and what a machine file expands to.

use crate::args::{FigureArgs, SetArgs};
use crate::failure::Failure;
use crate::machine_file;
use crate::picture::Picture;
use crate::report::machine as text;
use crate::session::Session;
use clap::{Args, Subcommand};
use serde::Serialize;
use std::path::PathBuf;
use vibroimpact_report::figure::machine::figure;
use vibroimpact_study::machine::{CATALOGUE, Named, WrittenMachine};

/// List the machines of the catalogue, and show a machine: its numbers, its matrices and its schematic
#[derive(Clone, Debug, Args)]
pub(crate) struct MachineCommand {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Clone, Debug, Subcommand)]
enum Verb {
    List(List),
    Show(Show),
}

/// List the machines of the catalogue
#[derive(Clone, Copy, Debug, Args)]
struct List {
    /// Print one JSON object
    #[arg(long, help_heading = "Output")]
    json: bool,
}

/// Show a machine: where it comes from, its numbers with their paths, and the matrices to which it expands
///
/// A machine is one of the catalogue or a machine file; `vibro schema --machine` prints what may be in such a file.
#[derive(Clone, Debug, Args)]
#[command(after_help = "Examples:\n  \
    vibro machine show soft-stop --set beta=100\n  \
    vibro machine show chain --written > my.toml\n  \
    vibro machine show my.toml --figure my.svg")]
struct Show {
    /// The name of a machine of the catalogue, or a file
    #[arg(value_name = "NAME|FILE")]
    machine: String,

    #[command(flatten)]
    set: SetArgs,

    /// Print the expansion alone, a machine file of matrices and directions
    #[arg(long, help_heading = "Output", conflicts_with_all = ["written", "json"])]
    toml: bool,

    /// Print the machine as it is written, with the changed numbers: a file to begin with
    #[arg(long, help_heading = "Output", conflicts_with = "json")]
    written: bool,

    /// Print one JSON object with everything
    #[arg(long, help_heading = "Output")]
    json: bool,

    /// Draw the schematic of the machine into this file, .svg, .png or .pdf
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    figure: Option<PathBuf>,

    #[command(flatten)]
    look: FigureArgs,
}

/// An entry of the list, as JSON.
#[derive(Serialize)]
struct Entry {
    name: &'static str,
    title: Option<String>,
    coordinates: Vec<String>,
    stops: Vec<String>,
    friction: Vec<String>,
    parameters: Named<f64>,
}

/// A machine, as JSON.
#[derive(Serialize)]
struct Shown {
    title: Option<String>,
    source: Option<String>,
    summary: Option<String>,
    parameters: Named<f64>,
    /// All numbers by path.
    numbers: Named<f64>,
    /// The expansion.
    machine: WrittenMachine,
}

pub(super) fn run(args: &MachineCommand, session: &Session) -> Result<(), Failure> {
    match &args.verb {
        Verb::List(args) => list(*args, session),
        Verb::Show(args) => show(args, session),
    }
}

fn list(args: List, session: &Session) -> Result<(), Failure> {
    let mut entries = Vec::new();
    for entry in CATALOGUE {
        let source = entry.source()?;
        let parts = source.parts()?;
        entries.push(Entry {
            name: entry.name,
            title: source.title,
            coordinates: parts.coordinates,
            stops: parts.stops.into_iter().map(|stop| stop.name).collect(),
            friction: parts.joints.into_iter().map(|joint| joint.name).collect(),
            parameters: source.parameters,
        });
    }
    if args.json {
        #[derive(Serialize)]
        struct Machines {
            machines: Vec<Entry>,
        }
        return session.print_json(&Machines { machines: entries });
    }
    let titles = entries.iter().map(|entry| (entry.name, entry.title.as_deref().unwrap_or_default()));
    session.print(&text::list(titles))
}

fn show(args: &Show, session: &Session) -> Result<(), Failure> {
    if args.figure.is_none() && args.look.any() {
        return Err(Failure::bad("the look of a figure is given, and no figure\nhint: --figure FILE.svg"));
    }
    let source = args.set.apply(machine_file::read(&args.machine)?)?;
    let expansion = source.expansion()?;
    let picture = args.figure.as_ref().map(|path| Picture::reserve(path, &args.look, session.force)).transpose()?;
    if args.json {
        session.print_json(&Shown {
            title: source.title.clone(),
            source: source.source.clone(),
            summary: source.summary.clone(),
            parameters: source.parameters.clone(),
            numbers: source.numbers()?,
            machine: expansion.machine,
        })?;
    } else if args.toml {
        session.print(&expansion.to_toml())?;
    } else if args.written {
        session.print(&source.to_toml())?;
    } else {
        session.print(&text::machine(&args.machine, &source, &source.numbers()?, &expansion))?;
    }
    if let Some((picture, path)) = picture.zip(args.figure.as_ref()) {
        picture.write(figure(&source)?)?;
        session.note(&format!("wrote {}", path.display()));
    }
    Ok(())
}

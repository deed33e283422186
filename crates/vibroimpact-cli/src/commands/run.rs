//! `vibro run`: fills a store with the study of a plan in a file.

use super::stored;
use crate::args::{BudgetArgs, ColourArgs, Filling, OutputArgs, OverlayArgs, Question, tiles};
use crate::commands::outputs::Outputs;
use crate::commands::respond;
use crate::failure::Failure;
use crate::hints;
use crate::machine_file;
use crate::session::Session;
use clap::Args;
use std::path::{Path, PathBuf};
use vibroimpact_report::{Shown, Units};
use vibroimpact_store::Part;
use vibroimpact_study::{Plan, PlanError, Study};

/// Run a study from a plan, into a store that can be resumed
///
/// The plan says what is computed, for which system and over which axes; `vibro schema` prints what a plan may contain,
/// and any command with --json prints its plan. The store is a Zarr group, which xarray, zarr and napari open. Tiles that
/// are done are not computed again. Several processes and machines may fill one store.
#[derive(Clone, Debug, Args)]
#[command(
    mut_arg("csv", |arg| arg.help("When all tiles are there: write the short table to this file; - for stdout")),
    mut_arg("plot", |arg| arg.help("When all tiles are there: draw the figure into this file, .svg, .png or .pdf")),
    mut_arg("json", |arg| arg.help("Print one JSON object with what was done")),
    after_help = "Examples:\n  \
    vibro run map.toml --store map.zarr --plot map.png\n  \
    vibro run map.toml --store /scratch/map.zarr \\\n    \
    --tiles 3/16     the third of sixteen jobs"
)]
pub(crate) struct Run {
    /// The plan, TOML or JSON
    #[arg(value_name = "PLAN")]
    pub(super) plan: PathBuf,

    /// Where the store is [default: the name of the plan, with .zarr, in the current folder]
    #[arg(long, value_name = "DIR", help_heading = "Store")]
    pub(super) store: Option<String>,

    /// Only part I of N of the tiles, for an array of jobs
    #[arg(long, value_parser = tiles, value_name = "I/N", help_heading = "Store")]
    tiles: Option<Part>,

    #[command(flatten)]
    budget: BudgetArgs,

    #[command(flatten)]
    colour: ColourArgs,
    #[command(flatten)]
    overlay: OverlayArgs,
    #[command(flatten)]
    output: OutputArgs,
}

/// Reads and checks the plan in a file.
pub(super) fn read(path: &Path) -> Result<Plan, Failure> {
    let plan = Plan::from_text_and_files(&text(path)?, |other| machine_file::beside(path, other));
    let plan = plan.map_err(|error| named(path, &error))?;
    // a machine is in the file, so the file is named
    let checked = plan.check();
    match checked {
        Err(error) if plan.machine().is_some() => Err(named(path, &error)),
        checked => Ok(checked.map(|()| plan)?),
    }
}

fn text(path: &Path) -> Result<String, Failure> {
    let name = path.display();
    std::fs::read_to_string(path)
        .map_err(|error| Failure::bad(format!(
                "the plan `{name}` cannot be read: {error}\nhint: a plan is a TOML or JSON file; `vibro schema` prints what may be in it"
            )))
}

/// An error in the plan of a file.
fn named(path: &Path, error: &PlanError) -> Failure {
    Failure::bad(format!("`{}`: {}", path.display(), hints::worded(error, hints::plan(error))))
}

/// The plan of a machine that fills no grid: its result is printed.
fn run_machine(args: &Run, plan: Plan, session: &Session) -> Result<(), Failure> {
    if args.store.is_some() || args.tiles.is_some() || args.budget.get().is_some() {
        return Err(Study::new(&plan).err().map_or_else(|| Failure::bad("the plan fills no store"), Failure::from));
    }
    args.colour.coloured(false)?;
    args.overlay.overlay(false, false)?;
    let name = args.plan.file_stem().map_or_else(|| "machine".into(), |stem| stem.to_string_lossy());
    let question = Question { plan, units: Units::default(), machine: Some(&name) };
    respond::ask(&question, &args.output, None, session)
}

/// The default place of the store of a plan.
pub(super) fn default_store(plan: &Path) -> String {
    let stem = plan.file_stem().map_or_else(|| "study".into(), |stem| stem.to_string_lossy().into_owned());
    format!("{stem}.zarr")
}

pub(super) fn run(args: &Run, session: &Session) -> Result<(), Failure> {
    let plan = read(&args.plan)?;
    if plan.machine().is_some() && !plan.fills_a_grid() {
        return run_machine(args, plan, session);
    }
    let outputs = Outputs::reserve(args.output.files(), session)?;
    let place = args.store.clone().unwrap_or_else(|| default_store(&args.plan));
    let colour = args.colour.coloured(outputs.drawn())?;
    let overlay = args.overlay.overlay(outputs.drawn(), colour.is_some())?;
    stored::check_overlay(&overlay, &plan, colour.is_some())?;
    let part = args.tiles.unwrap_or(Part::ALL);
    let filling = Filling { place: &place, part, budget: args.budget.get() };
    stored::run(&plan, &filling, (outputs, Shown { colour, overlay, ..Shown::default() }), session)
}

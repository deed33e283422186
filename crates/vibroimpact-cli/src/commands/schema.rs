//! `vibro schema`: the JSON schema of plans, of machine files, and of answers.

use crate::failure::Failure;
use crate::session::Session;
use vibroimpact_report::json;
use vibroimpact_study::Plan;
use vibroimpact_study::machine::MachineSource;

/// Print the JSON schema of plans, of machine files or of answers, for editors and other programs
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct Schema {
    /// The schema of the object that this command prints with --json, the same for every system: simulate, settle, attractors,
    /// orbit, branch, curve, region, response, margins, lyapunov, diagram, map or basin
    #[arg(value_name = "COMMAND", conflicts_with_all = ["machine", "machine_plan"])]
    of: Option<String>,

    /// The schema of machine files instead of that of plans
    #[arg(long)]
    machine: bool,

    /// The schema of plans, which is that of plans of machines too
    #[arg(long, conflicts_with = "machine", hide = true)]
    machine_plan: bool,
}

pub(super) fn run(args: &Schema, session: &Session) -> Result<(), Failure> {
    let schema = match (args.of.as_deref(), args.machine) {
        (Some(verb), _) => json::schema(verb).ok_or_else(|| {
            let known: Vec<&str> = json::verbs().collect();
            Failure::bad(format!("`{verb}` has no schema of an answer\nhint: one of {}", known.join(", ")))
        })?,
        (_, true) => MachineSource::schema(),
        _ => Plan::schema(),
    };
    let text = serde_json::to_string_pretty(&schema)
        .map_err(|error| Failure::Failed(format!("the schema failed: {error}")))?;
    session.print(&(text + "\n"))
}

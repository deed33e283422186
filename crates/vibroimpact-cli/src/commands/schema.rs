//! `vibro schema`: the JSON schema of plans, of machine files and of plans of machines.

use crate::failure::Failure;
use crate::session::Session;
use vibroimpact_study::machine::MachineSource;
use vibroimpact_study::{MachinePlan, Plan};

/// Print the JSON schema of plans, of machine files or of plans of machines, for editors and other programs
#[derive(Clone, Copy, Debug, clap::Args)]
pub(crate) struct Schema {
    /// The schema of machine files instead of that of plans
    #[arg(long)]
    machine: bool,

    /// The schema of plans of machines
    #[arg(long, conflicts_with = "machine")]
    machine_plan: bool,
}

pub(super) fn run(args: Schema, session: &Session) -> Result<(), Failure> {
    let schema = match (args.machine, args.machine_plan) {
        (true, _) => MachineSource::schema(),
        (_, true) => MachinePlan::schema(),
        _ => Plan::schema(),
    };
    let text = serde_json::to_string_pretty(&schema)
        .map_err(|error| Failure::Failed(format!("the schema failed: {error}")))?;
    session.print(&(text + "\n"))
}

//! `vibro schema`: the JSON schema of plans and of machine files.

use crate::failure::Failure;
use crate::session::Session;
use vibroimpact_study::Plan;
use vibroimpact_study::machine::MachineSource;

/// Print the JSON schema of plans or of machine files, for editors and other programs
#[derive(Clone, Copy, Debug, clap::Args)]
pub(crate) struct Schema {
    /// The schema of machine files instead of that of plans
    #[arg(long)]
    machine: bool,
}

pub(super) fn run(args: Schema, session: &Session) -> Result<(), Failure> {
    let schema = if args.machine { MachineSource::schema() } else { Plan::schema() };
    let text = serde_json::to_string_pretty(&schema)
        .map_err(|error| Failure::Failed(format!("the schema failed: {error}")))?;
    session.print(&(text + "\n"))
}

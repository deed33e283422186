//! `vibro schema`: the JSON schema of plans.

use crate::failure::Failure;
use crate::session::Session;
use vibroimpact_study::Plan;

/// Print the JSON schema of plans, for editors and other programs
#[derive(Clone, Copy, Debug, clap::Args)]
pub(crate) struct Schema {}

pub(super) fn run(session: &Session) -> Result<(), Failure> {
    let text = serde_json::to_string_pretty(&Plan::schema())
        .map_err(|error| Failure::Failed(format!("the schema failed: {error}")))?;
    session.print(&(text + "\n"))
}

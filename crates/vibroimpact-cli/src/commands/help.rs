//! `vibro help [COMMAND|TOPIC]`.

use crate::commands::CommandLine;
use crate::failure::Failure;
use crate::help::{shown, topic, topics};
use crate::session::Session;
use clap::{Args, CommandFactory};

/// Explain a command, or a topic: system, figure, units, quantities, machines
#[derive(Clone, Debug, Args)]
#[command(after_help = "Examples:\n  vibro help settle\n  vibro help machine show\n  vibro help system")]
pub(crate) struct Help {
    /// A command, such as `settle` or `machine show`, or a topic
    #[arg(value_name = "COMMAND|TOPIC")]
    of: Vec<String>,
}

pub(super) fn run(args: &Help, session: &Session) -> Result<(), Failure> {
    let command = CommandLine::command();
    if let [name] = args.of.as_slice()
        && let Some(text) = topic(name, &command)
    {
        return session.print(&text);
    }
    let mut command = shown(command);
    // gives each command its full name
    command.build();
    let mut found = &mut command;
    for name in &args.of {
        found = match found.find_subcommand_mut(name) {
            Some(sub) => sub,
            None => {
                return Err(Failure::bad(format!(
                    "there is no command and no topic `{name}`\nhint: `vibro help` lists them"
                )));
            }
        };
    }
    let whole = args.of.is_empty();
    let text = found.render_long_help().to_string();
    session.print(&if whole { format!("{text}\nTopics:\n{}", topics()) } else { text })
}

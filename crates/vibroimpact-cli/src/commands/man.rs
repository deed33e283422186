//! `vibro man [DIR]`.

use crate::commands::CommandLine;
use crate::failure::Failure;
use crate::files::Target;
use crate::session::Session;
use clap::{Args, Command, CommandFactory};
use clap_mangen::Man as Page;
use std::path::PathBuf;
use vibroimpact_study::counted;

/// Print the manual page, or write one page per command into a directory
#[derive(Clone, Debug, Args)]
#[command(after_help = "Examples:\n  vibro man | man -l -\n  vibro man ~/.local/share/man/man1")]
pub(crate) struct Man {
    /// Directory for vibro.1, vibro-settle.1 and so on; it must exist
    #[arg(value_name = "DIR")]
    directory: Option<PathBuf>,
}

pub(super) fn run(args: &Man, session: &Session) -> Result<(), Failure> {
    let mut command = CommandLine::command();
    command.build();
    let Some(directory) = &args.directory else {
        let page = rendered(command)?;
        return session.to_stdout(|out| out.write_all(&page));
    };
    let mut pages = vec![("vibro.1".to_owned(), command.clone())];
    collect(&command, "vibro", &mut pages);
    let mut reserved = Vec::new();
    for (file, command) in pages {
        let target = Target::reserve(&directory.join(file), session.force)?;
        reserved.push((target, rendered(command)?));
    }
    let count = reserved.len();
    for (target, page) in reserved {
        target.write(|out| out.write_all(&page))?;
    }
    session.note(&format!("wrote {} to {}", counted(count as u64, "page"), directory.display()));
    Ok(())
}

/// The pages of the sub-commands, and of theirs.
fn collect(command: &Command, name: &str, pages: &mut Vec<(String, Command)>) {
    for sub in command.get_subcommands().filter(|sub| sub.get_name() != "help") {
        // `build()` has given each sub-command its full name
        let name = format!("{name}-{}", sub.get_name());
        pages.push((format!("{name}.1"), sub.clone()));
        collect(sub, &name, pages);
    }
}

fn rendered(command: Command) -> Result<Vec<u8>, Failure> {
    let mut page = Vec::new();
    Page::new(command).render(&mut page).map_err(|error| Failure::writing("the manual page", &error))?;
    Ok(page)
}
